//! A recording in memory, and how it is read.

mod decimate;
mod decode;
mod iso;
mod kind;
mod mix;
mod mp3;
mod peaks;
mod raw;
mod read;
mod resample;
mod wav;
mod wav_form;
mod wav_writer;

use std::borrow::Cow;
use std::path::Path;
use std::sync::OnceLock;

use peaks::Pyramid;

pub(crate) use decimate::decimated;
pub(crate) use resample::Resampled;
pub(crate) use wav_writer::write_wav;

use crate::disk::Result;

/// A recording, its channels mixed into one.
#[derive(Debug, Clone, Default)]
pub struct Sound {
    /// Samples a second, at least 1.
    pub rate: u32,
    /// How many channels the file had.
    pub channels: u16,
    /// The mean of the channels, −1 to 1. Not to be changed once [`Self::peaks`] has been asked.
    pub samples: Vec<f32>,
    /// What was wrong with the file and mended, one line each.
    pub warnings: Vec<String>,
    /// The root mean square of each channel; none where it was not read from a file.
    pub(crate) sides: Vec<f64>,
    outline: OnceLock<Pyramid>,
}

impl Sound {
    /// A sound made of samples; `rate` 0 is taken for 1.
    #[must_use]
    pub fn new(rate: u32, samples: Vec<f32>) -> Self {
        Self { rate: rate.max(1), channels: 1, samples, ..Self::default() }
    }

    /// Reads a recording: WAV of 8 to 64 bits, whole numbers or floating point, A-law, µ-law or ADPCM, at any rate, with
    /// any number of channels; AIFF, FLAC, OGG (Vorbis), MP3, M4A (AAC, ALAC); the sound of MP4, MOV, MKV and WebM. What
    /// a file is, its content says, whatever its ending.
    ///
    /// The lengths in its headers are not believed: of a recording that was cut off, or whose header was never
    /// finished, everything that is there is used, with a warning. What is damaged is silent, and what follows keeps
    /// its time. What an encoder put before the sound is taken off: times are those of what was encoded.
    ///
    /// # Errors
    /// With the path: no recording, a compression that is not read (Opus, WMA), no sound in it, a rate or number of
    /// channels that cannot be, longer than 4 hours or larger than 2 GB.
    pub fn read(path: &Path) -> Result<Self> {
        read::read(path)
    }

    /// How long it is, in seconds.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.samples.len() as f64 / f64::from(self.rate.max(1))
    }

    /// The lowest and highest sample in each of `columns` equal parts of the time from `from` to `to`, in seconds: what
    /// a waveform is drawn from. Exact at any zoom, and as fast for an hour as for a word: some hundred numbers are
    /// looked at for a column. Outside the recording both are 0; a part shorter than a sample has the sample there.
    #[must_use]
    pub fn peaks(&self, from: f64, to: f64, columns: usize) -> Vec<(f32, f32)> {
        let outline = self.outline.get_or_init(|| Pyramid::new(&self.samples));
        let rate = f64::from(self.rate.max(1));
        let edge = |column: usize| ((from + (to - from) * column as f64 / columns as f64) * rate).floor();
        (0..columns)
            .map(|column| {
                let (first, last) = (edge(column), edge(column + 1).max(edge(column) + 1.0));
                // A column of nothing but what lies outside; NaN lands here too.
                if !(last > 0.0 && first < self.samples.len() as f64) {
                    return (0.0, 0.0);
                }
                outline.between(&self.samples, first.max(0.0) as usize, last as usize)
            })
            .collect()
    }

    /// Its samples at another rate, band-limited: as they are where it is the same. Sample `i` lies at `i / rate`
    /// seconds in both; there are round(n · `rate` / its own) of them. What passes is kept to a thousandth up to 95 % of
    /// half the lower rate, what that rate cannot hold is 64 dB down. Ten minutes at 48 kHz take half a second.
    #[must_use]
    pub fn resampled(&self, rate: u32) -> Cow<'_, [f32]> {
        if rate == self.rate {
            return Cow::Borrowed(&self.samples);
        }
        let all = self.resampling(rate);
        Cow::Owned(all.part(0..all.len()))
    }

    /// The same in parts, for what need not be in memory as a whole.
    #[must_use]
    pub(crate) fn resampling(&self, rate: u32) -> Resampled<'_> {
        Resampled::new(&self.samples, self.rate, rate)
    }
}
