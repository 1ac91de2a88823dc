//! The cartoon: a personal face drawn from its 72 points, measured colours and hair (thesis ch. 4), in a style.

mod brow;
mod eye;
mod mouth;
mod palette;
mod wrinkles;

pub use palette::{Chosen, Palette};
