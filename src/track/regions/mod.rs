//! A video by regions (thesis sec. 6.2 to 6.4): eyes and mouth grow in each frame from where they were in the last, by
//! thresholds reserved from the first.
//!
//! It needs no calibration, and sees no brows. Its ratios are told from eyes and mouth alone, through the shapes of a
//! calibration where there is one.

mod eyes;
mod mouth;
mod window;

use super::gather::{Instant, Rest, Seen, gathered};
use super::measure::{Measures, Neutral};
use super::{GoOn, Options, Tracked, stopped};
use crate::calibration::{Calibration, Choice, Decomposition};
use crate::disk::{Fault, Result, Setting, message};
use crate::face::find::find;
use crate::face::{Face, FeaturePoint as P};
use crate::geometry::{Point, Similarity, Vec2};
use crate::media::{Frame, Source};
use crate::photo::Grey;
use crate::pose::Ratios;
use crate::ratios::MouthMoves;
use crate::track::TrackFault;
use eyes::Eyes;
use mouth::{Mouth, matched};

/// So many frames an old pair of eyes stands for a new one; then the face is searched for.
const KEPT: u32 = 5;
/// While it is lost it is searched for in every so many frames.
const EVERY: u32 = 5;
/// How sure what is found is: less than a fit that a model vouches for.
const SURE: f64 = 0.7;
/// The same where an old pair stands for a new one.
const UNSURE: f64 = 0.4;

/// Follows the eyes and the mouth of a face through a video by regions. The neutral face gives the first regions; where it
/// is another picture's, a face is searched for in the frame. `go_on` is told how many frames are done, of how many, and
/// may stop it.
///
/// # Errors
/// When the video cannot be read, no face is in it, or `go_on` says no.
pub fn by_regions(
    source: &Source,
    face: &Face,
    calibration: Option<&Calibration>,
    options: &Options,
    go_on: GoOn,
) -> Result<Tracked> {
    let teller = calibration.and_then(|c| Teller::of(c, options.choice));
    let mut watch = Watch { face, teller, regions: None, kept: 0, lost: 0 };
    let mut instants = Vec::new();
    for frame in source.frames()? {
        let Frame { number, time, grey, .. } = frame?;
        instants.push(Instant { frame: number, time, seen: watch.see(&grey) });
        if !go_on(instants.len(), source.count()) {
            return Err(stopped());
        }
    }
    let Some(rest) = Rest::of(&instants) else {
        return Err(Fault::of(TrackFault::NoFace, "no face is found in the video")
            .at(source.path())
            .help("is it seen from the front?"));
    };
    let mut tracked = gathered(&instants, &rest);
    tracked.notes.extend(source.notes().iter().map(|n| n.as_str().into()));
    tracked.notes.push(if watch.teller.is_some() {
        let seen = "by regions the ratios are told from eyes and mouth alone; brows are not seen: ";
        message![seen, Setting::Method.of("aam"), " sees them"]
    } else {
        "without a calibration regions tell no emotions: the ratios are neutral".into()
    });
    Ok(tracked)
}

struct Watch<'f> {
    face: &'f Face,
    teller: Option<Teller>,
    regions: Option<(Eyes, Mouth, [f64; 2])>,
    kept: u32,
    lost: u32,
}

impl Watch<'_> {
    fn see(&mut self, grey: &Grey) -> Option<Seen> {
        if let Some((eyes, _, _)) = &mut self.regions {
            self.kept = if eyes.follow(grey) { 0 } else { self.kept + 1 };
            if self.kept > KEPT {
                self.regions = None;
            }
        }
        if self.regions.is_none() {
            let due = self.lost.is_multiple_of(EVERY);
            self.lost += 1;
            self.regions = due.then(|| self.begun(grey)).flatten();
            self.kept = 0;
        }
        let (eyes, mouth, heights) = self.regions.as_mut()?;
        self.lost = 0;
        let (left, right) = (eyes.balls.left.centre, eyes.balls.right.centre);
        let frame = frame_of(left, right)?;
        let moves = mouth.follow(grey, &frame);
        let open: [f64; 2] = std::array::from_fn(|k| eyes.heights[k] / frame.scale() / heights[k]);
        // The eyeball against its region's box, in eye heights: the box is as wide as the opening.
        let iris = [eyes.balls.left, eyes.balls.right]
            .iter()
            .zip(&eyes.boxes)
            .zip(*heights)
            .fold(Vec2::ZERO, |sum, ((ball, b), h)| sum + (ball.centre - b.centre()) / (h * frame.scale()) * 0.5);
        let mouth = moves.map_or_else(MouthMoves::default, |m| matched(&m));
        let measures = Measures {
            place: frame.origin,
            pupils: frame.scale(),
            roll: frame.angle().to_degrees(),
            yaw: 0.0,
            open,
            mouth,
            eyes: [[Point::ORIGIN; 4]; 2],
        };
        let ratios = self.teller.as_ref().map_or(Ratios::NEUTRAL, |t| t.tell(open, &mouth));
        let confidence = if self.kept == 0 && moves.is_some() { SURE } else { UNSURE };
        Some(Seen { ratios, confidence, measures, iris: (open[0].min(open[1]) > 0.5).then_some(iris) })
    }

    /// The first regions: where the neutral face has them if it is this picture, else where a face is found.
    fn begun(&self, grey: &Grey) -> Option<(Eyes, Mouth, [f64; 2])> {
        let found = find(&grey.to_photo(), &[]).ok();
        let own = |p: P| self.face.points[p.index()].at;
        let pupils = own(P::P3_6).distance(own(P::P3_5));
        // The thesis's first frame is the neutral photo. Where a face is found in the same place, that one's points, which a
        // hand may have set, are the better ones; of another photo they say nothing.
        let here = self.face.photo.size == [grey.width() as u32, grey.height() as u32]
            && found.as_ref().is_some_and(|f| f.points[P::P3_6.index()].at.distance(own(P::P3_6)) < 0.05 * pupils);
        let points = if here { &self.face.points } else { &found.as_ref()?.points };
        let at = |p: P| points[p.index()].at;
        let eyes = Eyes::reserved(grey, at(P::P3_6), at(P::P3_5))?;
        let frame = frame_of(eyes.balls.left.centre, eyes.balls.right.centre)?;
        let marks = [P::P8_4, P::P8_3, P::P8_1, P::P8_2, P::P9_15].map(|p| frame.undo(at(p)));
        let mouth = Mouth::reserved(grey, &frame, marks)?;
        let heights = eyes.heights.map(|h| (h / frame.scale()).clamp(0.03, 0.25));
        Some((eyes, mouth, heights))
    }
}

/// The frame of two eyes: their distance 1, the origin midway.
fn frame_of(left: Point, right: Point) -> Option<Similarity> {
    let across = right - left;
    (across.hypot() > 2.0).then(|| Similarity::spanning(left, right))
}

/// Tells ratios from six numbers, as eq. 6 does from all points.
struct Teller {
    decomposition: Decomposition,
    choice: Choice,
}

impl Teller {
    /// None where the seven shapes are alike in eyes and mouth.
    fn of(calibration: &Calibration, choice: Choice) -> Option<Self> {
        let neutral = Neutral::of(calibration).ok()?;
        let mut shapes: [Vec<Point>; 7] = Default::default();
        for (to, shape) in shapes.iter_mut().zip(calibration.shapes()) {
            let m = neutral.measure(&shape.points)?;
            *to = numbers(m.open, &m.mouth);
        }
        Some(Self { decomposition: Decomposition::new(&shapes).ok()?, choice })
    }

    fn tell(&self, open: [f64; 2], mouth: &MouthMoves) -> Ratios {
        self.decomposition.read(&numbers(open, mouth), self.choice).ratios
    }
}

/// Openings of eyes and mouth and the mouth's width, as two points would be: six numbers for six emotions leave nothing to
/// average, so both sides are taken together.
fn numbers([left, right]: [f64; 2], mouth: &MouthMoves) -> Vec<Point> {
    vec![
        Point::new(f64::midpoint(left, right), mouth.up),
        Point::new(mouth.down, 3.0 * f64::midpoint(mouth.left, mouth.right)),
    ]
}
