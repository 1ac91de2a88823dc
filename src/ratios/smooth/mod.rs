//! Noise out of what was tracked, movement kept.
//!
//! A value becomes that of a curve fitted to the values around it, as far as they are alike: what differs by more than
//! noise, such as a blink of three frames or lips closed for two, is another movement and takes no part. How large the
//! noise is, the values say themselves. [`smooth_record`] and [`smooth_tracks`] look both ways and serve files;
//! [`Steady`] looks back only and serves frames as they come. [`smooth_keeping_peaks`] is the plain curve.

mod live;
mod local;
mod noise;
mod rows;

pub use live::Steady;
pub use local::smooth_keeping_peaks;
pub use rows::{smooth_record, smooth_tracks};

use super::TrackRow;

/// How far it looks each way, in seconds: five frames of 25 see a slow movement's bend, and a breath is far longer.
pub const SMOOTH_WIDTH: f64 = 0.4;

/// A difference of so many deviations of the noise may be noise alone, and counts fully …
const ALIKE: f64 = 3.0;
/// … and one of so many is another movement.
const OTHER: f64 = 7.0;

/// How far rows are alike, 1 to 0, by the value that differs most. Without noise only what is equal is alike.
fn likeness<const N: usize>(a: &[f64; N], b: &[f64; N], noise: &[f64; N]) -> f64 {
    let far = (0..N).map(|c| (a[c] - b[c]).abs() / noise[c].max(1e-9)).fold(0.0, f64::max);
    let t = ((OTHER - far) / (OTHER - ALIKE)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The values of a track that move together.
type Parts = ([f64; 2], [f64; 2], [f64; 4], [f64; 3]);

fn parts(row: &TrackRow) -> Parts {
    let (g, l, m, h) = (row.gaze, row.lids, row.mouth, row.head);
    ([g.x, g.y], [l.left, l.right], [m.up, m.down, m.left, m.right], [h.x, h.y, h.roll])
}

/// A track with other values. Lids stay what lids can be.
fn with_parts(row: &TrackRow, (g, l, m, h): Parts) -> TrackRow {
    let mut row = *row;
    (row.gaze.x, row.gaze.y) = (g[0], g[1]);
    (row.lids.left, row.lids.right) = (l[0].clamp(0.0, 2.0), l[1].clamp(0.0, 2.0));
    (row.mouth.up, row.mouth.down, row.mouth.left, row.mouth.right) = (m[0], m[1], m[2], m[3]);
    (row.head.x, row.head.y, row.head.roll) = (h[0], h[1], h[2]);
    row
}
