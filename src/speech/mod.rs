//! Sound in: a recording as one stream of samples, its outline for the screen, and where it is not silent.
//!
//! It reads WAV. What was said is the business of `script`, and when it was said lands in `timing`.

mod levels;
mod peaks;
mod sound;
mod sounding;
mod wav;

pub use sound::Sound;
