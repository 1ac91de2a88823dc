//! An average face in the face frame (pupil distance 100), for tests: nobody's.
//!
//! Means over 72 faces of the Face Research Lab London Set (DeBruine and Jones 2017, CC BY 4.0,
//! <https://doi.org/10.6084/m9.figshare.5047666>), rounded to whole units and made symmetric.

use lianpu::face::{FeaturePoint, Points};
use lianpu::geometry::Point;

/// Points of the left side and the middle; those of the right mirror them.
const AVERAGE: [(&str, f64, f64); 27] = [
    ("4.6", -93.0, -11.0),
    ("4.4a", -74.0, -28.0),
    ("4.4", -50.0, -29.0),
    ("4.2", -22.0, -18.0),
    ("3.12", -70.0, 3.0),
    ("3.8", -27.0, 6.0),
    ("3.2", -50.0, -6.0),
    ("3.4", -50.0, 10.0),
    ("3.6", -50.0, 0.0),
    ("9.6", -9.0, 0.0),
    ("9.14", -25.0, 46.0),
    ("9.2", -28.0, 60.0),
    ("9.4", -20.0, 70.0),
    ("9.15", 0.0, 71.0),
    ("8.4", -40.0, 110.0),
    ("8.9", -11.0, 94.0),
    ("8.1", 0.0, 97.0),
    ("2.2", 0.0, 107.0),
    ("2.3", 0.0, 108.0),
    ("8.2", 0.0, 124.0),
    ("2.1", 0.0, 183.0),
    ("2.14", -100.0, 110.0),
    ("11.2", -87.0, -91.0),
    ("11.1", 0.0, -119.0),
    ("10.2", -132.0, 1.0),
    ("10.4", -137.0, 22.0),
    ("10.6", -120.0, 77.0),
];

/// The 47 points.
pub fn points() -> Points {
    let mut points = Points([Point::ZERO; FeaturePoint::FIXED]);
    for (name, x, y) in AVERAGE {
        let point = FeaturePoint::named(name).unwrap();
        points[point] = Point::new(x, y);
        points[point.mirror()] = Point::new(if point.mirror() == point { x } else { -x }, y);
    }
    points
}
