//! The outline of the sound, in braille: two columns and four rows of dots a cell.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::project::Clip;
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::widgets::text::{DIM, put};

pub(super) fn wave(buffer: &mut Buffer, area: Rect, editor: &Editor, clip: &Clip) {
    let middle = area.y + area.height / 2;
    let (sound, loudest) = match (&clip.sound, editor.loudest) {
        (_, None) => {
            put(buffer, area.x, middle, area.width, "reading the sound…", DIM);
            return;
        }
        (Some(sound), Some(loudest)) => (sound, loudest.max(1e-4)),
        (None, _) => {
            put(buffer, area.x, middle, area.width, "no sound: add a speech.wav to the clip", DIM);
            return;
        }
    };
    let columns = usize::from(area.width) * 2;
    let peaks = sound.peaks(editor.window.from, editor.window.to(), columns);
    let rows = usize::from(area.height) * 4;
    let mut dots = Dots::new(area);
    let half = (rows as f32 - 1.0) / 2.0;
    for (column, (low, high)) in peaks.into_iter().enumerate() {
        // The loudest sample reaches the edge; silence is the line in the middle.
        let row = |v: f32| (half - (v / loudest).clamp(-1.0, 1.0) * half).round() as usize;
        for y in row(high)..=row(low).min(rows - 1) {
            dots.set(column, y);
        }
    }
    dots.put(buffer, Style::new());
}

/// Dots over cells.
pub(super) struct Dots {
    area: Rect,
    bits: Vec<u8>,
}

impl Dots {
    pub(crate) fn new(area: Rect) -> Self {
        Self { area, bits: vec![0; usize::from(area.width) * usize::from(area.height)] }
    }

    /// Sets a dot: 0 ≤ x < 2 × width, 0 ≤ y < 4 × height from the top.
    pub(crate) fn set(&mut self, x: usize, y: usize) {
        const BITS: [[u8; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];
        let width = usize::from(self.area.width);
        if x / 2 < width
            && let Some(bits) = self.bits.get_mut(y / 4 * width + x / 2)
        {
            *bits |= BITS[x % 2][y % 4];
        }
    }

    /// Puts the cells that have dots.
    pub(crate) fn put(&self, buffer: &mut Buffer, style: Style) {
        for (place, bits) in self.area.positions().zip(&self.bits) {
            if *bits != 0
                && let Some(cell) = buffer.cell_mut(place)
            {
                // Where two lines meet in a cell both keep their dots; the colour is the later one's.
                let there = cell.symbol().chars().next().map_or(0, u32::from);
                let there = if (0x2800..0x2900).contains(&there) { there - 0x2800 } else { 0 };
                let dots = 0x2800 + (there | u32::from(*bits));
                cell.set_char(char::from_u32(dots).unwrap_or(' ')).set_style(style);
            }
        }
    }
}
