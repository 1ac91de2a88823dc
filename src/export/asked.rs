//! What an export is asked for, clip by clip, known before anything is made: all parts of a divided export tell the same.

use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::path::{Component, Path};

use sha2::{Digest, Sha256};

use super::manifest::hex;
use super::plan::{checked_output, chosen_clips, frames_asked, out_folder, root_folder, texts_of};
use super::{Asked, Format, Manifest, Request, Shard, wholes};
use crate::disk::{Fault, Result};
use crate::project::Lesson;
use crate::render::REVISION;

/// What is asked of each clip of a lesson, whatever share of it `request` names.
///
/// # Errors
/// When a clip, size, frame or frame rate cannot be used, or two files would have one name.
pub fn asked(lesson: &Lesson, request: &Request) -> Result<Vec<Asked>> {
    let whole_request = Request { shares: None, ..request.clone() };
    let output = checked_output(lesson, request)?;
    let (root, out) = (root_folder(lesson, request), out_folder(lesson, request));
    let wholes = wholes(lesson, &whole_request)?;
    let mut all = Vec::new();
    for (place, number) in chosen_clips(lesson, request)?.into_iter().enumerate() {
        let entry = &lesson.clips[number].entry;
        let count = lesson.timeline(number, Some(output.fps)).frames();
        let frames = frames_asked(request, &entry.name, count)?;
        let texts = texts_of(request, &entry.name, &out).map(|(_, path)| path);
        // What all clips have in common is the first one's.
        let own = wholes.iter().filter(|w| w.clip.as_ref().map_or(place == 0, |clip| *clip == entry.name));
        let whole = texts.chain(own.flat_map(|w| w.paths(lesson)));
        let frame_forms: Vec<String> =
            request.formats.iter().filter(|f| f.is_frames()).map(|f| f.name().to_owned()).collect();
        all.push(Asked {
            project: project_name(lesson),
            clip: entry.name.clone(),
            settings: settings(lesson, number, request, &output),
            folder: if frame_forms.is_empty() { String::new() } else { within(&root, &out.join(&entry.name)) },
            frame_forms,
            frames: Asked::runs(&frames),
            whole: whole.map(|path| within(&root, &path)).collect(),
        });
    }
    check_names(&all)?;
    Ok(all)
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

/// The lesson by its folder, as several are told apart that go into one place.
pub(super) fn project_name(lesson: &Lesson) -> String {
    let full = lesson.root.canonicalize().unwrap_or_else(|_| lesson.root.clone());
    full.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Whatever changes a clip's files: parts that differ in it are parts of different exports.
fn settings(
    lesson: &Lesson,
    clip: usize,
    request: &Request,
    output: &crate::project::Output,
) -> BTreeMap<String, String> {
    let background = match request.background {
        None => "the figure's".to_owned(),
        Some(None) => "transparent".to_owned(),
        Some(Some(c)) => c.to_string(),
    };
    let mut all = BTreeMap::from([
        ("size".to_owned(), format!("{}x{}", output.size[0], output.size[1])),
        ("fps".to_owned(), output.fps.to_string()),
        ("background".to_owned(), background),
        ("renderer".to_owned(), REVISION.to_string()),
        ("lesson".to_owned(), state_of(lesson, clip)),
    ]);
    if let Some(width) = request.width {
        all.insert("width".into(), width.name().into());
    }
    if request.thesis && request.formats.contains(&Format::Smil) {
        all.insert("smil".into(), "thesis".into());
    }
    all
}

/// Content beyond this many bytes, such as that of a long video, counts by its length alone.
const READ: u64 = 64 << 20;

/// Sixteen digits that change with the files a clip and its face are kept in. No file's place or time is among them, so
/// that copies of a lesson on several machines agree.
fn state_of(lesson: &Lesson, clip: usize) -> String {
    let entry = &lesson.clips[clip].entry;
    let mut sum = Sha256::new();
    add_file(&mut sum, &lesson.root, &lesson.root.join("lianpu.toml"));
    add_folder(&mut sum, &lesson.root, &lesson.root.join("clips").join(&entry.name));
    for face in &lesson.faces {
        add_folder(&mut sum, &lesson.root, &lesson.root.join("faces").join(&face.entry.name));
    }
    hex(&sum.finalize())[..16].to_owned()
}

fn add_folder(sum: &mut Sha256, root: &Path, folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let mut paths: Vec<_> = entries.flatten().map(|e| e.path()).collect();
    paths.sort();
    for path in paths {
        let hidden = path.file_name().is_none_or(|n| n.to_string_lossy().starts_with('.'));
        match (hidden, path.is_dir()) {
            (true, _) => {}
            (false, true) => add_folder(sum, root, &path),
            (false, false) => add_file(sum, root, &path),
        }
    }
}

fn add_file(sum: &mut Sha256, root: &Path, path: &Path) {
    let Ok(about) = fs::metadata(path) else { return };
    sum.update(within(root, path).as_bytes());
    sum.update(about.len().to_le_bytes());
    if about.len() <= READ
        && let Ok(bytes) = fs::read(path)
    {
        sum.update(&bytes);
    }
}

/// Two files of one name would be one, and the manifest's own name is taken.
fn check_names(all: &[Asked]) -> Result<()> {
    let own = Manifest::name(Shard::WHOLE);
    let mut seen = HashSet::from([own.as_str()]);
    for asked in all {
        if let Some(twice) = asked.whole.iter().find(|path| !seen.insert(path.as_str())) {
            return Err(Fault::new(format!("two files of this export would be `{twice}`"))
                .help("export the formats or clips one by one with --clip and --out, or rename a clip")
                .of_the_call());
        }
    }
    Ok(())
}
