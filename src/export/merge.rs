//! The parts of an export joined: every file that was asked for must be there, once, as it was written.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::aside::set_manifest_aside;
use super::manifest::{Entry, Manifest};
use super::{ExportFault, Shard, divide};
use crate::disk::{self, Fault, Message, Result, Setting, Task, clear_temporaries, message};

/// What joining found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Merged {
    /// The manifest of the whole, on disk.
    pub path: PathBuf,
    /// How many parts there were; 1 where the export was not divided.
    pub parts: u32,
    /// Files, all of them there and right.
    pub files: usize,
    /// Their length.
    pub bytes: u64,
    /// A file of somebody else's that had the manifest's name and was set aside, for the author to know.
    pub note: Option<String>,
}

/// Joins the manifests of the parts in `folder`, checks every file, and writes the manifest of the whole. Where the whole
/// is there already and no parts are, its files are checked. Run again, it does the same.
///
/// # Errors
/// When a part is missing or was made with other settings, a file is missing, damaged, in no part, or in two that
/// differ: with the part to be run again.
pub fn merge(folder: &Path) -> Result<Merged> {
    let found = parts_in(folder)?;
    if found.is_empty() {
        let path = folder.join(Manifest::name(Shard::WHOLE));
        if !path.is_file() {
            return Err(Fault::of(ExportFault::Manifest, "there is no manifest of an export here").at(folder).help(
                message![
                    "give the folder that ",
                    Task::Export.with(Setting::Shard, "I/N"),
                    " wrote into, once its parts are done"
                ],
            ));
        }
        let whole = Manifest::read(&path)?;
        check_asked(folder, &whole, &whole.files, 1)?;
        check_files(folder, &whole.files, |_| None)?;
        return Ok(done(path, 1, &whole));
    }
    let parts = all_parts(folder, found)?;
    let count = parts.len() as u32;
    let (files, owners) = joined(folder, &parts)?;
    check_asked(folder, &parts[0], &files, count)?;
    check_files(folder, &files, |path| owners.get(path).and_then(|index| Shard::new(*index, count)))?;
    let mut whole = Manifest::new(Shard::WHOLE, parts[0].clips.clone(), files);
    whole.program.clone_from(&parts[0].program);
    // Forms that were exported here before and are still there.
    if let Ok(earlier) = Manifest::read(&folder.join(Manifest::name(Shard::WHOLE))) {
        whole = whole.beside(earlier, folder);
    }
    clear_temporaries(folder);
    let note = set_manifest_aside(folder, Shard::WHOLE)?;
    let path = whole.write(folder)?;
    Ok(Merged { note, ..done(path, count, &whole) })
}

fn done(path: PathBuf, parts: u32, whole: &Manifest) -> Merged {
    Merged { path, parts, files: whole.files.len(), bytes: whole.files.iter().map(|f| f.bytes).sum(), note: None }
}

/// The manifests of parts in a folder, in the order of their names.
pub(super) fn parts_in(folder: &Path) -> Result<Vec<(PathBuf, Manifest)>> {
    let paths = disk::list(folder).map_err(|e| {
        Fault::io("cannot list the folder", folder, e).help("give the folder that the parts were exported into")
    })?;
    let is_part = |path: &PathBuf| {
        let name = path.file_name().and_then(|n| n.to_str()).unwrap_or_default();
        name.starts_with("manifest-") && name.ends_with(".json") && name.contains("-of-")
    };
    paths.into_iter().filter(is_part).map(|path| Manifest::read(&path).map(|manifest| (path, manifest))).collect()
}

/// The advice to do a part again.
fn again(shard: Shard) -> Message {
    message!["run the same export with ", Setting::Shard.of(shard.to_string()), ", then merge again"]
}

/// The parts by their numbers, all of them, all of one export.
fn all_parts(folder: &Path, found: Vec<(PathBuf, Manifest)>) -> Result<Vec<Manifest>> {
    let mut count = None;
    let mut parts: BTreeMap<u32, (PathBuf, Manifest)> = BTreeMap::new();
    for (path, manifest) in found {
        let shard = manifest.part()?;
        let name = Manifest::name(shard);
        if path.file_name().is_none_or(|n| n != name.as_str()) {
            return Err(Fault::of(
                ExportFault::Manifest,
                format!("the manifest says that it is part {shard}, which its name does not"),
            )
            .at(&path)
            .help("remove it; its part says so if it has to be run again"));
        }
        if *count.get_or_insert(shard.count()) != shard.count() {
            let other = count.unwrap_or_default();
            return Err(Fault::of(ExportFault::Parts, format!("parts of two exports are mixed: of {other} and of {}", shard.count()))
                .at(&path)
                .help(format!(
                    "remove the older ones' manifests, `manifest-*-of-{other}.json` or `manifest-*-of-{}.json`; frames that \
                     both have stay as they are",
                    shard.count()
                )));
        }
        parts.insert(shard.index(), (path, manifest));
    }
    let count = count.unwrap_or(1);
    let missing: Vec<Shard> =
        (1..=count).filter(|i| !parts.contains_key(i)).filter_map(|i| Shard::new(i, count)).collect();
    if let [first, ..] = missing[..] {
        let names: Vec<String> = missing.iter().take(20).map(Shard::to_string).collect();
        let more = if missing.len() > 20 { format!(" and {} more", missing.len() - 20) } else { String::new() };
        let (noun, verb) = if missing.len() == 1 { ("part", "is") } else { ("parts", "are") };
        return Err(Fault::of(
            ExportFault::Parts,
            format!("{noun} {}{more} of the export {verb} missing or not done", names.join(", ")),
        )
        .at(folder)
        .help(again(first)));
    }
    let mut parts = parts.into_values();
    let Some((first_path, first)) = parts.next() else { return Ok(Vec::new()) };
    let mut all = vec![first];
    for (path, part) in parts {
        let first = &all[0];
        let differs = if part.program != first.program {
            Some(format!("{} and {}", first.program, part.program))
        } else {
            (part.clips != first.clips).then(|| difference(first, &part))
        };
        if let Some(what) = differs {
            let shard = part.part()?;
            let name = first_path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
            return Err(Fault::of(
                ExportFault::Parts,
                format!("part {shard} is of another export than `{name}`: {what}"),
            )
            .at(path)
            .help(format!("where the first is right, {}", again(shard))));
        }
        all.push(part);
    }
    Ok(all)
}

/// In what two parts' ideas of the whole differ.
fn difference(first: &Manifest, other: &Manifest) -> String {
    if first.clips.len() != other.clips.len() {
        return format!("{} clips and {}", first.clips.len(), other.clips.len());
    }
    let Some((a, b)) = first.clips.iter().zip(&other.clips).find(|(a, b)| a != b) else { return String::new() };
    if (&a.project, &a.clip) != (&b.project, &b.clip) {
        return format!("clip {} of {} and clip {} of {}", a.clip, a.project, b.clip, b.project);
    }
    let setting = a.settings.iter().find(|(k, v)| b.settings.get(*k) != Some(v));
    let what = match setting {
        Some((name, value)) => {
            format!("{name} {value} and {}", b.settings.get(name).map_or("another", String::as_str))
        }
        None if a.frames != b.frames => format!("{} frames and {}", a.count(), b.count()),
        None => "other forms".into(),
    };
    format!("clip {} of {} has {what}", a.clip, a.project)
}

/// All files, by path, and which part has which. Two parts may have the same file where it is the same.
fn joined(folder: &Path, parts: &[Manifest]) -> Result<(Vec<Entry>, BTreeMap<String, u32>)> {
    let mut files: BTreeMap<&str, (u32, &Entry)> = BTreeMap::new();
    for (index, part) in (1..).zip(parts) {
        for entry in &part.files {
            let (other, before) = *files.entry(&entry.path).or_insert((index, entry));
            if (before.bytes, &before.sha256) != (entry.bytes, &entry.sha256) {
                let count = parts.len();
                let shard = part.part()?;
                return Err(Fault::of(
                    ExportFault::Parts,
                    format!("parts {other}/{count} and {shard} wrote it, each in another way"),
                )
                .at(folder.join(&entry.path))
                .help(again(shard)));
            }
        }
    }
    let owners = files.iter().map(|(path, (index, _))| ((*path).to_owned(), *index)).collect();
    Ok((files.into_values().map(|(_, entry)| entry.clone()).collect(), owners))
}

/// That every file that was asked for is in some part.
fn check_asked(folder: &Path, first: &Manifest, files: &[Entry], count: u32) -> Result<()> {
    let has = |path: &str| files.binary_search_by(|e| e.path.as_str().cmp(path)).is_ok();
    let counts: Vec<u32> = first.clips.iter().map(super::Asked::count).collect();
    for (clip, asked) in first.clips.iter().enumerate() {
        for (place, path) in asked.files() {
            if has(&path) {
                continue;
            }
            let is_whole = asked.whole.contains(&path);
            let owns = |shard: &Shard| {
                let share = &divide(&counts, *shard)[clip];
                if is_whole { share.whole_files } else { share.frames.contains(&place) }
            };
            let owner = (1..=count).filter_map(|i| Shard::new(i, count)).find(owns).filter(|_| count > 1);
            let fault = Fault::of(ExportFault::Parts, "it was asked for, but no part wrote it");
            return Err(fault.at(folder.join(path)).help(owner.map_or_else(|| "run the export again".into(), again)));
        }
    }
    Ok(())
}

/// That every file is there as it was written.
fn check_files(folder: &Path, files: &[Entry], owner: impl Fn(&str) -> Option<Shard> + Sync) -> Result<()> {
    let wrong = |entry: &Entry| -> Option<&'static str> {
        let what = match Entry::read(folder, entry.path.clone()) {
            Ok(now) if now.bytes == entry.bytes && now.sha256 == entry.sha256 => return None,
            Ok(_) => "it is not as it was written",
            Err(_) if !folder.join(&entry.path).exists() => "it was written, but is missing",
            Err(_) => "it cannot be read",
        };
        Some(what)
    };
    // In order, whichever thread finds which.
    let found: Vec<(&Entry, &str)> = files.par_iter().filter_map(|entry| Some((entry, wrong(entry)?))).collect();
    let Some((first, what)) = found.first() else { return Ok(()) };
    let what = match found.len() {
        1 => (*what).to_owned(),
        2 => format!("{what}, and another file is gone or changed"),
        n => format!("{what}, and {} other files are gone or changed", n - 1),
    };
    let mut shards: Vec<Shard> = found.iter().filter_map(|(entry, _)| owner(&entry.path)).collect();
    shards.sort_by_key(|s| s.index());
    shards.dedup();
    let help = match &shards[..] {
        [] => "run the export again".into(),
        [one] => again(*one),
        [first, more @ ..] => {
            let more: Vec<String> = more.iter().map(Shard::to_string).collect();
            message![
                "run the same export with ",
                Setting::Shard.of(first.to_string()),
                format!(", and then {}, then merge again", more.join(", "))
            ]
        }
    };
    Err(Fault::of(ExportFault::Parts, what).at(folder.join(&first.path)).help(help))
}
