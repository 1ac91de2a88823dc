//! The mouth of a face: at rest, in the nine shapes, in every emotion, on its way from one to the next.

use lianpu::face::rig::{Neutral, Proportions};
use lianpu::face::{FeaturePoint as P, Points};
use lianpu::pose::{Emotion, MouthPose, MouthPreset, MouthShape, Pose, Ratios};

use super::{MOUTH, PRESETS, average, average_face, felt, measured, says, spoken, unit};

#[test]
fn at_rest_nothing_moves_and_the_mouth_is_closed() {
    let neutral = average();
    let face = neutral.pose(&Pose::default());
    for point in P::fixed() {
        let moved = face.points[point].distance(neutral.points()[point]);
        // An iris lies a little below the eyeball's middle, as drawn eyes do.
        assert!(moved < if point.part() == lianpu::face::Part::Eyes { 1.0 } else { 1e-9 }, "{point} by {moved}");
    }
    assert_eq!(face.mouth.gap(), 0.0);
    assert_eq!(face.points[P::P2_2], face.points[P::P2_3]);
}

#[test]
fn a_mouth_that_the_photo_shows_open_is_closed_at_rest() {
    let mut points = average_face::points();
    for p in [P::P2_3, P::P8_2] {
        points[p].y += 9.0;
    }
    let neutral = Neutral::of(&points, &Proportions::NORMAL);
    let (open, shut) = (average(), &neutral);
    assert_eq!(shut.pose(&Pose::default()).mouth.gap(), 0.0);
    let lower = |n: &Neutral| n.units().lower_lip_height;
    assert!((lower(&open) - lower(shut)).abs() < 1.0, "the lip keeps its thickness");
}

#[test]
fn the_right_peak_mirrors_the_left_one_about_the_mouth_s_own_axis() {
    for (name, points) in measured().into_iter().chain([("average".into(), average_face::points())]) {
        let neutral = Neutral::of(&points, &Proportions::NORMAL);
        for shape in MouthShape::ALL {
            let p = neutral.pose(&spoken(shape)).points;
            let axis = p[P::P8_4].x.midpoint(p[P::P8_3].x);
            assert!((p[P::P8_9].x + p[P::P8_10].x - 2.0 * axis).abs() < 1e-9, "{name} {shape}");
            assert!((p[P::P8_9].y - p[P::P8_10].y).abs() < 1e-9, "{name} {shape}");
            for middle in [P::P8_1, P::P2_2, P::P2_3, P::P8_2] {
                assert!((p[middle].x - axis).abs() < 1e-9, "{name} {shape} {middle}");
            }
        }
    }
}

#[test]
fn the_middle_of_the_upper_lip_keeps_its_place_below_the_peaks() {
    let neutral = average();
    let dip = |p: &Points| p[P::P8_1].y - p[P::P8_9].y;
    let rest = dip(neutral.points());
    for shape in MouthShape::ALL {
        let face = neutral.pose(&spoken(shape));
        let rounded = face.mouth.rounded;
        assert!((dip(&face.points) - rest * (1.0 - 0.5 * rounded)).abs() < 1e-9, "{shape}");
    }
}

#[test]
fn lips_thin_as_the_mouth_widens_and_thicken_as_it_narrows() {
    let neutral = average();
    let thickness = |corner_in: f64| {
        let mouth = MouthPose { corner_in, lower: 0.4, speaking: 1.0, ..MouthPose::REST };
        let p = neutral.pose(&Pose { mouth, ..Pose::default() }).points;
        (p[P::P2_2].y - p[P::P8_1].y, p[P::P8_2].y - p[P::P2_3].y)
    };
    let (wide, rest, narrow) = (thickness(-0.12), thickness(0.0), thickness(0.12));
    assert!(wide.0 < rest.0 && rest.0 < narrow.0, "{wide:?} {rest:?} {narrow:?}");
    assert!(wide.1 < rest.1 && rest.1 < narrow.1, "{wide:?} {rest:?} {narrow:?}");
    let units = neutral.units();
    assert!((rest.0 - units.upper_lip_height).abs() < 1e-9 && (rest.1 - units.lower_lip_height).abs() < 1e-9);
}

#[test]
fn the_chin_follows_the_lower_lip_the_jaw_a_little_and_neither_follows_the_upper_one() {
    let neutral = average();
    let moved = |mouth: MouthPose| {
        let p = neutral.pose(&Pose { mouth: MouthPose { speaking: 1.0, ..mouth }, ..Pose::default() }).points;
        let by = |point| p[point].y - neutral.points()[point].y;
        (by(P::P8_2), by(P::P2_1), by(P::P2_14), by(P::P2_13))
    };
    let (lip, chin, left, right) = moved(MouthPose { lower: 1.0, ..MouthPose::REST });
    assert!((lip - unit(&neutral)).abs() < 1e-9, "{lip}");
    assert!((chin - 0.85 * lip).abs() < 1e-9 && (left - 0.18 * lip).abs() < 1e-9 && left == right);
    let (lip, chin, ..) = moved(MouthPose { upper: -0.2, ..MouthPose::REST });
    assert!(lip.abs() < 1e-9 && chin.abs() < 1e-9, "{lip} {chin}");
}

#[test]
fn a_mouth_at_rest_shows_the_whole_emotion_and_a_speaking_one_its_corners() {
    let neutral = average();
    let (m, width) = (unit(&neutral), neutral.units().mouth_width);
    let happy = neutral.pose(&felt(Emotion::Happy)).mouth;
    assert!((happy.gap() - 0.52 * m).abs() < 1e-9);
    assert!((happy.width() - 1.26 * width).abs() < 1e-9);
    // Its neutral opening beside what is left of the emotion's upper lip: 0.45 × 0.10 M.
    let h = MouthPose::of(MouthShape::H, MouthPreset::Distinct);
    let speaking = neutral.pose(&says(MouthShape::H, MouthPreset::Distinct, Emotion::Happy)).mouth;
    assert!((speaking.gap() - (h.lower - h.upper + 0.045) * m).abs() < 1e-9);
    let corner = |e| neutral.pose(&says(MouthShape::H, MouthPreset::Distinct, e)).points[P::P8_3];
    let lifted = corner(Emotion::Neutral) - corner(Emotion::Happy);
    // h narrows a little, so a little of the corners gathers.
    assert!((0.6 * 0.4 * m * 0.9..=0.6 * 0.4 * m + 1e-9).contains(&lifted.y), "{}", lifted.y / m);
    assert!((-lifted.x - 0.6 * 0.13 * width).abs() < 1e-9);
}

#[test]
fn from_silence_to_speech_the_mouth_goes_without_a_jump() {
    let neutral = average();
    for emotion in Emotion::ALL {
        for shape in MouthShape::ALL {
            let to = MouthPose::of(shape, MouthPreset::Distinct);
            let at = |t: f64| {
                let mouth = MouthPose::REST.lerp(&to, t);
                neutral.pose(&Pose { mouth, ..felt(emotion) })
            };
            let mut before = at(0.0);
            for i in 1..=100 {
                let now = at(f64::from(i) / 100.0);
                for point in MOUTH {
                    let step = now.points[point].distance(before.points[point]);
                    assert!(step < 1.6, "{emotion} {shape}: {point} jumps {step}");
                }
                before = now;
            }
        }
    }
}

#[test]
fn the_nine_distinct_shapes_differ_pairwise_on_every_face() {
    // The farthest point of the mouth, its gap, and what fills it: 2.5 is the width of the face's ink.
    const LEAST: f64 = 2.5;
    let mut least = (f64::INFINITY, String::new());
    for (name, points) in measured().into_iter().chain([("average".into(), average_face::points())]) {
        let neutral = Neutral::of(&points, &Proportions::NORMAL);
        for (i, a) in MouthShape::ALL.into_iter().enumerate() {
            for b in &MouthShape::ALL[i + 1..] {
                let (p, q) = (neutral.pose(&spoken(a)), neutral.pose(&spoken(*b)));
                let apart = MOUTH.iter().map(|m| p.points[*m].distance(q.points[*m])).fold(0.0, f64::max);
                if apart < least.0 {
                    least = (apart, format!("{a} and {b} of {name}"));
                }
            }
        }
    }
    println!("least apart: {:.2} {}", least.0, least.1);
    assert!(least.0 > LEAST, "{least:?}");
}

#[test]
fn openings_are_in_the_order_that_ears_expect() {
    use MouthShape::*;
    for preset in PRESETS {
        let neutral = average();
        let opening = |s| neutral.pose(&says(s, preset, Emotion::Neutral)).mouth.opening();
        assert!(opening(A) > opening(O) && opening(O) > opening(H) && opening(E) > opening(I), "{preset:?}");
        assert!(opening(I) > 2.0 && opening(M) == 0.0 && opening(F) < 1e-9, "{preset:?}");
    }
    let neutral = average();
    let mouth = |s| neutral.pose(&spoken(s)).mouth;
    assert!(mouth(U).rounded > 0.9 && mouth(O).rounded > 0.7 && mouth(I).rounded == 0.0);
    let open_width = |s: MouthShape| mouth(s).upper_inner[3].p3.x - mouth(s).upper_inner[0].p0.x;
    assert!(open_width(U) < 3.5 * mouth(U).gap() && open_width(I) > 6.0 * mouth(I).gap(), "u is round, i is not");
}

#[test]
fn f_shows_the_teeth_on_the_lower_lip_in_every_emotion() {
    let neutral = average();
    for emotion in Emotion::ALL {
        let mouth = neutral.pose(&says(MouthShape::F, MouthPreset::Distinct, emotion)).mouth;
        assert_eq!(mouth.bite, 1.0);
        let teeth = mouth.gap() / unit(&neutral);
        assert!((0.10..0.26).contains(&teeth), "{emotion} {teeth}");
    }
}

#[test]
fn a_happy_face_that_says_mama_closes_its_lips_in_a_frame_for_every_m() {
    use lianpu::timeline::{Key, KeyValue, Score, Sources, Spoken, Timeline};
    let neutral = average();
    let shapes = vec![(0.0, MouthShape::M), (0.464, MouthShape::A)];
    let starts = [0.4, 0.62, 0.84];
    let spoken = starts.map(|start| Spoken { start, end: start + 0.22, shapes: shapes.clone(), exact: false });
    for emotion in Emotion::ALL {
        let mut score = Score::default();
        score.keys.push(Key::new(0.0, KeyValue::Emotion(Ratios::pure(emotion))));
        let (record, tracks, mouths) = (None, None, MouthPreset::Distinct);
        let line = Timeline::build(&Sources {
            duration: 1.6,
            fps: 25.0,
            spoken: &spoken,
            record,
            tracks,
            score: &score,
            mouths,
        });
        let opening = |t: f64| neutral.pose(&line.pose(t)).mouth.opening() / unit(&neutral);
        let frames: Vec<f64> = (0..line.frames()).map(|k| line.time_of(k)).collect();
        for start in starts {
            let near = |reach: f64| frames.iter().filter(move |t| (*t - start).abs() <= reach).map(|t| opening(*t));
            assert!(near(0.041).any(|o| o < 0.03), "{emotion} at {start}");
            let after = frames.iter().filter(|t| (start + 0.1..start + 0.2).contains(*t)).map(|t| opening(*t));
            assert!(after.fold(0.0, f64::max) > 0.5, "{emotion} opens after {start}");
        }
    }
}

#[test]
fn a_mouth_that_was_measured_is_drawn_as_measured_whatever_the_emotion_opens() {
    let neutral = average();
    let m = unit(&neutral);
    for emotion in Emotion::ALL {
        for (upper, lower, corner_in) in [(0.0, 0.0, 0.0), (-0.1, 0.5, 0.05), (-0.2, 1.1, -0.1)] {
            let mouth = MouthPose { upper, lower, corner_in, speaking: 2.0, ..MouthPose::REST };
            let drawn = neutral.pose(&Pose { mouth, ..felt(emotion) }).mouth;
            assert!(
                (drawn.gap() - (lower - upper) * m).abs() < 1e-9,
                "{emotion:?}: {} {}",
                drawn.gap(),
                (lower - upper) * m
            );
        }
    }
}
