//! Edits of a face and its shots, each with its inverse.

use serde::{Deserialize, Serialize};

use crate::calibration::Marks;
use crate::disk::{Fault, Result};
use crate::face::{Face, FeaturePoint, How, Placed};
use crate::geometry::Point;
use crate::pose::Emotion;
use crate::project::ProjectFault;
use crate::project::fault::stale;
use crate::project::files::LessonFace;

/// An edit of one face. It says what was and what is to be, so that it can be taken back.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FaceEdit {
    /// Position of a feature point.
    Point {
        /// The shot that it is in; a journal that does not say means the neutral one.
        #[serde(default = "neutral")]
        shot: Emotion,
        /// The point's name.
        point: String,
        /// As it was.
        before: Spot,
        /// As it is to be.
        after: Spot,
    },
    /// The face as a whole, as the text of its `face.toml`; none is a face without points.
    Face {
        /// As it was.
        before: Option<String>,
        /// As it is to be.
        after: Option<String>,
    },
    /// The points of a shot as a whole, as the text of its `happy.toml`; none is a shot without points.
    Marks {
        /// The shot.
        shot: Emotion,
        /// As it was.
        before: Option<String>,
        /// As it is to be.
        after: Option<String>,
    },
}

fn neutral() -> Emotion {
    Emotion::Neutral
}

impl FaceEdit {
    /// The edit that takes it back.
    #[must_use]
    pub(crate) fn inverse(&self) -> Self {
        match self.clone() {
            Self::Point { shot, point, before, after } => Self::Point { shot, point, before: after, after: before },
            Self::Face { before, after } => Self::Face { before: after, after: before },
            Self::Marks { shot, before, after } => Self::Marks { shot, before: after, after: before },
        }
    }

    /// Makes the edit. What it says was must be what is.
    pub(super) fn apply(&self, face: &mut LessonFace) -> Result<()> {
        match self {
            Self::Point { shot, point, before, after } => {
                let point = FeaturePoint::named(point).ok_or_else(stale)?;
                let placed = match shot {
                    Emotion::Neutral => face.face.as_mut().and_then(|f| f.placed_mut(point)),
                    emotion => face.shots[emotion.index()].placed_mut(point),
                };
                let placed = placed.filter(|p| before.is_of(p)).ok_or_else(stale)?;
                near_the_photo(after.at)?;
                *placed = (*after).into();
            }
            Self::Face { before, after } => {
                if face.face.as_ref().map(Face::to_toml) != *before {
                    return Err(stale());
                }
                face.face = after.as_deref().map(Face::parse).transpose()?;
            }
            Self::Marks { shot, before, after } => {
                let shot = face.shots.get_mut(shot.index()).filter(|_| *shot != Emotion::Neutral).ok_or_else(stale)?;
                if shot.marks.as_ref().map(Marks::to_toml) != *before {
                    return Err(stale());
                }
                shot.marks = after.as_deref().map(Marks::parse).transpose()?;
            }
        }
        Ok(())
    }
}

/// A feature point's place, as an edit keeps it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spot {
    /// Pixels of the photo.
    pub at: [f64; 2],
    /// 0 to 1.
    pub confidence: f64,
    /// How it came to be.
    pub how: How,
}

impl Spot {
    /// Whether a point is there, as exactly as a file says it.
    fn is_of(&self, placed: &Placed) -> bool {
        let near = (placed.at - Point::new(self.at[0], self.at[1])).hypot() < 0.1;
        near && (placed.confidence - self.confidence).abs() < 0.01 && placed.how == self.how
    }
}

impl From<Placed> for Spot {
    fn from(placed: Placed) -> Self {
        Self { at: [placed.at.x, placed.at.y], confidence: placed.confidence, how: placed.how }
    }
}

impl From<Spot> for Placed {
    fn from(spot: Spot) -> Self {
        Self { at: Point::new(spot.at[0], spot.at[1]), confidence: spot.confidence, how: spot.how }
    }
}

/// Makes sure that points of a shot lie where points can lie.
fn near_the_photo(at: [f64; 2]) -> Result<()> {
    if at.iter().all(|v| v.abs() <= crate::face::MAX_COORDINATE) {
        return Ok(());
    }
    Err(Fault::of(ProjectFault::Edit, "the point would lie nowhere near the photo").help("move it back"))
}
