//! The studio: lessons, clips and timelines on a terminal, edited by keys.
//!
//! The way of a key: `terminal` reads it, the key table (`keys`) turns it into an [`Action`], `execute` alone carries
//! that out on the [`State`], and `draw` shows the state and decides nothing. Work that takes time runs in threads
//! (`work`) and reports back. The studio owns no lesson data: every edit is a change of the lesson.

mod action;
mod aligning;
mod boundary;
mod calibrating;
mod draw;
mod edits;
mod editor;
mod execute;
mod export;
mod face_desk;
mod face_edits;
mod following;
mod job;
mod keys;
mod lane;
mod line;
mod listening;
mod look;
mod overlay;
mod photo_picture;
mod picture;
mod places;
mod player;
mod run;
mod state;
#[allow(clippy::module_inception, reason = "it is the studio itself")]
mod studio;
mod tap_desk;
mod tapping;
mod terminal;
mod typed;
mod voice;
mod window;
mod wording;
mod work;

pub use action::{Action, Nudge};
pub use aligning::{Aligner, Aligning, Spotted};
pub use editor::{Editor, LaneKey, Left};
pub use export::{ExportRequest, Exporter, Progress, export};
pub use face_desk::{FaceDesk, Placing};
pub use keys::{Place, key_table_markdown};
pub use lane::Lane;
pub use line::Line;
pub use listening::{Listened, SoundView, Tone};
pub use look::Colours;
pub use overlay::{Overlay, Prompt, Purpose};
pub use player::{Caption, Played, Player, Show, play, play_live};
pub use run::run;
pub use state::{Hear, Listed, Message, Open, State};
pub use studio::{Report, Studio};
pub use tapping::{Phase, Tap, Tapping};
pub use window::Window;
