//! A sound at another rate: band-limited, without delay.
//!
//! Written here, and not taken from a crate, because those choose their arithmetic by the processor they run on: the
//! same recording must give the same samples everywhere.

use std::f64::consts::PI;
use std::ops::Range;

/// What passes unchanged, as a share of half the lower of the two rates. The rest of the way to the half is the slope
/// of the filter: 7.6 to 8 kHz where 16 kHz are made.
const PASS: f64 = 0.95;

/// How far what lies beyond half the lower rate is pushed down, in dB.
const STOP: f64 = 66.0;

/// As many fractions of a sample have filters of their own; between them filters are mixed, which errs by less than
/// 1e-6. The common rates need 1 to 640.
const MOST_PHASES: u64 = 1024;

/// Products are added up in so many sums side by side, which is what makes this fast, and always in the same order.
const LANES: usize = 16;

/// The samples of a sound at another rate, made part by part as they are asked for: the same whatever the parts.
#[derive(Debug)]
pub(crate) struct Resampled<'a> {
    samples: &'a [f32],
    /// Samples there are at the new rate.
    count: usize,
    /// The two rates without what they have in common: of the sound, and of what is made.
    step: u64,
    phases: u64,
    /// None where the rates are the same.
    bank: Option<Bank>,
}

impl<'a> Resampled<'a> {
    /// The samples at `to` instead of `from` samples a second. Sample `i` of either lies at `i / rate` seconds; there
    /// are round(n · to / from) of them. Outside the sound is silence. Rates of 0 are taken for 1.
    pub(super) fn new(samples: &'a [f32], from: u32, to: u32) -> Self {
        let (from, to) = (u64::from(from.max(1)), u64::from(to.max(1)));
        let common = gcd(from, to);
        let (step, phases) = (from / common, to / common);
        let bank = (from != to).then(|| Bank::new(from as f64, to as f64, phases));
        let count = ((samples.len() as u64 * to + from / 2) / from) as usize;
        Self { samples, count, step, phases, bank }
    }

    /// How many samples there are.
    #[must_use]
    pub(crate) const fn len(&self) -> usize {
        self.count
    }

    /// The samples of a range, by their numbers at the new rate. Beyond the last of them there is nothing.
    #[must_use]
    pub(crate) fn part(&self, range: Range<usize>) -> Vec<f32> {
        let range = range.start.min(self.count)..range.end.min(self.count);
        let Some(bank) = &self.bank else { return self.samples.get(range).unwrap_or_default().to_vec() };
        let mut edge = vec![0.0; bank.taps];
        let mut mixed = vec![0.0; bank.taps];
        let mut made = Vec::with_capacity(range.len());
        // The place of the next sample among those of the sound: whole, and in parts of `phases`.
        let place = range.start as u64 * self.step;
        let (mut whole, mut part) = (place / self.phases, place % self.phases);
        for _ in range {
            let first = whole as i64 - bank.before as i64;
            let filter = bank.at(part, self.phases, &mut mixed);
            let inner = usize::try_from(first).ok().and_then(|at| self.samples.get(at..at + bank.taps));
            made.push(match inner {
                Some(around) => product(around, filter),
                None => {
                    for (index, sample) in edge.iter_mut().enumerate() {
                        let at = usize::try_from(first + index as i64).ok();
                        *sample = at.and_then(|at| self.samples.get(at)).copied().unwrap_or(0.0);
                    }
                    product(&edge, filter)
                }
            });
            part += self.step;
            whole += part / self.phases;
            part %= self.phases;
        }
        made
    }
}

/// Filters for the places between two samples.
#[derive(Debug)]
struct Bank {
    /// Samples that one filter looks at, a multiple of [`LANES`].
    taps: usize,
    /// How many of them lie before the place or on it, less one.
    before: usize,
    /// Filter after filter. Where filters are mixed there is one more, for the place of the next sample.
    filters: Vec<f32>,
    /// How many fractions of a sample they stand for.
    phases: u64,
}

impl Bank {
    /// sinc under a Kaiser window: h(t) = 2f · sinc(2ft) · I₀(β√(1 − (t/w)²)) / I₀(β), t in samples of the sound, f the
    /// middle of the slope. β and the width w follow from [`STOP`] and the slope by Kaiser's formulas (Oppenheim and
    /// Schafer, Discrete-Time Signal Processing, 7.6.1). Each filter is scaled so that a steady level stays as it is.
    fn new(from: f64, to: f64, phases: u64) -> Self {
        let low = from.min(to) / from;
        let slope = PI * low * (1.0 - PASS);
        let width = ((STOP - 7.95) / (2.285 * slope)) / 2.0;
        let beta = 0.1102 * (STOP - 8.7);
        let cut = low * (1.0 + PASS) / 2.0;
        let taps = (2 * width.ceil() as usize).next_multiple_of(LANES);
        let before = taps / 2 - 1;
        let (rows, phases) = if phases <= MOST_PHASES { (phases, phases) } else { (MOST_PHASES + 1, MOST_PHASES) };
        let mut filters = Vec::with_capacity(rows as usize * taps);
        let mut row = vec![0.0_f64; taps];
        for phase in 0..rows {
            let place = before as f64 + phase as f64 / phases as f64;
            for (index, h) in row.iter_mut().enumerate() {
                let t = index as f64 - place;
                let inside = 1.0 - (t / width) * (t / width);
                let x = PI * cut * t;
                let sinc = if x.abs() < 1e-9 { 1.0 } else { x.sin() / x };
                *h = if inside > 0.0 { sinc * bessel(beta * inside.sqrt()) } else { 0.0 };
            }
            let sum: f64 = row.iter().sum();
            filters.extend(row.iter().map(|h| (h / sum) as f32));
        }
        Self { taps, before, filters, phases }
    }

    /// The filter for a place `part / of` behind a sample.
    fn at<'a>(&'a self, part: u64, of: u64, mixed: &'a mut [f32]) -> &'a [f32] {
        let row = |index: u64| &self.filters[index as usize * self.taps..][..self.taps];
        if of == self.phases {
            return row(part);
        }
        let place = part * self.phases;
        let share = (place % of) as f32 / of as f32;
        let (here, next) = (row(place / of), row(place / of + 1));
        for ((m, a), b) in mixed.iter_mut().zip(here).zip(next) {
            *m = a + share * (b - a);
        }
        mixed
    }
}

/// The sum of the products of two rows of equal length, a multiple of [`LANES`].
fn product(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0_f32; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum()
}

/// The modified Bessel function of the first kind, order 0, by its series Σ ((x/2)ᵏ / k!)².
fn bessel(x: f64) -> f64 {
    let quarter = x * x / 4.0;
    let (mut term, mut sum, mut k) = (1.0, 1.0, 1.0);
    while term > sum * 1e-12 {
        term *= quarter / (k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TO: u32 = 16_000;

    fn resampled(samples: &[f32], from: u32, to: u32) -> Vec<f32> {
        Resampled::new(samples, from, to).part(0..usize::MAX)
    }

    fn tone(rate: u32, hertz: f64, seconds: f64) -> Vec<f32> {
        let at = |i: usize| (i as f64 / f64::from(rate) * hertz * 2.0 * PI + 0.3).sin() as f32;
        (0..(f64::from(rate) * seconds) as usize).map(at).collect()
    }

    /// The largest size of what lies more than 20 ms from the ends, and its root mean square.
    fn inner(samples: &[f32], rate: u32) -> (f64, f64) {
        let edge = (f64::from(rate) * 0.02) as usize;
        let inner = &samples[edge..samples.len() - edge];
        let square = inner.iter().map(|s| f64::from(*s).powi(2)).sum::<f64>() / inner.len() as f64;
        (inner.iter().fold(0.0, |m, s| f64::from(s.abs()).max(m)), square.sqrt())
    }

    #[test]
    fn tones_that_pass_keep_their_size_and_place_to_a_thousandth() {
        for from in [8_000, 11_025, 22_050, 32_000, 44_100, 44_099, 48_000, 96_000, 192_000] {
            let half = f64::from(from.min(TO)) / 2.0;
            for hertz in [50.0, 440.0, 1000.0, 0.5 * half, PASS * half] {
                let made = resampled(&tone(from, hertz, 0.2), from, TO);
                let truth = tone(TO, hertz, 0.2);
                assert!(made.len().abs_diff(truth.len()) <= 1, "{from}: {}", made.len());
                let wrong: Vec<f32> = made.iter().zip(&truth).map(|(a, b)| a - b).collect();
                let (most, _) = inner(&wrong, TO);
                assert!(most < 1e-3, "{from} Hz, tone of {hertz} Hz: off by {most}");
            }
        }
    }

    #[test]
    fn what_the_lower_rate_cannot_hold_is_sixty_decibels_down() {
        for from in [22_050, 44_100, 44_099, 48_000, 96_000] {
            let mut hertz = 8_010.0;
            while hertz < f64::from(from) / 2.0 {
                let (_, left) = inner(&resampled(&tone(from, hertz, 0.1), from, TO), TO);
                assert!(20.0 * (left * 2.0_f64.sqrt()).log10() < -64.0, "{from} Hz: {hertz} Hz leaves {left}");
                hertz *= 1.07;
            }
        }
    }

    #[test]
    fn a_click_stays_where_it_was_and_a_level_as_it_was() {
        for from in [8_000, 11_025, 44_100, 48_000, 44_099] {
            let mut click = vec![0.0_f32; from as usize];
            click[from as usize / 4] = 1.0;
            let made = resampled(&click, from, TO);
            let weight: f64 = made.iter().map(|s| f64::from(*s).powi(2)).sum();
            let middle = made.iter().enumerate().map(|(i, s)| i as f64 * f64::from(*s).powi(2)).sum::<f64>() / weight;
            let (found, there) = (middle / f64::from(TO), f64::from(from / 4) / f64::from(from));
            assert!((found - there).abs() < 2e-5, "{from}: {found} instead of {there}");
            let level = resampled(&vec![0.25; from as usize], from, TO);
            assert!(level[800..15_000].iter().all(|s| (s - 0.25).abs() < 1e-6), "{from}");
        }
    }

    #[test]
    fn parts_are_those_of_the_whole_to_the_bit() {
        for (from, to) in [(16_000, 48_000), (44_100, 48_000), (44_099, 48_000), (48_000, 16_000), (48_000, 48_000)] {
            let sound = tone(from, 437.0, 0.3);
            let all = Resampled::new(&sound, from, to);
            let whole = all.part(0..all.len());
            assert_eq!(whole.len(), all.len());
            for block in [1, 997, 4096] {
                let pieces: Vec<f32> = (0..all.len()).step_by(block).flat_map(|at| all.part(at..at + block)).collect();
                assert!(pieces == whole, "{from} to {to} in pieces of {block}");
            }
            assert!(all.part(all.len()..all.len() + 9).is_empty());
        }
    }

    #[test]
    fn lengths_are_rounded_and_nothing_gives_nothing() {
        assert!(resampled(&[], 48_000, TO).is_empty());
        for (count, from, to, expected) in
            [(1, 48_000, TO, 0), (2, 48_000, TO, 1), (3, 48_000, TO, 1), (441, 44_100, TO, 160), (7, 1, 3, 21)]
        {
            assert_eq!(resampled(&vec![0.5; count], from, to).len(), expected, "{count} {from} {to}");
        }
    }
}
