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
pub(crate) fn spoken(
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
    // Pins need not lie on frames: all that is between two of them stays there, heard or not.
    let fixed: Vec<bool> = (0..syllables.len()).map(|n| pinned(n).is_some()).collect();
    let highs = highs(&syllables, &fixed, duration);
    let mut low = 0.0;
    for number in 0..syllables.len() {
        if fixed[number] {
            low = syllables[number].end;
            continue;
        }
        within(&mut syllables[number], low, highs[number]);
    }
    make_room(&mut syllables, &fixed, duration);
    in_order(&mut syllables, &fixed, duration);
    syllables
}

/// For each syllable when the next one that is set begins.
fn highs(syllables: &[SpokenSyllable], fixed: &[bool], duration: f64) -> Vec<f64> {
    let mut next = duration;
    let mut highs = vec![duration; syllables.len()];
    for (number, syllable) in syllables.iter().enumerate().rev() {
        highs[number] = next;
        if fixed[number] {
            next = syllable.start;
        }
    }
    highs
}

/// Keeps a syllable between two times; where they contradict each other, before the later one.
fn within(syllable: &mut SpokenSyllable, low: f64, high: f64) {
    let start = syllable.start.max(low).min(high);
    let end = syllable.end.max(start).min(high);
    if (start, end) != (syllable.start, syllable.end) {
        place(syllable, start, end);
    }
}

/// Lets nothing begin before what precedes it ends, whatever was moved and rounded; what is set by a person stays.
fn in_order(syllables: &mut [SpokenSyllable], fixed: &[bool], duration: f64) {
    let highs = highs(syllables, fixed, duration);
    let mut before = 0.0;
    for ((syllable, fixed), high) in syllables.iter_mut().zip(fixed).zip(highs) {
        if !fixed {
            within(syllable, before, high);
        }
        let mut at = syllable.start;
        for phone in &mut syllable.phones {
            phone.start = phone.start.max(at).min(syllable.end);
            phone.end = phone.end.max(phone.start).min(syllable.end);
            at = phone.end;
        }
        before = syllable.end;
    }
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
        let mut high = syllables.get(to).map_or(duration, |s| s.start);
        let mut low = from.checked_sub(1).map_or(0.0, |n| syllables[n].end).min(high);
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
            low = (at - 0.5 * need).min(high - need).max(low);
            high = (low + need).min(high);
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
pub(crate) fn partings(sections: &[Section], ways: &[Way], syllables: &[SpokenSyllable]) -> Vec<Note> {
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
    use proptest::prelude::*;

    use super::*;
    use crate::script::{System, syllables};

    fn syllable(start: f64, end: f64, heard: bool) -> SpokenSyllable {
        let middle = 0.5 * (start + end);
        let phone = |start, end| SpokenPhone { phone: "a", start, end };
        SpokenSyllable { start, end, confidence: 0.5, heard, phones: vec![phone(start, middle), phone(middle, end)] }
    }

    fn ordered(syllables: &[SpokenSyllable]) {
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
        ordered(&said);
        assert!((said[1].end - said[1].start - PLACE).abs() < 1e-9, "{:?}", said[1]);
        let mut said = vec![syllable(0.2, 0.5, true), syllable(0.7, 0.7, false), syllable(0.7, 0.7, false)];
        make_room(&mut said, &[false; 3], 1.0);
        ordered(&said);
        assert!(said[1].start >= 0.5 && (said[2].end - said[1].start - 2.0 * PLACE).abs() < 1e-9);
        assert_eq!((said[0].start, said[0].end), (0.2, 0.5));
    }

    #[test]
    fn a_pinned_neighbour_gives_no_room() {
        let mut said = vec![syllable(0.2, 0.5, true), syllable(0.5, 0.5, false), syllable(0.5, 0.8, true)];
        make_room(&mut said, &[true, false, true], 1.0);
        ordered(&said);
        assert_eq!((said[0].end, said[2].start), (0.5, 0.5));
    }

    /// Sections of a script of so many syllables `sa1`, and ways through them: each syllable of a section that no pin
    /// fills takes the next two of `steps` as the frames of its two links, none where `unheard` says so.
    fn found(count: usize, pins: &[Pin], frames: usize, steps: &[usize], unheard: &[bool]) -> Vec<SpokenSyllable> {
        let chain = Chain::of(&syllables(&"sa1 ".repeat(count), System::Hanyu).unwrap());
        let sections = super::super::sections::sections(frames, count, pins);
        let way = |section: &Section| {
            let mut t = section.from;
            let mut links = Vec::new();
            for n in section.first..section.last {
                for half in 0..2 {
                    let long = match (section.full, unheard[n]) {
                        (true, _) => (section.to - section.from) * half,
                        (false, true) => 0,
                        (false, false) => steps[2 * n + half],
                    };
                    let to = if section.full && half == 1 { section.to } else { (t + long).min(section.to) };
                    links.push((t, to));
                    t = to;
                }
            }
            Way { links, ..Way::default() }
        };
        let ways: Vec<Way> = sections.iter().map(way).collect();
        spoken(&chain, &sections, &ways, pins, &vec![0.5; count], frames as f64 / FRAMES)
    }

    fn pin(syllable: usize, start: f64, end: f64) -> Pin {
        Pin { syllable, start, end }
    }

    #[test]
    fn what_is_not_heard_before_a_pin_beside_the_frames_ends_where_the_pin_begins() {
        // The way ends in frame 150, at 0.75 s.
        let pins = [pin(2, 0.7481, 0.95)];
        for unheard in [[false, true, false], [true, true, false], [false, false, false]] {
            let said = found(3, &pins, 200, &[50, 100, 50, 0, 0, 0], &unheard);
            ordered(&said);
            assert!(said[1].end <= 0.7481 && (said[2].start, said[2].end) == (0.7481, 0.95), "{said:?}");
        }
        // And after one.
        let said = found(3, &[pin(0, 0.1, 0.3519)], 200, &[0, 0, 0, 0, 30, 30], &[false, true, false]);
        ordered(&said);
        assert!(said[1].start >= 0.3519 && said[2].end > said[2].start, "{said:?}");
    }

    proptest! {
        #[test]
        fn everything_is_in_order_about_pins_wherever_they_are(
            set in proptest::collection::vec((any::<bool>(), 0.0_f64..1.0, 0.0_f64..1.0), 7),
            steps in proptest::collection::vec(0_usize..60, 14),
            unheard in proptest::collection::vec(any::<bool>(), 7),
        ) {
            let mut times: Vec<f64> = set.iter().flat_map(|s| [1.8 * s.1, 1.8 * s.2]).collect();
            times.sort_by(f64::total_cmp);
            let pins: Vec<Pin> =
                (0..7).filter(|n| set[*n].0).map(|n| pin(n, times[2 * n], times[2 * n + 1])).collect();
            let said = found(7, &pins, 360, &steps, &unheard);
            ordered(&said);
            prop_assert!(said.iter().all(|s| s.start >= 0.0 && s.start <= s.end && s.end <= 1.8));
            for pin in &pins {
                prop_assert_eq!((said[pin.syllable].start, said[pin.syllable].end), (pin.start, pin.end));
            }
        }
    }
}
