//! Properties with keys, as Lottie writes them.

use std::fmt::Write;

/// A property whose values, each an array in JSON, are held from key to key; keys that change nothing are left out.
pub(super) fn keyed(keys: &[(u32, String)]) -> String {
    let mut text = String::new();
    let mut last: Option<&str> = None;
    let mut count = 0;
    for (frame, value) in keys {
        if last != Some(value.as_str()) {
            let _ = write!(text, "{}{{\"t\":{frame},\"h\":1,\"s\":{value}}}", if count > 0 { "," } else { "" });
            (last, count) = (Some(value.as_str()), count + 1);
        }
    }
    match (count, last) {
        (0, _) | (_, None) => "{\"a\":0,\"k\":0}".to_owned(),
        (1, Some(value)) => format!("{{\"a\":0,\"k\":{}}}", alone(value)),
        _ => format!("{{\"a\":1,\"k\":[{text}]}}"),
    }
}

/// A value that never changes: a shape and a single number stand for themselves, not in an array.
pub(super) fn alone(value: &str) -> &str {
    let inner = value.strip_prefix('[').and_then(|v| v.strip_suffix(']')).unwrap_or(value);
    if inner.starts_with('{') || !inner.contains(',') { inner } else { value }
}
