//! Projects on disk.

mod lessons;
mod times;
mod video;
