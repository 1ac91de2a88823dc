//! Chance that is the same on every run: a hash, a generator, and smooth noise in space.

use crate::vector::V;

/// A well-mixed number of a number (the finaliser of SplitMix64).
pub fn hash(n: u64) -> u64 {
    let mut z = n.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// [`hash`] as a fraction of one.
pub fn fraction(n: u64) -> f32 {
    (hash(n) >> 40) as f32 / (1u64 << 24) as f32
}

/// A stream of chance that belongs to one seed.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Dice {
        Dice(hash(seed))
    }

    /// Even over 0 to 1.
    pub fn roll(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(1);
        fraction(self.0)
    }

    /// Even over `a` to `b`.
    pub fn between(&mut self, a: f32, b: f32) -> f32 {
        a + (b - a) * self.roll()
    }

    /// About normal: mean 0, deviation 1 (the sum of four even numbers, scaled).
    pub fn normal(&mut self) -> f32 {
        (self.roll() + self.roll() + self.roll() + self.roll() - 2.0) * 1.732
    }
}

fn corner(x: i32, y: i32, z: i32) -> f32 {
    let n = (x as u32 as u64) ^ ((y as u32 as u64) << 21) ^ ((z as u32 as u64) << 42);
    fraction(n) * 2.0 - 1.0
}

/// Smooth noise, −1 to 1, with features about one unit wide.
pub fn grain(p: V) -> f32 {
    let (x, y, z) = (p.0.floor(), p.1.floor(), p.2.floor());
    let ease = |t: f32| t * t * (3.0 - 2.0 * t);
    let (u, v, w) = (ease(p.0 - x), ease(p.1 - y), ease(p.2 - z));
    let (x, y, z) = (x as i32, y as i32, z as i32);
    let mut sum = 0.0;
    for (dz, wz) in [(0, 1.0 - w), (1, w)] {
        for (dy, wy) in [(0, 1.0 - v), (1, v)] {
            let a = corner(x, y + dy, z + dz);
            let b = corner(x + 1, y + dy, z + dz);
            sum += wz * wy * (a + (b - a) * u);
        }
    }
    sum
}

/// Three octaves of [`grain`]: clouds.
pub fn cloud(p: V) -> f32 {
    grain(p) * 0.57 + grain(p * 2.03 + V::all(17.0)) * 0.29 + grain(p * 4.1 + V::all(41.0)) * 0.14
}
