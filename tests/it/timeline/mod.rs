//! From times to mouths.

mod lips;
mod mouths;
