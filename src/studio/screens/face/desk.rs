//! A face on the desk: its photo, the point that is chosen, and how the cartoon beside it is tried out.

use std::sync::Arc;

use crate::drawing::Drawing;
use crate::face::{FeaturePoint, Placed};
use crate::figure::Figure;
use crate::geometry::{Point, Rect, Vec2};
use crate::photo::Photo;
use crate::pose::{Emotion, MouthPose, MouthPreset, MouthShape, Pose, Ratios};
use crate::project::LessonFace;

/// How much nearer one step of the zoom brings the photo.
const ZOOM_STEP: f64 = 1.6;
/// The nearest that the photo can be looked at.
const MAX_ZOOM: i32 = 6;

/// A face on the desk.
#[derive(Debug)]
pub struct FaceDesk {
    /// Number of the face.
    pub face: usize,
    /// Which of its shots is looked at.
    pub shot: Emotion,
    /// Points of somebody else's annotation of that shot, which have no names.
    pub dots: Vec<Point>,
    /// Whether the points were changed since the face was calibrated.
    pub is_stale: bool,
    /// The photo of the shot; none while it is read, and where there is none.
    pub photo: Option<Arc<Photo>>,
    /// The point that keys move.
    pub point: FeaturePoint,
    /// Whether the point at the other side moves too.
    pub both: bool,
    /// Steps nearer than the whole face.
    pub zoom: i32,
    /// The thesis's stages of the photo, each with its caption; empty until they are there.
    pub stages: Vec<(String, Drawing)>,
    /// Which of them is shown in place of the photo; none shows the photo.
    pub stage: Option<usize>,
    /// The emotion that the cartoon shows.
    pub emotion: Emotion,
    /// The mouth shape that the cartoon shows; none is the emotion's own mouth.
    pub mouth: Option<MouthShape>,
    /// Which nine mouth shapes the face has.
    pub mouths: MouthPreset,
    /// What the face looks like drawn; none without points.
    pub figure: Option<Figure>,
    /// Places given by hand where nothing was found: left eye, right eye, mouth, chin so far, and the cross.
    pub placing: Option<Placing>,
    /// What the search had to say.
    pub remarks: Vec<String>,
    /// The state of the project's faces that is shown: the count of their changes.
    pub shown: u64,
}

/// Four places that an author gives so that the rest can be placed from them.
#[derive(Debug, Clone, PartialEq)]
pub struct Placing {
    /// Those given.
    pub given: Vec<Point>,
    /// Where the cross is, in pixels of the photo.
    pub cross: Point,
}

impl Placing {
    /// What is to be given, in order.
    pub(crate) const WANTED: [&'static str; 4] = [
        "the eye at the image's left",
        "the eye at the image's right",
        "the middle of the mouth",
        "the tip of the chin",
    ];

    /// What is to be given next.
    #[must_use]
    pub(crate) fn wanted(&self) -> &'static str {
        Self::WANTED[self.given.len().min(3)]
    }
}

impl FaceDesk {
    /// The desk of a face, as it is first seen.
    #[must_use]
    pub(crate) fn new(face: usize, mouths: MouthPreset, figure: Option<Figure>) -> Self {
        Self {
            face,
            shot: Emotion::Neutral,
            dots: Vec::new(),
            is_stale: false,
            photo: None,
            point: FeaturePoint::P3_6,
            both: false,
            zoom: 0,
            stages: Vec::new(),
            stage: None,
            emotion: Emotion::Neutral,
            mouth: None,
            mouths,
            figure,
            placing: None,
            remarks: Vec::new(),
            shown: 0,
        }
    }

    /// What the cartoon is to do.
    #[must_use]
    pub(crate) fn pose(&self) -> Pose {
        let mut pose = Pose::of(Ratios::pure(self.emotion));
        if let Some(shape) = self.mouth {
            pose.mouth = MouthPose::of(shape, self.mouths);
        }
        pose
    }

    /// Nearer or farther.
    pub(crate) fn zoom_by(&mut self, by: i32) {
        self.zoom = (self.zoom + by).clamp(0, MAX_ZOOM);
    }

    /// The part of the photo to show, in its pixels: the face with its hair, or nearer round the chosen point or the
    /// cross.
    #[must_use]
    pub(crate) fn view(&self, points: &[(FeaturePoint, Placed)], size: Vec2) -> Rect {
        let whole = Rect::new(-0.5, -0.5, size.x - 0.5, size.y - 0.5);
        let mut places = points.iter().map(|p| p.1.at).chain(self.dots.iter().copied());
        let around = places.next().map_or(whole, |first| {
            let bounds = places.fold(Rect::from_points(first, first), |r, p| r.union_pt(p));
            // A shot has no points of hair and ears, which are seen all the same.
            let share = if self.shot == Emotion::Neutral { 0.12 } else { 0.3 };
            let margin = share * bounds.width().max(bounds.height()).max(8.0);
            let shown = bounds.inflate(margin, margin).intersect(whole);
            if shown.width() > 4.0 && shown.height() > 4.0 { shown } else { whole }
        });
        let around = if self.placing.is_some() { whole } else { around };
        if self.zoom == 0 {
            return around;
        }
        let scale = ZOOM_STEP.powi(-self.zoom);
        let middle = match (&self.placing, points.iter().find(|p| p.0 == self.point)) {
            (Some(placing), _) => placing.cross,
            (None, Some((_, placed))) => placed.at,
            (None, None) => around.center(),
        };
        Rect::from_center_size(middle, around.size() * scale)
    }

    /// The named points of the shot that is looked at.
    #[must_use]
    pub(crate) fn points(&self, face: &LessonFace) -> Vec<(FeaturePoint, Placed)> {
        match (face.shot(self.shot), &face.face) {
            (Some(shot), _) => shot.points().collect(),
            (None, Some(face)) => FeaturePoint::all().filter_map(|p| Some((p, *face.placed(p)?))).collect(),
            (None, None) => Vec::new(),
        }
    }

    /// Chooses the next or previous of the points that there are.
    pub(crate) fn choose(&mut self, by: i32, points: &[(FeaturePoint, Placed)]) {
        let here = points.iter().position(|p| p.0 == self.point).unwrap_or(0) as i32;
        if let Some((point, _)) = points.get((here + by).rem_euclid(points.len().max(1) as i32) as usize) {
            self.point = *point;
        }
    }
}

/// A step of a point at one side as its mirror image takes it: mirrored at the line midway between the pupils.
#[must_use]
pub(crate) fn mirrored(step: Vec2, points: &[(FeaturePoint, Placed)]) -> Vec2 {
    let at = |p: FeaturePoint| points.iter().find(|q| q.0 == p).map_or(Point::ORIGIN, |q| q.1.at);
    let across = at(FeaturePoint::P3_5) - at(FeaturePoint::P3_6);
    let length = across.hypot();
    if length < 1e-6 {
        return Vec2::new(-step.x, step.y);
    }
    let across = across / length;
    step - across * (2.0 * step.dot(across))
}

/// How a point came to be, in words.
#[must_use]
pub(crate) fn told(placed: &Placed) -> String {
    use crate::face::How;
    match placed.how {
        How::Hand => "set by hand".into(),
        How::Rule => "placed by rule".into(),
        How::Found => format!("found, {:.0} % sure", placed.confidence * 100.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::face::Face;

    #[test]
    fn a_step_outwards_is_a_step_outwards_at_the_other_side() {
        let text = include_str!("../../../../projects/nihao/faces/teacher/face.toml");
        let face = Face::parse(text).expect("a face");
        let points: Vec<_> = FeaturePoint::all().filter_map(|p| Some((p, *face.placed(p)?))).collect();
        let step = mirrored(Vec2::new(-1.0, 2.0), &points);
        // The eyes of the photo are not quite level.
        assert!((step.x - 1.0).abs() < 0.15 && (step.y - 2.0).abs() < 0.15, "{step:?}");
    }
}
