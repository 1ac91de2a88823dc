//! What becomes of a commit that was cut off: it is carried on to its end, or cancelled as a whole.
//!
//! The record is written once all its temporary files are on the disk, and before the first of them is renamed. The files
//! alone show how far it came:
//!
//! - nothing was renamed, and a temporary is missing: the commit was cancelled;
//! - nothing was renamed, and a file has neither the old sum nor the new one: something else has changed it, and the
//!   commit is cancelled, which keeps both that change and the journal;
//! - otherwise the files that are not in place yet are put there. A file that something else has changed since is left as
//!   it is, and the one that was to take its place is set aside in the program's own folder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::record::{DONE, Entry, RECORD, Record};
use super::{Calls, Fault, Result, Sum, free_name, is_file_there};

/// The beginning of the names under which files are set aside.
const ASIDE: &str = "unsaved-";

/// How a file of a commit stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    /// It is as it is to be.
    InPlace,
    /// It is as it was, and can be made as it is to be.
    Waiting,
    /// It is as it was, and its temporary is gone.
    Cancelled,
    /// It is neither.
    Foreign,
}

/// A file of an open commit.
struct Found<'a> {
    entry: &'a Entry,
    target: PathBuf,
    /// Its temporary, where it is there and whole.
    temporary: Option<PathBuf>,
    state: State,
}

impl<'a> Found<'a> {
    fn of(entry: &'a Entry, root: &Path) -> Result<Self> {
        let (target, temporary) = entry.paths(root)?;
        let mut whole = None;
        if let Some(path) = temporary
            && Sum::at(&path)? == entry.new
        {
            whole = Some(path);
        }
        let now = Sum::at(&target)?;
        let state = match now {
            _ if now == entry.new => State::InPlace,
            _ if now != entry.old => State::Foreign,
            _ if entry.new.is_none() || whole.is_some() => State::Waiting,
            _ => State::Cancelled,
        };
        Ok(Self { entry, target, temporary: whole, state })
    }

    /// Whether the commit has put it in place, whatever was made of it since.
    fn was_renamed(&self) -> bool {
        let is_other = self.state == State::InPlace || (self.state == State::Foreign && self.entry.new.is_some());
        is_other && self.temporary.is_none()
    }
}

/// How an open commit ends.
pub(super) enum End {
    /// Every file is in place but those that somebody else has changed.
    Finished {
        /// Files left as somebody else made them, with the place of what was to be saved.
        left: Vec<(PathBuf, PathBuf)>,
    },
    /// No file was changed, for one of these was changed by somebody else.
    Cancelled(Vec<PathBuf>),
}

/// An open commit and the state of its files.
pub(super) struct Unfinished<'a> {
    root: &'a Path,
    own: &'a Path,
    files: Vec<Found<'a>>,
}

impl<'a> Unfinished<'a> {
    pub(super) fn of(record: &'a Record, root: &'a Path, own: &'a Path) -> Result<Self> {
        let files = record.files.iter().map(|entry| Found::of(entry, root)).collect::<Result<_>>()?;
        Ok(Self { root, own, files })
    }

    pub(super) fn has_begun(&self) -> bool {
        self.files.iter().any(Found::was_renamed)
    }

    fn is_cancelled(&self) -> bool {
        let keeps = |f: &Found| matches!(f.state, State::Cancelled | State::Foreign);
        !self.has_begun() && self.files.iter().any(keeps)
    }

    /// Brings it to its end.
    ///
    /// # Errors
    /// When a call fails; the commit stays open then, and can be ended later.
    pub(super) fn end(&self, calls: &mut dyn Calls) -> Result<End> {
        if self.is_cancelled() {
            self.close(calls)?;
            for temporary in self.files.iter().filter_map(|f| f.temporary.as_ref()) {
                // What stays is swept later.
                let _ = calls.remove(temporary);
            }
            let foreign = self.files.iter().filter(|f| f.state == State::Foreign).map(|f| f.target.clone());
            return Ok(End::Cancelled(foreign.collect()));
        }
        let mut left = Vec::new();
        for file in &self.files {
            let cannot = |e| Fault::io("cannot save it", &file.target, e);
            match (file.state, &file.temporary) {
                (State::Waiting, Some(temporary)) => calls.rename(temporary, &file.target).map_err(cannot)?,
                (State::Waiting, None) => calls.remove(&file.target).map_err(cannot)?,
                (State::Foreign, Some(temporary)) if !self.is_own(file) => {
                    let aside = self.aside(file);
                    calls.rename(temporary, &aside).map_err(cannot)?;
                    left.push((file.target.clone(), aside));
                }
                (_, Some(temporary)) => calls.remove(temporary).map_err(cannot)?,
                (_, None) => {}
            }
        }
        let mut folders: Vec<&Path> = self.files.iter().filter_map(|f| f.target.parent()).collect();
        folders.sort();
        folders.dedup();
        for folder in folders {
            calls.sync_folder(folder).map_err(|e| Fault::io("cannot save the folder", folder, e))?;
        }
        self.close(calls)?;
        Ok(End::Finished { left })
    }

    /// Whether a file is the program's own, such as the journal, which goes on after the commit.
    fn is_own(&self, file: &Found) -> bool {
        file.target.starts_with(self.own)
    }

    /// Where a file is set aside: its path below the project, as one name.
    fn aside(&self, file: &Found) -> PathBuf {
        free_name(&self.own.join(format!("{ASIDE}{}", file.entry.path.replace('/', "-"))))
    }

    fn close(&self, calls: &mut dyn Calls) -> Result<()> {
        let path = self.own.join(RECORD);
        let closed = (|| {
            let mut record = calls.open(&path)?;
            calls.write(&mut record, DONE)?;
            calls.sync(&record)
        })();
        closed.map_err(|e| Fault::io("cannot close the commit", &path, e))
    }

    /// The files as its end will leave them.
    fn pending(&self) -> Pending {
        let mut files = BTreeMap::new();
        if !self.is_cancelled() {
            let waiting = self.files.iter().filter(|f| f.state == State::Waiting);
            files.extend(waiting.map(|f| (f.target.clone(), f.temporary.clone())));
        }
        debug_assert!(files.keys().all(|path: &PathBuf| path.starts_with(self.root)));
        Pending { files }
    }
}

/// What a note says of a file that kept a commit from being made whole.
pub const CHANGED_MEANWHILE: &str = "was changed by something else";

/// Ends the commit that is open in a project, if there is one; what there is to say of that. The caller holds the lock.
///
/// # Errors
/// When a file cannot be read or put in place; the commit stays open then.
pub fn end_commit(root: &Path, own: &Path, calls: &mut dyn Calls) -> Result<Vec<String>> {
    let Some(record) = Record::open_in(own)? else { return Ok(Vec::new()) };
    let name = |path: &Path| path.strip_prefix(root).unwrap_or(path).display().to_string();
    Ok(match Unfinished::of(&record, root, own)?.end(calls)? {
        End::Finished { left } if left.is_empty() => vec!["a save that was cut off has been finished".into()],
        End::Finished { left } => left
            .iter()
            .map(|(path, aside)| {
                format!(
                    "{} {CHANGED_MEANWHILE} while it was saved, and is left as it is; {} has what was to be saved",
                    name(path),
                    name(aside)
                )
            })
            .collect(),
        End::Cancelled(foreign) if foreign.is_empty() => Vec::new(),
        End::Cancelled(foreign) => foreign
            .iter()
            .map(|path| format!("a save was cut off and is cancelled: {} {CHANGED_MEANWHILE} meanwhile", name(path)))
            .collect(),
    })
}

/// The files that an open commit will change, and where their content is until then.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Pending {
    files: BTreeMap<PathBuf, Option<PathBuf>>,
}

impl Pending {
    /// Those of the commit that is open in a project.
    ///
    /// # Errors
    /// When a file cannot be read.
    pub(crate) fn of(root: &Path, own: &Path) -> Result<Self> {
        match Record::open_in(own)? {
            Some(record) => Ok(Unfinished::of(&record, root, own)?.pending()),
            None => Ok(Self::default()),
        }
    }

    /// The file to read in place of the one at `path`; none where there is none.
    ///
    /// # Errors
    /// As [`is_file_there`].
    pub(crate) fn at(&self, path: &Path) -> Result<Option<PathBuf>> {
        let path = match self.files.get(path) {
            Some(Some(instead)) => instead,
            Some(None) => return Ok(None),
            None => path,
        };
        Ok(is_file_there(path)?.then(|| path.to_owned()))
    }
}

/// Whether a commit is open.
///
/// # Errors
/// When its record cannot be read.
pub fn is_commit_open(own: &Path) -> Result<bool> {
    Ok(Record::open_in(own)?.is_some())
}
