//! Timing files.

mod convert;
mod formats;
