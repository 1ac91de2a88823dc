//! What aligning a recording to its script takes and gives.

use std::fmt;

use crate::media::Sound;
use crate::script::Syllable;

/// Confidence from which on a syllable's times need no look.
pub(crate) const SURE: f64 = 0.75;

/// A recording with what is said in it, to be aligned.
#[derive(Debug, Clone, Copy)]
pub struct Take<'a> {
    /// The recording.
    pub sound: &'a Sound,
    /// What is said, in order.
    pub script: &'a [Syllable],
    /// Boundaries that somebody has set: they are kept as they are.
    pub pins: &'a [Pin],
}

/// A syllable whose times are known and are to be kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pin {
    /// Its number, from 0.
    pub syllable: usize,
    /// When it starts, in seconds.
    pub start: f64,
    /// When it ends, in seconds.
    pub end: f64,
}

/// A syllable, or English word, as it was found in a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct SpokenSyllable {
    /// Seconds from the start of the recording.
    pub start: f64,
    /// Seconds from the start of the recording.
    pub end: f64,
    /// How sure its times are, 0 to 1: the share of syllables so marked whose boundaries are right within 50 ms.
    pub confidence: f64,
    /// Whether it was heard at all: a word that the speaker left out has a short place where it belongs, and
    /// confidence 0.
    pub heard: bool,
    /// The phones inside it, one after the other without gaps, from its start to its end.
    pub phones: Vec<SpokenPhone>,
}

/// A phone in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpokenPhone {
    /// Its name, as [`crate::script::segments`] gives it.
    pub phone: &'static str,
    /// Seconds; a stop starts with its closure.
    pub start: f64,
    /// Seconds.
    pub end: f64,
}

/// When everything in a script is said.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// One for each syllable of the script.
    pub syllables: Vec<SpokenSyllable>,
    /// What the author should know, in order of time.
    pub notes: Vec<Note>,
}

/// Something about a recording and its script that an author should know.
#[derive(Debug, Clone, PartialEq)]
pub enum Note {
    /// The voice is so few dB above the noise that times are not to be trusted.
    Noisy {
        /// Signal to noise, in dB.
        snr: f64,
    },
    /// Sound and script part here: syllables of the script that are not heard.
    NotHeard {
        /// The first of them, from 0.
        first: usize,
        /// How many.
        count: usize,
        /// Where they belong, in seconds.
        at: f64,
    },
    /// Sound and script part here: something is said that is not in the script.
    NotInScript {
        /// It comes before this syllable, from 0; their number after the last.
        before: usize,
        /// Seconds.
        start: f64,
        /// Seconds.
        end: f64,
    },
    /// The script as a whole does not fit the sound.
    Doubtful,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Noisy { snr } => {
                write!(f, "the voice is only {snr:.0} dB above the noise: times may be off; record nearer, or in quiet")
            }
            Self::NotHeard { first, count: 1, at } => {
                write!(f, "syllable {} of the script is not heard, at {at:.2} s", first + 1)
            }
            Self::NotHeard { first, count, at } => {
                write!(f, "syllables {} to {} of the script are not heard, at {at:.2} s", first + 1, first + count)
            }
            Self::NotInScript { before, start, end } => write!(
                f,
                "something is said that is not in the script, from {start:.2} to {end:.2} s, before syllable {}",
                before + 1
            ),
            Self::Doubtful => write!(f, "the script does not seem to be what is said in the recording"),
        }
    }
}
