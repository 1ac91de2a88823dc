//! A chapter: the page with the face and the script under its readings, and the overlay that says what is read when.

use std::fmt::Write;

use super::Chapter;
use crate::forms::escaped;
use crate::forms::said::Piece;
use crate::forms::smil::lead;

/// A page up to and with the beginning of its body.
pub(super) fn head(title: &str, language: &str, scripted: bool) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" \
         xmlns:epub=\"http://www.idpf.org/2007/ops\" lang=\"{language}\" xml:lang=\"{language}\">\n<head>\n\
         <meta charset=\"utf-8\"/>\n<title>{}</title>\n<link rel=\"stylesheet\" type=\"text/css\" href=\"style.css\"/>\n{}</head>\n<body>\n",
        escaped(title),
        if scripted { "<script src=\"face.js\"></script>\n" } else { "" }
    )
}

/// The page of chapter `n`.
pub(super) fn text(chapter: &Chapter, n: usize, language: &str) -> String {
    let mut out = head(&chapter.title, language, true);
    let about = escaped(&chapter.description);
    let [width, height] = chapter.size;
    let _ = write!(
        out,
        "<section epub:type=\"chapter\" id=\"chapter\">\n<h1>{}</h1>\n<figure>\n\
         <object id=\"face\" data=\"clip-{n}.svg\" type=\"image/svg+xml\" width=\"{width}\" height=\"{height}\" data-ahead=\"{}\" aria-label=\"{about}\">\n\
         <img src=\"clip-{n}.png\" alt=\"{about}\"/>\n</object>\n",
        escaped(&chapter.title),
        lead(chapter.fps)
    );
    if let Some(sound) = &chapter.sound {
        let _ =
            writeln!(out, "<audio id=\"sound\" src=\"clip-{n}.{}\" controls=\"controls\"></audio>", sound.extension);
    }
    out.push_str("</figure>\n");
    let (mut sentence, mut number) = (None, 0);
    let end = |out: &mut String, open: bool| {
        if open {
            out.push_str("</p>\n");
        }
    };
    for phrase in &chapter.phrases {
        if sentence != Some(phrase.sentence) {
            end(&mut out, sentence.is_some());
            sentence = Some(phrase.sentence);
            let _ = write!(out, "<p class=\"said\" id=\"p{}\">", phrase.sentence);
        }
        for piece in &phrase.pieces {
            number += 1;
            let _ = write!(
                out,
                "{}<span id=\"s{number}\" data-from=\"{:.3}\" data-to=\"{:.3}\"{}>{}</span>{}",
                escaped(&piece.before),
                piece.start,
                piece.end,
                if piece.english && language != "en" { " lang=\"en\" xml:lang=\"en\"" } else { "" },
                ruby(piece, chapter.zhuyin),
                escaped(&piece.after)
            );
        }
    }
    end(&mut out, sentence.is_some());
    out.push_str("</section>\n</body>\n</html>\n");
    out
}

fn ruby(piece: &Piece, zhuyin: bool) -> String {
    let reading = if zhuyin { &piece.zhuyin } else { &piece.pinyin };
    let text = escaped(&piece.text);
    if reading.is_empty() { text } else { format!("<ruby>{text}<rt>{}</rt></ruby>", escaped(reading)) }
}

/// What is read when. Each piece lasts until the next, the first from the beginning, so that nothing of the sound is
/// left out.
pub(super) fn overlay(chapter: &Chapter, n: usize) -> String {
    let extension = chapter.sound.as_ref().map_or("mp3", |s| s.extension);
    let pieces: Vec<(u32, &Piece)> =
        chapter.phrases.iter().flat_map(|p| p.pieces.iter().map(move |piece| (p.sentence, piece))).collect();
    let millis = |seconds: f64| (seconds * 1000.0).round() as u64;
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<smil xmlns=\"http://www.w3.org/ns/SMIL\" \
         xmlns:epub=\"http://www.idpf.org/2007/ops\" version=\"3.0\">\n<body epub:textref=\"clip-{n}.xhtml#chapter\">\n"
    );
    let (mut open, mut at) = (None, 0);
    for (i, (sentence, _)) in pieces.iter().enumerate() {
        if open != Some(*sentence) {
            if open.is_some() {
                out.push_str("</seq>\n");
            }
            let _ = writeln!(out, "<seq id=\"q{sentence}\" epub:textref=\"clip-{n}.xhtml#p{sentence}\">");
            open = Some(*sentence);
        }
        let next = pieces.get(i + 1).map_or(millis(chapter.duration), |(_, p)| millis(p.start));
        let until = next.max(at + 1);
        let _ = writeln!(
            out,
            "<par id=\"r{0}\"><text src=\"clip-{n}.xhtml#s{0}\"/><audio src=\"clip-{n}.{extension}\" clipBegin=\"{1}\" clipEnd=\"{2}\"/></par>",
            i + 1,
            seconds(at),
            seconds(until)
        );
        at = until;
    }
    if open.is_some() {
        out.push_str("</seq>\n");
    }
    out.push_str("</body>\n</smil>\n");
    out
}

fn seconds(millis: u64) -> String {
    format!("{}.{:03}s", millis / 1000, millis % 1000)
}
