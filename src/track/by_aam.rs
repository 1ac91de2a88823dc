//! A video by active appearance model (paper sec. 3).

use super::follow::Follower;
use super::gather::{Instant, Rest, Seen, gathered, step};
use super::gaze::iris;
use super::measure::Neutral;
use super::said::ranges;
use super::{GoOn, Options, TrackFault, Tracked, stopped};
use crate::aam::{Fit, Model};
use crate::calibration::Calibration;
use crate::disk::{Fault, Message, Result};
use crate::geometry::Vec2;
use crate::media::{Frame, Source};
use crate::photo::Grey;

/// Below this opening an eye is too narrow for its iris to be seen.
const OPEN_TO_LOOK: f64 = 0.45;
/// A head that is turned by more degrees beyond what the calibration's shots show is said to be.
const BEYOND: f64 = 10.0;

/// Follows the face of a calibration through a video: its ratios (eq. 6), gaze, lids, mouth and head in every frame.
/// `go_on` is told how many frames are done, of how many, and may stop it.
///
/// # Errors
/// When the model and the calibration have different points, the video cannot be read, the face is in none of its
/// frames, or `go_on` says no.
pub fn by_aam(
    source: &Source,
    model: &Model,
    calibration: &Calibration,
    options: &Options,
    go_on: GoOn,
) -> Result<Tracked> {
    let mut eye = Watcher::new(model, calibration, options)?;
    let mut instants = Vec::new();
    for frame in source.frames()? {
        let Frame { number, time, grey, .. } = frame?;
        instants.push(Instant { frame: number, time, seen: eye.see(&grey) });
        if !go_on(instants.len(), source.count()) {
            return Err(stopped());
        }
    }
    let Some(rest) = Rest::of(&instants) else {
        let seen = if instants.is_empty() { "the video has no frames" } else { "the calibrated face is in no frame" };
        return Err(Fault::of(TrackFault::NoFace, seen).at(source.path()).help(
            "is it a video of the same person, seen from the front? a calibration from its own frames fits best",
        ));
    };
    let mut tracked = gathered(&instants, &rest);
    tracked.notes.extend(source.notes().iter().map(|n| n.as_str().into()));
    tracked.notes.extend(eye.turned(&instants).map(Message::from));
    Ok(tracked)
}

/// Sees one frame after the other.
#[derive(Debug, Clone)]
pub(super) struct Watcher<'m> {
    follower: Follower<'m>,
    calibration: &'m Calibration,
    neutral: Neutral<'m>,
    options: Options,
}

impl<'m> Watcher<'m> {
    pub(crate) fn new(model: &'m Model, calibration: &'m Calibration, options: &Options) -> Result<Self> {
        let (points, shapes) = (model.count(), calibration.binding().count());
        if points != shapes {
            return Err(Fault::new(format!("the model has {points} points and the calibration {shapes}"))
                .help("calibrate the face anew, so that they belong together"));
        }
        let neutral = Neutral::of(calibration)?;
        Ok(Self { follower: Follower::new(model, calibration), calibration, neutral, options: *options })
    }

    /// What is seen of the face in the next frame; none where it is lost.
    pub(crate) fn see(&mut self, grey: &Grey) -> Option<Seen> {
        let fit = self.follower.next(grey)?;
        let Fit { points, confidence, .. } = fit;
        let reading = if self.options.apart {
            self.calibration.read_apart(points, self.options.choice)?
        } else {
            self.calibration.read(points, self.options.choice)?
        };
        let measures = self.neutral.measure(points)?;
        let (mut sum, mut count) = (Vec2::ZERO, 0.0);
        let turn = measures.roll.to_radians();
        for (side, eye) in measures.eyes.iter().enumerate() {
            if measures.open[side] < OPEN_TO_LOOK {
                continue;
            }
            let Some(at) = iris(grey, *eye) else { continue };
            let v = (at - eye[0].midpoint(eye[1])) / (self.neutral.eyes[side] * measures.pupils);
            // Upright with the head.
            sum += Vec2::new(turn.cos() * v.x + turn.sin() * v.y, turn.cos() * v.y - turn.sin() * v.x);
            count += 1.0;
        }
        let iris = (count > 0.0).then(|| sum / count);
        Some(Seen { ratios: reading.ratios, confidence: *confidence, measures, iris })
    }

    /// What there is to say of a head that is turned farther than in any shot.
    fn turned(&self, instants: &[Instant]) -> Option<String> {
        let shots = self.calibration.shapes().iter().filter_map(|s| Some(self.neutral.measure(&s.points)?.yaw));
        let (low, high) = shots.fold((0.0_f64, 0.0_f64), |(low, high), yaw| (low.min(yaw), high.max(yaw)));
        let beyond = |i: &&Instant| i.seen.is_some_and(|s| !(low - BEYOND..=high + BEYOND).contains(&s.measures.yaw));
        let times: Vec<f64> = instants.iter().filter(beyond).map(|i| i.time).collect();
        (!times.is_empty()).then(|| {
            let when = ranges(&times, step(instants));
            format!("the head is turned farther than in any shot, so what is seen there is less sure: {when}")
        })
    }
}
