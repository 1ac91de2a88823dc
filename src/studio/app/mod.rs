//! The loop, the stack of screens and what they share.

pub(in crate::studio) mod action;
pub(in crate::studio) mod aligner;
pub(in crate::studio) mod colours;
pub(in crate::studio) mod export;
pub(in crate::studio) mod heard;
pub(in crate::studio) mod keys;
pub(in crate::studio) mod lane;
pub(in crate::studio) mod project;
pub(in crate::studio) mod run;
pub(in crate::studio) mod shell;
pub(in crate::studio) mod stack;
pub(in crate::studio) mod studio;
pub(in crate::studio) mod terminal;
pub(in crate::studio) mod voice;
pub(in crate::studio) mod wording;
