//! Sound and video in: a recording as one stream of samples, a video as a stream of frames.
//!
//! It decodes, mixes, resamples and mends files that were cut off; it does not listen or look. What is heard in a sound
//! is `speech`'s, what is seen in a frame `face`'s and `track`'s.
//!
//! Limits: recordings up to 4 hours and 2 GB, no Opus and no WMA; frames up to 8192 pixels a side; a video file needs
//! the program ffmpeg.

mod fault;
mod sound;
mod video;

pub use fault::MediaFault;
pub use sound::Sound;
pub(crate) use sound::{decimated, write_wav};
pub use video::{Ffmpeg, Frame, Frames, Scan, Source, Y4m, sound_of};
