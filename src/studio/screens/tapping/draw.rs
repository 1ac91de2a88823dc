//! What tapping asks for, in the place of the ratios, and what was tapped, on the ruler.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::clock::{Phase, Tapping};
use crate::project::Clip;
use crate::studio::app::shell::Shell;
use crate::studio::screens::timeline::draw::Layout;
use crate::studio::screens::timeline::editor::Editor;
use crate::studio::widgets::text::{BOLD, folded, put};

/// The panel beside the face.
pub(in crate::studio) fn panel(buffer: &mut Buffer, area: Rect, shell: &Shell, tapping: &Tapping, clip: &Clip) {
    let mut y = area.y;
    for (index, line) in lines(shell, tapping, clip).iter().enumerate() {
        // What there is to do now stands out.
        let style = if index == 0 { BOLD.add_modifier(Modifier::REVERSED) } else { Style::new() };
        let lines = if line.starts_with(' ') { vec![line.clone()] } else { folded(line, area.width) };
        for part in &lines {
            if y >= area.bottom() {
                return;
            }
            put(buffer, area.x, y, area.width, part, if part.trim().is_empty() { Style::new() } else { style });
            y += 1;
        }
        y += u16::from(index < 2);
    }
}

/// The taps on the ruler: starts, and ends before a pause.
pub(in crate::studio) fn marks(
    buffer: &mut Buffer,
    layout: &Layout,
    shell: &Shell,
    editor: &Editor,
    tapping: &Tapping,
) {
    for tap in &tapping.taps {
        if let Some(column) = editor.window.shown_column(tap.at, layout.columns()) {
            let sign = if tap.is_end { "╴" } else { "▾" };
            let style = shell.colours.accent().add_modifier(Modifier::BOLD);
            put(buffer, layout.ruler.x + column, layout.ruler.y, 1, sign, style);
        }
    }
}

/// What tapping asks of the author now, line by line.
fn lines(shell: &Shell, tapping: &Tapping, clip: &Clip) -> Vec<String> {
    let name = |i: usize| clip.syllables.get(i).map(|s| format!("{} {}", s.text, s.pinyin).trim_end().to_owned());
    let speed = if tapping.speed < 1.0 { "half speed" } else { "full speed" };
    let source = match shell.can_hear {
        true => "the clip is played here; if you hear nothing, play it yourself when the count ends".to_owned(),
        false => format!(
            "no sound from here: play the recording yourself{}, from {:.2} s, when the count ends",
            if tapping.speed < 1.0 { " at half speed" } else { "" },
            tapping.from
        ),
    };
    let late = match shell.latency {
        Some(late) => format!("{:.0} ms are taken off each tap", late * 1e3),
        None => "how late your taps come is not known: c measures it".to_owned(),
    };
    let many = tapping.taps.iter().filter(|t| !t.is_end).count();
    let done = format!("{} of {} tapped", many, clip.syllables.len());
    let next = name(tapping.next).map_or("all are tapped: q keeps them".to_owned(), |n| format!("next: {n}"));
    match &tapping.phase {
        Phase::Ready => vec![
            format!("Tapping, {speed}, from {:.2} s", tapping.from),
            next,
            source,
            "Enter begins, after a count of three".into(),
            late,
        ],
        Phase::Counting(_) => vec![tapping.count().map_or(String::new(), |c| format!("   {c}")), next, source],
        Phase::Running => vec![next, done, "Enter: it starts now   Space: a pause starts now".into()],
        Phase::Over => vec![done, "stopped: q keeps them, Backspace goes a second back and on".into()],
        Phase::Measuring { .. } => {
            let light = if tapping.flash().is_some() { "   ████████" } else { "" };
            let many = tapping.measured();
            vec!["Enter with every flash".into(), light.into(), light.into(), format!("{many} taps")]
        }
    }
}
