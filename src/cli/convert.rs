//! `lianpu convert`: timing files and ratio records, file to file. What a file is, its content says.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};

use super::output::spare;
use super::output_fault;
use super::print;
use crate::disk::{self, Fault, MAX_TEXT_BYTES, Result};
use crate::ratios::import::{self, Kind as Ratios};
use crate::ratios::{Record, Tracks, Whole, to_lpr};
use crate::timing::{self, Format};

/// What `lianpu convert` is asked.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The file to convert; its content tells what it is
    file: PathBuf,
    /// Times: textgrid, textgrid-short, srt, vtt, csv, json, audacity, ctm, lab. Mouth shapes: these and rhubarb-tsv,
    /// rhubarb-json, rhubarb-xml, moho. Ratios, also those of OpenFace, mediapipe and ARKit files: csv, json, lpr
    #[arg(long, value_name = "FORMAT")]
    to: String,
    /// Where to write; without it to standard output
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// The one tier to write; without it all, or for formats of one tier the words, else the syllables
    #[arg(long, value_name = "NAME")]
    tier: Option<String>,
    /// The tracks (eyes, mouth, head) of a ratio record. To lpr they are read from here, or from the tracks.csv beside a
    /// ratios.csv; from other forms they are written here, as CSV
    #[arg(long, value_name = "FILE")]
    tracks: Option<PathBuf>,
    /// The calibrated face (a folder faces/NAME) of whoever is seen: points of OpenFace or mediapipe are read by it
    #[arg(long, value_name = "FOLDER")]
    face: Option<PathBuf>,
    /// Frames a second of a Moho file, read or written, which does not say it; 24 where left out. Of a compact record; told
    /// from its times where left out
    #[arg(long, value_name = "FPS", value_parser = clap::value_parser!(u32).range(1..=240))]
    fps: Option<u32>,
}

/// Converts one file.
///
/// # Errors
/// Of the call: a format that is unknown or cannot hold this, a tier that is not there. Of the input: a file that
/// cannot be read, or has nothing to write.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    if let Some(path) = &args.out {
        let tracks = args.tracks.as_deref();
        let inputs: Vec<&Path> = [Some(args.file.as_path()), tracks].into_iter().flatten().collect();
        spare(path, &inputs)?;
    }
    let bytes = disk::read_bytes(&args.file, MAX_TEXT_BYTES)?;
    match Kind::of(&bytes) {
        Kind::Ratios(kind) => return ratios(args, &bytes, kind, out),
        Kind::Tracks => {
            return Err(Fault::new("the tracks of a clip have no other form than CSV by themselves")
                .at(&args.file)
                .help("give the ratios beside them: lianpu convert ratios.csv --to lpr takes both")
                .of_the_call());
        }
        Kind::Times => {}
    }
    if args.to == "lpr" || args.tracks.is_some() || args.face.is_some() {
        let what =
            if args.to == "lpr" { "this cannot be written as `lpr`" } else { "`--tracks` and `--face` are for ratios" };
        return Err(Fault::new(what).at(&args.file).help("only ratio records have that").of_the_call());
    }
    let text = times(args, args.to.parse().map_err(Fault::of_the_call)?)?;
    put(args.out.as_deref(), text.as_bytes(), out)
}

/// Writes what was asked for.
fn put(to: Option<&Path>, bytes: &[u8], out: &mut dyn Write) -> Result<()> {
    match to {
        Some(path) => disk::write_output(path, bytes),
        None => out.write_all(bytes).map_err(output_fault),
    }
}

/// What a file holds.
enum Kind {
    Times,
    Ratios(Ratios),
    Tracks,
}

impl Kind {
    /// Ratio records are an array in JSON, times an object; tables are told by their headers.
    fn of(bytes: &[u8]) -> Self {
        let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]);
        let head = head.trim_start_matches('\u{FEFF}').trim_start();
        match Ratios::of(bytes) {
            Some(kind) => Self::Ratios(kind),
            None if Tracks::is_header(head) => Self::Tracks,
            None if head.starts_with('[') => Self::Ratios(Ratios::Json),
            None => Self::Times,
        }
    }
}

/// The forms of a ratio record.
enum To {
    Csv,
    Json,
    Lpr,
}

fn ratios(args: &Args, bytes: &[u8], kind: Ratios, out: &mut dyn Write) -> Result<()> {
    let call = |what: String| Fault::new(what).at(&args.file).help("its formats are csv, json, lpr").of_the_call();
    let to = match args.to.as_str() {
        "csv" => To::Csv,
        "json" => To::Json,
        "lpr" => To::Lpr,
        other => return Err(call(format!("a ratio record cannot be written as `{other}`"))),
    };
    if let Some(tier) = &args.tier {
        return Err(call(format!("a ratio record has no tier `{tier}`")));
    }
    if matches!(to, To::Lpr) && args.out.is_none() && std::io::stdout().is_terminal() {
        let fault = Fault::new("a compact record is not text, and standard output is a terminal");
        return Err(fault.help("give `--out FILE.lpr`, or pipe it").of_the_call());
    }
    let at = |fault: Fault| fault.at(&args.file);
    let mut damage = None;
    let (record, own, notes, said) = if kind == Ratios::Lpr {
        let whole = Whole::read(bytes).map_err(at)?;
        damage = whole.damage;
        (whole.record, whole.tracks, Vec::new(), Some(whole.fps))
    } else if kind == Ratios::Json {
        let text = disk::read_text(&args.file)?;
        (Record::parse_json(&text).map_err(at)?, None, Vec::new(), None)
    } else {
        let calibration = args.face.as_deref().map(super::calibration_of).transpose()?;
        let (record, tracks, notes) = import::parse(bytes, calibration.as_ref()).map_err(at)?;
        (record, tracks, notes, None)
    };
    for note in notes {
        print::note(note);
    }
    match to {
        To::Lpr => {
            let tracks = if own.is_some() { own } else { beside(args)? };
            let fps = args.fps.map(f64::from).or(said).unwrap_or_else(|| record.fps());
            put(args.out.as_deref(), &to_lpr(&record, tracks.as_ref(), fps).map_err(at)?, out)?;
        }
        To::Csv | To::Json => {
            let text = if matches!(to, To::Json) { record.to_json() } else { record.to_csv() };
            match (&own, &args.tracks) {
                (Some(tracks), Some(path)) => {
                    spare(path, &[&args.file])?;
                    disk::write_output(path, tracks.to_csv().as_bytes())?;
                }
                (Some(_), None) => print::note("eyes, mouth and head are left out; `--tracks FILE` writes them"),
                (None, Some(_)) => {
                    return Err(Fault::new("the file has no eyes, mouth and head to write").at(&args.file));
                }
                (None, None) => {}
            }
            put(args.out.as_deref(), text.as_bytes(), out)?;
        }
    }
    // What could be read is written; that it is not all must not go unseen.
    match damage {
        Some(fault) => Err(fault.at(&args.file)),
        None => Ok(()),
    }
}

/// The tracks that go with a `ratios.csv`: those that are named, or the `tracks.csv` in its folder.
fn beside(args: &Args) -> Result<Option<Tracks>> {
    let path = match &args.tracks {
        Some(path) => path.clone(),
        None => {
            let next = args.file.with_file_name("tracks.csv");
            if args.file.file_stem().is_none_or(|stem| stem != "ratios") || !next.is_file() {
                return Ok(None);
            }
            next
        }
    };
    Tracks::parse(&disk::read_text(&path)?).map(Some).map_err(|fault| fault.at(&path))
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
