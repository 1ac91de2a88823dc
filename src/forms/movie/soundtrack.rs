//! Sound and captions of the frames that are shown: cut where frames are left out, so that both keep to the picture.

use std::io::BufWriter;
use std::path::Path;

use tempfile::NamedTempFile;

use crate::disk::Result;
use crate::forms::draft::{beside, write_fault};
use crate::forms::stream::Rate;
use crate::media::{Sound, write_wav};
use crate::timing::{Interval, Tier};

/// Samples a second of the sound in a video: what AAC and Opus both take as it is.
pub(super) const SAMPLE_RATE: u32 = 48_000;

/// As many samples are made and written at once: two seconds of them.
const BLOCK: usize = 2 * SAMPLE_RATE as usize;

/// Runs of neighbouring frames, as (first, one beyond the last).
pub(super) fn runs(shown: &[u32]) -> Vec<(u32, u32)> {
    let mut runs: Vec<(u32, u32)> = Vec::new();
    for frame in shown {
        match runs.last_mut() {
            Some(run) if run.1 == *frame => run.1 += 1,
            _ => runs.push((*frame, frame + 1)),
        }
    }
    runs
}

/// The sound of the runs as a WAV file that is gone when dropped: as long as the picture to a sample, silent where the
/// recording has ended.
pub(super) fn sound_file(place: &Path, sound: &Sound, runs: &[(u32, u32)], rate: Rate) -> Result<NamedTempFile> {
    let file = beside(place, ".wav")?;
    let samples = sound.resampling(SAMPLE_RATE);
    let blocks = runs.iter().flat_map(|(from, until)| {
        let [from, until] = [from, until].map(|n| rate.in_parts(*n, SAMPLE_RATE.into()) as usize);
        (from..until).step_by(BLOCK).map(move |start| start..until.min(start + BLOCK))
    });
    let coded = blocks.map(|block| {
        let length = block.len();
        let mut heard = samples.part(block);
        heard.resize(length, 0.0);
        heard.iter().map(|s| (s.clamp(-1.0, 1.0) * 32_767.0).round() as i16).collect::<Vec<_>>()
    });
    write_wav(BufWriter::new(file.as_file()), SAMPLE_RATE, coded).map_err(|e| write_fault(place, e))?;
    Ok(file)
}

/// The captions of the runs, in the time of the video.
pub(super) fn captions_of(tier: &Tier, runs: &[(u32, u32)], rate: Rate) -> Tier {
    let mut cut = Tier::new(tier.name.clone());
    let mut before = 0.0;
    for (from, until) in runs {
        let [from, until] = [from, until].map(|n| rate.time_of(*n));
        for said in tier.spoken() {
            let (start, end) = (said.start.max(from), said.end.min(until));
            // What only touches the run is not worth a caption.
            if end - start > 0.04 {
                cut.intervals.push(Interval::new(start - from + before, end - from + before, &said.label));
            }
        }
        before += until - from;
    }
    cut
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sound_and_captions_follow_the_frames_that_are_shown() {
        let rate = Rate::new(25.0).unwrap();
        let runs = runs(&[0, 1, 2, 3, 4, 50, 51, 52, 53, 54]);
        assert_eq!(runs, [(0, 5), (50, 55)]);
        let sound = Sound::new(SAMPLE_RATE, (0..SAMPLE_RATE * 2 + 4800).map(|i| i as f32 / 2e5).collect());
        let folder = tempfile::tempdir().unwrap();
        let file = sound_file(&folder.path().join("a.mp4"), &sound, &runs, rate).unwrap();
        let read: Vec<i16> = hound::WavReader::open(file.path()).unwrap().samples().map(Result::unwrap).collect();
        assert_eq!(read.len(), 2 * 9600);
        let at = |i: u32| (f64::from(i) / 2e5 * 32_767.0).round() as i16;
        assert_eq!([read[0], read[9599], read[9600]], [0, at(9599), at(96_000)]);
        // The recording ends half way through the last run.
        assert_eq!([read[9600 + 4799], read[9600 + 4800], read[19_199]], [at(100_799), 0, 0]);

        let mut tier = Tier::new("phrases");
        for (start, end, label) in [(0.1, 0.3, "a"), (1.0, 1.5, "b"), (1.9, 2.1, "c"), (2.18, 3.0, "d")] {
            tier.intervals.push(Interval::new(start, end, label));
        }
        let cut = captions_of(&tier, &runs, rate);
        let found: Vec<_> = cut.intervals.iter().map(|i| (i.label.as_str(), i.start, i.end)).collect();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].0 == "a" && near(found[0].1, 0.1) && near(found[0].2, 0.2));
        assert!(found[1].0 == "c" && near(found[1].1, 0.2) && near(found[1].2, 0.3));
    }
    #[test]
    fn a_sound_made_in_pieces_is_the_one_made_whole() {
        let rate = Rate::new(29.97).unwrap();
        let folder = tempfile::tempdir().unwrap();
        for from in [16_000, 44_100, SAMPLE_RATE] {
            let noise = |i: u32| (i.wrapping_mul(2_654_435_761) >> 8) as f32 / 8e6 - 1.0;
            let sound = Sound::new(from, (0..from * 7).map(noise).collect());
            let shown: Vec<u32> = (0..1).chain(3..150).chain(160..230).collect();
            let runs = runs(&shown);
            let file = sound_file(&folder.path().join("a.mp4"), &sound, &runs, rate).unwrap();
            let read: Vec<i16> = hound::WavReader::open(file.path()).unwrap().samples().map(Result::unwrap).collect();
            let whole = sound.resampled(SAMPLE_RATE);
            let mut expected: Vec<i16> = Vec::new();
            for (from, until) in runs {
                let [from, until] = [from, until].map(|n| rate.in_parts(n, SAMPLE_RATE.into()) as usize);
                let heard = (from..until).map(|at| whole.get(at).copied().unwrap_or_default());
                expected.extend(heard.map(|s| (s.clamp(-1.0, 1.0) * 32_767.0).round() as i16));
            }
            assert!(read.len() > 3 * BLOCK && read == expected, "{from}");
        }
    }
    #[test]
    #[cfg(target_os = "linux")]
    fn one_frame_of_a_long_recording_takes_no_memory_for_the_rest() {
        let peak = || -> u64 {
            let status = std::fs::read_to_string("/proc/self/status").unwrap();
            let line = status.lines().find(|l| l.starts_with("VmHWM:")).unwrap();
            line.split_whitespace().nth(1).unwrap().parse().unwrap()
        };
        // Ten minutes: 38 MB as they are, 115 MB at the rate of a video.
        let sound = Sound::new(16_000, vec![0.25; 16_000 * 600]);
        let folder = tempfile::tempdir().unwrap();
        let before = peak();
        let file = sound_file(&folder.path().join("a.mp4"), &sound, &[(0, 1)], Rate::new(25.0).unwrap()).unwrap();
        let grown = peak() - before;
        assert_eq!(hound::WavReader::open(file.path()).unwrap().len(), 1920);
        assert!(grown < 40_000, "{grown} kB");
    }
}
