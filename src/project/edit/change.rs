//! Changes: lists of edits, each with its inverse. Undo, redo, the journal and every editor use this one list.

use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value};

use super::clip::ClipEdit;
use super::face::FaceEdit;
use crate::disk::Result;
use crate::project::fault::stale;
use crate::project::files::{Clip, LessonFace};

/// Something an author did, in one step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// What was done, in a few words.
    pub label: String,
    /// What it changes, in order.
    pub edits: Vec<Edit>,
}

/// The smallest change: an edit of a clip or of a face, by its number in the manifest.
///
/// As JSON it is one object, `{"times": {"clip": 0, "first": 3, …}}`: the edit's name, and among its fields the number of the
/// clip or the face.
#[derive(Debug, Clone, PartialEq)]
pub enum Edit {
    /// Of a clip.
    Clip(usize, ClipEdit),
    /// Of a face.
    Face(usize, FaceEdit),
}

impl Change {
    /// A change of one edit.
    #[must_use]
    pub fn one(label: impl Into<String>, edit: Edit) -> Self {
        Self { label: label.into(), edits: vec![edit] }
    }

    /// The change that takes it back.
    #[must_use]
    pub(crate) fn inverse(&self) -> Self {
        Self { label: self.label.clone(), edits: self.edits.iter().rev().map(Edit::inverse).collect() }
    }
}

impl Edit {
    /// The edit that takes it back.
    #[must_use]
    pub(crate) fn inverse(&self) -> Self {
        match self {
            Self::Clip(number, edit) => Self::Clip(*number, edit.inverse()),
            Self::Face(number, edit) => Self::Face(*number, edit.inverse()),
        }
    }

    /// Returns true if what it says is to be is what is, so that it can be taken back.
    pub(super) fn is_made(&self, clips: &[Clip], faces: &[LessonFace]) -> bool {
        self.inverse().apply(&mut clips.to_vec(), &mut faces.to_vec()).is_ok()
    }

    /// Makes the edit. What it says was must be what is.
    pub(super) fn apply(&self, clips: &mut [Clip], faces: &mut [LessonFace]) -> Result<()> {
        match self {
            Self::Clip(number, edit) => edit.apply(clips.get_mut(*number).ok_or_else(stale)?),
            Self::Face(number, edit) => edit.apply(faces.get_mut(*number).ok_or_else(stale)?),
        }
    }
}

/// The fields of an edit as JSON: the only value of its object.
fn fields(edit: &mut Value) -> Option<&mut Map<String, Value>> {
    edit.as_object_mut()?.values_mut().next()?.as_object_mut()
}

impl Serialize for Edit {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let (target, number, edit) = match self {
            Self::Clip(number, edit) => ("clip", number, serde_json::to_value(edit)),
            Self::Face(number, edit) => ("face", number, serde_json::to_value(edit)),
        };
        let mut edit = edit.map_err(S::Error::custom)?;
        if let Some(fields) = fields(&mut edit) {
            fields.insert(target.into(), Value::from(*number));
        }
        edit.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Edit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        let mut edit = Value::deserialize(deserializer)?;
        let mut target = |name: &str| fields(&mut edit).and_then(|fields| fields.remove(name));
        let (clip, face) = (target("clip"), target("face"));
        let number = |value: Value| serde_json::from_value(value).map_err(D::Error::custom);
        match (clip, face) {
            (Some(clip), None) => {
                Ok(Self::Clip(number(clip)?, serde_json::from_value(edit).map_err(D::Error::custom)?))
            }
            (None, Some(face)) => {
                Ok(Self::Face(number(face)?, serde_json::from_value(edit).map_err(D::Error::custom)?))
            }
            _ => Err(D::Error::custom("an edit names a clip or a face")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Edits of a journal as version 0.1 wrote them, one of each kind.
    const LINES: &str = include_str!("journal-0.1.jsonl");

    #[test]
    fn every_kind_of_edit_is_read_and_written_as_before() {
        for line in LINES.lines() {
            let edit: Edit = serde_json::from_str(line).unwrap_or_else(|e| panic!("{line}: {e}"));
            assert_eq!(serde_json::to_value(&edit).unwrap(), serde_json::from_str::<Value>(line).unwrap());
            assert_eq!(edit.inverse().inverse(), edit);
        }
        assert_eq!(LINES.lines().count(), 15);
    }

    #[test]
    fn a_point_without_a_shot_is_one_of_the_neutral_photo() {
        let line = r#"{"point":{"face":1,"point":"8.4","before":{"at":[1.0,2.0],"confidence":0.5,"how":"found"},"after":{"at":[1.5,2.0],"confidence":1.0,"how":"hand"}}}"#;
        let edit: Edit = serde_json::from_str(line).unwrap();
        assert!(matches!(edit, Edit::Face(1, FaceEdit::Point { shot: crate::pose::Emotion::Neutral, .. })));
        assert!(serde_json::from_str::<Edit>(r#"{"pin":{"index":3,"pinned":true}}"#).is_err());
    }
}
