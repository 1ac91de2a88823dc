//! The files of a project: manifest, clips, faces and figures as they are read.

mod clip;
mod clip_video;
mod face;
mod figures;
mod import;
mod label;
mod manifest;
mod names;
mod recordings;
mod settled;
mod shots;
mod tiers;
mod times;

pub use clip::{Clip, read_script};
pub use face::LessonFace;
pub(super) use figures::{cartoon, figure, layer};
pub(super) use import::{Brought, copy_video, frame_of, write_face};
pub(super) use label::label_fits;
pub(crate) use manifest::check_output;
pub use manifest::{ClipEntry, FaceEntry, LayerEntry, MANIFEST, Manifest, Output};
pub(super) use names::{RATIOS, SCORE, SCRIPT, TIMES, TRACKS, is_gone};
pub(super) use recordings::{FRAMES_FPS, SOUNDS};
pub(super) use settled::{LOCK, OWN_FOLDER, end_and_sweep, read_settled};
pub use shots::FaceShot;
pub(super) use tiers::{CONFIDENCE, NOT_HEARD, NOT_IN_SCRIPT, OWN_TIERS, words};
