//! Compact records whole: from tables and to them.

use std::io::Read;

use super::{LprReader, LprWriter, Moment};
use crate::disk::{Fault, FileFault, Result};
use crate::ratios::{Record, Tracks};

/// Frames to a packet of a file.
const IN_A_FILE: u32 = 64;

/// Longest record that is held whole: 44 hours at 25 frames a second.
const MAX_ROWS: usize = 4_000_000;

/// All that a compact record has.
#[derive(Debug)]
pub struct Whole {
    /// Frames a second.
    pub fps: f64,
    /// The ratios; up to the damage, where there is any.
    pub record: Record,
    /// The tracks, of the frames that have them; none of a record without.
    pub tracks: Option<Tracks>,
    /// Where and how it is cut or damaged.
    pub damage: Option<Fault>,
}

impl Whole {
    /// Reads a compact record to its end or to the damage.
    ///
    /// # Errors
    /// When it is no record at all, is longer than 4,000,000 frames, or not a single frame of it can be read.
    pub fn read(input: impl Read) -> Result<Self> {
        let mut reader = LprReader::new(input)?;
        let mut whole = Self { fps: reader.fps(), record: Record::default(), tracks: None, damage: None };
        let mut tracks = Tracks::default();
        loop {
            match reader.next_moment() {
                Ok(Some(_)) if whole.record.rows.len() >= MAX_ROWS => {
                    let what = format!("the record has more than {MAX_ROWS} frames");
                    return Err(Fault::new(what).help("lessons are far shorter; is it the right one?"));
                }
                Ok(Some(moment)) => {
                    whole.record.rows.push(moment.row);
                    tracks.rows.extend(moment.track);
                }
                Ok(None) if whole.record.rows.is_empty() => {
                    return Err(Fault::of(FileFault::Empty, "the record has no frames")
                        .help("there is nothing to read: was it recorded?"));
                }
                Ok(None) => break,
                Err(fault) if whole.record.rows.is_empty() => return Err(fault),
                Err(fault) => {
                    whole.damage = Some(fault);
                    break;
                }
            }
        }
        whole.tracks = (!tracks.rows.is_empty()).then_some(tracks);
        Ok(whole)
    }
}

/// A record as a compact file, with the tracks of the same frames where there are any.
///
/// # Errors
/// When `fps` or a value cannot be, or frames or times do not rise.
pub fn to_lpr(record: &Record, tracks: Option<&Tracks>, fps: f64) -> Result<Vec<u8>> {
    let mut writer = LprWriter::new(Vec::new(), fps, tracks.is_some())?.in_packets_of(IN_A_FILE);
    let mut left = tracks.map(|t| t.rows.iter().peekable());
    for row in &record.rows {
        let track = left.as_mut().and_then(|rows| {
            while rows.next_if(|t| t.frame < row.frame).is_some() {}
            rows.next_if(|t| t.frame == row.frame).copied()
        });
        writer.push(&Moment { row: *row, track })?;
    }
    writer.finish()
}
