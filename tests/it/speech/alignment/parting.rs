//! Where sound and script part: it is said where, and the rest is aligned all the same.

use lianpu::speech::{Alignment, Note};

use super::edits::{inserted, joined, room, stretch};
use super::errors::{Errors, per_syllable, times};
use super::recordings::{self, Recording};

/// Sentences of at least six syllables, without repeated ones.
fn sentences() -> Option<Vec<Recording>> {
    let mut all = recordings::espeak("m0_150")?;
    all.extend(recordings::mbrola()?);
    all.retain(|r| r.truth.len() >= 6 && (1..r.script.len()).all(|i| r.script[i - 1].pinyin != r.script[i].pinyin));
    Some(all.into_iter().step_by(2).collect())
}

fn parted(found: &Alignment) -> Vec<&Note> {
    found
        .notes
        .iter()
        .filter(|n| matches!(n, Note::NotHeard { .. } | Note::NotInScript { .. } | Note::Doubtful))
        .collect()
}

/// Counts of what went right, for a line.
#[derive(Default)]
struct Tally {
    tried: usize,
    told: usize,
    others: Errors,
}

impl Tally {
    /// `told`: whether a note names the place; `others`: errors of the syllables that it does not concern.
    fn count(&mut self, told: bool, others: impl IntoIterator<Item = [f64; 2]>) {
        self.tried += 1;
        self.told += usize::from(told);
        self.others.0.extend(others.into_iter().flatten());
    }

    fn say(&self, what: &str) {
        println!("{what}: told in {} of {}", self.told, self.tried);
        self.others.say("  the other syllables");
    }

    fn holds(&self, told: f64, within: f64) {
        assert!(self.told as f64 >= told * self.tried as f64, "told in {} of {}", self.told, self.tried);
        assert!(self.others.within(0.05) >= within, "{:.1} % within 50 ms", self.others.within(0.05));
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn where_all_is_well_nothing_is_said() {
    let Some(recordings) = sentences() else { return };
    let mut real = recordings::real("htk").unwrap_or_default();
    real.extend(recordings::real("neural").unwrap_or_default());
    for recording in recordings.iter().chain(&real) {
        let found = recording.aligned();
        assert!(
            parted(&found).is_empty() && found.syllables.iter().all(|s| s.heard),
            "{}: {:?}",
            recording.name,
            found.notes
        );
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn of_a_person_who_says_the_script_nothing_is_said() {
    let Some(recordings) = recordings::own_voice() else { return };
    let takes: Vec<_> = recordings.iter().map(Recording::take).collect();
    let together = lianpu::speech::align(&takes);
    let mut told = 0;
    for (recording, together) in recordings.iter().zip(together) {
        let together = together.unwrap();
        for (how, found) in [("alone", recording.aligned()), ("together", together)] {
            let notes = parted(&found);
            told += notes.len();
            if !notes.is_empty() {
                println!("{}, {how}: {notes:?}", recording.name);
            }
        }
    }
    println!("six takes of a person, alone and together: {told} notes");
    assert_eq!(told, 0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_word_that_is_not_in_the_script_is_pointed_out() {
    let Some(recordings) = sentences() else { return };
    let mut tally = Tally::default();
    for (number, recording) in recordings.iter().enumerate() {
        // Two syllables are missing in the script, away from the ends.
        let gone = 2 + number % (recording.truth.len() - 4);
        let mut short = recording.clone();
        let (from, to) = (recording.truth[gone].0, recording.truth[gone + 1].1);
        short.script.drain(gone..gone + 2);
        short.truth.drain(gone..gone + 2);
        let found = short.aligned();
        let told = parted(&found).iter().any(|note| {
            matches!(note, Note::NotInScript { before, start, end }
                if before.abs_diff(gone) <= 1 && *start < to && *end > from)
        });
        if !told {
            println!("not told: {} {gone}: {:?}", recording.name, found.notes);
        }
        let off = per_syllable(&short.truth, &times(&found));
        let others = off.into_iter().enumerate().filter(|(i, _)| i + 1 != gone && *i != gone);
        tally.count(told, others.map(|(_, o)| o));
    }
    tally.say("a word too few in the script");
    tally.holds(0.8, 92.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_word_that_is_not_said_is_pointed_out() {
    let Some(recordings) = sentences() else { return };
    let extra = recordings::script(&["chuang1".into(), "hu5".into()]);
    let mut tally = Tally::default();
    for (number, recording) in recordings.iter().enumerate() {
        let place = 1 + number % (recording.truth.len() - 2);
        let mut long = recording.clone();
        long.script.splice(place..place, extra.iter().cloned());
        let found = long.aligned();
        let told = parted(&found).iter().any(|note| {
            matches!(note, Note::NotHeard { first, count, .. } if *first < place + 2 && first + count > place && *count <= 3)
        });
        if !told {
            println!("not told: {} {place}: {:?}", recording.name, found.notes);
        }
        let mut rest = times(&found);
        rest.drain(place..place + 2);
        let off = per_syllable(&recording.truth, &rest);
        let others = off.into_iter().enumerate().filter(|(i, _)| i + 1 != place && *i != place);
        tally.count(told, others.map(|(_, o)| o));
    }
    tally.say("a word too many in the script");
    tally.holds(0.8, 92.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_word_said_twice_is_pointed_out() {
    let Some(recordings) = sentences() else { return };
    let mut tally = Tally::default();
    for (number, recording) in recordings.iter().enumerate() {
        let first = 1 + number % (recording.truth.len() - 4);
        let (from, to) = (recording.truth[first].0, recording.truth[first + 2].0);
        let again = stretch(recording, from, to);
        let long = to - from;
        let twice = inserted(recording, to, &again);
        let found = twice.aligned();
        let told = parted(&found)
            .iter()
            .any(|note| matches!(note, Note::NotInScript { start, end, .. } if *start < to + long && *end > from));
        if !told {
            println!("not told: {} {first}: {:?}", recording.name, found.notes);
        }
        // The said twice may be found in either place.
        let off = per_syllable(&twice.truth, &times(&found));
        let others = off.into_iter().enumerate().filter(|(i, _)| *i + 1 < first || *i > first + 2);
        tally.count(told, others.map(|(_, o)| o));
    }
    tally.say("a word said twice");
    tally.holds(0.8, 92.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_long_silence_is_a_pause() {
    let Some(recordings) = sentences() else { return };
    let mut all = Errors::default();
    for (number, recording) in recordings.iter().enumerate() {
        let place = recording.truth[1 + number % (recording.truth.len() - 2)].1;
        // Put in between the syllables.
        let paused = inserted(recording, place, &room(3.0, recording.sound.rate));
        let found = paused.aligned();
        assert!(parted(&found).is_empty(), "{}: {:?}", recording.name, found.notes);
        all.add(&paused.truth, &found);
    }
    all.say("3 s of silence between two words");
    assert!(all.within(0.05) >= 92.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_hesitation_is_passed_over() {
    let Some(recordings) = sentences() else { return };
    // The e of 喝 in the sentence 我想喝一杯茶, drawn out by its middle.
    let said = recordings::espeak("s06_m0_150").unwrap().remove(0);
    let (from, to) = said.truth[2];
    let middle = stretch(&said, from + 0.55 * (to - from), from + 0.8 * (to - from));
    let mut tally = Tally::default();
    for (number, recording) in recordings.iter().enumerate().filter(|(_, r)| r.name != said.name) {
        let place = recording.truth[1 + number % (recording.truth.len() - 2)].1;
        let rate = recording.sound.rate;
        let hum: Vec<f32> = [room(0.15, rate), middle.repeat(5), room(0.2, rate)].concat();
        let held = hum.len() as f64 / f64::from(rate);
        let hesitant = inserted(recording, place, &hum);
        let found = hesitant.aligned();
        let told = parted(&found)
            .iter()
            .any(|note| matches!(note, Note::NotInScript { start, end, .. } if *start < place + held && *end > place));
        if !told {
            println!("not told: {} at {place:.2}: {:?}", recording.name, found.notes);
        }
        tally.count(told, per_syllable(&hesitant.truth, &times(&found)));
    }
    tally.say("a hesitation");
    tally.holds(0.8, 95.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_script_of_something_else_is_doubted() {
    let Some(recordings) = sentences() else { return };
    let (mut told, mut tried) = (0, 0);
    for (number, recording) in recordings.iter().enumerate() {
        let mut wrong = recording.clone();
        // Another sentence of about the same length.
        let others = recordings.iter().enumerate().filter(|(i, r)| {
            *i != number
                && r.truth.len().abs_diff(recording.truth.len()) <= 2
                && r.script.iter().all(|s| !recording.script.contains(s))
        });
        let Some((_, other)) = others.last() else { continue };
        wrong.script = other.script.clone();
        let found = wrong.aligned();
        tried += 1;
        let doubted = found.notes.contains(&Note::Doubtful);
        told += usize::from(doubted);
        if !doubted {
            println!("not doubted: {} as {}: {:?}", recording.name, other.name, found.notes);
        }
    }
    println!("another script altogether: doubted in {told} of {tried}");
    assert!(tried >= 5 && told * 10 >= tried * 8);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn two_sentences_in_one_recording_are_as_good_as_one() {
    let Some(recordings) = recordings::espeak("mf3_110") else { return };
    let mut all = Errors::default();
    for pair in recordings.chunks_exact(2).step_by(3) {
        let both = joined(pair);
        all.add(&both.truth, &both.aligned());
    }
    all.say("two sentences in one recording");
    assert!(all.mean() <= 20.0 && all.within(0.05) >= 92.0);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn speech_is_not_looked_for_in_the_silence_about_it() {
    let Some(recordings) = recordings::mbrola() else { return };
    let mut all = Errors::default();
    for recording in recordings.iter().step_by(3) {
        let before = inserted(recording, 0.0, &room(4.0, recording.sound.rate));
        let end = before.sound.duration();
        let long = inserted(&before, end, &room(5.0, recording.sound.rate));
        let (start, end) = long.spoken();
        let found = long.aligned();
        let (first, last) = (&found.syllables[0], &found.syllables[found.syllables.len() - 1]);
        assert!(
            (first.start - start).abs() < 0.1 && (last.end - end).abs() < 0.1,
            "{}: {} {}",
            recording.name,
            first.start - start,
            last.end - end
        );
        all.add(&long.truth, &found);
    }
    all.say("silence before and after");
    assert!(all.within(0.05) >= 92.0);
}
