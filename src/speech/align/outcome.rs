//! What was found, as an alignment: times in seconds, places for what was not heard, and what the author should know.

use super::chain::Chain;
use super::features::FRAMES;
use super::search::{Section, Way};
use crate::speech::{Note, Pin, SpokenPhone, SpokenSyllable};

/// The place of a syllable that is not heard is this long, in seconds, where there is room.
const PLACE: f64 = 0.04;

/// Of a neighbour no more than this is taken to make room.
const TAKEN: f64 = 0.25;

/// The times of every syllable; `confidence` has one for each.
#[must_use]
pub fn spoken(
    chain: &Chain,
    sections: &[Section],
    ways: &[Way],
    pins: &[Pin],
    confidence: &[f64],
    duration: f64,
) -> Vec<SpokenSyllable> {
    let time = |frame: usize| (frame as f64 / FRAMES).min(duration);
    let mut syllables = Vec::with_capacity(chain.syllables.len());
    for (section, way) in sections.iter().zip(ways) {
        let first = chain.syllables[section.first].start;
        for number in section.first..section.last {
            let links = chain.syllables[number].clone();
            let span = |link: usize| way.links[link - first];
            let mut phones: Vec<SpokenPhone> = Vec::new();
            for (index, phone) in chain.phones[number].iter().enumerate() {
                let mut own = links.clone().filter(|l| chain.links[*l].phone == index);
                let Some(a) = own.next() else { continue };
                let b = own.next_back().unwrap_or(a);
                phones.push(SpokenPhone { phone, start: time(span(a).0), end: time(span(b).1) });
            }
            let (start, end) = (time(span(links.start).0), time(span(links.end - 1).1));
            let heard = section.full || span(links.end - 1).1 > span(links.start).0;
            let confidence = if heard { confidence.get(number).copied().unwrap_or(0.0) } else { 0.0 };
            syllables.push(SpokenSyllable { start, end, confidence, heard, phones });
        }
    }
    let pinned = |number: usize| pins.iter().find(|p| p.syllable == number);
    for (number, syllable) in syllables.iter_mut().enumerate() {
        if let Some(pin) = pinned(number) {
            place(syllable, pin.start, pin.end);
            syllable.confidence = 1.0;
        }
    }
    // Pins need not lie on frames: what is beside them gives way.
    let free = |number: &usize| pinned(*number).is_none();
    for number in 0..syllables.len() {
        let Some(pin) = pinned(number) else { continue };
        if let Some(before) = number.checked_sub(1).filter(free) {
            let (start, end) = (syllables[before].start, syllables[before].end);
            if end > pin.start {
                place(&mut syllables[before], start.min(pin.start), pin.start);
            }
        }
        if let Some(after) = Some(number + 1).filter(|n| *n < syllables.len() && free(n)) {
            let (start, end) = (syllables[after].start, syllables[after].end);
            if start < pin.end {
                place(&mut syllables[after], pin.end, end.max(pin.end));
            }
        }
    }
    let fixed: Vec<bool> = (0..syllables.len()).map(|n| pinned(n).is_some()).collect();
    make_room(&mut syllables, &fixed, duration);
    syllables
}

/// Gives every run of syllables that are not heard a short place where it belongs.
fn make_room(syllables: &mut [SpokenSyllable], fixed: &[bool], duration: f64) {
    let mut from = 0;
    while from < syllables.len() {
        if syllables[from].heard {
            from += 1;
            continue;
        }
        let to = (from..syllables.len()).find(|n| syllables[*n].heard).unwrap_or(syllables.len());
        let need = PLACE * (to - from) as f64;
        let mut low = from.checked_sub(1).map_or(0.0, |n| syllables[n].end);
        let mut high = syllables.get(to).map_or(duration, |s| s.start).max(low);
        if high - low < need {
            let lacking = 0.5 * (need - (high - low));
            if let Some(n) = from.checked_sub(1).filter(|n| !fixed[*n] && syllables[*n].heard) {
                let (start, end) = (syllables[n].start, syllables[n].end);
                low = end - lacking.min(TAKEN * (end - start));
                place(&mut syllables[n], start, low);
            }
            if let Some(s) = syllables.get_mut(to).filter(|_| !fixed[to]) {
                let (start, end) = (s.start, s.end);
                high = start + lacking.min(TAKEN * (end - start));
                place(s, high, end);
            }
        } else {
            // About where the way passed over them.
            let at = syllables[from].start;
            low = (at - 0.5 * need).clamp(low, high - need);
            high = low + need;
        }
        let each = (high - low) / (to - from) as f64;
        for (i, s) in syllables[from..to].iter_mut().enumerate() {
            place(s, low + each * i as f64, low + each * (i + 1) as f64);
        }
        if let Some(last) = syllables[from..to].last_mut() {
            place(last, last.start, high);
        }
        from = to;
    }
}

/// Moves a syllable to other times, its phones with it: in proportion, evenly where they have none.
fn place(syllable: &mut SpokenSyllable, start: f64, end: f64) {
    let (from, length) = (syllable.start, syllable.end - syllable.start);
    let count = syllable.phones.len();
    for (number, phone) in syllable.phones.iter_mut().enumerate() {
        let share = |t: f64, evenly: usize| {
            let share = if length > 0.0 { (t - from) / length } else { evenly as f64 / count as f64 };
            start + share * (end - start)
        };
        (phone.start, phone.end) = (share(phone.start, number), share(phone.end, number + 1));
    }
    // To the bit at the ends, and each where the one before ends.
    for n in 1..count {
        syllable.phones[n].start = syllable.phones[n - 1].end;
    }
    if let Some(phone) = syllable.phones.first_mut() {
        phone.start = start;
    }
    if let Some(phone) = syllable.phones.last_mut() {
        phone.end = end;
    }
    (syllable.start, syllable.end) = (start, end);
}

/// Where sound and script part.
#[must_use]
pub fn partings(sections: &[Section], ways: &[Way], syllables: &[SpokenSyllable]) -> Vec<Note> {
    let mut notes: Vec<(f64, Note)> = Vec::new();
    for (section, way) in sections.iter().zip(ways) {
        for (offset, beside) in way.beside.iter().enumerate() {
            if let Some((from, to)) = beside {
                let (start, end) = (*from as f64 / FRAMES, *to as f64 / FRAMES);
                notes.push((start, Note::NotInScript { before: section.first + offset, start, end }));
            }
        }
    }
    let mut first = 0;
    while first < syllables.len() {
        let count = syllables[first..].iter().take_while(|s| !s.heard).count();
        if count > 0 {
            let at = syllables[first].start;
            notes.push((at, Note::NotHeard { first, count, at }));
        }
        first += count.max(1);
    }
    notes.sort_by(|a, b| a.0.total_cmp(&b.0));
    notes.into_iter().map(|n| n.1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn syllable(start: f64, end: f64, heard: bool) -> SpokenSyllable {
        let middle = 0.5 * (start + end);
        let phone = |start, end| SpokenPhone { phone: "a", start, end };
        SpokenSyllable { start, end, confidence: 0.5, heard, phones: vec![phone(start, middle), phone(middle, end)] }
    }

    fn in_order(syllables: &[SpokenSyllable]) {
        for pair in syllables.windows(2) {
            assert!(pair[0].end <= pair[1].start, "{pair:?}");
        }
        for s in syllables {
            assert_eq!((s.start, s.end), (s.phones[0].start, s.phones[1].end));
            assert!(s.phones[0].end == s.phones[1].start && s.start <= s.phones[0].end && s.phones[0].end <= s.end);
        }
    }

    #[test]
    fn what_is_not_heard_has_a_short_place_between_its_neighbours() {
        let mut said = vec![syllable(0.2, 0.5, true), syllable(0.5, 0.5, false), syllable(0.5, 0.8, true)];
        make_room(&mut said, &[false; 3], 1.0);
        in_order(&said);
        assert!((said[1].end - said[1].start - PLACE).abs() < 1e-9, "{:?}", said[1]);
        let mut said = vec![syllable(0.2, 0.5, true), syllable(0.7, 0.7, false), syllable(0.7, 0.7, false)];
        make_room(&mut said, &[false; 3], 1.0);
        in_order(&said);
        assert!(said[1].start >= 0.5 && (said[2].end - said[1].start - 2.0 * PLACE).abs() < 1e-9);
        assert_eq!((said[0].start, said[0].end), (0.2, 0.5));
    }

    #[test]
    fn a_pinned_neighbour_gives_no_room() {
        let mut said = vec![syllable(0.2, 0.5, true), syllable(0.5, 0.5, false), syllable(0.5, 0.8, true)];
        make_room(&mut said, &[true, false, true], 1.0);
        in_order(&said);
        assert_eq!((said[0].end, said[2].start), (0.5, 0.5));
    }
}
