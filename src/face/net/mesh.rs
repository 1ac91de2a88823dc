//! The face mesh: 478 landmarks with lips, eyes and irises looked at twice (attention mesh, 192 × 192 pixels).
//!
//! Its presence score is no sign of quality: it is 0.98 also where the landmarks are wrong.

use std::sync::OnceLock;

use super::crop::{Beyond, Levels, Square};
use super::graph::{Net, Scratch};
use crate::geometry::Point;

/// Side of the net's input, in pixels.
const SIDE: usize = 192;
/// Landmarks of the surface; ten of the irises follow.
const SURFACE: usize = 468;
/// Landmarks in all: the surface, then the iris at the image's left and the one at its right: centre, right, top, left,
/// bottom.
pub const LANDMARKS: usize = 478;
/// The outer corners of the eyes, at the image's left and right.
const OUTER_CORNERS: [usize; 2] = [33, 263];

/// The landmarks of a face.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// [`LANDMARKS`] points, in pixels of the photo.
    pub points: Vec<Point>,
    /// Their depths, in pixels of the photo, smaller towards the camera; 0 of the irises.
    pub depths: Vec<f64>,
    /// 0 to 1: that there is a face in the square.
    pub presence: f64,
}

impl Mesh {
    /// The square round the landmarks, in which to look again, or in the next frame: 1.5 times their extent, the eyes level.
    #[must_use]
    pub fn square(&self) -> Square {
        let across = self.points[OUTER_CORNERS[1]] - self.points[OUTER_CORNERS[0]];
        let turn = libm::atan2(across.y, across.x);
        let (sin, cos) = libm::sincos(turn);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in &self.points[..SURFACE] {
            for (axis, v) in [cos * point.x + sin * point.y, cos * point.y - sin * point.x].into_iter().enumerate() {
                low[axis] = low[axis].min(v);
                high[axis] = high[axis].max(v);
            }
        }
        let [x, y] = [0, 1].map(|axis| f64::midpoint(low[axis], high[axis]));
        let centre = Point::new(cos * x - sin * y, sin * x + cos * y);
        Square { centre, side: 1.5 * (high[0] - low[0]).max(high[1] - low[1]), turn }
    }
}

/// The net of the mesh, read once.
fn net() -> &'static Net {
    static NET: OnceLock<Net> = OnceLock::new();
    NET.get_or_init(|| {
        let file = include_bytes!("face_landmark_with_attention.tflite");
        Net::read(file).expect("a test reads the carried net")
    })
}

/// The landmarks of the face in a square of a photo.
#[must_use]
pub fn mesh(levels: &Levels<'_>, square: &Square, scratch: &mut Scratch) -> Mesh {
    let input = levels.crop(square, SIDE, [0.0, 1.0], Beyond::Nearest);
    let outputs = net().run(&input, scratch);
    let [surface, finer @ .., presence] = &outputs[..] else { unreachable!("the net has seven outputs") };
    let mut pixels: Vec<[f32; 3]> = surface.as_chunks().0.to_vec();
    // Lips, the two eyes and their brows, in the order of the regions; then the irises.
    for (region, pairs) in net().regions().zip(finer) {
        for (landmark, [x, y]) in region.iter().zip(pairs.as_chunks().0) {
            pixels[*landmark][..2].copy_from_slice(&[*x, *y]);
        }
    }
    for iris in &finer[3..] {
        pixels.extend(iris.as_chunks().0.iter().map(|[x, y]| [*x, *y, 0.0]));
    }
    let side = SIDE as f64;
    let points = pixels.iter().map(|[x, y, _]| square.point(f64::from(*x) / side - 0.5, f64::from(*y) / side - 0.5));
    let depths = pixels.iter().map(|[.., z]| f64::from(*z) * square.side / side);
    let presence = 1.0 / (1.0 + libm::exp(-f64::from(presence[0])));
    Mesh { points: points.collect(), depths: depths.collect(), presence }
}
