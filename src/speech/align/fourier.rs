//! The Fourier transform of 512 samples, in one way on every processor: what is learned and what is pinned by tests
//! must not depend on which instructions it has.

/// Samples of a transform.
pub const SIZE: usize = 512;

const BINS: usize = SIZE / 2 + 1;

/// Tables and room for a transform, radix 2, decimation in time.
#[derive(Debug)]
pub struct Fourier {
    /// For each stage its roots of unity, one after the other.
    roots: Vec<(f32, f32)>,
    /// Where each sample goes: its number with the bits the other way round.
    order: Vec<u16>,
    re: [f32; SIZE],
    im: [f32; SIZE],
}

impl Default for Fourier {
    fn default() -> Self {
        Self::new()
    }
}

impl Fourier {
    /// Makes the tables.
    #[must_use]
    pub fn new() -> Self {
        let bits = SIZE.trailing_zeros();
        let order = (0..SIZE).map(|i| (i as u16).reverse_bits() >> (16 - bits)).collect();
        let mut roots = Vec::with_capacity(SIZE);
        let mut half = 1;
        while half < SIZE {
            roots.extend((0..half).map(|k| {
                let angle = -std::f64::consts::PI * k as f64 / half as f64;
                (angle.cos() as f32, angle.sin() as f32)
            }));
            half *= 2;
        }
        Self { roots, order, re: [0.0; SIZE], im: [0.0; SIZE] }
    }

    /// Takes two real signals of up to [`SIZE`] samples; what is missing is 0.
    pub fn load(&mut self, samples: impl Iterator<Item = (f32, f32)>) {
        self.re.fill(0.0);
        self.im.fill(0.0);
        for ((a, b), to) in samples.zip(&self.order) {
            self.re[usize::from(*to)] = a;
            self.im[usize::from(*to)] = b;
        }
    }

    /// Transforms what was loaded: the power of every frequency of the first signal and of the second.
    pub fn powers(&mut self, out: &mut [[f32; BINS]; 2]) {
        self.transform();
        let [one, two] = out;
        for (k, (one, two)) in one.iter_mut().zip(two).enumerate() {
            let m = (SIZE - k) % SIZE;
            // Of a real signal the transform at −k is the conjugate of that at k: so the two come apart.
            let (a, b, c, d) = (self.re[k], self.im[k], self.re[m], self.im[m]);
            let (x, y) = (0.5 * (a + c), 0.5 * (b - d));
            let (u, v) = (0.5 * (b + d), 0.5 * (c - a));
            *one = x * x + y * y;
            *two = u * u + v * v;
        }
    }

    fn transform(&mut self) {
        let (mut half, mut table) = (1, 0);
        while half < SIZE {
            let roots = &self.roots[table..table + half];
            for (re, im) in self.re.chunks_exact_mut(2 * half).zip(self.im.chunks_exact_mut(2 * half)) {
                let (re_low, re_high) = re.split_at_mut(half);
                let (im_low, im_high) = im.split_at_mut(half);
                let low = re_low.iter_mut().zip(im_low);
                for (((a, b), (c, d)), (cos, sin)) in low.zip(re_high.iter_mut().zip(im_high)).zip(roots) {
                    let (x, y) = (*c * cos - *d * sin, *c * sin + *d * cos);
                    (*c, *d) = (*a - x, *b - y);
                    (*a, *b) = (*a + x, *b + y);
                }
            }
            table += half;
            half *= 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_powers_are_those_of_the_sum_of_the_definition() {
        let signal =
            |seed: u32| -> Vec<f32> { (0..400_u32).map(|i| ((i * i + seed * i) % 97) as f32 / 48.5 - 1.0).collect() };
        let (one, two) = (signal(3), signal(11));
        let mut fourier = Fourier::new();
        fourier.load(one.iter().copied().zip(two.iter().copied()));
        let mut powers = [[0.0; BINS]; 2];
        fourier.powers(&mut powers);
        for (signal, powers) in [one, two].iter().zip(&powers) {
            for k in [0, 1, 2, 17, 100, 255, 256] {
                let (mut re, mut im) = (0.0, 0.0);
                for (i, s) in signal.iter().enumerate() {
                    let angle = std::f64::consts::TAU * (k * i % SIZE) as f64 / SIZE as f64;
                    re += f64::from(*s) * angle.cos();
                    im += f64::from(*s) * angle.sin();
                }
                let expected = re * re + im * im;
                assert!((f64::from(powers[k]) - expected).abs() < 1e-3 * expected + 1e-2, "{k}");
            }
        }
    }
}
