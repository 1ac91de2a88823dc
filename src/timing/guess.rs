//! Times for syllables that nobody has aligned yet: equal shares of the sound.

use super::{Interval, Tier};

/// A silence longer than this is a pause, which no syllable goes through. Stops close the mouth for up to a fifth of
/// a second, so shorter ones may lie inside a syllable. Seconds.
const PAUSE: f64 = 0.25;

/// Shares the time that is not silence equally among syllables.
///
/// Spans of sound less than 0.25 s apart are one stretch. Each stretch gets whole syllables: after each one as many
/// are used up as its share of all sound so far rounds to, so that no syllable goes through a pause and none is more
/// than half a share off because of that. Within a stretch all get the same time of sound; the short silences inside
/// are not counted, and a boundary that falls on one leaves it between the syllables. Where there is no sound at all
/// the syllables share the whole duration.
///
/// `sounding` holds spans in seconds, by rising time. The tier is called `syllables`; whoever puts it into a
/// [`super::Timing`] marks that as guessed.
#[must_use]
pub fn equal_shares(sounding: &[(f64, f64)], labels: &[String], duration: f64) -> Tier {
    let mut stretches: Vec<Vec<(f64, f64)>> = Vec::new();
    for &span in sounding.iter().filter(|(start, end)| end > start) {
        match stretches.last_mut() {
            Some(stretch) if stretch.last().is_some_and(|last| span.0 - last.1 <= PAUSE) => stretch.push(span),
            _ => stretches.push(vec![span]),
        }
    }
    if stretches.is_empty() {
        stretches.push(vec![(0.0, duration.max(0.0))]);
    }
    let whole: f64 = stretches.iter().map(|s| length(s)).sum();
    let mut tier = Tier::new("syllables");
    let (mut heard, mut used) = (0.0, 0);
    for (index, stretch) in stretches.iter().enumerate() {
        heard += length(stretch);
        let upto = if index + 1 == stretches.len() || whole <= 0.0 {
            labels.len()
        } else {
            ((labels.len() as f64 * heard / whole).round() as usize).clamp(used, labels.len())
        };
        let count = upto - used;
        let share = length(stretch) / count.max(1) as f64;
        for (place, label) in labels[used..upto].iter().enumerate() {
            let start = at_sound(stretch, place as f64 * share, Side::After);
            let end = at_sound(stretch, (place + 1) as f64 * share, Side::Before);
            tier.intervals.push(Interval::new(start, end.max(start), label.clone()));
        }
        used = upto;
    }
    tier
}

fn length(stretch: &[(f64, f64)]) -> f64 {
    stretch.iter().map(|(start, end)| end - start).sum()
}

/// On which side of a short silence a boundary that falls on it lies.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Before,
    After,
}

/// The time at which `sound` seconds of a stretch have been heard, its silences not counted.
fn at_sound(stretch: &[(f64, f64)], sound: f64, side: Side) -> f64 {
    // Adding shares up rounds; a boundary this near to a silence is on it.
    const NEAR: f64 = 1e-9;
    let mut left = sound;
    for &(start, end) in stretch {
        let here = end - start;
        if left < here - NEAR || (side == Side::Before && left <= here + NEAR) {
            return start + left.clamp(0.0, here);
        }
        left -= here;
    }
    stretch.last().map_or(0.0, |last| last.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guess(sounding: &[(f64, f64)], count: usize) -> Vec<(f64, f64)> {
        let labels: Vec<String> = (0..count).map(|i| i.to_string()).collect();
        let tier = equal_shares(sounding, &labels, 4.0);
        assert!(tier.intervals.iter().zip(&labels).all(|(i, l)| i.label == *l));
        tier.intervals.iter().map(|i| (i.start, i.end)).collect()
    }

    #[test]
    fn one_stretch_is_cut_into_equal_parts() {
        assert_eq!(guess(&[(1.0, 3.0)], 4), [(1.0, 1.5), (1.5, 2.0), (2.0, 2.5), (2.5, 3.0)]);
    }

    #[test]
    fn no_syllable_goes_through_a_pause_and_counts_follow_the_sound() {
        assert_eq!(guess(&[(0.0, 1.0), (2.0, 4.0)], 3), [(0.0, 1.0), (2.0, 3.0), (3.0, 4.0)]);
        for (start, end) in guess(&[(0.0, 1.1), (2.0, 2.7), (3.0, 3.3)], 7) {
            assert!(end <= 1.1 || (start >= 2.0 && end <= 2.7) || start >= 3.0, "{start} {end}");
        }
    }

    #[test]
    fn a_short_silence_lies_between_syllables_where_a_boundary_falls_on_it_and_inside_one_otherwise() {
        assert_eq!(guess(&[(0.0, 1.0), (1.2, 2.2)], 2), [(0.0, 1.0), (1.2, 2.2)]);
        assert_eq!(guess(&[(0.0, 1.0), (1.2, 2.2)], 1), [(0.0, 2.2)]);
    }

    #[test]
    fn without_sound_the_whole_duration_is_shared_and_without_labels_there_is_nothing() {
        assert_eq!(guess(&[], 2), [(0.0, 2.0), (2.0, 4.0)]);
        assert_eq!(guess(&[(0.0, 1.0)], 0), []);
    }
}
