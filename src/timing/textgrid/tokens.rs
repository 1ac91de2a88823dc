//! The pieces of a TextGrid: numbers, texts in quotes, flags, and the words between them.

use crate::disk::{Fault, FileFault, Result};

/// One piece and the line on which it begins.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Token {
    pub kind: Kind,
    pub line: usize,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kind {
    /// A number that stands alone.
    Number(f64),
    /// A text in quotes, with doubled quotes undone.
    Text(String),
    /// `<exists>` or `<absent>`.
    Flag(String),
    /// Anything else: `xmin`, `intervals`, `[3]:`.
    Word(String),
    /// `=`, after which a value must follow.
    Assign,
}

impl Kind {
    /// Whether it is a value rather than a word about one.
    pub(crate) fn is_value(&self) -> bool {
        matches!(self, Self::Number(_) | Self::Text(_) | Self::Flag(_))
    }

    /// As it is shown in a fault.
    pub(crate) fn shown(&self) -> String {
        match self {
            Self::Number(n) => format!("`{n}`"),
            Self::Text(text) => format!("the text `{}`", shortened(text)),
            Self::Flag(word) | Self::Word(word) => format!("`{}`", shortened(word)),
            Self::Assign => "`=`".to_owned(),
        }
    }
}

/// At most 40 characters on one line.
fn shortened(text: &str) -> String {
    let mut short: String = text.chars().take(40).map(|c| if c == '\n' { ' ' } else { c }).collect();
    if text.chars().nth(40).is_some() {
        short.push('…');
    }
    short
}

/// Whether a text begins like a file of Praat's.
pub(in crate::timing) fn is_header(text: &str) -> bool {
    let first = text.trim_start().lines().next().unwrap_or_default();
    first.contains("ooTextFile") || is_chronological(text)
}

/// Whether a text is of the chronological form.
pub(super) fn is_chronological(text: &str) -> bool {
    text.trim_start().lines().next().is_some_and(|first| first.contains("Praat chronological TextGrid"))
}

/// Whether the first thing after the two lines of the header is a number: the short form.
pub(in crate::timing) fn is_short(text: &str) -> bool {
    let after = text.splitn(5, '"').nth(4).unwrap_or_default().trim_start();
    after.starts_with(|c: char| c.is_ascii_digit() || c == '-')
}

/// All pieces of a text.
///
/// # Errors
/// A text in quotes that is never closed, or goes on after its closing quote.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>> {
    let mut tokens = Vec::new();
    let mut line = 1;
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        let began = line;
        let kind = match c {
            '\n' => {
                line += 1;
                continue;
            }
            c if c.is_whitespace() => continue,
            '!' => {
                while chars.next_if(|c| *c != '\n').is_some() {}
                continue;
            }
            '=' => Kind::Assign,
            '"' => {
                let mut label = String::new();
                loop {
                    match chars.next() {
                        Some('"') if chars.next_if_eq(&'"').is_some() => label.push('"'),
                        Some('"') => break,
                        Some(c) => {
                            line += usize::from(c == '\n');
                            label.push(c);
                        }
                        None => {
                            return Err(Fault::of(
                                FileFault::CutOff,
                                format!("the file ends inside the text `{}`", shortened(&label)),
                            )
                            .line(began)
                            .help("the quote opened here is never closed; was the file cut off?"));
                        }
                    }
                }
                if chars.peek().is_some_and(|c| !c.is_whitespace() && *c != '!') {
                    return Err(Fault::new(format!(
                        "the text `{}` goes on after its closing quote",
                        shortened(&label)
                    ))
                    .line(line)
                    .help("a quote inside a text is written twice"));
                }
                Kind::Text(label)
            }
            c => {
                let mut word = String::from(c);
                while let Some(c) = chars.next_if(|c| !c.is_whitespace() && *c != '=') {
                    word.push(c);
                }
                word_or_value(word)
            }
        };
        tokens.push(Token { kind, line: began });
    }
    Ok(tokens)
}

/// A word that begins like a number and is one; `inf` and `nan` are words.
fn word_or_value(word: String) -> Kind {
    let numeric = word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'))
        && !word.contains(|c: char| c.is_ascii_alphabetic() && !c.eq_ignore_ascii_case(&'e'));
    match word.parse::<f64>() {
        Ok(number) if numeric => Kind::Number(number),
        _ if word.starts_with('<') => Kind::Flag(word),
        _ => Kind::Word(word),
    }
}
