//! Reading a project in one state: a save that was cut off is ended first, and one that is made meanwhile is waited for.

use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::disk::{
    Calls, Fault, Lock, Message, Pending, Result, SystemCalls, clear_temporaries, commit_stamp, end_commit,
    has_temporaries, is_commit_open, list,
};
use crate::project::ProjectFault;

/// The program's own folder in a project.
pub(in crate::project) const OWN_FOLDER: &str = ".lianpu";
/// The name of the lock's file in it.
pub(in crate::project) const LOCK: &str = "lock";

/// A reader waits so long for a save of another session.
const LONGEST_WAIT: Duration = Duration::from_secs(1);
/// And looks so often.
const STEP: Duration = Duration::from_millis(20);
/// A project is read at most so often where it is saved while it is read.
const TRIES: u32 = 8;

/// Reads files of the project in `root`, through the paths that [`Pending`] gives, until no save was made meanwhile;
/// with what there is to say of a save that was cut off.
///
/// # Errors
/// When the record of the last save is damaged, or the project is saved all the time.
pub(in crate::project) fn read_settled<T>(
    root: &Path,
    mut read: impl FnMut(&Pending) -> T,
) -> Result<(T, Vec<Message>)> {
    let own = root.join(OWN_FOLDER);
    let mut notes = Vec::new();
    for _ in 0..TRIES {
        let before = commit_stamp(&own);
        let pending = settle(root, &own, &mut notes)?;
        let value = read(&pending);
        // A save that has begun since has changed its record; one that others finish has moved its files.
        if commit_stamp(&own) == before && Pending::of(root, &own)? == pending {
            return Ok((value, notes));
        }
    }
    Err(Fault::of(ProjectFault::Busy, "the lesson is being saved all the time")
        .at(root)
        .help("try again when it is not"))
}

/// Ends a save that was cut off, or waits for the session that makes it. Where neither ends it, the files as its end will
/// leave them.
fn settle(root: &Path, own: &Path, notes: &mut Vec<Message>) -> Result<Pending> {
    let lock = own.join(LOCK);
    let until = Instant::now() + LONGEST_WAIT;
    while is_commit_open(own)? {
        match Lock::take(&lock) {
            Ok(Some(_held)) => {
                let ended = end_and_sweep(root, own, &mut SystemCalls);
                return match ended {
                    Ok(found) => {
                        notes.extend(found);
                        Ok(Pending::default())
                    }
                    Err(_) => Pending::of(root, own),
                };
            }
            Ok(None) if Instant::now() < until => sleep(STEP),
            Ok(None) | Err(_) => return Pending::of(root, own),
        }
    }
    if own.is_dir() && written_folders(root).iter().any(|f| has_temporaries(f)) {
        // Whoever saves now holds the lock, and clears away what is left.
        if let Ok(Some(_held)) = Lock::take(&lock)
            && !is_commit_open(own)?
        {
            sweep(root);
        }
    }
    Ok(Pending::default())
}

/// Ends a save that was cut off and clears away what killed programs have left. The caller holds the lock.
///
/// # Errors
/// As [`end_commit`].
pub(in crate::project) fn end_and_sweep(root: &Path, own: &Path, calls: &mut dyn Calls) -> Result<Vec<Message>> {
    let notes = end_commit(root, own, calls)?;
    sweep(root);
    Ok(notes.into_iter().map(Message::from).collect())
}

fn sweep(root: &Path) {
    written_folders(root).iter().for_each(|folder| clear_temporaries(folder));
}

/// The folders that a save writes into: the program's own, those of clips and of faces. Links are not followed.
fn written_folders(root: &Path) -> Vec<PathBuf> {
    let mut folders = vec![root.join(OWN_FOLDER)];
    for kind in ["clips", "faces"] {
        let inner = list(&root.join(kind)).unwrap_or_default();
        folders.extend(inner.into_iter().filter(|path| path.symlink_metadata().is_ok_and(|about| about.is_dir())));
    }
    folders
}
