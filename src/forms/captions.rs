//! Subtitles with the time of every syllable in them. In WebVTT players that know it light them one by one, others show the
//! phrase. SubRip has no such times: there a phrase is shown anew for each syllable, with what is said in another colour.

use std::fmt::Write;

use super::said::Phrase;

/// WebVTT of phrases: a cue a phrase, a time before every piece but the first.
pub(crate) fn vtt(phrases: &[Phrase]) -> String {
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

/// What is said now.
const LIT: &str = "#ffc800";

/// SubRip of phrases: a cue a piece, from where it begins to where the next one does.
pub(crate) fn karaoke_srt(phrases: &[Phrase]) -> String {
    let mut text = String::new();
    let mut number = 0;
    for phrase in phrases {
        for (lit, piece) in phrase.pieces.iter().enumerate() {
            let end = phrase.pieces.get(lit + 1).map_or(phrase.end, |next| next.start);
            let (start, end) = (millis(piece.start), millis(end));
            if end <= start {
                continue;
            }
            number += 1;
            let clock = |at| clock(at).replace('.', ",");
            let _ = write!(text, "{number}\n{} --> {}\n", clock(start), clock(end));
            let mut line = String::new();
            for (i, piece) in phrase.pieces.iter().enumerate() {
                let (open, close) =
                    if i == lit { (format!("<font color=\"{LIT}\">"), "</font>") } else { (String::new(), "") };
                let _ = write!(line, "{}{open}{}{close}{}", piece.before, piece.text, piece.after);
            }
            text.push_str(line.trim());
            text.push_str("\n\n");
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forms::said::Piece;

    fn phrase() -> Phrase {
        let piece = |text: &str, after: &str, start: f64| Piece {
            before: String::new(),
            text: text.into(),
            after: after.into(),
            pinyin: String::new(),
            zhuyin: String::new(),
            english: false,
            start,
            end: start + 0.2,
        };
        let pieces = vec![piece("你", "", 1.0), piece("好", "", 1.25), piece("吗", "？", 1.25)];
        Phrase { start: 1.0, end: 2.0, sentence: 0, pieces }
    }

    #[test]
    fn every_syllable_is_lit_from_its_start_to_the_next_one_s() {
        let text = karaoke_srt(&[phrase()]);
        let lines: Vec<&str> = text.lines().collect();
        // 好 has no time of its own.
        assert_eq!(lines[..2], ["1", "00:00:01,000 --> 00:00:01,250"]);
        assert_eq!(lines[2], "<font color=\"#ffc800\">你</font>好吗？");
        assert_eq!(lines[4..6], ["2", "00:00:01,250 --> 00:00:02,000"]);
        assert_eq!(lines[6], "你好<font color=\"#ffc800\">吗</font>？");
        assert_eq!(vtt(&[phrase()]), "WEBVTT\n\n00:00:01.000 --> 00:00:02.000\n你<00:00:01.250>好吗？\n\n");
    }
}
