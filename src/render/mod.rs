//! A drawing as SVG text or as pixels. It decides nothing about what is drawn.
//!
//! Both ways show the same picture; the pixels do not take the way over SVG text.

mod adler;
mod canvas;
mod clip;
mod cover;
mod edges;
mod escaped;
mod font;
mod huffman;
mod leaf;
mod paint;
mod piece;
mod pixels;
mod png;
mod print;
mod prints;
mod raster;
mod recent;
mod reel;
mod svg;
mod tiles;
mod tokens;

pub use clip::{ClipCoder, FrameCoder, Painted};
pub(crate) use escaped::Escaped;
pub use font::{FontFile, text_outline, text_width, uncovered, uncovered_in};
pub use pixels::Painter;
pub use png::{decode_key, encode_png, to_png};
pub use reel::Reel;
pub use svg::to_svg;

/// The largest picture side that is made: 16,384 pixels.
pub const MAX_SIDE: u32 = 16_384;

/// Raised whenever the same drawing comes to give other pixels, so that frames of before are written anew.
pub(crate) const REVISION: u32 = 4;

/// How far an outline may be from the true one, in units of the drawing: a tenth of a pixel at twice its size.
const TOLERANCE: f64 = 0.05;
