//! The book of a running export: what it was asked for, what is there, and what of an earlier run can be kept.
//!
//! It becomes a [`Manifest`] when the export is done, and not before. Until then files that cannot tell themselves what
//! they were made from are noted in a draft of it, so that an export that was killed goes on where it was.

use std::fs::File;
use std::path::{Path, PathBuf};

use super::Shard;
use super::aside::{self, Aside, put_aside};
use super::manifest::{Asked, Entry, Manifest, within};
use super::merge::parts_in;
use crate::disk::{self, Fault, Result};

/// What a running export knows of its files.
#[derive(Debug)]
pub struct Ledger {
    folder: PathBuf,
    shard: Shard,
    clips: Vec<Asked>,
    files: Vec<Entry>,
    before: Vec<Manifest>,
    aside: Aside,
}

impl Ledger {
    /// Opens the book of an export, or of a part of one, into a folder that need not be there yet.
    #[must_use]
    pub fn open(folder: &Path, shard: Shard) -> Self {
        let names = [draft(shard), Manifest::name(shard), Manifest::name(Shard::WHOLE)];
        // One that is damaged keeps nothing, and is written anew.
        let before: Vec<Manifest> = names.iter().filter_map(|name| Manifest::read(&folder.join(name)).ok()).collect();
        let mut aside = Aside::default();
        if !folder.join(draft(shard)).exists() {
            let parts = parts_in(folder).unwrap_or_default();
            for entry in before.iter().chain(parts.iter().map(|(_, part)| part)).flat_map(|m| &m.files) {
                if entry.path.ends_with(".svg") || entry.path.ends_with(".png") {
                    aside.wrote.entry(entry.path.clone()).or_default().push(entry.sha256.clone());
                }
            }
        }
        Self { folder: folder.to_owned(), shard, clips: Vec::new(), files: Vec::new(), before, aside }
    }

    /// Whether nothing was asked for or made.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.clips.is_empty() && self.files.is_empty()
    }

    /// Notes what is asked of clips, in all parts.
    pub fn ask(&mut self, clips: Vec<Asked>) {
        self.clips.extend(clips);
    }

    /// Notes files that are there and right.
    pub(crate) fn add(&mut self, files: impl IntoIterator<Item = Entry>) {
        self.files.extend(files);
    }

    /// What was set aside.
    pub(super) const fn aside(&self) -> &Aside {
        &self.aside
    }

    /// The entry of a file that is there as an earlier run made it from the same.
    pub(super) fn kept(&self, path: &Path, key: &str) -> Option<Entry> {
        let name = within(&self.folder, path);
        let holds = self.before.iter().find(|m| m.holds(&self.folder, &name, key))?;
        holds.entry(&name).cloned()
    }

    /// Before a file is written anew: where no earlier export wrote what is there, or somebody has changed it since, that is
    /// renamed to the same name with a `~` that no other file has, and a note on it kept for the author. `new` is what will
    /// be written, where it is known.
    pub(super) fn set_aside(&self, path: &Path, new: Option<&[u8]>) -> Result<()> {
        let name = within(&self.folder, path);
        let parts = parts_in(&self.folder).unwrap_or_default();
        let earlier = self.before.iter().chain(parts.iter().map(|(_, part)| part));
        let wrote: Vec<&Entry> = earlier.filter_map(|m| m.entry(&name)).collect();
        // A folder in the way stays, and writing says so.
        if path.symlink_metadata().map_or(true, |there| there.is_dir()) {
            return Ok(());
        }
        // What cannot be read is nothing that was exported.
        if let Ok(now) = Entry::read(&self.folder, name.clone()) {
            let is_new = new.is_some_and(|new| Entry::of(String::new(), new).sha256 == now.sha256);
            if is_new || wrote.iter().any(|w| w.sha256 == now.sha256) {
                return Ok(());
            }
        }
        let aside = put_aside(path)?;
        self.aside.note(match wrote.is_empty() {
            false => format!(
                "{name} was changed since it was exported; that is kept as {name}{aside}, and it is written anew"
            ),
            true => format!("{name} was there and is of no export; it is kept as {name}{aside}"),
        });
        Ok(())
    }

    /// Before anything is written: what has the manifest's name and is none is set aside as a file is.
    pub(super) fn set_manifest_aside(&self) -> Result<()> {
        if let Some(note) = aside::set_manifest_aside(&self.folder, self.shard)? {
            self.aside.note(note);
        }
        Ok(())
    }

    /// Notes a file that was made from what `key` tells.
    pub(super) fn made(&mut self, path: &Path, key: &str) -> Result<()> {
        self.keep(Entry::read(&self.folder, within(&self.folder, path))?.made_from(key))
    }

    /// Notes a file that tells what it was made from, at once also on disk, with those that earlier runs have noted.
    pub(super) fn keep(&mut self, entry: Entry) -> Result<()> {
        self.files.push(entry.clone());
        let _lock = self.lock();
        self.write_draft(|files| {
            files.retain(|e| e.path != entry.path);
            files.push(entry);
        })
    }

    /// When all is known that is asked of it: until it is closed, the draft says that files may be newer than the manifest.
    /// In a divided export what an earlier run of this part wrote for another request no longer counts as done.
    pub(crate) fn begin(&self) {
        if !self.before.is_empty() {
            let _lock = self.lock();
            // Without the draft, frames of a run that is killed would be taken for changed by somebody.
            let _ = self.write_draft(|_| ());
        }
        let path = self.folder.join(Manifest::name(self.shard));
        if self.shard != Shard::WHOLE && Manifest::read(&path).is_ok_and(|m| m.clips != self.clips) {
            let _ = disk::remove(&path);
        }
    }

    /// Leaves a part undone: without its manifest it is known not to be.
    pub(crate) fn give_up(self) {
        if self.shard != Shard::WHOLE {
            let _ = disk::remove(&self.folder.join(Manifest::name(self.shard)));
        }
    }

    /// Writes the manifest: everything that was asked for is there. Returns its path.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn close(mut self) -> Result<PathBuf> {
        let clips = std::mem::take(&mut self.clips);
        let mut manifest = Manifest::new(self.shard, clips, std::mem::take(&mut self.files));
        disk::make_folder(&self.folder).map_err(|e| Fault::io("cannot make the folder", &self.folder, e))?;
        // Several exports into one folder may end at once: each adds to what the others have.
        let _lock = self.lock();
        if self.shard == Shard::WHOLE
            && let Ok(earlier) = Manifest::read(&self.folder.join(Manifest::name(Shard::WHOLE)))
        {
            manifest = manifest.beside(earlier, &self.folder);
        }
        let path = manifest.write(&self.folder)?;
        let name = draft(self.shard);
        if let Ok(mut draft) = Manifest::read(&self.folder.join(&name)) {
            draft.files.retain(|e| manifest.entry(&e.path).is_none());
            match draft.files.is_empty() {
                // Where it cannot be removed, the next run trusts the manifest less.
                true => drop(disk::remove(&self.folder.join(&name))),
                false => draft.write_as(&self.folder, &name)?,
            }
        }
        remove_superseded(&self.folder, &manifest);
        Ok(path)
    }

    /// Changes the draft.
    fn write_draft(&self, change: impl FnOnce(&mut Vec<Entry>)) -> Result<()> {
        let name = draft(self.shard);
        let mut files = Manifest::read(&self.folder.join(&name)).map(|m| m.files).unwrap_or_default();
        change(&mut files);
        Manifest::new(self.shard, Vec::new(), files).write_as(&self.folder, &name)
    }

    /// Waits until no other export changes the folder's manifests. Where folders cannot be locked nobody waits.
    fn lock(&self) -> Option<File> {
        let folder = disk::open_folder(&self.folder).ok()?;
        folder.lock().ok()?;
        Some(folder)
    }
}

/// Manifests of parts that this one makes void: those of another division where this is a part, and those whose every file
/// is in it where it is the whole.
fn remove_superseded(folder: &Path, now: &Manifest) {
    let Ok(count) = now.part().map(Shard::count) else { return };
    for (path, part) in parts_in(folder).unwrap_or_default() {
        let other = part.part().is_ok_and(|p| p.count() != count);
        let is_void = match count {
            1 => part.files.iter().all(|f| now.entry(&f.path).is_some()),
            _ => other,
        };
        if is_void {
            let _ = disk::remove(&path);
        }
    }
}

/// No manifest's name, so that nobody takes it for one.
fn draft(shard: Shard) -> String {
    format!(".{}.part", Manifest::name(shard))
}
