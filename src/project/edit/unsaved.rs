//! Changes that an earlier session, or another one, left in the journal.

use std::path::Path;

use super::journal::{JOURNAL, Journal};
use crate::disk::{Lock, Message, Result, Task, message};
use crate::project::count::counted;
use crate::project::files::{LOCK, OWN_FOLDER};

/// Changes of a lesson that are in its journal and in none of its files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Unsaved {
    /// How many.
    pub changes: usize,
    /// Whether somebody has the lesson open, who may still save them.
    pub is_open: bool,
}

impl Unsaved {
    /// Those of the lesson in `root`.
    pub(in crate::project) fn of(root: &Path) -> Result<Self> {
        let own = root.join(OWN_FOLDER);
        let left = Journal::left_in(&own.join(JOURNAL))?;
        let changes = left.changes.len() + left.unreadable;
        Ok(Self { changes, is_open: changes > 0 && Lock::is_held(&own.join(LOCK)) })
    }

    /// The remark on them; none where there are none.
    #[must_use]
    pub(crate) fn note(self) -> Option<Message> {
        if self.changes == 0 {
            return None;
        }
        if self.is_open {
            return Some("it is open in a studio with changes that are not saved, and so not in its files".into());
        }
        let changes = counted(self.changes, "unsaved change");
        let open = format!("{changes} of an earlier session: open it in ");
        Some(message![open, Task::Open, " to bring them back, and save or discard them"])
    }
}
