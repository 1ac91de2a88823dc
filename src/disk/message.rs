//! Text for people in which the steps to take are data, so that each face words them itself.

use std::fmt;

use super::NextStep;

/// A sentence or two, with [`NextStep`]s in it.
///
/// ```ignore
/// use lianpu::disk::{Message, Task};
/// let note = Message::from("the times are guessed; ").then(Task::Align).then(" finds them");
/// assert_eq!(note.to_string(), "the times are guessed; aligning finds them");
/// assert_eq!(note.worded(&|_| "`A`".to_owned()), "the times are guessed; `A` finds them");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Message {
    parts: Vec<Part>,
}

/// A stretch of a [`Message`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Part {
    /// Plain text.
    Text(String),
    /// A step to be worded.
    Step(NextStep),
}

impl Message {
    /// The same with one part more.
    #[must_use]
    pub(crate) fn then(mut self, part: impl Into<Part>) -> Self {
        self.parts.push(part.into());
        self
    }

    /// The text with every step as `word` puts it.
    #[must_use]
    pub(crate) fn worded(&self, word: &dyn Fn(&NextStep) -> String) -> String {
        let text = |part: &Part| match part {
            Part::Text(text) => text.clone(),
            Part::Step(step) => word(step),
        };
        self.parts.iter().map(text).collect()
    }

    /// The steps in it, in order.
    pub fn steps(&self) -> impl Iterator<Item = &NextStep> {
        self.parts.iter().filter_map(|part| match part {
            Part::Text(_) => None,
            Part::Step(step) => Some(step),
        })
    }

    /// Whether there is nothing in it.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.parts.iter().all(|part| matches!(part, Part::Text(text) if text.is_empty()))
    }

    /// The same behind a text such as `clip nihao: `.
    #[must_use]
    pub(crate) fn after(mut self, before: impl Into<String>) -> Self {
        self.parts.insert(0, Part::Text(before.into()));
        self
    }
}

/// A [`Message`] of texts and steps: `message!["give ", Setting::Out]`.
macro_rules! message {
    ($($part:expr),+ $(,)?) => { $crate::disk::Message::default()$(.then($part))+ };
}
pub(crate) use message;

impl fmt::Display for Message {
    /// With steps as noun phrases that name no program and no key.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.worded(&NextStep::to_string))
    }
}

impl From<&str> for Message {
    fn from(text: &str) -> Self {
        Self::default().then(text)
    }
}

impl From<String> for Message {
    fn from(text: String) -> Self {
        Self::default().then(text)
    }
}

impl From<&Self> for Message {
    fn from(message: &Self) -> Self {
        message.clone()
    }
}

impl From<&str> for Part {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Part {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl<T: Into<NextStep>> From<T> for Part {
    fn from(step: T) -> Self {
        Self::Step(step.into())
    }
}
