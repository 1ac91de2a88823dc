//! Faces that the cascade does not find by itself: found by the nets, with the cascade as a second opinion.
//!
//! The detector says where the face is, the mesh where its points are. From there the cascade looks too. A point on which
//! both agree is their mean; of one on which they do not, the mesh is believed and its confidence is low. Ears and the
//! hairline, which a mesh does not have, are the cascade's.

use super::refusal::{Doubt, Refusal};
use super::search::{Candidate, WORKING_SIDE};
use super::{Found, Model, Pyramid};
use crate::face::net::{Detection, Levels, Mesh, Scratch, detect, mesh, scores_by_turn};
use crate::face::{FeaturePoint as P, How, Part, Placed};
use crate::geometry::{Point, Similarity};
use crate::photo::Photo;

/// Two opinions on a point agree within these shares of the pupil distance: inside the face, and on its contour.
const AGREED: [f64; 2] = [0.04, 0.09];
/// Where the two differ by more than this share of the pupil distance, in the mean over eyes and nose, there is no face to
/// be sure of.
const APART: f64 = 0.20;
/// A head turned by more degrees is not one from the front.
const TURNED: f64 = 40.0;
/// A face beside the largest that is at least so much of its size could be meant as well.
const RIVAL: f64 = 0.6;
/// The least score of a face, 0 to 1: of 80 photos in any light and mood the least is above 0.05.
const LEAST_SCORE: f64 = 0.05;
/// The smallest pupil distance, in pixels of the photo.
const SMALL: f64 = 24.0;

/// Finds the face that the cascade did not, as `refusal` says.
pub(super) fn find_by_net(model: &Model, photo: &Photo, refusal: Refusal) -> Result<Found, Refusal> {
    // Of two faces, tilted ones and small ones the cascade is sure.
    if !matches!(refusal, Refusal::NoFace | Refusal::Unclear | Refusal::TurnedAway(_)) {
        return Err(refusal);
    }
    let (levels, mut scratch) = (Levels::of(photo), Scratch::default());
    let mut faces = detect(&levels, &mut scratch);
    faces.sort_by(|a, b| side(b).total_cmp(&side(a)));
    let [largest, others @ ..] = &faces[..] else { return Err(refusal) };
    // A face upside down is found upright too, but less surely.
    let scores = scores_by_turn(&levels, &mut scratch);
    if scores[1..].iter().any(|score| *score > scores[0] && *score > largest.score) {
        return Err(refusal);
    }
    let found = look(model, photo, &levels, largest, &mut scratch).map_err(|own| own.unwrap_or(refusal))?;
    let mut rivals = others.iter().filter(|other| side(other) > RIVAL * side(largest));
    match rivals.any(|rival| look(model, photo, &levels, rival, &mut scratch).is_ok()) {
        true => Err(Refusal::TwoFaces),
        false => Ok(found),
    }
}

/// The face that the detector saw somewhere; a refusal of its own where there is one from another side or too small, none
/// where there is none.
fn look(
    model: &Model,
    photo: &Photo,
    levels: &Levels<'_>,
    face: &Detection,
    scratch: &mut Scratch,
) -> Result<Found, Option<Refusal>> {
    let first = mesh(levels, &face.square(), scratch);
    let mesh = mesh(levels, &first.square(), scratch);
    let (unit, yaw) = (mesh.frame().scale(), mesh.yaw());
    if mesh.presence < 0.5 {
        return Err(None);
    }
    if yaw.abs() > TURNED {
        return Err(Some(Refusal::TurnedAway(Some(yaw.abs()))));
    }
    if unit < SMALL {
        return Err(Some(Refusal::TooSmall(unit)));
    }
    let candidate = model.second_opinion(photo, &mesh);
    let mut points = model.points_of(&candidate);
    if join(&mut points, &mesh) > APART {
        return Err(None);
    }
    let mut found = model.described(points, &candidate, &[]);
    if found.score < LEAST_SCORE {
        return Err(None);
    }
    found.yaw = yaw;
    found.doubts.retain(|doubt| !matches!(doubt, Doubt::Turned(_)));
    found.doubts.extend((yaw.abs() > 12.0).then_some(Doubt::Turned(yaw)));
    Ok(found)
}

/// Side of a detected face, in pixels of the photo.
fn side(face: &Detection) -> f64 {
    face.area.width().max(face.area.height())
}

impl Model {
    /// The fit of the cascade from where a mesh has its points.
    fn second_opinion(&self, photo: &Photo, mesh: &Mesh) -> Candidate {
        let points = mesh.feature_points();
        let pairs = points
            .iter()
            .filter(|(p, _)| is_inner(*p))
            .filter_map(|(point, at)| Some((self.shapes.mean[self.learned_index(*point)?], *at)));
        let (means, places): (Vec<Point>, Vec<Point>) = pairs.unzip();
        let frame = Similarity::between(&means, &places).unwrap_or_else(|| mesh.frame());
        let (small, step) = photo.at_most(WORKING_SIDE);
        let rough = self.roughly(&Pyramid::of(&small, step), frame, 0.0, &[]);
        self.closely(photo, &rough, &[])
    }
}

fn is_inner(point: P) -> bool {
    point.index() < P::P2_1.index()
}

/// Joins the points of a mesh with those of the cascade. Returns their mean distance at eyes and nose, in pupil distances.
fn join(points: &mut [Placed; P::FIXED], mesh: &Mesh) -> f64 {
    let unit = mesh.frame().scale();
    let (mut sum, mut count) = (0.0, 0.0);
    for (point, at) in mesh.feature_points() {
        let placed = &mut points[point.index()];
        let apart = placed.at.distance(at) / unit;
        // An open mouth the cascade does not know.
        if matches!(point.part(), Part::Eyes | Part::Nose) {
            sum += apart;
            count += 1.0;
        }
        let measured = point.part() == Part::Ears || [P::P11_1, P::P11_2, P::P11_3].contains(&point);
        if measured && apart < 0.3 {
            continue;
        }
        let agreed = AGREED[usize::from(!is_inner(point))];
        let confidence = 1.0 / (1.0 + apart / 0.06);
        *placed = match apart <= agreed {
            true => {
                Placed { at: placed.at.midpoint(at), confidence: placed.confidence.max(confidence), how: How::Found }
            }
            false => Placed { at, confidence: confidence.min(0.5), how: How::Found },
        };
    }
    sum / f64::max(count, 1.0)
}
