//! What rows of a picture are told by in deflate: single bytes and runs, in the codes of one table for a whole clip.
//!
//! In the first row of a band, pixels are told as they are, and runs repeat the pixel before; in the others what
//! is told is the difference from the row above, and runs are of zeros.

use super::huffman::{Bits, Code, codes, lengths};

/// Symbols for bytes, the end and lengths.
const SYMBOLS: usize = 286;
const END: usize = 256;
/// The longest run that one symbol tells.
const LONGEST: usize = 258;

/// First length of every symbol from 257 on, and how many bits say which of its lengths (RFC 1951, 3.2.5).
const BASES: [(usize, u8); 29] = [
    (3, 0),
    (4, 0),
    (5, 0),
    (6, 0),
    (7, 0),
    (8, 0),
    (9, 0),
    (10, 0),
    (11, 1),
    (13, 1),
    (15, 1),
    (17, 1),
    (19, 2),
    (23, 2),
    (27, 2),
    (31, 2),
    (35, 3),
    (43, 3),
    (51, 3),
    (59, 3),
    (67, 4),
    (83, 4),
    (99, 4),
    (115, 4),
    (131, 5),
    (163, 5),
    (195, 5),
    (227, 5),
    (258, 0),
];

/// The symbol of a length, its further bits and how many they are.
fn length_symbol(length: usize) -> (usize, u64, u8) {
    let i = BASES.partition_point(|(first, _)| *first <= length) - 1;
    (257 + i, (length - BASES[i].0) as u64, BASES[i].1)
}

/// Takes tokens.
pub(super) trait Sink {
    /// One byte.
    fn byte(&mut self, byte: u8);
    /// So many zeros after one that has been told: at most [`LONGEST`], at least 3.
    fn zeros(&mut self, count: usize);
    /// The pixel before again, so many bytes of it, as many at a time.
    fn again(&mut self, count: usize);

    /// Three bytes.
    #[inline]
    fn three(&mut self, bytes: [u8; 3]) {
        bytes.into_iter().for_each(|byte| self.byte(byte));
    }

    /// A run of zeros of any length.
    #[inline]
    fn gap(&mut self, count: usize) {
        tell_zeros(self, count);
    }
}

/// Tells a run of zeros of any length.
fn tell_zeros(sink: &mut (impl Sink + ?Sized), count: usize) {
    if count == 0 {
        return;
    }
    sink.byte(0);
    let mut left = count - 1;
    while left >= 3 {
        // Not so much that one or two are left over.
        let now = if left > LONGEST && left < LONGEST + 3 { left - 3 } else { left.min(LONGEST) };
        sink.zeros(now);
        left -= now;
    }
    (0..left).for_each(|_| sink.byte(0));
}

/// How often each symbol occurs.
pub(super) struct Counts(Box<[u64; SYMBOLS]>);

impl Counts {
    /// Every symbol once, for any may come.
    pub(super) fn new() -> Self {
        Self(Box::new([1; SYMBOLS]))
    }
}

/// A token of the sample weighs more than one that only may come.
const WEIGHT: u64 = 64;

impl Sink for Counts {
    fn byte(&mut self, byte: u8) {
        self.0[usize::from(byte)] += WEIGHT;
    }

    fn zeros(&mut self, count: usize) {
        self.0[length_symbol(count).0] += WEIGHT;
    }

    fn again(&mut self, count: usize) {
        self.zeros(count);
    }
}

/// The codes of a clip.
pub(super) struct Table {
    bytes: [Code; 256],
    end: Code,
    /// A run of so many, with its distance: of zeros, and of pixels.
    zeros: Vec<(u32, u8)>,
    again: Vec<(u32, u8)>,
    /// A zero and the zeros after it, all as one; from 0 of them on.
    gaps: Vec<(u64, u8)>,
    /// In whole words, and how many bits of them are meant.
    header: (Box<[u64]>, usize),
}

impl Table {
    /// The best codes for what has been counted, where a pixel has `channels` bytes.
    pub(super) fn new(counts: &Counts, channels: usize) -> Self {
        let lengths_of_all = lengths(&counts.0[..], 14);
        let all = codes(&lengths_of_all);
        // Two distances, 1 and a pixel, with a bit each: the symbol of a distance to 4 is one less.
        let mut distances = vec![0; channels];
        (distances[0], distances[channels - 1]) = (1, 1);
        let distance_codes = codes(&distances);
        let run = |length: usize, distance: Code| {
            if length < 3 {
                return (0, 0);
            }
            let (symbol, more, count) = length_symbol(length);
            let code = all[symbol];
            let bits = u64::from(code.bits) | more << code.count | u64::from(distance.bits) << (code.count + count);
            (bits as u32, code.count + count + distance.count)
        };
        let runs = |distance: Code| (0..=LONGEST).map(|n| run(n, distance)).collect();
        let mut bytes = [Code::default(); 256];
        bytes.copy_from_slice(&all[..256]);
        let zeros: Vec<(u32, u8)> = runs(distance_codes[0]);
        let gap = |count: usize| match count {
            0 => (0, 0),
            1..4 => {
                (0..count as u8).fold((0, 0), |(bits, n), _| (bits | u64::from(bytes[0].bits) << n, n + bytes[0].count))
            }
            _ => {
                let (bits, n) = zeros[count - 1];
                (u64::from(bytes[0].bits) | u64::from(bits) << bytes[0].count, bytes[0].count + n)
            }
        };
        Self {
            bytes,
            end: all[END],
            gaps: (0..=LONGEST + 1).map(gap).collect(),
            zeros,
            again: runs(distance_codes[channels - 1]),
            header: header(&lengths_of_all, &distances),
        }
    }

    /// Opens a block that is not the last.
    pub(super) fn open(&self, bits: &mut Bits) {
        let (words, count) = &self.header;
        bits.append(words, *count);
    }

    /// Ends it at a whole byte, so that another piece can follow.
    pub(super) fn close(&self, bits: &mut Bits) {
        bits.put(u64::from(self.end.bits), u32::from(self.end.count));
        // An empty stored block.
        bits.put(0, 3);
        bits.fill_byte();
        bits.put(0xFFFF_0000, 32);
    }
}

/// Writes tokens in the codes of a table.
pub(super) struct Coded<'a> {
    pub(super) table: &'a Table,
    pub(super) bits: &'a mut Bits,
}

impl Sink for Coded<'_> {
    #[inline]
    fn byte(&mut self, byte: u8) {
        let code = self.table.bytes[usize::from(byte)];
        self.bits.put(u64::from(code.bits), u32::from(code.count));
    }

    #[inline]
    fn zeros(&mut self, count: usize) {
        let (bits, length) = self.table.zeros[count];
        self.bits.put(u64::from(bits), u32::from(length));
    }

    #[inline]
    fn again(&mut self, count: usize) {
        let (bits, length) = self.table.again[count];
        self.bits.put(u64::from(bits), u32::from(length));
    }

    #[inline]
    fn three(&mut self, bytes: [u8; 3]) {
        // No code has more than 14 bits.
        let [a, b, c] = bytes.map(|byte| self.table.bytes[usize::from(byte)]);
        let two = u64::from(a.bits) | u64::from(b.bits) << a.count;
        let count = u32::from(a.count + b.count);
        self.bits.put(two | u64::from(c.bits) << count, count + u32::from(c.count));
    }

    #[inline]
    fn gap(&mut self, count: usize) {
        match self.table.gaps.get(count) {
            Some((bits, length)) => self.bits.put(*bits, u32::from(*length)),
            None => tell_zeros(self, count),
        }
    }
}

/// The start of a block of such codes (RFC 1951, 3.2.7): the lengths, themselves in codes.
fn header(symbols: &[u8], distances: &[u8]) -> (Box<[u64]>, usize) {
    const ORDER: [usize; 19] = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];
    let all: Vec<u8> = symbols.iter().chain(distances).copied().collect();
    // A length, or the length before three to six times more.
    let mut told: Vec<(usize, u64)> = Vec::new();
    let mut i = 0;
    while i < all.len() {
        let alike = all[i..].iter().take_while(|n| **n == all[i]).count();
        told.push((usize::from(all[i]), 0));
        i += 1;
        let mut more = alike - 1;
        while more >= 3 && all[i] != 0 {
            let now = more.min(6);
            told.push((16, (now - 3) as u64));
            (i, more) = (i + now, more - now);
        }
    }
    let mut counts = [0; 19];
    told.iter().for_each(|(symbol, _)| counts[*symbol] += 1);
    let lengths = lengths(&counts, 7);
    let codes = codes(&lengths);
    let mut bits = Bits::default();
    bits.put(0b100, 3);
    bits.put((symbols.len() - 257) as u64, 5);
    bits.put((distances.len() - 1) as u64, 5);
    bits.put((ORDER.len() - 4) as u64, 4);
    ORDER.iter().for_each(|symbol| bits.put(u64::from(lengths[*symbol]), 3));
    for (symbol, more) in told {
        bits.put(u64::from(codes[symbol].bits), u32::from(codes[symbol].count));
        if symbol == 16 {
            bits.put(more, 2);
        }
    }
    let count = bits.len();
    bits.fill_word();
    (bits.words().into(), count)
}
