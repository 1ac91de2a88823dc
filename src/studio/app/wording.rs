//! The steps of messages as keys of the studio; the command line's words for those that no key takes.

use super::action::{Action, Action as A};
use super::keys::{Place, TABLE, shown};
use crate::disk::{Fault, Message, NextStep, Setting, Task};

/// A step as an author at the studio takes it.
pub(in crate::studio) fn word(step: &NextStep) -> String {
    match (step.task, step.settings.first()) {
        (Some(Task::Align), _) => key(Place::Timeline, A::Align),
        (Some(Task::Track), _) => key(Place::Timeline, A::Follow),
        (Some(Task::Calibrate), _) => key(Place::Face, A::Calibrate),
        (Some(Task::FindFace), _) => format!("{} on the page of the face", key(Place::Face, A::FindAgain)),
        (Some(Task::Export), _) => key(Place::Lesson, A::Export),
        (Some(Task::New), _) => "`lianpu new` on the command line".to_owned(),
        (Some(Task::Open), _) => "the studio".to_owned(),
        (None, Some((Setting::Anchors, _))) => key(Place::Face, A::Anchors),
        (None, Some((Setting::Out, _))) => "`lianpu export … --out DIR` on the command line".to_owned(),
        _ => step.to_string(),
    }
}

/// A message in the studio's words.
pub(in crate::studio) fn worded(message: &Message) -> String {
    message.worded(&word)
}

/// A fault in one line, without its place.
pub(in crate::studio) fn in_a_line(fault: &Fault) -> String {
    worded(&fault.in_a_line())
}

/// The first key of an action in a place, in backticks.
fn key(place: Place, action: Action) -> String {
    let rows = TABLE.iter().filter(|row| row.places.contains(&place));
    let found = rows.flat_map(|row| row.keys).find(|(_, a)| *a == action);
    found.map_or_else(String::new, |(key, _)| format!("`{}`", shown(key)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disk::message;

    #[test]
    fn steps_are_worded_as_keys_that_are_in_the_table() {
        let note = message!["the times are guessed; ", Task::Align, " finds them"];
        assert_eq!(worded(&note), "the times are guessed; `A` finds them");
        for task in [Task::Align, Task::Track, Task::Calibrate, Task::FindFace, Task::Export] {
            assert!(word(&task.into()).starts_with('`'), "{task:?}");
        }
        assert!(word(&Setting::Anchors.into()).starts_with('`'));
    }
}
