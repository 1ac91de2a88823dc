//! Faces followed through videos: from frames to the seven ratios, eyes, mouth and head of each, by active appearance
//! model (paper sec. 3) or by regions (thesis ch. 6).
//!
//! Frames come from `media`; the ratios of a shape are the business of `calibration`.

mod by_aam;
mod fault;
mod follow;
mod gather;
mod gaze;
mod live;
mod measure;
mod regions;
mod relay;
mod said;

pub use by_aam::by_aam;
pub use fault::TrackFault;
pub use follow::Follower;
pub use live::Live;
pub use regions::by_regions;
pub use relay::relay;

use crate::calibration::Choice;
use crate::disk::{Fault, Message};
use crate::ratios::{Record, Tracks};

/// What was found in a video.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tracked {
    /// The seven ratios of every frame; a lost frame has confidence 0 and values bridged from its neighbours.
    pub record: Record,
    /// Eyes, mouth and head of every frame.
    pub tracks: Tracks,
    /// What there is to say of it: frames lost, weak calibration.
    pub notes: Vec<Message>,
}

/// How ratios are read from shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Which of the solutions of eq. 6.
    pub choice: Choice,
    /// Whether ratios are told apart from speech, blinks, glances and turns of the head.
    pub apart: bool,
}

impl Options {
    /// Eq. 6 as the paper has it: whole shapes, negative ratios kept.
    pub const PAPER: Self = Self { choice: Choice::Paper, apart: false };
}

impl Default for Options {
    /// What comes nearest to known ratios: mixes without negative ratios, told apart from other movements.
    fn default() -> Self {
        Self { choice: Choice::NonNegative, apart: true }
    }
}

/// Is told how many frames are done, of how many where that is known, and says whether to go on.
pub(crate) type GoOn<'a> = &'a mut dyn FnMut(usize, Option<usize>) -> bool;

/// The fault of what was stopped.
fn stopped() -> Fault {
    Fault::of(TrackFault::Stopped, "the tracking was stopped").help("nothing was changed; start it again when you like")
}
