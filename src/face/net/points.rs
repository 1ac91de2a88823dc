//! Feature points from a mesh: each lies at a landmark, moved by an offset in the face's own frame.
//!
//! The frame has its origin between the pupils, x along them and their distance as unit. `points.csv` holds landmark and
//! offset of each point, learned from the London set (`tests/learn/mesh.rs`).

use std::sync::OnceLock;

use super::mesh::Mesh;
use crate::face::FeaturePoint as P;
use crate::geometry::{Point, Similarity};

/// Landmarks of the pupils, at the image's left and right: the centres of the irises.
const PUPILS: [usize; 2] = [468, 473];

/// Landmarks before the ears, at the image's left and right.
const SIDES: [usize; 2] = [234, 454];

/// A row of the table.
#[derive(Debug, Clone, Copy)]
struct Row {
    point: P,
    landmark: usize,
    offset: Point,
}

fn table() -> &'static [Row] {
    static TABLE: OnceLock<Vec<Row>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let read = |line: &str| {
            let mut cells = line.split(',');
            let point = P::named(cells.next()?)?;
            let landmark = cells.nth(1)?.parse().ok()?;
            let offset = Point::new(cells.next()?.parse().ok()?, cells.next()?.parse().ok()?);
            Some(Row { point, landmark, offset })
        };
        include_str!("points.csv").lines().skip(1).filter_map(read).collect()
    })
}

impl Mesh {
    /// The face's own frame: from pupil distances to pixels of the photo.
    #[must_use]
    pub fn frame(&self) -> Similarity {
        Similarity::spanning(self.points[PUPILS[0]], self.points[PUPILS[1]])
    }

    /// Angle of the head from side to side, in degrees: above 0 the nose points to the image's right. From the depths of
    /// the two sides of the face, the head upright.
    #[must_use]
    pub fn yaw(&self) -> f64 {
        let across = self.points[SIDES[1]] - self.points[SIDES[0]];
        let deeper = self.depths[SIDES[1]] - self.depths[SIDES[0]];
        libm::atan2(deeper, across.hypot()).to_degrees()
    }

    /// The feature points that a mesh has, 43 of the 47 that every face has, in pixels of the photo.
    #[must_use]
    pub fn feature_points(&self) -> Vec<(P, Point)> {
        let frame = self.frame();
        let place = |row: &Row| {
            let at = frame.undo(self.points[row.landmark]);
            (row.point, frame.apply(at + row.offset.to_vec2()))
        };
        table().iter().map(place).collect()
    }
}
