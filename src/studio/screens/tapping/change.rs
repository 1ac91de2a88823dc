//! The change that tapping makes of a project.

use super::clock::Tapping;
use crate::project::{Change, Clip, ClipEdit, Edit, counted};

/// The shortest a syllable can be, in seconds, as when its edges are moved by hand.
const SHORTEST: f64 = 0.02;

/// A syllable that nothing ends lasts at most so long, in seconds.
const LONGEST_LAST: f64 = 0.6;

/// What syllables that had to give way take each, where there is room, in seconds.
const USUAL: f64 = 0.2;

/// The tapped syllables with their starts and ends, by their numbers.
pub(super) fn spoken(tapping: &Tapping, clip: &Clip) -> Vec<(usize, f64, f64)> {
    let duration = clip.duration();
    // What is rounded up must not lie beyond the sound.
    let round = |t: f64| ((t * 1e4).round() / 1e4).min(duration);
    let mut spoken: Vec<(usize, f64, Option<f64>)> = Vec::new();
    for tap in &tapping.taps {
        match (tap.is_end, spoken.last_mut()) {
            (true, Some(last)) => last.2 = Some(round(tap.at)),
            (true, None) => {}
            (false, last) => {
                if let Some(last) = last {
                    last.2 = last.2.or(Some(round(tap.at)));
                }
                spoken.push((tap.syllable, round(tap.at), None));
            }
        }
    }
    let sounding = clip.sound.as_ref().map(|s| s.sounding()).unwrap_or_default();
    let ended = |(syllable, start, end): (usize, f64, Option<f64>)| {
        // What nothing ends goes on as long as there is sound.
        let until = sounding.iter().find(|(from, to)| *from < start + 0.1 && start + SHORTEST < *to).map(|(_, to)| *to);
        let last = until.unwrap_or(start + USUAL).min(start + LONGEST_LAST).min(duration);
        (syllable, start, end.unwrap_or(round(last)))
    };
    let mut spoken: Vec<(usize, f64, f64)> = spoken.into_iter().map(ended).collect();
    spoken.retain(|(_, start, end)| end - start >= SHORTEST - 1e-9);
    spoken
}

/// The change that gives the tapped syllables their times and vouches for them. The others stay where they are, as far
/// as there is room, and give way where there is not.
///
/// # Errors
/// In one line, where those that were not tapped have no room left.
pub(super) fn change_of(number: usize, clip: &Clip, spoken: &[(usize, f64, f64)]) -> Result<Change, String> {
    let before: Vec<(f64, f64)> = clip.intervals().iter().map(|i| (i.start, i.end)).collect();
    let mut after = before.clone();
    let mut tapped = vec![false; after.len()];
    for (syllable, start, end) in spoken {
        if let Some(times) = after.get_mut(*syllable) {
            *times = (*start, *end);
            tapped[*syllable] = true;
        }
    }
    let is_tapped = |i: usize| tapped[i];
    let mut at = 0;
    while at < after.len() {
        if is_tapped(at) {
            at += 1;
            continue;
        }
        let end = (at..after.len()).find(|i| is_tapped(*i)).unwrap_or(after.len());
        let low = at.checked_sub(1).map_or(0.0, |i| after[i].1);
        let high = after.get(end).map_or(clip.duration(), |t| t.0);
        give_way(&mut after[at..end], low, high).map_err(|()| {
            let name = clip.syllables.get(at).map_or("", |s| s.text.as_str());
            let many = counted(end - at, "syllable");
            format!("no room is left for {many} from {name} on, not tapped: Backspace goes back, x drops the taps")
        })?;
        at = end;
    }
    let moved = |i: &usize| before[*i] != after[*i];
    let first = (0..after.len()).find(moved).unwrap_or(0);
    let last = (0..after.len()).rev().find(moved).map_or(first, |l| l + 1);
    let mut edits = Vec::new();
    if last > first {
        let (before, after) = (before[first..last].to_vec(), after[first..last].to_vec());
        edits.push(Edit::Clip(number, ClipEdit::Times { first, before, after }));
    }
    for index in 0..after.len() {
        let was = clip.score.pins.binary_search(&index).is_ok();
        // Nobody vouches for what had to give way.
        let is = is_tapped(index) || was && !moved(&index);
        if was != is {
            edits.push(Edit::Clip(number, ClipEdit::Pin { index, pinned: is }));
        }
    }
    Ok(Change { label: format!("{} tapped", counted(spoken.len(), "syllable")), edits })
}

/// Moves and shrinks neighbouring syllables so that they lie between two times, no more than is needed.
fn give_way(times: &mut [(f64, f64)], low: f64, high: f64) -> Result<(), ()> {
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return Ok(()) };
    let (from, to) = (first.0, last.1);
    if from >= low - 1e-9 && to <= high + 1e-9 {
        return Ok(());
    }
    let least = SHORTEST * times.len() as f64;
    if high - low < least {
        return Err(());
    }
    let wanted = (USUAL * times.len() as f64).min(high - low).min(to - from).max(least);
    let (mut new_from, mut new_to) = (from.max(low), to.min(high));
    if new_to - new_from < wanted {
        // They keep to the side where they were.
        if from < low {
            (new_from, new_to) = (low, (low + wanted).min(high));
        } else {
            (new_from, new_to) = ((high - wanted).max(low), high);
        }
    }
    // Syllables that take no time at all cannot be drawn out.
    let scale = if to - from > 1e-9 { (new_to - new_from) / (to - from) } else { 0.0 };
    let least_scaled = times.iter().map(|t| (t.1 - t.0) * scale).fold(f64::INFINITY, f64::min);
    let count = times.len() as f64;
    for (index, time) in times.iter_mut().enumerate() {
        *time = if least_scaled < SHORTEST {
            // Shares alike, where some would get too short to be seen.
            let share = |n: usize| new_from + (new_to - new_from) * n as f64 / count;
            (share(index), share(index + 1))
        } else {
            (new_from + (time.0 - from) * scale, new_from + (time.1 - from) * scale)
        };
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_tapped_gives_way_no_more_than_it_must() {
        let times = [(1.0, 1.2), (1.2, 1.6)];
        let given = |low, high| {
            let mut times = times;
            give_way(&mut times, low, high).map(|()| times.map(|(a, b)| ((a * 1e4).round(), (b * 1e4).round())))
        };
        assert_eq!(given(0.5, 2.0), Ok([(10000.0, 12000.0), (12000.0, 16000.0)]));
        assert_eq!(given(1.1, 2.0), Ok([(11000.0, 12667.0), (12667.0, 16000.0)]));
        assert_eq!(given(3.0, 9.0), Ok([(30000.0, 31333.0), (31333.0, 34000.0)]));
        assert_eq!(given(0.0, 0.5), Ok([(1000.0, 2333.0), (2333.0, 5000.0)]));
        assert_eq!(given(1.0, 1.05), Ok([(10000.0, 10250.0), (10250.0, 10500.0)]));
        assert_eq!(given(1.0, 1.03), Err(()));
        let mut none = [(1.0, 1.0), (1.0, 1.0)];
        assert_eq!(give_way(&mut none, 2.0, 3.0), Ok(()));
        assert_eq!(
            none.map(|(a, b)| ((a * 1e4_f64).round(), (b * 1e4_f64).round())),
            [(20000.0, 20200.0), (20200.0, 20400.0)]
        );
    }
}
