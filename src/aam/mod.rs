//! The active appearance model (Matthews and Baker 2004; paper eq. 5): the shape of a face as a mean and a few modes,
//! its look as a mean texture and a few modes, and a fit that finds both in a picture.
//!
//! It owns annotations of faces in other programs' formats, training, the model's file and the fit. It knows nothing
//! of emotions: what the shape parameters say is somebody else's reading.
//!
//! A shape is `N(W(x; p); q)`: the mean shape moved along its modes by `p`, then turned, scaled and shifted by the
//! similarity `q`. Modes are orthogonal to what a similarity does, so that `q` can be dropped and `p` holds the
//! expression alone. Every result is the same on every processor: loops have a fixed order and use no instructions
//! that some lack.

pub mod annotation;
mod align;
mod appearance;
mod detected;
mod file;
mod fit;
mod fitted;
mod ground;
mod learn;
mod level;
mod mesh;
mod mirror;
mod model;
mod painted;
mod shape;
mod shots;
mod simultaneous;
mod skirt;
mod steady;
mod sums;
mod table;
mod trust;

pub use align::{Aligned, align};
pub use annotation::Annotation;
pub use fit::{Fitter, Start};
pub use fitted::Fit;
pub use learn::{Kind, Options};
pub use mesh::triangles;
pub use model::Model;
pub use shape::Shapes;
pub use shots::Shot;
