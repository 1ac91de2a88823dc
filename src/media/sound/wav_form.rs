//! How the samples of a WAV file are written, and turning them into numbers.

use std::io::Read;

use super::raw::{RATES, SAVE_AS_WAV};
use crate::disk::{Fault, FileFault, Result};

/// How samples are written.
pub(super) struct Form {
    pub channels: u16,
    pub rate: u32,
    /// Bytes of one sample. Fewer valid bits stand at its upper end, so that they need not be known.
    container: u16,
    code: Code,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Code {
    /// Whole numbers: 8 bits from 0 to 255, others from below 0.
    Whole,
    Float,
    MuLaw,
    ALaw,
}

impl Form {
    /// What the chunk `fmt ` says. Nothing where it says a compression that is not read here.
    ///
    /// # Errors
    /// Where it is cut off, says what cannot be, or a form that nobody reads.
    pub(crate) fn of(bytes: &[u8]) -> Result<Option<Self>> {
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
            return Err(Fault::of(FileFault::Mismatch, format!("the file says that it has {what}")).help(SAVE_AS_WAV));
        }
        let container = if align >= channels && align % channels == 0 { align / channels } else { bits.div_ceil(8) };
        if container.checked_mul(channels).is_none() {
            return Err(Fault::of(FileFault::Mismatch, format!("the file says that it has {channels} channels"))
                .help(SAVE_AS_WAV));
        }
        let (code, known, what) = match tag {
            1 => (Code::Whole, (1..=4).contains(&container) && (1..=container * 8).contains(&bits), "whole numbers"),
            3 => (Code::Float, matches!(container, 4 | 8) && bits == container * 8, "floating point"),
            6 => (Code::ALaw, container == 1, "A-law"),
            7 => (Code::MuLaw, container == 1, "µ-law"),
            _ => return Ok(None),
        };
        if known {
            return Ok(Some(Self { channels, rate, container, code }));
        }
        Err(Fault::of(FileFault::Unsupported, format!("the samples are {what} of {bits} bits, which is not read"))
            .help(SAVE_AS_WAV))
    }

    /// Bytes of one sample of every channel.
    pub(crate) fn frame(&self) -> u64 {
        u64::from(self.container) * u64::from(self.channels)
    }

    /// Hands on every whole sample, full at −1 and 1.
    pub(crate) fn samples(&self, mut source: impl Read, mut each: impl FnMut(f64)) -> std::io::Result<()> {
        let width = usize::from(self.container);
        let mut bytes = vec![0; 4096 * width];
        let mut held = 0;
        loop {
            let got = match source.read(&mut bytes[held..]) {
                Ok(0) => return Ok(()),
                Ok(got) => held + got,
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(error),
            };
            let whole = got - got % width;
            for sample in bytes[..whole].chunks_exact(width) {
                each(self.sample(sample));
            }
            bytes.copy_within(whole..got, 0);
            held = got - whole;
        }
    }

    fn sample(&self, bytes: &[u8]) -> f64 {
        let whole = |number: i32| f64::from(number) / 2_147_483_648.0;
        match (self.code, bytes) {
            (Code::MuLaw, [a]) => f64::from(mu_law(*a)) / 32_768.0,
            (Code::ALaw, [a]) => f64::from(a_law(*a)) / 32_768.0,
            (Code::Float, [a, b, c, d]) => f64::from(f32::from_le_bytes([*a, *b, *c, *d])),
            (Code::Float, [a, b, c, d, e, f, g, h]) => f64::from_le_bytes([*a, *b, *c, *d, *e, *f, *g, *h]),
            (_, [a]) => (f64::from(*a) - 128.0) / 128.0,
            (_, [a, b]) => whole(i32::from_le_bytes([0, 0, *a, *b])),
            (_, [a, b, c]) => whole(i32::from_le_bytes([0, *a, *b, *c])),
            (_, [a, b, c, d]) => whole(i32::from_le_bytes([*a, *b, *c, *d])),
            _ => 0.0,
        }
    }
}

/// ITU-T G.711, µ-law, to 16 bits.
fn mu_law(code: u8) -> i16 {
    let code = !code;
    let size = (i16::from(code & 0x0F) << 3 | 0x84) << (code >> 4 & 7);
    if code & 0x80 == 0 { size - 0x84 } else { 0x84 - size }
}

/// ITU-T G.711, A-law, to 16 bits.
fn a_law(code: u8) -> i16 {
    let code = code ^ 0x55;
    let (segment, low) = (code >> 4 & 7, i16::from(code & 0x0F) << 4);
    let size = if segment == 0 { low + 8 } else { (low + 0x108) << (segment - 1) };
    if code & 0x80 == 0 { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn telephone_codes_are_those_of_the_standard() {
        // Ends, zeros and a step of each: table 2a and 1a of G.711, shifted to 16 bits.
        for (code, number) in [(0xFF, 0), (0x7F, 0), (0x80, 32_124), (0x00, -32_124), (0xEF, 132), (0xFE, 8)] {
            assert_eq!(mu_law(code), number, "{code:#x}");
        }
        for (code, number) in [(0xD5, 8), (0x55, -8), (0xAA, 32_256), (0x2A, -32_256), (0xC5, 264), (0x80, 5_504)] {
            assert_eq!(a_law(code), number, "{code:#x}");
        }
    }
}
