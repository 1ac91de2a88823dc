//! The forms of an export, each made in memory or as one stream: pages, books, animated drawings, moving pictures, sounds,
//! captions and the files of other programs.
//!
//! A clip, its figure and its timeline go in, bytes come out. It knows nothing of folders, of divided exports and of what
//! an earlier export has written: that is the business of `export`.

pub mod apng;
mod base64;
pub(crate) mod captions;
mod cels;
mod draft;
pub(crate) mod epub;
mod fault;
mod fewer;
mod flac;
pub mod gif;
pub(crate) mod html;
pub(crate) mod layers;
pub(crate) mod lottie;
pub(crate) mod mouths;
pub mod movie;
mod packed;
mod palette;
pub(crate) mod parts;
pub(crate) mod poses;
pub(crate) mod ratios;
mod rounded;
pub(crate) mod said;
pub(crate) mod shapes;
pub(crate) mod smil;
pub(crate) mod sound;
mod stream;
mod svg_marks;
mod zip;

pub use fault::FormFault;
pub(crate) use rounded::rounded;
pub use stream::{Frames, Outcome, Watch};

use std::path::{Path, PathBuf};

use crate::render::Escaped;

/// A file of a form, to be written.
pub(crate) struct File {
    /// Its path.
    pub(crate) path: PathBuf,
    /// Its content.
    pub(crate) bytes: Vec<u8>,
}

/// Text safe inside elements and quoted attributes of XML and HTML.
fn escaped(text: &str) -> String {
    Escaped(text).to_string()
}

/// `OUT/CLIP` with an ending; a clip's name may hold points of its own.
pub(crate) fn with_ending(base: &Path, ending: &str) -> PathBuf {
    let mut name = base.file_name().unwrap_or_default().to_owned();
    name.push(".");
    name.push(ending);
    base.with_file_name(name)
}
