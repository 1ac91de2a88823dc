//! Files that an export finds where its own belong and that no export wrote: renamed, and told to the author.

use std::collections::HashMap;
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

use super::Shard;
use super::manifest::{Entry, Manifest};
use crate::disk::{self, Fault, Message, Result};

/// What an export has set aside, known also where it fails later.
#[derive(Debug, Default)]
pub struct Aside {
    notes: Mutex<Vec<Message>>,
    /// SHA-256 of the frames that earlier exports wrote, by path from the manifest's folder. Empty where an earlier run
    /// did not come to its end: then the manifests may be older than the frames.
    pub(super) wrote: HashMap<String, Vec<String>>,
    /// Files of others that had the names of frames.
    pub(super) frames: AtomicU32,
}

impl Aside {
    pub(super) fn note(&self, note: String) {
        self.notes.lock().unwrap_or_else(PoisonError::into_inner).push(note.into());
    }

    /// Whether a frame may be as an earlier export wrote it: no manifest has it, or one has it with this content. `name` is
    /// its path from the manifest's folder.
    pub(super) fn may_be_exported(&self, name: &str, content: &[u8]) -> bool {
        self.wrote.get(name).is_none_or(|sums| sums.contains(&Entry::of(String::new(), content).sha256))
    }

    /// Takes the notes on what was set aside since they were last taken.
    pub(super) fn take_notes(&self) -> Vec<Message> {
        let mut notes = std::mem::take(&mut *self.notes.lock().unwrap_or_else(PoisonError::into_inner));
        let count = self.frames.swap(0, Ordering::Relaxed);
        let files = if count == 1 { "1 file".to_owned() } else { format!("{count} files") };
        notes.extend((count > 0).then(|| {
            format!(
                "{files} among the frames were of no export or changed since; they are kept with a ~ behind their names"
            )
            .into()
        }));
        notes
    }
}

/// Sets aside what has a manifest's name in a folder and is none; a note for the author.
pub(super) fn set_manifest_aside(folder: &Path, shard: Shard) -> Result<Option<String>> {
    let name = Manifest::name(shard);
    let path = folder.join(&name);
    let is_there = path.symlink_metadata().is_ok_and(|there| !there.is_dir());
    if !is_there || Manifest::read(&path).is_ok() {
        return Ok(None);
    }
    let aside = put_aside(&path)?;
    Ok(Some(format!("{name} was there and is no manifest of an export; it is kept as {name}{aside}")))
}

/// Renames a file to its name with a `~`, or with `~2` and so on where an earlier one has that. Returns what was added.
pub(super) fn put_aside(path: &Path) -> Result<String> {
    let mut beside = path.as_os_str().to_owned();
    beside.push("~");
    let kept = disk::free_name(Path::new(&beside));
    let ending = kept.as_os_str().to_string_lossy()[path.as_os_str().to_string_lossy().len()..].to_owned();
    let renamed = disk::rename(path, &kept);
    renamed.map(|()| ending).map_err(|e| Fault::io("cannot keep what was changed in it", path, e))
}
