//! The lanes of keys: mouth shapes as letters at their times, and the keys of emotion, blink, gaze and head. What the
//! author set is underlined, and bracketed where there is room; colour only repeats it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use crate::project::Clip;
use crate::studio::app::colours::Colours;
use crate::studio::app::lane::Lane;
use crate::studio::screens::timeline::editor::{Editor, value_text};
use crate::studio::widgets::text::{DIM, cells, put};
use crate::timeline::{MouthKey, Origin, Track};

fn own_style(colours: Colours) -> Style {
    colours.accent().add_modifier(Modifier::UNDERLINED | Modifier::BOLD)
}

/// The keys of the mouth, and how long each is held.
pub(super) fn mouth(buffer: &mut Buffer, row: Rect, editor: &Editor, colours: Colours) {
    let (window, columns) = (editor.window, row.width);
    let keys = editor.timeline.mouth_keys();
    let held = |k: &&MouthKey| k.shape.is_some() && k.until >= window.from && k.time <= window.to();
    for key in keys.iter().filter(held) {
        for column in
            window.column(key.time, columns).max(0)..=window.column(key.until, columns).min(i32::from(columns) - 1)
        {
            put(buffer, row.x + column as u16, row.y, 1, "─", DIM);
        }
    }
    // Letters upon letters say nothing: of too many only the author's are shown.
    let in_sight = keys.iter().filter(|k| window.shown_column(k.time, columns).is_some()).count();
    let crowded = in_sight > 2 * usize::from(columns);
    // The author's keys are put last, so that none is hidden where many share a column.
    for authors in [false, true] {
        for key in keys.iter().filter(|k| (k.origin == Origin::Author) == authors) {
            let Some(column) = window.shown_column(key.time, columns).filter(|_| authors || !crowded) else {
                continue;
            };
            let letter = key.shape.map_or('·', |s| s.letter()).to_string();
            let x = row.x + column;
            match authors {
                false if key.shape.is_some() || key.origin != Origin::Pause => {
                    put(buffer, x, row.y, 1, &letter, Style::new());
                }
                false => {
                    put(buffer, x, row.y, 1, "·", DIM);
                }
                true => {
                    for (at, bracket) in [(x.wrapping_sub(1), "["), (x + 1, "]")] {
                        let free = |c: &ratatui::buffer::Cell| matches!(c.symbol(), " " | "─");
                        if row.contains((at, row.y).into()) && buffer.cell((at, row.y)).is_some_and(free) {
                            put(buffer, at, row.y, 1, bracket, colours.accent());
                        }
                    }
                    put(buffer, x, row.y, 1, &letter, own_style(colours));
                }
            }
        }
    }
}

/// A mark of a key: when, its letter, what it says, whether the author set it.
struct Mark {
    time: f64,
    letter: char,
    text: String,
    own: bool,
}

/// The keys of one lane with what they set, or those of all lanes as letters.
pub(super) fn keys(buffer: &mut Buffer, row: Rect, lane: Option<Lane>, editor: &Editor, clip: &Clip, colours: Colours) {
    let (window, columns) = (editor.window, row.width);
    let wanted = |track| lane.is_none_or(|l| l == Lane::Keys(track));
    let mut marks: Vec<Mark> = Vec::new();
    if wanted(Track::Emotion) {
        for range in &clip.score.ranges {
            let (from, to) = (window.column(range.from, columns), window.column(range.to, columns));
            for column in from.max(0)..=to.min(i32::from(columns) - 1) {
                put(buffer, row.x + column as u16, row.y, 1, "~", colours.accent());
            }
        }
    }
    for key in clip.score.sorted_keys().filter(|k| k.value.track() != Track::Mouth && wanted(k.value.track())) {
        let letter = match key.value.track() {
            Track::Emotion => 'E',
            Track::Blink => 'B',
            Track::Gaze => 'G',
            Track::Head | Track::Mouth => 'H',
        };
        marks.push(Mark { time: key.time, letter, text: value_text(&key.value), own: true });
    }
    if wanted(Track::Blink) {
        for blink in editor.timeline.blinks().iter().filter(|b| !b.by_author) {
            // The moment of closure, as an author's key is.
            let time = blink.start + 0.3 * blink.length;
            marks.push(Mark { time, letter: 'b', text: String::new(), own: false });
        }
    }
    // In one column the author's come first: they are shown where there is room for one alone.
    marks.sort_by_key(|m| (window.column(m.time, columns), !m.own));
    // The waves of an edited stretch say more than that there are no keys beside it.
    let is_waved = wanted(Track::Emotion) && !clip.score.ranges.is_empty();
    if marks.is_empty() && !is_waved && lane.is_some_and(|l| l == editor.lane) {
        put(buffer, row.x, row.y, columns, "no keys yet: a adds one at the cursor", DIM);
    }
    let wanted: Vec<i32> = marks.iter().map(|m| window.column(m.time, columns)).collect();
    let places = spread(&wanted, i32::from(columns));
    for (index, (mark, place)) in marks.iter().zip(&places).enumerate() {
        let style = if mark.own { own_style(colours) } else { Style::new() };
        let Some(place) = *place else {
            // There is no room beside it either: the one that stands there has company.
            if let Some(column) = u16::try_from(wanted[index]).ok().filter(|c| *c < columns) {
                put(buffer, row.x + column, row.y, 1, "+", style);
            }
            continue;
        };
        let Some(column) = u16::try_from(place).ok().filter(|c| *c < columns) else { continue };
        let x = row.x + column;
        put(buffer, x, row.y, 1, &mark.letter.to_string(), style);
        // What it sets, up to the next key.
        let next = places[index + 1..].iter().flatten().next().copied();
        let next = next.map_or(i32::from(columns), |n| (n - 1).min(i32::from(columns)));
        let room = u16::try_from(next - place - 2).unwrap_or(0);
        if lane.is_some() && cells(&mark.text) <= room {
            put(buffer, x + 2, row.y, room, &mark.text, Style::new());
        }
    }
}

/// The columns of marks of which no two may share one: later ones go to the right, at most two columns and only where
/// nothing else belongs. Those that find no place have none.
fn spread(wanted: &[i32], columns: i32) -> Vec<Option<i32>> {
    let mut placed: Vec<Option<i32>> = Vec::with_capacity(wanted.len());
    for (index, want) in wanted.iter().enumerate() {
        let is_free =
            |c: &i32| !placed.contains(&Some(*c)) && (c == want || !wanted[index..].contains(c) && *c < columns);
        // What is out of sight stays there.
        let reach = if *want < 0 { *want } else { want + 2 };
        let place = (*want..=reach).find(is_free).or((*want < 0).then_some(*want));
        placed.push(place);
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_of_one_instant_stand_side_by_side_where_there_is_room() {
        assert_eq!(spread(&[4, 4, 4, 9], 66), [Some(4), Some(5), Some(6), Some(9)]);
        assert_eq!(spread(&[4, 4, 5], 66), [Some(4), Some(6), Some(5)]);
        assert_eq!(spread(&[4, 4, 5, 6], 66), [Some(4), None, Some(5), Some(6)]);
        assert_eq!(spread(&[65, 65], 66), [Some(65), None]);
    }
}
