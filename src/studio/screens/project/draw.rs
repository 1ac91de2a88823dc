//! Drawing a project: its clips, and what is there, missing or wrong.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use crate::disk::Fault;
use crate::project::{Clip, Finding, Lesson};
use crate::studio::app::colours::Colours;
use crate::studio::app::project::OpenProject;
use crate::studio::app::stack::View;
use crate::studio::app::wording;
use crate::studio::screens::timeline::aligning;
use crate::studio::widgets::text::{BOLD, DIM, cells, chosen_row, folded, head, put, put_short, rows};

/// A project that is open, with one of its clips chosen.
pub(super) fn project(view: &mut View<'_>, project: &OpenProject, chosen: usize) {
    let (area, colours) = (view.area, view.shell.colours);
    let (buffer, lesson) = (&mut *view.buffer, &project.lesson);
    let (standing, style) = project.standing(colours);
    head(buffer, area, &[&lesson.manifest.title], standing, style);
    let inner = inside(area);
    put(buffer, inner.x, inner.y, inner.width, "Clips", BOLD.add_modifier(Modifier::UNDERLINED));
    let room = (lesson.clips.len() as u16).clamp(1, inner.height / 2);
    let list = Rect { y: inner.y + 1, height: room, ..inner };
    clips(buffer, list, lesson, chosen);
    found(buffer, Rect { y: list.bottom() + 1, ..inner }, inner.bottom(), &project.findings, colours);
}

/// A project that does not open.
pub(super) fn damaged(view: &mut View<'_>, name: &str, fault: &Fault, list: &[Finding]) {
    let (area, colours) = (view.area, view.shell.colours);
    let buffer = &mut *view.buffer;
    head(buffer, area, &[name], "it does not open", colours.fault());
    let inner = inside(area);
    put(buffer, inner.x, inner.y, inner.width, "This lesson does not open.", BOLD);
    let mut y = inner.y + 1;
    // A check finds the same and more, as a rule.
    let told = list.iter().any(|f| matches!(f, Finding::Wrong(_)));
    for line in fault.to_string().lines().filter(|_| !told) {
        put_short(buffer, inner.x, y, inner.width, line, colours.fault());
        y += 1;
    }
    found(buffer, Rect { y: y + 1, ..inner }, inner.bottom(), list, colours);
}

fn inside(area: Rect) -> Rect {
    Rect::new(area.x + 1, area.y + 2, area.width - 2, area.height - 4)
}

/// The findings under their title, from the top of `area` to a row.
fn found(buffer: &mut Buffer, area: Rect, bottom: u16, list: &[Finding], colours: Colours) {
    if area.y < bottom {
        put(buffer, area.x, area.y, area.width, "What is there", BOLD.add_modifier(Modifier::UNDERLINED));
        findings(buffer, Rect { y: area.y + 1, height: bottom - area.y - 1, ..area }, list, colours);
    }
}

fn clips(buffer: &mut Buffer, list: Rect, lesson: &Lesson, chosen: usize) {
    if lesson.clips.is_empty() {
        put(buffer, list.x + 1, list.y, list.width, "no clips yet: add a [[clip]] to lianpu.toml", DIM);
    }
    let names = lesson.clips.iter().map(|c| cells(&c.entry.name)).max().unwrap_or(0).min(20) + 2;
    for (index, (y, clip)) in rows(list, chosen, &lesson.clips) {
        let style = chosen_row(buffer, list, y, index == chosen);
        let x = list.x + 1;
        put_short(buffer, x, y, names, &clip.entry.name, style.patch(BOLD));
        let facts = format!("{:>7.2} s   {}", clip.duration(), facts(clip));
        let used = names + put(buffer, x + names, y, list.width.saturating_sub(names + 2), &facts, style);
        let said = clip.script.split_whitespace().collect::<Vec<_>>().join(" ");
        put_short(buffer, x + used + 3, y, list.width.saturating_sub(used + 5), &said, style);
    }
}

fn facts(clip: &Clip) -> String {
    let mut facts = vec![match clip.syllables.len() {
        1 => "1 syllable".to_owned(),
        many => format!("{many} syllables"),
    }];
    let origin = aligning::origin(clip);
    if !origin.is_empty() {
        facts.push(origin);
    }
    match clip.score.keys.len() {
        0 => {}
        1 => facts.push("1 key".into()),
        many => facts.push(format!("{many} keys")),
    }
    facts.join(", ")
}

fn findings(buffer: &mut Buffer, area: Rect, findings: &[Finding], colours: Colours) {
    let warning = colours.warning();
    let mut y = area.y;
    // What is wrong first, then what is odd: the rest may be cut off below.
    let rank = |f: &&Finding| match f {
        Finding::Wrong(_) => 0,
        Finding::Odd(_) => 1,
        Finding::Fine(_) => 2,
    };
    let mut sorted: Vec<&Finding> = findings.iter().collect();
    sorted.sort_by_key(rank);
    for finding in sorted {
        let (mark, style, text) = match finding {
            Finding::Fine(text) => ("✓", Style::new(), text.clone()),
            Finding::Odd(text) => ("!", warning, wording::worded(text)),
            Finding::Wrong(fault) => ("✗", colours.fault().add_modifier(Modifier::BOLD), fault.worded(&wording::word)),
        };
        for (index, line) in text.lines().flat_map(|l| folded(l.trim(), area.width.saturating_sub(3))).enumerate() {
            if y >= area.bottom() {
                return;
            }
            if index == 0 {
                put(buffer, area.x, y, 1, mark, style);
            }
            put(buffer, area.x + 2, y, area.width - 2, &line, style);
            y += 1;
        }
    }
}
