//! `score.toml`: a score as a person can read, write and diff it.

use serde::Deserialize;

use super::blink::BLINK_SECONDS;
use super::{Ease, Key, KeyValue, Marker, Range, Score, Track};
use crate::disk::{Fault, FileFault, Result, from_toml};
use crate::pose::{Emotion, Gaze, Head, Ratios};

impl Score {
    /// Reads `score.toml`.
    ///
    /// # Errors
    /// With the line, what was found and what is allowed.
    pub fn parse(text: &str) -> Result<Self> {
        let file: File = from_toml(text)?;
        let line_of = |span: std::ops::Range<usize>| 1 + text[..span.start.min(text.len())].matches('\n').count();
        // TOML's integers end there, so a larger seed could be read and not written.
        if i64::try_from(file.seed).is_err() {
            return Err(Fault::of(FileFault::OutOfRange, format!("`seed` is {}", file.seed))
                .help(format!("give at most {}", i64::MAX)));
        }
        let mut score = Self { seed: file.seed, auto_blink: file.auto_blink, pins: file.pins, ..Self::default() };
        score.pins.sort_unstable();
        score.pins.dedup();
        score.guessed = file.guessed;
        // Anything else was not written by this program, and is the checksum of nothing.
        let is_checksum = |s: &String| s.len() == 8 && s.bytes().all(|b| b.is_ascii_hexdigit());
        score.aligned = file.aligned.filter(is_checksum);
        score.tracked = file.tracked.filter(|s| s.len() == 16 && s.bytes().all(|b| b.is_ascii_hexdigit()));
        for key in file.keys {
            let line = line_of(key.span());
            score.keys.push(key.into_inner().read().map_err(|f| f.line(line))?);
        }
        for range in file.ranges {
            let line = line_of(range.span());
            score.ranges.push(range.into_inner().read().map_err(|f| f.line(line))?);
        }
        for marker in file.markers {
            let line = line_of(marker.span());
            let marker = marker.into_inner();
            checked_time(marker.time, "time").map_err(|f| f.line(line))?;
            score.markers.push(Marker { time: marker.time, text: crate::disk::clean_line(&marker.text, 200) });
        }
        Ok(score)
    }

    /// The text of `score.toml`: keys in order of time, what is usual left out.
    #[must_use]
    pub(crate) fn to_toml(&self) -> String {
        use std::fmt::Write;
        let mut out = String::new();
        let usual = Self::default();
        if self.seed != usual.seed {
            let _ = writeln!(out, "seed = {}", self.seed);
        }
        if self.auto_blink != usual.auto_blink {
            let _ = writeln!(out, "auto_blink = {}", self.auto_blink);
        }
        if !self.pins.is_empty() {
            let _ = writeln!(out, "pins = {:?}", self.pins);
        }
        if self.guessed {
            out.push_str("guessed = true\n");
        }
        if let Some(checksum) = &self.aligned {
            let _ = writeln!(out, "aligned = \"{checksum}\"");
        }
        if let Some(checksum) = &self.tracked {
            let _ = writeln!(out, "tracked = \"{checksum}\"");
        }
        for key in self.sorted_keys() {
            let _ = write!(out, "\n[[key]]\ntrack = \"{}\"\ntime = {}\n", name_of(key.value.track()), Float(key.time));
            let _ = writeln!(out, "value = {}", value_text(&key.value));
            if key.ease != Ease::Smooth {
                let _ = writeln!(out, "ease = \"{}\"", if key.ease == Ease::Hold { "hold" } else { "linear" });
            }
            if key.ends {
                out.push_str("ends = true\n");
            }
            if let Some(time) = key.replaces {
                let _ = writeln!(out, "replaces = {}", Float(time));
            }
        }
        for range in &self.ranges {
            let _ = write!(out, "\n[[range]]\nfrom = {}\nto = {}\n", Float(range.from), Float(range.to));
            for (name, list, usual) in [("scale", range.scale, 1.0), ("offset", range.offset, 0.0)] {
                if list[1..].iter().any(|v| *v != usual) {
                    let _ = writeln!(out, "{name} = {}", table(&list, usual));
                }
            }
            if range.smooth > 0.0 {
                let _ = writeln!(out, "smooth = {}", Float(range.smooth));
            }
        }
        for marker in &self.markers {
            let text = toml::Value::String(marker.text.clone());
            let _ = write!(out, "\n[[marker]]\ntime = {}\ntext = {text}\n", Float(marker.time));
        }
        out
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default = "one")]
    seed: u64,
    #[serde(default = "yes")]
    auto_blink: bool,
    #[serde(default)]
    pins: Vec<usize>,
    #[serde(default)]
    guessed: bool,
    #[serde(default)]
    aligned: Option<String>,
    #[serde(default)]
    tracked: Option<String>,
    #[serde(default, rename = "key")]
    keys: Vec<toml::Spanned<FileKey>>,
    #[serde(default, rename = "range")]
    ranges: Vec<toml::Spanned<FileRange>>,
    #[serde(default, rename = "marker")]
    markers: Vec<toml::Spanned<Marker>>,
}

fn one() -> u64 {
    1
}

fn yes() -> bool {
    true
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileKey {
    track: Track,
    time: f64,
    #[serde(default)]
    value: Option<toml::Value>,
    #[serde(default)]
    ease: Ease,
    #[serde(default)]
    ends: bool,
    replaces: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileRange {
    from: f64,
    to: f64,
    #[serde(default)]
    scale: toml::Table,
    #[serde(default)]
    offset: toml::Table,
    #[serde(default)]
    smooth: f64,
}

impl FileKey {
    fn read(self) -> Result<Key> {
        checked_time(self.time, "time")?;
        let value = match (self.track, &self.value) {
            (Track::Emotion, Some(toml::Value::Table(table))) => {
                let ratios = Ratios(by_emotion(table, "value", 0.0)?);
                let given = table.contains_key("neutral");
                if given && (ratios.sum() - 1.0).abs() > 1e-6 {
                    return Err(Fault::of(FileFault::Mismatch, format!("the seven ratios sum to {}", ratios.sum()))
                        .help("they must sum to 1; leave `neutral` out and it is made up"));
                }
                KeyValue::Emotion(if given { ratios } else { ratios.closed() })
            }
            (Track::Mouth, Some(toml::Value::String(s))) if s == "rest" => KeyValue::Mouth(None),
            (Track::Mouth, Some(toml::Value::String(s))) => {
                KeyValue::Mouth(Some(s.parse().map_err(|e: String| Fault::new(e).help("or write `rest`"))?))
            }
            (Track::Blink, None) => KeyValue::Blink(BLINK_SECONDS),
            (Track::Blink, Some(v)) => match number(v) {
                Some(length) if (0.05..=5.0).contains(&length) => KeyValue::Blink(length),
                _ => return Err(wrong(v, "a blink's length in seconds, 0.05 to 5")),
            },
            (Track::Gaze, Some(v)) => {
                let [x, y] = numbers(v, [10.0; 2]).ok_or_else(|| wrong(v, "[x, y] in eye heights, each at most 10"))?;
                KeyValue::Gaze(Gaze { x, y })
            }
            (Track::Head, Some(v)) => {
                let [x, y, roll] = numbers(v, [10.0, 10.0, 180.0]).ok_or_else(|| {
                    wrong(v, "[x, y, roll] in pupil distances, each at most 10, and degrees, at most 180")
                })?;
                KeyValue::Head(Head { x, y, roll })
            }
            (track, Some(v)) => {
                let wanted = match track {
                    Track::Emotion => "a table such as { happy = 0.6, neutral = 0.4 }",
                    _ => "one of \"m\" \"f\" \"h\" \"a\" \"i\" \"u\" \"e\" \"o\" \"n\" \"rest\"",
                };
                return Err(wrong(v, wanted));
            }
            (_, None) => {
                return Err(Fault::of(FileFault::Missing, "a key has no `value`").help("give what holds at its time"));
            }
        };
        if let Some(time) = self.replaces {
            checked_time(time, "replaces")?;
        }
        for (given, name, track) in
            [(self.ends, "ends", Track::Emotion), (self.replaces.is_some(), "replaces", Track::Mouth)]
        {
            if given && self.track != track {
                return Err(Fault::new(format!("`{name}` is given on the track `{}`", name_of(self.track)))
                    .help(format!("only keys of the track `{}` can have it", name_of(track))));
            }
        }
        Ok(Key { time: self.time, value, ease: self.ease, ends: self.ends, replaces: self.replaces })
    }
}

impl FileRange {
    fn read(self) -> Result<Range> {
        checked_time(self.from, "from")?;
        checked_time(self.to, "to")?;
        if self.to <= self.from {
            return Err(Fault::of(FileFault::OutOfRange, format!("a range runs from {} to {}", self.from, self.to))
                .help("end it after its start"));
        }
        if !(0.0..=10.0).contains(&self.smooth) {
            return Err(Fault::of(FileFault::OutOfRange, format!("`smooth` is {}", self.smooth))
                .help("give seconds from 0 to 10"));
        }
        if self.scale.contains_key("neutral") || self.offset.contains_key("neutral") {
            return Err(Fault::new("a range edit cannot change `neutral`")
                .help("change the six others; neutral takes up what they gain or lose"));
        }
        let scale = by_emotion(&self.scale, "scale", 1.0)?;
        let offset = by_emotion(&self.offset, "offset", 0.0)?;
        Ok(Range { from: self.from, to: self.to, scale, offset, smooth: self.smooth })
    }
}

fn wrong(found: &toml::Value, wanted: &str) -> Fault {
    Fault::of(FileFault::OutOfRange, format!("`value` is {found}")).help(format!("give {wanted}"))
}

fn checked_time(time: f64, what: &str) -> Result<()> {
    if time.is_finite() && (0.0..=86_400.0).contains(&time) {
        Ok(())
    } else {
        Err(Fault::of(FileFault::OutOfRange, format!("`{what}` is {time}")).help("give seconds from 0 to 86400"))
    }
}

fn number(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|i| i as f64)).filter(|v| v.is_finite())
}

/// Numbers, none farther from 0 than its limit.
fn numbers<const N: usize>(value: &toml::Value, limits: [f64; N]) -> Option<[f64; N]> {
    let list = value.as_array().filter(|l| l.len() == N)?;
    let mut out = [0.0; N];
    for ((slot, v), limit) in out.iter_mut().zip(list).zip(limits) {
        *slot = number(v).filter(|v| v.abs() <= limit)?;
    }
    Some(out)
}

fn by_emotion(table: &toml::Table, what: &str, usual: f64) -> Result<[f64; 7]> {
    let mut out = [usual; 7];
    for (name, value) in table {
        let emotion: Emotion = name.parse().map_err(|e: String| {
            let known: Vec<&str> = Emotion::ALL.iter().map(|e| e.name()).collect();
            Fault::new(format!("{e} (in `{what}`)")).help(crate::disk::suggestion(name, "known", &known))
        })?;
        out[emotion.index()] = number(value).filter(|v| v.abs() <= 100.0).ok_or_else(|| {
            Fault::of(FileFault::OutOfRange, format!("`{name}` in `{what}` is {value}"))
                .help("give a number from −100 to 100")
        })?;
    }
    Ok(out)
}

fn name_of(track: Track) -> &'static str {
    match track {
        Track::Emotion => "emotion",
        Track::Mouth => "mouth",
        Track::Blink => "blink",
        Track::Gaze => "gaze",
        Track::Head => "head",
    }
}

fn value_text(value: &KeyValue) -> String {
    match value {
        KeyValue::Emotion(ratios) => {
            let mut list = ratios.0;
            // Neutral is made up when it is left out, so a pure table needs none.
            list[0] = 0.0;
            if list.iter().all(|v| *v == 0.0) { "{ neutral = 1.0 }".into() } else { table(&list, 0.0) }
        }
        KeyValue::Mouth(None) => "\"rest\"".into(),
        KeyValue::Mouth(Some(shape)) => format!("\"{shape}\""),
        KeyValue::Blink(length) => Float(*length).to_string(),
        KeyValue::Gaze(g) => format!("[{}, {}]", Float(g.x), Float(g.y)),
        KeyValue::Head(h) => format!("[{}, {}, {}]", Float(h.x), Float(h.y), Float(h.roll)),
    }
}

fn table(list: &[f64; 7], usual: f64) -> String {
    let cells: Vec<String> = Emotion::ALL[1..]
        .iter()
        .filter(|e| list[e.index()] != usual)
        .map(|e| format!("{e} = {}", Float(list[e.index()])))
        .collect();
    format!("{{ {} }}", cells.join(", "))
}

/// A number as TOML writes floats: with a point, and no digits beyond a microsecond.
struct Float(f64);

impl std::fmt::Display for Float {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}", (self.0 * 1e6).round() / 1e6)
    }
}
