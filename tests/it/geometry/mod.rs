//! Shapes.

mod strokes;
