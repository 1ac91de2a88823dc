//! The range coder: decisions to bytes and back (Martin 1979, in the binary form of LZMA).

use super::model::Bit;

/// Writes decisions or reads them, so that what is in a frame is said once for both. What is given is what is written;
/// a reader passes it over. What is returned is what the record has.
pub(super) trait Coder {
    /// A decision of probability `zero` / 65536 for a 0.
    fn decide(&mut self, zero: u32, one: bool) -> bool;

    /// A decision, learned from.
    fn bit(&mut self, model: &mut Bit, one: bool) -> bool {
        let one = self.decide(model.zero(), one);
        model.learn(one);
        one
    }

    /// A decision that is nowhere learned.
    fn even(&mut self, one: bool) -> bool {
        self.decide(0x8000, one)
    }

    /// A whole number by its models: unary for the small ones, Exp-Golomb beyond.
    fn whole(&mut self, models: &mut [Bit; 15], value: u64) -> u64 {
        for (at, model) in models.iter_mut().enumerate() {
            if !self.bit(model, value > at as u64) {
                return at as u64;
            }
        }
        let rest = value.saturating_sub(15).saturating_add(1).min((1 << 62) - 1);
        let mut size = 0;
        while size < 62 && self.even(rest >> (size + 1) > 0) {
            size += 1;
        }
        let mut read = 1_u64;
        for at in (0..size).rev() {
            read = read << 1 | u64::from(self.even(rest >> at & 1 == 1));
        }
        read - 1 + 15
    }
}

/// Writes a payload.
#[derive(Debug)]
pub(super) struct Encoder {
    low: u32,
    range: u32,
    out: Vec<u8>,
}

impl Encoder {
    pub(crate) fn new() -> Self {
        Self { low: 0, range: u32::MAX, out: Vec::new() }
    }

    /// How many bytes there are by now.
    pub(crate) fn len(&self) -> usize {
        self.out.len()
    }

    /// The payload: the number within the last interval that has the most zeros at its end, which need not be written.
    pub(crate) fn finish(mut self) -> Vec<u8> {
        let last = u64::from(self.low) + u64::from(self.range) - 1;
        let round = |zeros: u32| (u64::from(self.low) + (1_u64 << zeros) - 1) >> zeros << zeros;
        let value = (0..=32).rev().map(round).find(|v| *v <= last).unwrap_or(u64::from(self.low));
        if value >> 32 != 0 {
            self.carry();
        }
        self.out.extend((value as u32).to_be_bytes());
        while self.out.last() == Some(&0) {
            self.out.pop();
        }
        self.out
    }

    /// One more in the bytes that are out already.
    fn carry(&mut self) {
        for byte in self.out.iter_mut().rev() {
            *byte = byte.wrapping_add(1);
            if *byte != 0 {
                return;
            }
        }
    }
}

impl Coder for Encoder {
    fn decide(&mut self, zero: u32, one: bool) -> bool {
        let bound = (self.range >> 16) * zero;
        if one {
            let (low, over) = self.low.overflowing_add(bound);
            self.low = low;
            self.range -= bound;
            if over {
                self.carry();
            }
        } else {
            self.range = bound;
        }
        while self.range < 1 << 24 {
            self.out.push((self.low >> 24) as u8);
            self.low <<= 8;
            self.range <<= 8;
        }
        one
    }
}

/// Reads a payload. Beyond its end are zeros; damage was noticed before.
#[derive(Debug)]
pub(super) struct Decoder {
    code: u32,
    range: u32,
    bytes: Vec<u8>,
    at: usize,
}

impl Decoder {
    pub(crate) fn new(bytes: Vec<u8>) -> Self {
        let mut new = Self { code: 0, range: u32::MAX, bytes, at: 0 };
        for _ in 0..4 {
            new.next();
        }
        new
    }

    fn next(&mut self) {
        self.code = self.code << 8 | u32::from(self.bytes.get(self.at).copied().unwrap_or(0));
        self.at = self.at.saturating_add(1);
    }
}

impl Coder for Decoder {
    fn decide(&mut self, zero: u32, _one: bool) -> bool {
        let bound = (self.range >> 16) * zero;
        let one = self.code >= bound;
        if one {
            self.code -= bound;
            self.range -= bound;
        } else {
            self.range = bound;
        }
        while self.range < 1 << 24 {
            self.range <<= 8;
            self.next();
        }
        one
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn whatever_is_decided_comes_back(
            decisions in prop::collection::vec((any::<bool>(), 32..=65_504_u32), 0..400),
            values in prop::collection::vec(prop_oneof![0..20_u64, any::<u64>().prop_map(|v| v >> 3)], 0..40),
        ) {
            let mut encoder = Encoder::new();
            let mut models = [Bit::NEW; 15];
            for (one, zero) in &decisions {
                encoder.decide(*zero, *one);
            }
            for value in &values {
                encoder.whole(&mut models, *value);
            }
            let bytes = encoder.finish();
            let mut decoder = Decoder::new(bytes);
            let mut models = [Bit::NEW; 15];
            for (one, zero) in &decisions {
                prop_assert_eq!(decoder.decide(*zero, false), *one);
            }
            for value in &values {
                prop_assert_eq!(decoder.whole(&mut models, 0), *value);
            }
        }
    }
}
