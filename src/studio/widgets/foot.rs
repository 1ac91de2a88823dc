//! The line at the foot: what there is to say, else the keys that help here.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::text::{BOLD, DIM, cells, folded, put, put_short};
use crate::studio::app::colours::Colours;
use crate::studio::app::keys::{Place, hints_of};
use crate::studio::app::lane::Lane;
use crate::studio::app::shell::Message;

/// What the foot is told.
#[derive(Debug, Clone, Copy)]
pub(in crate::studio) struct Foot<'a> {
    /// Where a key would be pressed.
    pub place: Place,
    /// The lane one stands on, on the timeline.
    pub lane: Option<Lane>,
    /// Whether there is something to save and to export.
    pub opens: bool,
    /// What there is to say.
    pub message: Option<&'a Message>,
    /// What is being waited for.
    pub busy: Option<&'a str>,
}

pub(in crate::studio) fn foot(buffer: &mut Buffer, area: Rect, foot: Foot<'_>, colours: Colours) {
    let row = Rect::new(area.x + 1, area.bottom() - 1, area.width - 2, 1);
    if let Some(message) = foot.message {
        say(buffer, row, message, colours);
    } else if let Some(busy) = foot.busy {
        put_short(buffer, row.x, row.y, row.width, busy, DIM);
    } else {
        hints(buffer, row, foot);
    }
}

/// A message: one that does not fit takes the row above too.
fn say(buffer: &mut Buffer, row: Rect, message: &Message, colours: Colours) {
    let style = if message.is_fault { colours.fault().add_modifier(Modifier::BOLD) } else { BOLD };
    let text = format!("{}{}", if message.is_fault { "! " } else { "" }, message.text);
    if cells(&text) <= row.width {
        put(buffer, row.x, row.y, row.width, &text, style);
        return;
    }
    let lines = folded(&text, row.width);
    let (first, rest) = lines.split_first().map_or((text.clone(), String::new()), |(f, r)| (f.clone(), r.join(" ")));
    let above = row.y.saturating_sub(u16::from(!rest.is_empty()));
    for x in buffer.area.x..buffer.area.right() {
        if let Some(cell) = buffer.cell_mut((x, above)) {
            cell.reset();
        }
    }
    put_short(buffer, row.x, above, row.width, &first, style);
    put_short(buffer, row.x, row.y, row.width, &rest, style);
}

/// The keys that help here, the most needed first to get room, all in the order of the table.
fn hints(buffer: &mut Buffer, row: Rect, foot: Foot<'_>) {
    let shown: Vec<(String, &str)> = hints_of(foot.place).filter(|(_, hint)| belongs(hint, foot)).collect();
    let length = |(keys, hint): &(String, &str)| cells(keys) + 1 + cells(hint) + 2;
    let mut order: Vec<usize> = (0..shown.len()).collect();
    order.sort_by_key(|index| rank(shown[*index].1));
    // Nothing follows the last one, so its gap needs no room.
    let mut room = row.width + 2;
    let mut chosen = vec![false; shown.len()];
    for index in order {
        let wanted = length(&shown[index]);
        if wanted <= room {
            room -= wanted;
            chosen[index] = true;
        }
    }
    let mut x = row.x;
    for ((keys, hint), _) in shown.iter().zip(chosen).filter(|(_, chosen)| *chosen) {
        x += put(buffer, x, row.y, row.right().saturating_sub(x), keys, BOLD) + 1;
        x += put(buffer, x, row.y, row.right().saturating_sub(x), hint, Style::new()) + 2;
    }
}

/// Whether a hint helps on this lane of this lesson.
fn belongs(hint: &str, foot: Foot<'_>) -> bool {
    match hint {
        _ if foot.place == Place::Tapping => true,
        "start" | "end" | "read" | "look at" | "mark" | "tap" | "syllable" => foot.lane == Some(Lane::Syllables),
        "align" => foot.opens && foot.lane.is_none_or(|l| l == Lane::Syllables),
        "add" | "change" | "delete" | "key" => foot.lane.is_some_and(|l| l != Lane::Syllables),
        "choose" | "open" => foot.opens || foot.place != Place::Lesson,
        "save" | "export" => foot.opens || foot.place == Place::Confirm,
        _ => true,
    }
}

/// Who gets room first: how to get help and out, what is always wanted, what the lane is for, then the rest.
fn rank(hint: &str) -> u8 {
    match hint {
        "help" | "back" | "quit" | "done" => 0,
        "play" | "undo" | "save" => 1,
        "lane" => 3,
        "syllable" | "key" => 4,
        "align" | "look at" => 5,
        "export" => 6,
        "zoom" => 7,
        "tap" | "mark" | "drop" | "go to" => 8,
        _ => 2,
    }
}
