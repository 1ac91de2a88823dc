//! Reading a TextGrid. The counts it gives are not believed: intervals are read as long as there are any, and a count
//! only serves to notice that some are gone.

use super::super::Timing;
use super::super::layer::{Layer, checked};
use super::tokens::{Kind, Token, tokens};
use crate::disk::{Fault, FileFault, Result};

/// The words that say which value follows, in the long form.
const KEYS: [&str; 9] = ["xmin", "xmax", "size", "class", "name", "text", "number", "time", "mark"];

/// Reads the long or short form.
///
/// # Errors
/// With the line and what was found there.
pub(super) fn parse(reader: &mut Reader) -> Result<Timing> {
    reader.header()?;
    let end = reader.span("the file")?;
    let mut timing = Timing { duration: end, ..Timing::default() };
    let (exists, line) = reader.value(&[], "`<exists>`")?;
    match exists {
        Kind::Flag(flag) if flag == "<exists>" => {}
        Kind::Flag(flag) if flag == "<absent>" => return Ok(timing),
        found => return Err(unexpected(&found, "`<exists>`", line)),
    }
    let said = reader.count("the number of tiers")?;
    let mut there = 0_usize;
    while reader.next_value().is_some() {
        reader.tier(&mut timing)?;
        there += 1;
    }
    reader.nothing_left()?;
    enough(there, said, "tiers", "the file")?;
    Ok(timing)
}

/// A tier whose last interval ends this near to its own end, in seconds, has all its intervals.
const WHOLE: f64 = 1e-3;

pub(super) struct Reader {
    tokens: Vec<Token>,
    at: usize,
    /// In the short form there are no words, so any word is a fault.
    short: bool,
    last_line: usize,
}

impl Reader {
    /// Cuts cleaned text into its values; `short` where no words stand between them.
    pub(super) fn new(text: &str, short: bool) -> Result<Self> {
        Ok(Self { tokens: tokens(text)?, at: 0, short, last_line: text.lines().count().max(1) })
    }

    fn header(&mut self) -> Result<()> {
        let help = "a TextGrid begins with `File type = \"ooTextFile\"` and `Object class = \"TextGrid\"`";
        for (begins, what) in [("ooTextFile", "the file's type"), ("TextGrid", "the object's class")] {
            let (text, line) = self.text(&["class"], what).map_err(|fault| fault.help(help))?;
            if !text.starts_with(begins) {
                return Err(Fault::new(format!("{what} is `{text}`, not `{begins}`")).line(line).help(help));
            }
        }
        self.short = matches!(self.tokens.get(self.at), Some(Token { kind: Kind::Number(_), .. }));
        Ok(())
    }

    /// What kind of tier follows: whether it is one of points.
    pub(super) fn class(&mut self) -> Result<bool> {
        let (class, line) = self.text(&["class"], "a tier's class")?;
        match class.as_str() {
            "IntervalTier" => Ok(false),
            "TextTier" => Ok(true),
            _ => Err(Fault::new(format!("found `{class}` where a tier's class is expected"))
                .line(line)
                .help("`IntervalTier` and `TextTier` are the two there are")),
        }
    }

    fn tier(&mut self, timing: &mut Timing) -> Result<()> {
        let points = self.class()?;
        let (name, _) = self.text(&["name"], "the tier's name")?;
        let end = self.span(&format!("tier `{name}`"))?;
        let said = self.count(&format!("the number of intervals of tier `{name}`"))?;
        let mut layer = Layer::new(&name);
        let mut there = 0_usize;
        while let Some(Kind::Number(_)) = self.next_value() {
            there += 1;
            let of = format!("of interval {there} of tier `{name}`");
            let (start, end, line) = if points {
                let (time, line) =
                    self.number(&["number", "time"], &format!("the time of point {there} of tier `{name}`"))?;
                (time, time, line)
            } else {
                let (start, line) = self.number(&["xmin"], &format!("the start {of}"))?;
                (start, self.number(&["xmax"], &format!("the end {of}"))?.0, line)
            };
            let (label, _) = self.text(&["text", "mark"], &format!("the label {of}, in quotes"))?;
            layer.lay(start, end, &label).map_err(|fault| fault.line(line))?;
        }
        let (tier, until) = layer.done();
        // What reaches to its end is whole, whatever it says of itself.
        if points || until < end - WHOLE {
            enough(there, said, if points { "points" } else { "intervals" }, &format!("tier `{name}`"))?;
        }
        timing.duration = timing.duration.max(end);
        if !(points && tier.intervals.is_empty()) {
            timing.add_read(tier, until)?;
        }
        Ok(())
    }

    /// How many there are to be, and the line that says it; nothing where the long form leaves it out.
    fn count(&mut self, what: &str) -> Result<Option<(f64, usize)>> {
        let announced = self.tokens[self.at..].windows(2).map_while(|pair| match &pair[0].kind {
            kind if kind.is_value() => None,
            Kind::Word(word) if pair[1].kind == Kind::Assign => Some(Some(word.as_str())),
            _ => Some(None),
        });
        let next = announced.flatten().next();
        if next.is_some_and(|word| word != "size" && KEYS.contains(&word)) {
            return Ok(None);
        }
        self.number(&["size"], what).map(Some)
    }

    /// `xmin` and `xmax` of the file or a tier: its end.
    pub(super) fn span(&mut self, of: &str) -> Result<f64> {
        let (start, line) = self.number(&["xmin"], &format!("the start of {of}"))?;
        let (end, end_line) = self.number(&["xmax"], &format!("the end of {of}"))?;
        checked(start).map_err(|fault| fault.line(line))?;
        checked(end).map_err(|fault| fault.line(end_line))?;
        if start > end {
            return Err(Fault::new(format!("{of} starts at {start} and ends before that, at {end}"))
                .line(line)
                .help("xmin must not lie behind xmax"));
        }
        Ok(end)
    }

    /// The value that comes next, without taking it.
    pub(super) fn next_value(&self) -> Option<&Kind> {
        self.tokens[self.at..].iter().map(|t| &t.kind).find(|kind| kind.is_value())
    }

    /// Takes the next value. `keys` are the words that may announce it in the long form.
    fn value(&mut self, keys: &[&str], what: &str) -> Result<(Kind, usize)> {
        let mut due = false;
        while let Some(Token { kind, line }) = self.tokens.get(self.at).cloned() {
            self.at += 1;
            match &kind {
                Kind::Assign => due = true,
                Kind::Word(word) => {
                    let announces = matches!(self.tokens.get(self.at), Some(Token { kind: Kind::Assign, .. }));
                    let of_another = announces && KEYS.contains(&word.as_str()) && !keys.contains(&word.as_str());
                    if self.short || due || of_another {
                        return Err(unexpected(&kind, what, line));
                    }
                }
                _ => return Ok((kind, line)),
            }
        }
        Err(Fault::of(FileFault::CutOff, format!("the file ends where {what} is expected"))
            .line(self.last_line)
            .help("was it cut off? take it from its source again"))
    }

    pub(super) fn number(&mut self, keys: &[&str], what: &str) -> Result<(f64, usize)> {
        match self.value(keys, what)? {
            (Kind::Number(number), line) => Ok((number, line)),
            (found, line) => Err(unexpected(&found, what, line)),
        }
    }

    pub(super) fn text(&mut self, keys: &[&str], what: &str) -> Result<(String, usize)> {
        match self.value(keys, what)? {
            (Kind::Text(text), line) => Ok((text, line)),
            (found, line) => Err(unexpected(&found, what, line)),
        }
    }

    /// After the last value only words of the long form may stand, and none that announces another.
    pub(super) fn nothing_left(&self) -> Result<()> {
        let left = &self.tokens[self.at..];
        match left.iter().find(|t| self.short || t.kind == Kind::Assign) {
            Some(token) => Err(unexpected(&token.kind, "the end of the file or another tier", token.line)),
            None => Ok(()),
        }
    }
}

fn unexpected(found: &Kind, what: &str, line: usize) -> Fault {
    Fault::new(format!("found {} where {what} is expected", found.shown()))
        .line(line)
        .help("texts stand in double quotes, numbers alone; is something missing just before it?")
}

/// Notices that there are fewer than the file says. More are fine: somebody added one and let the count be.
fn enough(there: usize, said: Option<(f64, usize)>, what: &str, of: &str) -> Result<()> {
    match said {
        Some((said, line)) if (there as f64) < said => {
            Err(Fault::of(FileFault::Mismatch, format!("{of} says that it has {said} {what}, and {there} are there"))
                .line(line)
                .help(format!("was the file cut off? if nothing is missing, write {there} here")))
        }
        _ => Ok(()),
    }
}
