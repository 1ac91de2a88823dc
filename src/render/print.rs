//! 128 bits that tell what is painted: equal ones mean equal pixels.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Things by their prints.
pub(super) type ByPrint<T> = HashMap<Print, T, BuildHasherDefault<AsItIs>>;

/// A print is as even as a hash can be, and is not hashed again.
#[derive(Default)]
pub(super) struct AsItIs(u64);

impl Hasher for AsItIs {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|b| self.write_u64(u64::from(*b)));
    }

    fn write_u64(&mut self, word: u64) {
        self.0 = self.0.rotate_left(32) ^ word;
    }
}

/// 128 bits of all numbers that have been put in, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Print(u64, u64);

impl Print {
    pub(super) const START: Self = Self(0x243F_6A88_85A3_08D3, 0x1319_8A2E_0370_7344);

    #[inline]
    pub(super) fn word(&mut self, word: u64) {
        // A folded product (Yi 2019) and, so that no one weakness is both's, a rotated one (FNV).
        let product = u128::from(self.0 ^ word) * 0x9E37_79B9_7F4A_7C15;
        self.0 = (product as u64 ^ (product >> 64) as u64).wrapping_add(0xA076_1D64_78BD_642F);
        self.1 = (self.1 ^ word).wrapping_mul(0x0000_0100_0000_01B3).rotate_left(23);
        self.1 ^= self.1 >> 29;
    }

    #[inline]
    pub(super) fn print(&mut self, other: Self) {
        self.word(other.0);
        self.word(other.1);
    }

    pub(super) fn numbers(&mut self, numbers: &[f64]) {
        numbers.iter().for_each(|n| self.word(n.to_bits()));
    }
}
