//! What a spectrogram strip is drawn from.

use std::f32::consts::TAU;
use std::ops::Range;

use rayon::prelude::*;

use super::fourier::Powers;
use crate::media::Sound;
use crate::media::decimated;

/// Bands of frequency, equally wide in mel: more than a strip in a terminal has rows.
const BANDS: usize = 64;

/// The lowest and highest frequency, in Hz: below is hum, above is little that tells sounds of speech apart.
const LOWEST: f32 = 60.0;
const HIGHEST: f32 = 8000.0;

/// The seconds from one column to the next: a third of the shortest stop.
const STEP: f64 = 0.005;

/// The most columns there are; a recording longer than 50 minutes has longer steps, so that memory stays within 41 MB.
const MOST: f64 = 600_000.0;

/// Samples of a window. At 16 to 32 kHz they are 16 to 32 ms: formants stand out and so do the closures of stops.
const WINDOW: usize = 512;

/// How many columns are one in the coarse copy that long stretches are drawn from.
const COARSE: usize = 16;

/// Values are kept in thirds of a dB above −85, where 0 dB is a full-scale sine.
const FLOOR: f32 = -85.0;
const PER_DB: f32 = 3.0;

/// The share of the quietest values of a band whose middle is taken for its noise, as in [`Sound::sounding`].
const QUIET: f64 = 0.06;

/// The least and the most that a picture's darkest lies below its brightest, in dB.
const RANGE: (f32, f32) = (20.0, 55.0);

/// Energy by time and frequency: 64 bands from 60 to 8000 Hz, equally wide in mel, every 5 ms.
#[derive(Debug, Clone, Default)]
pub struct Spectrogram {
    /// Seconds from one column to the next.
    step: f64,
    /// Column after column, each from the lowest band to the highest.
    fine: Vec<u8>,
    /// The same, [`COARSE`] columns in one.
    coarse: Vec<u8>,
    /// The noise of each band, in the units of `fine`.
    noise: Vec<f32>,
    /// The loudest there is but for a thousandth, in the units of `fine`.
    loudest: f32,
}

impl Spectrogram {
    /// Computes it, once for a recording: in less than half a second for ten minutes.
    #[must_use]
    pub fn of(sound: &Sound) -> Self {
        let (samples, rate) = decimated(&sound.samples, sound.rate, 16_000);
        let (step, count) = steps(samples.len() as f64 / rate);
        let columns = Columns::new(rate);
        let mut fine = vec![0_u8; count * BANDS];
        // A thousand columns to a thread's turn; each column is computed alone, so their order is of no matter.
        fine.par_chunks_mut(1000 * BANDS).enumerate().for_each(|(turn, part)| {
            let mut transform = columns.transform.clone();
            for (index, column) in part.chunks_mut(BANDS).enumerate() {
                let middle = ((turn * 1000 + index) as f64 * step * rate) as usize;
                columns.column(&samples, middle, &mut transform, column);
            }
        });
        let coarse = (0..count.div_ceil(COARSE))
            .flat_map(|i| {
                let columns = i * COARSE..((i + 1) * COARSE).min(count);
                let sums = sums(&fine, columns.clone());
                sums.into_iter().map(move |s| (s / columns.len() as f32).round() as u8)
            })
            .collect();
        let histograms = histograms(&fine);
        let noise = histograms.iter().map(|h| quantile(h, QUIET / 2.0)).collect();
        let mut all = [0_u32; 256];
        histograms.iter().for_each(|h| all.iter_mut().zip(h).for_each(|(a, b)| *a += b));
        Self { step, fine, coarse, noise, loudest: quantile(&all, 0.999) }
    }

    /// A picture of the time from `from` to `to`, in seconds: `columns` columns of `rows` values each, from the highest
    /// band to the lowest, 0 (as quiet as the noise) to 1 (the loudest). Outside the recording all is 0.
    ///
    /// A column is the mean over its time, a row the loudest of its bands. It is as fast for an hour as for a word.
    #[must_use]
    pub fn picture(&self, from: f64, to: f64, columns: usize, rows: usize) -> Vec<Vec<f32>> {
        (0..columns)
            .map(|column| {
                let edge = |i: usize| (from + (to - from) * i as f64 / columns as f64) / self.step.max(f64::EPSILON);
                let bands = self.between(edge(column), edge(column + 1));
                (0..rows).map(|row| row_of(&bands, row, rows)).collect()
            })
            .collect()
    }

    /// Brightness of every band in the mean of the steps from `from` to `to`; nothing outside.
    fn between(&self, from: f64, to: f64) -> Vec<f32> {
        let count = self.fine.len() / BANDS;
        if !(to > 0.0 && from < count as f64) {
            return Vec::new();
        }
        let first = from.max(0.0) as usize;
        let last = (to.ceil() as usize).clamp(first + 1, count.max(first + 1)).min(count);
        let (values, range) = if last - first > 4 * COARSE {
            (&self.coarse, first / COARSE..last.div_ceil(COARSE))
        } else {
            (&self.fine, first..last)
        };
        let number = range.len().max(1) as f32;
        let span = |noise: f32| (self.loudest - noise).clamp(RANGE.0 * PER_DB, RANGE.1 * PER_DB);
        let sums = sums(values, range);
        let noises = sums.iter().zip(&self.noise);
        noises.map(|(s, n)| ((s / number - self.loudest) / span(*n) + 1.0).clamp(0.0, 1.0)).collect()
    }
}

/// The seconds from one column to the next, and the number of columns, for a recording of some seconds.
fn steps(seconds: f64) -> (f64, usize) {
    let step = STEP.max(seconds / MOST);
    (step, (seconds / step).ceil() as usize)
}

/// The loudest of the bands that a row stands for; rows count from the highest.
fn row_of(bands: &[f32], row: usize, rows: usize) -> f32 {
    let place = rows - 1 - row;
    let (from, to) = (place * BANDS / rows, ((place + 1) * BANDS / rows).max(place * BANDS / rows + 1));
    bands.get(from..to).unwrap_or_default().iter().copied().fold(0.0, f32::max)
}

fn sums(values: &[u8], columns: Range<usize>) -> [f32; BANDS] {
    let mut sums = [0_u32; BANDS];
    let part = values.get(columns.start * BANDS..columns.end * BANDS).unwrap_or_default();
    for column in part.chunks_exact(BANDS) {
        sums.iter_mut().zip(column).for_each(|(s, v)| *s += u32::from(*v));
    }
    sums.map(|s| s as f32)
}

/// How often each value is in each band.
fn histograms(values: &[u8]) -> Vec<[u32; 256]> {
    let mut out = vec![[0; 256]; BANDS];
    for column in values.chunks_exact(BANDS) {
        out.iter_mut().zip(column).for_each(|(h, v)| h[usize::from(*v)] += 1);
    }
    out
}

/// The value that a share of all lie below.
fn quantile(histogram: &[u32; 256], share: f64) -> f32 {
    let wanted = histogram.iter().map(|n| u64::from(*n)).sum::<u64>() as f64 * share;
    let mut sum = 0.0;
    let found = histogram.iter().position(|n| {
        sum += f64::from(*n);
        sum > wanted
    });
    found.unwrap_or(0) as f32
}

/// What turns samples into columns.
struct Columns {
    transform: Powers,
    window: Vec<f32>,
    /// For each band its first line of the spectrum and the weights of the lines from there.
    filters: Vec<(usize, Vec<f32>)>,
}

impl Columns {
    fn new(rate: f64) -> Self {
        let mel = |hertz: f32| 2595.0 * (1.0 + hertz / 700.0).log10();
        let hertz = |mel: f32| 700.0 * (10.0_f32.powf(mel / 2595.0) - 1.0);
        let middle = |band: f32| hertz(mel(LOWEST) + (mel(HIGHEST) - mel(LOWEST)) * (band + 0.5) / BANDS as f32);
        let window: Vec<f32> =
            (0..WINDOW).map(|i| 0.5 - 0.5 * (TAU * (i as f32 + 0.5) / WINDOW as f32).cos()).collect();
        // What makes a full-scale sine 1.
        let scale = (2.0 / window.iter().sum::<f32>()).powi(2);
        let line = rate as f32 / WINDOW as f32;
        let filters = (0..BANDS)
            .map(|band| {
                let at = middle(band as f32);
                // Triangles that reach to the middles beside, and at least over two lines, so that none is empty.
                let half = (0.5 * (middle(band as f32 + 1.0) - middle(band as f32 - 1.0))).max(line);
                let first = ((at - half) / line).max(0.0).ceil() as usize;
                let last = (((at + half) / line) as usize).min(WINDOW / 2);
                let triangle = |i: usize| 1.0 - ((i as f32 * line - at) / half).abs();
                let weights: Vec<f32> = (first..=last).map(|i| triangle(i).max(0.0)).collect();
                let gain = scale * tilt(at) / weights.iter().sum::<f32>().max(1e-6);
                (first, weights.into_iter().map(|w| w * gain).collect())
            })
            .collect();
        Self { transform: Powers::new(WINDOW), window, filters }
    }

    /// The column whose middle is at a sample.
    fn column(&self, samples: &[f32], middle: usize, transform: &mut Powers, column: &mut [u8]) {
        let power = transform.of(self.window.iter().enumerate().map(|(i, weight)| {
            let sample = (middle + i).checked_sub(WINDOW / 2).and_then(|at| samples.get(at));
            sample.copied().unwrap_or(0.0) * weight
        }));
        for (value, (first, weights)) in column.iter_mut().zip(&self.filters) {
            let energy: f32 = power.iter().skip(*first).zip(weights).map(|(p, w)| p * w).sum();
            *value = ((10.0 * (energy + 1e-12).log10() - FLOOR) * PER_DB).clamp(0.0, 255.0) as u8;
        }
    }
}

/// What makes up for the fall of a voice towards high frequencies: 6 dB an octave above 250 Hz, 0 dB at 1000 Hz.
fn tilt(hertz: f32) -> f32 {
    (hertz.max(250.0) / 1000.0).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sound(rate: u32, seconds: f64, value: impl Fn(f64) -> f64) -> Sound {
        let count = (seconds * f64::from(rate)) as usize;
        Sound::new(rate, (0..count).map(|i| value(i as f64 / f64::from(rate)) as f32).collect())
    }

    fn sine(hertz: f64, time: f64) -> f64 {
        (std::f64::consts::TAU * hertz * time).sin()
    }

    #[test]
    fn a_tone_is_bright_where_and_when_it_is() {
        for rate in [8000, 16_000, 22_050, 44_100, 48_000] {
            let tone = |t: f64| if (1.0..2.0).contains(&t) { 0.5 * sine(1000.0, t) } else { 0.0 };
            let picture = Spectrogram::of(&sound(rate, 3.0, tone)).picture(0.0, 3.0, 30, 32);
            // 1000 Hz is at 0.33 of the mel scale from 60 to 8000 Hz.
            let row = 31 - (0.33 * 32.0) as usize;
            assert!(picture[15][row] > 0.8 || picture[15][row + 1] > 0.8, "{rate}: {:?}", picture[15]);
            assert!(picture[15][2] < 0.1 && picture[5].iter().all(|v| *v < 0.05), "{rate}");
        }
    }

    #[test]
    fn every_zoom_shows_the_same_and_outside_is_dark() {
        let hiss = |t: f64| 0.01 * sine(50.0 + 3000.0 * (t * 977.0).fract(), t);
        let tone = |t: f64| hiss(t) + if (t % 4.0) < 2.0 { 0.5 * sine(700.0, t) } else { 0.0 };
        let spectrogram = Spectrogram::of(&sound(16_000, 40.0, tone));
        let far = spectrogram.picture(0.0, 40.0, 20, 16);
        let near = spectrogram.picture(0.0, 4.0, 2000, 16);
        for row in 0..16 {
            let mean = near[100..900].iter().map(|c| c[row]).sum::<f32>() / 800.0;
            assert!((far[0][row] - mean).abs() < 0.1, "row {row}: {} and {mean}", far[0][row]);
        }
        assert!(spectrogram.picture(-5.0, -1.0, 3, 8).iter().flatten().all(|v| *v == 0.0));
        assert!(spectrogram.picture(41.0, 50.0, 3, 8).iter().flatten().all(|v| *v == 0.0));
        assert_eq!(spectrogram.picture(0.0, 1.0, 0, 8).len(), 0);
        assert_eq!(spectrogram.picture(0.0, 1.0, 2, 0), vec![Vec::<f32>::new(); 2]);
        assert_eq!(spectrogram.picture(1.0, 1.0, 2, 100)[0].len(), 100);
        assert!(Spectrogram::default().picture(0.0, 1.0, 2, 2).iter().flatten().all(|v| *v == 0.0));
        assert!(Spectrogram::of(&Sound::default()).picture(0.0, 1.0, 2, 2).iter().flatten().all(|v| *v == 0.0));
    }

    #[test]
    fn a_long_recording_stays_small() {
        for hours in [1.0, 2.0, 4.0] {
            let (step, count) = steps(3600.0 * hours);
            assert!(count * BANDS * (COARSE + 1) / COARSE < 42_000_000, "{hours} hours");
            assert!((step * count as f64 - 3600.0 * hours).abs() < 2.0 * step);
        }
        assert_eq!(steps(600.0), (STEP, 120_000));
    }
}
