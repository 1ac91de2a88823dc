//! A commit: several files of a project are replaced and removed together, all of them or none.
//!
//! Every new file is written beside its place and flushed, then one record of all of them is written and flushed
//! (`record`), then they are renamed, then the record is marked as done. A commit that is cut off before its record is
//! whole has not happened; one that is cut off later is finished by whoever opens the project next (`recover`). The caller
//! holds the project's lock.
//!
//! It does not make several readers see one state: they compare [`commit_stamp`](super::commit_stamp) before and after.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::record::{Entry, RECORD, Record};
use super::recover::{End, Unfinished};
use super::{Calls, Fault, FileFault, Result, Rights, Sum};

/// The sums that a commit gives its files; none for those that it removes.
pub type Sums = BTreeMap<PathBuf, Option<Sum>>;

/// A file of a commit.
#[derive(Debug)]
struct Planned {
    path: PathBuf,
    /// Its new bytes; none where it is removed.
    bytes: Option<Vec<u8>>,
    /// Its sum as it is now.
    old: Option<Sum>,
}

/// Changes of files below one folder, collected to be made together.
#[derive(Debug)]
pub struct Commit<'a> {
    root: &'a Path,
    own: &'a Path,
    like: &'a Path,
    sent: &'a Sums,
    files: Vec<Planned>,
    sums: Sums,
}

/// A commit that was made.
#[derive(Debug)]
pub struct Committed {
    /// The files that were written or removed, without the program's own.
    pub changed: Vec<PathBuf>,
    /// The failure that kept a file from its place. The commit holds all the same: whoever opens the project next
    /// finishes it.
    pub unfinished: Option<Fault>,
}

impl<'a> Commit<'a> {
    /// A commit below `root`, whose record lies in the folder `own`. New files get no more rights than `like` has. `sent`
    /// are the sums of an earlier commit that failed: it may have written them all the same.
    #[must_use]
    pub(crate) fn new(root: &'a Path, own: &'a Path, like: &'a Path, sent: &'a Sums) -> Self {
        Self { root, own, like, sent, files: Vec::new(), sums: Sums::new() }
    }

    /// Adds a file's new bytes. `seen` is its sum when it was last read or written.
    ///
    /// # Errors
    /// When the file was changed by something else since, or cannot be read.
    pub(crate) fn put(&mut self, path: &Path, bytes: impl Into<Vec<u8>>, seen: Option<Sum>) -> Result<()> {
        let bytes = bytes.into();
        let (now, new) = (Sum::at(path)?, Some(Sum::of(&bytes)));
        let is_known = now.is_none() || now == seen || now == new || self.sent.get(path).is_some_and(|s| *s == now);
        if !is_known {
            return Err(foreign(path));
        }
        self.replace(path, Some(bytes), now, new);
        Ok(())
    }

    /// Adds a file's new bytes, whatever it holds now.
    ///
    /// # Errors
    /// When the file cannot be read.
    pub(crate) fn put_over(&mut self, path: &Path, bytes: impl Into<Vec<u8>>) -> Result<()> {
        let bytes = bytes.into();
        let (now, new) = (Sum::at(path)?, Some(Sum::of(&bytes)));
        self.replace(path, Some(bytes), now, new);
        Ok(())
    }

    /// Adds the removal of a file, if it is as it was when it was last read or written.
    ///
    /// # Errors
    /// When the file cannot be read.
    pub(crate) fn remove(&mut self, path: &Path, seen: Option<Sum>) -> Result<()> {
        let now = Sum::at(path)?;
        if now.is_none() || now == seen {
            self.replace(path, None, now, None);
        }
        Ok(())
    }

    /// What is added last counts.
    fn replace(&mut self, path: &Path, bytes: Option<Vec<u8>>, old: Option<Sum>, new: Option<Sum>) {
        self.files.retain(|f| f.path != path);
        self.sums.insert(path.to_owned(), new);
        if old != new {
            self.files.push(Planned { path: path.to_owned(), bytes, old });
        }
    }

    /// The sums that its files will have, those among them that have them already.
    #[must_use]
    pub(crate) fn sums(&self) -> &Sums {
        &self.sums
    }

    /// Makes the changes.
    ///
    /// # Errors
    /// When a step fails before it is sure that all of them will be made: then every file is as it was. Where a single
    /// file is written, it may be in its place, though the folder could not be flushed.
    pub(crate) fn run(mut self, calls: &mut dyn Calls) -> Result<Committed> {
        // What is written first, so that a temporary that is gone says that the renaming has begun; and the program's own
        // files before all others: notes that follow in the journal follow the commit.
        self.files.sort_by_key(|f| (f.bytes.is_none(), !f.path.starts_with(self.own)));
        let own = self.own;
        let changed = self.files.iter().map(|f| f.path.clone()).filter(|p| !p.starts_with(own)).collect();
        let unfinished = match self.files.as_slice() {
            [] => None,
            [one] => self.run_one(one, calls).map(|()| None)?,
            _ => self.run_all(calls)?,
        };
        Ok(Committed { changed, unfinished })
    }

    /// Makes the changes one after the other, in a folder that nobody else reads yet.
    ///
    /// # Errors
    /// When one fails.
    pub(crate) fn run_unrecorded(self, calls: &mut dyn Calls) -> Result<()> {
        self.files.iter().try_for_each(|file| self.run_one(file, calls))
    }

    /// One file needs no record: it is replaced whole or not at all.
    fn run_one(&self, file: &Planned, calls: &mut dyn Calls) -> Result<()> {
        let done = match self.temporary(file, calls)? {
            Some(temporary) => calls.rename(&temporary, &file.path).inspect_err(|_| {
                let _ = calls.remove(&temporary);
            }),
            None => calls.remove(&file.path),
        };
        done.and_then(|()| calls.sync_folder(folder_of(&file.path))).map_err(|e| cannot_save(&file.path, e))
    }

    fn run_all(&self, calls: &mut dyn Calls) -> Result<Option<Fault>> {
        let mut temporaries = Vec::with_capacity(self.files.len());
        let recorded = self.record(&mut temporaries, calls);
        let record = recorded.inspect_err(|_| self.cancel(&temporaries, calls))?;
        let unfinished = Unfinished::of(&record, self.root, self.own);
        match unfinished.and_then(|unfinished| unfinished.end(calls)) {
            Ok(End::Finished { left }) => Ok(left
                .first()
                .map(|(path, aside)| foreign(path).help(format!("{} has what was to be saved", aside.display())))),
            Ok(End::Cancelled(others)) => Err(foreign(others.first().map_or(self.root, PathBuf::as_path))),
            Err(fault) => match Unfinished::of(&record, self.root, self.own) {
                Ok(unfinished) if !unfinished.has_begun() => {
                    self.cancel(&temporaries, calls);
                    Err(fault)
                }
                _ => Ok(Some(fault.help("save again, or open the project again: the save is finished then"))),
            },
        }
    }

    /// Writes all that is new and its record.
    fn record(&self, temporaries: &mut Vec<PathBuf>, calls: &mut dyn Calls) -> Result<Record> {
        let mut files = Vec::with_capacity(self.files.len());
        for file in &self.files {
            let temporary = self.temporary(file, calls)?;
            temporaries.extend(temporary.clone());
            files.push(self.entry(file, temporary.as_deref())?);
        }
        let mut folders: Vec<&Path> = temporaries.iter().map(|t| folder_of(t)).collect();
        folders.sort();
        folders.dedup();
        let path = self.own.join(RECORD);
        let record = Record { files };
        let line = record.to_line()?;
        let written = (|| {
            folders.iter().try_for_each(|folder| calls.sync_folder(folder))?;
            calls.create_folder(self.own)?;
            let mut file = calls.open(&path)?;
            calls.truncate(&mut file)?;
            calls.write(&mut file, line.as_bytes())?;
            calls.sync(&file)?;
            calls.sync_folder(self.own)
        })();
        written.map_err(|e| cannot_save(&path, e))?;
        Ok(record)
    }

    /// Takes back a commit of which nothing was renamed. What fails here is taken back when the project is opened next: a
    /// record without its temporaries is none.
    fn cancel(&self, temporaries: &[PathBuf], calls: &mut dyn Calls) {
        let path = self.own.join(RECORD);
        if path.is_file()
            && let Ok(mut record) = calls.open(&path)
        {
            let _ = calls.truncate(&mut record).and_then(|()| calls.sync(&record));
        }
        for temporary in temporaries {
            let _ = calls.remove(temporary);
        }
    }

    /// The file beside its place, with its new bytes on the disk; none where it is removed.
    fn temporary(&self, file: &Planned, calls: &mut dyn Calls) -> Result<Option<PathBuf>> {
        let Some(bytes) = &file.bytes else { return Ok(None) };
        let folder = folder_of(&file.path);
        // A temporary that is read in the file's place is read by its ending.
        let ending = file.path.extension().map_or(String::new(), |e| format!(".{}", e.to_string_lossy()));
        let made = (|| {
            calls.create_folder(folder)?;
            let mut handle = calls.create(folder, &ending)?;
            let rights = Rights::of(&file.path, self.like);
            let written = calls
                .set_rights(&handle, rights)
                .and_then(|()| calls.write(&mut handle, bytes))
                .and_then(|()| calls.sync(&handle));
            match written {
                Ok(()) => Ok(handle.path),
                Err(error) => {
                    let _ = calls.remove(&handle.path);
                    Err(error)
                }
            }
        })();
        made.map(Some).map_err(|e| cannot_save(&file.path, e))
    }

    fn entry(&self, file: &Planned, temporary: Option<&Path>) -> Result<Entry> {
        let below = file.path.strip_prefix(self.root).ok().and_then(Path::to_str);
        let Some(path) = below else {
            return Err(Fault::of(FileFault::Outside, "the file is not in the project's folder")
                .at(&file.path)
                .help("move it there"));
        };
        Ok(Entry {
            path: path.replace(std::path::MAIN_SEPARATOR, "/"),
            old: file.old,
            new: file.bytes.as_deref().map(Sum::of),
            temporary: temporary.and_then(Path::file_name).map(|n| n.to_string_lossy().into_owned()),
        })
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn cannot_save(path: &Path, error: std::io::Error) -> Fault {
    Fault::writing("cannot save it", path, error)
}

fn foreign(path: &Path) -> Fault {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    Fault::of(
        FileFault::Changed,
        format!("{name} was changed by something else since the lesson was opened, and is left as it is"),
    )
    .at(path)
    .help("move it aside and save again to keep yours, or leave without saving and open the lesson again")
}
