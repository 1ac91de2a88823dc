//! Where a command writes the file that it was asked for: never over what it reads, nor over the files of a lesson.

use std::path::{Component, Path};

use crate::disk::{Fault, Result};
use crate::project::MANIFEST;

/// The folders of a lesson that hold what its author made.
const KEPT: [&str; 6] = ["faces", "clips", "figures", "styles", "layers", ".lianpu"];

/// Makes sure that writing at `path` takes nobody's work: there is none of the `inputs`, and no file of a lesson. Called
/// before anything is computed.
///
/// # Errors
/// Of the call, when one of them would be written over.
pub(super) fn spare(path: &Path, inputs: &[&Path]) -> Result<()> {
    // What is not there, or no file that could be replaced, takes nothing.
    let Ok(real) = path.canonicalize() else { return Ok(()) };
    if !real.is_file() {
        return Ok(());
    }
    let refused = |what: &str, help: &str| Err(Fault::new(what).at(path).help(help).of_the_call());
    if inputs.iter().any(|input| input.canonicalize().is_ok_and(|input| input == real)) {
        return refused("it would be written over the file that it is made from", "give another name");
    }
    if real.ancestors().skip(1).any(|root| is_of_lesson(&real, root)) {
        return refused(
            "it would be written over a file of the lesson",
            "give another name, or move that file away first",
        );
    }
    Ok(())
}

/// Whether a file is what the author of the lesson in `root` made, if one is there.
fn is_of_lesson(file: &Path, root: &Path) -> bool {
    let below = file.strip_prefix(root).ok().and_then(|below| match below.components().next() {
        Some(Component::Normal(name)) => name.to_str(),
        _ => None,
    });
    below.is_some_and(|name| name == MANIFEST || KEPT.contains(&name)) && root.join(MANIFEST).is_file()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn neither_what_is_read_nor_a_file_of_a_lesson_is_written_over() {
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        for name in ["p/lianpu.toml", "p/clips/a/timing.TextGrid", "p/export/a.srt", "p/chart.svg", "in.srt", "clips/b"]
        {
            fs::create_dir_all(at(name).parent().unwrap()).unwrap();
            fs::write(at(name), "").unwrap();
        }
        let is_spared = |name: &str| spare(&at(name), &[&at("in.srt")]).is_err();
        for name in ["p/lianpu.toml", "p/clips/a/timing.TextGrid", "in.srt", "p/../in.srt"] {
            assert!(is_spared(name), "{name}");
        }
        for name in ["p/export/a.srt", "p/chart.svg", "new.srt", "p/clips/a/new.TextGrid", "clips/b"] {
            assert!(!is_spared(name), "{name}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_what_is_read_is_no_way_around() {
        let dir = tempfile::tempdir().unwrap();
        let (file, link) = (dir.path().join("in.wav"), dir.path().join("out.srt"));
        fs::write(&file, "").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        assert!(spare(&link, &[&file]).is_err());
        assert!(spare(Path::new("/dev/null"), &[&file]).is_ok());
    }
}
