//! A face: 72 feature points and what else was measured of it, how they are found in a photo, its own units, and how
//! it deforms (thesis ch. 4).
//!
//! It owns no drawing: what a face looks like is a `figure`'s business.

mod create;
mod file;
pub mod find;
mod lips;
mod measure;
pub mod net;
mod point;
mod point_row;
pub mod rig;
pub mod thesis;
mod units;

use std::ops::{Index, IndexMut};

pub use create::{Created, Warning, create};
pub use find::{Anchors, Refusal};
pub use measure::{Fitness, Measured, measure};
pub use point::{FeaturePoint, Part};
pub use point_row::{MAX_COORDINATE, PointRow};
pub use units::{Units, to_face_frame};

use crate::drawing::Colour;
use crate::geometry::Point;

/// A person's neutral face, as `face.toml` holds it. Lengths are pixels of the photo unless said otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// The 47 points that every face has, in the model's order.
    pub points: [Placed; FeaturePoint::FIXED],
    /// Its colours, as the photo shows them.
    pub colours: Colours,
    /// What else was measured.
    pub measures: Measures,
    /// Its hair.
    pub hair: Hair,
    /// The photo that all this is of.
    pub photo: PhotoRecord,
}

/// Where a feature point is, and how that came to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Pixels of the photo.
    pub at: Point,
    /// 0 to 1: how far the place can be trusted. 1 where a hand has set it.
    pub confidence: f64,
    /// How it came to be.
    pub how: How,
}

/// How a feature point came to be where it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum How {
    /// Found in the photo.
    Found,
    /// Placed by a rule, from other points.
    Rule,
    /// Set by hand; a new run keeps it.
    Hand,
}

/// The places of the 47 points that every face has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Points(pub [Point; FeaturePoint::FIXED]);

/// Colours as the photo shows them: medians, not yet a cartoon's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colours {
    /// Of the cheeks.
    pub skin: Colour,
    /// Of the hair; of the brows where there is no hair.
    pub hair: Colour,
    /// Of the lower lip.
    pub lips: Colour,
    /// Of the ring round the pupil.
    pub iris: Colour,
    /// Of the brows' darker pixels.
    pub brows: Colour,
    /// Of the chin, where a beard would be.
    pub beard: Colour,
}

/// What a face has besides points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// How far the inner handles of the jaw's cubic reach: along the chin, in widths from 2.1 to 2.14; and down from
    /// 2.14, in heights between them. Larger and smaller make a flatter and a sharper jaw (thesis sec. 4.2.2.2 B).
    pub jaw: [f64; 2],
    /// Height of the brows, in pupil distances.
    pub brow_height: f64,
    /// Half the width of the neck, in half widths of the jaw.
    pub neck: f64,
    /// How much darker than the cheeks, in OKLab lightness, the chin, jaw, lower cheeks and upper lip are.
    pub beard: Beard,
    /// How much of the left and the right ear can be seen, 0 to 1.
    pub ears: [f64; 2],
    /// The top of the head with its hair: y in pixels of the photo.
    pub head_top: f64,
    /// How likely the face wears glasses, 0 to 1.
    pub glasses: f64,
}

/// How much darker than the cheeks four places of a face are, in OKLab lightness; 0 and below: not darker.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beard {
    /// Between the lower lip and the chin.
    pub chin: f64,
    /// Along the jaw.
    pub jaw: f64,
    /// The lower cheeks, beside the ears.
    pub cheek: f64,
    /// Under the nose.
    pub lip: f64,
}

/// The hair of a face.
#[derive(Debug, Clone, PartialEq)]
pub struct Hair {
    /// How it falls.
    pub kind: HairKind,
    /// `h.1` to `h.25`; none on a bald head.
    pub points: Option<[Placed; FeaturePoint::HAIR]>,
    /// What can be seen of it from the front, as closed outlines, finer than 25 points can say. The largest comes
    /// first; holes run against the outline they are in.
    pub front: Vec<Vec<Point>>,
    /// Which vertices of the first outline the 25 points are; empty where there are none.
    pub vertices: Vec<usize>,
    /// What lies behind the head, as closed outlines.
    pub back: Vec<Vec<Point>>,
}

/// How hair falls. Photos do not settle straight, wavy and curly; an author does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HairKind {
    /// Straight, as long as nobody says otherwise.
    #[default]
    Straight,
    /// In waves.
    Wavy,
    /// In curls.
    Curly,
    /// So short that the skin shows through.
    Shaved,
    /// None.
    Bald,
}

/// Which photo a face is of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PhotoRecord {
    /// SHA-256 of its file, 64 hexadecimal digits.
    pub sha256: String,
    /// Width and height as it is looked at, in pixels.
    pub size: [u32; 2],
}

impl Index<FeaturePoint> for Points {
    type Output = Point;
    fn index(&self, point: FeaturePoint) -> &Point {
        &self.0[point.index()]
    }
}

impl IndexMut<FeaturePoint> for Points {
    fn index_mut(&mut self, point: FeaturePoint) -> &mut Point {
        &mut self.0[point.index()]
    }
}

impl Face {
    /// What is odd about where its points lie; none where they lie as those of a face in its photo do.
    #[must_use]
    pub(crate) fn oddity(&self) -> Option<String> {
        use FeaturePoint as P;
        let at = |p: P| self.points[p.index()].at;
        let across = at(P::P3_5) - at(P::P3_6);
        if across.x < 8.0 || across.y.abs() > across.x {
            return Some("its eyes do not lie side by side".into());
        }
        let below = |p: P| across.cross(at(p) - at(P::P3_6)) / across.hypot();
        let down = [P::P9_15, P::P8_1, P::P8_2, P::P2_1].map(below);
        if !(down[0] > 0.0 && down.is_sorted()) {
            return Some("its nose, lips and chin do not lie below each other".into());
        }
        let [width, height] = self.photo.size.map(f64::from);
        let outside = |p: &Placed| p.at.x < -0.5 || p.at.y < -0.5 || p.at.x > width - 0.5 || p.at.y > height - 0.5;
        match self.points.iter().filter(|p| outside(p)).count() {
            0 => None,
            1 => Some("one of its points lies outside the photo".into()),
            n => Some(format!("{n} of its points lie outside the photo")),
        }
    }

    /// The places of the 47 points that every face has, in pixels of the photo.
    #[must_use]
    pub fn places(&self) -> Points {
        Points(self.points.map(|p| p.at))
    }

    /// A point of the face; none for a point of hair on a bald head.
    #[must_use]
    pub fn placed(&self, point: FeaturePoint) -> Option<&Placed> {
        match point.hair_index() {
            Some(n) => self.hair.points.as_ref().map(|points| &points[n]),
            None => Some(&self.points[point.index()]),
        }
    }

    /// A point of the face, to change it; none for a point of hair on a bald head.
    pub fn placed_mut(&mut self, point: FeaturePoint) -> Option<&mut Placed> {
        match point.hair_index() {
            Some(n) => self.hair.points.as_mut().map(|points| &mut points[n]),
            None => Some(&mut self.points[point.index()]),
        }
    }

    /// The first outline of the hair with what a hand has moved: between two of the 25 points the rest of the
    /// outline follows in proportion to its way along it. Empty without hair.
    #[must_use]
    pub(crate) fn hair_outline(&self) -> Vec<Point> {
        let Some(outline) = self.hair.front.first() else { return Vec::new() };
        let (Some(points), false) = (&self.hair.points, self.hair.vertices.is_empty()) else { return outline.clone() };
        let moves: Vec<_> = points.iter().zip(&self.hair.vertices).map(|(p, v)| (*v, p.at - outline[*v])).collect();
        if moves.iter().all(|(_, by)| by.hypot() < 0.05) {
            return outline.clone();
        }
        let mut moved = outline.clone();
        let n = outline.len();
        let mut order = moves;
        order.sort_by_key(|(v, _)| *v);
        for (i, (from, by)) in order.iter().enumerate() {
            let (to, by_next) = order[(i + 1) % order.len()];
            let steps = (to + n - from) % n;
            let at = |k: usize| outline[(from + k) % n];
            let length: f64 = (0..steps).map(|k| at(k).distance(at(k + 1))).sum::<f64>().max(1e-9);
            let mut gone = 0.0;
            for k in 0..steps.max(1) {
                let share = gone / length;
                moved[(from + k) % n] = at(k) + *by * (1.0 - share) + by_next * share;
                gone += at(k).distance(at(k + 1));
            }
        }
        moved
    }
}
