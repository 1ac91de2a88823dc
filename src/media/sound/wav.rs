//! WAV files, read byte by byte: the lengths that headers give are not believed, a recording that was cut off is used
//! as far as it goes, and chunks of odd length do not lead astray.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};

use super::mix::Mixer;
use super::raw::{Raw, broken};
use super::wav_form::Form;
use crate::disk::{Fault, FileFault, Result};

/// Lengths from here on are not lengths: programs that write to a pipe, or crash, leave such numbers behind.
const UNFINISHED: u64 = 0x7FFF_0000;

/// Reads a file; faults come without its path. Nothing where its samples are compressed in a way that is not read here.
pub(super) fn read(file: &mut File, bytes: u64, only: Option<usize>) -> Result<Option<Raw>> {
    let chunks = Chunks::find(file, bytes).map_err(broken)?;
    let Some(form) = Form::of(&chunks.form)? else { return Ok(None) };
    let Some((start, said)) = chunks.data else {
        return Err(Fault::of(FileFault::Empty, "there is no sound in the file")
            .help("was it cut off? record or save it again"));
    };
    let there = bytes.saturating_sub(start);
    let mut warnings = Vec::new();
    let frame = form.frame();
    let per_second = (frame * u64::from(form.rate)) as f64;
    // 0 is what a recorder writes before it knows better; find() has made sure that nothing else follows.
    let used = if said > there || (said == 0 && there > 0) {
        let have = there as f64 / per_second;
        warnings.push(if said == 0 || said >= UNFINISHED {
            format!("the file does not say how long it is; all {have:.2} s that are there are used")
        } else {
            format!("the file was cut off: {have:.2} s of {:.2} s are there and used", said as f64 / per_second)
        });
        there
    } else {
        said
    };
    let frames = used / frame;
    if frames == 0 {
        return Err(Fault::of(FileFault::Empty, "there is no sound in the file")
            .help("its part for samples is empty: record it again"));
    }
    super::raw::short_enough(frames, form.rate)?;
    file.seek(SeekFrom::Start(start)).map_err(broken)?;
    let mut mixer = Mixer::new(usize::from(form.channels), only, frames as usize);
    form.samples(BufReader::with_capacity(1 << 16, file).take(frames * frame), |sample| mixer.push(sample))
        .map_err(broken)?;
    let mixed = mixer.done();
    if mixed.highest > 1.0 {
        warnings.push(format!("samples reach {:.3} where 1 is full; all are made smaller to fit", mixed.highest));
    }
    Ok(Some(Raw { rate: form.rate, mixed, warnings }))
}

/// What lies where in a file.
#[derive(Default)]
struct Chunks {
    /// The beginning of `fmt `, at most 40 bytes.
    form: Vec<u8>,
    /// Where the samples begin, and how many bytes of them the file says there are.
    data: Option<(u64, u64)>,
}

impl Chunks {
    fn find(file: &mut File, bytes: u64) -> std::io::Result<Self> {
        let mut chunks = Self::default();
        // What RF64 and BW64 say instead of a length that does not fit into 32 bits.
        let mut long = None;
        let mut at = 12;
        while chunks.data.is_none() {
            let Some((name, length)) = chunk_at(file, at)? else { break };
            match &name {
                b"fmt " => {
                    chunks.form = vec![0; length.min(40) as usize];
                    let got = read_up_to(file, &mut chunks.form)?;
                    chunks.form.truncate(got);
                }
                b"ds64" => {
                    let mut lengths = [0; 16];
                    if read_up_to(file, &mut lengths)? == 16 {
                        let [_, _, _, _, _, _, _, _, data @ ..] = lengths;
                        long = Some(u64::from_le_bytes(data)).filter(|length| *length > 0);
                    }
                }
                // An empty part for samples is one only where the file goes on in good order behind it.
                b"data" if length > 0 || !in_order(file, at + 8, bytes)? => {
                    let unknown = length == u64::from(u32::MAX);
                    chunks.data = Some((at + 8, long.filter(|_| unknown).unwrap_or(length)));
                }
                _ => {}
            }
            // Parts begin at even places.
            at = at + 8 + length + (length & 1);
        }
        Ok(chunks)
    }
}

/// Whether whole chunks with names of letters follow each other from `at` to the end of the file, at least one.
fn in_order(file: &mut File, mut at: u64, bytes: u64) -> std::io::Result<bool> {
    let began = at;
    while at + 8 <= bytes {
        match chunk_at(file, at)? {
            Some((name, length)) if name.iter().all(|b| (b' '..=b'~').contains(b)) => at += 8 + length + (length & 1),
            _ => return Ok(false),
        }
    }
    // The byte that makes the last one even may be missing.
    Ok(at > began && (at == bytes || at == bytes + 1))
}

/// The name and length of the chunk at a place; nothing at the end of the file.
fn chunk_at(file: &mut File, at: u64) -> std::io::Result<Option<([u8; 4], u64)>> {
    file.seek(SeekFrom::Start(at))?;
    let mut head = [0; 8];
    if read_up_to(file, &mut head)? < 8 {
        return Ok(None);
    }
    let [a, b, c, d, length @ ..] = head;
    Ok(Some(([a, b, c, d], u64::from(u32::from_le_bytes(length)))))
}

fn read_up_to(file: &mut File, buffer: &mut [u8]) -> std::io::Result<usize> {
    let mut got = 0;
    while got < buffer.len() {
        match file.read(&mut buffer[got..])? {
            0 => break,
            more => got += more,
        }
    }
    Ok(got)
}
