//! Ratios of emotions, and their records.

mod known;
mod mixes;
mod record;
