//! The way from a photo to a face: by what a hand has set, by the cascade, or where that finds none by the nets.

use super::by_net::find_by_net;
use super::given::by_cascade;
use super::{Doubt, Found, Model, Pyramid, Refusal, WORKING_SIDE};
use crate::face::FeaturePoint as P;
use crate::geometry::Point;
use crate::photo::Photo;

/// Finds the face in a photo. Points that a hand has set are kept exactly, and pull the others; three or more of
/// them say where the face is.
///
/// # Errors
/// When there is no face that is seen from the front, large enough and upright, or there are two.
pub fn find(photo: &Photo, hands: &[(P, Point)]) -> Result<Found, Refusal> {
    let model = Model::learned();
    let (small, step) = photo.at_most(WORKING_SIDE);
    let picture = Pyramid::of(&small, step);
    let known = model.known(photo, hands);
    if let Some(frame) = model.frame_by_hand(hands) {
        let rough = model.roughly(&picture, frame, 0.0, &known);
        let close = model.closely(photo, &rough, &known);
        let mut found = model.given(&close, hands);
        if close.close < 0.0 {
            found.doubts.push(Doubt::Unusual);
        }
        return Ok(found);
    }
    match by_cascade(model, photo, &picture, step, hands, &known) {
        Err(refusal) if hands.is_empty() => find_by_net(model, photo, refusal),
        found => found,
    }
}
