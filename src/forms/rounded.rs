//! Poses in steps that nobody can see, so that equal frames have equal poses.

use crate::pose::{Gaze, Head, Lids, MouthPose, Pose, Ratios};

/// Parts of a unit that a pose is told in where frames are made: a step moves nothing by more than a hundredth of a
/// pixel, and two instants of the same movement become equal whatever the last digits of their times.
const PARTS: f64 = 8192.0;

/// The pose as frames show it.
pub(crate) fn rounded(pose: &Pose) -> Pose {
    let r = |v: f64| (v * PARTS).round() / PARTS + 0.0;
    let mut ratios = Ratios(pose.ratios.0.map(r));
    if (pose.ratios.sum() - 1.0).abs() < 1e-6 {
        ratios = ratios.closed();
    }
    Pose {
        ratios,
        mouth: MouthPose::from_array(pose.mouth.to_array().map(r)),
        shape: pose.shape,
        gaze: Gaze { x: r(pose.gaze.x), y: r(pose.gaze.y) },
        lids: Lids { left: r(pose.lids.left), right: r(pose.lids.right) },
        head: Head { x: r(pose.head.x), y: r(pose.head.y), roll: r(pose.head.roll) },
    }
}
