//! The list of changes, and where in it the lesson and its files are.

use super::change::Change;

/// Changes made, changes taken back, and how many of those made are in the files.
#[derive(Debug, Default)]
pub struct History {
    done: Vec<Change>,
    undone: Vec<Change>,
    /// The length of `done` when the files were last written; none where that state can no longer be reached.
    saved: Option<usize>,
    started: bool,
}

impl History {
    /// The changes made, oldest first.
    #[must_use]
    pub(crate) fn done(&self) -> &[Change] {
        &self.done
    }

    /// The changes taken back, the one to be made again next at the end.
    #[must_use]
    pub(crate) fn undone(&self) -> &[Change] {
        &self.undone
    }

    /// The changes that lead from the files to the lesson as it is, oldest first; where that state cannot be reached any
    /// more, all changes.
    pub(in crate::project) fn unsaved(&self) -> Vec<Change> {
        match self.saved {
            Some(saved) if saved <= self.done.len() => self.done[saved..].to_vec(),
            Some(saved) => {
                let back = self.undone.iter().take(saved - self.done.len());
                back.map(Change::inverse).collect()
            }
            None => self.done.clone(),
        }
    }

    pub(in crate::project) fn push(&mut self, change: Change) {
        self.start();
        if self.saved.is_some_and(|s| s > self.done.len()) {
            self.saved = None;
        }
        self.undone.clear();
        self.done.push(change);
    }

    pub(in crate::project) fn step_back(&mut self) -> Option<Change> {
        self.start();
        let change = self.done.pop()?;
        self.undone.push(change.clone());
        Some(change)
    }

    pub(in crate::project) fn step_on(&mut self) -> Option<Change> {
        let change = self.undone.pop()?;
        self.done.push(change.clone());
        Some(change)
    }

    pub(in crate::project) fn is_unsaved(&self) -> bool {
        self.started && self.saved != Some(self.done.len())
    }

    pub(in crate::project) fn mark_saved(&mut self) {
        self.started = true;
        self.saved = Some(self.done.len());
    }

    /// A lesson as read is as its files are.
    fn start(&mut self) {
        if !self.started {
            self.started = true;
            self.saved = Some(self.done.len());
        }
    }
}
