//! Lianpu makes a face talk.
//!
//! A **script** becomes syllables and mouth shapes, a **recording** gives them times, ratios of seven emotions come
//! from a record or from an author; all of it lies on a [`timeline`], the score. A [`pose`] is the score read at one
//! instant, a figure turns a pose into a drawing, and a drawing is rendered and exported. The studio and the command
//! line are two thin faces on the same rooms. A room uses only the rooms before it in this list.
//!
//! From a project to a frame as SVG and as PNG:
//!
//! ```
//! # fn main() -> lianpu::disk::Result<()> {
//! use lianpu::{project::Lesson, render};
//!
//! let lesson = Lesson::read("projects/nihao".as_ref())?;
//! let drawing = lesson.drawing(0, 0.9)?;
//! let svg = render::to_svg(&drawing, 640, 360);
//! let png = render::to_png(&drawing, 640, 360)?;
//! # assert!(svg.starts_with("<svg") && png.starts_with(b"\x89PNG"));
//! # Ok(())
//! # }
//! ```
//!
//! Features: `cli` (the command line) and `studio` (the studio and the player in a terminal), both on unless
//! `default-features = false` asks for the rooms alone.

pub mod geometry;
pub mod pose;
pub mod drawing;
pub mod disk;
pub mod photo;
pub mod media;
pub mod face;
pub mod aam;
pub mod calibration;
pub mod ratios;
pub mod script;
pub mod timing;
pub mod speech;
pub mod track;
pub mod timeline;
pub mod figure;
pub mod plot;
pub mod render;
pub mod project;
pub mod forms;
pub mod export;
#[cfg(feature = "studio")]
pub mod studio;
#[cfg(feature = "cli")]
pub mod cli;
