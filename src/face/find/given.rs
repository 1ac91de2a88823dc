//! What is given for a photo: the 47 points with their doubts, or a refusal.

use super::fit::{Fit, Known};
use super::refusal::{Doubt, Refusal};
use super::search::{Candidate, SMALLEST, WORKING_SIDE, apart};
use super::{Model, Pyramid};
use crate::face::{FeaturePoint as P, How, Placed};
use crate::geometry::{Point, Similarity};
use crate::photo::Photo;

/// A face as it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The 47 fixed points, in the model's order, in pixels of the photo.
    pub points: [Placed; P::FIXED],
    /// 0 to 1: how sure it is that this is a face seen from the front. Below 0.5 it would be refused.
    pub score: f64,
    /// How far the head is tilted, in degrees, clockwise as seen.
    pub roll: f64,
    /// About how far the head is turned, in degrees; above 0 the nose points to the image's right.
    pub yaw: f64,
    /// How far the mouth is open: 2.2 to 2.3, as a share of the mouth's width.
    pub opening: f64,
    /// How strange the brows, eyes, nose and mouth look: 1 is usual, 2 is hardly met.
    pub residual: f64,
    /// What gives cause for doubt.
    pub doubts: Vec<Doubt>,
}

/// Four places on a face that somebody has pointed out, in pixels of the photo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchors {
    /// The pupil at the image's left.
    pub left_eye: Point,
    /// The pupil at the image's right.
    pub right_eye: Point,
    /// The middle of the mouth.
    pub mouth: Point,
    /// The lowest point of the chin.
    pub chin: Point,
}

/// The four points that the London set does not have; they are placed by rule.
const BY_RULE: [P; 4] = [P::P9_6, P::P9_7, P::P9_14, P::P9_13];

/// A candidate's total must be above this. Cross-validated, faces have 3.5 and more, other photos of other cameras 2
/// and more; all that was drawn or torn is below −0.5.
const ENOUGH: f32 = 0.6;
/// Below this, the face is doubted.
const PLENTY: f32 = 2.0;
/// The smallest pupil distance, in pixels of the working copy.
const SMALL: f64 = 24.0;
/// A head turned by more degrees than the first is doubted, by more than the second refused.
const TURNED: [f64; 2] = [12.0, 25.0];
/// The same of a head that is tilted.
const TILTED: [f64; 2] = [10.0, 32.0];
/// A mouth that is open by more of its width is doubted.
const OPEN: f64 = 0.12;
/// How far off, in pupil distances, a point is taken to be that a hand has set, and the four of a rescue.
const BY_HAND: f64 = 0.002;
const POINTED_OUT: [f64; 4] = [0.03, 0.03, 0.05, 0.06];

impl Candidate {
    /// The detector's and the judges' sums together: about 4 for faces, below 0 for anything else.
    #[must_use]
    pub fn total(&self) -> f32 {
        0.4 * self.window.min(8.0) + 0.2 * self.rough + 0.4 * self.close
    }
}

/// The face that the cascade finds by itself.
pub(super) fn by_cascade(
    model: &Model,
    photo: &Photo,
    picture: &Pyramid,
    step: f64,
    hands: &[(P, Point)],
    known: &[Known],
) -> Result<Found, Refusal> {
    let mut rough = model.candidates(picture, known).into_iter();
    let Some(first) = rough.next() else { return Err(model.nothing(picture)) };
    let close = model.closely(photo, &first, known);
    let found = model.given(&close, hands);
    let pupils = close.fit.frame.scale();
    if close.total() < ENOUGH {
        let something = close.window > 0.5 && close.total() > -0.5;
        return Err(if something { unclear(&found) } else { model.nothing(picture) });
    }
    if pupils / step < SMALL {
        return Err(Refusal::TooSmall(pupils / step));
    }
    for other in rough.filter(|o| o.rough > 0.0 && o.window > 0.5 && o.fit.frame.scale() > 0.4 * pupils) {
        let other = model.closely(photo, &other, &[]);
        if other.total() > ENOUGH && apart(&other.fit.frame, &close.fit.frame) {
            return Err(Refusal::TwoFaces);
        }
    }
    if found.yaw.abs() > TURNED[1] {
        return Err(Refusal::TurnedAway(Some(found.yaw.abs())));
    }
    if found.roll.abs() > TILTED[1] {
        return Err(Refusal::Tilted(found.roll));
    }
    Ok(found)
}

/// What hinders a face that is nearly one.
fn unclear(found: &Found) -> Refusal {
    if found.yaw.abs() > TURNED[0] { Refusal::TurnedAway(None) } else { Refusal::Unclear }
}

/// Finds a face whose pupils, mouth and chin somebody has pointed out: they say where it is, and the picture
/// the rest, as far as it can; else the points are those of a usual face that has these four.
#[must_use]
pub fn find_from(photo: &Photo, anchors: &Anchors) -> Found {
    let model = Model::learned();
    let index = |point| model.learned_index(point);
    let places = [anchors.left_eye, anchors.right_eye, anchors.mouth, anchors.mouth, anchors.chin];
    let points = [P::P3_6, P::P3_5, P::P2_2, P::P2_3, P::P2_1];
    let slack = |i: usize| POINTED_OUT[i.saturating_sub(usize::from(i > 2))];
    let fixed: Vec<Known> =
        points.iter().zip(places).enumerate().filter_map(|(i, (p, at))| Some((index(*p)?, at, slack(i)))).collect();
    let means: Vec<Point> = fixed.iter().map(|(i, ..)| model.shapes.mean[*i]).collect();
    let at: Vec<Point> = fixed.iter().map(|f| f.1).collect();
    let frame = Similarity::between(&means, &at).unwrap_or(Similarity::spanning(anchors.left_eye, anchors.right_eye));
    let (small, step) = photo.at_most(WORKING_SIDE);
    let rough = model.roughly(&Pyramid::of(&small, step), frame, 0.0, &fixed);
    let close = model.closely(photo, &rough, &fixed);
    let near = |f: &Known| close.fit.frame.apply(close.fit.shape[f.0]).distance(f.1) < 0.15 * frame.scale();
    if close.close > 0.0 && fixed.iter().all(near) {
        return model.given(&close, &[]);
    }
    let mut fit = Fit::at(&model.shapes, frame);
    let held: Vec<_> = fixed.iter().map(|(i, at, slack)| (*i, frame.undo(*at), *slack)).collect();
    fit.shape = model.shapes.given(&fit.shape, &held, 1.0);
    let strangeness = model.strangeness(&Pyramid::round_face(photo, &frame, 60.0), &fit);
    let guess = Candidate { fit, strangeness, window: 0.0, rough: close.rough, close: close.close };
    let mut found = model.given(&guess, &[]);
    for placed in &mut found.points {
        *placed = Placed { how: How::Rule, confidence: placed.confidence.min(0.3), ..*placed };
    }
    found.doubts.push(Doubt::Guessed(P::FIXED));
    found
}

impl Model {
    /// Why nothing was found: perhaps there is a face, but too small a one.
    fn nothing(&self, picture: &Pyramid) -> Refusal {
        // Of windows that small only those are believed that are as sure as a face's.
        let tiny = self.detector.scan(picture, 0.55 * SMALLEST * picture.step(), 2.5);
        let size = tiny.first().map(|hit| hit.frame.scale() / picture.step());
        size.filter(|s| *s < SMALL).map_or(Refusal::NoFace, Refusal::TooSmall)
    }

    /// Which of the learned points a feature point is; none for those that are placed by rule and for hair.
    pub(super) fn learned_index(&self, point: P) -> Option<usize> {
        let before = BY_RULE.iter().filter(|r| r.index() < point.index()).count();
        (point.index() < P::FIXED && !BY_RULE.contains(&point)).then(|| point.index() - before)
    }

    pub(super) fn known(&self, photo: &Photo, hands: &[(P, Point)]) -> Vec<Known> {
        let within = |at: &Point| {
            let (w, h) = (photo.width() as f64, photo.height() as f64);
            (-w..2.0 * w).contains(&at.x) && (-h..2.0 * h).contains(&at.y)
        };
        let known = hands.iter().filter(|(_, at)| within(at));
        known.filter_map(|(p, at)| Some((self.learned_index(*p)?, *at, BY_HAND))).collect()
    }

    /// Where a face is of which a hand has set three points or more that lie apart.
    pub(super) fn frame_by_hand(&self, hands: &[(P, Point)]) -> Option<Similarity> {
        let pairs: Vec<(Point, Point)> =
            hands.iter().filter_map(|(p, at)| Some((self.shapes.mean[self.learned_index(*p)?], *at))).collect();
        let (means, places): (Vec<_>, Vec<_>) = pairs.into_iter().unzip();
        let wide = means.iter().any(|a| means.iter().any(|b| a.distance(*b) > 0.7));
        (means.len() >= 3 && wide).then(|| Similarity::between(&means, &places)).flatten().filter(|f| f.scale() > 8.0)
    }

    /// The 47 points and what else is said of a fit.
    pub(super) fn given(&self, candidate: &Candidate, hands: &[(P, Point)]) -> Found {
        self.described(self.points_of(candidate), candidate, hands)
    }

    /// The points of a fit, with those that are placed by rule still to come.
    pub(super) fn points_of(&self, candidate: &Candidate) -> [Placed; P::FIXED] {
        let fit = &candidate.fit;
        let places = fit.places();
        let guess = Placed { at: Point::ORIGIN, confidence: 0.0, how: How::Rule };
        let mut points = [guess; P::FIXED];
        for point in P::fixed() {
            let Some(n) = self.learned_index(point) else { continue };
            let strangeness = candidate.strangeness.get(n).copied().unwrap_or(1.0);
            let error = self.looks.expected(n, fit.spread[n], strangeness);
            // Half trusted where the error to be expected is 6 % of the pupil distance: an eyelid's whole opening
            // is about 20 %.
            points[point.index()] = Placed { at: places[n], confidence: 1.0 / (1.0 + error / 0.06), how: How::Found };
        }
        points
    }

    /// Points with those that follow from them, and what else is said of them and of the fit they are of.
    pub(super) fn described(
        &self,
        mut points: [Placed; P::FIXED],
        candidate: &Candidate,
        hands: &[(P, Point)],
    ) -> Found {
        let unit = candidate.fit.frame.scale();
        let set = |points: &mut [Placed; P::FIXED]| {
            for (point, at) in hands.iter().filter(|(p, _)| p.index() < P::FIXED) {
                points[point.index()] = Placed { at: *at, confidence: 1.0, how: How::Hand };
            }
        };
        set(&mut points);
        chin(&mut points);
        by_rule(&mut points);
        set(&mut points);
        let at = |p: P| points[p.index()].at;
        let pupils = Similarity::spanning(at(P::P3_6), at(P::P3_5));
        let own = |p: P| pupils.undo(at(p));
        let roll = pupils.angle().to_degrees();
        // The nose stands out by 0.45 pupil distances before the eyes, so its base moves by 0.45 sin(yaw).
        let yaw = (own(P::P9_15).x / 0.45).clamp(-1.0, 1.0).asin().to_degrees();
        let width = at(P::P8_4).distance(at(P::P8_3)).max(1e-6);
        let opening = (own(P::P2_3).y - own(P::P2_2).y).max(0.0) * pupils.scale() / width;
        let inner: Vec<f32> = P::fixed()
            .filter(|p| p.index() < P::P2_1.index())
            .filter_map(|p| candidate.strangeness.get(self.learned_index(p)?).copied())
            .collect();
        let residual = f64::from(inner.iter().sum::<f32>() / inner.len().max(1) as f32);
        let mut doubts = Vec::new();
        let mut doubt = |yes: bool, doubt: Doubt| {
            if yes {
                doubts.push(doubt);
            }
        };
        doubt(roll.abs() > TILTED[0], Doubt::Tilted(roll));
        doubt(yaw.abs() > TURNED[0], Doubt::Turned(yaw));
        doubt(opening > OPEN, Doubt::MouthOpen(opening));
        doubt(unit < 1.6 * SMALL, Doubt::Small(unit));
        doubt(candidate.total() < PLENTY && hands.len() < 3, Doubt::Unusual);
        let score = 1.0 / (1.0 + f64::from(-(candidate.total() - ENOUGH)).exp());
        Found { points, score, roll, yaw, opening, residual, doubts }
    }
}

/// Where the chin lies beside the face, it is speculated: 2.1 = 8.2 + 0.7 d below, d the pupil distance
/// (thesis sec. 4.3.2 A 1).
fn chin(points: &mut [Placed; P::FIXED]) {
    let at = |p: P| points[p.index()].at;
    let pupils = Similarity::spanning(at(P::P3_6), at(P::P3_5));
    let (lip, chin) = (pupils.undo(at(P::P8_2)), pupils.undo(at(P::P2_1)));
    if points[P::P2_1.index()].how == How::Found && !(0.15..1.1).contains(&(chin.y - lip.y)) {
        let guess = pupils.apply(Point::new(lip.x, lip.y + 0.7));
        points[P::P2_1.index()] = Placed { at: guess, confidence: 0.2, how: How::Rule };
    }
}

/// The bridge and the top of the wings: a third of the way between the inner corners of the eyes, at the height of
/// the pupils (thesis alg. 4.4); a little inside the wings, a fifth of the nose's height above them (the recipe).
fn by_rule(points: &mut [Placed; P::FIXED]) {
    let of = |p: P| points[p.index()];
    let pupils = Similarity::spanning(of(P::P3_6).at, of(P::P3_5).at);
    let own = |p: P| pupils.undo(of(p).at);
    let (inner, other) = (own(P::P3_8), own(P::P3_11));
    let third = (other.x - inner.x) / 3.0;
    let up = 0.2 * own(P::P9_15).y;
    let places = [
        (P::P9_6, Point::new(inner.x + third, 0.0), P::P3_8),
        (P::P9_7, Point::new(other.x - third, 0.0), P::P3_11),
        (P::P9_14, Point::new(own(P::P9_2).x + 0.03, own(P::P9_2).y - up), P::P9_2),
        (P::P9_13, Point::new(own(P::P9_1).x - 0.03, own(P::P9_1).y - up), P::P9_1),
    ];
    let sure = places.map(|(_, _, from)| 0.9 * of(from).confidence);
    for ((point, at, _), confidence) in places.into_iter().zip(sure) {
        points[point.index()] = Placed { at: pupils.apply(at), confidence, how: How::Rule };
    }
}
