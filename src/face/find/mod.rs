//! The face in a photo and its 47 fixed points: a detector proposes windows, a cascade lays a shape on each, judges
//! say whether what lies under it is a face.
//!
//! It owns what was learned of faces. It reads no files, and of colour it knows only luma. `tests/learn/faces.rs` is
//! where its numbers come from.

mod by_net;
mod cascade;
mod channels;
mod detector;
mod finder;
mod fit;
mod given;
mod looks;
mod model;
mod pyramid;
mod refusal;
mod search;
mod shape;
mod weights;

/// What learning the shipped model needs beside [`find()`].
#[cfg(feature = "tools")]
pub mod training {
    pub use super::cascade::{Block, Chip, Moves, Stage};
    pub use super::channels::DESCRIPTOR;
    pub use super::detector::{BELOW, CELL, Detector, Hit, SCALE, SIDE, WINDOW, cells, window};
    pub use super::looks::Looks;
    pub use super::search::Candidate;
    pub use super::shape::ShapeModel;
    pub use super::weights::Matrix;
}

pub use finder::find;
pub use fit::{Fit, Known};
pub use given::{Anchors, Found, find_from};
pub use model::Model;
pub use pyramid::Pyramid;
pub use refusal::{Doubt, Refusal};
pub use search::{Candidate, SMALLEST, WORKING_SIDE};
