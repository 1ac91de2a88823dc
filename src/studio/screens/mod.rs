//! The screens, each with its state, its actions and its drawing. A new one is a folder here, a place in the key table
//! with its rows, and whoever opens it.

pub(in crate::studio) mod confirm;
pub(in crate::studio) mod exporting;
pub(in crate::studio) mod face;
pub(in crate::studio) mod help;
pub(in crate::studio) mod notes;
pub(in crate::studio) mod project;
pub(in crate::studio) mod projects;
pub(in crate::studio) mod review;
pub(in crate::studio) mod tapping;
pub(in crate::studio) mod timeline;
pub(in crate::studio) mod typing;
