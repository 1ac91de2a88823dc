//! A line to type and what it is for; a place to choose from a list.

use std::borrow::Cow;

use super::line::Line;
use crate::timeline::{Key, Range, Track};

/// A line to type: for what, and what has been typed.
#[derive(Debug, Clone)]
pub struct Prompt {
    /// What the line is for.
    pub purpose: Purpose,
    /// The question.
    pub title: String,
    /// What may be typed.
    pub help: Cow<'static, str>,
    /// What has been typed.
    pub line: Line,
    /// What was wrong with it, after it was accepted once.
    pub fault: Option<String>,
}

/// What a line is typed for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Purpose {
    /// How a syllable is read.
    Reading {
        /// Its number.
        syllable: usize,
    },
    /// The value of a key.
    Key {
        /// The track it lies on.
        track: Track,
        /// When it is.
        time: f64,
        /// The author's key that it takes the place of.
        old: Option<Key>,
        /// The time of the key of speech that it takes the place of.
        replaces: Option<f64>,
    },
    /// Words for marked places, from the one at the cursor on.
    Words,
    /// An edit of a stretch of the record.
    Range {
        /// Seconds.
        from: f64,
        /// Seconds.
        to: f64,
        /// The edit that it takes the place of, and its place among the edits.
        old: Option<(usize, Range)>,
    },
    /// The formats of an export.
    Export,
    /// The name of a feature point.
    Point,
}

/// A place to look at, as a list shows it.
#[derive(Debug, Clone, PartialEq)]
pub struct Spotted {
    /// Where, in seconds; none where it concerns the whole clip.
    pub at: Option<f64>,
    /// The syllable.
    pub syllable: Option<usize>,
    /// What there is.
    pub text: String,
}
