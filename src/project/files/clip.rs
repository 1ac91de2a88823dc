//! A clip: what is said, when, with which emotions, and what its author set.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::label::label_reading;
use super::manifest::ClipEntry;
use super::names::{RATIOS, SCORE, SCRIPT, TIMES, TRACKS, sum_of};
use super::recordings::{sound_file, video_file};
use super::tiers::{OWN_TIERS, of_shapes, phones_of};
use crate::disk::{
    Fault, FileFault, Message, NextStep, Pending, Result, Setting, Sum, Task, inside, message, read_text,
};
use crate::media::Sound;
use crate::pose::MouthPreset;
use crate::project::ProjectFault;
use crate::ratios::{Record, Tracks};
use crate::script::{self, OnsetPreset, Pause, Syllable, System};
use crate::speech::Pin;
use crate::timeline::{Score, Sources, Spoken, Timeline};
use crate::timing::{self, Format, Interval, Tier, Timing};

/// A clip in memory. Edits change `timing` and `score`; the rest is as the files have it.
#[derive(Debug, Clone)]
pub struct Clip {
    /// Its entry in the manifest.
    pub entry: ClipEntry,
    /// Its folder.
    pub folder: PathBuf,
    /// What is said, as written; empty without a script.
    pub script: String,
    /// The script's syllables, readings of the timing's labels included.
    pub syllables: Vec<Syllable>,
    /// When they are said: one interval of the tier `syllables` each.
    pub timing: Timing,
    /// The recording.
    pub sound: Option<Arc<Sound>>,
    /// Where the recording is.
    pub sound_path: Option<PathBuf>,
    /// Where its video is: a folder of pictures, or a file.
    pub video: Option<PathBuf>,
    /// The ratio record.
    pub record: Option<Record>,
    /// Eyes, mouth and head from a video.
    pub tracks: Option<Tracks>,
    /// What the author set.
    pub score: Score,
    /// What is odd but not wrong, for the author to know.
    pub warnings: Vec<Message>,
    /// Sums of the files that saving writes, as they were read.
    pub(in crate::project) seen: Seen,
    /// Times and score as the files have them.
    pub(in crate::project) stored: (Timing, Score),
    /// The script's own syllables, before labels gave other readings.
    pub(in crate::project) plain: Vec<Syllable>,
    /// The script as its file has it, or as the labels of the timing gave it.
    pub(in crate::project) kept_script: String,
    /// Whether the labels of the times are the script, for want of another.
    pub(in crate::project) labels_are_script: bool,
    /// Whether an edit has changed what was found in the video since it was read or written.
    pub(in crate::project) footage_changed: bool,
    /// Length of the sound in seconds, 0 without one.
    sound_seconds: f64,
    /// Length of the video in seconds, 0 without one, and where a sound or a record says it.
    video_seconds: f64,
}

/// What the files that saving writes looked like when they were last read or written; none where there was none.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::project) struct Seen {
    pub(in crate::project) script: Option<Sum>,
    pub(in crate::project) timing: Option<Sum>,
    pub(in crate::project) score: Option<Sum>,
    pub(in crate::project) ratios: Option<Sum>,
    pub(in crate::project) tracks: Option<Sum>,
}

impl Clip {
    /// Reads a clip of the project in `root`, through the paths of `pending`.
    ///
    /// # Errors
    /// When one of its files is damaged, or the times do not fit the script.
    pub(crate) fn read(root: &Path, entry: &ClipEntry, pending: &Pending) -> Result<Self> {
        Self::read_as(root, entry, pending, None)
    }

    /// Reads a clip, with the text `before` in place of its script's where its times do not fit that: a save of an earlier
    /// version that was cut off leaves a new script beside old times.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub(in crate::project) fn read_before(
        root: &Path,
        entry: &ClipEntry,
        pending: &Pending,
        before: Option<&str>,
    ) -> Result<Self> {
        match (Self::read(root, entry, pending), before) {
            (Err(fault), Some(before)) => Self::read_as(root, entry, pending, Some(before)).map_err(|_| fault),
            (read, _) => read,
        }
    }

    /// Reads a clip with the text `instead` in place of its script's.
    fn read_as(root: &Path, entry: &ClipEntry, pending: &Pending, instead: Option<&str>) -> Result<Self> {
        let folder = inside(root, &format!("clips/{}", entry.name))?;
        if !folder.is_dir() {
            return Err(Fault::of(ProjectFault::Incomplete, format!("the clip `{}` has no folder", entry.name))
                .at(&folder)
                .help("make the folder with a script.txt and a speech.wav, or take the clip out of lianpu.toml"));
        }
        let file = |name: &str| -> Result<Option<PathBuf>> {
            let path = inside(root, &format!("clips/{}/{name}", entry.name))?;
            pending.at(&path)
        };
        let mut clip = Self {
            entry: entry.clone(),
            folder: folder.clone(),
            script: String::new(),
            syllables: Vec::new(),
            timing: Timing::default(),
            sound: None,
            sound_path: sound_file(root, &folder)?,
            video: video_file(root, &folder)?,
            record: None,
            tracks: None,
            score: Score::default(),
            warnings: Vec::new(),
            seen: Seen::default(),
            stored: (Timing::default(), Score::default()),
            plain: Vec::new(),
            kept_script: String::new(),
            labels_are_script: false,
            footage_changed: false,
            sound_seconds: 0.0,
            video_seconds: 0.0,
        };
        if let Some(path) = file(SCRIPT)? {
            clip.read_script(&path, instead)?;
        }
        if let Some(path) = &clip.sound_path {
            let sound = Sound::read(path)?;
            clip.warnings.extend(sound.warnings.iter().map(|w| Message::from(w.as_str())));
            clip.sound_seconds = sound.duration();
            clip.sound = Some(Arc::new(sound));
        }
        clip.read_ratios_and_score(&file)?;
        if clip.sound.is_none() && clip.record.is_none() {
            // A video that cannot be opened here, for want of ffmpeg, is no reason not to show the rest.
            match clip.source() {
                Ok(source) => clip.video_seconds = source.and_then(|s| s.duration()).unwrap_or(0.0),
                Err(fault) => clip.warnings.push(fault.to_message()),
            }
        }
        match file(TIMES)? {
            Some(path) => clip.read_times(&path)?,
            None => clip.guess(),
        }
        clip.read_labels();
        if instead.is_none() {
            clip.kept_script.clone_from(&clip.script);
        }
        if clip.duration() <= 0.0 {
            return Err(Fault::of(ProjectFault::Incomplete, format!("the clip `{}` has nothing in it", entry.name))
                .at(&folder)
                .help("put a speech.wav with its script.txt there, a timing.TextGrid, a ratios.csv, or a video"));
        }
        clip.stored = (clip.timing.clone(), clip.score.clone());
        Ok(clip)
    }

    /// Reads the script, and takes the text `instead` in its place.
    fn read_script(&mut self, path: &Path, instead: Option<&str>) -> Result<()> {
        let system = self.entry.script_system.unwrap_or(System::Auto);
        self.seen.script = sum_of(path);
        (self.script, self.plain) = read_script(path, system)?;
        self.kept_script.clone_from(&self.script);
        if let Some(before) = instead {
            self.plain = script::syllables(before, system).map_err(|f| f.at(path))?;
            before.clone_into(&mut self.script);
        }
        Ok(())
    }

    /// Reads the ratio record, the tracks and the score. `file` gives the path of a file that is there.
    fn read_ratios_and_score(&mut self, file: &dyn Fn(&str) -> Result<Option<PathBuf>>) -> Result<()> {
        // The sum first: a file that changes while it is read is not what it says.
        let text = |name: &str| -> Result<Option<(PathBuf, Option<Sum>, String)>> {
            file(name)?
                .map(|path| (sum_of(&path), path))
                .map(|(sum, path)| read_text(&path).map(|text| (path, sum, text)))
                .transpose()
        };
        let mut ratios = None;
        if let Some((path, sum, text)) = text(RATIOS)? {
            self.record = Some(Record::parse(&text).map_err(|f| f.at(&path))?);
            self.seen.ratios = sum;
            ratios = Some(text);
        }
        if let Some((path, sum, text)) = text(TRACKS)? {
            self.tracks = Some(Tracks::parse(&text).map_err(|f| f.at(&path))?);
            self.seen.tracks = sum;
        }
        if let Some((path, sum, text)) = text(SCORE)? {
            self.score = Score::parse(&text).map_err(|f| f.at(&path))?;
            self.seen.score = sum;
        }
        if let Some(ratios) = &ratios {
            self.disown(ratios);
        }
        Ok(())
    }

    /// Whether `ratios.csv` is still what tracking wrote: one that an author has changed is hers.
    fn disown(&mut self, ratios: &str) {
        let sum = format!("{:08x}", crc32fast::hash(ratios.as_bytes()));
        if self.score.tracked.as_ref().is_some_and(|t| !t.ends_with(&sum)) {
            self.score.tracked = None;
            let stays = "its ratios.csv was changed since the face was followed, and stays; ";
            self.warnings.push(message![stays, NextStep::from(Task::Track).and(Setting::Replace), " finds it anew"]);
        }
    }

    /// Reads the times; those of an older script are carried over to this one.
    fn read_times(&mut self, path: &Path) -> Result<()> {
        self.seen.timing = sum_of(path);
        let timing = timing::read(path)?;
        if self.is_of_an_older_script(&timing) {
            self.carry_over(timing);
            let changed = "the script has changed since its times were found: ";
            self.warnings.push(message![changed, Task::Align, " finds them anew"]);
        } else {
            self.take_timing(timing).map_err(|f| f.at(path))?;
            self.timing.guessed |= self.score.guessed;
        }
        Ok(())
    }

    /// Shares the sound among the syllables; tiers of something else stay.
    pub(in crate::project) fn guess(&mut self) {
        self.timing.tiers.retain(|t| !OWN_TIERS.contains(&t.name.as_str()));
        self.guess_beside();
    }

    /// The same beside tiers that somebody else made, whatever they are called.
    pub(in crate::project) fn guess_beside(&mut self) {
        let labels: Vec<String> = self.plain.iter().map(|s| s.text.clone()).collect();
        let duration = if self.sound_seconds > 0.0 { self.sound_seconds } else { 0.3 * labels.len() as f64 };
        let sounding = self.sound.as_deref().map(Sound::sounding).unwrap_or_default();
        self.timing.duration = self.timing.duration.max(duration);
        self.timing.guessed = !labels.is_empty();
        if !labels.is_empty() {
            self.timing.set_tier(timing::equal_shares(&sounding, &labels, duration));
        }
    }

    /// Takes the readings that labels give; called again when a label is edited.
    pub(in crate::project) fn read_labels(&mut self) {
        self.syllables = self.plain.clone();
        let intervals = self.timing.syllables().map(|t| t.intervals.as_slice()).unwrap_or_default();
        for (syllable, interval) in self.syllables.iter_mut().zip(intervals) {
            if let Some(reading) = label_reading(syllable, &interval.label) {
                *syllable = syllable.with_reading(&reading);
            }
        }
    }

    /// Whether its times are still to be found in its sound: they are guessed, or were found in another sound or for
    /// another script.
    #[must_use]
    pub fn wants_alignment(&self) -> bool {
        if self.sound.is_none() || self.syllables.is_empty() {
            return false;
        }
        let all_set = self.score.pins.len() >= self.syllables.len();
        // Without their script nobody can tell whether times are those of another one; they stay until asked for.
        let older = || !self.labels_are_script && self.found_for_another();
        !all_set && (self.timing.guessed || older())
    }

    /// Whether its times were found in another sound or for another script.
    pub(in crate::project) fn found_for_another(&self) -> bool {
        self.score.aligned.is_some() && self.score.aligned != self.fingerprint()
    }

    /// The syllables whose times are the author's.
    #[must_use]
    pub(crate) fn pins(&self) -> Vec<Pin> {
        let own = self.score.pins.iter().filter_map(|p| {
            let interval = self.intervals().get(*p)?;
            Some(Pin { syllable: *p, start: interval.start, end: interval.end })
        });
        own.filter(|p| p.syllable < self.syllables.len() && p.end > p.start).collect()
    }

    /// What the times were made from: a checksum of the sound and the script. None without a sound.
    pub(in crate::project) fn fingerprint(&self) -> Option<String> {
        let sound = self.sound.as_ref()?;
        let mut hash = crc32fast::Hasher::new();
        hash.update(&sound.rate.to_le_bytes());
        let mut bytes = Vec::with_capacity(4 << 12);
        for block in sound.samples.chunks(1 << 12) {
            bytes.clear();
            bytes.extend(block.iter().flat_map(|s| s.to_le_bytes()));
            hash.update(&bytes);
        }
        hash.update(self.script.trim().as_bytes());
        hash.update(format!("{:?}", self.entry.script_system).as_bytes());
        Some(format!("{:08x}", hash.finalize()))
    }

    /// The syllables' times, one for each.
    #[must_use]
    pub fn intervals(&self) -> &[Interval] {
        self.timing.syllables().map(|t| t.intervals.as_slice()).unwrap_or_default()
    }

    /// Length in seconds: the sound's, else the longest of times, record and keys.
    #[must_use]
    pub fn duration(&self) -> f64 {
        if self.sound_seconds > 0.0 {
            return self.sound_seconds;
        }
        let last_key = self.score.keys.iter().map(|k| k.time).fold(0.0, f64::max);
        let record = self.record.as_ref().map_or(0.0, Record::duration);
        self.timing.duration.max(record).max(last_key).max(self.video_seconds)
    }

    /// What is said as the timeline takes it: from the tier `shapes` where there is one, else from the syllables.
    #[must_use]
    pub(crate) fn spoken(&self, onsets: OnsetPreset) -> Vec<Spoken> {
        if let Some(tier) = self.timing.tier("shapes") {
            return of_shapes(tier);
        }
        let phones = self.timing.tier("phones");
        let spoken = |(syllable, interval): (&Syllable, &Interval)| {
            let times = phones.and_then(|tier| phones_of(tier, syllable, interval)).unwrap_or_default();
            let starts = script::onsets_in_phones(syllable, (interval.start, interval.end), &times, onsets);
            let shapes = starts.into_iter().zip(syllable.shapes.iter().copied()).collect();
            Spoken { start: interval.start, end: interval.end, shapes, exact: !times.is_empty() }
        };
        self.syllables.iter().zip(self.intervals()).map(spoken).collect()
    }

    /// How many syllables have the times of their phones, by names that are known.
    #[must_use]
    pub fn syllables_with_phones(&self) -> usize {
        let Some(tier) = self.timing.tier("phones") else { return 0 };
        let has = |(s, i): &(&Syllable, &Interval)| phones_of(tier, s, i).is_some();
        self.syllables.iter().zip(self.intervals()).filter(has).count()
    }

    /// What is said as an audience reads it: phrases as the script writes them, cut at its punctuation, at pauses, and
    /// where they get too long for a line.
    #[must_use]
    pub fn phrases(&self) -> Tier {
        const PAUSE: f64 = 0.25;
        const LONGEST: usize = 18;
        let said: Vec<(&Syllable, &Interval)> = self.syllables.iter().zip(self.intervals()).collect();
        let mut tier = Tier::new("phrases");
        let mut first = 0;
        for i in 0..said.len() {
            let next = said.get(i + 1);
            let too_long = i + 1 - first >= LONGEST;
            let breaks = next.is_none_or(|n| n.1.start - said[i].1.end > PAUSE)
                || said[i].0.pause_after != Pause::None
                || too_long;
            // The syllables of a number share its place in the script, which cannot be cut.
            let ends = breaks && next.is_none_or(|n| n.0.span.start > said[i].0.span.start);
            if ends {
                // With the punctuation that follows, without forced readings in braces.
                let upto = next.map_or(self.script.len(), |n| n.0.span.start);
                let text = self.script.get(said[first].0.span.start..upto).unwrap_or_default();
                let label = script::without_braces(text);
                tier.intervals.push(Interval::new(said[first].1.start, said[i].1.end, label));
                first = i + 1;
            }
        }
        tier
    }

    /// The clip's score, built.
    #[must_use]
    pub(crate) fn timeline(&self, fps: f64, mouths: MouthPreset) -> Timeline {
        let spoken = self.spoken(self.entry.onsets);
        Timeline::build(&Sources {
            duration: self.duration(),
            fps,
            spoken: &spoken,
            record: self.record.as_ref(),
            tracks: self.tracks.as_ref(),
            score: &self.score,
            mouths,
        })
    }
}

/// The text of a script and its syllables.
///
/// # Errors
/// When it cannot be read, or is a timing file and no script.
pub fn read_script(path: &Path, system: System) -> Result<(String, Vec<Syllable>)> {
    let text = read_text(path)?;
    if let Some(format @ (Format::TextGrid | Format::TextGridShort | Format::Srt | Format::WebVtt | Format::Csv)) =
        Format::sniff(text.as_bytes())
    {
        let what = format!("it holds times in the format {format}, and is no script");
        return Err(Fault::of(FileFault::Mismatch, what)
            .at(path)
            .help("give what is said as plain text; times are a file of their own"));
    }
    let syllables = script::syllables(&text, system).map_err(|f| f.at(path))?;
    Ok((text, syllables))
}
