//! A project in the list.

use std::path::PathBuf;

use crate::disk::{Result, clean_line};
use crate::project::Manifest;

/// A project in the list.
#[derive(Debug)]
pub(crate) struct Listed {
    /// Its folder.
    pub root: PathBuf,
    /// The folder's name.
    pub name: String,
    /// Its title and number of clips, or what is wrong with its manifest.
    pub manifest: Result<(String, usize)>,
}

impl Listed {
    /// The project in a folder.
    pub(super) fn of(root: PathBuf) -> Self {
        // The folder may be given as `.`, which has no name.
        let whole = root.canonicalize().unwrap_or_else(|_| root.clone());
        let name = whole.file_name().map_or_else(|| "lesson".into(), |n| n.to_string_lossy().into_owned());
        let manifest = Manifest::read(&root).map(|m| (m.title, m.clips.len()));
        Self { name: clean_line(&name, 60), root, manifest }
    }
}
