//! Codes of few bits for what is frequent, and the bits themselves, in the order that deflate has them (RFC 1951).

/// Bits one after another, the lowest of a byte first.
#[derive(Debug, Default)]
pub(super) struct Bits {
    words: Vec<u64>,
    open: u64,
    /// How many of `open` are meant: always less than 64.
    count: u32,
}

impl Bits {
    /// Appends the lowest `count` bits, at most 56; the others must be 0.
    #[inline]
    pub(super) fn put(&mut self, bits: u64, count: u32) {
        self.open |= bits << self.count;
        let all = self.count + count;
        if all < 64 {
            self.count = all;
        } else {
            self.words.push(self.open);
            // At least 8 were there before, so that less than a word is left.
            self.open = bits >> (64 - self.count);
            self.count = all - 64;
        }
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        64 * self.words.len() + self.count as usize
    }

    /// Appends `count` bits of whole words.
    #[inline]
    pub(super) fn append(&mut self, words: &[u64], count: usize) {
        let (whole, rest) = (count / 64, (count % 64) as u32);
        if self.count == 0 {
            self.words.extend_from_slice(&words[..whole]);
        } else {
            self.words.extend(words[..whole].iter().map(|word| {
                let full = self.open | word << self.count;
                self.open = word >> (64 - self.count);
                full
            }));
        }
        if rest > 32 {
            self.put(words[whole] & 0xFFFF_FFFF, 32);
            self.put(words[whole] >> 32, rest - 32);
        } else if rest > 0 {
            self.put(words[whole], rest);
        }
    }

    /// Appends zeros up to the next whole word.
    pub(super) fn fill_word(&mut self) {
        if self.count > 0 {
            self.words.push(self.open);
            (self.open, self.count) = (0, 0);
        }
    }

    /// Appends zeros up to the next whole byte.
    pub(super) fn fill_byte(&mut self) {
        self.put(0, (8 - self.count % 8) % 8);
    }

    /// All words; bits beyond the last whole one are not among them.
    pub(super) fn words(&self) -> &[u64] {
        &self.words
    }

    /// Gives all of them, which are whole bytes, to `file`, and starts anew.
    pub(super) fn drain_into(&mut self, file: &mut Vec<u8>) {
        file.reserve(8 * self.words.len() + 8);
        self.words.iter().for_each(|word| file.extend_from_slice(&word.to_le_bytes()));
        file.extend_from_slice(&self.open.to_le_bytes()[..(self.count / 8) as usize]);
        self.clear();
    }

    /// Forgets them, but not their memory.
    pub(super) fn clear(&mut self) {
        self.words.clear();
        (self.open, self.count) = (0, 0);
    }
}

/// A code: its bits as they are written, and how many.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Code {
    pub(super) bits: u16,
    pub(super) count: u8,
}

/// The best lengths of codes for symbols that occur so often, none longer than `limit`: package-merge (Larmore and
/// Hirschberg 1990). 0 where a symbol does not occur.
pub(super) fn lengths(counts: &[u64], limit: usize) -> Vec<u8> {
    let mut lengths = vec![0; counts.len()];
    let mut leaves: Vec<(u64, usize)> =
        counts.iter().enumerate().filter(|(_, n)| **n > 0).map(|(i, n)| (*n, i)).collect();
    leaves.sort_unstable();
    if leaves.len() < 2 {
        leaves.iter().for_each(|(_, symbol)| lengths[*symbol] = 1);
        return lengths;
    }
    // On every level the leaves and the pairs of the level before, by weight; whether one is a leaf.
    let mut levels: Vec<Vec<(u64, bool)>> = vec![leaves.iter().map(|(n, _)| (*n, true)).collect()];
    for level in 1..limit {
        let pairs = levels[level - 1].chunks_exact(2).map(|p| (p[0].0 + p[1].0, false));
        let mut next: Vec<(u64, bool)> = leaves.iter().map(|(n, _)| (*n, true)).chain(pairs).collect();
        next.sort_by_key(|(weight, leaf)| (*weight, !leaf));
        levels.push(next);
    }
    let mut take = 2 * leaves.len() - 2;
    for level in levels.iter().rev() {
        let taken = &level[..take.min(level.len())];
        let singles = taken.iter().filter(|(_, leaf)| *leaf).count();
        leaves[..singles].iter().for_each(|(_, symbol)| lengths[*symbol] += 1);
        take = 2 * (taken.len() - singles);
    }
    lengths
}

/// The codes of those lengths (RFC 1951, 3.2.2).
pub(super) fn codes(lengths: &[u8]) -> Vec<Code> {
    let mut counts = [0_u16; 17];
    lengths.iter().filter(|n| **n > 0).for_each(|n| counts[usize::from(*n)] += 1);
    let mut next = [0_u16; 17];
    for length in 1..17 {
        next[length] = (next[length - 1] + counts[length - 1]) << 1;
    }
    let code = |count: &u8| match *count {
        0 => Code::default(),
        count => {
            let bits = next[usize::from(count)].reverse_bits() >> (16 - count);
            next[usize::from(count)] += 1;
            Code { bits, count }
        }
    };
    lengths.iter().map(code).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lengths_fill_the_code_exactly_and_keep_the_limit(
            counts in prop::collection::vec(prop_oneof![Just(0_u64), 1_u64..5, 1_u64..1_000_000], 2..286),
            limit in 9_usize..15,
        ) {
            let lengths = lengths(&counts, limit);
            prop_assert!(lengths.iter().all(|n| usize::from(*n) <= limit));
            let used = counts.iter().filter(|n| **n > 0).count();
            let sum: f64 = lengths.iter().filter(|n| **n > 0).map(|n| 0.5_f64.powi(i32::from(*n))).sum();
            prop_assert!(used < 2 || (sum - 1.0).abs() < 1e-12, "{sum}");
            // What is more frequent is not longer.
            for (a, b) in (0..counts.len()).flat_map(|a| (0..counts.len()).map(move |b| (a, b))) {
                prop_assert!(counts[a] <= counts[b] || counts[b] == 0 || lengths[a] <= lengths[b]);
            }
        }
    }

    #[test]
    fn bits_are_appended_where_the_last_ended() {
        let mut bits = Bits::default();
        bits.put(0b101, 3);
        bits.append(&[0x3_DEAD_BEEF], 34);
        assert_eq!(bits.len(), 37);
        bits.fill_byte();
        let mut bytes = Vec::new();
        bits.drain_into(&mut bytes);
        let all = bytes.iter().rev().fold(0_u64, |all, b| all << 8 | u64::from(*b));
        assert_eq!((all, bytes.len()), (0b101 | 0x3_DEAD_BEEF << 3, 5));
        assert_eq!(bits.len(), 0);
    }

    proptest! {
        #[test]
        fn bits_come_out_as_they_were_put_in(
            parts in prop::collection::vec((0_u64..1 << 56, 0_u32..=56, prop::bool::ANY), 0..60),
        ) {
            let (mut bits, mut wanted) = (Bits::default(), Vec::new());
            for (value, count, as_words) in parts {
                let value = value & ((1 << count) - 1);
                if as_words {
                    bits.append(&[value.rotate_left(7), value], 64 + count as usize);
                    wanted.extend((0..64).map(|i| value.rotate_left(7) >> i & 1));
                } else {
                    bits.put(value, count);
                }
                wanted.extend((0..count).map(|i| value >> i & 1));
            }
            prop_assert_eq!(bits.len(), wanted.len());
            bits.fill_byte();
            let mut bytes = Vec::new();
            bits.drain_into(&mut bytes);
            prop_assert_eq!(bytes.len(), wanted.len().div_ceil(8));
            prop_assert!(wanted.iter().enumerate().all(|(i, bit)| u64::from(bytes[i / 8]) >> (i % 8) & 1 == *bit));
        }
    }
}
