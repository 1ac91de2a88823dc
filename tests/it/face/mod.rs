//! From a photo to a face: found, measured, moved.

mod measures;
mod net;
mod points;
mod rig;
mod teacher;
