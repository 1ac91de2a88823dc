//! A script made speakable: text in characters, Pinyin, Zhuyin or English becomes syllables with their readings and the
//! mouth shapes each passes through (thesis 5.2), and the share of its time at which each shape starts (5.3).
//!
//! The way of a script: `tokens` cuts it into pieces, `detect` tells what its Latin letters are, `say` reads every piece:
//! characters by `words` and `han`, Pinyin by `romanised`, Zhuyin by `zhuyin`, English by `english`, digits by `numbers`
//! and `numerals`. `sound` is the table of syllables that all of Mandarin ends in.
//!
//! It knows nothing of sound files: when a syllable is spoken is for the timing and speech rooms. The licences of its data are in
//! `NOTICE.md` beside it.

mod detect;
mod english;
mod han;
mod label;
mod marks;
mod numbers;
mod numerals;
mod onsets;
mod onsets_in_phones;
mod phone;
mod reading;
mod romanised;
mod say;
mod segment;
mod sound;
mod spelling;
mod syllable;
mod system;
mod tokens;
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
pub use tokens::Pause;
pub(crate) use written::{without_braces, written_words};
