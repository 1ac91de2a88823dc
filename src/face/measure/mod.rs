//! What a face has besides its 47 fixed points, measured from the photo alone: colours, hair, jaw, beard, ears, neck,
//! glasses, and whether the photo is fit for it. But for the usual jaw (`shape`), nothing here is learned from other photos.
//!
//! The photo is warped once into the face frame ([`frame`]), its cells are told apart into background, skin, hair and
//! clothes ([`segment`]), and the measures read from both. It places no point that it is given.

mod backdrop;
mod colours;
mod features;
mod fitness;
mod frame;
mod glasses;
mod hair;
mod jaw;
mod kind;
mod mask;
mod mixture;
mod outline;
mod segment;
mod shape;

pub use fitness::Fitness;

use super::{Colours, Hair, How, Measures, Placed, Points};
use crate::geometry::Point;
use crate::photo::Photo;

/// All that is measured of a face besides its 47 points. Lengths are pixels of the photo unless said otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Its colours, as the photo shows them.
    pub colours: Colours,
    /// Its measures.
    pub measures: Measures,
    /// Its hair.
    pub hair: Hair,
    /// Whether the photo is fit for all this.
    pub fitness: Fitness,
}

/// Measures the face in `photo` whose 47 points lie at `points`; errors of some 3 % of the pupil distance inside the
/// face and 5 % at its contour and ears are borne.
#[must_use]
pub fn measure(photo: &Photo, points: &Points) -> Measured {
    let frame = frame::Frame::of(photo, points);
    let shape = shape::Shape::of(frame.units(points));
    let cheeks = colours::cheeks(&frame, &shape);
    let regions = segment::Regions::of(&frame, &shape);
    let found = hair::found(&regions, &shape, cheeks.skin);
    let glasses = glasses::likely(&frame, &shape);
    let measures = Measures {
        jaw: jaw::handles(&frame, &shape),
        brow_height: features::brow_height(&frame, &shape),
        neck: features::neck(&regions, &shape),
        beard: features::beard(&frame, &shape, &cheeks, &found.mask),
        ears: found.ears,
        head_top: frame.photo(Point::new(0.0, found.top)).y,
        glasses,
    };
    let outlines = |list: &[Vec<Point>]| -> Vec<Vec<Point>> {
        list.iter().map(|outline| outline.iter().map(|p| frame.photo(*p)).collect()).collect()
    };
    let front = outlines(&found.front);
    let hair_points = <[usize; super::FeaturePoint::HAIR]>::try_from(found.vertices.as_slice()).ok().map(|vertices| {
        vertices.map(|v| Placed { at: front[0][v], confidence: regions.confidence(found.front[0][v]), how: How::Found })
    });
    let hair = Hair {
        kind: found.kind,
        vertices: if hair_points.is_some() { found.vertices.clone() } else { Vec::new() },
        points: hair_points,
        back: outlines(&found.back),
        front,
    };
    Measured {
        colours: colours::colours(&frame, &shape, &cheeks, found.colour),
        measures,
        hair,
        fitness: Fitness::of(&regions, &shape, &cheeks, &found, glasses),
    }
}
