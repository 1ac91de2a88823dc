//! Figures drawn, held against the paper, the thesis and kept pictures.

mod cartoon;
mod line;
mod pictures;
mod widths;
