//! Recordings and what is found in them.

mod alignment;
mod pitch;
mod recordings;
