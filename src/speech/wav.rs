//! WAV files. hound turns bytes into samples; the way to them through the file is our own, because hound believes the
//! lengths that headers give, stops at a recording that was cut off, and loses its way after a chunk of odd length.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use hound::{SampleFormat, WavReader};

use super::Sound;
use crate::disk::{Fault, Result};

/// The largest file that is read. Its samples lie in memory.
const MAX_BYTES: u64 = 2 << 30;

/// The longest recording that is read, in seconds: 4 hours.
const MAX_SECONDS: u64 = 4 * 3600;

/// Lengths from here on are not lengths: programs that write to a pipe, or crash, leave such numbers behind.
const UNFINISHED: u64 = 0x7FFF_0000;

/// Samples a second that are read: from the poorest telephone to the finest studio. Others are damaged headers.
const RATES: std::ops::RangeInclusive<u32> = 1_000..=768_000;

const CONVERT: &str = "save it as WAV, 16 bits, and try again";

/// Reads a file; faults come without its path.
pub(super) fn read(path: &Path) -> Result<Sound> {
    let broken = |error| Fault::io("cannot read it", path, error);
    let mut file = File::open(path).map_err(|error| Fault::io("cannot open it", path, error))?;
    let bytes = file.metadata().map_err(broken)?.len();
    if bytes > MAX_BYTES {
        return Err(Fault::new("the file is larger than 2 GB").help("cut the recording into clips"));
    }
    let chunks = Chunks::find(&mut file, bytes).map_err(broken)?;
    let Chunks { wave: true, .. } = chunks else {
        return Err(Fault::new("it is no WAV file").help(CONVERT));
    };
    let form = Form::of(&chunks.form)?;
    let Some((start, said)) = chunks.data else {
        return Err(Fault::new("there is no sound in the file").help("was it cut off? record or save it again"));
    };
    let there = bytes.saturating_sub(start);
    let mut warnings = Vec::new();
    let frame = u64::from(form.container) * u64::from(form.channels);
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
        return Err(Fault::new("there is no sound in the file").help("its part for samples is empty: record it again"));
    }
    if frames > MAX_SECONDS * u64::from(form.rate) {
        return Err(Fault::new("the recording is longer than 4 hours").help("cut it into clips"));
    }
    file.seek(SeekFrom::Start(start)).map_err(broken)?;
    let header = form.header((frames * frame) as u32);
    let samples = form.mix(header.chain(BufReader::with_capacity(1 << 16, file)), frames as usize, &mut warnings)?;
    let mut sound = Sound::new(form.rate, samples);
    (sound.channels, sound.warnings) = (form.channels, warnings);
    Ok(sound)
}

/// What lies where in a file.
#[derive(Default)]
struct Chunks {
    wave: bool,
    /// The beginning of `fmt `, at most 40 bytes.
    form: Vec<u8>,
    /// Where the samples begin, and how many bytes of them the file says there are.
    data: Option<(u64, u64)>,
}

impl Chunks {
    fn find(file: &mut File, bytes: u64) -> std::io::Result<Self> {
        let mut chunks = Self::default();
        let mut head = [0; 12];
        let got = read_up_to(file, &mut head)?;
        chunks.wave = got == 12 && matches!(&head[..4], b"RIFF" | b"RF64") && &head[8..] == b"WAVE";
        let mut at = 12;
        while chunks.wave && chunks.data.is_none() {
            let Some((name, length)) = chunk_at(file, at)? else { break };
            match &name {
                b"fmt " => {
                    chunks.form = vec![0; length.min(40) as usize];
                    let got = read_up_to(file, &mut chunks.form)?;
                    chunks.form.truncate(got);
                }
                // An empty part for samples is one only where the file goes on in good order behind it.
                b"data" if length > 0 || !in_order(file, at + 8, bytes)? => chunks.data = Some((at + 8, length)),
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

/// How samples are written.
struct Form {
    float: bool,
    channels: u16,
    rate: u32,
    /// Bytes of one sample. Fewer valid bits stand at its upper end, so that they need not be known.
    container: u16,
}

impl Form {
    fn of(bytes: &[u8]) -> Result<Self> {
        let number = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
        if bytes.len() < 16 {
            return Err(Fault::new("the file does not say how its samples are written")
                .help("was it cut off? record or save it again"));
        }
        // 0xFFFE: the real tag begins the GUID further on.
        let tag = if number(0) == 0xFFFE && bytes.len() >= 26 { number(24) } else { number(0) };
        let (channels, bits, align) = (number(2), number(14), number(12));
        let rate = u32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]]);
        if channels == 0 || !RATES.contains(&rate) {
            let what = if channels == 0 { "0 channels".to_owned() } else { format!("{rate} samples a second") };
            return Err(Fault::new(format!("the file says that it has {what}")).help(CONVERT));
        }
        let container = if align >= channels && align % channels == 0 { align / channels } else { bits.div_ceil(8) };
        let float = tag == 3;
        // What is written for one frame is a number of 16 bits, in the file as in the header made for hound.
        if container.checked_mul(channels).is_none() {
            return Err(Fault::new(format!("the file says that it has {channels} channels")).help(CONVERT));
        }
        let known = match tag {
            1 => (1..=4).contains(&container) && (1..=container * 8).contains(&bits),
            3 => container == 4,
            _ => false,
        };
        if known {
            return Ok(Self { float, channels, rate, container });
        }
        let what = match tag {
            1 => format!("whole numbers of {bits} bits"),
            3 => format!("floating point of {bits} bits"),
            2 | 0x11 => "compressed as ADPCM".to_owned(),
            6 => "compressed as A-law".to_owned(),
            7 => "compressed as µ-law".to_owned(),
            0x55 => "compressed as MP3".to_owned(),
            other => format!("of the kind {other:#06x}"),
        };
        Err(Fault::new(format!("the samples are {what}, which is not read")).help(CONVERT))
    }

    /// The plainest header that says this form and `data` bytes of samples, for hound.
    fn header(&self, data: u32) -> std::io::Cursor<Vec<u8>> {
        let align = self.container * self.channels;
        let mut header = Vec::with_capacity(44);
        header.extend_from_slice(b"RIFF");
        header.extend_from_slice(&data.saturating_add(36).to_le_bytes());
        header.extend_from_slice(b"WAVEfmt \x10\0\0\0");
        header.extend_from_slice(&if self.float { 3_u16 } else { 1 }.to_le_bytes());
        header.extend_from_slice(&self.channels.to_le_bytes());
        // The rate is ours to know. hound only checks that it and the bytes a second agree, which for absurd rates
        // they cannot in 32 bits.
        header.extend_from_slice(&1_u32.to_le_bytes());
        header.extend_from_slice(&u32::from(align).to_le_bytes());
        header.extend_from_slice(&align.to_le_bytes());
        header.extend_from_slice(&(self.container * 8).to_le_bytes());
        header.extend_from_slice(b"data");
        header.extend_from_slice(&data.to_le_bytes());
        std::io::Cursor::new(header)
    }

    /// The mean of the channels of `frames` frames, brought into −1 to 1 where floating point goes beyond.
    fn mix(&self, source: impl Read, frames: usize, warnings: &mut Vec<String>) -> Result<Vec<f32>> {
        let fault = |error: hound::Error| Fault::new(format!("cannot read the samples: {error}")).help(CONVERT);
        let mut reader = WavReader::new(source).map_err(fault)?;
        let channels = usize::from(self.channels);
        let mut mixed = Vec::with_capacity(frames);
        let mut strange = 0_usize;
        if reader.spec().sample_format == SampleFormat::Float {
            let mut sum = 0.0_f64;
            for (index, sample) in reader.samples::<f32>().enumerate() {
                let sample = sample.map_err(fault)?;
                strange += usize::from(!sample.is_finite());
                sum += if sample.is_finite() { f64::from(sample) } else { 0.0 };
                if (index + 1) % channels == 0 {
                    mixed.push((std::mem::take(&mut sum) / channels as f64) as f32);
                }
            }
        } else {
            let full = 1.0 / ((1_u64 << (self.container * 8 - 1)) as f64 * channels as f64);
            let mut sum = 0_i64;
            for (index, sample) in reader.samples::<i32>().enumerate() {
                sum += i64::from(sample.map_err(fault)?);
                if (index + 1) % channels == 0 {
                    mixed.push((std::mem::take(&mut sum) as f64 * full) as f32);
                }
            }
        }
        if strange > 0 {
            warnings.push(format!("{strange} samples are no numbers and are taken for silence"));
        }
        let highest = mixed.iter().fold(0.0_f32, |highest, s| highest.max(s.abs()));
        if highest > 1.0 {
            warnings.push(format!("samples reach {highest:.3} where 1 is full; all are made smaller to fit"));
            mixed.iter_mut().for_each(|s| *s /= highest);
        }
        Ok(mixed)
    }
}
