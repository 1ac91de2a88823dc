//! What an export wrote, with checksums: `manifest.json` of a whole export, `manifest-2-of-3.json` of a part of one.
//!
//! It holds no time and no path of this machine: the same lessons give the same manifest wherever they are exported. A
//! part's manifest is written last, so that it says that the part is done.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::{ExportFault, Shard};
use crate::disk::{self, Fault, Result, read_bytes, read_old, write_whole};

/// The largest manifest that is read: a million frames have 150 MB.
const MAX_BYTES: u64 = 1 << 30;

/// The form of the file that this program writes and reads.
const FORMAT: u32 = 1;

/// What an export wrote.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// The form of this file.
    pub format: u32,
    /// The program and its version: another one may draw otherwise.
    pub program: String,
    /// Which part of the export this is, as `2/3`; none where it is the whole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<String>,
    /// What the whole export was asked for, a clip each.
    pub clips: Vec<Asked>,
    /// What this part of it wrote or found right, by path.
    pub files: Vec<Entry>,
}

/// What was asked of one clip, over all parts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asked {
    /// The project's name.
    pub project: String,
    /// The clip's name.
    pub clip: String,
    /// Whatever changes its files beside the lesson itself: size, frames a second, background.
    pub settings: BTreeMap<String, String>,
    /// Where its frames lie, from the manifest's folder; empty without frames.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub folder: String,
    /// The forms that are one file a frame, by their endings.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frame_forms: Vec<String>,
    /// The frames, as first and last of each run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<(u32, u32)>,
    /// Its files that are not frames, from the manifest's folder.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub whole: Vec<String>,
}

impl Asked {
    /// How many frames were asked for, whatever forms they take.
    #[must_use]
    pub(crate) fn count(&self) -> u32 {
        self.frames.iter().map(|(a, b)| b.saturating_sub(*a).saturating_add(1)).fold(0, u32::saturating_add)
    }

    /// The frames one by one.
    pub(super) fn numbers(&self) -> Vec<u32> {
        self.frames.iter().flat_map(|(a, b)| *a..=*b).collect()
    }

    /// The file of a frame, from the manifest's folder.
    pub(super) fn path_of(&self, frame: u32, form: &str) -> String {
        format!("{}/{frame:06}.{form}", self.folder)
    }

    /// Every file that was asked for, with the place of its frame among the clip's; whole files are at place 0.
    pub(super) fn files(&self) -> impl Iterator<Item = (u32, String)> + '_ {
        let numbers = self.frames.iter().flat_map(|(a, b)| *a..=*b);
        let frames = (0..).zip(numbers).flat_map(move |(place, number)| {
            self.frame_forms.iter().map(move |form| (place, self.path_of(number, form)))
        });
        self.whole.iter().map(|path| (0, path.clone())).chain(frames)
    }

    /// Frame numbers, rising, as first and last of each run.
    #[must_use]
    pub fn runs(frames: &[u32]) -> Vec<(u32, u32)> {
        let mut runs: Vec<(u32, u32)> = Vec::new();
        for frame in frames {
            match runs.last_mut() {
                Some(run) if run.1 + 1 == *frame => run.1 += 1,
                _ => runs.push((*frame, *frame)),
            }
        }
        runs
    }
}

/// One file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// From the manifest's folder, with `/` between its parts.
    pub path: String,
    /// Its length.
    pub bytes: u64,
    /// SHA-256 of its content, in hexadecimal digits.
    pub sha256: String,
    /// What it was made from, for forms that cannot tell themselves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
}

impl Entry {
    /// Of content in memory.
    #[must_use]
    pub fn of(path: String, content: &[u8]) -> Self {
        Self { path, bytes: content.len() as u64, sha256: hex(&Sha256::digest(content)), key: None }
    }

    /// Of a file.
    ///
    /// # Errors
    /// When it cannot be read.
    pub(crate) fn read(folder: &Path, path: String) -> Result<Self> {
        let full = folder.join(&path);
        let mut file = disk::open(&full).map_err(|e| Fault::io("cannot open it", &full, e))?;
        let mut sum = Sha256::new();
        let bytes = add_content(&mut sum, &mut file).map_err(|e| Fault::io("cannot read it", &full, e))?;
        Ok(Self { path, bytes, sha256: hex(&sum.finalize()), key: None })
    }

    /// The same with a word on what it was made from.
    #[must_use]
    pub fn made_from(mut self, key: impl Into<String>) -> Self {
        self.key = Some(key.into());
        self
    }
}

/// Adds what a file holds, a little at a time; says how much it was.
pub(super) fn add_content(sum: &mut Sha256, file: &mut File) -> std::io::Result<u64> {
    let mut part = vec![0; 1 << 16];
    let mut bytes = 0;
    loop {
        let count = file.read(&mut part)?;
        if count == 0 {
            return Ok(bytes);
        }
        sum.update(&part[..count]);
        bytes += count as u64;
    }
}

pub(super) fn hex(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 16] = b"0123456789abcdef";
    let digits = bytes.iter().flat_map(|b| [DIGITS[usize::from(b >> 4)], DIGITS[usize::from(b & 15)]]);
    digits.map(char::from).collect()
}

impl Manifest {
    /// Of an export or a part of one. Files are put in order.
    #[must_use]
    pub fn new(shard: Shard, clips: Vec<Asked>, mut files: Vec<Entry>) -> Self {
        files.sort_by(|a, b| a.path.cmp(&b.path));
        files.dedup_by(|a, b| a.path == b.path);
        Self {
            format: FORMAT,
            program: format!("{} {}", env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION")),
            shard: (shard != Shard::WHOLE).then(|| shard.to_string()),
            clips,
            files,
        }
    }

    /// What its file is called: the number is as long as the highest, so that files sort.
    #[must_use]
    pub fn name(shard: Shard) -> String {
        if shard == Shard::WHOLE {
            return "manifest.json".into();
        }
        let (index, count) = (shard.index(), shard.count());
        let digits = count.to_string().len();
        format!("manifest-{index:0digits$}-of-{count}.json")
    }

    /// Which part it is of.
    ///
    /// # Errors
    /// When it says something that is none.
    pub(crate) fn part(&self) -> Result<Shard> {
        match &self.shard {
            None => Ok(Shard::WHOLE),
            Some(text) => text.parse().map_err(Fault::new),
        }
    }

    /// The entry of a path.
    #[must_use]
    pub(crate) fn entry(&self, path: &str) -> Option<&Entry> {
        self.files.binary_search_by(|e| e.path.as_str().cmp(path)).ok().map(|at| &self.files[at])
    }

    /// Whether a file is there that was made from this, as it was written: then it need not be made again.
    #[must_use]
    pub fn holds(&self, folder: &Path, path: &str, key: &str) -> bool {
        self.entry(path).is_some_and(|entry| {
            entry.key.as_deref() == Some(key)
                && Entry::read(folder, path.to_owned())
                    .is_ok_and(|now| now.bytes == entry.bytes && now.sha256 == entry.sha256)
        })
    }

    /// Reads one; paths in it that lead out of its folder are refused.
    ///
    /// # Errors
    /// When the file cannot be read or is no manifest of this version.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = read_bytes(path, MAX_BYTES)?;
        let damaged = |what: String| {
            Fault::of(ExportFault::Manifest, what).at(path).help("remove it and run the export it belongs to again")
        };
        let read: Self = serde_json::from_slice(&bytes)
            .map_err(|e| damaged(format!("this is no manifest of an export: {e}")).line(e.line().max(1)))?;
        if read.format != FORMAT {
            let newer = format!("the manifest has form {}, this program reads form {FORMAT}", read.format);
            return Err(Fault::of(ExportFault::Manifest, newer)
                .at(path)
                .help("use the version of the program that wrote it"));
        }
        read.part().map_err(|f| damaged(f.what().to_owned()))?;
        let leads_out = |p: &str| {
            let parts = Path::new(p).components();
            p.is_empty() || parts.into_iter().any(|c| !matches!(c, Component::Normal(_)))
        };
        let named = read.files.iter().map(|e| &e.path).chain(read.clips.iter().flat_map(|c| &c.whole));
        let folders = read.clips.iter().map(|c| &c.folder).filter(|f| !f.is_empty());
        if let Some(out) = named.chain(folders).find(|p| leads_out(p)) {
            return Err(damaged(format!("`{out}` leads out of the manifest's folder")));
        }
        if !read.files.is_sorted_by(|a, b| a.path < b.path) {
            return Err(damaged("the files are not in order".into()));
        }
        Ok(read)
    }

    /// Writes it into its folder and says where.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        let name = Self::name(self.part()?);
        self.write_as(folder, &name)?;
        Ok(folder.join(name))
    }

    pub(super) fn write_as(&self, folder: &Path, name: &str) -> Result<()> {
        let path = folder.join(name);
        let text = self.to_json()?;
        if read_old(&path).is_some_and(|old| old == text.as_bytes()) {
            return Ok(());
        }
        write_whole(&path, text.as_bytes())
    }

    /// JSON with a line for each clip and each file, so that two of them can be compared.
    fn to_json(&self) -> Result<String> {
        let mut lines = vec![
            "{".to_owned(),
            format!("\"format\": {},", self.format),
            format!("\"program\": {},", json_of(&self.program)?),
        ];
        if let Some(shard) = &self.shard {
            lines.push(format!("\"shard\": {},", json_of(shard)?));
        }
        lines.push("\"clips\": [".into());
        for (i, clip) in self.clips.iter().enumerate() {
            lines.push(format!("  {}{}", json_of(clip)?, if i + 1 < self.clips.len() { "," } else { "" }));
        }
        lines.push("],\n\"files\": [".into());
        for (i, file) in self.files.iter().enumerate() {
            lines.push(format!("  {}{}", json_of(file)?, if i + 1 < self.files.len() { "," } else { "" }));
        }
        lines.push("]\n}\n".into());
        Ok(lines.join("\n"))
    }
}

fn json_of<T: Serialize>(value: &T) -> Result<String> {
    serde_json::to_string(value)
        .map_err(|e| Fault::of(ExportFault::Manifest, format!("the manifest cannot be written: {e}")))
}

/// A path as manifests have it: from their folder on, with `/` between its parts.
pub(super) fn within(root: &Path, path: &Path) -> String {
    let inside = path.strip_prefix(root).unwrap_or(path);
    let parts = inside.components().filter_map(|part| match part {
        Component::Normal(name) => Some(name.to_string_lossy()),
        _ => None,
    });
    parts.collect::<Vec<_>>().join("/")
}
