//! What the terminal can show: how many colours, and which one each emotion has.

use ratatui::style::{Color, Style};

use crate::pose::Emotion;

/// How many colours the terminal has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Colours {
    /// None, or none are wanted (`NO_COLOR`): no colour code at all is written.
    None,
    /// The 256 of xterm.
    #[default]
    Palette,
    /// All of them.
    True,
}

impl Colours {
    /// What the environment says: `NO_COLOR`, then `COLORTERM`, then `TERM`.
    #[must_use]
    pub(crate) fn of_environment() -> Self {
        let variable = |name| std::env::var(name).unwrap_or_default();
        Self::said(&variable("NO_COLOR"), &variable("COLORTERM"), &variable("TERM"))
    }

    /// What three variables say.
    #[must_use]
    pub(crate) fn said(no_color: &str, colorterm: &str, term: &str) -> Self {
        match (no_color, colorterm) {
            (set, _) if !set.is_empty() => Self::None,
            (_, "truecolor" | "24bit") => Self::True,
            _ if term == "dumb" || term.ends_with("-mono") => Self::None,
            _ => Self::Palette,
        }
    }

    /// A colour as this terminal has it.
    #[must_use]
    pub(crate) fn colour(self, [r, g, b]: [u8; 3]) -> Color {
        match self {
            Self::None => Color::Reset,
            // A grey of the 256 takes half the bytes, and 24 of them are enough for ink on paper.
            Self::True if r.max(g).max(b) - r.min(g).min(b) < 10 => Color::Indexed(nearest_of_256([r, g, b])),
            Self::True => Color::Rgb(r, g, b),
            Self::Palette => Color::Indexed(nearest_of_256([r, g, b])),
        }
    }

    /// A style of that colour, plain where there are none.
    #[must_use]
    pub(crate) fn ink(self, rgb: [u8; 3]) -> Style {
        match self {
            Self::None => Style::new(),
            _ => Style::new().fg(self.colour(rgb)),
        }
    }

    /// The style of an emotion's curve and bar. The colours are those of Okabe and Ito, which people who cannot tell
    /// red from green can tell apart; the two darkest are lightened so that they show on black too. Neutral has the
    /// terminal's own.
    #[must_use]
    pub(crate) fn of_emotion(self, emotion: Emotion) -> Style {
        match emotion {
            Emotion::Neutral => Style::new(),
            Emotion::Happy => self.ink([214, 146, 0]),
            Emotion::Anger => self.ink([213, 94, 0]),
            Emotion::Disgust => self.ink([0, 158, 115]),
            Emotion::Sadness => self.ink([40, 130, 200]),
            Emotion::Fear => self.ink([190, 110, 160]),
            Emotion::Surprised => self.ink([70, 170, 220]),
        }
    }

    /// The style of what belongs to the author: magenta can be read on black and on white.
    #[must_use]
    pub(crate) fn accent(self) -> Style {
        match self {
            Self::None => Style::new(),
            _ => Style::new().fg(Color::Magenta),
        }
    }

    /// The style of what is not done yet: unsaved, guessed, odd.
    #[must_use]
    pub(crate) fn warning(self) -> Style {
        match self {
            Self::None => Style::new(),
            _ => Style::new().fg(Color::Yellow),
        }
    }

    /// The style of what is wrong, and of nothing else.
    #[must_use]
    pub(crate) fn fault(self) -> Style {
        match self {
            Self::None => Style::new(),
            _ => Style::new().fg(Color::Red),
        }
    }
}

/// The nearest of xterm's 6 × 6 × 6 cube and its 24 greys. The first 16 are left alone: people set them as they like.
fn nearest_of_256(rgb: [u8; 3]) -> u8 {
    const LEVELS: [i32; 6] = [0, 95, 135, 175, 215, 255];
    let near = |v: u8| (0..6).min_by_key(|i| (LEVELS[*i] - i32::from(v)).abs()).unwrap_or(0);
    let [r, g, b] = rgb.map(near);
    let cube = [LEVELS[r], LEVELS[g], LEVELS[b]];
    let mean = rgb.iter().map(|v| i32::from(*v)).sum::<i32>() / 3;
    let grey = ((mean - 8 + 5) / 10).clamp(0, 23);
    let far = |c: [i32; 3]| -> i32 { c.iter().zip(rgb).map(|(a, b)| (a - i32::from(b)).pow(2)).sum() };
    if far([8 + 10 * grey; 3]) < far(cube) { 232 + grey as u8 } else { (16 + 36 * r + 6 * g + b) as u8 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_color_wins_and_truecolor_is_asked_for_by_name() {
        assert_eq!(Colours::said("1", "truecolor", "xterm"), Colours::None);
        assert_eq!(Colours::said("", "truecolor", "xterm"), Colours::True);
        assert_eq!(Colours::said("", "", "xterm-256color"), Colours::Palette);
        for emotion in Emotion::ALL {
            assert_eq!(Colours::None.of_emotion(emotion), Style::new());
        }
    }

    #[test]
    fn colours_of_the_cube_and_greys_are_found_again() {
        assert_eq!(nearest_of_256([255, 255, 255]), 231);
        assert_eq!(nearest_of_256([0, 0, 0]), 16);
        assert_eq!(nearest_of_256([128, 128, 128]), 244);
        assert_eq!(nearest_of_256([255, 0, 0]), 196);
    }
}
