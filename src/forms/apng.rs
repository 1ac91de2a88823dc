//! A clip as an animated PNG, as browsers and messengers show it: each frame only the rectangle that has changed, times
//! exact, edges half-transparent where there is no background. It needs no other program.
//!
//! Each rectangle is encoded as a PNG of its own and its data put into the chunks of the animation.

use std::io::{Seek, SeekFrom, Write};
use std::path::Path;

use super::FormFault;
use super::cels::{self, Area};
use super::draft::{Draft, write_fault};
use super::palette::Palette;
use super::stream::{Frames, Outcome, Rate, Watch};
use crate::disk::{Fault, Result};

/// How many colours an animated PNG has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Depth {
    /// 256 for the whole clip, each with its own alpha: about half as large.
    #[default]
    Palette,
    /// Every pixel as it was painted.
    Exact,
}

/// How an animated PNG is written.
#[derive(Debug, Clone, Copy)]
pub struct ApngForm {
    /// Frames a second.
    pub fps: f64,
    /// How often it is shown; 0 is for ever.
    pub plays: u32,
    /// How many colours.
    pub depth: Depth,
    /// Whether every pixel of every frame is opaque, so that no alpha needs to be kept.
    pub opaque: bool,
}

const SIGNATURE: &[u8; 8] = b"\x89PNG\r\n\x1a\n";

/// Where the chunk that counts the frames begins: after the signature and the header.
const COUNT_AT: u64 = 8 + 25;

/// Writes all frames at `path`; where there is a file already, when the new one is whole.
///
/// # Errors
/// When there are no frames, one cannot be drawn, or the file cannot be written.
pub fn write(path: &Path, frames: &mut dyn Frames, form: ApngForm, watch: &Watch<'_>) -> Result<Outcome> {
    let rate = Rate::new(form.fps)?;
    let size = frames.size();
    if frames.count() == 0 {
        return Err(Fault::of(FormFault::NoFrames, "there are no frames to be shown")
            .help("give the clip a recording, times or keys"));
    }
    let mut pixels = match form.depth {
        Depth::Palette if form.opaque => Pixels::Through(Palette::learn(frames, 255, Some)?, Vec::new()),
        Depth::Palette => Pixels::Indexed(Palette::learn(frames, 256, |c| Some(visible(c)))?),
        Depth::Exact if form.opaque => Pixels::Opaque,
        Depth::Exact => Pixels::Straight,
    };
    let mut file = Chunks { file: Draft::new(path)?, next: 0 };
    let failed = |e| write_fault(path, e);
    let mut cels = 0_u32;
    let outcome = cels::each(
        frames,
        watch,
        |from| from + 1,
        |cel, rgba| {
            let parts = pixels.encode(cel.area, size[0], rgba)?;
            if cels == 0 {
                file.start(&parts, form.plays).map_err(failed)?;
            }
            // A time is a fraction of two numbers of 16 bits: what is longer gets another frame that changes nothing.
            let longest = u32::from(u16::MAX) / rate.seconds;
            let mut left = cel.until - cel.from;
            let mut now = left.min(longest);
            file.frame(cel.area, now, rate, &parts, cels == 0).map_err(failed)?;
            cels += 1;
            left -= now;
            while left > 0 {
                let corner = Area { x: 0, y: 0, width: 1, height: 1 };
                now = left.min(longest);
                let same = pixels.encode(corner, size[0], rgba)?;
                file.frame(corner, now, rate, &same, false).map_err(failed)?;
                cels += 1;
                left -= now;
            }
            Ok(())
        },
    )?;
    if outcome == Outcome::Stopped {
        return Ok(outcome);
    }
    file.chunk(b"IEND", &[]).map_err(failed)?;
    let bytes = file.file.finish(|file| {
        // Only now it is known how many there are.
        file.seek(SeekFrom::Start(COUNT_AT))?;
        file.write_all(&chunk(b"acTL", &counted(cels, form.plays)))
    })?;
    Ok(Outcome::Written(bytes))
}

/// What cannot be seen has no colour: otherwise palettes would keep some for it.
fn visible(colour: [u8; 4]) -> [u8; 4] {
    if colour[3] == 0 { [0; 4] } else { colour }
}

fn counted(frames: u32, plays: u32) -> [u8; 8] {
    let mut body = [0; 8];
    body[..4].copy_from_slice(&frames.to_be_bytes());
    body[4..].copy_from_slice(&plays.to_be_bytes());
    body
}

/// How the pixels of one file are kept.
enum Pixels {
    /// Opaque colours by number, and one that shows what was there before: the numbers that are shown.
    Through(Palette, Vec<u8>),
    /// Colours with alpha by number.
    Indexed(Palette),
    Opaque,
    Straight,
}

/// The chunks of one PNG that matter here.
#[derive(Default)]
struct Parts {
    /// Header, palette and what comes with it, as they are.
    head: Vec<u8>,
    data: Vec<u8>,
    /// Whether it is laid over what was there, which shows through; else it replaces it.
    over: bool,
}

/// The number of the colour that shows what was there before.
const THROUGH: u8 = 255;

impl Pixels {
    fn encode(&mut self, area: Area, width: u32, rgba: &[u8]) -> Result<Parts> {
        let pixels = area.rows(width, 4).flat_map(|row| rgba[row].chunks_exact(4));
        let (kind, data): (_, Vec<u8>) = match self {
            Self::Through(palette, shown) => {
                if shown.is_empty() {
                    shown.resize(rgba.len() / 4, THROUGH);
                }
                let mut last = ([0; 4], palette.index_of([0; 4]));
                let mut data = Vec::with_capacity(area.width as usize * area.height as usize);
                for (row, four) in area.rows(width, 1).zip(area.rows(width, 4)) {
                    for (old, p) in shown[row].iter_mut().zip(rgba[four].chunks_exact(4)) {
                        let colour = [p[0], p[1], p[2], p[3]];
                        if colour != last.0 {
                            last = (colour, palette.index_of(colour));
                        }
                        data.push(if *old == last.1 { THROUGH } else { last.1 });
                        *old = last.1;
                    }
                }
                (png::ColorType::Indexed, data)
            }
            Self::Indexed(palette) => {
                let mut last = ([0; 4], palette.index_of([0; 4]));
                let index = |p: &[u8]| {
                    let colour = visible([p[0], p[1], p[2], p[3]]);
                    if colour != last.0 {
                        last = (colour, palette.index_of(colour));
                    }
                    last.1
                };
                (png::ColorType::Indexed, pixels.map(index).collect())
            }
            Self::Opaque => (png::ColorType::Rgb, pixels.flat_map(|p| [p[0], p[1], p[2]]).collect()),
            Self::Straight => (png::ColorType::Rgba, pixels.flatten().copied().collect()),
        };
        let mut file = Vec::with_capacity(1 << 14);
        let encoded = (|| {
            let mut encoder = png::Encoder::new(&mut file, area.width, area.height);
            encoder.set_color(kind);
            encoder.set_depth(png::BitDepth::Eight);
            encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
            encoder.set_compression(png::Compression::Balanced);
            if let Self::Indexed(palette) | Self::Through(palette, _) = self {
                let mut colours = palette.colours().to_vec();
                if matches!(self, Self::Through(..)) {
                    colours.resize(256, [0; 4]);
                }
                encoder.set_palette(colours.iter().flat_map(|c| [c[0], c[1], c[2]]).collect::<Vec<u8>>());
                if colours.iter().any(|c| c[3] < 255) {
                    encoder.set_trns(colours.iter().map(|c| c[3]).collect::<Vec<u8>>());
                }
                encoder.set_filter(png::Filter::NoFilter);
            } else {
                encoder.set_filter(png::Filter::Adaptive);
            }
            let mut writer = encoder.write_header()?;
            writer.write_image_data(&data)?;
            writer.finish()
        })();
        encoded.map_err(|e| Fault::of(FormFault::CannotWrite, format!("the picture cannot be written as PNG: {e}")))?;
        Ok(Parts { over: matches!(self, Self::Through(..)), ..Parts::of(&file) })
    }
}

impl Parts {
    fn of(file: &[u8]) -> Self {
        let mut parts = Self::default();
        let mut rest = file.get(SIGNATURE.len()..).unwrap_or_default();
        while let Some((length, after)) = rest.split_first_chunk::<4>() {
            let length = u32::from_be_bytes(*length) as usize;
            let (Some(kind), Some(body)) = (after.get(..4), after.get(4..4 + length)) else { break };
            match kind {
                b"IDAT" => parts.data.extend_from_slice(body),
                b"IEND" => break,
                _ => parts.head.extend_from_slice(&rest[..length + 12]),
            }
            rest = &rest[length + 12..];
        }
        parts
    }
}

/// The file, chunk by chunk.
struct Chunks {
    file: Draft,
    /// The number of the next chunk that is part of the animation.
    next: u32,
}

impl Chunks {
    /// Everything before the first frame. The header comes first, then the count, which is a guess so far.
    fn start(&mut self, parts: &Parts, plays: u32) -> std::io::Result<()> {
        let (header, others) = parts.head.split_at(25.min(parts.head.len()));
        self.file.write_all(SIGNATURE)?;
        self.file.write_all(header)?;
        self.chunk(b"acTL", &counted(1, plays))?;
        self.file.write_all(others)
    }

    fn frame(&mut self, area: Area, frames: u32, rate: Rate, parts: &Parts, first: bool) -> std::io::Result<()> {
        let mut control = Vec::with_capacity(26);
        for number in [self.next, area.width, area.height, area.x, area.y] {
            control.extend(number.to_be_bytes());
        }
        for part in [frames * rate.seconds, rate.frames] {
            control.extend((part.min(u16::MAX.into()) as u16).to_be_bytes());
        }
        // Left as it is afterwards; laid over what was there, or put in its place.
        control.extend([0, u8::from(parts.over)]);
        self.next += 1;
        self.chunk(b"fcTL", &control)?;
        if first {
            return self.chunk(b"IDAT", &parts.data);
        }
        let mut body = self.next.to_be_bytes().to_vec();
        body.extend_from_slice(&parts.data);
        self.next += 1;
        self.chunk(b"fdAT", &body)
    }

    fn chunk(&mut self, kind: &[u8; 4], body: &[u8]) -> std::io::Result<()> {
        self.file.write_all(&chunk(kind, body))
    }
}

fn chunk(kind: &[u8; 4], body: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(body.len() + 12);
    bytes.extend((body.len() as u32).to_be_bytes());
    bytes.extend(kind);
    bytes.extend(body);
    bytes.extend(crc32fast::hash(&bytes[4..]).to_be_bytes());
    bytes
}
