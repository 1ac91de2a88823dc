//! The formats by name, by file name and by content, and the way into and out of each.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use super::{Tier, Timing, audacity, clock, csv, ctm, cues, decode, json, lab, moho, rhubarb, shapes, textgrid};
use crate::disk::{self, Fault, FileFault, MAX_TEXT_BYTES, Result, Setting, message};

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
    /// Audacity's labels: one tier.
    Audacity,
    /// Time marked conversations of NIST and Kaldi: one tier, labels without blanks.
    Ctm,
    /// HTK's labels: one tier, labels without blanks.
    Lab,
    /// Mouth shapes of Rhubarb Lip Sync, as a table.
    RhubarbTsv,
    /// The same in JSON.
    RhubarbJson,
    /// The same in XML.
    RhubarbXml,
    /// Switch data of Moho and Papagayo: mouth shapes at 24 frames a second.
    Moho,
}

impl Format {
    /// All of them, in the order they are listed to people.
    pub const ALL: [Self; 13] = [
        Self::TextGrid,
        Self::TextGridShort,
        Self::Srt,
        Self::WebVtt,
        Self::Csv,
        Self::Json,
        Self::Audacity,
        Self::Ctm,
        Self::Lab,
        Self::RhubarbTsv,
        Self::RhubarbJson,
        Self::RhubarbXml,
        Self::Moho,
    ];

    /// The name on the command line.
    #[must_use]
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::TextGrid => "textgrid",
            Self::TextGridShort => "textgrid-short",
            Self::Srt => "srt",
            Self::WebVtt => "vtt",
            Self::Csv => "csv",
            Self::Json => "json",
            Self::Audacity => "audacity",
            Self::Ctm => "ctm",
            Self::Lab => "lab",
            Self::RhubarbTsv => "rhubarb-tsv",
            Self::RhubarbJson => "rhubarb-json",
            Self::RhubarbXml => "rhubarb-xml",
            Self::Moho => "moho",
        }
    }

    /// The usual ending of a file's name, without the point.
    #[must_use]
    pub(crate) const fn extension(self) -> &'static str {
        match self {
            Self::TextGrid | Self::TextGridShort => "TextGrid",
            Self::Audacity => "txt",
            Self::RhubarbTsv => "tsv",
            Self::RhubarbJson => "json",
            Self::RhubarbXml => "xml",
            Self::Moho => "dat",
            other => other.name(),
        }
    }

    /// Whether it holds one tier only: the words, or else the syllables, or the one that is named.
    #[must_use]
    pub const fn holds_one_tier(self) -> bool {
        matches!(self, Self::Srt | Self::WebVtt | Self::Audacity | Self::Ctm | Self::Lab)
    }

    /// Whether it holds nothing but mouth shapes.
    #[must_use]
    pub(crate) const fn holds_shapes(self) -> bool {
        matches!(self, Self::RhubarbTsv | Self::RhubarbJson | Self::RhubarbXml | Self::Moho)
    }

    /// What the ending of a file's name says.
    #[must_use]
    pub(crate) fn from_path(path: &Path) -> Option<Self> {
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
        let text = text.trim_start_matches(['\n', ' ']);
        let first = text.lines().next().unwrap_or_default().to_ascii_lowercase();
        if textgrid::is_header(text) {
            return Some(if textgrid::is_short(text) { Self::TextGridShort } else { Self::TextGrid });
        }
        if first.starts_with("webvtt") {
            return Some(Self::WebVtt);
        }
        if first.trim_end() == moho::HEADER.to_ascii_lowercase() {
            return Some(Self::Moho);
        }
        if first.starts_with('{') {
            return Some(if text.contains("\"mouthCues\"") { Self::RhubarbJson } else { Self::Json });
        }
        if first.starts_with("<?xml") || first.starts_with("<rhubarbresult") {
            return text.contains("<rhubarbResult").then_some(Self::RhubarbXml);
        }
        if csv::is_header(&first) {
            return Some(Self::Csv);
        }
        let is_cue = |line: &str| line.split_once("-->").is_some_and(|(start, _)| clock::parse_clock(start).is_some());
        if text.lines().take(3).any(is_cue) {
            return Some(Self::Srt);
        }
        Self::of_lines(text, head.len() < bytes.len())
    }

    /// Told by what each line looks like; the last is left out where it may be cut.
    fn of_lines(text: &str, cut: bool) -> Option<Self> {
        let count = text.lines().count();
        let whole = if cut && count > 1 { count - 1 } else { count };
        let lines = || text.lines().take(whole).filter(|line| !line.trim().is_empty());
        let all = |is: fn(&str) -> bool| lines().next().is_some() && lines().all(is);
        if all(rhubarb::is_line) {
            Some(Self::RhubarbTsv)
        } else if all(|line| ctm::is_line(line) || ctm::is_remark(line)) && !all(ctm::is_remark) {
            Some(Self::Ctm)
        } else if lines().next().is_some_and(audacity::is_line) && !lines().next().is_some_and(lab::in_units) {
            Some(Self::Audacity)
        } else if lines().next().is_some_and(lab::is_line) {
            Some(Self::Lab)
        } else {
            None
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
        let wanted = match wanted.as_str() {
            "webvtt" => "vtt",
            "tsv" | "rhubarb" => "rhubarb-tsv",
            "dat" | "papagayo" => "moho",
            wanted => wanted,
        };
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
    parse_at(bytes, format, moho::FPS)
}

/// `fps` is the rate of a Moho file that does not say it.
fn parse_at(bytes: &[u8], format: Format, fps: f64) -> Result<Timing> {
    let text = decode::text(bytes)?;
    match format {
        Format::TextGrid | Format::TextGridShort => textgrid::parse(&text),
        Format::Srt => cues::parse_srt(&text),
        Format::WebVtt => cues::parse_vtt(&text),
        Format::Csv => csv::parse(&text),
        Format::Json => json::parse(&text),
        Format::Audacity => audacity::parse(&text),
        Format::Ctm => ctm::parse(&text),
        Format::Lab => lab::parse(&text),
        Format::RhubarbTsv => rhubarb::parse_tsv(&text),
        Format::RhubarbJson => rhubarb::parse_json(&text),
        Format::RhubarbXml => rhubarb::parse_xml(&text),
        Format::Moho => moho::parse(&text, fps),
    }
}

/// Reads a timing file, told by its content, or by its name where the content does not tell.
///
/// # Errors
/// As [`parse`], with the file's path; also when it cannot be read or its format cannot be told.
pub fn read(path: &Path) -> Result<Timing> {
    read_at(path, moho::FPS)
}

/// The same, where a Moho file that does not say its rate has `fps` frames a second, a number above 0.
///
/// # Errors
/// As [`read`].
pub fn read_at(path: &Path, fps: f64) -> Result<Timing> {
    let bytes = disk::read_bytes(path, MAX_TEXT_BYTES)?;
    let format = Format::sniff(&bytes).or_else(|| Format::from_path(path)).ok_or_else(|| {
        Fault::of(FileFault::Unsupported, "neither its name nor its content says which timing format it is")
            .at(path)
            .help(format!("the formats are {}", Format::ALL.map(Format::name).join(", ")))
    })?;
    parse_at(&bytes, format, fps).map_err(|fault| fault.at(path))
}

/// Makes sure that a format can hold something of these times.
///
/// # Errors
/// Where it holds one tier and none says anything, or mouth shapes and there is no tier of them.
pub fn writable(timing: &Timing, format: Format) -> Result<()> {
    if format.holds_shapes() {
        let none = || {
            Fault::of(
                FileFault::Unknown,
                format!("`{format}` holds mouth shapes, and there is no tier `{}`", shapes::TIER),
            )
            .help("write it as textgrid, srt, vtt, csv, json, audacity, ctm or lab")
        };
        return shapes::check_shapes(timing.shapes().ok_or_else(none)?);
    }
    let nothing = timing.subtitles().is_none_or(|tier| tier.intervals.is_empty());
    if nothing && format.holds_one_tier() {
        return Err(Fault::of(FileFault::Empty, "there is no label to write")
            .help(message!["name another tier by ", Setting::Tier]));
    }
    Ok(())
}

/// Writes times. Subtitles and lists of labels hold one tier: the words, or else the syllables, or else the first.
/// Formats of mouth shapes hold the tier `shapes`, or silence where there is none: ask [`writable`] before.
#[must_use]
pub fn write(timing: &Timing, format: Format) -> String {
    let one = || timing.subtitles().map_or(&[][..], |tier| tier.intervals.as_slice());
    match format {
        Format::TextGrid => textgrid::write(timing, false),
        Format::TextGridShort => textgrid::write(timing, true),
        Format::Srt => cues::write_srt(one()),
        Format::WebVtt => cues::write_vtt(one()),
        Format::Csv => csv::write(timing),
        Format::Json => json::write(timing),
        Format::Audacity => audacity::write(one()),
        Format::Ctm => ctm::write(one()),
        Format::Lab => lab::write(one()),
        Format::RhubarbTsv => rhubarb::write_tsv(timing),
        Format::RhubarbJson => rhubarb::write_json(timing),
        Format::RhubarbXml => rhubarb::write_xml(timing),
        Format::Moho => moho::write(timing),
    }
}

/// Writes one tier alone.
///
/// # Errors
/// When there is none of that name, with the names there are; when the format cannot hold it.
pub fn write_tier(timing: &Timing, format: Format, name: &str) -> Result<String> {
    let Some(tier) = timing.tier(name) else {
        let names: Vec<&str> = timing.tiers.iter().map(|t: &Tier| t.name.as_str()).collect();
        return Err(Fault::of(FileFault::Unknown, format!("there is no tier `{name}`"))
            .help(format!("the tiers are {}", names.join(", "))));
    };
    let mut tier = tier.clone();
    if format.holds_shapes() {
        shapes::check_shapes(&tier)?;
        shapes::TIER.clone_into(&mut tier.name);
    }
    let alone = Timing { tiers: vec![tier], ..*timing };
    writable(&alone, format)?;
    Ok(write(&alone, format))
}
