//! What a face does in every frame, as a table: for other programs, and for checking a lesson without looking at it.

use crate::pose::Emotion;
use crate::ratios::decimal;
use crate::timeline::Timeline;

/// The columns beside those of the seven ratios.
const BEFORE: [&str; 5] = ["frame", "time", "shape", "opening", "width"];
const AFTER: [&str; 7] = ["lid_left", "lid_right", "gaze_x", "gaze_y", "head_x", "head_y", "head_roll"];

/// A line of column names, then a line a frame.
///
/// `time` is in seconds; `shape` one of the nine, empty at rest; `opening` how far speech parts the lips, in MNS0
/// (the distance from nose to upper lip of the neutral face), 0 when they are closed; `width` that of the mouth as speech
/// shapes it, in MW0 (that of the neutral mouth). Lids are 1 open to 0 closed, gaze in eye heights, the head in pupil
/// distances and degrees. What the emotion adds to a mouth is a matter of the face, and not in it.
pub(crate) fn to_csv(timeline: &Timeline, frames: &[u32]) -> String {
    let emotions = Emotion::ALL.map(Emotion::name);
    let names: Vec<&str> = BEFORE.into_iter().chain(emotions).chain(AFTER).collect();
    let mut out = names.join(",");
    out.push('\n');
    for frame in frames {
        let time = timeline.time_of(*frame);
        let pose = timeline.pose(time);
        let (g, l, h) = (pose.gaze, pose.lids, pose.head);
        let shape = pose.shape.map(|s| s.to_string()).unwrap_or_default();
        let mouth = [pose.mouth.opening(), 1.0 - 2.0 * pose.mouth.corner_in];
        let after = [l.left, l.right, g.x, g.y, h.x, h.y, h.roll];
        let mut cells = vec![frame.to_string(), decimal(time, 6), shape];
        cells.extend(mouth.iter().map(|v| decimal(*v, 4)));
        // Digits enough that each row sums to 1 within 1e-9.
        cells.extend(Emotion::ALL.iter().map(|e| decimal(pose.ratios[*e], 10)));
        cells.extend(after.iter().map(|v| decimal(*v, 4)));
        out.push_str(&cells.join(","));
        out.push('\n');
    }
    out
}
