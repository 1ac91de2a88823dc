//! The places that an alignment or a tracking is not sure of, to go to.

use super::desk::ClipDesk;
use crate::project::Doubt;
use crate::studio::app::lane::Lane;
use crate::studio::screens::review::ReviewScreen;
use crate::studio::widgets::prompt::Spotted;

/// Goes to the next or previous place.
pub(super) fn step(desk: &mut ClipDesk<'_, '_>, by: i32) {
    let clip = desk.clip();
    let doubts = clip.to_look_at();
    if doubts.is_empty() {
        let unknown = clip.timing.tier("confidence").is_none() && clip.score.tracked.is_none();
        desk.say(if unknown {
            "not aligned yet: A finds the times"
        } else {
            "nothing to look at: everything found is sure"
        });
        return;
    }
    let (cursor, on) = (desk.editor.cursor, desk.editor.syllable);
    // The doubt that one stands on, by its syllable, is neither before nor after.
    let is_here = |d: &Doubt| d.syllable.is_some() && d.syllable == on && (d.start - cursor).abs() < 0.02;
    let beyond = |d: &&Doubt| !is_here(d) && (d.start - cursor) * f64::from(by) > 1e-3;
    let found = if by > 0 { doubts.iter().find(beyond) } else { doubts.iter().rev().find(beyond) };
    match found {
        Some(doubt) => {
            let said = clip.told(doubt);
            go(desk, doubt.start, doubt.syllable);
            desk.say(said);
        }
        None => {
            let side = if by > 0 { "after" } else { "before" };
            desk.say(format!("nothing more to look at {side} here; {} in all", doubts.len()));
        }
    }
}

/// Lists everything there is to look at: what concerns the whole clip, then place by place.
pub(super) fn list(desk: &mut ClipDesk<'_, '_>) {
    let clip = desk.clip();
    let notes = desk.project.notes.get(&desk.editor.clip).into_iter().flatten();
    let whole = notes.map(|n| Spotted { at: None, syllable: None, text: n.clone() });
    let doubts = clip.to_look_at();
    let places = doubts.iter().map(|d| Spotted { at: Some(d.start), syllable: d.syllable, text: clip.told(d) });
    let list: Vec<Spotted> = whole.chain(places).collect();
    if list.is_empty() {
        desk.say("there is nothing to look at");
        return;
    }
    let cursor = desk.editor.cursor;
    let after = list.iter().position(|s| s.at.is_some_and(|at| at >= cursor - 0.02));
    let chosen = after.unwrap_or(list.len() - 1);
    desk.cx.push(ReviewScreen::new(list, chosen));
}

/// Goes to what was chosen in the list.
pub(super) fn go_to(desk: &mut ClipDesk<'_, '_>, spot: &Spotted) {
    if let Some(at) = spot.at {
        go(desk, at, spot.syllable);
        desk.say(spot.text.clone());
    }
}

fn go(desk: &mut ClipDesk<'_, '_>, time: f64, syllable: Option<usize>) {
    desk.go(time);
    desk.editor.syllable = syllable.or(desk.editor.syllable);
    if syllable.is_some() {
        desk.editor.lane = Lane::Syllables;
    }
}
