//! What the man feels, looks at and does while he speaks.

use lianpu::pose::{Emotion, Ratios};
use lianpu::timeline::Timeline;

use crate::act::Act;
use crate::studio::Pose;

pub const FPS: f64 = 25.0;
pub const DURATION: f64 = 3.0;

/// A frame of the clip.
pub struct Moment {
    pub ratios: Ratios,
    /// Emotion, speech, lids and gaze together.
    pub act: Act,
    pub held: Pose,
    /// How much of the mouth is speech's, 0 to 1.
    pub speaking: f64,
}

/// Which mixes are reached when; between two the face moves without a jerk.
const STATIONS: [(f64, f64, [f64; 7]); 7] = [
    //  from   to   neutral happy anger disgust sadness fear surprised
    (0.00, 0.12, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (0.46, 0.96, [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    (1.20, 1.36, [0.3, 0.4, 0.0, 0.0, 0.0, 0.0, 0.3]),
    (1.72, 1.80, [0.25, 0.15, 0.0, 0.0, 0.0, 0.0, 0.6]),
    (2.26, 2.36, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
    (2.62, 2.66, [0.15, 0.0, 0.0, 0.0, 0.45, 0.1, 0.3]),
    (2.88, 3.00, [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]),
];

/// When the eyes are shut, and how long a lid takes down and up.
const BLINKS: [f64; 2] = [0.30, 2.50];
const DOWN: f64 = 0.09;
const UP: f64 = 0.15;

/// Where the eyes look when: to the right and down, in units.
const GAZES: [(f64, f32, f32); 7] = [
    (0.0, 0.0, 0.0),
    (0.36, 0.0, 0.0),
    (0.44, 2.4, -0.4),
    (1.30, 2.4, -0.4),
    (1.38, 0.0, 0.0),
    (2.44, 0.0, 0.0),
    (2.56, -1.4, 0.6),
];

/// How the head is held when: x, y in units, roll in degrees.
const HEADS: [(f64, f32, f32, f32); 6] = [
    (0.0, 0.0, 0.0, 0.0),
    (0.55, 4.0, -2.5, 2.6),
    (1.15, 1.5, 3.5, 1.2),
    (1.85, -2.0, -1.0, -1.6),
    (2.35, -3.0, -5.0, -2.2),
    (3.0, -6.0, 6.0, -4.0),
];

/// No jerk at either end of the way.
fn eased(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * u * (u * (6.0 * u - 15.0) + 10.0)
}

fn ratios(t: f64) -> Ratios {
    let k = STATIONS.iter().rposition(|s| s.0 <= t).unwrap_or(0);
    let here = Ratios(STATIONS[k].2);
    match STATIONS.get(k + 1) {
        Some(next) => here.lerp(Ratios(next.2), eased((t - STATIONS[k].1) / (next.0 - STATIONS[k].1))),
        None => here,
    }
}

fn closed(t: f64) -> f32 {
    let one = |at: f64| if t < at { eased(1.0 - (at - t) / DOWN) } else { eased(1.0 - (t - at) / UP) };
    BLINKS.iter().map(|at| one(*at)).fold(0.0, f64::max) as f32
}

/// Between the entries of a table by time.
fn between<const N: usize>(t: f64, rows: impl Iterator<Item = (f64, [f32; N])>) -> [f32; N] {
    let rows: Vec<_> = rows.collect();
    let k = rows.iter().rposition(|r| r.0 <= t).unwrap_or(0);
    let (from, here) = rows[k];
    let Some(&(to, next)) = rows.get(k + 1) else { return here };
    let u = eased((t - from) / (to - from)) as f32;
    std::array::from_fn(|i| here[i] + (next[i] - here[i]) * u)
}

/// How the head is held in a calibration shot: nobody holds still.
pub fn still(emotion: Emotion) -> Pose {
    let [x, y, roll] = [
        [0.0, 0.0, 0.0],
        [2.0, -1.0, 1.5],
        [-1.0, 2.0, 0.5],
        [-3.0, 1.0, -2.0],
        [1.0, 3.0, -1.5],
        [0.0, -3.0, 1.0],
        [1.0, -3.0, -0.5],
    ][emotion.index()];
    Pose { x, y, roll }
}

impl Moment {
    pub fn at(timeline: &Timeline, frame: usize) -> Moment {
        let t = frame as f64 / FPS;
        let ratios = ratios(t);
        let mut act = Act::mixed(&ratios.0);
        act.closed = closed(t);
        let [x, y] = between(t, GAZES.iter().map(|g| (g.0, [g.1, g.2])));
        act.gaze_x += x;
        act.gaze_y += y;
        let (mouth, _) = timeline.mouth(t);
        speak(&mut act, &mouth);
        let [x, y, roll] = between(t, HEADS.iter().map(|h| (h.0, [h.1, h.2, h.3])));
        Moment { ratios, act, held: Pose { x, y, roll }, speaking: mouth.speaking }
    }
}

/// Units of the mouth's moves in this figure: M is the way from nose to lip, MW0 the mouth's width.
const M: f32 = 24.0;
const MW0: f32 = 76.0;
/// A person talks with less than the shapes as they are drawn.
const EASE: f32 = 0.62;

/// Lays the mouth of speech over the emotion's: its opening shrinks while speech has the mouth, and where lips must meet they
/// do.
fn speak(act: &mut Act, mouth: &lianpu::pose::MouthPose) {
    let n = |v: f64| v as f32;
    let keep = 1.0 - 0.55 * n(mouth.speaking);
    act.jaw = act.jaw * keep + EASE * M * 0.72 * n(mouth.lower).max(0.0);
    act.lower = act.lower * keep + EASE * M * 0.28 * n(mouth.lower).max(0.0);
    act.upper = act.upper * (1.0 - 0.35 * n(mouth.speaking)) + EASE * M * n(mouth.upper);
    act.corner_out -= EASE * MW0 * n(mouth.corner_in);
    act.corner_down += EASE * 0.6 * M * n(mouth.corner_down);
    act.pout += (3.0 * n(mouth.corner_in)).max(0.0);
    let met = n(mouth.closure * (1.0 - mouth.bite));
    // Lips that meet do so where the upper one is, a little lower.
    act.lower *= 1.0 - met;
    act.jaw *= 1.0 - met;
    act.upper *= 1.0 - met;
    act.bare *= 1.0 - met;
    act.press += 0.2 * met * (1.0 - act.press);
}
