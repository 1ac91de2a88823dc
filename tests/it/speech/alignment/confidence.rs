//! What alignment says of itself: how sure it is; that it keeps what a person has set; that a voice known better is
//! aligned no worse.

use lianpu::speech::{Pin, Take, align};

use super::edits;
use super::errors::{Errors, per_syllable, times};
use super::recordings::{self, Recording};

/// Recordings from good to bad, every few of each kind.
fn mixed() -> Option<Vec<Recording>> {
    let mut out: Vec<Recording> = recordings::mbrola()?;
    let clean = recordings::espeak("m0_150")?;
    out.extend(clean.iter().step_by(4).cloned());
    out.extend(recordings::espeak("mf3_110")?.into_iter().step_by(4));
    out.extend(recordings::espeak("m0_150_snr20")?.into_iter().step_by(3));
    for (snr, seed) in [(10.0, 11), (5.0, 12), (0.0, 13)] {
        out.extend(clean.iter().skip(seed as usize % 3).step_by(3).map(|r| edits::noisy(r, snr, seed)));
    }
    out.extend(recordings::real("htk")?);
    Some(out)
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn confidence_is_the_share_that_is_right() {
    let Some(recordings) = mixed() else { return };
    // Confidence, and whether both boundaries are within 50 ms.
    let mut marks: Vec<(f64, bool)> = Vec::new();
    for recording in &recordings {
        let found = recording.aligned();
        let off = per_syllable(&recording.truth, &times(&found));
        marks.extend(found.syllables.iter().zip(off).map(|(s, o)| (s.confidence, o.iter().all(|e| e.abs() <= 0.05))));
    }
    let mut gap = 0.0;
    for (low, high) in [(0.0, 0.3), (0.3, 0.5), (0.5, 0.7), (0.7, 0.85), (0.85, 0.95), (0.95, 1.01)] {
        let bin: Vec<_> = marks.iter().filter(|m| (low..high).contains(&m.0)).collect();
        if bin.is_empty() {
            continue;
        }
        let said = bin.iter().map(|m| m.0).sum::<f64>() / bin.len() as f64;
        let right = bin.iter().filter(|m| m.1).count() as f64 / bin.len() as f64;
        println!("confidence {low} to {high}: {} syllables, says {said:.2}, right {right:.2}", bin.len());
        gap += (said - right).abs() * bin.len() as f64 / marks.len() as f64;
    }
    // How well it tells the wrong from the right: the chance that a right one is trusted more than a wrong one.
    let of = |good: bool| marks.iter().filter(|m| m.1 == good).collect::<Vec<_>>();
    let (right, wrong) = (of(true), of(false));
    let pairs = right.iter().flat_map(|r| {
        wrong.iter().map(move |w| {
            if r.0 > w.0 {
                1.0
            } else if r.0 < w.0 {
                0.0
            } else {
                0.5
            }
        })
    });
    let told = pairs.sum::<f64>() / (right.len() * wrong.len()).max(1) as f64;
    println!(
        "confidence: {} syllables, {} wrong, off by {gap:.3} on the whole, right above wrong in {told:.2}",
        marks.len(),
        wrong.len()
    );
    assert!(gap <= 0.1 && told >= 0.7);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn what_a_person_has_set_is_kept() {
    let Some(recordings) = recordings::espeak("m0_150") else { return };
    for recording in recordings.iter().filter(|r| r.truth.len() >= 5).step_by(4) {
        // The third syllable, put a little beside where it is, and the fifth where it is.
        let (third, fifth) = (recording.truth[2], recording.truth[4]);
        let pins = [
            Pin { syllable: 2, start: third.0 + 0.03, end: third.1 - 0.02 },
            Pin { syllable: 4, start: fifth.0, end: fifth.1 },
        ];
        let found = recording.with_pins(&pins);
        for pin in &pins {
            let syllable = &found.syllables[pin.syllable];
            assert_eq!((syllable.start, syllable.end), (pin.start, pin.end), "{}", recording.name);
            let (first, last) = (syllable.phones.first().unwrap(), syllable.phones.last().unwrap());
            assert!((first.start - pin.start).abs() < 1e-9 && (last.end - pin.end).abs() < 1e-9, "{}", recording.name);
        }
        let mut before = 0.0;
        for syllable in &found.syllables {
            assert!(syllable.start >= before - 1e-9 && syllable.end >= syllable.start);
            before = syllable.end;
        }
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn takes_of_one_voice_are_no_worse_together() {
    let Some(mbrola) = recordings::mbrola() else { return };
    let Some(espeak) = recordings::espeak("mf3_110") else { return };
    let espeak: Vec<Recording> = espeak.into_iter().step_by(2).collect();
    for (name, recordings) in [("mbrola", mbrola), ("espeak", espeak)] {
        let (mut alone, mut together) = (Errors::default(), Errors::default());
        let takes: Vec<Take<'_>> = recordings.iter().map(Recording::take).collect();
        for (recording, found) in recordings.iter().zip(align(&takes)) {
            alone.add(&recording.truth, &recording.aligned());
            together.add(&recording.truth, &found.unwrap());
        }
        alone.say(&format!("{name}, each alone"));
        together.say(&format!("{name}, together"));
        assert!(together.mean() <= alone.mean() + 0.5);
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn takes_of_a_person_stay_near_together() {
    let Some(recordings) = recordings::own_voice() else { return };
    let takes: Vec<Take<'_>> = recordings.iter().take(4).map(Recording::take).collect();
    let mut moved = Errors::default();
    for (recording, found) in recordings.iter().zip(align(&takes)) {
        moved.add(&times(&recording.aligned()), &found.unwrap());
    }
    moved.say("self, together against alone");
    assert!(moved.within(0.1) >= 95.0);
}
