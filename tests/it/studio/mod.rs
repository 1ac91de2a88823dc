//! The studio without a terminal.

mod edits;
mod screens;
mod speech;
mod tracking;
