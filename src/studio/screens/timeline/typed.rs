//! What a typed line means: the value of a key, an edit of a stretch. Every refusal says what is allowed.

use super::editor::{number, value_text};
use crate::pose::{Emotion, Gaze, Head, MouthShape, Ratios};
use crate::timeline::{Ease, Key, KeyValue, Range, Track};

/// What may be typed for a key of a track.
#[must_use]
pub(crate) const fn key_help(track: Track) -> &'static str {
    match track {
        Track::Mouth => "one of m f h a i u e o n, or rest",
        Track::Emotion => {
            "such as happy 0.6, fear 0.2 (the rest is neutral); then how it goes on: smooth, linear or hold; ends = \
             the record again"
        }
        Track::Blink => "Enter, or seconds such as 0.3",
        Track::Gaze => {
            "x y in eye heights: right and down are positive; 0 0 is straight ahead; then how it goes on: smooth, \
             linear or hold"
        }
        Track::Head => {
            "x y roll: pupil distances right and down, degrees clockwise; then how it goes on: smooth, linear or \
             hold"
        }
    }
}

/// What may be typed for an edit of a stretch.
pub(crate) const RANGE_HELP: &str = "such as happy *1.2 +0.05, sadness *0, smooth 0.12";

/// Reads a key's value. Words at its end say how it goes on: `linear`, `smooth`, `hold`; and `ends`: the record
/// holds again after it.
///
/// # Errors
/// In one line: what was typed, and what is allowed.
pub(crate) fn key(track: Track, text: &str, time: f64) -> Result<Key, String> {
    let mut words: Vec<&str> = text.split([' ', ',', '，', '、']).filter(|w| !w.is_empty()).collect();
    let mut key = Key::new(time, KeyValue::Blink(0.0));
    while let Some(word) = words.last() {
        match *word {
            "linear" => key.ease = Ease::Linear,
            "smooth" => key.ease = Ease::Smooth,
            "hold" => key.ease = Ease::Hold,
            "ends" if track == Track::Emotion => key.ends = true,
            _ => break,
        }
        words.pop();
    }
    key.value = match track {
        Track::Mouth => KeyValue::Mouth(mouth(&words)?),
        Track::Emotion => KeyValue::Emotion(ratios(&words)?),
        Track::Blink => match numbers(&words)?.as_slice() {
            [] => KeyValue::Blink(0.24),
            [length] if (0.05..=5.0).contains(length) => KeyValue::Blink(*length),
            _ => return Err("a blink lasts 0.05 to 5 seconds".into()),
        },
        Track::Gaze => match numbers(&words)?.as_slice() {
            [x, y] if x.abs() <= 10.0 && y.abs() <= 10.0 => KeyValue::Gaze(Gaze { x: *x, y: *y }),
            _ => return Err("gaze has two numbers from -10 to 10: x y, such as 0.2 0".into()),
        },
        Track::Head => match numbers(&words)?.as_slice() {
            [x, y, roll] if x.abs() <= 10.0 && y.abs() <= 10.0 && roll.abs() <= 180.0 => {
                KeyValue::Head(Head { x: *x, y: *y, roll: *roll })
            }
            _ => return Err("head has three numbers: x y (-10 to 10) and roll in degrees, such as 0 0.1 5".into()),
        },
    };
    Ok(key)
}

/// A key as it would be typed.
#[must_use]
pub(crate) fn key_text(key: &Key) -> String {
    let mut text = value_text(&key.value).trim_end_matches(" s").to_owned();
    match key.ease {
        Ease::Smooth => {}
        Ease::Linear => text.push_str(" linear"),
        Ease::Hold => text.push_str(" hold"),
    }
    if key.ends {
        text.push_str(" ends");
    }
    text
}

fn mouth(words: &[&str]) -> Result<Option<MouthShape>, String> {
    match words {
        ["rest"] => Ok(None),
        [one] => one.to_lowercase().parse().map(Some).map_err(|e: String| format!("{e}, nor `rest`")),
        _ => Err(format!("type {}", key_help(Track::Mouth))),
    }
}

fn ratios(words: &[&str]) -> Result<Ratios, String> {
    if words == ["neutral"] {
        return Ok(Ratios::NEUTRAL);
    }
    if words.is_empty() {
        return Err(format!("type {}", key_help(Track::Emotion)));
    }
    let mut ratios = Ratios([0.0; 7]);
    let mut rest = words.iter().peekable();
    while let Some(word) = rest.next() {
        let emotion = emotion(word)?;
        let value = match rest.peek().map(|w| w.parse::<f64>()) {
            Some(Ok(value)) => {
                rest.next();
                value
            }
            _ => 1.0,
        };
        if !(-2.0..=2.0).contains(&value) {
            return Err(format!("{emotion} cannot be {value}: ratios go from -2 to 2, usually 0 to 1"));
        }
        if emotion != Emotion::Neutral {
            ratios[emotion] = value;
        }
    }
    Ok(ratios.closed())
}

/// An emotion by its name, the start of its name, or its letter.
fn emotion(word: &str) -> Result<Emotion, String> {
    let word = word.to_lowercase();
    let mut one = word.chars();
    if let (Some(letter), None) = (one.next(), one.next())
        && let Some(found) = Emotion::ALL.into_iter().find(|e| e.letter().eq_ignore_ascii_case(&letter))
    {
        return Ok(found);
    }
    // The seven are called by nouns and adjectives as they come; whoever types the other form means the same.
    let other = match word.as_str() {
        "calm" | "none" => Some(Emotion::Neutral),
        "happiness" | "happily" => Some(Emotion::Happy),
        "angry" | "angrily" => Some(Emotion::Anger),
        "disgusted" | "disgusting" => Some(Emotion::Disgust),
        "sadly" | "unhappy" => Some(Emotion::Sadness),
        "fearful" | "afraid" | "scared" => Some(Emotion::Fear),
        "surprising" => Some(Emotion::Surprised),
        _ => None,
    };
    if let Some(found) = other {
        return Ok(found);
    }
    let mut near = Emotion::ALL.into_iter().filter(|e| word.len() > 1 && e.name().starts_with(&word));
    match (near.next(), near.next()) {
        (Some(found), None) => Ok(found),
        _ => {
            let names: Vec<&str> = Emotion::ALL.iter().map(|e| e.name()).collect();
            Err(format!("`{word}` is no emotion: {}", names.join(" ")))
        }
    }
}

fn numbers(words: &[&str]) -> Result<Vec<f64>, String> {
    let number =
        |w: &&str| w.parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| format!("`{w}` is no number"));
    words.iter().map(number).collect()
}

/// Reads an edit of a stretch: `happy *1.2 +0.05, smooth 0.12`.
///
/// # Errors
/// In one line: what was typed, and what is allowed.
pub(crate) fn range(text: &str, from: f64, to: f64) -> Result<Range, String> {
    let mut range = Range::new(from, to);
    for part in text.split([',', '，']).map(str::trim).filter(|p| !p.is_empty()) {
        let mut words = part.split_whitespace();
        let name = words.next().unwrap_or_default();
        if name == "smooth" {
            let width = numbers(&words.collect::<Vec<_>>())?;
            range.smooth = match width.as_slice() {
                [width] if (0.0..=5.0).contains(width) => *width,
                _ => return Err("smooth has one number, 0 to 5 seconds".into()),
            };
            continue;
        }
        let emotion = emotion(name)?;
        if emotion == Emotion::Neutral {
            return Err("neutral takes up what the others gain or lose; change one of the six".into());
        }
        let before = range;
        for word in words {
            let value = |digits: &str| digits.parse::<f64>().ok().filter(|v| v.abs() <= 10.0);
            match (word.chars().next(), word.strip_prefix('*').and_then(value), value(word)) {
                (Some('*'), Some(scale), _) => range.scale[emotion.index()] = scale,
                (Some('+' | '-'), _, Some(offset)) => range.offset[emotion.index()] = offset,
                _ => return Err(format!("`{word}` is neither *1.2 nor +0.05 nor -0.05")),
            }
        }
        if range == before {
            return Err(format!("say what becomes of {emotion}: {RANGE_HELP}"));
        }
    }
    if range == Range::new(from, to) { Err(format!("type {RANGE_HELP}")) } else { Ok(range) }
}

/// An edit of a stretch in words, as it would be typed.
#[must_use]
pub(crate) fn range_text(range: &Range) -> String {
    let mut parts = Vec::new();
    for emotion in &Emotion::ALL[1..] {
        let (scale, offset) = (range.scale[emotion.index()], range.offset[emotion.index()]);
        let mut part = String::new();
        if scale != 1.0 {
            part.push_str(&format!(" *{}", number(scale)));
        }
        if offset != 0.0 {
            part.push_str(&format!(" {}{}", if offset > 0.0 { "+" } else { "" }, number(offset)));
        }
        if !part.is_empty() {
            parts.push(format!("{emotion}{part}"));
        }
    }
    if range.smooth > 0.0 {
        parts.push(format!("smooth {}", number(range.smooth)));
    }
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_reads_back_as_it_is_shown() {
        for (track, text) in [
            (Track::Mouth, "a"),
            (Track::Mouth, "rest"),
            (Track::Emotion, "happy 0.6, fear 0.2"),
            (Track::Emotion, "anger -0.1 hold ends"),
            (Track::Emotion, "neutral"),
            (Track::Blink, "0.3"),
            (Track::Gaze, "-0.2 0.1"),
            (Track::Head, "0 0.1 -5 linear"),
        ] {
            assert_eq!(key_text(&key(track, text, 1.0).unwrap()), text);
        }
    }

    #[test]
    fn an_emotion_may_be_a_letter_or_the_start_of_its_name_and_the_rest_is_neutral() {
        let KeyValue::Emotion(r) = key(Track::Emotion, "H .5 surp 0.2", 0.0).unwrap().value else { unreachable!() };
        assert_eq!((r[Emotion::Happy], r[Emotion::Surprised]), (0.5, 0.2));
        assert!((r.sum() - 1.0).abs() < 1e-12);
        for (word, meant) in [
            ("angry", Emotion::Anger),
            ("sad", Emotion::Sadness),
            ("Happiness", Emotion::Happy),
            ("surprise", Emotion::Surprised),
            ("fearful", Emotion::Fear),
            ("disgusted", Emotion::Disgust),
        ] {
            assert_eq!(emotion(word), Ok(meant));
        }
    }

    #[test]
    fn every_refusal_says_what_is_allowed() {
        for (track, text, word) in [
            (Track::Mouth, "x", "m f h a i u e o n"),
            (Track::Mouth, "", "rest"),
            (Track::Emotion, "", "happy 0.6"),
            (Track::Emotion, "joy 1", "happy"),
            (Track::Emotion, "happy 9", "-2 to 2"),
            (Track::Emotion, "happy nan", "-2 to 2"),
            (Track::Blink, "nan", "no number"),
            (Track::Blink, "9", "0.05 to 5"),
            (Track::Gaze, "1", "two numbers"),
            (Track::Head, "1 2", "three numbers"),
        ] {
            let said = key(track, text, 0.0).unwrap_err();
            assert!(said.contains(word), "{text}: {said}");
        }
    }

    #[test]
    fn a_range_edit_reads_back_as_it_is_shown_and_neutral_is_left_alone() {
        let text = "happy *1.2 +0.05, sadness -0.1, smooth 0.12";
        assert_eq!(range_text(&range(text, 0.0, 1.0).unwrap()), text);
        for (bad, word) in [("neutral *2", "six"), ("", "such as"), ("happy", "such as"), ("happy 2", "*1.2")] {
            assert!(range(bad, 0.0, 1.0).unwrap_err().contains(word), "{bad}");
        }
    }
}
