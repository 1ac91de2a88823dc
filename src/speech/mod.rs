//! Hearing: the silences, pitch, spectrum and quality of a recording, and the times at which the syllables of its script
//! are spoken.
//!
//! A recording comes from `media`, what was said from `script`; how times are written down is the business of `timing`.

mod align;
mod alignment;
mod fault;
mod fourier;
mod levels;
mod nuclei;
mod pitch;
mod quality;
mod sonority;
mod sounding;
mod spectrogram;

pub use align::align;
#[cfg(feature = "tools")]
pub use align::training;
pub(crate) use alignment::SURE;
pub use alignment::{Alignment, Note, Pin, SpokenPhone, SpokenSyllable, Take};
pub use fault::SpeechFault;
pub use nuclei::{Heard, nuclei};
pub use pitch::{Pitch, pitch};
pub use quality::Quality;
pub use spectrogram::Spectrogram;
