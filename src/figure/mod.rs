//! Figures: what turns a pose into a drawing. So far the line figures, which blend seven drawings made of Bézier
//! strokes (paper sec. 2); two come with the program and an author can write more as files.
//!
//! A figure owns no time: it draws the pose it is given and remembers nothing.

mod author_layer;
pub mod cartoon;
pub mod line;

pub use author_layer::{AuthorLayer, LayerPlace, MAX_LAYER_BYTES};
pub use line::LineFigure;
