//! From times to mouths on real timings: every closure is seen, and none that is not there.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::test_data;
use std::path::PathBuf;

use lianpu::pose::{MouthPreset, MouthShape};
use lianpu::script::{OnsetPreset, System, onsets, syllables};
use lianpu::timeline::{Score, Sources, Spoken, Timeline};
use lianpu::timing;

/// Lips count as closed up to this opening, in M.
const CLOSED: f64 = 0.03;

/// Speech alone, at 25 frames a second.
fn timeline(spoken: &[Spoken], duration: f64) -> Timeline {
    Timeline::build(&Sources {
        duration,
        fps: 25.0,
        spoken,
        record: None,
        tracks: None,
        score: &Score::default(),
        mouths: MouthPreset::Distinct,
    })
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn lips_close_for_every_b_p_m_f_and_for_nothing_else() {
    let Some(folder) = test_data::find("speech/espeak") else { return };
    let (mut wanted, mut seen, mut open_frames, mut false_frames) = (0, 0, 0, 0);
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().flatten().map(|e| e.path()).collect();
    files.retain(|p| p.extension().is_some_and(|e| e == "TextGrid"));
    for path in &files {
        let times = timing::read(path).unwrap();
        let script = std::fs::read_to_string(path.with_extension("lab")).unwrap();
        let said = syllables(&script, System::Hanyu).unwrap();
        let tier = times.syllables().unwrap();
        assert_eq!(said.len(), tier.intervals.len(), "{}", path.display());
        let spoken: Vec<Spoken> = said
            .iter()
            .zip(&tier.intervals)
            .map(|(s, i)| Spoken {
                exact: false,
                start: i.start,
                end: i.end,
                shapes: onsets(s, OnsetPreset::Measured).into_iter().zip(s.shapes.iter().copied()).collect(),
            })
            .collect();
        let line = timeline(&spoken, times.duration);
        let frames: Vec<(f64, bool)> = (0..line.frames())
            .map(|k| line.time_of(k))
            .map(|t| (t, line.mouth(t).0.speaking > 0.99 && line.mouth(t).0.opening() <= CLOSED))
            .collect();
        // From the start of a closure to the start of the vowel after it.
        let closures: Vec<(f64, f64)> = spoken
            .iter()
            .filter(|s| s.shapes.first().is_some_and(|(_, shape)| shape.closes()))
            .map(|s| (s.start, s.start + s.shapes.get(1).map_or(1.0, |(share, _)| *share) * (s.end - s.start)))
            .collect();
        for (at, _) in &closures {
            wanted += 1;
            seen += usize::from(frames.iter().any(|(t, closed)| *closed && (t - at).abs() <= 0.0401));
        }
        for (t, closed) in &frames {
            let near = closures.iter().any(|(at, vowel)| (at - 0.0401..*vowel).contains(t));
            let speaking = spoken.iter().any(|s| s.start <= *t && *t < s.end);
            if speaking && !near {
                open_frames += 1;
                false_frames += usize::from(*closed);
            }
        }
    }
    println!(
        "{} files: {seen} of {wanted} closures seen, {false_frames} of {open_frames} other frames closed",
        files.len()
    );
    assert!(wanted > 80);
    assert_eq!(seen, wanted);
    assert_eq!(false_frames, 0);
}

#[test]
fn fast_speech_does_not_flap() {
    // Ten syllables a second of ba-la-ba-la: the lips must close for every b, and the la between, which has no time
    // to open wide, stays in part.
    let mut spoken = Vec::new();
    for i in 0..20 {
        let start = 0.2 + 0.1 * f64::from(i);
        let shapes =
            if i % 2 == 0 { vec![(0.0, MouthShape::M), (0.464, MouthShape::A)] } else { vec![(0.0, MouthShape::A)] };
        spoken.push(Spoken { start, end: start + 0.1, shapes, exact: false });
    }
    let line = timeline(&spoken, 2.6);
    let opening = |t: f64| line.mouth(t).0.opening();
    let path = |times: std::ops::Range<u32>| {
        let values: Vec<f64> = times.map(|k| opening(f64::from(k) / 100.0)).collect();
        values.windows(2).map(|w| (w[1] - w[0]).abs()).sum::<f64>()
    };
    // One closing and one opening for each of the nine pairs in between, none higher than four fifths of a whole a.
    let whole = 1.5;
    let pairs = 9.0;
    let travelled = path(30..210);
    assert!(travelled < pairs * 2.0 * 0.8 * whole, "{travelled}");
    let turns = (31..209).filter(|k| {
        let at = |k: u32| opening(f64::from(k) / 100.0);
        at(*k) > at(k - 1) + 1e-9 && at(*k) > at(k + 1) + 1e-9
    });
    assert!(turns.count() <= 10, "more openings than b-la pairs");
}
