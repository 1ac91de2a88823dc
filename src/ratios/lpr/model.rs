//! How likely a decision is, as learned from those before it.

/// Decisions after which the fast and the slow estimate forget at a constant rate.
const FAST: usize = 20;
const SLOW: usize = 250;

/// What a new decision counts after n, in 65536ths.
const RATES: [i64; SLOW + 1] = {
    let mut rates = [0; SLOW + 1];
    let mut n = 0;
    while n <= SLOW {
        rates[n] = 655_360 / (10 * n as i64 + 16);
        n += 1;
    }
    rates
};

/// Bits that a decision of probability (i + ½) / 256 costs, in 256ths. Found with whole numbers alone, so that the
/// choices that rest on it are the same on every machine.
const COSTS: [u32; 256] = {
    let mut costs = [0; 256];
    let mut i = 0;
    while i < 256 {
        // −log2((2 i + 1) / 512) bit by bit: squaring doubles a logarithm.
        let mut x = (2 * i as u64 + 1) << 32;
        let mut whole = 9;
        while x >= 2 << 32 {
            x >>= 1;
            whole -= 1;
        }
        let (mut part, mut bit) = (0, 0);
        while bit < 8 {
            x = ((x >> 8) * (x >> 8)) >> 16;
            part <<= 1;
            if x >= 2 << 32 {
                x >>= 1;
                part += 1;
            }
            bit += 1;
        }
        costs[i] = whole * 256 - part;
        i += 1;
    }
    costs
};

/// One decision's probability.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bit {
    fast: u16,
    slow: u16,
    count: u8,
}

impl Bit {
    pub(crate) const NEW: Self = Self { fast: 0x8000, slow: 0x8000, count: 0 };

    /// The probability of a 0, in 65536ths: never none and never all.
    pub(crate) fn zero(self) -> u32 {
        ((u32::from(self.fast) + u32::from(self.slow)) >> 1).clamp(32, 65_504)
    }

    /// Learns of a decision.
    pub(crate) fn learn(&mut self, one: bool) {
        let target = if one { 0 } else { 65_535 };
        let n = usize::from(self.count);
        let near = |now: u16, most: usize| {
            let now = i64::from(now);
            // Between the old and the target: it fits.
            (now + (((target - now) * RATES[n.min(most)]) >> 16)).clamp(0, 65_535) as u16
        };
        (self.fast, self.slow) = (near(self.fast, FAST), near(self.slow, SLOW));
        self.count = (n + 1).min(SLOW) as u8;
    }

    /// What a decision would cost, in 256ths of a bit.
    pub(crate) fn cost(self, one: bool) -> u32 {
        let zero = self.zero();
        COSTS[(if one { 65_536 - zero } else { zero } >> 8) as usize & 0xFF]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_are_logarithms() {
        for (i, cost) in COSTS.iter().enumerate() {
            let bits = -((2.0 * i as f64 + 1.0) / 512.0).log2();
            assert!((f64::from(*cost) / 256.0 - bits).abs() < 0.01, "{i}: {cost} {bits}");
        }
    }

    #[test]
    fn a_decision_that_is_always_the_same_becomes_cheap() {
        let mut bit = Bit::NEW;
        for _ in 0..1000 {
            bit.learn(true);
        }
        assert!(bit.zero() < 700 && bit.cost(true) < 6, "{}", bit.zero());
    }
}
