//! `lianpu convert`: timing files and ratio records, file to file. What a file is, its content says.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::output_fault;
use crate::disk::{self, Fault, MAX_TEXT_BYTES, Result};
use crate::emotion::{Record, Tracks};
use crate::timing::{self, Format};

/// What `lianpu convert` is asked.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The file to convert; its content tells what it is
    file: PathBuf,
    /// Times: textgrid, textgrid-short, srt, vtt, csv, json, audacity, ctm, lab. Mouth shapes: these and rhubarb-tsv,
    /// rhubarb-json, rhubarb-xml, moho. Ratios: csv, json
    #[arg(long, value_name = "FORMAT")]
    to: String,
    /// Where to write; without it to standard output
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// The one tier to write; without it all, or for formats of one tier the words, else the syllables
    #[arg(long, value_name = "NAME")]
    tier: Option<String>,
    /// Frames a second of a Moho file, read or written, which does not say it; 24 where left out
    #[arg(long, value_name = "FPS", value_parser = clap::value_parser!(u32).range(1..=240))]
    fps: Option<u32>,
}

/// Converts one file.
///
/// # Errors
/// Of the call: a format that is unknown or cannot hold this, a tier that is not there. Of the input: a file that
/// cannot be read, or has nothing to write.
pub fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let to: Format = args.to.parse().map_err(Fault::of_the_call)?;
    let bytes = disk::read_bytes(&args.file, MAX_TEXT_BYTES)?;
    let text = match Kind::of(&bytes) {
        Kind::Ratios => ratios(&args.file, to, args.tier.as_deref())?,
        Kind::Tracks => {
            return Err(Fault::new("the tracks of a clip have no other form than CSV")
                .at(&args.file)
                .help("give a timing file or a ratio record")
                .of_the_call());
        }
        Kind::Times => times(args, to)?,
    };
    match &args.out {
        Some(path) => disk::write_whole(path, text.as_bytes()),
        None => out.write_all(text.as_bytes()).map_err(output_fault),
    }
}

/// What a file holds.
enum Kind {
    Times,
    Ratios,
    Tracks,
}

impl Kind {
    /// Ratio records are an array in JSON, times an object; tables are told by their headers.
    fn of(bytes: &[u8]) -> Self {
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]);
        let head = head.trim_start_matches('\u{FEFF}').trim_start();
        if head.starts_with('[') || Record::is_header(head) {
            Self::Ratios
        } else if Tracks::is_header(head) {
            Self::Tracks
        } else {
            Self::Times
        }
    }
}

fn ratios(path: &Path, to: Format, tier: Option<&str>) -> Result<String> {
    if !matches!(to, Format::Csv | Format::Json) || tier.is_some() {
        let what = match tier {
            Some(tier) => format!("a ratio record has no tier `{tier}`"),
            None => format!("a ratio record cannot be written as `{to}`"),
        };
        return Err(Fault::new(what).at(path).help("its formats are csv, json").of_the_call());
    }
    let text = disk::read_text(path)?;
    let record = if text.trim_start().starts_with('[') { Record::parse_json(&text) } else { Record::parse(&text) };
    let record = record.map_err(|fault| fault.at(path))?;
    Ok(if to == Format::Json { record.to_json() } else { record.to_csv() })
}

fn times(args: &Args, to: Format) -> Result<String> {
    let fps = args.fps.map_or(timing::MOHO_FPS, f64::from);
    let mut timing = timing::read_at(&args.file, fps)?;
    if to == Format::Moho {
        timing.stretch(fps / timing::MOHO_FPS);
    }
    if let Some(name) = &args.tier {
        return timing::write_tier(&timing, to, name).map_err(|fault| fault.at(&args.file).of_the_call());
    }
    timing::writable(&timing, to).map_err(|fault| fault.at(&args.file))?;
    Ok(timing::write(&timing, to))
}
