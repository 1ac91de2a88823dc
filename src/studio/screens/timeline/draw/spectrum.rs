//! The frequencies of the sound over time: two bands a cell in colours, or dots where there are none.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};

use super::sound::Dots;
use crate::project::Clip;
use crate::speech::Spectrogram;
use crate::studio::app::colours::Colours;
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::widgets::text::{DIM, put};

/// From silence to the loudest, in colours of xterm's cube, which every terminal with 256 colours has: black over
/// violet and orange to pale yellow, as matplotlib's `inferno`. Brightness rises with it, so that it reads without hue.
const HEAT: [u8; 12] = [16, 17, 53, 54, 89, 125, 161, 166, 202, 208, 214, 229];

/// Thresholds of ordered dither for the eight dots of a cell (Bayer's order, on 2 × 4).
const DITHER: [[f32; 2]; 4] = [[0.11, 0.67], [0.83, 0.39], [0.25, 0.53], [0.95, 0.72]];

pub(super) fn spectrum(
    buffer: &mut Buffer,
    area: Rect,
    heard: Option<&Spectrogram>,
    editor: &Editor,
    clip: &Clip,
    colours: Colours,
) {
    let middle = area.y + area.height / 2;
    if clip.sound.is_none() {
        put(buffer, area.x, middle, area.width, "no sound: add a speech.wav to the clip", DIM);
        return;
    }
    let Some(spectrogram) = heard else {
        put(buffer, area.x, middle, area.width, "listening…", DIM);
        return;
    };
    let window = editor.window;
    // Beyond the end there is nothing to show.
    let columns = window.column(editor.timeline.duration(), area.width).clamp(0, i32::from(area.width)) as u16;
    let to = window.time_of(f64::from(columns), area.width);
    if colours == Colours::None {
        let (across, down) = (usize::from(columns) * 2, usize::from(area.height) * 4);
        let mut dots = Dots::new(area);
        for (x, bands) in spectrogram.picture(window.from, to, across, down).iter().enumerate() {
            for (y, value) in bands.iter().enumerate().filter(|(y, v)| **v > DITHER[y % 4][x % 2]) {
                let _ = value;
                dots.set(x, y);
            }
        }
        dots.put(buffer, Style::new());
        return;
    }
    let picture = spectrogram.picture(window.from, to, usize::from(columns), usize::from(area.height) * 2);
    for (x, bands) in (area.x..).zip(&picture) {
        for (y, pair) in (area.y..area.bottom()).zip(bands.chunks(2)) {
            let heat = |value: Option<&f32>| Color::Indexed(heat(value.copied().unwrap_or(0.0)));
            if let Some(cell) = buffer.cell_mut((x, y)) {
                let (upper, lower) = (heat(pair.first()), heat(pair.get(1)));
                // One colour is fewer bytes than two.
                if upper == lower {
                    cell.set_char(' ').set_style(Style::new().bg(lower));
                } else {
                    cell.set_char('▀').set_style(Style::new().fg(upper).bg(lower));
                }
            }
        }
    }
}

/// The colour of a loudness from 0 to 1.
fn heat(value: f32) -> u8 {
    let step = (value.clamp(0.0, 1.0) * HEAT.len() as f32) as usize;
    HEAT[step.min(HEAT.len() - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn louder_is_brighter_and_everything_has_a_colour() {
        assert_eq!((heat(-1.0), heat(0.0), heat(1.0), heat(9.0)), (16, 16, 229, 229));
        let steps: Vec<u8> = (0..12).map(|i| heat((i as f32 + 0.5) / 12.0)).collect();
        assert_eq!(steps, HEAT);
    }
}
