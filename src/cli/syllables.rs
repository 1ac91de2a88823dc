//! `lianpu syllables`: a script as a table of syllables and mouth shapes.

use std::io::{self, IsTerminal, Read, Write};

use serde::Serialize;

use super::output_fault;
use super::print::say;
use crate::disk::{self, Fault, Result};
use crate::script::{self, Lang, Syllable, System};

/// Print the syllables of a text: character, Pinyin, Zhuyin, mouth shapes.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The text; `-` or nothing reads standard input.
    #[arg(allow_hyphen_values = true)]
    text: Option<String>,
    /// What it is written in: auto, han, hanyu, zhuyin, tongyong or english.
    #[arg(long, value_name = "SYSTEM", default_value_t = System::Auto)]
    from: System,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// An entry as machines read it.
#[derive(Serialize)]
struct Entry<'a> {
    text: &'a str,
    pinyin: &'a str,
    zhuyin: &'a str,
    shapes: Vec<String>,
    lang: Lang,
}

/// Prints one line a syllable, or one list of entries.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    let text = match args.text.as_deref() {
        Some(text) if text != "-" => disk::clean(text),
        given => disk::clean(&standard_input(given.is_some())?),
    };
    let said = script::syllables(&text, args.from)?;
    if args.json {
        return write_json(&said, out).map_err(output_fault);
    }
    said.iter()
        .try_for_each(|s| say(out, format_args!("{}\t{}\t{}\t{}", s.text, s.pinyin, s.zhuyin, shapes(s).join(" "))))
}

fn shapes(syllable: &Syllable) -> Vec<String> {
    syllable.shapes.iter().map(ToString::to_string).collect()
}

fn write_json(said: &[Syllable], out: &mut dyn Write) -> io::Result<()> {
    let entries: Vec<Entry> = said
        .iter()
        .map(|s| Entry { text: &s.text, pinyin: &s.pinyin, zhuyin: &s.zhuyin, shapes: shapes(s), lang: s.lang })
        .collect();
    serde_json::to_writer(&mut *out, &entries)?;
    writeln!(out)
}

/// What comes in on standard input. A person at a terminal who gave no text is told how to give one.
fn standard_input(asked_for: bool) -> Result<String> {
    let mut input = io::stdin().lock();
    if !asked_for && input.is_terminal() {
        return Err(Fault::new("there is no text to read")
            .help("give it as `lianpu syllables 您好`, or pipe it in; see `lianpu syllables --help`")
            .of_the_call());
    }
    let mut bytes = Vec::new();
    let limit = disk::MAX_TEXT_BYTES;
    (&mut input)
        .take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(|e| Fault::io("cannot read it", "standard input", e))?;
    if bytes.len() as u64 > limit {
        return Err(Fault::new(format!("the text is larger than {} MB", limit >> 20)).at("standard input"));
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(text.to_owned()),
        Err(error) => {
            let line = 1 + bytes[..error.valid_up_to()].iter().filter(|b| **b == b'\n').count();
            Err(Fault::new("the text is not UTF-8").at("standard input").line(line).help("convert it to UTF-8"))
        }
    }
}
