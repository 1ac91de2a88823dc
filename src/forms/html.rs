//! A lesson as one page that needs nothing beside it: picture, sound and script of its clips.
//!
//! The script is ordinary text of the page, with its readings over it; a page without scripts still shows it.

use std::fmt::Write;

use serde_json::{Value, json};

use super::base64::data_uri;
use super::escaped;
use super::packed::packed;
use super::sound::Encoded;
use crate::forms::parts::Parts;
use crate::forms::said::{self, Phrase, Piece};

const PAGE: &str = include_str!("player.html");
const STYLE: &str = include_str!("player.css");
const SCRIPT: &str = include_str!("player.js");

/// What the page needs of a clip.
pub(crate) struct Shown<'a> {
    /// Its name.
    pub name: &'a str,
    /// The lesson's title.
    pub title: &'a str,
    /// What is said, for those who cannot see or hear it.
    pub description: String,
    /// Seconds.
    pub duration: f64,
    /// The face.
    pub parts: &'a Parts,
    /// Its sound.
    pub sound: Option<&'a Encoded>,
    /// Its script.
    pub phrases: Vec<Phrase>,
    /// Whether it is written in Zhuyin, which is then its reading too.
    pub zhuyin: bool,
}

/// What is made of clips one by one, so that only one is in memory as parts.
#[derive(Default)]
pub(crate) struct Page {
    names: Vec<String>,
    scripts: String,
    sounds: String,
    clips: Vec<Value>,
    readings: bool,
    speaks: bool,
    zhuyin: Option<bool>,
    size: [u32; 2],
}

impl Page {
    /// Takes a clip in.
    pub(crate) fn add(&mut self, clip: &Shown<'_>) {
        let number = self.clips.len();
        if number == 0 {
            self.size = clip.parts.grid.size;
        }
        self.names.push(clip.name.to_owned());
        let mut data = packed(clip.parts);
        data["name"] = json!(clip.name);
        data["duration"] = json!(clip.duration);
        data["about"] = json!(clip.description);
        self.clips.push(data);
        if let Some(sound) = clip.sound {
            let _ = writeln!(
                self.sounds,
                "<audio id=\"sound-{number}\" preload=\"auto\" src=\"{}\"></audio>",
                data_uri(sound.mime, &sound.bytes)
            );
        }
        let hidden = if number == 0 { "" } else { " hidden" };
        let pieces = || clip.phrases.iter().flat_map(|p| &p.pieces);
        let lang = said::language(&clip.phrases, clip.title);
        self.speaks |= !clip.phrases.is_empty();
        if pieces().any(|p| !p.zhuyin.is_empty()) {
            self.readings = true;
            self.zhuyin.get_or_insert(clip.zhuyin);
        }
        let _ = writeln!(self.scripts, "<section id=\"said-{number}\" lang=\"{lang}\"{hidden}>");
        if clip.phrases.is_empty() {
            self.scripts.push_str("<p class=\"none\" lang=\"en\">Nothing is said in this clip.</p>\n");
        }
        write_script(&mut self.scripts, &clip.phrases);
        self.scripts.push_str("</section>\n");
    }

    /// The page.
    pub(crate) fn done(self, title: &str) -> String {
        let tabs: String = self
            .names
            .iter()
            .enumerate()
            .map(|(i, name)| format!("<button type=\"button\" data-clip=\"{i}\">{}</button>\n", escaped(name)))
            .collect();
        let many = if self.names.len() > 1 { "" } else { " hidden" };
        let readings = if self.readings { "" } else { " hidden" };
        let reading = if self.zhuyin == Some(true) { "zhuyin" } else { "pinyin" };
        let choices: String = [("pinyin", "Pinyin"), ("zhuyin", "Zhuyin"), ("none", "None")]
            .map(|(value, word)| {
                let chosen = if value == reading { " selected" } else { "" };
                format!("<option value=\"{value}\"{chosen}>{word}</option>")
            })
            .concat();
        let silent = if self.speaks { "" } else { " silent" };
        // Inside a script element only its end could be taken for markup.
        let data = json!(self.clips).to_string().replace('<', "\\u003c");
        let [width, height] = self.size;
        filled(PAGE, &|name| match name {
            "TITLE" => escaped(title),
            "WIDTH" => width.to_string(),
            "HEIGHT" => height.to_string(),
            "STYLE" => STYLE.to_owned(),
            "MANY" => many.to_owned(),
            "TABS" => tabs.clone(),
            "READINGS" => readings.to_owned(),
            "READING" => reading.to_owned(),
            "CHOICES" => choices.clone(),
            "SILENT" => silent.to_owned(),
            "SCRIPTS" => self.scripts.clone(),
            "SOUNDS" => self.sounds.clone(),
            "DATA" => data.clone(),
            "CODE" => SCRIPT.to_owned(),
            _ => String::new(),
        })
    }
}

/// A template with what stands for each `{{NAME}}` in it; what is put in is not looked through again.
pub(crate) fn filled(template: &str, value: &dyn Fn(&str) -> String) -> String {
    let mut out = String::new();
    let mut rest = template;
    while let Some((before, (name, after))) = rest.split_once("{{").and_then(|(b, r)| Some((b, r.split_once("}}")?))) {
        out.push_str(before);
        out.push_str(&value(name));
        rest = after;
    }
    out + rest
}

/// A paragraph a sentence, and in it a cell a syllable; what is written next to a syllable stays on its line.
fn write_script(out: &mut String, phrases: &[Phrase]) {
    let mut open = None;
    for phrase in phrases {
        if open != Some(phrase.sentence) {
            if open.is_some() {
                out.push_str("</p>\n");
            }
            out.push_str("<p>");
            open = Some(phrase.sentence);
        }
        for piece in &phrase.pieces {
            write_piece(out, piece);
        }
    }
    if open.is_some() {
        out.push_str("</p>\n");
    }
}

fn write_piece(out: &mut String, piece: &Piece) {
    let lang = if piece.english { " lang=\"en\"" } else { "" };
    let after = piece.after.trim_end();
    let is_alone = piece.before.is_empty() && after.is_empty();
    if !is_alone {
        let _ = write!(out, "<span class=\"on\">{}", escaped(&piece.before));
    }
    let (start, end) = (piece.start, piece.end);
    let _ = write!(out, "<span data-from=\"{start:.3}\" data-to=\"{end:.3}\"{lang}>{}</span>", ruby(piece));
    if !is_alone {
        let _ = write!(out, "{}</span>", escaped(after));
    }
    out.push_str(&escaped(&piece.after[after.len()..]));
}

/// A piece under its readings.
pub(crate) fn ruby(piece: &Piece) -> String {
    let text = escaped(&piece.text);
    if piece.pinyin.is_empty() && piece.zhuyin.is_empty() {
        return text;
    }
    format!(
        "<ruby>{text}<rt class=\"pinyin\" lang=\"zh-Latn-pinyin\">{}</rt><rt class=\"zhuyin\" lang=\"zh-Bopo\">{}</rt></ruby>",
        escaped(&piece.pinyin),
        escaped(&piece.zhuyin)
    )
}
