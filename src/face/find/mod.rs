//! The face in a photo and its 47 fixed points: a detector proposes windows, a cascade lays a shape on each, judges
//! say whether what lies under it is a face.
//!
//! It owns what was learned of faces. It reads no files, and of colour it knows only luma. `tests/learn/faces.rs` is
//! where its numbers come from.

pub mod cascade;
pub mod channels;
pub mod detector;
mod fit;
mod given;
pub mod looks;
mod model;
mod pyramid;
mod refusal;
mod search;
pub mod shape;
pub mod weights;

pub use fit::{Fit, Known};
pub use given::{Anchors, Found, find, find_from};
pub use model::Model;
pub use pyramid::Pyramid;
pub use refusal::{Doubt, Refusal};
pub use search::{Candidate, SMALLEST, WORKING_SIDE};
