//! The face in a photo and its 47 fixed points.

pub mod cascade;
pub mod channels;
pub mod detector;
mod fit;
pub mod looks;
mod frame;
mod model;
mod pyramid;
mod search;
pub mod shape;
pub mod weights;

pub use fit::{Fit, Known};
pub use frame::Frame;
pub use model::Model;
pub use pyramid::Pyramid;
pub use search::{Candidate, SMALLEST, WORKING_SIDE};
