//! WebVTT with the time of every syllable in it: players that know it light them one by one, others show the phrase.

use std::fmt::Write;

use super::said::Phrase;

/// WebVTT of phrases: a cue a phrase, a time before every piece but the first.
pub(super) fn vtt(phrases: &[Phrase]) -> String {
    let mut text = String::from("WEBVTT\n\n");
    for phrase in phrases {
        let (start, end) = (millis(phrase.start), millis(phrase.end).max(millis(phrase.start) + 1));
        let _ = writeln!(text, "{} --> {}", clock(start), clock(end));
        let mut last = start;
        for piece in &phrase.pieces {
            let at = millis(piece.start);
            // Times in a cue rise and lie inside it.
            if at > last && at < end {
                let _ = write!(text, "<{}>", clock(at));
                last = at;
            }
            let words = format!("{}{}{}", piece.before, piece.text, piece.after);
            text.push_str(&words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;"));
        }
        text.truncate(text.trim_end().len());
        text.push_str("\n\n");
    }
    text
}

fn millis(seconds: f64) -> u64 {
    (seconds * 1000.0).round().max(0.0) as u64
}

fn clock(millis: u64) -> String {
    let (seconds, minutes, hours) = (millis / 1000, millis / 60_000, millis / 3_600_000);
    format!("{:02}:{:02}:{:02}.{:03}", hours, minutes % 60, seconds % 60, millis % 1000)
}
