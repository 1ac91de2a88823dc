//! The panel beside the face: the seven ratios at the cursor as bars with numbers, and what is there.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use crate::pose::Emotion;
use crate::project::{Clip, Concern};
use crate::studio::app::colours::Colours;
use crate::studio::app::keys::{Place, help_of};
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::screens::timeline::edits;
use crate::studio::widgets::text::{BOLD, DIM, cells, put, put_short};

/// The widest bar: beyond, a longer one tells no more.
const WIDEST: u16 = 50;

/// A panel this wide has room for the keys beside the bars.
const ROOMY: u16 = 124;

pub(super) fn panel(buffer: &mut Buffer, area: Rect, editor: &Editor, clip: &Clip, colours: Colours) {
    let left = Rect { width: area.width.min(if area.width >= ROOMY { 66 } else { 78 }), ..area };
    let lines = lines(editor, clip, left.width, colours);
    let count = lines.len() as u16;
    // Where there is no room for both, time and syllable come first and of the ratios only what there is.
    let is_low = area.height < 7 + count;
    let (bars, text) = match is_low {
        true => (Rect { y: left.y + count, height: left.height.saturating_sub(count), ..left }, left),
        false => {
            let gap = 7 + u16::from(area.height > 7 + count);
            (Rect { height: 7, ..left }, Rect { y: left.y + gap, height: left.height - gap, ..left })
        }
    };
    ratios(buffer, bars, editor, is_low, colours);
    for ((line, style), y) in lines.iter().zip(text.y..text.bottom()) {
        put_short(buffer, text.x, y, text.width, line, *style);
    }
    if area.width >= ROOMY {
        let keys = Rect { x: left.right() + 3, width: area.right() - left.right() - 3, ..area };
        let widest = help_of(Place::Timeline).map(|(names, _)| cells(&names)).max().unwrap_or(0);
        let all: Vec<_> = help_of(Place::Timeline).collect();
        let is_cut = all.len() > usize::from(keys.height);
        // Of too many the last line says where the others are.
        let room = usize::from(keys.height).saturating_sub(usize::from(is_cut));
        let rest = is_cut.then(|| ("?".to_owned(), "the other keys"));
        for ((names, help), y) in all.into_iter().take(room).chain(rest).zip(keys.y..keys.bottom()) {
            put(buffer, keys.x, y, widest, &names, BOLD);
            put_short(buffer, keys.x + widest + 2, y, keys.width.saturating_sub(widest + 2), help, DIM);
        }
    }
}

/// A bar a ratio: letter, name, bar, number; of all seven, or of those that are not zero.
fn ratios(buffer: &mut Buffer, area: Rect, editor: &Editor, only_some: bool, colours: Colours) {
    let ratios = editor.timeline.ratios(editor.cursor);
    let widest = area.width.saturating_sub(19).min(WIDEST);
    let shown = Emotion::ALL.into_iter().filter(|e| !only_some || ratios[*e].abs() >= 0.005);
    for (emotion, y) in shown.zip(area.y..area.bottom()) {
        let style = colours.of_emotion(emotion);
        put(buffer, area.x, y, 1, &emotion.letter().to_string(), style.add_modifier(Modifier::BOLD));
        put(buffer, area.x + 2, y, 9, emotion.name(), Style::new());
        let value = ratios[emotion];
        put(buffer, area.x + 12, y, widest, &bar(value, widest), style);
        let text = format!("{value:>5.2}").replace("-0.00", " 0.00");
        put(buffer, area.x + 13 + widest, y, 5, &text, Style::new());
    }
}

/// A bar from 0 to 1 in eighths of a cell; below 0 and beyond 1 an arrow says so.
fn bar(value: f64, widest: u16) -> String {
    if value < -0.005 {
        return "◂".into();
    }
    let eighths = (value.min(1.0) * f64::from(widest) * 8.0).round().max(0.0) as usize;
    let mut text = "█".repeat(eighths / 8);
    if !eighths.is_multiple_of(8) {
        text.extend(char::from_u32(0x2590 - (eighths % 8) as u32));
    }
    if value > 1.005 {
        text.pop();
        text.push('▸');
    }
    text
}

/// What is at the cursor, line by line, the most telling first.
fn lines(editor: &Editor, clip: &Clip, width: u16, colours: Colours) -> Vec<(String, Style)> {
    let duration = editor.timeline.duration();
    let last = editor.timeline.frames().saturating_sub(1);
    let mut now = format!("{:.3} of {duration:.2} s   frame {} (last {last})", editor.cursor, editor.frame());
    let shown = format!("   {:.2} s shown", editor.window.span.min(duration));
    if cells(&now) + cells(&shown) <= width {
        now.push_str(&shown);
    }
    let mut lines = vec![(now, Style::new())];
    if let Some((from, to)) = editor.place_here() {
        lines.push((format!("○ no words yet   {from:.3} to {to:.3} s   Enter types them"), colours.accent()));
    } else if let Some((index, syllable, interval)) =
        editor.syllable.and_then(|i| Some((i, clip.syllables.get(i)?, clip.intervals().get(i)?)))
    {
        let reading = match (syllable.pinyin.as_str(), syllable.zhuyin.as_str()) {
            ("", _) => String::new(),
            (pinyin, zhuyin) => format!(" {pinyin} {zhuyin}"),
        };
        let guessed = Editor::is_guessed(clip, index);
        let confidence = clip.confidence(index);
        let doubt = clip.doubts().into_iter().find(|d| d.syllable == Some(index) && !guessed);
        let doubtful = doubt.is_some();
        let style = if guessed || doubtful { colours.warning() } else { Style::new() };
        let mark = match confidence {
            _ if clip.score.pins.contains(&index) => "   by hand".to_owned(),
            _ if guessed => "   guessed?".to_owned(),
            Some(_) if doubt.is_some_and(|d| d.what == Concern::NotHeard) => "   not heard!".to_owned(),
            Some(c) => format!("   {:.0} % sure{}", c * 100.0, if doubtful { "!" } else { "" }),
            None => String::new(),
        };
        let text = format!("{}{reading}   {:.3} to {:.3} s{mark}", syllable.text, interval.start, interval.end);
        lines.push((text, style));
    }
    let lost = clip.lost().into_iter().find(|d| (d.start - 1e-9..d.end).contains(&editor.cursor));
    if let Some(lost) = lost {
        lines.push((format!("{}!", clip.told(&lost)), colours.warning()));
    }
    let (_, shape) = editor.timeline.mouth(editor.cursor);
    let shape = shape.map_or("rest".into(), |s| s.to_string());
    let key = edits::key_line(editor, clip).map_or(String::new(), |k| format!("   {k}"));
    lines.push((format!("mouth {shape}{key}"), Style::new()));
    if let Some(range) = edits::range_line(editor, clip) {
        lines.push((range, colours.accent()));
    }
    if let Some(mark) = editor.mark {
        lines.push((format!("marked from {mark:.3} s: v at the other end"), colours.warning()));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_count_in_eighths_and_arrows_say_what_is_beyond() {
        assert_eq!(bar(0.5, 10), "█████");
        assert_eq!(bar(0.0625, 2), "▏");
        assert_eq!(bar(0.125, 4), "▌");
        assert_eq!(bar(-0.2, 4), "◂");
        assert_eq!(bar(1.5, 4), "███▸");
        assert_eq!(bar(0.0, 4), "");
    }
}
