//! A disk on which one call of a commit fails, or after which the process is dead or the power gone.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{Error, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use lianpu::disk::{Calls, Handle, Rights, temporary_prefix};

/// What goes wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum How {
    /// The process dies in the call: half a write is made, and nothing after it.
    Dies,
    /// The same, and what was not flushed is lost, or is there, by the bits of a number.
    LosesPower(u64),
    /// The call fails with this error, and the next ones do not.
    FailsOnce(i32),
    /// The call and all that follow fail with this error.
    Fails(i32),
}

/// Something that is not on the disk for sure.
#[derive(Debug)]
enum Unflushed {
    /// Bytes of a file, and those before.
    Bytes(PathBuf, Vec<u8>),
    /// A file's name.
    Name(PathBuf),
    /// A name that was given to another file, and the bytes of the one that had it.
    Renamed(PathBuf, PathBuf, Option<Vec<u8>>),
    /// A file's removal, and its bytes.
    Removed(PathBuf, Vec<u8>),
}

/// The disk. Flushing is not waited for.
#[derive(Debug)]
pub struct Disk {
    at: usize,
    how: How,
    /// The calls so far.
    pub calls: usize,
    dead: bool,
    unflushed: Vec<Unflushed>,
}

impl Disk {
    /// One on which the call number `at`, from 1 on, goes wrong; none with 0.
    pub fn new(at: usize, how: How) -> Self {
        Self { at, how, calls: 0, dead: false, unflushed: Vec::new() }
    }

    /// One on which all goes well.
    pub fn sound() -> Self {
        Self::new(0, How::Dies)
    }

    fn step(&mut self) -> Result<()> {
        let gone = || Err(Error::other("the process is dead"));
        if self.dead {
            return gone();
        }
        self.calls += 1;
        let now = self.calls == self.at;
        match self.how {
            How::Dies if now => {
                self.dead = true;
                gone()
            }
            How::LosesPower(bits) if now => {
                self.dead = true;
                self.lose(bits);
                gone()
            }
            How::FailsOnce(error) if now => Err(Error::from_raw_os_error(error)),
            How::Fails(error) if self.at > 0 && self.calls >= self.at => Err(Error::from_raw_os_error(error)),
            _ => Ok(()),
        }
    }

    /// Takes back what was not flushed, the last first, where its bit is set.
    fn lose(&mut self, bits: u64) {
        for (place, what) in std::mem::take(&mut self.unflushed).into_iter().enumerate().rev() {
            if bits >> (place % 64) & 1 == 0 {
                continue;
            }
            match what {
                Unflushed::Bytes(path, before) if path.exists() => fs::write(path, before).unwrap(),
                Unflushed::Name(path) if path.exists() => fs::remove_file(path).unwrap(),
                Unflushed::Renamed(from, to, before) if to.exists() => {
                    fs::rename(&to, &from).unwrap();
                    before.into_iter().for_each(|bytes| fs::write(&to, bytes).unwrap());
                }
                Unflushed::Removed(path, bytes) => fs::write(path, bytes).unwrap(),
                _ => {}
            }
        }
    }
}

impl Calls for Disk {
    fn create_folder(&mut self, folder: &Path) -> Result<()> {
        self.step()?;
        fs::create_dir_all(folder)
    }

    fn create(&mut self, folder: &Path, ending: &str) -> Result<Handle> {
        self.step()?;
        static NAMES: AtomicUsize = AtomicUsize::new(0);
        let number = NAMES.fetch_add(1, Ordering::Relaxed);
        // The name of a process that is dead: there is none of the highest number.
        let own = temporary_prefix();
        let machine = own.trim_end_matches('-').rsplit_once('-').unwrap().0;
        let path = folder.join(format!("{machine}-4294967295-{number}{ending}"));
        let file = File::options().write(true).create_new(true).open(&path)?;
        self.unflushed.push(Unflushed::Name(path.clone()));
        Ok(Handle { file, path })
    }

    fn open(&mut self, path: &Path) -> Result<Handle> {
        self.step()?;
        let is_new = !path.exists();
        let file = File::options().append(true).create(true).open(path)?;
        if is_new {
            self.unflushed.push(Unflushed::Name(path.to_owned()));
        }
        Ok(Handle { file, path: path.to_owned() })
    }

    fn set_rights(&mut self, _handle: &Handle, _rights: Rights) -> Result<()> {
        self.step()
    }

    fn write(&mut self, handle: &mut Handle, bytes: &[u8]) -> Result<()> {
        self.unflushed.push(Unflushed::Bytes(handle.path.clone(), fs::read(&handle.path).unwrap_or_default()));
        if !self.dead && self.calls + 1 == self.at {
            let _ = handle.file.write_all(&bytes[..bytes.len() / 2]);
        }
        self.step()?;
        handle.file.write_all(bytes)
    }

    fn truncate(&mut self, handle: &mut Handle) -> Result<()> {
        self.step()?;
        self.unflushed.push(Unflushed::Bytes(handle.path.clone(), fs::read(&handle.path)?));
        handle.file.set_len(0)
    }

    fn sync(&mut self, handle: &Handle) -> Result<()> {
        self.step()?;
        self.unflushed.retain(|u| !matches!(u, Unflushed::Bytes(path, _) if *path == handle.path));
        Ok(())
    }

    fn rename(&mut self, from: &Path, to: &Path) -> Result<()> {
        self.step()?;
        self.unflushed.push(Unflushed::Renamed(from.to_owned(), to.to_owned(), fs::read(to).ok()));
        fs::rename(from, to)
    }

    fn remove(&mut self, path: &Path) -> Result<()> {
        self.step()?;
        self.unflushed.push(Unflushed::Removed(path.to_owned(), fs::read(path)?));
        fs::remove_file(path)
    }

    fn sync_folder(&mut self, folder: &Path) -> Result<()> {
        self.step()?;
        self.unflushed.retain(|u| match u {
            Unflushed::Bytes(..) => true,
            Unflushed::Name(path) | Unflushed::Removed(path, _) | Unflushed::Renamed(_, path, _) => {
                path.parent() != Some(folder)
            }
        });
        Ok(())
    }
}

/// The files below a folder, without the program's own: path and bytes.
pub fn files(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if entry.file_name() == ".lianpu" {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else {
                found.insert(path.strip_prefix(root).unwrap().to_owned(), fs::read(&path).unwrap());
            }
        }
    }
    found
}
