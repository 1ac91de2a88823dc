//! Numbers of things in words.

/// A number of things in words: `1 clip`, `2 clips`.
pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
