//! What lies on top of a screen: help, a line to type, a question, a running export. The top one takes the keys.

use std::borrow::Cow;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::aligning::Spotted;
use super::export::Progress;
use super::line::Line;
use super::{Action, Place};
use crate::timeline::{Key, Range, Track};

/// One thing that lies on top.
#[derive(Debug)]
pub enum Overlay {
    /// Every key of a place, scrolled down by so many lines.
    Help {
        /// The place that it explains.
        of: Place,
        /// Lines scrolled.
        scrolled: usize,
    },
    /// What there is to look at in a clip.
    Doubts {
        /// The places.
        list: Vec<Spotted>,
        /// Which is chosen.
        chosen: usize,
    },
    /// Lines to read, scrolled down by so many.
    Notes {
        /// The title of the list.
        title: String,
        /// The lines, which are folded where the screen is too narrow.
        lines: Vec<String>,
        /// Lines scrolled.
        scrolled: usize,
    },
    /// A line to type.
    Prompt(Box<Prompt>),
    /// Leave with unsaved changes? What was asked for is done after the answer.
    Confirm(Action),
    /// An export under way.
    Export {
        /// How far it is.
        progress: Progress,
        /// Set to stop it.
        cancel: Arc<AtomicBool>,
    },
}

impl Overlay {
    /// The place in the key table.
    #[must_use]
    pub const fn place(&self) -> Place {
        match self {
            Self::Help { .. } | Self::Notes { .. } => Place::Help,
            Self::Doubts { .. } => Place::Doubts,
            Self::Prompt(_) => Place::Prompt,
            Self::Confirm(_) => Place::Confirm,
            Self::Export { .. } => Place::Export,
        }
    }
}

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
