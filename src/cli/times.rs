//! Syllables in time as they are printed: a table for people, an array for machines.

use serde::Serialize;

use crate::disk::{Fault, Result, printable_json};
use crate::project::{Clip, Concern};
use crate::script::Syllable;
use crate::speech::{self, SURE};
use crate::timing::Interval;

/// One syllable, as it is printed.
#[derive(Debug, Serialize)]
pub(super) struct Row {
    #[serde(skip_serializing_if = "Option::is_none")]
    clip: Option<String>,
    text: String,
    pinyin: String,
    start: f64,
    end: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    confidence: Option<f64>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    not_heard: bool,
    phones: Vec<PhoneRow>,
}

#[derive(Debug, Serialize)]
struct PhoneRow {
    phone: String,
    start: f64,
    end: f64,
}

/// Times as they are printed: to a tenth of a millisecond.
pub(super) fn seconds(t: f64) -> f64 {
    (t * 1e4).round() / 1e4
}

impl Row {
    pub(super) fn found(syllable: &Syllable, found: &speech::SpokenSyllable) -> Self {
        let phone =
            |p: &speech::SpokenPhone| PhoneRow { phone: p.phone.into(), start: seconds(p.start), end: seconds(p.end) };
        Self {
            clip: None,
            text: syllable.text.clone(),
            pinyin: syllable.pinyin.clone(),
            start: seconds(found.start),
            end: seconds(found.end),
            confidence: Some((found.confidence * 1000.0).round() / 1000.0),
            not_heard: !found.heard,
            phones: found.phones.iter().map(phone).collect(),
        }
    }

    /// What a lesson has of a clip, from its tiers.
    pub(super) fn of_clip(clip: &Clip, named: bool) -> Vec<Self> {
        let mut unheard: Vec<usize> =
            clip.doubts().iter().filter(|d| d.what == Concern::NotHeard).filter_map(|d| d.syllable).collect();
        unheard.sort_unstable();
        let phones = clip.timing.tier("phones").map(|t| t.intervals.as_slice()).unwrap_or_default();
        let row = |(i, (syllable, interval)): (usize, (&Syllable, &Interval))| {
            let middle = |p: &Interval| f64::midpoint(p.start, p.end);
            let from = phones.partition_point(|p| middle(p) < interval.start);
            let own = phones[from..].iter().take_while(|p| middle(p) < interval.end);
            let phone =
                |p: &Interval| PhoneRow { phone: p.label.clone(), start: seconds(p.start), end: seconds(p.end) };
            Self {
                clip: named.then(|| clip.entry.name.clone()),
                text: syllable.text.clone(),
                pinyin: syllable.pinyin.clone(),
                start: seconds(interval.start),
                end: seconds(interval.end),
                confidence: clip.confidence(i),
                not_heard: unheard.binary_search(&i).is_ok(),
                phones: own.map(phone).collect(),
            }
        };
        clip.syllables.iter().zip(clip.intervals()).enumerate().map(row).collect()
    }
}

/// An array, one object a line.
pub(super) fn json<T: Serialize>(rows: &[T]) -> Result<String> {
    let lines: Result<Vec<String>, _> = rows.iter().map(serde_json::to_string).collect();
    let lines = lines.map_err(|e| Fault::new(format!("it cannot be written as JSON: {e}")))?;
    let text = if lines.is_empty() { "[]\n".into() } else { format!("[\n  {}\n]\n", lines.join(",\n  ")) };
    Ok(printable_json(&text).into_owned())
}

pub(super) fn table(rows: &[Row]) -> String {
    let mut text = String::new();
    for row in rows {
        let sure = match row.confidence {
            _ if row.not_heard => " not heard".into(),
            Some(c) if c < SURE => format!(" {c:.2} ?"),
            Some(c) => format!(" {c:.2}"),
            None => String::new(),
        };
        let said = if row.pinyin.is_empty() { String::new() } else { format!(" {}", row.pinyin) };
        text.push_str(&format!("{:8.3} {:8.3} {sure:<7} {}{said}\n", row.start, row.end, row.text));
    }
    text
}
