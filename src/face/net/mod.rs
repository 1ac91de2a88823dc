//! Nets that find faces and their landmarks: the BlazeFace detector and the attention mesh, run in plain Rust.
//!
//! It owns reading `.tflite` files, running them, and the crops that they take. Sums have a fixed order and sines and
//! exponentials one source, so that a photo gives the same bits on every processor. The weights are carried beside the
//! code: by the MediaPipe authors, from the Python package mediapipe 0.10.14, Apache License 2.0, unmodified; the data that
//! they were trained on are not public.

mod attention;
mod convolution;
mod crop;
mod detector;
mod error;
mod flatbuffer;
mod flexbuffer;
mod graph;
mod layer;
mod mesh;
mod points;
mod tensor;

pub use crop::{Levels, Square};
pub use detector::{Detection, detect, scores_by_turn};
pub use error::NetError;
pub use graph::{Net, Scratch};
pub use mesh::{LANDMARKS, Mesh, mesh};
