//! The line at the foot: what there is to say, else the keys that help here.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::{BOLD, DIM, cells, put, put_short};
use crate::studio::keys::{Place, hints_of};
use crate::studio::look::Colours;
use crate::studio::state::Message;

pub(in crate::studio) fn foot(
    buffer: &mut Buffer,
    area: Rect,
    place: Place,
    message: Option<&Message>,
    busy: Option<&str>,
    colours: Colours,
) {
    let y = area.bottom() - 1;
    let mut x = area.x + 1;
    let right = area.right() - 1;
    if let Some(message) = message {
        let style = if message.is_fault { colours.warning().add_modifier(Modifier::BOLD) } else { BOLD };
        let mark = if message.is_fault { "! " } else { "" };
        put_short(buffer, x, y, right - x, &format!("{mark}{}", message.text), style);
        return;
    }
    if let Some(busy) = busy {
        put_short(buffer, x, y, right - x, busy, DIM);
        return;
    }
    let hints: Vec<(String, &str)> = hints_of(place).collect();
    // How to get help and out is always there; the others as far as they fit.
    let always = |hint: &str| matches!(hint, "help" | "back" | "quit");
    let length = |(keys, hint): &(String, &str)| cells(keys) + 1 + cells(hint) + 2;
    let mut room = (right - x).saturating_sub(hints.iter().filter(|h| always(h.1)).map(length).sum());
    for hint in &hints {
        if !always(hint.1) {
            if length(hint) > room {
                continue;
            }
            room -= length(hint);
        }
        x += put(buffer, x, y, right - x, &hint.0, BOLD) + 1;
        x += put(buffer, x, y, right.saturating_sub(x), hint.1, Style::new()) + 2;
    }
}
