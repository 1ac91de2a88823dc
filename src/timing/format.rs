//! The formats by name, by file name and by content, and the way into and out of each.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use super::{Tier, Timing, csv, cues, decode, json, textgrid};
use crate::disk::{self, Fault, MAX_TEXT_BYTES, Result};

/// A way to write times down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// Praat's TextGrid, the long form. Holds everything but whether the times are guessed.
    TextGrid,
    /// Praat's TextGrid, the short form.
    TextGridShort,
    /// SubRip subtitles: one tier, to the millisecond.
    Srt,
    /// WebVTT subtitles: one tier, to the millisecond.
    WebVtt,
    /// A table with the columns tier, start, end, label.
    Csv,
    /// One object with everything, for machines.
    Json,
}

impl Format {
    /// All of them, in the order they are listed to people.
    pub const ALL: [Self; 6] = [Self::TextGrid, Self::TextGridShort, Self::Srt, Self::WebVtt, Self::Csv, Self::Json];

    /// The name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::TextGrid => "textgrid",
            Self::TextGridShort => "textgrid-short",
            Self::Srt => "srt",
            Self::WebVtt => "vtt",
            Self::Csv => "csv",
            Self::Json => "json",
        }
    }

    /// The usual ending of a file's name, without the point.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::TextGrid | Self::TextGridShort => "TextGrid",
            other => other.name(),
        }
    }

    /// What the ending of a file's name says.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        Self::ALL.into_iter().find(|f| f.extension().to_ascii_lowercase() == extension)
    }

    /// What a file's first lines say, whatever its name.
    #[must_use]
    pub fn sniff(bytes: &[u8]) -> Option<Self> {
        let mut head = &bytes[..bytes.len().min(4096)];
        // The cut may go through a character, or the file be no text further on.
        let text = loop {
            match decode::text(head) {
                Ok(text) => break text,
                Err(_) if head.len() > 4 => head = &head[..head.len() - (head.len() / 2).clamp(1, 4)],
                Err(_) => return None,
            }
        };
        let text = text.trim_start();
        let first = text.lines().next().unwrap_or_default().to_ascii_lowercase();
        if textgrid::is_header(text) {
            Some(if textgrid::is_short(text) { Self::TextGridShort } else { Self::TextGrid })
        } else if first.starts_with("webvtt") {
            Some(Self::WebVtt)
        } else if first.starts_with('{') {
            Some(Self::Json)
        } else if csv::is_header(&first) {
            Some(Self::Csv)
        } else {
            text.lines().take(3).any(|l| l.contains("-->")).then_some(Self::Srt)
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Format {
    type Err = Fault;

    fn from_str(text: &str) -> Result<Self> {
        let wanted = text.to_ascii_lowercase();
        let wanted = if wanted == "webvtt" { "vtt" } else { &wanted };
        Self::ALL.into_iter().find(|f| f.name() == wanted).ok_or_else(|| {
            Fault::new(format!("`{text}` is no timing format"))
                .help(format!("the formats are {}", Self::ALL.map(Self::name).join(", ")))
        })
    }
}

/// Reads times from the bytes of a file. The two forms of TextGrid are told apart by content, whichever is named.
///
/// # Errors
/// With the line and what was found there: anything that is not the format, intervals that overlap or run backwards,
/// times that are no numbers, negative or beyond [`super::MAX_SECONDS`], a file that ends too soon.
pub fn parse(bytes: &[u8], format: Format) -> Result<Timing> {
    let text = decode::text(bytes)?;
    match format {
        Format::TextGrid | Format::TextGridShort => textgrid::parse(&text),
        Format::Srt => cues::parse_srt(&text),
        Format::WebVtt => cues::parse_vtt(&text),
        Format::Csv => csv::parse(&text),
        Format::Json => json::parse(&text),
    }
}

/// Reads a timing file, told by its content, or by its name where the content does not tell.
///
/// # Errors
/// As [`parse`], with the file's path; also when it cannot be read or its format cannot be told.
pub fn read(path: &Path) -> Result<Timing> {
    let bytes = disk::read_bytes(path, MAX_TEXT_BYTES)?;
    let format = Format::sniff(&bytes).or_else(|| Format::from_path(path)).ok_or_else(|| {
        Fault::new("neither its name nor its content says which timing format it is")
            .at(path)
            .help(format!("the formats are {}", Format::ALL.map(Format::name).join(", ")))
    })?;
    parse(&bytes, format).map_err(|fault| fault.at(path))
}

/// Writes times. Subtitles hold one tier: the words, or else the syllables, or else the first.
#[must_use]
pub fn write(timing: &Timing, format: Format) -> String {
    let subtitles = || timing.subtitles().map_or(&[][..], |tier| tier.intervals.as_slice());
    match format {
        Format::TextGrid => textgrid::write(timing, false),
        Format::TextGridShort => textgrid::write(timing, true),
        Format::Srt => cues::write_srt(subtitles()),
        Format::WebVtt => cues::write_vtt(subtitles()),
        Format::Csv => csv::write(timing),
        Format::Json => json::write(timing),
    }
}

/// Writes one tier alone.
///
/// # Errors
/// When there is none of that name, with the names there are.
pub fn write_tier(timing: &Timing, format: Format, name: &str) -> Result<String> {
    let Some(tier) = timing.tier(name) else {
        let names: Vec<&str> = timing.tiers.iter().map(|t: &Tier| t.name.as_str()).collect();
        return Err(
            Fault::new(format!("there is no tier `{name}`")).help(format!("the tiers are {}", names.join(", ")))
        );
    };
    Ok(write(&Timing { tiers: vec![tier.clone()], ..*timing }, format))
}
