//! The book of a running export: what it was asked for, what is there, and what of an earlier run can be kept.
//!
//! It becomes a [`Manifest`] when the export is done, and not before. Until then files that cannot tell themselves what
//! they were made from are noted in a draft of it, so that an export that was killed goes on where it was.

use std::path::{Path, PathBuf};

use super::manifest::{Asked, Entry, Manifest};
use super::{Shard, asked::within};
use crate::disk::Result;

/// What a running export knows of its files.
#[derive(Debug)]
pub struct Ledger {
    folder: PathBuf,
    shard: Shard,
    clips: Vec<Asked>,
    files: Vec<Entry>,
    before: Vec<Manifest>,
}

impl Ledger {
    /// Opens the book of an export, or of a part of one, into a folder that need not be there yet.
    #[must_use]
    pub fn open(folder: &Path, shard: Shard) -> Self {
        let names = [draft(shard), Manifest::name(shard), Manifest::name(Shard::WHOLE)];
        // One that is damaged keeps nothing, and is written anew.
        let before = names.iter().filter_map(|name| Manifest::read(&folder.join(name)).ok()).collect();
        Self { folder: folder.to_owned(), shard, clips: Vec::new(), files: Vec::new(), before }
    }

    /// Whether nothing was asked for or made.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.clips.is_empty() && self.files.is_empty()
    }

    /// Notes what is asked of clips, in all parts.
    pub fn ask(&mut self, clips: Vec<Asked>) {
        self.clips.extend(clips);
    }

    /// Notes files that are there and right.
    pub fn add(&mut self, files: impl IntoIterator<Item = Entry>) {
        self.files.extend(files);
    }

    /// The entry of a file that is there as an earlier run made it from the same.
    pub(super) fn kept(&self, path: &Path, key: &str) -> Option<Entry> {
        let name = within(&self.folder, path);
        let holds = self.before.iter().find(|m| m.holds(&self.folder, &name, key))?;
        holds.entry(&name).cloned()
    }

    /// Notes a file that was made from what `key` tells.
    pub(super) fn made(&mut self, path: &Path, key: &str) -> Result<()> {
        self.keep(Entry::read(&self.folder, within(&self.folder, path))?.made_from(key))
    }

    /// Notes a file that tells what it was made from, at once also on disk.
    pub(super) fn keep(&mut self, entry: Entry) -> Result<()> {
        self.files.push(entry);
        let keyed = self.files.iter().filter(|e| e.key.is_some()).cloned().collect();
        Manifest::new(self.shard, Vec::new(), keyed).write_as(&self.folder, &draft(self.shard))
    }

    /// Writes the manifest: everything that was asked for is there. Returns its path.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn close(self) -> Result<PathBuf> {
        let mut manifest = Manifest::new(self.shard, self.clips, self.files);
        if self.shard == Shard::WHOLE {
            let own = Manifest::name(Shard::WHOLE);
            if let Ok(earlier) = Manifest::read(&self.folder.join(own)) {
                manifest = manifest.beside(earlier, &self.folder);
            }
        }
        let path = manifest.write(&self.folder)?;
        // Nothing depends on its going.
        let _ = std::fs::remove_file(self.folder.join(draft(self.shard)));
        Ok(path)
    }
}

/// No manifest's name, so that nobody takes it for one.
fn draft(shard: Shard) -> String {
    format!(".{}.part", Manifest::name(shard))
}
