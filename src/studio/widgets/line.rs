//! A line of text being typed: `tui-input`'s editing, and what it does not know: a proposal, clean text, a limit.

use tui_input::{Input, InputRequest};

use crate::disk::clean_line;

/// The longest line, in letters.
const LIMIT: usize = 200;

/// A line being typed.
#[derive(Debug, Clone, Default)]
pub struct Line {
    input: Input,
    /// All of it is a proposal, not touched yet: the first letter typed takes its place.
    proposed: bool,
}

impl Line {
    /// A line that proposes a text, the caret behind it. Typing replaces it; moving the caret first keeps it.
    #[must_use]
    pub(crate) fn new(text: impl Into<String>) -> Self {
        let input = Input::new(text.into());
        Self { proposed: !input.value().is_empty(), input }
    }

    /// True while the text is a proposal that the next letter replaces.
    #[must_use]
    pub(crate) fn is_proposed(&self) -> bool {
        self.proposed
    }

    /// The text of the line.
    #[must_use]
    pub(crate) fn text(&self) -> &str {
        self.input.value()
    }

    /// The text before the caret.
    #[must_use]
    pub(crate) fn before_caret(&self) -> &str {
        let text = self.text();
        let end = text.char_indices().nth(self.input.cursor()).map_or(text.len(), |(at, _)| at);
        &text[..end]
    }

    /// Puts text in; what could act on a terminal is left out.
    pub(crate) fn put(&mut self, text: &str) {
        self.drop_proposal();
        let clean = if text == " " { " ".into() } else { clean_line(text, LIMIT) };
        let room = LIMIT.saturating_sub(self.text().chars().count());
        for letter in clean.chars().take(room) {
            self.input.handle(InputRequest::InsertChar(letter));
        }
    }

    /// Takes the letter before the caret away.
    pub(crate) fn rub(&mut self) {
        self.drop_proposal();
        self.input.handle(InputRequest::DeletePrevChar);
    }

    /// Takes the letter after the caret away.
    pub(crate) fn rub_ahead(&mut self) {
        self.drop_proposal();
        self.input.handle(InputRequest::DeleteNextChar);
    }

    /// Takes everything before the caret away.
    pub(crate) fn rub_line(&mut self) {
        self.proposed = false;
        self.input.handle(InputRequest::DeleteFromStart);
    }

    /// Moves the caret by so many letters, as far as there are any.
    pub(crate) fn move_caret(&mut self, by: i32) {
        self.proposed = false;
        let step = if by < 0 { InputRequest::GoToPrevChar } else { InputRequest::GoToNextChar };
        let mut left = by.unsigned_abs();
        while left > 0 && self.input.handle(step).is_some() {
            left -= 1;
        }
    }

    fn drop_proposal(&mut self) {
        if std::mem::take(&mut self.proposed) {
            self.input.reset();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_go_in_and_out_where_the_caret_is() {
        let mut line = Line::new("行2");
        line.move_caret(-1);
        line.put("hang");
        assert_eq!((line.text(), line.before_caret()), ("行hang2", "行hang"));
        line.rub();
        line.rub_ahead();
        assert_eq!(line.text(), "行han");
        line.move_caret(i32::MIN);
        line.rub();
        line.move_caret(1);
        line.rub_line();
        assert_eq!((line.text(), line.before_caret()), ("han", ""));
    }

    #[test]
    fn the_caret_steps_over_what_is_seen_as_one_letter() {
        let mut line = Line::new("臉🇹🇼");
        line.move_caret(-1);
        assert_eq!(line.before_caret(), "臉");
        line.rub_ahead();
        line.put("👍🏽");
        line.rub();
        assert_eq!(line.text(), "臉");
    }

    #[test]
    fn a_proposal_is_replaced_by_the_first_letter_and_kept_when_the_caret_moves_first() {
        let mut line = Line::new("nin2");
        line.put("h");
        assert_eq!((line.text(), line.before_caret()), ("h", "h"));
        let mut line = Line::new("nin2");
        line.move_caret(0);
        line.rub();
        line.put("3");
        assert_eq!(line.text(), "nin3");
        let mut line = Line::new("nin2");
        line.rub();
        assert_eq!(line.text(), "");
    }

    #[test]
    fn nothing_that_could_act_on_a_terminal_gets_in_and_no_line_is_endless() {
        let mut line = Line::default();
        line.put("a\x1b[31m\u{202E}b");
        assert_eq!(line.text(), "a[31mb");
        line.put(&"x".repeat(5000));
        assert_eq!(line.text().chars().count(), LIMIT);
    }
}
