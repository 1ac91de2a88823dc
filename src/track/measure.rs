//! What a shape says beside the ratios: head, lids, mouth, and where the openings of the eyes are.

use crate::calibration::Calibration;
use crate::disk::{Fault, Result};
use crate::face::FeaturePoint as P;
use crate::geometry::{Point, Similarity};
use crate::ratios::MouthMoves;

/// What does not move with the expression: the corners of the eyes and the nose. They say where the head is.
const STEADY: [P; 9] = [P::P3_12, P::P3_8, P::P3_11, P::P3_7, P::P9_6, P::P9_7, P::P9_4, P::P9_5, P::P9_15];
/// Inner corner, outer corner, upper and lower lid of the eye at the image's left and right.
const EYES: [[P; 4]; 2] = [[P::P3_8, P::P3_12, P::P3_2, P::P3_4], [P::P3_11, P::P3_7, P::P3_1, P::P3_3]];
/// A mouth at rest that is open by no more than this, in pupil distances, is closed: its edges are marked a little apart.
/// The line of ink of [`face::rig`](crate::face::rig).
const A_LINE: f64 = 0.016;
/// Where lips meet between the upper (0) and the lower edge (1), as in the rig.
const MEET: f64 = 0.4;
/// How far before the eyes the nose's base lies, in pupil distances: by so much it moves sideways when the head turns.
const NOSE_DEPTH: f64 = 0.35;

/// The neutral face that everything is measured against.
#[derive(Debug, Clone)]
pub(super) struct Neutral<'c> {
    calibration: &'c Calibration,
    steady: Vec<(P, Point)>,
    /// Heights of the eyes, in pupil distances.
    pub eyes: [f64; 2],
    nose: Point,
    corners: [Point; 2],
    meet: f64,
    /// MNS0 and MW0.
    units: [f64; 2],
}

/// The measures of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Measures {
    /// The place between the pupils, in pixels.
    pub place: Point,
    /// The pupil distance, in pixels.
    pub pupils: f64,
    /// The head's roll in degrees, clockwise as seen.
    pub roll: f64,
    /// How far the nose's base is turned to the image's right from where the neutral face has it, in degrees, about.
    pub yaw: f64,
    /// How far each eye is open, 1 as the neutral face.
    pub open: [f64; 2],
    /// The mouth.
    pub mouth: MouthMoves,
    /// Inner corner, outer corner, upper and lower lid of each eye, in pixels.
    pub eyes: [[Point; 4]; 2],
}

impl<'c> Neutral<'c> {
    /// # Errors
    /// When the calibration's points do not tell where eyes, nose and mouth are.
    pub(crate) fn of(calibration: &'c Calibration) -> Result<Self> {
        let shape = &calibration.laid()[0];
        let at = |name: P| {
            calibration.binding().at(shape, name).ok_or_else(|| {
                Fault::new(format!("the calibration's points do not say where the {} is", name.meaning()))
                    .help("calibrate the face anew")
            })
        };
        let steady = STEADY.into_iter().map(|p| Ok((p, at(p)?))).collect::<Result<Vec<_>>>()?;
        let mut eyes = [0.0; 2];
        for (height, [_, _, upper, lower]) in eyes.iter_mut().zip(EYES) {
            *height = (at(lower)?.y - at(upper)?.y).max(0.05);
        }
        let (nose, corners) = (at(P::P9_15)?, [at(P::P8_4)?, at(P::P8_3)?]);
        let (upper, lower) = (at(P::P2_2)?.y, at(P::P2_3)?.y);
        let meet = upper + MEET * (lower - upper).clamp(0.0, A_LINE);
        let units = [(at(P::P8_1)?.y - nose.y).max(0.05), (corners[1].x - corners[0].x).max(0.1)];
        Ok(Self { calibration, steady, eyes, nose, corners, meet, units })
    }

    /// The measures of a shape, in pixels; none where it has no extent or is another's.
    pub(crate) fn measure(&self, shape: &[Point]) -> Option<Measures> {
        let binding = self.calibration.binding();
        let at = |name: P| binding.at(shape, name);
        let mut now = [Point::ORIGIN; STEADY.len()];
        for (to, (name, _)) in now.iter_mut().zip(&self.steady) {
            *to = at(*name)?;
        }
        let rest: [Point; STEADY.len()] = std::array::from_fn(|i| self.steady[i].1);
        // From the neutral frame to the picture: the head's pose.
        let head = Similarity::between(&rest, &now)?;
        if !(head.scale() > 1.0 && head.scale().is_finite()) {
            return None;
        }
        let mut eyes = [[Point::ORIGIN; 4]; 2];
        let mut open = [1.0; 2];
        for (((eye, open), names), height) in eyes.iter_mut().zip(&mut open).zip(EYES).zip(self.eyes) {
            for (to, name) in eye.iter_mut().zip(names) {
                *to = at(name)?;
            }
            *open = ((head.undo(eye[3]).y - head.undo(eye[2]).y) / height).max(0.0);
        }
        // The mouth is measured from the nose's base, which a nod carries along.
        let shift = self.nose - head.undo(at(P::P9_15)?);
        let place = |name: P| Some(head.undo(at(name)?) + shift);
        let (upper, lower) = (place(P::P2_2)?.y, place(P::P2_3)?.y);
        let corners = [place(P::P8_4)?, place(P::P8_3)?];
        let mouth = MouthMoves {
            up: (self.meet - upper) / self.units[0],
            down: (lower - self.meet) / self.units[0],
            left: (self.corners[0].x - corners[0].x) / self.units[1],
            right: (corners[1].x - self.corners[1].x) / self.units[1],
        };
        Some(Measures {
            place: head.apply(Point::ORIGIN),
            pupils: head.scale(),
            roll: head.angle().to_degrees(),
            yaw: self.yaw(&eyes, at(P::P9_15)?),
            open,
            mouth,
            eyes,
        })
    }

    /// The nose's base against the corners of the eyes alone, which lie in one plane.
    fn yaw(&self, eyes: &[[Point; 4]; 2], nose: Point) -> f64 {
        let rest: [Point; 4] = std::array::from_fn(|i| self.steady[i].1);
        let now = [eyes[0][1], eyes[0][0], eyes[1][0], eyes[1][1]];
        let Some(q) = Similarity::between(&now, &rest) else { return 0.0 };
        let aside = q.apply(nose).x - self.nose.x;
        (aside / NOSE_DEPTH).clamp(-1.0, 1.0).asin().to_degrees()
    }
}
