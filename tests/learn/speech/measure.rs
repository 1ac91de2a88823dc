//! How well recordings with known times are aligned.

use std::collections::BTreeMap;
use std::path::Path;

use lianpu::media::Sound;
use lianpu::script::{Syllable, System, syllables};
use lianpu::speech::training::{Model, works};
use lianpu::speech::{Alignment, Take};

use crate::chance::Chance;
use crate::corpus;

/// Errors of boundaries, in seconds.
#[derive(Default)]
pub struct Errors(pub Vec<f64>);

impl Errors {
    /// A boundary anywhere in a gap of less than 80 ms is right.
    pub fn add(&mut self, truth: &[(f64, f64)], found: &[(f64, f64)]) {
        for (i, (t, f)) in truth.iter().zip(found).enumerate() {
            let before = i.checked_sub(1).map(|j| truth[j].1).filter(|b| t.0 - b < 0.08);
            let after = truth.get(i + 1).map(|n| n.0).filter(|a| a - t.1 < 0.08);
            let off = |x: f64, low: f64, high: f64| (low - x).max(x - high).max(0.0);
            self.0.push(off(f.0, before.unwrap_or(t.0).min(t.0), t.0));
            self.0.push(off(f.1, t.1, after.unwrap_or(t.1).max(t.1)));
        }
    }

    /// Whether both boundaries of each syllable are right within 50 ms.
    pub fn right(&self) -> Vec<bool> {
        self.0.chunks(2).map(|e| e.iter().all(|e| *e <= 0.05)).collect()
    }

    pub fn print(&self, name: &str) {
        let n = self.0.len().max(1) as f64;
        let within = |limit: f64| self.0.iter().filter(|e| **e <= limit).count() as f64 / n * 100.0;
        println!(
            "{name:22} {:4}  mean {:5.1} ms  20 ms {:5.1} %  50 ms {:5.1} %  100 ms {:5.1} %  worst {:.0}",
            self.0.len(),
            self.0.iter().sum::<f64>() / n * 1000.0,
            within(0.020),
            within(0.050),
            within(0.100),
            self.0.iter().copied().fold(0.0, f64::max) * 1000.0
        );
    }
}

fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|l| l.split(',').map(str::to_owned).collect()).collect()
}

pub fn script(labels: &[String], system: System) -> Vec<Syllable> {
    labels.iter().flat_map(|l| syllables(l, system).unwrap()).collect()
}

fn times(alignment: &Alignment) -> Vec<(f64, f64)> {
    alignment.syllables.iter().map(|s| (s.start, s.end)).collect()
}

fn run(model: &Model, name: &str, sound: &Sound, script: &[Syllable]) -> Option<Alignment> {
    match works(model, &[Take { sound, script, pins: &[] }]).pop().unwrap() {
        Ok(work) => {
            let a = work.alignment(model);
            if std::env::var("INFO").is_ok() {
                println!(
                    "{name}: snr {:.1} fit {:.3} sense {:.2} missing {}",
                    work.heard.snr,
                    work.fit,
                    work.sense,
                    a.syllables.iter().filter(|s| !s.heard).count()
                );
            }
            for note in a.notes.iter().filter(|n| !matches!(n, lianpu::speech::Note::Noisy { .. })) {
                println!("{name}: {note}");
            }
            Some(a)
        }
        Err(fault) => {
            println!("{name}: {fault}");
            None
        }
    }
}

pub fn all(model: &Model, data: &Path, which: &[String]) {
    let asked = |name: &str| which.is_empty() || which.iter().any(|w| w == name);
    if asked("mbrola") {
        synthetic(model, &data.join("mbrola"), "mbrola", |_| true, None);
    }
    if asked("real") {
        real(model, &data.join("real"));
    }
    if which.iter().any(|w| w.starts_with("wrong:")) {
        for set in which.iter().filter(|w| w.starts_with("wrong:")).map(|w| &w[6..]) {
            wrong(model, &data.join(set));
        }
    }
    if asked("english") {
        english(model, &data.join("english"));
    }
    if asked("espeak") {
        synthetic(model, &data.join("espeak"), "espeak clean", |n| !n.contains("snr"), None);
        synthetic(model, &data.join("espeak"), "espeak 20 dB", |n| n.contains("snr20"), None);
        synthetic(model, &data.join("espeak"), "espeak 10 dB", |n| !n.contains("snr"), Some(10.0));
    }
    for folder in which.iter().filter(|w| w.starts_with("tests:")) {
        let folder = Path::new(&folder[6..]);
        synthetic(model, folder, "tests clean", |n| !n.contains("snr"), None);
        synthetic(model, folder, "tests 20 dB", |n| n.contains("snr20"), None);
        synthetic(model, folder, "tests 10 dB", |n| n.contains("snr10"), None);
    }
    for folder in which.iter().filter(|w| w.starts_with("parted:")) {
        parted(model, Path::new(&folder[7..]));
    }
    for folder in which.iter().filter(|w| w.starts_with('/')) {
        held(model, Path::new(folder));
    }
}

/// A corpus of the same kind as what was learned from, clean and changed.
fn held(model: &Model, folder: &Path) {
    let (mut clean, mut changed) = (Errors::default(), Errors::default());
    let mut sure: [Vec<f64>; 2] = Default::default();
    for (number, told) in corpus::read(folder).iter().enumerate() {
        if let Some(a) = run(model, &told.name, &told.sound, &told.script) {
            clean.add(&told.times, &times(&a));
            sure[0].extend(a.syllables.iter().map(|s| s.confidence));
        }
        let other = corpus::changed(told, &mut Chance(77_000 + number as u64), 60.0, 15.0);
        if let Some(a) = run(model, &told.name, &Sound::new(16_000, other.samples), &told.script) {
            let truth: Vec<_> = told.times.iter().map(|t| (t.0 * other.slower, t.1 * other.slower)).collect();
            changed.add(&truth, &times(&a));
            sure[1].extend(a.syllables.iter().map(|s| s.confidence));
        }
    }
    let name = folder.file_name().unwrap().to_string_lossy();
    table(&sure[0], &clean.right());
    table(&sure[1], &changed.right());
    clean.print(&format!("{name} clean"));
    changed.print(&format!("{name} changed"));
}

fn synthetic(model: &Model, folder: &Path, name: &str, which: impl Fn(&str) -> bool, snr: Option<f64>) {
    let mut files: BTreeMap<String, Vec<(String, String, f64, f64)>> = BTreeMap::new();
    for row in rows(&folder.join("phones.csv")) {
        if which(&row[0]) {
            let entry = files.entry(row[0].clone()).or_default();
            entry.push((
                format!("{} {}", row[1], row[2]),
                row[3].clone(),
                row[4].parse().unwrap(),
                row[5].parse().unwrap(),
            ));
        }
    }
    let (mut errors, mut lips) = (Errors::default(), Errors::default());
    let mut sure: Vec<f64> = Vec::new();
    let mut takes = Vec::new();
    for (file, phones) in files {
        let mut truth: Vec<(String, f64, f64)> = Vec::new();
        let mut closed: Vec<f64> = Vec::new();
        for (syllable, phone, start, end) in &phones {
            let first = truth.last().is_none_or(|t| t.0 != *syllable);
            if first {
                truth.push((syllable.clone(), *start, *end));
            } else if let Some(t) = truth.last_mut() {
                t.2 = *end;
            }
            if first && phone.starts_with(['b', 'p', 'm']) {
                closed.push(*start);
            }
        }
        let labels: Vec<String> = truth.iter().map(|t| t.0.split(' ').nth(1).unwrap().to_owned()).collect();
        let mut sound = Sound::read(&folder.join(format!("{file}.wav"))).unwrap();
        if let Some(snr) = snr {
            let voiced: Vec<f32> = sound.samples.iter().copied().filter(|s| s.abs() > 1e-3).collect();
            let level = (voiced.iter().map(|s| f64::from(s * s)).sum::<f64>() / voiced.len() as f64).sqrt();
            corpus::noise(&mut sound.samples, level * 10_f64.powf(-snr / 20.0), &mut Chance(file.len() as u64));
        }
        let script = script(&labels, System::Hanyu);
        takes.push((file, truth, closed, sound, script));
    }
    let pooled: Vec<_> = if std::env::var("POOL").is_ok() {
        let all: Vec<Take> = takes.iter().map(|t| Take { sound: &t.3, script: &t.4, pins: &[] }).collect();
        works(model, &all).into_iter().map(|w| Some(w.unwrap().alignment(model))).collect()
    } else {
        takes.iter().map(|t| run(model, &t.0, &t.3, &t.4)).collect()
    };
    for ((file, truth, closed, ..), a) in takes.iter().zip(pooled) {
        let Some(a) = a else { continue };
        errors.add(&truth.iter().map(|t| (t.1, t.2)).collect::<Vec<_>>(), &times(&a));
        sure.extend(a.syllables.iter().map(|s| s.confidence));
        if std::env::var("SHOW").is_ok() {
            for (t, s) in truth.iter().zip(&a.syllables) {
                let phones: Vec<String> = s.phones.iter().map(|p| format!("{} {:.3}", p.phone, p.start)).collect();
                println!(
                    "{file} {:9} {:.3} {:+4.0}   {:.3} {:+4.0}  {}",
                    t.0,
                    t.1,
                    (s.start - t.1) * 1000.0,
                    t.2,
                    (s.end - t.2) * 1000.0,
                    phones.join(", ")
                );
            }
        }
        let found: Vec<f64> = a
            .syllables
            .iter()
            .filter_map(|s| s.phones.first())
            .filter(|p| matches!(p.phone, "b" | "p" | "m"))
            .map(|p| p.start)
            .collect();
        assert_eq!(found.len(), closed.len(), "{file}");
        lips.0.extend(found.iter().zip(closed).map(|(a, b)| (a - b).abs()));
    }
    errors.print(name);
    table(&sure, &errors.right());
    let near = lips.0.iter().filter(|e| **e <= 0.04).count();
    println!("{name:22} lips: {near} of {} within 40 ms", lips.0.len());
}

fn real(model: &Model, folder: &Path) {
    let truth = rows(&folder.join("real_truth.csv"));
    for (name, wav) in [("htk test_16000", "test_16000.wav"), ("neural SSB0005", "SSB00050015_16k.wav")] {
        let own: Vec<&Vec<String>> = truth.iter().filter(|r| r[1] == wav).collect();
        let labels: Vec<String> = own.iter().map(|r| r[3].clone()).collect();
        let times_of: Vec<(f64, f64)> = own.iter().map(|r| (r[4].parse().unwrap(), r[5].parse().unwrap())).collect();
        let sound = Sound::read(&folder.join(wav)).unwrap();
        let Some(a) = run(model, wav, &sound, &script(&labels, System::Hanyu)) else { continue };
        let found = times(&a);
        let mut errors = Errors::default();
        if name.starts_with("neural") {
            let mut off: Vec<f64> = times_of.iter().zip(&found).flat_map(|(t, f)| [f.0 - t.0, f.1 - t.1]).collect();
            off.sort_by(f64::total_cmp);
            let middle = off[off.len() / 2];
            println!("{name}: offset {:.0} ms", middle * 1000.0);
            errors.add(&times_of, &found.iter().map(|f| (f.0 - middle, f.1 - middle)).collect::<Vec<_>>());
        } else {
            errors.add(&times_of, &found);
        }
        errors.print(name);
        if std::env::var("SHOW").is_ok() {
            for ((l, t), f) in labels.iter().zip(&times_of).zip(&found) {
                println!(
                    "{l:8} {:.2} {:.3} {:+.0}   {:.2} {:.3} {:+.0}",
                    t.0,
                    f.0,
                    (f.0 - t.0) * 1000.0,
                    t.1,
                    f.1,
                    (f.1 - t.1) * 1000.0
                );
            }
        }
    }
    let labels: Vec<String> = rows(&folder.join("real_script.csv")).iter().map(|r| r[3].clone()).collect();
    let sound = Sound::read(&folder.join("f1_P8.wav")).unwrap();
    let Some(a) = run(model, "f1_P8", &sound, &script(&labels, System::Hanyu)) else { return };
    let mut errors = Errors::default();
    for row in rows(&folder.join("real_ipu.csv")) {
        let number = |i: usize| row[i].parse::<usize>().unwrap();
        let (start, end): (f64, f64) = (row[2].parse().unwrap(), row[3].parse().unwrap());
        let (s, e) = (a.syllables[number(4)].start - start, a.syllables[number(5)].end - end);
        errors.0.extend([s.abs(), e.abs()]);
        if std::env::var("SHOW").is_ok() {
            println!("f1_P8 {start:.2} {:+.0}  {end:.2} {:+.0}", s * 1000.0, e * 1000.0);
        }
    }
    errors.print("f1_P8 pauses");
}

fn english(model: &Model, folder: &Path) {
    let mut errors = Errors::default();
    for (wav, grid) in
        [("mary", "mary"), ("bobby", "bobby_words"), ("the_north_wind_and_the_sun", "the_north_wind_and_the_sun")]
    {
        let text = std::fs::read_to_string(folder.join(format!("{grid}.TextGrid"))).unwrap();
        let words = words(&text);
        if words.is_empty() {
            println!("{wav}: no tier of words is read");
            continue;
        }
        let labels: Vec<String> = words.iter().map(|w| w.0.clone()).collect();
        let sound = Sound::read(&folder.join(format!("{wav}.wav"))).unwrap();
        let Some(a) = run(model, wav, &sound, &script(&labels, System::English)) else { continue };
        let truth: Vec<(f64, f64)> = words.iter().map(|w| (w.1, w.2)).collect();
        if std::env::var("SHOW").is_ok() {
            for ((l, t), f) in labels.iter().zip(&truth).zip(times(&a)) {
                println!(
                    "{l:8} {:.3} {:.3} {:+.0}   {:.3} {:.3} {:+.0}",
                    t.0,
                    f.0,
                    (f.0 - t.0) * 1000.0,
                    t.1,
                    f.1,
                    (f.1 - t.1) * 1000.0
                );
            }
        }
        errors.add(&truth, &times(&a));
    }
    errors.print("english words");
}

/// The labelled intervals of the tier `word` (or `words`, or the only one), of a TextGrid long or short.
fn words(text: &str) -> Vec<(String, f64, f64)> {
    let values: Vec<String> = text
        .lines()
        .map(|l| l.split_once('=').map_or(l, |(_, v)| v).trim().to_owned())
        .filter(|l| !l.is_empty() && !l.ends_with("[]:"))
        .collect();
    let names = ["\"word\"", "\"words\"", "\"Word\"", "\"ORT-MAU\"", "\"sentence\""];
    let Some(at) = values.iter().position(|v| names.contains(&v.as_str())) else { return Vec::new() };
    let mut rest = values[at + 1..].iter().filter(|v| !v.starts_with("intervals [")).skip(2);
    let count: usize = rest.next().and_then(|v| v.parse().ok()).unwrap_or(0);
    let mut out = Vec::new();
    for _ in 0..count {
        let (Some(a), Some(b), Some(label)) = (rest.next(), rest.next(), rest.next()) else { break };
        let label = label.trim_matches('"').to_owned();
        if !label.is_empty() {
            out.push((label, a.parse().unwrap_or(0.0), b.parse().unwrap_or(0.0)));
        }
    }
    out
}

/// Scripts that are not quite, or not at all, what is said.
pub fn parted(model: &Model, folder: &Path) {
    let all = corpus::read(folder);
    let number = all.len();
    let (mut quiet, mut doubted, mut noted) = ([0; 4], [0; 4], [0; 4]);
    let mut errors = [(); 4].map(|()| Errors::default());
    let mut fits: [Vec<f32>; 4] = Default::default();
    let mut where_off = [0; 4];
    for (n, told) in all.iter().enumerate() {
        let mut chance = Chance(991 + n as u64);
        let other = corpus::changed(told, &mut chance, 60.0, 15.0);
        let sound = Sound::new(16_000, other.samples);
        let times_of: Vec<_> = told.times.iter().map(|t| (t.0 * other.slower, t.1 * other.slower)).collect();
        let foreign = &all[(n + 7) % number].script;
        let count = told.script.len();
        let at = chance.below(count);
        for kind in 0..4 {
            let mut script = told.script.clone();
            let mut truth: Vec<Option<(f64, f64)>> = times_of.iter().copied().map(Some).collect();
            match kind {
                1 => {
                    script.remove(at);
                    truth.remove(at);
                }
                2 => {
                    script.insert(at, foreign[at % foreign.len()].clone());
                    truth.insert(at, None);
                }
                3 => {
                    script = (0..count).map(|i| foreign[i % foreign.len()].clone()).collect();
                }
                _ => {}
            }
            if script.is_empty() {
                continue;
            }
            let Ok(work) = works(model, &[Take { sound: &sound, script: &script, pins: &[] }]).pop().unwrap() else {
                continue;
            };
            let a = work.alignment(model);
            fits[kind].push(work.sense);
            if std::env::var("INFO").is_ok() {
                println!(
                    "kind {kind} count {} fit {:.2} sense {:.2} missing {:.2}",
                    script.len(),
                    work.fit,
                    work.sense,
                    a.syllables.iter().filter(|s| !s.heard).count() as f64 / script.len() as f64
                );
            }
            if a.notes.contains(&lianpu::speech::Note::Doubtful) {
                doubted[kind] += 1;
            }
            let right = a.notes.iter().any(|note| match (kind, note) {
                (1, lianpu::speech::Note::NotInScript { before, .. }) => before.abs_diff(at) <= 1,
                (2, lianpu::speech::Note::NotHeard { first, .. }) => first.abs_diff(at) <= 1,
                _ => false,
            });
            where_off[kind] += usize::from(right);
            let any = a
                .notes
                .iter()
                .any(|n| !matches!(n, lianpu::speech::Note::Noisy { .. } | lianpu::speech::Note::Doubtful));
            noted[kind] += usize::from(any);
            quiet[kind] += 1;
            let (t, f): (Vec<_>, Vec<_>) = truth.iter().zip(times(&a)).filter_map(|(t, f)| Some(((*t)?, f))).unzip();
            errors[kind].add(&t, &f);
        }
    }
    for (kind, name) in
        ["right script", "word left out of it", "word too many in it", "another script"].iter().enumerate()
    {
        fits[kind].sort_by(f32::total_cmp);
        let of = |q: f64| fits[kind][((fits[kind].len() - 1) as f64 * q) as usize];
        println!(
            "{name}: of {} parted {} (right place {}) doubted {}; fit {:.2} {:.2} {:.2} {:.2} {:.2}",
            quiet[kind],
            noted[kind],
            where_off[kind],
            doubted[kind],
            of(0.0),
            of(0.02),
            of(0.5),
            of(0.98),
            of(1.0)
        );
        errors[kind].print(name);
    }
}

/// Every recording of a folder with the scripts of the others.
fn wrong(model: &Model, folder: &Path) {
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .flatten()
        .map(|e| e.path())
        .filter(|p| p.extension().is_some_and(|e| e == "lab"))
        .collect();
    files.sort();
    let scripts: Vec<Vec<Syllable>> = files
        .iter()
        .map(|f| syllables(&std::fs::read_to_string(f).unwrap(), System::Hanyu).unwrap_or_default())
        .collect();
    for (n, file) in files.iter().enumerate() {
        let Ok(sound) = Sound::read(&file.with_extension("wav")) else { continue };
        for (other, script) in scripts.iter().enumerate() {
            if !script.is_empty() {
                println!("{} {} {}", if n == other { "right" } else { "wrong" }, n, script.len());
                run(model, &file.file_stem().unwrap().to_string_lossy(), &sound, script);
            }
        }
    }
}

/// Of syllables with about such a confidence, how many are right.
pub fn table(sure: &[f64], right: &[bool]) {
    if std::env::var("TABLE").is_err() {
        return;
    }
    for (low, high) in
        [(0.0, 0.3), (0.3, 0.5), (0.5, 0.7), (0.7, 0.8), (0.8, 0.9), (0.9, 0.95), (0.95, 0.98), (0.98, 1.01)]
    {
        let own: Vec<(f64, bool)> =
            sure.iter().copied().zip(right.iter().copied()).filter(|(s, _)| (low..high).contains(s)).collect();
        let n = own.len().max(1) as f64;
        println!(
            "  said {low:.2} to {high:.2}: {:5} syllables, said {:.3}, right {:.3}",
            own.len(),
            own.iter().map(|o| o.0).sum::<f64>() / n,
            own.iter().filter(|o| o.1).count() as f64 / n
        );
    }
}
