//! Frames as a face tracker gives them, and what they become.

use super::blendshapes::{Reader, Shapes, value};
use crate::disk::Result;
use crate::geometry::Point;
use crate::pose::{Gaze, Head, Lids, Ratios};
use crate::ratios::{MouthMoves, Record, Row, TrackRow, Tracks, bridge_record, bridge_tracks};

/// One frame of somebody's tracker.
#[derive(Debug, Clone, Default)]
pub(super) struct Seen {
    pub frame: u32,
    /// Seconds.
    pub time: f64,
    /// 0 where no face was found.
    pub confidence: f64,
    pub shapes: Shapes,
    /// Where the eyes look, where it is said apart from the blendshapes.
    pub gaze: Option<Gaze>,
    /// Where the head is, not yet from rest: pupil distances and degrees.
    pub head: Option<Head>,
    /// Points of the face, in pixels or what is in proportion to them.
    pub points: Vec<Point>,
}

/// How far the iris goes at a full look, in eye heights: eyes are two and a half times as wide as high, and the iris of
/// a full look nearly reaches the corner.
const FULL_LOOK: [f64; 2] = [0.8, 0.45];
/// A lid is closed at so much of `eyeBlink`; many trackers never reach 1.
const CLOSED: f64 = 0.8;
/// At most so much of `eyeBlink` is an open eye's at rest.
const OPEN: f64 = 0.3;
/// What a jaw fully open moves the lips, in MNS0, and what full blendshapes move a corner outward, in MW0: from the mouth
/// shapes of speech, whose *a* has half an open jaw (1.3 MNS0) and whose *u* has full pucker (0.22 MW0).
const JAW: f64 = 2.2;
const LOWER_LIP: f64 = 0.6;
const UPPER_LIP: f64 = 0.5;
const OUTWARD: [(&str, f64); 5] = [
    ("mouthsmile", 0.14),
    ("mouthstretch", 0.16),
    ("mouthdimple", 0.08),
    ("mouthpucker", -0.22),
    ("mouthfunnel", -0.12),
];

/// Ratios by blendshapes.
pub(super) fn by_blendshapes(frames: &[Seen], notes: &mut Vec<String>) -> Result<Record> {
    let reader = Reader::of(frames.iter().filter(|f| f.confidence > 0.0).map(|f| &f.shapes))?;
    if !reader.unseen.is_empty() {
        notes.push(format!("no frame tells {}: read without", reader.unseen.join(", ")));
    }
    notes.push("the ratios follow a table of typical blendshapes, not this person's calibration".to_owned());
    Ok(record(frames, |f| reader.ratios(&f.shapes)))
}

/// Rows of what each frame that was found shows; the others are bridged.
pub(super) fn record(frames: &[Seen], ratios: impl Fn(&Seen) -> Ratios) -> Record {
    let row = |f: &Seen| {
        let ratios = if f.confidence > 0.0 { ratios(f) } else { Ratios::NEUTRAL };
        Row { frame: f.frame, time: f.time, ratios, confidence: f.confidence }
    };
    let mut record = Record { rows: frames.iter().map(row).collect() };
    bridge_record(&mut record);
    record
}

/// Eyes, mouth and head by blendshapes; none where no frame has any of them.
pub(super) fn tracks(frames: &[Seen]) -> Option<Tracks> {
    let found = || frames.iter().filter(|f| f.confidence > 0.0);
    if !found().any(|f| !f.shapes.is_empty() || f.head.is_some() || f.gaze.is_some()) {
        return None;
    }
    let open = ["left", "right"].map(|side| {
        let name = if found().any(|f| f.shapes.contains_key("eyeblink")) {
            "eyeblink".to_owned()
        } else {
            format!("eyeblink{side}")
        };
        let rest = median(found().map(|f| value(&f.shapes, &name)).collect()).min(OPEN);
        move |f: &Seen| 1.0 - ((value(&f.shapes, &name) - rest) / (CLOSED - rest)).clamp(0.0, 1.0)
    });
    let rest = Head {
        x: median(found().filter_map(|f| f.head).map(|h| h.x).collect()),
        y: median(found().filter_map(|f| f.head).map(|h| h.y).collect()),
        roll: median(found().filter_map(|f| f.head).map(|h| h.roll).collect()),
    };
    let row = |f: &Seen| {
        let [subject_left, subject_right] = [open[0](f), open[1](f)];
        let head = f.head.unwrap_or(rest);
        TrackRow {
            frame: f.frame,
            time: f.time,
            gaze: f.gaze.unwrap_or_else(|| gaze(&f.shapes)),
            // A person's left is at the image's right.
            lids: Lids { left: subject_right, right: subject_left },
            mouth: mouth(&f.shapes),
            head: Head { x: head.x - rest.x, y: head.y - rest.y, roll: head.roll - rest.roll },
            confidence: f.confidence,
        }
    };
    let mut tracks = Tracks { rows: frames.iter().map(row).collect() };
    bridge_tracks(&mut tracks);
    Some(tracks)
}

fn gaze(shapes: &Shapes) -> Gaze {
    let of = |name: &str| shapes.get(name).copied().unwrap_or(0.0);
    // The person's left is the image's right: the left eye looks there outward, the right one inward.
    let x = of("eyelookoutleft") + of("eyelookinright") - of("eyelookinleft") - of("eyelookoutright");
    let y = of("eyelookdownleft") + of("eyelookdownright") - of("eyelookupleft") - of("eyelookupright");
    Gaze { x: FULL_LOOK[0] * x / 2.0, y: FULL_LOOK[1] * y / 2.0 }
}

fn mouth(shapes: &Shapes) -> MouthMoves {
    let of = |name: &str| value(shapes, name);
    // ARKit's mouthClose is how far closed lips make up for an open jaw.
    let jaw = (of("jawopen") - of("mouthclose")).max(0.0);
    let up = (UPPER_LIP * of("mouthupperup") + 0.15 * JAW * jaw).max(0.0);
    let down = (LOWER_LIP * of("mouthlowerdown") + JAW * jaw).max(0.0);
    let outward = |side: &str| {
        let of = |name: &str| {
            let own = shapes.get(&format!("{name}{side}")).copied();
            own.unwrap_or_else(|| value(shapes, name))
        };
        OUTWARD.iter().map(|(name, by)| by * of(name)).sum::<f64>()
    };
    MouthMoves { up, down, left: outward("right"), right: outward("left") }
}

/// The middle value; 0 of none.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
