//! Recordings whose times are known.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use lianpu::media::Sound;
use lianpu::script::{Syllable, System, syllables};
use lianpu::speech::{Alignment, Pin, Take, align};
use lianpu::timing;

use crate::support::test_data;

/// The start and end of each syllable, in seconds.
pub type Times = Vec<(f64, f64)>;

/// A recording, what is said in it, and when.
#[derive(Clone)]
pub struct Recording {
    pub name: String,
    pub sound: Sound,
    pub script: Vec<Syllable>,
    /// When each syllable of the script is spoken.
    pub truth: Times,
    /// Syllable, name as its maker has it, start, end.
    pub phones: Vec<(usize, String, f64, f64)>,
}

impl Recording {
    pub fn take(&self) -> Take<'_> {
        Take { sound: &self.sound, script: &self.script, pins: &[] }
    }

    pub fn aligned(&self) -> Alignment {
        self.with_pins(&[])
    }

    pub fn with_pins(&self, pins: &[Pin]) -> Alignment {
        let found = align(&[Take { pins, ..self.take() }]).remove(0);
        found.unwrap_or_else(|fault| panic!("{}: {fault}", self.name))
    }

    /// Where speech begins and ends.
    pub fn spoken(&self) -> (f64, f64) {
        (self.truth[0].0, self.truth[self.truth.len() - 1].1)
    }
}

pub fn script(labels: &[String]) -> Vec<Syllable> {
    let script = syllables(&labels.join(" "), System::Auto).unwrap();
    assert_eq!(script.len(), labels.len(), "{labels:?}");
    script
}

pub fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn seconds(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("{text:?} is no time"))
}

/// What a folder with `phones.csv` (file, syllable, pinyin, phone, start, end) holds, those files that are wanted.
fn with_phones(folder: &Path, wanted: impl Fn(&str) -> bool) -> Vec<Recording> {
    let mut files: BTreeMap<String, Vec<Vec<String>>> = BTreeMap::new();
    for row in rows(&folder.join("phones.csv")) {
        files.entry(row[0].clone()).or_default().push(row);
    }
    let files = files.into_iter().filter(|(name, _)| wanted(name));
    files
        .map(|(name, rows)| {
            let phones: Vec<(usize, String, f64, f64)> =
                rows.iter().map(|r| (r[1].parse().unwrap(), r[3].clone(), seconds(&r[4]), seconds(&r[5]))).collect();
            let mut truth: Vec<(f64, f64)> = Vec::new();
            let mut labels = Vec::new();
            for (row, (syllable, _, start, end)) in rows.iter().zip(&phones) {
                if truth.len() <= *syllable {
                    truth.push((*start, *end));
                    labels.push(row[2].clone());
                } else {
                    truth[*syllable].1 = *end;
                }
            }
            let sound = Sound::read(&folder.join(format!("{name}.wav"))).unwrap();
            Recording { name, sound, script: script(&labels), truth, phones }
        })
        .collect()
}

/// Sentences in espeak's voices: `ending` is that of the voice and speed, `m0_150`, `mf3_110`, `m0_150_snr20`.
pub fn espeak(ending: &str) -> Option<Vec<Recording>> {
    Some(with_phones(&test_data::find("speech/espeak")?, |name| name.ends_with(ending)))
}

/// Sentences in a voice of recorded syllables.
pub fn mbrola() -> Option<Vec<Recording>> {
    Some(with_phones(&test_data::find("speech/mbrola")?, |_| true))
}

/// People, aligned by another program: `htk` or `neural`.
pub fn real(source: &str) -> Option<Vec<Recording>> {
    let folder = test_data::find("speech/real")?;
    // Labels and times of each file.
    let mut files = BTreeMap::<String, (Vec<String>, Times)>::new();
    for row in rows(&folder.join("real_truth.csv")).iter().filter(|r| r[6] == source) {
        let (labels, truth) = files.entry(row[1].clone()).or_default();
        labels.push(row[3].clone());
        truth.push((seconds(&row[4]), seconds(&row[5])));
    }
    let made = files.into_iter().map(|(name, (labels, truth))| {
        let sound = Sound::read(&folder.join(&name)).unwrap();
        Recording { name, sound, script: script(&labels), truth, phones: Vec::new() }
    });
    Some(made.collect())
}

/// A reading whose pauses a person has marked; instead of syllables its truth has spans between pauses, each with its
/// first and last syllable.
pub fn reading() -> Option<(Recording, Vec<(usize, usize)>)> {
    let folder = test_data::find("speech/real")?;
    let labels: Vec<String> = rows(&folder.join("real_script.csv")).into_iter().map(|r| r[3].clone()).collect();
    let spans = rows(&folder.join("real_ipu.csv"));
    let ends = spans.iter().map(|r| (r[4].parse().unwrap(), r[5].parse().unwrap())).collect();
    let truth = spans.iter().map(|r| (seconds(&r[2]), seconds(&r[3]))).collect();
    let sound = Sound::read(&folder.join("f1_P8.wav")).unwrap();
    Some((Recording { name: "f1_P8".into(), sound, script: script(&labels), truth, phones: Vec::new() }, ends))
}

/// The real takes of one speaker, without truth.
pub fn own_voice() -> Option<Vec<Recording>> {
    let folder = test_data::find("speech/self")?;
    let mut files: Vec<PathBuf> = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().path()).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "lab"));
    files.sort();
    let read = files.into_iter().map(|file| {
        let script = syllables(&std::fs::read_to_string(&file).unwrap(), System::Hanyu).unwrap();
        let name = file.file_stem().unwrap().to_string_lossy().into_owned();
        Recording {
            name,
            sound: Sound::read(&file.with_extension("wav")).unwrap(),
            script,
            truth: Vec::new(),
            phones: Vec::new(),
        }
    });
    Some(read.collect())
}

/// English sentences, words marked by hand.
pub fn english() -> Option<Vec<Recording>> {
    let folder = test_data::find("speech/english")?;
    let mut out = Vec::new();
    for (name, grid) in [("bobby", "bobby_words"), ("mary", "mary")] {
        let timing = timing::read(&folder.join(format!("{grid}.TextGrid"))).unwrap();
        let words: Vec<_> = timing.tier("word").unwrap().spoken().cloned().collect();
        out.push(Recording {
            name: name.into(),
            sound: Sound::read(&folder.join(format!("{name}.wav"))).unwrap(),
            script: script(&words.iter().map(|w| w.label.to_lowercase()).collect::<Vec<_>>()),
            truth: words.iter().map(|w| (w.start, w.end)).collect(),
            phones: Vec::new(),
        });
    }
    // Its phones are marked, its words only by a point: the phones of each word are counted off.
    let name = "the_north_wind_and_the_sun";
    let timing = timing::read(&folder.join(format!("{name}.TextGrid"))).unwrap();
    let phones: Vec<_> = timing.tier("phonemes").unwrap().spoken().cloned().collect();
    let counts = [("the", 2), ("north", 3), ("wind", 4), ("and", 2), ("the", 1), ("sun", 3)];
    let mut at = 0;
    let truth = counts.map(|(_, count)| {
        at += count;
        (phones[at - count].start, phones[at - 1].end)
    });
    assert_eq!(at, phones.len());
    out.push(Recording {
        name: name.into(),
        sound: Sound::read(&folder.join(format!("{name}.wav"))).unwrap(),
        script: script(&counts.map(|(word, _)| word.to_owned())),
        truth: truth.to_vec(),
        phones: Vec::new(),
    });
    Some(out)
}
