//! A script made speakable: text in characters, Pinyin, Zhuyin or English becomes syllables with their readings and the
//! mouth shapes each passes through (thesis 5.2), and the share of its time at which each shape starts (5.3).
//!
//! A script goes through three stages. `scan` cuts it into tokens, and each token carries its candidates (`token`): its
//! character, its Zhuyin (`zhuyin`), its syllables in the two romanisations (`romanised`, from `letters`), its English
//! parts, its number (`number`), its readings in braces (`label`). `detect` chooses the system of the script from the
//! candidates. `say` makes syllables of the chosen ones: characters by `words` and `han`, English by `english`. `sound`
//! is the table of syllables that all of Mandarin ends in.
//!
//! It knows nothing of sound files: when a syllable is spoken is for the timing and speech rooms. The licences of its data are in
//! `NOTICE.md` beside it.

mod detect;
mod english;
mod han;
mod label;
mod letters;
mod marks;
mod number;
mod onsets;
mod onsets_in_phones;
mod phone;
mod reading;
mod romanised;
mod say;
mod scan;
mod segment;
mod sound;
mod spelling;
mod syllable;
mod system;
mod token;
mod tone;
mod words;
mod written;
mod zhuyin;

pub use han::{is_han, readings_of};
pub use label::{reading, readings};
pub use marks::{in_latin, with_marks};
pub use onsets::{OnsetPreset, onsets};
pub use onsets_in_phones::onsets_in_phones;
pub use phone::{Phone, shapes_of};
pub use reading::Reading;
pub use say::syllables;
pub use segment::segments;
pub use sound::{FinalClass, InitialClass, Sound};
pub use syllable::{Lang, Syllable};
pub use system::System;
pub use token::Pause;
pub use written::{WrittenWord, without_braces, written_words};
