//! How well recordings are aligned to their scripts, against times that are known: exact for synthetic voices, another
//! aligner's or a person's for people. Each figure is a line printed and a threshold held.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

mod confidence;
mod edits;
mod errors;
mod nuclei;
mod parting;
mod recordings;

use errors::{Errors, times};
use lianpu::speech::Note;
use recordings::Recording;

/// Aligns each and says how it went.
fn measured(what: &str, recordings: &[Recording]) -> Errors {
    let mut errors = Errors::default();
    for recording in recordings {
        errors.add(&recording.truth, &recording.aligned());
    }
    errors.say(what);
    errors
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_voice_that_nothing_was_learned_from_is_aligned_within_20_ms() {
    let Some(recordings) = recordings::mbrola() else { return };
    let errors = measured("mbrola", &recordings);
    assert!(errors.mean() <= 20.0 && errors.within(0.05) >= 92.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn synthetic_voices_are_aligned_fast_and_slow() {
    for ending in ["m0_150", "mf3_110"] {
        let Some(recordings) = recordings::espeak(ending) else { return };
        let errors = measured(&format!("espeak {ending}"), &recordings);
        assert!(errors.mean() <= 20.0 && errors.within(0.05) >= 92.0);
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn two_minutes_are_aligned_as_exactly_as_a_sentence() {
    let Some(recordings) = recordings::espeak("m0_150") else { return };
    let mut pieces = Vec::new();
    let mut lasting = 0.0;
    for recording in recordings.iter().cycle() {
        if lasting >= 120.0 {
            break;
        }
        lasting += recording.sound.duration();
        pieces.push(recording.clone());
    }
    let long = edits::joined(&pieces);
    let errors = measured("espeak, two minutes of sentences", &[long]);
    assert!(errors.mean() <= 12.0 && errors.within(0.05) >= 95.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn noise_20_db_below_the_voice_does_little_harm() {
    let Some(recordings) = recordings::espeak("m0_150_snr20") else { return };
    let errors = measured("espeak, noise at 20 dB", &recordings);
    assert!(errors.within(0.05) >= 92.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn noise_10_db_below_the_voice_is_warned_of() {
    let Some(recordings) = recordings::espeak("m0_150") else { return };
    let noisy: Vec<Recording> =
        recordings.iter().step_by(2).zip(1..).map(|(r, seed)| edits::noisy(r, 10.0, seed)).collect();
    measured("espeak, noise at 10 dB", &noisy);
    for (before, with_noise) in recordings.iter().step_by(2).zip(&noisy) {
        let warned = |r: &Recording| r.aligned().notes.iter().any(|n| matches!(n, Note::Noisy { .. }));
        assert!(warned(with_noise), "{} is not warned of", with_noise.name);
        assert!(!warned(before), "{} is without noise", before.name);
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_person_is_aligned_as_a_trained_aligner_does() {
    let Some(recordings) = recordings::real("htk") else { return };
    let errors = measured("real, HTK truth", &recordings);
    assert!(errors.mean() <= 16.0 && errors.within(0.05) >= 97.0 && errors.within(0.1) >= 100.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_person_is_aligned_as_a_neural_aligner_does_but_for_its_offset() {
    let Some(recordings) = recordings::real("neural") else { return };
    let (errors, offset) = measured("real, neural truth, with its offset", &recordings).without_offset();
    errors.say(&format!("real, neural truth, without its offset of {:.0} ms", offset * 1000.0));
    assert!(errors.mean() <= 25.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn pauses_are_where_a_person_hears_them() {
    let Some((recording, ends)) = recordings::reading() else { return };
    let found = times(&recording.aligned());
    let edges = recording.truth.iter().zip(&ends);
    let errors = Errors(edges.flat_map(|(t, (first, last))| [found[*first].0 - t.0, found[*last].1 - t.1]).collect());
    errors.say("real, edges of pauses");
    assert!(errors.mean() <= 20.0 && errors.within(0.1) >= 100.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn english_words_are_aligned() {
    let Some(recordings) = recordings::english() else { return };
    let errors = measured("english, words", &recordings);
    // Three sentences, 14 words: one boundary is 3.6 %.
    assert!(errors.mean() <= 25.0 && errors.within(0.05) >= 85.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn lips_close_when_they_do() {
    let mut sets = Vec::new();
    for ending in ["m0_150", "mf3_110"] {
        let Some(recordings) = recordings::espeak(ending) else { return };
        sets.extend(recordings);
    }
    let Some(recordings) = recordings::mbrola() else { return };
    sets.extend(recordings);
    let (mut near, mut all, mut starts) = (0, 0, Errors::default());
    for recording in &sets {
        let found = recording.aligned();
        for (number, syllable) in found.syllables.iter().enumerate() {
            let own = syllable.phones.iter().find(|p| matches!(p.phone, "b" | "p" | "m"));
            let true_one =
                recording.phones.iter().find(|p| p.0 == number && matches!(p.1.as_str(), "b" | "p" | "ph" | "m"));
            let (Some(own), Some((_, _, start, end))) = (own, true_one) else {
                assert!(own.is_none() && true_one.is_none(), "{} {number}", recording.name);
                continue;
            };
            all += 1;
            let middle = |from: f64, to: f64| (from + to) / 2.0;
            let inside = |at: f64, from: f64, to: f64| (from - 0.04..=to + 0.04).contains(&at);
            let one = inside(middle(own.start, own.end), *start, *end);
            near += usize::from(one && inside(middle(*start, *end), own.start, own.end));
            starts.0.push(own.start - start);
        }
    }
    starts.say("where b, p and m begin");
    println!("lips: {near} of {all} closures within 40 ms");
    assert!(near * 100 >= all * 98);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn equal_shares_are_no_match() {
    let Some(mbrola) = recordings::mbrola() else { return };
    let Some(espeak) = recordings::espeak("m0_150") else { return };
    let Some(htk) = recordings::real("htk") else { return };
    for (name, recordings) in [("mbrola", mbrola), ("espeak m0_150", espeak), ("real, htk", htk)] {
        let (mut shares, mut own) = (Errors::default(), Errors::default());
        for recording in &recordings {
            let sound = &recording.sound;
            let labels: Vec<String> = recording.script.iter().map(|s| s.pinyin.clone()).collect();
            let tier = lianpu::timing::equal_shares(&sound.sounding(), &labels, sound.duration());
            let found: Vec<(f64, f64)> = tier.intervals.iter().map(|i| (i.start, i.end)).collect();
            shares.0.extend(errors::per_syllable(&recording.truth, &found).into_iter().flatten());
            own.add(&recording.truth, &recording.aligned());
        }
        shares.say(&format!("{name}, equal shares"));
        assert!(own.mean() * 2.0 < shares.mean());
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn phones_fill_their_syllables_and_are_those_of_the_script() {
    let Some(recordings) = recordings::espeak("m0_150") else { return };
    for recording in recordings.iter().step_by(3) {
        let found = recording.aligned();
        assert_eq!(found.syllables.len(), recording.script.len());
        let mut before = 0.0;
        for (syllable, said) in found.syllables.iter().zip(&recording.script) {
            assert!(syllable.start >= before && syllable.end > syllable.start, "{}: {syllable:?}", recording.name);
            before = syllable.end;
            let names: Vec<&str> = syllable.phones.iter().map(|p| p.phone).collect();
            assert_eq!(names, lianpu::script::segments(said));
            let mut at = syllable.start;
            for phone in &syllable.phones {
                assert!((phone.start - at).abs() < 1e-9 && phone.end > phone.start, "{}: {syllable:?}", recording.name);
                at = phone.end;
            }
            assert!((at - syllable.end).abs() < 1e-9);
        }
        assert!(before <= recording.sound.duration());
        assert_eq!(found, recording.aligned(), "the same again");
    }
}
