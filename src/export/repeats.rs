//! Frames that show what another one does: they need not be drawn again, nor written.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;
use std::str::FromStr;

use crate::disk::{self, Fault, Result, settle, temporary_prefix};
use crate::pose::Pose;

/// What is done about frames that are equal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dedupe {
    /// They are one file under several names (hard links), or copies where the disk has no links. A frame that
    /// changes later becomes a file of its own; a program that writes into one of them in place changes all.
    #[default]
    Link,
    /// They are copies, which share their blocks where the disk can do so.
    Copy,
    /// Each is made by itself.
    None,
}

impl FromStr for Dedupe {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "link" => Ok(Self::Link),
            "copy" => Ok(Self::Copy),
            "none" => Ok(Self::None),
            _ => Err(format!("`{text}` is no way to keep equal frames: write link, copy or none")),
        }
    }
}

/// Frames by what they show.
pub(super) struct Repeats {
    /// The first frame of every pose, in order.
    pub(super) first: Vec<u32>,
    /// The others, each with the place in `first` of the one that it repeats.
    pub(super) others: Vec<(u32, usize)>,
}

impl Repeats {
    /// Sorts frames by their poses, rounded.
    pub(super) fn of(frames: &[u32], pose: impl Fn(u32) -> Pose) -> Self {
        let mut places: HashMap<[u64; 25], usize> = HashMap::new();
        let mut all = Self { first: Vec::new(), others: Vec::new() };
        for frame in frames {
            match places.entry(numbers(&pose(*frame))) {
                Entry::Occupied(place) => all.others.push((*frame, *place.get())),
                Entry::Vacant(place) => {
                    place.insert(all.first.len());
                    all.first.push(*frame);
                }
            }
        }
        all
    }
}

/// All numbers of a pose. The shape that a mouth is nearest to is told in words, not drawn.
fn numbers(pose: &Pose) -> [u64; 25] {
    let (g, l, h) = (pose.gaze, pose.lids, pose.head);
    let rest = [g.x, g.y, l.left, l.right, h.x, h.y, h.roll];
    let mut all = pose.ratios.0.into_iter().chain(pose.mouth.to_array()).chain(rest);
    std::array::from_fn(|_| all.next().map_or(0, f64::to_bits))
}

/// Gives what `from` holds to `path` as well, which is whole at any moment and a name of its own afterwards. Returns
/// how many bytes were written.
pub(super) fn repeat(from: &Path, path: &Path, dedupe: Dedupe) -> Result<u64> {
    // Where the disk has no links, or no more of this file, it is copied.
    if dedupe == Dedupe::Link {
        // A link is made whole, where nothing is in its place.
        if disk::link(from, path).is_ok() || in_place(path, |beside| disk::link(from, beside)).is_ok() {
            return Ok(0);
        }
    }
    let mut bytes = 0;
    in_place(path, |beside| disk::copy(from, beside).map(|n| bytes = n))
        .map_err(|e| Fault::io("cannot write it", path, e))?;
    Ok(bytes)
}

/// Makes a file beside `path` and puts it into its place: never changed where it stands, for it may be a link itself.
fn in_place(path: &Path, mut make: impl FnMut(&Path) -> std::io::Result<()>) -> std::io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let beside = tempfile::Builder::new().prefix(&temporary_prefix()).make_in(folder, |beside| make(beside))?;
    settle(beside.into_temp_path(), path)
}
