//! Moving the boundary of a syllable. A boundary that two syllables share moves both; one that meets a neighbour stops
//! there; no syllable gets shorter than can be seen.

use crate::project::{Change, Clip, ClipEdit, Edit};

/// The shortest a syllable can be made, in seconds: half a frame of the usual film, below any real syllable.
const SHORTEST: f64 = 0.02;

/// Boundaries this near to each other are one.
const TOUCHING: f64 = 1e-6;

/// Which end of a syllable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Start,
    End,
}

/// The change that moves a boundary of a syllable by so many seconds, as far as there is room, and vouches for every
/// syllable that it touches. `alone` leaves a neighbour that touches where it is: a gap opens between the two.
///
/// # Errors
/// Why it cannot be moved, in one line.
pub(super) fn moved(
    clip: &Clip,
    number: usize,
    syllable: usize,
    (side, alone): (Side, bool),
    by: f64,
) -> Result<Change, String> {
    let times: Vec<(f64, f64)> = clip.intervals().iter().map(|i| (i.start, i.end)).collect();
    let Some(&own) = times.get(syllable) else { return Err("no syllable is selected".into()) };
    let neighbour = match side {
        Side::Start => syllable.checked_sub(1),
        Side::End => Some(syllable + 1).filter(|n| *n < times.len()),
    };
    let other = neighbour.and_then(|n| times.get(n).copied());
    let old = if side == Side::Start { own.0 } else { own.1 };
    let (low, high, shared) = match (side, other) {
        (Side::Start, Some(o)) if !alone && own.0 - o.1 < TOUCHING => (o.0 + SHORTEST, own.1 - SHORTEST, true),
        (Side::Start, o) => (o.map_or(0.0, |o| o.1), own.1 - SHORTEST, false),
        (Side::End, Some(o)) if !alone && o.0 - own.1 < TOUCHING => (own.0 + SHORTEST, o.1 - SHORTEST, true),
        (Side::End, o) => (own.0 + SHORTEST, o.map_or(clip.duration(), |o| o.0), false),
    };
    // A tenth of a millisecond is finer than any ear, and keeps steps from gathering rounding.
    let wanted = ((old + by) * 1e4).round() / 1e4;
    // Where the syllable is too short already, it may still be made longer.
    let new = if by < 0.0 { wanted.max(low.min(old)) } else { wanted.min(high.max(old)) };
    if (new - old).abs() < TOUCHING {
        let name = |n: usize| clip.syllables.get(n).map_or_else(String::new, |s| s.text.clone());
        return Err(match (shared, neighbour) {
            (true, Some(n)) => {
                format!("there is no room left in `{}`", name(if by < 0.0 { n.min(syllable) } else { n.max(syllable) }))
            }
            _ => format!("there is no room left for `{}`", name(syllable)),
        });
    }
    let mut after = own;
    let end_of = |times: &mut (f64, f64), side| if side == Side::Start { times.0 = new } else { times.1 = new };
    end_of(&mut after, side);
    let (first, before, after) = match (shared, side, other) {
        (true, Side::Start, Some(o)) => (syllable - 1, vec![o, own], vec![(o.0, new), after]),
        (true, Side::End, Some(o)) => (syllable, vec![own, o], vec![after, (new, o.1)]),
        _ => (syllable, vec![own], vec![after]),
    };
    let touched = first..first + before.len();
    let mut edits = vec![Edit::Clip(number, ClipEdit::Times { first, before, after })];
    let unpinned = touched.filter(|index| !clip.score.pins.contains(index));
    edits.extend(unpinned.map(|index| Edit::Clip(number, ClipEdit::Pin { index, pinned: true })));
    let text = clip.syllables.get(syllable).map_or("", |s| s.text.as_str());
    let verb = if side == Side::Start { "starts" } else { "ends" };
    Ok(Change { label: format!("{text} {verb} at {new:.3} s"), edits })
}
