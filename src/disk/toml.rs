//! TOML with faults that name the line, and for an unknown key the nearest known one.

use serde::de::DeserializeOwned;

use super::{Fault, FileFault, Result, suggestion};

/// Reads a TOML text into a type that refuses unknown keys.
///
/// # Errors
/// With the line, what was found and what is allowed.
pub fn from_toml<T: DeserializeOwned>(text: &str) -> Result<T> {
    toml::from_str(text).map_err(|error| {
        let line = error.span().map(|s| 1 + text[..s.start.min(text.len())].matches('\n').count());
        let message = error.message().trim();
        let fault = match unknown(message) {
            Some((what, word, known)) => Fault::of(FileFault::Unknown, format!("unknown {what} `{word}`"))
                .help(suggestion(word, "known here", &known)),
            None if message.starts_with("missing field") => {
                let key = message.split('`').nth(1).unwrap_or_default();
                Fault::of(FileFault::Missing, format!("there is no `{key}`")).help(match key {
                    // The only value there is so far, so a beginner need not look for it.
                    "format" => "add `format = 1` at the top".to_owned(),
                    _ => format!("add `{key} = …`"),
                })
            }
            None => Fault::new(message.lines().collect::<Vec<_>>().join("; ").replace("invalid type: ", "found "))
                .help(expected(message)),
        };
        match line {
            Some(line) => fault.line(line),
            None => fault,
        }
    })
}

/// Takes serde's "unknown field `x`, expected one of `a`, `b`" apart, and the same of variants.
fn unknown(message: &str) -> Option<(&'static str, &str, Vec<&str>)> {
    let (what, rest) = match message.strip_prefix("unknown field `") {
        Some(rest) => ("key", rest),
        None => ("word", message.strip_prefix("unknown variant `")?),
    };
    let (word, rest) = rest.split_once('`')?;
    Some((what, word, rest.split('`').skip(1).step_by(2).collect()))
}

/// What serde expected, in words for people; its own names of types say nothing to a teacher.
fn expected(message: &str) -> &'static str {
    match message.rsplit("expected ").next().unwrap_or_default().trim() {
        "f64" | "f32" | "a floating point number" => "a number is needed here",
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number from 0 on is needed here, without a point",
        "a string" => "a text in quotes is needed here",
        "a boolean" => "true or false is needed here",
        _ => "see the README for how the file is written",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Output {
        fps: u32,
        size: [u32; 2],
    }

    #[test]
    fn an_unknown_key_names_its_line_and_the_nearest_known_one() {
        let fault = from_toml::<Output>("# frames\nfsp = 25\nsize = [1, 2]\n").unwrap_err();
        assert_eq!(fault.what(), "unknown key `fsp`");
        assert_eq!(fault.line_number(), Some(2));
        assert!(fault.next_step().contains("did you mean `fps`"), "{fault}");
    }
}
