//! A ratio record as it arrives, in any of its forms: compact, CSV or JSON.

use std::io::{BufRead, BufReader, Cursor, Read};

use super::lpr::LPR_FIRST;
use super::{LprReader, Moment, Record};
use crate::disk::{Fault, FileFault, Result};

/// A line of CSV, or a frame of JSON, has at most so many bytes.
const LONGEST: usize = 64 << 10;

/// What is left of an input of which the beginning was looked at.
type Rest<R> = std::io::Chain<Cursor<Vec<u8>>, R>;

/// Reads frames from a pipe one by one, as soon as each has arrived whole. Which form they have, the first bytes tell.
#[derive(Debug)]
pub struct RecordReader<R: Read> {
    form: Form<R>,
    last: Option<(u32, f64)>,
}

#[derive(Debug)]
enum Form<R: Read> {
    Lpr(Box<LprReader<Rest<R>>>),
    Csv { input: BufReader<Rest<R>>, header: String, line: usize },
    Json { input: BufReader<Rest<R>>, entry: usize, is_array: bool },
    Over,
}

impl<R: Read> RecordReader<R> {
    /// Waits for the first bytes and looks at them.
    ///
    /// # Errors
    /// When nothing comes, it cannot be read, or the head of a compact record or of a table is wrong.
    pub fn new(mut input: R) -> Result<Self> {
        let mut start = Vec::new();
        let first = loop {
            let mut byte = [0];
            match input.read(&mut byte) {
                Ok(0) => {
                    return Err(Fault::of(FileFault::Empty, "no record came")
                        .help("pipe ratios.csv, its JSON or a compact record into it"));
                }
                Ok(_) => start.push(byte[0]),
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                Err(error) => return Err(cannot(error)),
            }
            // Blanks and a byte order mark tell nothing; nobody writes many of them.
            if !byte[0].is_ascii_whitespace() && !b"\xEF\xBB\xBF".contains(&byte[0]) || start.len() > 4096 {
                break byte[0];
            }
        };
        let rest = Cursor::new(start).chain(input);
        let form = match first {
            LPR_FIRST => Form::Lpr(Box::new(LprReader::new(rest)?)),
            b'[' | b'{' => Form::Json { input: BufReader::new(rest), entry: 0, is_array: first == b'[' },
            _ => {
                let mut form = Form::Csv { input: BufReader::new(rest), header: String::new(), line: 0 };
                if let Form::Csv { input, header, line } = &mut form {
                    *header = line_of(input, line)?.unwrap_or_default();
                    // Only the heading can be wrong here: there is no row yet.
                    if let Err(fault) = Record::parse(header)
                        && !header.is_empty()
                        && fault.line_number().is_some()
                    {
                        return Err(fault);
                    }
                }
                form
            }
        };
        Ok(Self { form, last: None })
    }

    /// The next frame, waited for; none at the end, and after a fault.
    ///
    /// # Errors
    /// When the record is cut, damaged or wrong from here on, with where.
    pub fn next_moment(&mut self) -> Result<Option<Moment>> {
        let next = self.form.next().and_then(|moment| self.in_order(moment));
        if !matches!(next, Ok(Some(_))) {
            self.form = Form::Over;
        }
        next
    }

    fn in_order(&mut self, moment: Option<Moment>) -> Result<Option<Moment>> {
        let Some(moment) = moment else { return Ok(None) };
        let (frame, time) = (moment.row.frame, moment.row.time);
        if self.last.is_some_and(|(f, t)| frame <= f || time <= t) {
            return Err(Fault::new(format!("frame {frame} at {time} s does not come after the one before it"))
                .help("frames and times must rise"));
        }
        self.last = Some((frame, time));
        Ok(Some(moment))
    }
}

impl<R: Read> Form<R> {
    fn next(&mut self) -> Result<Option<Moment>> {
        match self {
            Self::Lpr(reader) => reader.next_moment(),
            Self::Csv { input, header, line } => {
                let Some(row) = line_of(input, line)? else { return Ok(None) };
                let record =
                    Record::parse(&format!("{header}\n{row}")).map_err(|f| placed(f, &format!("line {line}")))?;
                Ok(record.rows.first().map(|row| Moment { row: *row, track: None }))
            }
            Self::Json { input, entry, is_array } => {
                *entry += 1;
                let Some(object) = object_of(input, *is_array)? else { return Ok(None) };
                let record = Record::parse_json(&format!("[{object}]"))
                    .map_err(|f| placed(f, &format!("frame {entry} of the array")))?;
                Ok(record.rows.first().map(|row| Moment { row: *row, track: None }))
            }
            Self::Over => Ok(None),
        }
    }
}

/// A fault of a part read by itself, with its place in the whole.
fn placed(fault: Fault, place: &str) -> Fault {
    let what = fault.what().trim_start_matches("entry 1: ").to_owned();
    fault.rephrased(what).in_part(place)
}

/// The next line that is not empty, and its number.
fn line_of(input: &mut impl BufRead, number: &mut usize) -> Result<Option<String>> {
    loop {
        let mut bytes = Vec::new();
        Read::by_ref(input).take(LONGEST as u64).read_until(b'\n', &mut bytes).map_err(cannot)?;
        if bytes.is_empty() {
            return Ok(None);
        }
        *number += 1;
        if bytes.len() >= LONGEST {
            return Err(Fault::of(FileFault::CutOff, format!("line {number} has no end")).help("is it a ratio record?"));
        }
        let text = crate::disk::clean(&String::from_utf8_lossy(&bytes));
        if !text.trim().is_empty() {
            return Ok(Some(text.trim_end().to_owned()));
        }
    }
}

/// The next object of a JSON array, or of objects one after another, as text; none at the end.
fn object_of(input: &mut impl BufRead, is_array: bool) -> Result<Option<String>> {
    let (mut bytes, mut deep, mut quoted, mut escaped) = (Vec::new(), 0_u32, false, false);
    let mut byte = [0];
    loop {
        match input.read(&mut byte) {
            Ok(0) if bytes.is_empty() && !is_array => return Ok(None),
            Ok(0) if bytes.is_empty() => return Err(Fault::of(FileFault::CutOff, "the array of frames is cut off")),
            Ok(0) => return Err(Fault::of(FileFault::CutOff, "the last frame is cut off")),
            Ok(_) => {}
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(cannot(error)),
        }
        if deep == 0 && byte[0] == b']' {
            return Ok(None);
        }
        if deep > 0 || byte[0] == b'{' {
            bytes.push(byte[0]);
        }
        match byte[0] {
            _ if escaped => escaped = false,
            b'\\' if quoted => escaped = true,
            b'"' => quoted = !quoted,
            b'{' if !quoted => deep += 1,
            b'}' if !quoted && deep > 0 => {
                deep -= 1;
                if deep == 0 {
                    return Ok(Some(String::from_utf8_lossy(&bytes).into_owned()));
                }
            }
            _ => {}
        }
        if bytes.len() > LONGEST {
            return Err(Fault::of(FileFault::CutOff, "a frame of the array has no end").help("is it a ratio record?"));
        }
    }
}

fn cannot(error: std::io::Error) -> Fault {
    Fault::io("cannot read the record", "the record", error)
}
