//! The steps of messages as commands and flags.

use std::fmt::Write;

use crate::disk::{Message, NextStep, Setting, Task};

/// A step as it is typed: a task as a command in backticks, settings as flags.
pub(super) fn word(step: &NextStep) -> String {
    let mut text = String::new();
    if let Some(task) = step.task {
        text.push_str(command(task));
        if step.settings.is_empty() && matches!(task, Task::FindFace | Task::Open) {
            text.push_str(" PROJECT");
        }
    }
    for (setting, value) in &step.settings {
        let (flag, example) = flag(*setting);
        if !text.is_empty() {
            text.push(' ');
        }
        text.push_str(flag);
        // Writing to a string cannot fail.
        let _ = match (value, example) {
            (Some(value), _) => write!(text, " {value}"),
            (None, "") => Ok(()),
            (None, example) => write!(text, " {example}"),
        };
    }
    if step.task.is_some() { format!("`{text}`") } else { text }
}

const fn command(task: Task) -> &'static str {
    match task {
        Task::Align => "lianpu align",
        Task::Calibrate => "lianpu calibrate",
        Task::Convert => "lianpu convert",
        Task::Export => "lianpu export",
        Task::FindFace => "lianpu face",
        Task::Merge => "lianpu merge",
        Task::New => "lianpu new",
        Task::Open => "lianpu",
        Task::Track => "lianpu track",
        Task::TrainModel => "lianpu aam train",
    }
}

/// The flag of a setting and an example of its value; no example where the flag has no value.
const fn flag(setting: Setting) -> (&'static str, &'static str) {
    match setting {
        Setting::Anchors => ("--at", "LEFT-EYE RIGHT-EYE MOUTH CHIN"),
        Setting::Clip => ("--clip", "NAME"),
        Setting::Face => ("--face", "NAME"),
        Setting::Format => ("--to", "FORMAT"),
        Setting::Frames => ("--frames", "A-B"),
        Setting::Method => ("--by", "aam|regions"),
        Setting::Neutral => ("--neutral", "PHOTO"),
        Setting::NeutralFrame => ("--neutral-frame", "N"),
        Setting::Out => ("--out", "DIR"),
        Setting::Ratios => ("--ratios", "FILE"),
        Setting::Replace => ("--replace", ""),
        Setting::Script => ("--script", "FILE"),
        Setting::Shard => ("--shard", "I/N"),
        Setting::Speech => ("--speech", "FILE"),
        Setting::System => ("--from", "SYSTEM"),
        Setting::Tier => ("--tier", "NAME"),
        Setting::Timing => ("--timing", "FILE"),
        Setting::Video => ("--video", "FILE"),
    }
}

/// A message in the words of the command line.
pub(super) fn worded(message: impl Into<Message>) -> String {
    message.into().worded(&word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_worded_as_they_are_typed() {
        assert_eq!(word(&Task::Align.into()), "`lianpu align`");
        assert_eq!(word(&Task::Align.with(Setting::Clip, "a")), "`lianpu align --clip a`");
        assert_eq!(word(&NextStep::from(Task::Track).and(Setting::Replace)), "`lianpu track --replace`");
        assert_eq!(word(&Setting::Out.into()), "--out DIR");
        assert_eq!(word(&Setting::Shard.of("2/3")), "--shard 2/3");
    }
}
