//! The outline of a sound at every zoom: a pyramid of lowest and highest samples, built once.

/// How many entries of one level an entry of the next stands for. With 16 the pyramid takes an eighth of the samples'
/// own memory, and a column looks at no more than 30 entries of each level.
const FAN: usize = 16;

/// Lowest and highest samples of blocks of 16, 256, 4096… samples.
#[derive(Debug, Clone, Default)]
pub(super) struct Pyramid {
    levels: Vec<Vec<(f32, f32)>>,
}

impl Pyramid {
    pub(crate) fn new(samples: &[f32]) -> Self {
        let mut levels = Vec::new();
        let mut level: Vec<(f32, f32)> =
            samples.chunks(FAN).map(|c| c.iter().fold(NOTHING, |so_far, s| with(so_far, (*s, *s)))).collect();
        while level.len() > 1 {
            let next = level.chunks(FAN).map(|c| c.iter().copied().fold(NOTHING, with)).collect();
            levels.push(std::mem::replace(&mut level, next));
        }
        levels.push(level);
        Self { levels }
    }

    /// The lowest and highest of the samples from `from` up to but not including `to`; (0, 0) where there are none.
    /// `samples` are those the pyramid was built from.
    pub(crate) fn between(&self, samples: &[f32], from: usize, to: usize) -> (f32, f32) {
        let (mut from, mut to) = (from.min(samples.len()), to.min(samples.len()));
        let mut found = NOTHING;
        // What does not fill a block of the level above is looked at one by one, and the rest one level up.
        for level in 0..=self.levels.len() {
            let entry = |i: usize| match level.checked_sub(1) {
                None => samples.get(i).map_or(NOTHING, |s| (*s, *s)),
                Some(below) => self.levels[below].get(i).copied().unwrap_or(NOTHING),
            };
            let top = level == self.levels.len();
            while from < to && (top || from % FAN != 0) {
                found = with(found, entry(from));
                from += 1;
            }
            while from < to && to % FAN != 0 {
                to -= 1;
                found = with(found, entry(to));
            }
            (from, to) = (from / FAN, to / FAN);
        }
        if found.0 <= found.1 { found } else { (0.0, 0.0) }
    }
}

const NOTHING: (f32, f32) = (f32::INFINITY, f32::NEG_INFINITY);

fn with(a: (f32, f32), b: (f32, f32)) -> (f32, f32) {
    (a.0.min(b.0), a.1.max(b.1))
}

#[cfg(test)]
mod tests {
    use super::super::Sound;

    fn noise(length: usize) -> Vec<f32> {
        let mut state = 1_u32;
        let next = |_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 23) as f32 - 1.0
        };
        (0..length).map(next).collect()
    }

    #[test]
    fn every_column_at_every_zoom_is_exactly_the_lowest_and_highest_sample() {
        let samples = noise(10_007);
        let sound = Sound::new(100, samples.clone());
        for (from, to, columns) in
            [(0.0, 100.07, 80), (0.0, 100.07, 1), (3.0, 3.5, 50), (17.0, 93.0, 7), (99.0, 101.0, 4)]
        {
            for (column, peaks) in sound.peaks(from, to, columns).into_iter().enumerate() {
                let edge = |c: usize| ((from + (to - from) * c as f64 / columns as f64) * 100.0).floor() as usize;
                let range = edge(column).min(10_007)..edge(column + 1).min(10_007);
                let expected = samples[range].iter().fold((f32::MAX, f32::MIN), |m, s| (m.0.min(*s), m.1.max(*s)));
                let expected = if expected.0 > expected.1 { (0.0, 0.0) } else { expected };
                assert_eq!(peaks, expected, "{from} {to} {columns}: {column}");
            }
        }
    }

    #[test]
    fn outside_the_sound_and_at_impossible_times_the_outline_is_flat() {
        let sound = Sound::new(10, vec![0.5; 10]);
        assert_eq!(sound.peaks(-2.0, 2.0, 4), [(0.0, 0.0), (0.0, 0.0), (0.5, 0.5), (0.0, 0.0)]);
        assert_eq!(sound.peaks(f64::NAN, 1.0, 1), [(0.0, 0.0)]);
        assert_eq!(sound.peaks(0.5, 0.5, 2), [(0.5, 0.5), (0.5, 0.5)]);
        assert!(sound.peaks(0.0, 1.0, 0).is_empty());
        assert_eq!(Sound::new(10, Vec::new()).peaks(0.0, 1.0, 1), [(0.0, 0.0)]);
    }
}
