//! Lips that close when b, p and m are said, and at no other time: from a recording and its script to the frames that
//! would be exported, against the true times of every phone.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::test_data;
use std::collections::BTreeMap;

use lianpu::project::{NewLesson, create};

/// Frames are looked at this far around a true closure, in seconds.
const NEAR: f64 = 0.04;
/// Lips apart by no more than this are closed, in MNS0.
const CLOSED: f64 = 0.03;
/// The usual frame rate.
const FPS: f64 = 25.0;
/// A mouth rests in pauses longer than this, in seconds, and may be shut there.
const PAUSE: f64 = 0.15;

/// One phone as it truly was spoken: name, start and end in seconds.
type Phone = (String, f64, f64);

/// The true phones of every recording in a folder.
fn phones(folder: &std::path::Path) -> BTreeMap<String, Vec<Phone>> {
    let text = std::fs::read_to_string(folder.join("phones.csv")).unwrap();
    let mut all: BTreeMap<String, Vec<Phone>> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let time = |i: usize| cells[i].parse::<f64>().unwrap();
        all.entry(cells[0].into()).or_default().push((cells[3].into(), time(4), time(5)));
    }
    all
}

/// Whether a phone closes the lips, by its name in espeak-ng (`p ph m`) or MBROLA (`b p m`).
fn closes(name: &str) -> bool {
    matches!(name, "b" | "p" | "ph" | "m")
}

struct Count {
    closures: usize,
    shown: usize,
    missed: Vec<String>,
    shut: usize,
    wrong: Vec<String>,
}

fn count(folder: &str, wanted: impl Fn(&str) -> bool) -> Option<Count> {
    let folder = test_data::find(&format!("speech/{folder}"))?;
    let lessons = tempfile::tempdir().unwrap();
    let mut count = Count { closures: 0, shown: 0, missed: Vec::new(), shut: 0, wrong: Vec::new() };
    for (name, phones) in phones(&folder).into_iter().filter(|(name, _)| wanted(name)) {
        let new = NewLesson {
            speech: Some(folder.join(format!("{name}.wav"))),
            script: Some(folder.join(format!("{name}.lab"))),
            ..NewLesson::default()
        };
        let made = create(&lessons.path().join(&name), &new, &mut |_, _| true).unwrap();
        let timeline = made.lesson.timeline(0, Some(FPS));
        let frames: Vec<(f64, bool)> = (0..timeline.frames())
            .map(|k| {
                let (mouth, _) = timeline.mouth(timeline.time_of(k));
                (timeline.time_of(k), mouth.opening() <= CLOSED)
            })
            .collect();
        for (phone, start, end) in phones.iter().filter(|p| closes(&p.0)) {
            count.closures += 1;
            let near = frames.iter().filter(|f| (start - NEAR..=end + NEAR).contains(&f.0));
            if near.clone().any(|f| f.1) {
                count.shown += 1;
            } else {
                count.missed.push(format!("{name}: {phone} at {start:.3}"));
            }
        }
        let said = phones[0].1..phones[phones.len() - 1].2;
        let rests = |t: f64| phones.windows(2).any(|w| w[1].1 - w[0].2 > PAUSE && (w[0].2..w[1].1).contains(&t));
        // f has lips that touch as well, and is no wrong closure.
        let lips = |p: &Phone| closes(&p.0) || p.0 == "f";
        let meant = |t: f64| phones.iter().any(|p| lips(p) && (p.1 - NEAR..=p.2 + NEAR).contains(&t));
        // A closure is a run of frames; one of them must be near a true one.
        let shut = |f: &&(f64, bool)| f.1 && said.contains(&f.0) && !rests(f.0);
        for run in frames.split(|f| !shut(&f)).filter(|run| !run.is_empty()) {
            count.shut += 1;
            if !run.iter().any(|f| meant(f.0)) {
                count.wrong.push(format!("{name}: {:.2}", run[0].0));
            }
        }
    }
    println!(
        "{}: {} of {} closures shown, missed {:?}; {} times shut, wrongly {:?}",
        folder.display(),
        count.shown,
        count.closures,
        count.missed,
        count.shut,
        count.wrong
    );
    Some(count)
}

fn assert_closes(count: &Count) {
    let shown = count.shown as f64 / count.closures as f64;
    assert!(shown >= 0.98, "{shown}: {:?}", count.missed);
    let wrong = count.wrong.len() as f64 / count.shut as f64;
    assert!(wrong <= 0.01, "{wrong}: {:?}", count.wrong);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn lips_close_for_b_p_and_m_of_a_synthetic_voice_and_at_no_other_time() {
    if let Some(count) = count("espeak", |name| !name.contains("snr")) {
        assert!(count.closures >= 60);
        assert_closes(&count);
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn lips_close_for_b_p_and_m_of_a_voice_of_recorded_syllables_and_at_no_other_time() {
    if let Some(count) = count("mbrola", |_| true) {
        assert!(count.closures >= 5);
        assert_closes(&count);
    }
}
