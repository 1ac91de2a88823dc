//! Mixing channels into one, as they come out of a file.

/// One stream of samples in the making.
pub(super) struct Mixer {
    channels: usize,
    /// The one channel that is taken; without it the mean of all.
    only: Option<usize>,
    /// The channel that the next sample is of.
    next: usize,
    sum: f64,
    squares: Vec<f64>,
    mixed: Vec<f32>,
    strange: usize,
}

/// What was mixed.
pub(super) struct Mixed {
    pub samples: Vec<f32>,
    /// The root mean square of each channel.
    pub sides: Vec<f64>,
    /// How many samples were no numbers.
    pub strange: usize,
    /// By how much all samples were divided, where they went beyond full.
    pub highest: f32,
}

impl Mixer {
    /// For frames of `channels` samples, at least 1; `frames` of them are expected.
    pub(crate) fn new(channels: usize, only: Option<usize>, frames: usize) -> Self {
        let channels = channels.max(1);
        Self {
            channels,
            only: only.filter(|only| *only < channels),
            next: 0,
            sum: 0.0,
            squares: vec![0.0; channels],
            mixed: Vec::with_capacity(frames),
            strange: 0,
        }
    }

    /// How many frames there are.
    pub(crate) fn frames(&self) -> usize {
        self.mixed.len()
    }

    /// How many channels there are.
    pub(crate) fn channels(&self) -> usize {
        self.channels
    }

    /// Takes the next sample: of the first channel, the second and so on, then of the first again.
    pub(crate) fn push(&mut self, sample: f64) {
        let sample = if sample.is_finite() {
            sample
        } else {
            self.strange += 1;
            0.0
        };
        self.squares[self.next] += sample * sample;
        match self.only {
            None => self.sum += sample / self.channels as f64,
            Some(only) if only == self.next => self.sum = sample,
            Some(_) => {}
        }
        self.next += 1;
        if self.next == self.channels {
            self.mixed.push(std::mem::take(&mut self.sum) as f32);
            self.next = 0;
        }
    }

    /// Takes frames of silence.
    pub(crate) fn silence(&mut self, frames: usize) {
        self.mixed.resize(self.mixed.len() + frames, 0.0);
    }

    /// Puts frames of silence before the frame at a place.
    pub(crate) fn insert(&mut self, at: usize, frames: usize) {
        let at = at.min(self.mixed.len());
        self.mixed.splice(at..at, std::iter::repeat_n(0.0, frames));
    }

    /// Drops `start` frames from the beginning, and all beyond `length` after them.
    pub(crate) fn trim(&mut self, start: usize, length: Option<usize>) {
        self.mixed.drain(..start.min(self.mixed.len()));
        self.mixed.truncate(length.unwrap_or(usize::MAX));
    }

    /// What has been mixed, brought into −1 to 1 where it goes beyond.
    pub(crate) fn done(mut self) -> Mixed {
        let highest = self.mixed.iter().fold(1.0_f32, |highest, s| highest.max(s.abs()));
        if highest > 1.0 {
            self.mixed.iter_mut().for_each(|s| *s /= highest);
        }
        let frames = self.mixed.len().max(1) as f64;
        let sides = self.squares.iter().map(|square| (square / frames).sqrt()).collect();
        self.mixed.shrink_to_fit();
        Mixed { samples: self.mixed, sides, strange: self.strange, highest }
    }
}

impl Mixed {
    /// The channel to take alone where the channels are each other turned upside down, so that little is left of their
    /// mean: less than a tenth of what unlike channels leave.
    pub(crate) fn cancelled(&self) -> Option<usize> {
        let count = self.sides.len();
        let all: f64 = self.sides.iter().map(|side| side * side).sum();
        let scale = f64::from(self.highest).powi(2) / self.samples.len().max(1) as f64;
        let left: f64 = self.samples.iter().map(|s| f64::from(*s).powi(2)).sum::<f64>() * scale;
        let loudest = (0..count).max_by(|a, b| self.sides[*a].total_cmp(&self.sides[*b]))?;
        (count > 1 && all > 1e-8 && left < 0.1 * all / (count * count) as f64).then_some(loudest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mixed(frames: &[[f64; 2]], only: Option<usize>) -> Mixed {
        let mut mixer = Mixer::new(2, only, 0);
        frames.iter().flatten().for_each(|s| mixer.push(*s));
        mixer.done()
    }

    #[test]
    fn channels_that_cancel_are_noticed_and_others_are_not() {
        let wave = |i: usize| (i as f64 * 0.1).sin() * 0.5;
        let upside_down: Vec<[f64; 2]> = (0..1000).map(|i| [wave(i) * 0.9, -wave(i)]).collect();
        assert_eq!(mixed(&upside_down, None).cancelled(), Some(1));
        assert_eq!(mixed(&upside_down, Some(1)).samples[15], -wave(15) as f32);
        let one_silent: Vec<[f64; 2]> = (0..1000).map(|i| [wave(i), 0.0]).collect();
        assert_eq!(mixed(&one_silent, None).cancelled(), None);
        let apart: Vec<[f64; 2]> = (0..1000).map(|i| [wave(i), wave(i + 16)]).collect();
        assert_eq!(mixed(&apart, None).cancelled(), None);
    }

    #[test]
    fn half_a_frame_is_none_and_what_is_no_number_is_silence() {
        let mut mixer = Mixer::new(2, None, 0);
        [f64::NAN, 1.0, 4.0, 4.0, 0.3].into_iter().for_each(|s| mixer.push(s));
        let done = mixer.done();
        assert_eq!((done.samples.as_slice(), done.strange, done.highest), (&[0.125, 1.0][..], 1, 4.0));
    }
}
