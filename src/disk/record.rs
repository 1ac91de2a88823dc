//! The record of a commit: the files that it replaces or removes, with their sums before and after.
//!
//! `.lianpu/commit` holds the last one: a line of its CRC-32 and its JSON, and a second line once it is done. A line whose
//! CRC-32 does not fit was cut off while it was written, before any file was touched, and counts as none.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Fault, FileFault, Result, Sum, inside, is_temporary, read_bytes};

/// The record's file, in the program's own folder.
pub(super) const RECORD: &str = "commit";
/// The line after a record whose files are all in place.
pub(super) const DONE: &[u8] = b"done\n";
/// The largest record: ten thousand files.
const LARGEST: u64 = 4 << 20;

/// A file of a commit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Entry {
    /// Its path below the project's folder, with `/`.
    pub(super) path: String,
    /// Its sum before; none where it was not there.
    pub(super) old: Option<Sum>,
    /// Its sum after; none where it is removed.
    pub(super) new: Option<Sum>,
    /// The name of the file beside it that takes its place; none where it is removed.
    pub(super) temporary: Option<String>,
}

/// The files of a commit, in the order in which they are put in place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Record {
    pub(super) files: Vec<Entry>,
}

impl Record {
    /// Its line.
    pub(super) fn to_line(&self) -> Result<String> {
        let json = serde_json::to_string(self)
            .map_err(|e| Fault::of(FileFault::OutOfRange, format!("the commit cannot be recorded: {e}")))?;
        Ok(format!("{:08x} {json}\n", crc32fast::hash(json.as_bytes())))
    }

    /// The record in the program's own folder that is not done yet; none where there is none.
    ///
    /// # Errors
    /// When its file cannot be read.
    pub(super) fn open_in(own: &Path) -> Result<Option<Self>> {
        let path = own.join(RECORD);
        if !path.is_file() {
            return Ok(None);
        }
        Ok(Self::parse(&read_bytes(&path, LARGEST)?))
    }

    /// The record in the bytes of its file, unless it is done or was cut off.
    fn parse(bytes: &[u8]) -> Option<Self> {
        let end = bytes.iter().position(|b| *b == b'\n')?;
        let (line, rest) = bytes.split_at(end);
        // A mark that was cut off is followed by a whole one.
        if rest.ends_with(DONE) {
            return None;
        }
        let (sum, json) = line.split_at_checked(9)?;
        let is_whole = format!("{:08x} ", crc32fast::hash(json)).as_bytes() == sum;
        serde_json::from_slice(json).ok().filter(|_| is_whole)
    }
}

/// The bytes of the record's file, which differ after every commit; none where there is no such file.
#[must_use]
pub fn commit_stamp(own: &Path) -> Option<Vec<u8>> {
    read_bytes(&own.join(RECORD), LARGEST).ok()
}

impl Entry {
    /// Where it is, and where its temporary is.
    ///
    /// # Errors
    /// When one of them leads out of the project: the record is not this program's.
    pub(super) fn paths(&self, root: &Path) -> Result<(PathBuf, Option<PathBuf>)> {
        let target = inside(root, &self.path)?;
        let Some(name) = &self.temporary else { return Ok((target, None)) };
        if !is_temporary(name) || name.contains(['/', '\\']) {
            return Err(Fault::new(format!("`{name}` is no temporary file's name"))
                .help("the record of the last save is damaged: move .lianpu/commit aside"));
        }
        let beside = target.with_file_name(name);
        Ok((target, Some(beside)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> Record {
        let new = Some(Sum::of(b"new"));
        let temporary = Some(".lianpu-0-1-x".to_owned());
        Record { files: vec![Entry { path: "clips/a/score.toml".into(), old: None, new, temporary }] }
    }

    #[test]
    fn a_record_that_is_cut_off_anywhere_is_none() {
        let line = record().to_line().unwrap().into_bytes();
        for end in 0..line.len() {
            assert_eq!(Record::parse(&line[..end]), None, "{end}");
        }
        assert_eq!(Record::parse(&line), Some(record()));
        for end in 1..DONE.len() {
            assert_eq!(Record::parse(&[&line, &DONE[..end]].concat()), Some(record()), "{end}");
        }
        assert_eq!(Record::parse(&[&line, DONE].concat()), None);
        assert_eq!(Record::parse(&[&line, &DONE[..2], DONE].concat()), None);
    }

    #[test]
    fn a_record_names_no_file_outside_its_project() {
        let root = tempfile::tempdir().unwrap();
        let mut entry = record().files.remove(0);
        assert!(entry.paths(root.path()).is_ok());
        entry.temporary = Some(".lianpu-/../x".into());
        assert!(entry.paths(root.path()).is_err());
        entry.path = "../x".into();
        assert!(entry.paths(root.path()).is_err());
    }
}
