//! A folder of pictures, one a frame, in the natural order of their names.

use std::cmp::Ordering;
use std::path::{Path, PathBuf};

use super::{Coded, Frame};
use crate::disk::{Fault, FileFault, Result, list, read_bytes};
use crate::photo::Grey;
use crate::photo::MAX_PHOTO_BYTES;

/// Endings of the pictures that are frames.
const PICTURES: [&str; 4] = ["png", "jpg", "jpeg", "webp"];
/// The most frames: 11 hours at 25 a second.
const MOST: usize = 1_000_000;

/// The pictures of a folder in order. Hidden files and everything that is no picture are passed over.
pub(super) fn pictures(folder: &Path) -> Result<Vec<PathBuf>> {
    let paths = list(folder).map_err(|e| Fault::io("cannot open the folder of frames", folder, e))?;
    let mut names: Vec<String> = Vec::new();
    for path in paths {
        let Some(name) = path.file_name().and_then(|n| n.to_str()).map(str::to_owned) else { continue };
        let ending = name.rsplit_once('.').map(|(_, e)| e.to_ascii_lowercase()).unwrap_or_default();
        if name.starts_with('.') || !PICTURES.contains(&ending.as_str()) {
            continue;
        }
        if path.is_symlink() {
            return Err(Fault::of(FileFault::Outside, "a frame is a link")
                .at(folder.join(&name))
                .help("copy the picture itself into the folder: nothing outside it is opened"));
        }
        if names.len() == MOST {
            return Err(Fault::of(FileFault::TooLarge, format!("there are more than {MOST} frames"))
                .at(folder)
                .help("cut it into clips"));
        }
        names.push(name);
    }
    if names.is_empty() {
        return Err(Fault::of(FileFault::Empty, "there are no frames in it")
            .at(folder)
            .help("put the video's frames there as PNG, JPEG or WebP, numbered: 0000.jpg, 0001.jpg"));
    }
    names.sort_by(|a, b| natural(a, b));
    Ok(names.iter().map(|name| folder.join(name)).collect())
}

/// Frame `number` of a folder, decoded to grey.
pub(super) fn frame(path: &Path, number: u32, fps: f64) -> Result<Frame> {
    let bytes = read_bytes(path, MAX_PHOTO_BYTES)?;
    let of_frame = |fault: Fault| fault.at(path).help(format!("it is frame {number}; copy it again"));
    let grey = Grey::decode(&bytes).map_err(of_frame)?;
    let time = f64::from(number) / fps;
    Ok(Frame { number, time, grey, colour: Coded::Picture(path.to_owned(), bytes) })
}

/// Names compared as people count: `f9` before `f10`. Names that differ in zeros before a number alone stay in the order of
/// their letters, so that the order is the same everywhere.
fn natural(a: &str, b: &str) -> Ordering {
    let (mut x, mut y) = (a.as_bytes(), b.as_bytes());
    while let (Some(p), Some(q)) = (x.first(), y.first()) {
        if p.is_ascii_digit() && q.is_ascii_digit() {
            let (m, n) = (digits(&mut x), digits(&mut y));
            // Without zeros before it, a longer number is larger.
            let order = m.len().cmp(&n.len()).then_with(|| m.cmp(n));
            if order.is_ne() {
                return order;
            }
        } else {
            if p != q {
                return p.cmp(q);
            }
            (x, y) = (&x[1..], &y[1..]);
        }
    }
    x.len().cmp(&y.len()).then_with(|| a.cmp(b))
}

/// Takes the digits at the front, and gives them without zeros before.
fn digits<'a>(text: &mut &'a [u8]) -> &'a [u8] {
    let end = text.iter().position(|c| !c.is_ascii_digit()).unwrap_or(text.len());
    let (number, rest) = text.split_at(end);
    *text = rest;
    let zeros = number.iter().position(|c| *c != b'0').unwrap_or(number.len());
    &number[zeros..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_ordered_as_people_count() {
        let mut names = ["f10.png", "f9.png", "f09.png", "f1b2.png", "f1b10.png", "a.png", "f0.png", "f.png"];
        names.sort_by(|a, b| natural(a, b));
        assert_eq!(names, ["a.png", "f.png", "f0.png", "f1b2.png", "f1b10.png", "f09.png", "f9.png", "f10.png"]);
        let huge = format!("f1{}.png", "0".repeat(400));
        assert_eq!(natural("f2.png", &huge), Ordering::Less);
    }

    #[test]
    fn other_files_are_passed_over_and_an_empty_folder_is_said() {
        let dir = tempfile::tempdir().unwrap();
        for name in ["2.JPG", "10.jpg", ".hidden.jpg", "notes.txt", "1.webp"] {
            std::fs::write(dir.path().join(name), b"x").unwrap();
        }
        let names: Vec<_> = pictures(dir.path()).unwrap();
        let names: Vec<_> = names.iter().filter_map(|p| p.file_name()?.to_str()).collect();
        assert_eq!(names, ["1.webp", "2.JPG", "10.jpg"]);
        let empty = tempfile::tempdir().unwrap();
        assert!(pictures(empty.path()).unwrap_err().what().contains("no frames"));
        let fault = frame(&dir.path().join("10.jpg"), 2, 25.0).unwrap_err();
        assert!(fault.to_string().contains("10.jpg") && fault.next_step().contains("frame 2"), "{fault}");
    }
}
