//! Times of a clip as edits take them: compared with what is there, checked for order, and carried to the other tiers.

use serde::{Deserialize, Serialize};

use crate::disk::{Fault, Result};
use crate::project::ProjectFault;
use crate::project::fault::stale;
use crate::project::files::{CONFIDENCE, Clip, OWN_TIERS};
use crate::timing::{Tier, Timing};

/// The tiers of a clip, and what they were made from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The tiers.
    pub timing: Timing,
    /// The checksum of sound and script they were found with, where they were found by an alignment.
    pub aligned: Option<String>,
}

impl Times {
    /// Those of a clip as it is.
    pub(in crate::project) fn of(clip: &Clip) -> Self {
        Self { timing: clip.timing.clone(), aligned: clip.score.aligned.clone() }
    }

    /// Puts these times in the place of those of a clip, which must be `before`.
    pub(super) fn put(&self, before: &Self, clip: &mut Clip) -> Result<()> {
        if !same_times(&clip.timing, &before.timing) || clip.score.aligned != before.aligned {
            return Err(stale());
        }
        in_order(self.timing.syllables().unwrap_or(&Tier::default()))?;
        take_own(&mut clip.timing, &self.timing);
        clip.score.aligned.clone_from(&self.aligned);
        clip.read_labels();
        Ok(())
    }
}

/// Whether two sets of tiers have the same syllables at the same times: a file keeps microseconds, memory more. The
/// other tiers follow the syllables.
pub(super) fn same_times(a: &Timing, b: &Timing) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() < 2e-6;
    let intervals = |t: &Timing| t.syllables().map(|t| t.intervals.clone()).unwrap_or_default();
    let (a, b) = (intervals(a), intervals(b));
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| a.label == b.label && near(a.start, b.start) && near(a.end, b.end))
}

/// Gives a clip the tiers that this program writes, from others. Everybody else's stay as they are now.
pub(super) fn take_own(timing: &mut Timing, from: &Timing) {
    let is_own = |t: &&Tier| OWN_TIERS.contains(&t.name.as_str());
    timing.tiers.retain(|t| !is_own(&t));
    for tier in from.tiers.iter().filter(is_own) {
        timing.set_tier(tier.clone());
    }
    timing.guessed = from.guessed;
}

/// Makes sure that syllables follow each other: what does not could be written and not read again.
pub(super) fn in_order(tier: &Tier) -> Result<()> {
    let mut edge = 0.0;
    for interval in tier.spoken() {
        let rises = interval.start >= edge - 1e-6 && interval.end >= interval.start && interval.end.is_finite();
        if !rises {
            return Err(Fault::of(
                ProjectFault::Edit,
                format!(
                    "`{}` cannot be said from {:.3} to {:.3} s, where the one before ends at {edge:.3} s",
                    interval.label, interval.start, interval.end
                ),
            )
            .help("syllables follow each other"));
        }
        edge = interval.end;
    }
    Ok(())
}

/// Moves what lies in or ends with syllables along with them: an edge at a syllable's edge stays there, one inside
/// keeps its share of the syllable. Turning the edit round brings it back. What stands between syllables gives way to
/// them for good.
fn follow(tier: &mut Tier, before: &[(f64, f64)], after: &[(f64, f64)]) {
    const NEAR: f64 = 2e-6;
    let moved = |t: f64, is_start: bool| {
        // Where two syllables touch, a start belongs to the later one and an end to the earlier.
        let holds = |(from, to): &(f64, f64)| {
            if is_start { *from - NEAR <= t && t < *to - NEAR } else { *from + NEAR < t && t <= *to + NEAR }
        };
        // Syllables rise, so the one that may hold a time is the last that starts before it, or the one before that.
        let after_it = before.partition_point(|(from, _)| *from <= t + NEAR);
        let place = (after_it.saturating_sub(2)..after_it).find(|p| holds(&before[*p]))?;
        let ((a, b), (c, d)) = (before[place], after[place]);
        Some(c + ((t - a) / (b - a)).clamp(0.0, 1.0) * (d - c))
    };
    for interval in &mut tier.intervals {
        interval.start = moved(interval.start, true).unwrap_or(interval.start);
        interval.end = moved(interval.end, false).unwrap_or(interval.end).max(interval.start);
    }
    // What stands between syllables, such as something that is not in the script, gives way.
    for i in 1..tier.intervals.len() {
        let until = tier.intervals[i - 1].end;
        let interval = &mut tier.intervals[i];
        if interval.start < until {
            interval.start = until;
            interval.end = interval.end.max(until);
        }
    }
}

/// Sets times that stay in order: no syllable ends before it starts or overlaps its neighbour.
pub(super) fn set_times(clip: &mut Clip, first: usize, before: &[(f64, f64)], after: &[(f64, f64)]) -> Result<()> {
    let duration = clip.duration();
    let Some(tier) = clip.timing.tier_mut("syllables") else { return Err(stale()) };
    let end = first + before.len();
    let now = tier.intervals.get(first..end).filter(|_| before.len() == after.len()).ok_or_else(stale)?;
    // A file keeps microseconds, memory more.
    let near = |a: f64, b: f64| (a - b).abs() < 2e-6;
    if now.iter().zip(before).any(|(i, b)| !near(i.start, b.0) || !near(i.end, b.1)) {
        return Err(stale());
    }
    let left = first.checked_sub(1).and_then(|i| tier.intervals.get(i)).map_or(0.0, |i| i.end);
    let right = tier.intervals.get(end).map_or(duration, |i| i.start);
    let mut edge = left;
    for (start, end) in after {
        if !(start.is_finite() && end.is_finite() && *start >= edge - 1e-9 && end > start && *end <= right + 1e-9) {
            return Err(Fault::of(ProjectFault::Edit, format!("a syllable cannot last from {start:.3} to {end:.3} s"))
                .help(format!("there is room from {left:.3} to {right:.3} s")));
        }
        edge = *end;
    }
    for (interval, (start, end)) in tier.intervals[first..end].iter_mut().zip(after) {
        (interval.start, interval.end) = (*start, *end);
    }
    for tier in clip.timing.tiers.iter_mut().filter(|t| matches!(t.name.as_str(), "words" | "phones" | CONFIDENCE)) {
        follow(tier, before, after);
    }
    Ok(())
}
