//! Sound in: a recording as one stream of samples, its outline for the screen, where it is not silent, and when what
//! its script says is spoken.
//!
//! What was said is the business of `script`, and how times are written down that of `timing`.

pub mod align;
mod alignment;
mod decimate;
mod decode;
mod fault;
mod fourier;
mod iso;
mod kind;
mod levels;
mod mix;
mod mp3;
mod nuclei;
mod peaks;
mod pitch;
mod quality;
mod read;
mod resample;
mod sonority;
mod sound;
mod sounding;
mod spectrogram;
mod wav;
mod wav_form;
mod wav_writer;

pub use align::align;
pub use alignment::{Alignment, Note, Pin, SURE, SpokenPhone, SpokenSyllable, Take};
pub use fault::SpeechFault;
pub use nuclei::{Heard, nuclei};
pub use pitch::{Pitch, pitch};
pub use quality::Quality;
pub use resample::Resampled;
pub use sound::Sound;
pub use spectrogram::Spectrogram;
pub use wav_writer::write_wav;
