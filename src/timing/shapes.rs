//! Mouth shapes of other programs and ours: the tier `shapes` holds ours, files hold theirs.
//!
//! | ours | Rhubarb | Preston Blair | what it is there |
//! | --- | --- | --- | --- |
//! | m | A | MBP | lips closed |
//! | i | B | etc | slightly open, teeth together: most consonants, and ee |
//! | e | C | E | open |
//! | a | D | AI | wide open |
//! | o | E | O | a little rounded |
//! | u | F | U, WQ | puckered |
//! | f | G | FV | teeth on the lower lip |
//! | n | H | L | the tongue raised behind the teeth |
//! | (silence) | X | rest | at rest |
//!
//! Theirs have no *h*, our slightly open mouth: it is written as B, and comes back as *i*. All others come back.
//!
//! Rhubarb's are described in its README, Preston Blair's as Papagayo, Moho and OpenToonz name them.

use super::layer::Layer;
use super::{Interval, Tier, Timing};
use crate::disk::{Fault, FileFault, Result};
use crate::pose::MouthShape;

/// The tier.
pub(super) const TIER: &str = "shapes";

/// What a shape is called elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Naming {
    Rhubarb,
    PrestonBlair,
}

const NAMES: [(Option<MouthShape>, &str, &str); 10] = [
    (Some(MouthShape::M), "A", "MBP"),
    (Some(MouthShape::I), "B", "etc"),
    (Some(MouthShape::E), "C", "E"),
    (Some(MouthShape::A), "D", "AI"),
    (Some(MouthShape::O), "E", "O"),
    (Some(MouthShape::U), "F", "U"),
    (Some(MouthShape::U), "F", "WQ"),
    (Some(MouthShape::F), "G", "FV"),
    (Some(MouthShape::N), "H", "L"),
    (None, "X", "rest"),
];

impl Naming {
    /// Our shape of that name; nothing inside is silence.
    pub(crate) fn ours(self, name: &str) -> Option<Option<MouthShape>> {
        let row = NAMES.iter().find(|(_, rhubarb, blair)| match self {
            Self::Rhubarb => *rhubarb == name,
            Self::PrestonBlair => blair.eq_ignore_ascii_case(name),
        });
        row.map(|(shape, ..)| *shape)
    }

    /// The name of our shape, or of silence.
    pub(crate) fn theirs(self, shape: Option<MouthShape>) -> &'static str {
        let shape = if shape == Some(MouthShape::H) { Some(MouthShape::I) } else { shape };
        let row = NAMES.iter().find(|(ours, ..)| *ours == shape);
        row.map_or("X", |(_, rhubarb, blair)| if self == Self::Rhubarb { *rhubarb } else { *blair })
    }

    /// Why a name is none.
    pub(crate) fn unknown(self, name: &str) -> Fault {
        let names = match self {
            Self::Rhubarb => "A B C D E F G H X",
            Self::PrestonBlair => "AI E O U etc L WQ MBP FV rest, or A to H and X",
        };
        Fault::of(FileFault::Empty, format!("`{name}` is no mouth shape")).help(format!("the shapes are {names}"))
    }
}

/// Lays cues with our names: each from its start to its end.
pub(super) struct Cues(Layer);

impl Cues {
    pub(crate) fn new() -> Self {
        Self(Layer::new(TIER))
    }

    /// # Errors
    /// Without a line: a shape that is none, times that cannot be.
    pub(crate) fn lay(&mut self, start: f64, end: f64, name: &str, naming: Naming) -> Result<()> {
        let shape = naming.ours(name).ok_or_else(|| naming.unknown(name))?;
        self.0.lay(start, end, &shape.map(|s| s.to_string()).unwrap_or_default())
    }

    /// # Errors
    /// Where nothing was laid.
    pub(crate) fn done(self, duration: f64) -> Result<Timing> {
        let (tier, until) = self.0.done();
        if until == 0.0 && tier.intervals.is_empty() && duration == 0.0 {
            return Err(
                Fault::of(FileFault::Empty, "there is no mouth shape in the file").help("was it written to the end?")
            );
        }
        let mut timing = Timing::default();
        timing.add_read(tier, until.max(duration))?;
        Ok(timing)
    }
}

/// The shapes of a tier with silence between them, from 0 to the end: start, end, name. Labels that are no shapes are
/// silence; [`check`] finds them before.
pub(super) fn tiled(tier: &Tier, end: f64, naming: Naming) -> Vec<(f64, f64, &'static str)> {
    let mut cues: Vec<(f64, f64, &'static str)> = Vec::new();
    let mut lay = |start: f64, stop: f64, name: &'static str| {
        if (stop * 1e6).round() > (start * 1e6).round() {
            cues.push((start, stop, name));
        }
    };
    let mut until = 0.0;
    for i in &tier.intervals {
        lay(until, i.start, naming.theirs(None));
        lay(i.start, i.end, naming.theirs(mouth_shape(&i.label)));
        until = i.end;
    }
    lay(until, end, naming.theirs(None));
    cues
}

/// The mouth shape that a label of the tier `shapes` names; h' is drawn as h (thesis table 5.3).
#[must_use]
pub fn mouth_shape(label: &str) -> Option<MouthShape> {
    let label = label.trim();
    label.strip_suffix(['\'', '’']).unwrap_or(label).parse().ok()
}

/// Makes sure that every label of a tier is a shape.
///
/// # Errors
/// With the first that is none.
pub fn check_shapes(tier: &Tier) -> Result<()> {
    let wrong = |i: &&Interval| mouth_shape(&i.label).is_none();
    match tier.spoken().find(wrong) {
        None => Ok(()),
        Some(i) => {
            let place = format!("`{}` at {:.3} s in the tier `{}` is no mouth shape", i.label, i.start, tier.name);
            Err(Fault::new(place.replace('\n', " ")).help("shapes: m f h a i u e o n, and h' for h"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_but_h_comes_back_from_either_naming() {
        for naming in [Naming::Rhubarb, Naming::PrestonBlair] {
            for shape in MouthShape::ALL.into_iter().filter(|s| *s != MouthShape::H).map(Some).chain([None]) {
                assert_eq!(naming.ours(naming.theirs(shape)), Some(shape));
            }
        }
        assert_eq!(Naming::Rhubarb.theirs(Some(MouthShape::H)), "B");
        assert_eq!(Naming::PrestonBlair.ours("WQ"), Some(Some(MouthShape::U)));
        assert_eq!((Naming::Rhubarb.ours("Q"), Naming::Rhubarb.ours("mbp")), (None, None));
    }
}
