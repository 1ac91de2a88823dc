//! What a script becomes: syllables of Mandarin and words of English, each with its mouth shapes and its place in the
//! text.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::label;
use super::phone::{self, Phone};
use super::reading::Reading;
use super::sound::{FinalClass, InitialClass, Sound};
use super::system::System;
use super::token::Pause;
use crate::pose::MouthShape;

/// The language of an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Lang {
    /// Mandarin.
    #[default]
    Zh,
    /// English.
    En,
}

/// One syllable of Mandarin, or one word of English.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Syllable {
    /// What stands in the script: a character, a syllable as written, a word; for numbers the character they are read as.
    pub text: String,
    /// Hanyu Pinyin with a tone digit where the tone is known; empty for English.
    pub pinyin: String,
    /// Zhuyin, marks where they are usual; empty for English.
    pub zhuyin: String,
    /// The mouth shapes it passes through (thesis 5.2).
    pub shapes: Vec<MouthShape>,
    /// Its language.
    pub lang: Lang,
    /// The phones of an English word; empty for Mandarin.
    #[serde(default)]
    pub phones: Vec<Phone>,
    /// Its bytes in the script. The syllables of a number share those of the number.
    #[serde(default)]
    pub span: Range<usize>,
    /// What follows it.
    #[serde(default)]
    pub pause_after: Pause,
}

impl Syllable {
    /// A syllable of Mandarin.
    pub(super) fn mandarin(text: impl Into<String>, reading: &Reading, span: Range<usize>) -> Self {
        Self {
            text: text.into(),
            pinyin: reading.pinyin(),
            zhuyin: reading.zhuyin(),
            shapes: reading.shapes().to_vec(),
            lang: Lang::Zh,
            phones: Vec::new(),
            span,
            pause_after: Pause::None,
        }
    }

    /// A character in no table of readings: the mouth opens a little, and the empty Pinyin shows that its reading is
    /// missing. One rare character does not keep a script from being spoken.
    pub(super) fn unknown(text: impl Into<String>, span: Range<usize>) -> Self {
        Self {
            text: text.into(),
            pinyin: String::new(),
            zhuyin: String::new(),
            shapes: vec![MouthShape::H],
            lang: Lang::Zh,
            phones: Vec::new(),
            span,
            pause_after: Pause::None,
        }
    }

    /// A word of English.
    pub(super) fn english(text: impl Into<String>, phones: Vec<Phone>, span: Range<usize>) -> Self {
        Self {
            text: text.into(),
            pinyin: String::new(),
            zhuyin: String::new(),
            shapes: phone::shapes_of(&phones),
            lang: Lang::En,
            phones,
            span,
            pause_after: Pause::None,
        }
    }

    /// The same place of the script, read otherwise: what a label of a TextGrid says wins over the dictionary.
    #[must_use]
    pub fn with_reading(&self, reading: &Reading) -> Self {
        let read = Self::mandarin(self.text.clone(), reading, self.span.clone());
        Self { pause_after: self.pause_after, ..read }
    }

    /// Its reading; nothing for English.
    #[must_use]
    pub fn reading(&self) -> Option<Reading> {
        (self.lang == Lang::Zh).then(|| label::reading(&self.pinyin, System::Hanyu))?
    }

    /// Its syllable without the tone; nothing for English.
    #[must_use]
    pub fn sound(&self) -> Option<Sound> {
        self.reading().map(|r| r.sound())
    }

    /// How it begins, for its timing; nothing for English.
    #[must_use]
    pub fn initial_class(&self) -> Option<InitialClass> {
        self.sound().map(Sound::initial_class)
    }

    /// What follows its initial, for its timing; nothing for English.
    #[must_use]
    pub fn final_class(&self) -> Option<FinalClass> {
        self.sound().map(Sound::final_class)
    }
}
