//! The frames of a video as a stream, whatever it lies in: a folder of pictures, a video that ffmpeg decodes, or
//! YUV4MPEG2. Memory does not grow with their number.

mod ahead;
mod ffmpeg;
mod folder;
mod print;
mod source;
mod y4m;

pub use ahead::Frames;
pub use ffmpeg::{Ffmpeg, sound_of};
pub use source::Source;
pub use y4m::{Scan, Y4m};

use std::path::PathBuf;

use crate::disk::Result;
use crate::photo::Grey;
use crate::photo::Photo;

/// A frame of a video.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Its number, from 0.
    pub number: u32,
    /// When it is shown, in seconds.
    pub time: f64,
    /// Its luma, full range.
    pub grey: Grey,
    pub(super) colour: Coded,
}

/// Where a frame's colours are, until somebody asks for them.
#[derive(Debug, Clone)]
pub(super) enum Coded {
    /// A picture's file as it is on disk.
    Picture(PathBuf, Vec<u8>),
    /// Planes of YUV4MPEG2.
    Planes(y4m::Head, Vec<u8>),
}

impl Frame {
    /// The frame in colour.
    ///
    /// # Errors
    /// When its picture is damaged.
    pub fn photo(&self) -> Result<Photo> {
        match &self.colour {
            Coded::Picture(path, bytes) => Photo::decode(bytes).map_err(|fault| fault.at(path)),
            Coded::Planes(head, planes) => Ok(head.photo(planes)),
        }
    }
}

/// The most frames a second: high-speed cameras have fewer that anybody could talk in.
pub(super) const MOST_FPS: f64 = 1000.0;
