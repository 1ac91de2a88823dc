//! The frames of a clip as PNG files, put together from pieces.
//!
//! A row of tiles is a stretch of compressed data that stands by itself. What stays the same in a clip is compressed
//! once, as well as can be; what moves is told tile by tile in the codes of one table, which is made from a few frames
//! of the clip. Which those are is fixed, so a frame has the same bytes whichever frames are written, in which order, and
//! by how many threads.

use std::ops::Range;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use miniz_oxide::deflate::core::{CompressorOxide, TDEFLFlush, compress_to_output, create_comp_flags_from_zip_params};

use super::adler::Sum;
use super::canvas::{Area, Canvas};
use super::huffman::Bits;
use super::piece::{Piece, Stretch, count, filtered, tell_band};
use super::pixels::Plan;
use super::png::{SIGNATURE, chunk, text_chunk};
use super::print::{ByPrint, Print};
use super::recent::Recent;
use super::tiles::TILE;
use super::tokens::{Counts, Table};
use super::{Painter, encode_png};
use crate::disk::Result;
use crate::drawing::{Drawing, Picture};

/// Bytes of pieces, and of whole bands, that are kept.
const PIECES: usize = 16 << 20;
const BANDS: usize = 4 << 20;

/// Bytes for the names of tiles that have been there.
const SEEN: usize = 1 << 20;

/// What shrinks to less than this part of its size is no photo.
const PHOTO: usize = 4;

/// What the frames of a clip have in common: bands that stay the same, and codes for what does not.
pub struct ClipCoder {
    size: (u32, u32),
    channels: usize,
    table: Table,
    still: ByPrint<Arc<Band>>,
    /// From the signature to the pixels.
    head: Vec<u8>,
    kept: Mutex<Kept>,
}

/// What all threads have told.
struct Kept {
    pieces: Recent<Arc<Piece>>,
    bands: Recent<Arc<Band>>,
    /// Tiles that have been told once and not kept.
    seen: Recent<()>,
}

/// A row of tiles as an `IDAT` chunk.
struct Band {
    chunk: Vec<u8>,
    sum: Sum,
}

/// Writes frames of a clip. Every thread has its own.
pub struct FrameCoder<'a> {
    clip: &'a ClipCoder,
    painter: Painter,
    bits: Bits,
    data: Vec<u8>,
}

impl ClipCoder {
    /// Learns from some frames of a clip, which must always be the same ones.
    ///
    /// # Errors
    /// When the size is none that can be painted.
    pub fn new(width: u32, height: u32, samples: &[Drawing]) -> Result<Self> {
        let mut painter = Painter::new(width, height)?;
        let mut seen: ByPrint<u32> = ByPrint::default();
        let mut channels = 3;
        for drawing in samples {
            let plan = painter.plan(drawing);
            band_prints(&plan, painter.grid().columns).for_each(|print| *seen.entry(print).or_default() += 1);
            if !plan.is_opaque() {
                channels = 4;
            }
        }
        let mut counts = Counts::new();
        let mut still = ByPrint::default();
        for drawing in samples {
            let plan = painter.plan(drawing);
            painter.refresh(&plan, |_| true);
            for (row, print) in band_prints(&plan, painter.grid().columns).enumerate() {
                let area = band_area(row, (width, height));
                if seen[&print] > 1 || samples.len() == 1 {
                    let band = || Arc::new(Band::best(painter.canvas(), area, channels));
                    still.entry(print).or_insert_with(band);
                } else {
                    count(painter.canvas(), area, channels, &mut counts);
                }
            }
        }
        Ok(Self {
            size: (width, height),
            channels,
            table: Table::new(&counts, channels),
            still,
            head: head((width, height), channels),
            kept: Mutex::new(Kept::new(BANDS, SEEN)),
        })
    }

    /// Something to write its frames with.
    ///
    /// # Errors
    /// As for [`ClipCoder::new`].
    pub fn frames(&self) -> Result<FrameCoder<'_>> {
        let painter = Painter::new(self.size.0, self.size.1)?;
        Ok(FrameCoder { clip: self, painter, bits: Bits::default(), data: Vec::new() })
    }

    /// The same, but all that moves is told anew in every frame, also what was there before: for measurements.
    #[must_use]
    pub fn forgetful(self) -> Self {
        Self { kept: Mutex::new(Kept::new(0, 0)), ..self }
    }

    /// What has been told before. Whether something is there decides how fast a frame is told, not what its bytes are.
    fn kept(&self) -> MutexGuard<'_, Kept> {
        // A thread that stopped in the middle leaves nothing half done.
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Kept {
    fn new(bands: usize, seen: usize) -> Self {
        Self { pieces: Recent::new(PIECES), bands: Recent::new(bands), seen: Recent::new(seen) }
    }
}

impl FrameCoder<'_> {
    /// The PNG file of a drawing: RGB where nothing lets through what is behind it, else RGBA. `key` goes into a text
    /// chunk after the pixels.
    ///
    /// # Errors
    /// When it cannot be encoded.
    pub fn encode(&mut self, drawing: &Drawing, key: &str) -> Result<Vec<u8>> {
        let mut file = Vec::new();
        self.encode_into(drawing, key, &mut file)?;
        Ok(file)
    }

    /// The same, appended to `file`.
    ///
    /// # Errors
    /// As for [`FrameCoder::encode`].
    pub fn encode_into(&mut self, drawing: &Drawing, key: &str, file: &mut Vec<u8>) -> Result<()> {
        let painted = self.paint(drawing);
        self.tell(painted, key, file)
    }

    /// The first half of encoding: paints what has not been told before.
    #[must_use]
    pub fn paint(&mut self, drawing: &Drawing) -> Painted {
        let Self { clip, painter, .. } = self;
        let plan = painter.plan(drawing);
        if clip.channels == 3 && !plan.is_opaque() {
            // None of the samples was like this one.
            return Painted(Found::Other(painter.paint(drawing)));
        }
        let grid = painter.grid();
        let columns = grid.columns;
        let prints: Vec<Print> = band_prints(&plan, columns).collect();
        let mut kept = clip.kept();
        let found: Vec<Option<Arc<Band>>> =
            prints.iter().map(|print| clip.still.get(print).cloned().or_else(|| kept.bands.get(print))).collect();
        let mut parts: Vec<Part> = Vec::with_capacity(64);
        for row in (0..grid.rows).filter(|row| found[*row].is_none()) {
            divide(&plan, row * columns..(row + 1) * columns, &mut kept, &mut parts);
        }
        drop(kept);
        let mut missing = vec![false; plan.prints.len()];
        for part in parts.iter().filter(|part| part.piece.is_none()) {
            missing[part.tiles.clone()].fill(true);
        }
        painter.refresh(&plan, |tile| missing[tile]);
        Painted(Found::Bands { prints, found, parts })
    }

    /// The second half: appends the file to `file`, before anything else is painted.
    ///
    /// # Errors
    /// As for [`FrameCoder::encode`].
    pub fn tell(&mut self, painted: Painted, key: &str, file: &mut Vec<u8>) -> Result<()> {
        let (prints, mut found, mut parts) = match painted.0 {
            Found::Bands { prints, found, parts } => (prints, found, parts),
            Found::Other(picture) => {
                file.extend(encode_png(&picture, key)?);
                return Ok(());
            }
        };
        let Self { clip, painter, bits, data } = self;
        let (grid, columns) = (painter.grid(), painter.grid().columns);
        let canvas = painter.canvas();
        for part in &mut parts {
            if let (None, Some(print)) = (&part.piece, part.keep) {
                // Parts that look alike are told once.
                let there = clip.kept().pieces.get(&print);
                part.piece = there.or_else(|| {
                    let piece = Piece::new(canvas, grid.run(part.tiles.clone()), clip.channels, &clip.table, bits);
                    let piece = Arc::new(piece);
                    clip.kept().pieces.put(print, Arc::clone(&piece), piece.size());
                    Some(piece)
                });
            }
        }
        for of_row in parts.chunk_by(|a, b| a.tiles.start / columns == b.tiles.start / columns) {
            let row = of_row[0].tiles.start / columns;
            let stretches: Vec<Stretch> = of_row
                .iter()
                .map(|part| match &part.piece {
                    Some(piece) => Stretch::Ready(piece),
                    None => Stretch::New(grid.run(part.tiles.clone())),
                })
                .collect();
            let high = band_area(row, clip.size).height();
            let sum = tell_band(canvas, &stretches, high, clip.channels, &clip.table, bits);
            data.clear();
            bits.drain_into(data);
            let band = Arc::new(Band::new(data, sum));
            clip.kept().bands.put(prints[row], Arc::clone(&band), band.chunk.len() + size_of::<Band>());
            found[row] = Some(band);
        }
        let all = || found.iter().flatten();
        let size = all().map(|b| b.chunk.len()).sum::<usize>();
        file.reserve(clip.head.len() + key.len() + size + 128);
        file.extend_from_slice(&clip.head);
        // The two bytes of zlib: a window of 32 kB, compressed fast.
        chunk(file, *b"IDAT", &[0x78, 0x01]);
        all().for_each(|band| file.extend_from_slice(&band.chunk));
        let sum = all().fold(Sum::default(), |sum, band| sum.then(band.sum));
        // An empty block ends it.
        let [a, b, c, d] = sum.value().to_be_bytes();
        chunk(file, *b"IDAT", &[3, 0, a, b, c, d]);
        // What files have in common comes first.
        if !key.is_empty() {
            text_chunk(file, key);
        }
        chunk(file, *b"IEND", &[]);
        Ok(())
    }
}

/// A frame that is painted and not yet told.
pub struct Painted(Found);

enum Found {
    /// What is on every row of tiles, the rows that were told before, and what the others are put together from.
    Bands { prints: Vec<Print>, found: Vec<Option<Arc<Band>>>, parts: Vec<Part> },
    /// A picture unlike all samples.
    Other(Picture),
}

/// Tiles of a row that are told together.
struct Part {
    tiles: Range<usize>,
    piece: Option<Arc<Piece>>,
    /// What they are kept by when they have been told; none where they move on.
    keep: Option<Print>,
}

/// Divides a row of tiles: what no moving thing touches is one part, up to the next moving thing; a tile that has been
/// there before is one; and tiles that are new are one that is told and forgotten, for most never come again.
fn divide(plan: &Plan, row: Range<usize>, kept: &mut Kept, parts: &mut Vec<Part>) {
    let (mut tile, end) = (row.start, row.end);
    let is_still = |tile: usize| plan.prints[tile] == plan.still_prints[tile];
    let mut open = false;
    while tile < end {
        let start = tile;
        if is_still(tile) {
            let mut print = Print::START;
            while tile < end && is_still(tile) {
                print.print(plan.prints[tile]);
                tile += 1;
            }
            parts.push(Part { tiles: start..tile, piece: kept.pieces.get(&print), keep: Some(print) });
            open = false;
            continue;
        }
        tile += 1;
        let print = plan.prints[start];
        let piece = kept.pieces.get(&print);
        if piece.is_some() || kept.seen.again(print) {
            parts.push(Part { tiles: start..tile, piece, keep: Some(print) });
            open = false;
            continue;
        }
        match parts.last_mut() {
            Some(part) if open => part.tiles.end = tile,
            _ => parts.push(Part { tiles: start..tile, piece: None, keep: None }),
        }
        open = true;
    }
}

impl Band {
    fn new(data: &[u8], sum: Sum) -> Self {
        let mut all = Vec::with_capacity(data.len() + 12);
        chunk(&mut all, *b"IDAT", data);
        Self { chunk: all, sum }
    }

    /// A band compressed as well as can be.
    fn best(canvas: &Canvas, area: Area, channels: usize) -> Self {
        let told = |differences| {
            let bytes = filtered(canvas, area, channels, differences);
            (deflated(&bytes), bytes)
        };
        // Flat colours are told best as they are; a photo, which does not shrink much so, by differences.
        let (mut out, mut bytes) = told(false);
        if out.len() > bytes.len() / PHOTO {
            let by_differences = told(true);
            if by_differences.0.len() < out.len() {
                (out, bytes) = by_differences;
            }
        }
        Self::new(&out, Sum::of(&bytes))
    }
}

/// Compressed as well as can be, up to a whole byte from which anything can go on.
fn deflated(bytes: &[u8]) -> Vec<u8> {
    // Level 9, without the header and sum of zlib.
    let mut deflate = CompressorOxide::new(create_comp_flags_from_zip_params(9, -15, 0));
    let mut out = Vec::with_capacity(bytes.len() / 8 + 1024);
    compress_to_output(&mut deflate, bytes, TDEFLFlush::Full, |some| {
        out.extend_from_slice(some);
        true
    });
    out
}

fn band_area(row: usize, (width, height): (u32, u32)) -> Area {
    let y0 = row as i32 * TILE.1;
    Area { x0: 0, y0, x1: width as i32, y1: (y0 + TILE.1).min(height as i32) }
}

/// What is on every row of tiles.
fn band_prints(plan: &Plan, columns: usize) -> impl Iterator<Item = Print> {
    plan.prints.chunks(columns).map(|tiles| {
        let mut print = Print::START;
        tiles.iter().for_each(|tile| print.print(*tile));
        print
    })
}

/// The start of every file: its signature, size and colours.
fn head((width, height): (u32, u32), channels: usize) -> Vec<u8> {
    let mut head = SIGNATURE.to_vec();
    let mut body = [width.to_be_bytes(), height.to_be_bytes()].concat();
    body.extend_from_slice(&[8, if channels == 3 { 2 } else { 6 }, 0, 0, 0]);
    chunk(&mut head, *b"IHDR", &body);
    chunk(&mut head, *b"sRGB", &[0]);
    head
}
