//! A clip as an animated GIF: at most 255 colours for the whole clip and one for what shows through, each frame only the
//! rectangle that has changed. It needs no other program.
//!
//! GIF counts time in hundredths of a second: a frame begins at the hundredth that is nearest to its time, so that
//! nothing drifts. Viewers show delays below two hundredths as ten: of frames faster than that, some are left out.

use std::borrow::Cow;
use std::path::Path;

use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

use super::FormFault;
use super::cels::{self, Area, Cel, changed};
use super::draft::{Draft, write_fault};
use super::palette::Palette;
use super::stream::{Frames, Outcome, Rate, Watch};
use crate::disk::{Fault, Result};
use crate::drawing::Colour;

/// The shortest time that viewers keep to, in hundredths of a second.
const SHORTEST: u64 = 2;

/// The number of the colour that shows what was there before.
const THROUGH: u8 = 255;

/// How a GIF is written.
#[derive(Debug, Clone, Copy)]
pub struct GifForm {
    /// Frames a second.
    pub fps: f64,
    /// How often it is shown; 0 is for ever.
    pub plays: u16,
    /// What half-transparent edges are laid on, since a GIF's pixel is there or not: the colour of the page it is for.
    pub matte: Colour,
}

/// Writes all frames at `path`; where there is a file already, when the new one is whole.
///
/// # Errors
/// When there are no frames, one cannot be drawn, or the file cannot be written.
pub fn write(path: &Path, frames: &mut dyn Frames, form: GifForm, watch: &Watch<'_>) -> Result<Outcome> {
    let rate = Rate::new(form.fps)?;
    let size = frames.size();
    let sides = size.map(|side| u16::try_from(side).ok().filter(|s| *s > 0));
    let [Some(width), Some(height)] = sides else {
        return Err(Fault::of(FormFault::TooLarge, format!("a GIF cannot be {} × {} pixels", size[0], size[1])));
    };
    if frames.count() == 0 {
        return Err(Fault::of(FormFault::NoFrames, "there are no frames to be shown")
            .help("give the clip a recording, times or keys"));
    }
    let flat = |colour| flattened(colour, form.matte);
    let palette = Palette::learn(frames, usize::from(THROUGH), flat)?;
    let mut table: Vec<u8> = palette.colours().iter().flat_map(|c| [c[0], c[1], c[2]]).collect();
    table.resize(256 * 3, 0);
    let file = Draft::new(path)?;
    let fault = |e| encoding_fault(path, e);
    let mut encoder = Encoder::new(file, width, height, &table).map_err(fault)?;
    let repeat = if form.plays == 0 { Repeat::Infinite } else { Repeat::Finite(form.plays - 1) };
    if form.plays != 1 {
        encoder.set_repeat(repeat).map_err(fault)?;
    }
    let mut canvas = Canvas {
        size,
        matte: form.matte,
        palette,
        shown: vec![THROUGH; size[0] as usize * size[1] as usize],
        next: vec![THROUGH; size[0] as usize * size[1] as usize],
        held: None,
    };
    let begins = |n| rate.in_parts(n, 100);
    // The first frame that begins late enough after one.
    let soonest = |from: u32| {
        let mut n = from + 1;
        while begins(n) < begins(from) + SHORTEST {
            n += 1;
        }
        n
    };
    let outcome = cels::each(frames, watch, soonest, |cel, pixels| {
        let delay = (begins(cel.until) - begins(cel.from)).max(SHORTEST);
        for frame in canvas.lay(cel, pixels, delay) {
            encoder.write_frame(&frame).map_err(fault)?;
        }
        Ok(())
    })?;
    if outcome == Outcome::Stopped {
        return Ok(outcome);
    }
    if let Some(last) = canvas.held.take() {
        encoder.write_frame(&last).map_err(fault)?;
    }
    let file = encoder.into_inner().map_err(fault)?;
    Ok(Outcome::Written(file.finish(|_| Ok(()))?))
}

/// There or not: what is less than half there is not; the rest lies on the matte.
fn flattened([r, g, b, a]: [u8; 4], matte: Colour) -> Option<[u8; 4]> {
    match a {
        255 => Some([r, g, b, a]),
        0..128 => None,
        _ => {
            let mixed = Colour::rgb(r, g, b).over(matte, f64::from(a) / 255.0);
            Some([mixed.r, mixed.g, mixed.b, 255])
        }
    }
}

fn encoding_fault(path: &Path, error: EncodingError) -> Fault {
    match error {
        EncodingError::Io(error) => write_fault(path, error),
        error => Fault::of(FormFault::CannotWrite, format!("the GIF cannot be written: {error}")).at(path),
    }
}

/// What a viewer shows, as numbers of colours, [`THROUGH`] where nothing is.
struct Canvas {
    size: [u32; 2],
    matte: Colour,
    palette: Palette,
    shown: Vec<u8>,
    next: Vec<u8>,
    /// The newest frame: the one after it may want it to be cleared away.
    held: Option<Frame<'static>>,
}

impl Canvas {
    /// Lays a cel over what is shown and gives back the frames that can be written now.
    fn lay(&mut self, cel: Cel, pixels: &[u8], delay: u64) -> Vec<Frame<'static>> {
        let width = self.size[0];
        for (row, four) in cel.area.rows(width, 1).zip(cel.area.rows(width, 4)) {
            let mut last = ([0; 4], THROUGH);
            for (index, p) in self.next[row].iter_mut().zip(pixels[four].chunks_exact(4)) {
                let colour = [p[0], p[1], p[2], p[3]];
                // Neighbours are mostly equal.
                if colour != last.0 {
                    let index = flattened(colour, self.matte).map(|c| self.palette.index_of(c));
                    last = (colour, index.unwrap_or(THROUGH));
                }
                *index = last.1;
            }
        }
        let first = self.held.is_none();
        let area = if first { Some(cel.area) } else { changed(&self.shown, &self.next, width, 1, cel.area) };
        let Some(mut area) = area else {
            // The change was too slight for the colours: the frame before stays.
            return self.longer(delay);
        };
        // What was there and is not any more cannot be painted over: the frame before has to clear it away.
        if let Some(gone) = self.gone(area)
            && let Some(before) = &mut self.held
        {
            let held = Area {
                x: before.left.into(),
                y: before.top.into(),
                width: before.width.into(),
                height: before.height.into(),
            };
            let cleared = held.union(gone);
            let whole = cut(&self.shown, cleared, width);
            place(before, cleared, whole);
            before.dispose = DisposalMethod::Background;
            area = area.union(cleared);
            for row in cleared.rows(width, 1) {
                self.shown[row].fill(THROUGH);
            }
        }
        let mut buffer = cut(&self.next, area, width);
        let old = area.rows(width, 1).flat_map(|row| &self.shown[row]);
        for (new, old) in buffer.iter_mut().zip(old) {
            if new == old {
                *new = THROUGH;
            }
        }
        for row in area.rows(width, 1) {
            self.shown[row.clone()].copy_from_slice(&self.next[row]);
        }
        let mut frame = Frame { transparent: Some(THROUGH), dispose: DisposalMethod::Keep, ..Frame::default() };
        place(&mut frame, area, buffer);
        let mut ready: Vec<_> = self.held.replace(frame).into_iter().collect();
        ready.extend(self.longer(delay));
        ready
    }

    /// Shows the held frame for so much longer. A frame lasts 655 seconds at most: what is beyond gets another one.
    fn longer(&mut self, delay: u64) -> Vec<Frame<'static>> {
        let mut ready = Vec::new();
        let Some(held) = &mut self.held else { return ready };
        let mut all = u64::from(held.delay) + delay;
        while all > u64::from(u16::MAX) {
            // The rest must not be too short.
            let part = u16::MAX - SHORTEST as u16;
            held.delay = part;
            all -= u64::from(part);
            let mut same = Frame { transparent: Some(THROUGH), dispose: DisposalMethod::Keep, ..Frame::default() };
            place(&mut same, Area { x: 0, y: 0, width: 1, height: 1 }, vec![THROUGH]);
            ready.push(std::mem::replace(held, same));
        }
        held.delay = all as u16;
        ready
    }

    /// The smallest area of what is shown and will not be.
    fn gone(&self, area: Area) -> Option<Area> {
        let width = self.size[0];
        let mut gone: Option<Area> = None;
        for (y, row) in (area.y..).zip(area.rows(width, 1)) {
            let is_gone = |(old, new): (&u8, &u8)| *old != THROUGH && *new == THROUGH;
            let pairs = || self.shown[row.clone()].iter().zip(&self.next[row.clone()]);
            let (Some(left), Some(right)) = (pairs().position(is_gone), pairs().rposition(is_gone)) else { continue };
            let here = Area { x: area.x + left as u32, y, width: (right - left + 1) as u32, height: 1 };
            gone = Some(gone.map_or(here, |g| g.union(here)));
        }
        gone
    }
}

fn cut(pixels: &[u8], area: Area, width: u32) -> Vec<u8> {
    area.rows(width, 1).flat_map(|row| pixels[row].iter().copied()).collect()
}

/// The sides fit: those of the whole picture do.
fn place(frame: &mut Frame<'static>, area: Area, buffer: Vec<u8>) {
    let [x, y, width, height] = [area.x, area.y, area.width, area.height].map(|v| v.min(u16::MAX.into()) as u16);
    (frame.left, frame.top, frame.width, frame.height) = (x, y, width, height);
    frame.buffer = Cow::Owned(buffer);
}
