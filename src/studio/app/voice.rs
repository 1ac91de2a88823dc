//! Sound to hear, by a player program that is there: the clip while its syllables are tapped, and the clicks of a
//! measurement. Over a network the player would sound at the wrong end, so there is none.

use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::thread;

use crossbeam_channel::{Receiver, Sender, unbounded};
use tempfile::NamedTempFile;

use crate::disk::Program;
use crate::media::{Sound, write_wav};

/// Players that are known, the quickest to begin first, with what they are given before the file.
const PLAYERS: [(&str, &[&str]); 5] = [
    ("aplay", &["-q"]),
    ("paplay", &[]),
    ("afplay", &[]),
    ("play", &["-q"]),
    ("ffplay", &["-nodisp", "-autoexit", "-loglevel", "quiet"]),
];

/// As much of a recording is given to a player at once, in seconds: it has to be written before it begins.
const MOST: f64 = 300.0;

/// The window of the slowing down, in seconds: two or three periods of a low voice.
const WINDOW: f64 = 0.04;

/// A player, and the thread that feeds it. Dropping it makes it silent.
#[derive(Debug)]
pub(in crate::studio) struct Voice {
    orders: Sender<Order>,
}

#[derive(Debug)]
enum Order {
    Prepare { sound: Arc<Sound>, from: f64, speed: f64 },
    Play { sound: Arc<Sound>, from: f64, speed: f64 },
    Clicks(Vec<f64>),
    Silence,
}

impl Voice {
    /// The player of this computer; none where none is installed or the terminal is somewhere else.
    pub(crate) fn found() -> Option<Self> {
        let is_remote = ["SSH_CONNECTION", "SSH_TTY", "SSH_CLIENT"].iter().any(|v| std::env::var_os(v).is_some());
        if is_remote {
            return None;
        }
        PLAYERS.iter().find_map(|(name, options)| Some(Self::of(Program::find(name)?.path().to_owned(), options)))
    }

    fn of(program: PathBuf, options: &'static [&'static str]) -> Self {
        let (orders, taken) = unbounded();
        thread::spawn(move || serve(&program, options, &taken));
        Self { orders }
    }

    /// Makes ready what will be played next, so that it then begins at once.
    pub(crate) fn prepare(&self, sound: Arc<Sound>, from: f64, speed: f64) {
        self.order(Order::Prepare { sound, from, speed });
    }

    /// Plays a recording from a time in seconds on; at half speed its pitch stays.
    pub(crate) fn play(&self, sound: Arc<Sound>, from: f64, speed: f64) {
        self.order(Order::Play { sound, from, speed });
    }

    /// Plays clicks at times in seconds.
    pub(crate) fn click(&self, times: Vec<f64>) {
        self.order(Order::Clicks(times));
    }

    /// Stops what is heard.
    pub(crate) fn stop(&self) {
        self.order(Order::Silence);
    }

    fn order(&self, order: Order) {
        // A thread that has ended has no player to serve either.
        let _ = self.orders.send(order);
    }
}

/// Serves orders until nobody gives any. Each ends what is heard.
fn serve(program: &Path, options: &[&str], orders: &Receiver<Order>) {
    let mut playing: Option<(Child, NamedTempFile)> = None;
    let mut ready: Option<Ready> = None;
    let mut next = orders.recv().ok();
    while let Some(order) = next {
        if let Some((mut child, _file)) = playing.take() {
            let _ = child.kill();
            let _ = child.wait();
        }
        // Of several orders that wait the last one counts.
        let order = orders.try_iter().last().unwrap_or(order);
        let file = match order {
            Order::Prepare { sound, from, speed } => {
                if ready.as_ref().is_none_or(|r| r.from != from || !r.has(&sound, from, speed)) {
                    drop(ready.take());
                    ready = Some(Ready::of(sound, from, speed));
                }
                None
            }
            Order::Play { sound, from, speed } => {
                ready = ready.filter(|r| r.has(&sound, from, speed));
                ready.get_or_insert_with(|| Ready::of(sound, from, speed)).file_from(from)
            }
            Order::Clicks(times) => written(CLICK_RATE, &coded(&clicks(&times))),
            Order::Silence => None,
        };
        playing = file.and_then(|file| Some((begin(program, options, file.path())?, file)));
        next = orders.recv().ok();
    }
    if let Some((mut child, _file)) = playing {
        let _ = child.kill();
        let _ = child.wait();
    }
}

/// A recording made ready to be played, slowed down where it has to be: when the clock of the taps starts there is no
/// time left for that.
struct Ready {
    sound: Arc<Sound>,
    from: f64,
    speed: f64,
    /// Samples as they stand in the file.
    coded: Vec<i16>,
    /// The file of all of them, until it is played.
    file: Option<NamedTempFile>,
}

impl Ready {
    fn of(sound: Arc<Sound>, from: f64, speed: f64) -> Self {
        let coded = coded(&slowed(&sound, from, speed));
        let file = written(sound.rate, &coded);
        Self { sound, from, speed, coded, file }
    }

    /// Whether it has that sound at that speed from a time on, either to its end or for long.
    fn has(&self, sound: &Arc<Sound>, from: f64, speed: f64) -> bool {
        let until = self.from.max(0.0) + MOST;
        let is_enough = until >= sound.duration() || until - from >= MOST / 2.0;
        Arc::ptr_eq(&self.sound, sound) && self.speed == speed && self.from <= from && is_enough
    }

    /// The file to play from a time on.
    fn file_from(&mut self, from: f64) -> Option<NamedTempFile> {
        let whole = self.file.take();
        let skipped = ((from - self.from).max(0.0) / self.speed * f64::from(self.sound.rate)).round() as usize;
        if skipped == 0 && whole.is_some() {
            return whole;
        }
        written(self.sound.rate, self.coded.get(skipped..).unwrap_or_default())
    }
}

fn begin(program: &Path, options: &[&str], file: &Path) -> Option<Child> {
    let mut command = Command::new(program);
    command.args(options).arg(file);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().ok()
}

/// Samples of 16 bits.
fn coded(samples: &[f32]) -> Vec<i16> {
    samples.iter().map(|s| (s.clamp(-1.0, 1.0) * f32::from(i16::MAX)).round() as i16).collect()
}

/// A WAV file of samples; none where it cannot be written.
fn written(rate: u32, samples: &[i16]) -> Option<NamedTempFile> {
    let file = tempfile::Builder::new().prefix("lianpu-").suffix(".wav").tempfile().ok()?;
    write_wav(BufWriter::new(file.as_file()), rate, [samples]).ok()?;
    Some(file)
}

/// A recording from a time on; at half speed by overlapping windows that are put where they fit best (WSOLA: Verhelst
/// and Roelands 1993), so that the voice stays as high as it is.
fn slowed(sound: &Sound, from: f64, speed: f64) -> Vec<f32> {
    let rate = f64::from(sound.rate);
    let first = ((from.max(0.0) * rate) as usize).min(sound.samples.len());
    let last = (first + (MOST * rate) as usize).min(sound.samples.len());
    let samples = &sound.samples[first..last];
    if speed >= 1.0 {
        return samples.to_vec();
    }
    let hop = ((WINDOW / 2.0 * rate) as usize).max(1);
    let search = hop / 2;
    // Voices are told apart by what lies below 2 kHz, whatever the rate.
    let (apart, step_by) = ((sound.rate as usize / 4000).max(1), (sound.rate as usize / 8000).max(1));
    let length = (samples.len() as f64 / speed) as usize;
    let mut out = vec![0.0_f32; length + 2 * hop];
    let at = |i: usize| samples.get(i).copied().unwrap_or(0.0);
    let mut taken = 0_usize;
    for step in 0..length / hop {
        let ideal = (step as f64 * hop as f64 * speed) as usize;
        let source = if step == 0 {
            0
        } else {
            // What would go on by itself after the last window is what the next should be like.
            let natural = taken + hop;
            let likeness = |start: usize| (0..hop).step_by(apart).map(|i| at(natural + i) * at(start + i)).sum::<f32>();
            let candidates = (ideal.saturating_sub(search)..=ideal + search).step_by(step_by);
            let measured = candidates.map(|start| (likeness(start), start));
            measured.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(ideal, |(_, start)| start)
        };
        for i in 0..2 * hop {
            let window = 0.5 - 0.5 * (std::f32::consts::TAU * i as f32 / (2 * hop) as f32).cos();
            out[step * hop + i] += window * at(source + i);
        }
        taken = source;
    }
    out.truncate(length);
    out
}

const CLICK_RATE: u32 = 16_000;

/// Clicks of 20 ms.
fn clicks(times: &[f64]) -> Vec<f32> {
    let rate = f64::from(CLICK_RATE);
    let length = times.iter().copied().fold(0.0, f64::max) + 0.5;
    let mut samples = vec![0.0_f32; (length * rate) as usize];
    for time in times {
        let first = (time * rate) as usize;
        for (i, sample) in samples.iter_mut().skip(first).take(320).enumerate() {
            let fade = 1.0 - i as f32 / 320.0;
            *sample = 0.6 * fade * (i as f32 * 1000.0 * std::f32::consts::TAU / 16_000.0).sin();
        }
    }
    samples
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_speed_lasts_twice_as_long_and_is_as_high() {
        let tone: Vec<f32> = (0..16_000).map(|i| (i as f32 * 200.0 * std::f32::consts::TAU / 16_000.0).sin()).collect();
        let slow = slowed(&Sound::new(16_000, tone), 0.0, 0.5);
        assert_eq!(slow.len(), 32_000);
        let middle = &slow[4_000..28_000];
        let crossings = middle.windows(2).filter(|w| w[0] < 0.0 && w[1] >= 0.0).count();
        let hertz = crossings as f64 / (middle.len() as f64 / 16_000.0);
        assert!((hertz - 200.0).abs() < 4.0, "{hertz}");
        let loud = middle.iter().fold(0.0_f32, |m, s| m.max(s.abs()));
        assert!((0.8..1.2).contains(&loud), "{loud}");
    }

    #[test]
    fn a_player_is_given_a_whole_file_and_is_stopped_by_the_next_order() {
        let folder = tempfile::tempdir().unwrap();
        let (program, seen) = (folder.path().join("player"), folder.path().join("seen"));
        let text = format!("#!/bin/sh\nwc -c < \"$2\" >> '{}'\nexec sleep 60\n", seen.display());
        std::fs::write(&program, text).unwrap();
        let mut rights = std::fs::metadata(&program).unwrap().permissions();
        std::os::unix::fs::PermissionsExt::set_mode(&mut rights, 0o755);
        std::fs::set_permissions(&program, rights).unwrap();
        let voice = Voice::of(program, &["-q"]);
        let lines = || std::fs::read_to_string(&seen).unwrap_or_default().lines().count();
        let until = |many: usize| {
            let start = std::time::Instant::now();
            while lines() < many && start.elapsed().as_secs() < 10 {
                thread::sleep(std::time::Duration::from_millis(5));
            }
            assert_eq!(lines(), many);
        };
        voice.play(Arc::new(Sound::new(8000, vec![0.1; 8000])), 0.5, 1.0);
        until(1);
        voice.click(vec![0.1]);
        until(2);
        let sound = Arc::new(Sound::new(8000, vec![0.1; 8000]));
        voice.prepare(Arc::clone(&sound), 0.0, 0.5);
        thread::sleep(std::time::Duration::from_millis(50));
        assert_eq!(lines(), 2, "nothing is heard yet");
        voice.play(Arc::clone(&sound), 0.0, 0.5);
        until(3);
        voice.play(sound, 0.25, 0.5);
        until(4);
        voice.stop();
        let text = std::fs::read_to_string(&seen).unwrap();
        let sizes: Vec<usize> = text.lines().map(|l| l.trim().parse().unwrap()).collect();
        assert_eq!(sizes, [44 + 8000, 44 + 2 * 9600, 44 + 32_000, 44 + 24_000]);
    }
}
