//! Refusals to change a project that is read-only, and the name of the lost journal.

use std::path::Path;

use crate::disk::{Fault, Lock};
use crate::project::ProjectFault;

/// Where changes are kept that do not fit the files any more.
pub(in crate::project) const LOST: &str = "journal.lost";

/// Why a read-only lesson cannot be changed or saved, and what to do.
pub(in crate::project) fn refusal(what: &str, why: &str) -> Fault {
    let help = if why.starts_with(ELSEWHERE) {
        "close it there and open it here again"
    } else {
        "copy the folder to a place of yours and open the copy"
    };
    Fault::of(ProjectFault::ReadOnly, format!("the lesson cannot be {what}: {why}")).help(help)
}

/// Why a lesson is read-only that somebody is working on.
const ELSEWHERE: &str = "it is open in another window";

/// The same, with who holds the lock at `path`.
pub(in crate::project) fn elsewhere(path: &Path) -> String {
    Lock::holder(path).map_or(ELSEWHERE.into(), |holder| format!("{ELSEWHERE} ({holder})"))
}
