//! The forms of export that hold a clip or a project whole.

mod movies;
mod whole;
