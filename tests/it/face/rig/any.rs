//! Any pose of any face, and every measured face in every emotion and shape: nothing crosses, lips close that have to.

use lianpu::face::rig::{Neutral, Proportions};
use lianpu::face::{FeaturePoint as P, Points};
use lianpu::pose::{Emotion, Gaze, Head, Lids, MouthPose, MouthShape, Pose, Ratios};
use proptest::prelude::*;

use super::{PRESETS, average, average_face, felt, measured, says, sound, unit};

fn any_ratios() -> impl Strategy<Value = Ratios> {
    let usual = prop::array::uniform7(-0.5..1.5f64);
    let wild = prop::array::uniform7(prop::num::f64::NORMAL | prop::num::f64::ZERO);
    prop_oneof![3 => usual, 1 => wild].prop_map(Ratios)
}

fn any_mouth() -> impl Strategy<Value = MouthPose> {
    let spoken = (0..9usize, 0..9usize, 0.0..1.0f64, any::<bool>()).prop_map(|(a, b, t, thesis)| {
        let preset = PRESETS[usize::from(thesis)];
        MouthPose::of(MouthShape::ALL[a], preset).lerp(&MouthPose::of(MouthShape::ALL[b], preset), t)
    });
    let usual = prop::collection::vec(-1.5..1.5f64, 11);
    let wild = prop::collection::vec(prop::num::f64::NORMAL | prop::num::f64::ZERO, 11);
    let any = prop_oneof![usual, wild].prop_map(|v| MouthPose::from_array(v.try_into().unwrap()));
    prop_oneof![Just(MouthPose::REST), spoken, any]
}

fn any_pose() -> impl Strategy<Value = Pose> {
    let far = || prop_oneof![4 => -2.0..2.0f64, 1 => prop::num::f64::NORMAL];
    (any_ratios(), any_mouth(), [far(), far()], [far(), far()], [far(), far(), far()]).prop_map(
        |(ratios, mouth, [x, y], [left, right], [hx, hy, roll])| Pose {
            ratios,
            mouth,
            shape: None,
            gaze: Gaze { x, y },
            lids: Lids { left, right },
            head: Head { x: hx, y: hy, roll },
        },
    )
}

/// The average with every point moved by up to `by`.
fn any_face(by: f64) -> impl Strategy<Value = Points> {
    prop::collection::vec((-by..by, -by..by), P::FIXED).prop_map(|moves| {
        let mut points = average_face::points();
        for (p, (x, y)) in points.0.iter_mut().zip(moves) {
            *p += lianpu::geometry::Vec2::new(x, y);
        }
        points
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn any_pose_of_any_face_is_finite_and_nothing_crosses(points in any_face(8.0), pose in any_pose(), cute: bool) {
        let proportions = if cute { Proportions::CUTE } else { Proportions::NORMAL };
        let neutral = Neutral::of(&points, &proportions);
        let held = sound(&neutral, &neutral.pose(&pose));
        prop_assert!(held.is_ok(), "{held:?}");
    }

    #[test]
    fn points_that_no_face_has_still_make_one(points in any_face(120.0), pose in any_pose()) {
        let neutral = Neutral::of(&points, &Proportions::NORMAL);
        let held = sound(&neutral, &neutral.pose(&pose));
        prop_assert!(held.is_ok(), "{held:?}");
    }

    #[test]
    fn lips_close_for_m_b_p_and_f_whatever_is_felt(ratios in any_ratios(), points in any_face(5.0), shape in 0..2usize) {
        let neutral = Neutral::of(&points, &Proportions::NORMAL);
        for preset in PRESETS {
            let mouth = MouthPose::of(MouthShape::ALL[shape], preset);
            let open = neutral.pose(&Pose { mouth, ..Pose::of(ratios) }).mouth.opening();
            prop_assert!(open < 0.03 * unit(&neutral), "{open}");
        }
    }

    #[test]
    fn a_small_change_of_the_ratios_is_a_small_change_of_the_face(
        ratios in prop::array::uniform7(-0.3..1.0f64),
        which in 1..7usize,
    ) {
        let neutral = average();
        let mut other = ratios;
        other[which] += 0.01;
        let (a, b) = (neutral.pose(&Pose::of(Ratios(ratios))), neutral.pose(&Pose::of(Ratios(other))));
        for p in P::fixed() {
            let step = a.points[p].distance(b.points[p]);
            prop_assert!(step < 1.0, "{p} by {step}");
        }
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn every_measured_face_holds_in_every_emotion_and_shape() {
    let mut held = 0;
    for (name, points) in measured() {
        for proportions in [Proportions::NORMAL, Proportions::CUTE] {
            let neutral = Neutral::of(&points, &proportions);
            for emotion in Emotion::ALL {
                for preset in PRESETS {
                    for shape in MouthShape::ALL {
                        let face = neutral.pose(&says(shape, preset, emotion));
                        sound(&neutral, &face).unwrap_or_else(|e| panic!("{name} {emotion} {shape} {preset:?}: {e}"));
                        if shape.closes() {
                            let open = face.mouth.opening() / unit(&neutral);
                            assert!(open < 0.03, "{name} {emotion} {shape} {preset:?}: {open}");
                        }
                        held += 1;
                    }
                }
                sound(&neutral, &neutral.pose(&felt(emotion))).unwrap_or_else(|e| panic!("{name} {emotion}: {e}"));
            }
        }
    }
    println!("{held} faces held");
}
