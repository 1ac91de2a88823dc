//! Ratios: exact on what is exact, near under noise, and what speech does to them; and smoothing that keeps movement.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::average_face;
use lianpu::calibration::{Binding, Choice, Decomposition};
use lianpu::face::rig::{Neutral, Proportions};
use lianpu::geometry::{Point, Similarity, Vec2};
use lianpu::pose::{Emotion, Gaze, Head, Lids, MouthPose, MouthPreset, MouthShape, Pose, Ratios};
use lianpu::ratios::{
    Moment, MouthMoves, Record, Row, SMOOTH_WIDTH, Steady, TrackRow, Tracks, smooth_record, smooth_tracks,
};

use crate::support::chance::Chance;

/// The average face's own 41 points in a pose, pupil distance 1.
struct Face(Neutral);

impl Face {
    fn new() -> Self {
        Self(Neutral::of(&average_face::points(), &Proportions::NORMAL))
    }

    fn shape(&self, pose: &Pose) -> Vec<Point> {
        let points = self.0.pose(pose).points;
        Binding::own_points().map(|p| Point::new(points[p].x / 100.0, points[p].y / 100.0)).collect()
    }

    fn neutral(&self) -> Vec<Point> {
        self.shape(&Pose::default())
    }

    /// A shape laid over the neutral one, as a calibration lays it.
    fn laid(&self, shape: &[Point]) -> Vec<Point> {
        let q = Similarity::between(shape, &self.neutral()).unwrap();
        shape.iter().map(|p| q.apply(*p)).collect()
    }

    fn decomposition(&self) -> Decomposition {
        Decomposition::new(&Emotion::ALL.map(|e| self.laid(&self.shape(&Pose::of(Ratios::pure(e)))))).unwrap()
    }

    /// The nine mouth shapes and a blink, laid.
    fn speech(&self) -> Vec<Vec<Point>> {
        let said = MouthShape::ALL.map(|s| Pose { mouth: MouthPose::of(s, MouthPreset::default()), ..Pose::default() });
        let blink = Pose { lids: Lids { left: 0.0, right: 0.0 }, ..Pose::default() };
        said.iter().chain([&blink]).map(|pose| self.laid(&self.shape(pose))).collect()
    }

    /// The sum of the seven shapes, as eq. 6 has it.
    fn mix(&self, ratios: &Ratios) -> Vec<Point> {
        let shapes = Emotion::ALL.map(|e| self.laid(&self.shape(&Pose::of(Ratios::pure(e)))));
        let at = |k: usize| {
            let sum = shapes.iter().zip(ratios.0).fold(Vec2::ZERO, |s, (shape, r)| s + shape[k].to_vec2() * r);
            sum.to_point()
        };
        (0..shapes[0].len()).map(at).collect()
    }
}

/// Mixes that a face can show: two or three emotions and neutral.
fn some_mix(chance: &mut Chance) -> Ratios {
    let mut ratios = [0.0; 7];
    let mut left = 1.0;
    for _ in 0..2 + (chance.next() * 2.0) as usize {
        let share = left * chance.next();
        ratios[1 + (chance.next() * 6.0) as usize] += share;
        left -= share;
    }
    Ratios(ratios).closed()
}

fn noisy(shape: &[Point], by: f64, chance: &mut Chance) -> Vec<Point> {
    shape.iter().map(|p| *p + Vec2::new(by * chance.normal(), by * chance.normal())).collect()
}

fn mean_error(a: &Ratios, b: &Ratios) -> f64 {
    a.0.iter().zip(b.0).map(|(a, b)| (a - b).abs()).sum::<f64>() / 7.0
}

#[test]
fn pure_and_mixed_shapes_are_read_exactly_in_every_way_of_reading() {
    let face = Face::new();
    let plain = face.decomposition();
    println!("condition {:.1}; hardest to tell apart: {:.1?}", plain.condition(), &plain.alike()[..3]);
    println!("amplification {:.2?}", plain.amplification());
    let weights: Vec<f64> = (0..41).map(|i| 1.0 + f64::from(i % 3)).collect();
    let apart = plain.apart_from(&face.speech(), 0.02).unwrap();
    println!("told apart from speech: condition {:.1}, amplification {:.2?}", apart.condition(), apart.amplification());
    let mut chance = Chance(3);
    for way in [&plain, &plain.weighed(&weights).unwrap(), &apart] {
        for choice in [Choice::Paper, Choice::NonNegative] {
            let pure = Emotion::ALL.map(Ratios::pure);
            for ratios in pure.into_iter().chain((0..50).map(|_| some_mix(&mut chance))) {
                let reading = way.read(&face.mix(&ratios), choice);
                let off = (0..7).map(|i| (reading.ratios.0[i] - ratios.0[i]).abs()).fold(0.0, f64::max);
                assert!(off < 1e-6 && reading.rest < 1e-6, "{ratios:?} {reading:?}");
                assert!((reading.ratios.sum() - 1.0).abs() <= 1e-9);
            }
        }
    }
    let overdrawn = Ratios([-0.2, 1.4, 0.0, -0.3, 0.0, 0.1, 0.0]);
    let reading = plain.read(&face.mix(&overdrawn), Choice::Paper).ratios;
    assert!(mean_error(&reading, &overdrawn) < 1e-9, "the paper keeps negative ratios: {reading:?}");
    let reading = plain.read(&face.mix(&overdrawn), Choice::NonNegative).ratios;
    assert!(reading.0.iter().all(|r| *r >= 0.0) && (reading.sum() - 1.0).abs() <= 1e-9);
    let nowhere = plain.read(&[Point::new(f64::NAN, 0.0); 41], Choice::NonNegative);
    assert_eq!((nowhere.ratios, nowhere.rest), (Ratios::NEUTRAL, f64::INFINITY));
}

#[test]
fn ratios_stay_near_under_noise() {
    let face = Face::new();
    let plain = face.decomposition();
    let apart = plain.apart_from(&face.speech(), 0.02).unwrap();
    let mut chance = Chance(1);
    for (name, way, choice) in [
        ("eq. 6", &plain, Choice::Paper),
        ("not negative", &plain, Choice::NonNegative),
        ("apart from speech", &apart, Choice::Paper),
        ("apart, not negative", &apart, Choice::NonNegative),
    ] {
        let mut errors = Vec::new();
        let mut smooth_errors = Vec::new();
        let mut live_errors = Vec::new();
        for _ in 0..12 {
            // Three seconds: from one mix to another and to a third.
            let keys = [(); 4].map(|()| some_mix(&mut chance));
            let truth = |i: usize| {
                let t = i as f64 / 75.0 * 3.0;
                let (k, t) = (t.floor().min(2.0) as usize, t - t.floor().min(2.0));
                keys[k].lerp(keys[k + 1], t * t * (3.0 - 2.0 * t))
            };
            let mut steady = Steady::new(SMOOTH_WIDTH);
            let mut record = Record::default();
            for i in 0..75 {
                let shape = face.laid(&noisy(&face.mix(&truth(i)), 0.02, &mut chance));
                let ratios = way.read(&shape, choice).ratios;
                let row = Row { frame: i as u32, time: i as f64 / 25.0, ratios, confidence: 1.0 };
                errors.push(mean_error(&ratios, &truth(i)));
                live_errors.push(mean_error(&steady.push(&Moment { row, track: None }).row.ratios, &truth(i)));
                record.rows.push(row);
            }
            smooth_record(&mut record, SMOOTH_WIDTH);
            smooth_errors.extend(record.rows.iter().enumerate().map(|(i, r)| mean_error(&r.ratios, &truth(i))));
        }
        let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
        println!(
            "2 % noise, {name}: mean error {:.4}; smoothed both ways {:.4}, live {:.4}",
            mean(&errors),
            mean(&smooth_errors),
            mean(&live_errors)
        );
        let most = if choice == Choice::NonNegative { mean(&errors) } else { mean(&smooth_errors) };
        assert!(std::ptr::eq(way, &apart) || most <= 0.06, "{most}");
        assert!(mean(&smooth_errors) < 0.75 * mean(&errors) && mean(&live_errors) < mean(&errors));
    }
}

#[test]
fn what_a_mouth_says_is_told_from_what_a_face_feels() {
    let face = Face::new();
    let plain = face.decomposition();
    for noise in [0.01, 0.02] {
        let apart = plain.apart_from(&face.speech(), noise).unwrap();
        for choice in [Choice::Paper, Choice::NonNegative] {
            let mut chance = Chance(5);
            let mut errors = [0.0; 4];
            let mut count = 0.0;
            for _ in 0..200 {
                let ratios = some_mix(&mut chance);
                let [a, b] = [(); 2].map(|()| MouthShape::ALL[(chance.next() * 9.0) as usize]);
                let said = |s| MouthPose::of(s, MouthPreset::default());
                let mouth = said(a).lerp(&said(b), chance.next());
                let lids = Lids { left: chance.next(), right: chance.next() };
                let shape = face.shape(&Pose { ratios, mouth, lids, ..Pose::default() });
                for (k, by) in [(0, 0.0), (2, 0.02)] {
                    let shape = face.laid(&noisy(&shape, by, &mut chance));
                    errors[k] += mean_error(&plain.read(&shape, choice).ratios, &ratios);
                    errors[k + 1] += mean_error(&apart.read(&shape, choice).ratios, &ratios);
                }
                count += 1.0;
            }
            println!(
                "noise {noise}, {choice:?}: speech alone {:.3} -> {:.3}; with 2 % noise {:.3} -> {:.3}",
                errors[0] / count,
                errors[1] / count,
                errors[2] / count,
                errors[3] / count
            );
            assert!(errors[1] < 0.3 * errors[0] && errors[3] < 0.6 * errors[2], "{errors:?}");
        }
    }
}

/// What becomes of a row of values by each way of smoothing: both ways, looking back.
fn smoothed(values: &[f64]) -> [Vec<f64>; 2] {
    let row = |(i, v): (usize, &f64)| TrackRow {
        frame: i as u32,
        time: i as f64 / 25.0,
        gaze: Gaze::default(),
        lids: Lids { left: *v, right: *v },
        mouth: MouthMoves { up: 0.0, down: *v, left: 0.0, right: 0.0 },
        head: Head::default(),
        confidence: 1.0,
    };
    let mut tracks = Tracks { rows: values.iter().enumerate().map(row).collect() };
    let mut steady = Steady::new(SMOOTH_WIDTH);
    let live = tracks.rows.iter().map(|t| {
        let row = Row { frame: t.frame, time: t.time, ratios: Ratios::NEUTRAL, confidence: 1.0 };
        steady.push(&Moment { row, track: Some(*t) }).track.unwrap().mouth.down
    });
    let live = live.collect();
    smooth_tracks(&mut tracks, SMOOTH_WIDTH);
    [tracks.rows.iter().map(|r| r.mouth.down).collect(), live]
}

#[test]
fn noise_goes_and_blinks_and_closures_stay() {
    let mut chance = Chance(11);
    const NOISE: f64 = 0.02;
    let noise: Vec<f64> = (0..500).map(|_| 0.5 + NOISE * chance.normal()).collect();
    let left = smoothed(&noise).map(|out| {
        let rms = |v: &[f64]| (v.iter().map(|x| (x - 0.5).powi(2)).sum::<f64>() / v.len() as f64).sqrt();
        rms(&out[50..]) / rms(&noise[50..])
    });
    println!("white noise brought down to {:.2} both ways, {:.2} live", left[0], left[1]);
    assert!(left[0] < 0.5 && left[1] < 0.5, "{left:?}");
    // A mouth half open that closes for two frames; eyes that close for three, at every place in the noise.
    for (name, shape) in [("closure", &[0.5, 0.5][..]), ("blink", &[0.3, 0.5, 0.25])] {
        let mut kept = [1.0_f64; 2];
        let mut mean = [0.0; 2];
        for at in (50..450).step_by(16) {
            let mut values = noise.clone();
            for (value, by) in values[at..].iter_mut().zip(shape) {
                *value -= by;
            }
            let deep = |v: &[f64]| 0.5 - v[at..at + shape.len()].iter().copied().fold(f64::MAX, f64::min);
            for (k, out) in smoothed(&values).iter().enumerate() {
                let share = deep(out) / deep(&values);
                kept[k] = kept[k].min(share);
                mean[k] += share / 25.0;
            }
        }
        println!(
            "a {name} of {} frames keeps {:.3} of its depth both ways, {:.3} live (at worst {:.3}, {:.3})",
            shape.len(),
            mean[0],
            mean[1],
            kept[0],
            kept[1]
        );
        assert!(kept[0] > 0.85 && kept[1] > 0.85 && mean[0] > 0.95 && mean[1] > 0.95, "{kept:?} {mean:?}");
    }
    // What has no noise is not touched: a smile that comes in half a second.
    let clean: Vec<f64> =
        (0..100).map(|i| ((f64::from(i) - 40.0) / 12.0).clamp(0.0, 1.0)).map(|t| t * t * (3.0 - 2.0 * t)).collect();
    for out in smoothed(&clean) {
        let off = out.iter().zip(&clean).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("a clean movement is off by {off:.4}");
        assert!(off < 0.02, "{off}");
    }
}
