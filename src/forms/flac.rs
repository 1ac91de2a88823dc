//! FLAC, as small as its fixed predictors make it: what sound is written as where no encoder is there. About half of a
//! WAV file, played by every browser, and lossless (RFC 9639).

/// Samples of a block.
const BLOCK: usize = 4096;

/// The code of that size in a frame's header; the other says that the size stands at the header's end.
const SIZE_4096: u64 = 0b1100;
const SIZE_FOLLOWS: u64 = 0b0111;

/// Blocks are cut into 2⁰ to 2⁶ parts, each with its own length of code.
const MOST_CUTS: u32 = 6;

/// The largest Rice parameter of four bits that is no escape.
const LARGEST: u32 = 14;

/// The FLAC file of samples of 16 bits, one channel.
pub(crate) fn flac(samples: &[i16], rate: u32) -> Vec<u8> {
    let mut out = Bits::default();
    out.bytes.extend(b"fLaC\x80\0\0\x22");
    out.push(BLOCK as u64, 16);
    out.push(BLOCK as u64, 16);
    // Lengths of frames and the sum of the samples are not said, which the format allows.
    out.push(0, 48);
    out.push(u64::from(rate), 20);
    out.push(0, 3);
    out.push(15, 5);
    out.push(samples.len() as u64, 36);
    out.bytes.extend([0; 16]);
    for (number, block) in samples.chunks(BLOCK).enumerate() {
        frame(&mut out.bytes, number as u32, block);
    }
    out.bytes
}

fn frame(file: &mut Vec<u8>, number: u32, block: &[i16]) {
    let mut out = Bits::default();
    let whole = block.len() == BLOCK;
    out.push(0b1111_1111_1111_1000, 16);
    out.push(if whole { SIZE_4096 } else { SIZE_FOLLOWS }, 4);
    // The rate as the file has it, one channel, 16 bits.
    out.push(0b0000_0000_1000, 12);
    out.number(number);
    if !whole {
        out.push(block.len() as u64 - 1, 16);
    }
    let sum = checksum(&out.bytes, 8, 0x07);
    out.push(sum, 8);
    subframe(&mut out, block);
    out.align();
    let sum = checksum(&out.bytes, 16, 0x8005);
    out.push(sum, 16);
    file.append(&mut out.bytes);
}

fn subframe(out: &mut Bits, block: &[i16]) {
    let wide: Vec<i64> = block.iter().map(|s| i64::from(*s)).collect();
    let (order, left) = predicted(&wide);
    out.push(0b0000_1000 | order as u64, 7);
    out.push(0, 1);
    for sample in &block[..order] {
        out.push(u64::from(*sample as u16), 16);
    }
    let codes: Vec<u64> = left.iter().map(|v| ((v << 1) ^ (v >> 63)) as u64).collect();
    let most = if block.len() == BLOCK { MOST_CUTS } else { 0 };
    let cuts =
        (0..=most).min_by_key(|cuts| parts(&codes, block.len(), order, *cuts).map(|p| 4 + best(p).1).sum::<u64>());
    let cuts = cuts.unwrap_or(0);
    out.push(0, 2);
    out.push(u64::from(cuts), 4);
    for part in parts(&codes, block.len(), order, cuts) {
        let (bits, _) = best(part);
        out.push(u64::from(bits), 4);
        for code in part {
            out.zeros(code >> bits);
            out.push(1, 1);
            out.push(code & ((1 << bits) - 1), bits);
        }
    }
}

/// The order of the fixed predictor that leaves least, 0 to 4, and what it leaves.
fn predicted(samples: &[i64]) -> (usize, Vec<i64>) {
    let mut left = samples.to_vec();
    let mut best = (0, left.clone());
    let size = |v: &[i64]| v.iter().map(|x| x.unsigned_abs()).sum::<u64>();
    for order in 1..=4.min(samples.len().saturating_sub(1)) {
        left = left.windows(2).map(|w| w[1] - w[0]).collect();
        if size(&left) < size(&best.1) {
            best = (order, left.clone());
        }
    }
    best
}

/// The codes in 2^`cuts` parts; the first is shorter by what is not predicted.
fn parts(codes: &[u64], block: usize, order: usize, cuts: u32) -> impl Iterator<Item = &[u64]> {
    let each = block >> cuts;
    (0..1_usize << cuts).map(move |i| {
        let edge = |i: usize| (i * each).saturating_sub(order).min(codes.len());
        &codes[edge(i)..edge(i + 1)]
    })
}

/// The length of code that is shortest for these, and how many bits they take with it.
fn best(codes: &[u64]) -> (u32, u64) {
    let cost = |bits: u32| codes.iter().map(|c| 1 + u64::from(bits) + (c >> bits)).sum::<u64>();
    (0..=LARGEST).map(|bits| (bits, cost(bits))).min_by_key(|b| b.1).unwrap_or((0, 0))
}

/// A cyclic sum of bytes, high bit first, from 0.
fn checksum(bytes: &[u8], width: u32, polynomial: u64) -> u64 {
    let mask = (1 << width) - 1;
    bytes.iter().fold(0, |sum, byte| {
        (0..8).fold(sum ^ u64::from(*byte) << (width - 8), |sum, _| {
            let over = sum >> (width - 1) & 1;
            (sum << 1 & mask) ^ (over * polynomial)
        })
    })
}

/// Bits, the high one first.
#[derive(Default)]
struct Bits {
    bytes: Vec<u8>,
    /// Bits that fill no byte yet, and how many.
    open: u64,
    count: u32,
}

impl Bits {
    /// The `count` low bits of a value, at most 48.
    fn push(&mut self, value: u64, count: u32) {
        self.open = self.open << count | (value & ((1 << count) - 1));
        self.count += count;
        while self.count >= 8 {
            self.count -= 8;
            self.bytes.push((self.open >> self.count) as u8);
        }
        self.open &= (1 << self.count) - 1;
    }

    fn zeros(&mut self, mut count: u64) {
        while count > 0 {
            let some = count.min(32);
            self.push(0, some as u32);
            count -= some;
        }
    }

    fn align(&mut self) {
        if self.count > 0 {
            self.push(0, 8 - self.count);
        }
    }

    /// A number as UTF-8 would write it, up to 31 bits.
    fn number(&mut self, value: u32) {
        if value < 0x80 {
            return self.push(value.into(), 8);
        }
        let bits = u32::BITS - value.leading_zeros();
        let more = (bits - 2) / 5;
        let first = 0xFF00_u32 >> (more + 1) & 0xFF | value >> (6 * more);
        self.push(first.into(), 8);
        for i in (0..more).rev() {
            self.push(u64::from(0x80 | value >> (6 * i) & 0x3F), 8);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::media::Sound;

    #[test]
    fn what_is_written_is_read_back_to_the_last_bit() {
        let wave = |i: usize| ((i as f64 * 0.07).sin() * 9000.0 + (i as f64 * 1.9).sin() * 400.0) as i16;
        let ends = [i16::MIN, i16::MAX, 0, -1, i16::MAX, i16::MIN];
        // Silence, speech-like waves, the loudest there is; more blocks than one byte can count.
        let samples: Vec<i16> = (0..140 * BLOCK + 777)
            .map(|i| {
                if i < 9000 {
                    0
                } else if i < 20_000 {
                    ends[i * i % 6]
                } else {
                    wave(i)
                }
            })
            .collect();
        let folder = tempfile::tempdir().unwrap();
        for length in [1, 2, 5, BLOCK, samples.len()] {
            let path = folder.path().join("sound.flac");
            std::fs::write(&path, flac(&samples[..length], 22_050)).unwrap();
            let read = Sound::read(&path).unwrap();
            let whole: Vec<i16> = read.samples.iter().map(|s| (s * 32_768.0) as i16).collect();
            assert!(read.rate == 22_050 && whole == samples[..length], "{length} samples, {:?}", read.warnings);
        }
    }

    #[test]
    fn a_wave_takes_less_room_than_as_wav() {
        let samples: Vec<i16> = (0..50_000).map(|i| ((f64::from(i) * 0.05).sin() * 8000.0) as i16).collect();
        assert!(flac(&samples, 16_000).len() < samples.len());
    }
}
