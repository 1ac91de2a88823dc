//! The checksum of zlib (RFC 1950), of pieces that are put together later.

const BASE: u64 = 65_521;

/// Both sums over a stretch of bytes, as if they began at 0.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Sum {
    length: u64,
    first: u64,
    second: u64,
}

impl Sum {
    /// Of no bytes.
    pub(super) const NONE: Self = Self { length: 0, first: 0, second: 0 };

    /// Of so many zeros.
    pub(super) fn zeros(length: u32) -> Self {
        Self { length: length.into(), ..Self::default() }
    }

    /// Both sums in little room.
    pub(super) fn packed(self) -> [u16; 2] {
        [(self.first % BASE) as u16, (self.second % BASE) as u16]
    }

    /// Sums again, of so many bytes.
    #[inline]
    pub(super) fn unpacked(length: u32, [first, second]: [u16; 2]) -> Self {
        Self { length: length.into(), first: first.into(), second: second.into() }
    }

    /// Replaces zeros by bytes, the first of which is so far from the end (1 for the last). The stretch is short: below
    /// 2^20.
    #[inline]
    pub(super) fn put(&mut self, bytes: &[u8], from_end: u32) {
        for (byte, from_end) in bytes.iter().zip((0..=from_end).rev()) {
            self.first += u64::from(*byte);
            self.second += u64::from(*byte) * u64::from(from_end);
        }
    }

    /// Appends a byte.
    #[inline]
    pub(super) fn byte(&mut self, byte: u8) {
        self.length += 1;
        self.first += u64::from(byte);
        self.second += self.first;
    }

    /// Of bytes.
    pub(super) fn of(bytes: &[u8]) -> Self {
        let mut all = Self::default();
        for part in bytes.chunks(4096) {
            let mut sum = Self::default();
            part.iter().for_each(|b| sum.byte(*b));
            all = all.then(sum);
        }
        all
    }

    /// Another stretch after this one, both of one row of a picture, whose sums have room.
    #[inline]
    pub(super) fn add(&mut self, next: Self) {
        self.second += next.second + next.length * self.first;
        self.first += next.first;
        self.length += next.length;
    }

    /// This stretch and another after it.
    #[inline]
    pub(super) fn then(self, next: Self) -> Self {
        Self {
            length: (self.length + next.length) % BASE,
            first: (self.first + next.first) % BASE,
            second: (self.second + next.second + next.length * self.first) % BASE,
        }
    }

    /// The four bytes that a file has.
    pub(super) fn value(self) -> u32 {
        let all = Self { length: 0, first: 1, second: 0 }.then(self);
        (all.second as u32) << 16 | all.first as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// As the standard has it.
    fn slow(bytes: &[u8]) -> u32 {
        let (mut a, mut b) = (1_u32, 0_u32);
        for byte in bytes {
            a = (a + u32::from(*byte)) % 65_521;
            b = (b + a) % 65_521;
        }
        b << 16 | a
    }

    proptest! {
        #[test]
        fn pieces_add_up_to_the_whole(bytes in prop::collection::vec(0_u8..=255, 0..20_000), cut in 0_usize..20_000) {
            let (one, two) = bytes.split_at(cut.min(bytes.len()));
            prop_assert_eq!(Sum::of(&bytes).value(), slow(&bytes));
            prop_assert_eq!(Sum::of(one).then(Sum::of(two)).value(), slow(&bytes));
            let mut put = Sum::zeros(bytes.len() as u32);
            bytes.chunks(3).enumerate().for_each(|(i, three)| put.put(three, (bytes.len() - 3 * i) as u32));
            prop_assert_eq!(put.value(), slow(&bytes));
            prop_assert_eq!(Sum::unpacked(bytes.len() as u32, put.packed()).value(), slow(&bytes));
        }
    }
}
