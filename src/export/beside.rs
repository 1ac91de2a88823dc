//! Two manifests of one folder as one: what an export finds there of earlier ones stays known.

use std::path::Path;

use super::{Asked, Entry, Manifest};

impl Manifest {
    /// Takes over what an earlier manifest of the same folder has beside this one, as far as it is still there: files with
    /// their length, and what was asked of a clip as far as its files are neither gone nor made anew in another way.
    #[must_use]
    pub fn beside(mut self, earlier: Self, folder: &Path) -> Self {
        let same = |e: &Entry| std::fs::metadata(folder.join(&e.path)).is_ok_and(|m| m.len() == e.bytes);
        let kept: Vec<Entry> =
            earlier.files.into_iter().filter(|e| self.entry(&e.path).is_none()).filter(|e| same(e)).collect();
        let rows: Vec<Asked> = earlier.clips.iter().flat_map(|row| self.left_of(row, &kept)).collect();
        self.clips.extend(rows);
        self.files.extend(kept);
        self.files.sort_by(|a, b| a.path.cmp(&b.path));
        self
    }

    /// What is left of an earlier request, when of its files those are `kept` that this export has not: a row for all forms
    /// that have the same frames.
    fn left_of(&self, row: &Asked, kept: &[Entry]) -> Vec<Asked> {
        let is_kept = |path: &str| kept.binary_search_by(|e| e.path.as_str().cmp(path)).is_ok();
        let alike = |a: &&Asked| (&a.project, &a.clip, &a.settings) == (&row.project, &row.clip, &row.settings);
        let now = self.clips.iter().find(alike);
        let whole: Vec<String> = row.whole.iter().filter(|path| is_kept(path)).cloned().collect();
        let mut rows: Vec<Asked> = Vec::new();
        for form in &row.frame_forms {
            let mut frames = row.numbers();
            let again = now.filter(|a| a.frame_forms.contains(form)).map(Asked::numbers);
            // Made anew in the same way, they are what they were.
            let is_same = |frame: &u32| again.as_ref().is_some_and(|all| all.binary_search(frame).is_ok());
            frames.retain(|frame| is_kept(&row.path_of(*frame, form)) || is_same(frame));
            if frames.iter().all(is_same) {
                continue;
            }
            let frames = Asked::runs(&frames);
            match rows.iter_mut().find(|r| r.frames == frames) {
                Some(other) => other.frame_forms.push(form.clone()),
                None => rows.push(Asked { frame_forms: vec![form.clone()], frames, whole: Vec::new(), ..row.clone() }),
            }
        }
        match rows.first_mut() {
            Some(first) => first.whole = whole,
            None if whole.is_empty() => {}
            None => rows.push(Asked { frame_forms: Vec::new(), folder: String::new(), whole, ..row.clone() }),
        }
        rows
    }
}
