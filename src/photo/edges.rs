//! Edges where features are looked for (thesis sec. 3.4.2).

use super::threshold::moment_preserving;
use super::{Bounds, Eyeballs, Mask, Plane};
use crate::geometry::Point;

/// Edges of a face, thresholded part by part.
#[derive(Debug, Clone, PartialEq)]
pub struct Edges {
    /// S, the strength of edges by Sobel's operator (eq. 3.13).
    pub sobel: Plane,
    /// S with the right half of the square mapped onto the left one.
    pub mirrored: Plane,
    /// The 2d × 2d square.
    pub square: Bounds,
    /// Where the square is divided.
    pub divisions: Divisions,
    /// The threshold of each of the four parts, from the top; none where a part has no edges.
    pub thresholds: [Option<f32>; 4],
    /// B_edge, set at edges; nothing outside the square.
    pub binary: Mask,
}

/// The three lines that divide the square into brows, eyes, nose and mouth, as heights in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Divisions {
    /// Div_EE: brows above, eyes below.
    pub brow_eye: f64,
    /// Div_EN: eyes above, nose below.
    pub eye_nose: f64,
    /// Div_NM: nose above, mouth below.
    pub nose_mouth: f64,
}

impl Divisions {
    /// The lines of a pair of eyeballs (sec. 3.4.2, step 3).
    #[must_use]
    pub(crate) fn of(eyes: &Eyeballs) -> Self {
        Self {
            brow_eye: eyes.left.centre.y - eyes.left.height() / 2.0 - 1.0,
            eye_nose: eyes.middle().y + eyes.distance() / 3.0,
            nose_mouth: eyes.middle().y + eyes.distance(),
        }
    }

    /// The four parts of the square from the top; each keeps at least a row of the image.
    #[must_use]
    pub(crate) fn parts(&self, square: &Bounds) -> [Bounds; 4] {
        let row = |y: f64| (y.ceil().max(0.0) as usize).clamp(square.y0, square.y1);
        let lines = [square.y0, row(self.brow_eye), row(self.eye_nose), row(self.nose_mouth), square.y1];
        std::array::from_fn(|i| {
            let top = lines[i].min(square.y1 - 1);
            Bounds { y0: top, y1: lines[i + 1].max(top + 1), ..*square }
        })
    }
}

/// The strength of edges: the sum of both directions' absolute differences (thesis eq. 3.13, fig. 3.12), in the unit
/// of the plane. The outermost pixels' values go on beyond the border.
#[must_use]
pub(crate) fn sobel(plane: &Plane) -> Plane {
    let (width, height) = (plane.width(), plane.height());
    let mut values = Vec::with_capacity(width * height);
    for y in 0..height {
        let (above, here, below) = (plane.row(y.saturating_sub(1)), plane.row(y), plane.row((y + 1).min(height - 1)));
        values.extend((0..width).map(|x| {
            let (l, r) = (x.saturating_sub(1), (x + 1).min(width - 1));
            let down = (below[l] + 2.0 * below[x] + below[r]) - (above[l] + 2.0 * above[x] + above[r]);
            let across = (above[r] + 2.0 * here[r] + below[r]) - (above[l] + 2.0 * here[l] + below[l]);
            down.abs() + across.abs()
        }));
    }
    Plane::new(width, height, values)
}

impl Edges {
    /// The edges of an intensity image round a pair of eyeballs.
    #[must_use]
    pub(crate) fn of(intensity: &Plane, eyes: &Eyeballs) -> Self {
        let sobel = sobel(intensity);
        let square = eyes.square(intensity.width(), intensity.height());
        let divisions = Divisions::of(eyes);
        let mirrored = mirrored(&sobel, eyes, &square);
        let mut binary = Mask::filled(intensity.width(), intensity.height(), false);
        let thresholds = divisions.parts(&square).map(|part| {
            let places = (part.y0..part.y1).flat_map(|y| (part.x0..part.x1).map(move |x| (x, y)));
            let threshold = moment_preserving(places.clone().map(|at| mirrored[at]))?;
            places.for_each(|at| binary[at] = mirrored[at] > threshold);
            Some(threshold)
        });
        Self { sobel, mirrored, square, divisions, thresholds, binary }
    }
}

/// The plane with what lies right of the line between the eyeballs mapped onto the left, within the square. Faces are
/// symmetric; the points of the left half are found, those of the right follow (thesis sec. 4.3.1).
fn mirrored(plane: &Plane, eyes: &Eyeballs, square: &Bounds) -> Plane {
    let mut mapped = plane.clone();
    let across = eyes.right.centre - eyes.left.centre;
    for y in square.y0..square.y1 {
        for x in square.x0..square.x1 {
            let p = Point::new(x as f64, y as f64);
            if (p - eyes.middle()).dot(across) < 0.0 {
                let q = eyes.mirror(p);
                mapped[(x, y)] = plane.sample(q.x, q.y);
            }
        }
    }
    mapped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_has_four_times_its_height_and_a_flat_plane_no_edge() {
        let step = Plane::new(6, 3, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0].repeat(3));
        assert_eq!(sobel(&step).row(1), [0.0, 0.0, 4.0, 4.0, 0.0, 0.0]);
        assert!(sobel(&Plane::filled(5, 5, 0.7)).pixels().iter().all(|v| *v == 0.0));
    }

    #[test]
    fn the_left_half_becomes_the_mirror_image_of_the_right() {
        let ramp = Plane::new(41, 41, (0..41 * 41).map(|i| (i % 41) as f32).collect());
        let eyes = Eyeballs::at(Point::new(15.0, 20.0), Point::new(25.0, 20.0));
        let square = eyes.square(41, 41);
        let mapped = mirrored(&ramp, &eyes, &square);
        assert_eq!([mapped.at(12, 20), mapped.at(28, 20), mapped.at(2, 20)], [28.0, 28.0, 2.0]);
    }

    #[test]
    fn the_parts_fill_the_square_from_the_top_and_stay_in_the_image() {
        let eyes = Eyeballs::at(Point::new(40.0, 90.0), Point::new(60.0, 90.0));
        let square = eyes.square(100, 100);
        let parts = Divisions::of(&eyes).parts(&square);
        assert_eq!((parts[0].y0, parts[3].y1), (square.y0, 100));
        assert!(parts.iter().all(|p| p.y0 < p.y1 && p.y1 <= 100));
        assert!(parts[0].y1 == parts[1].y0 && parts[1].y1 == parts[2].y0);
    }
}
