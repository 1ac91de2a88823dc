//! What an export is asked for, clip by clip, known before anything is made: all parts of a divided export tell the same.

use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use sha2::{Digest, Sha256};

use super::manifest::{add_content, hex, within};
use super::plan::{checked_output, chosen_clips, frames_asked, out_folder, root_folder, texts_of};
use super::whole::TOGETHER;
use super::{Asked, ExportFault, Format, Request, wholes};
use crate::disk::{self, Fault, FileFault, Result, Setting, message};
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
    let project = project_name(lesson)?;
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
            project: project.clone(),
            clip: entry.name.clone(),
            settings: settings(lesson, number, request, &output)?,
            folder: if frame_forms.is_empty() { String::new() } else { within(&root, &out.join(&entry.name)) },
            frame_forms,
            frames: Asked::runs(&frames),
            whole: whole.map(|path| within(&root, &path)).collect(),
        });
    }
    if request.clip.as_deref() == Some(TOGETHER) && request.formats.iter().any(|f| f.is_of_the_lesson()) {
        return Err(Fault::of(
            ExportFault::NamesClash,
            format!("the page of the clip `{TOGETHER}` would take the name of the whole lesson's"),
        )
        .help(message!["rename the clip, or leave out ", Setting::Clip])
        .of_the_call());
    }
    check_names(&all, request.by_project && request.out.is_some())?;
    Ok(all)
}

/// The lesson by its folder, as several are told apart that go into one place.
fn project_name(lesson: &Lesson) -> Result<String> {
    let full = lesson.root.canonicalize().unwrap_or_else(|_| lesson.root.clone());
    let Some(name) = full.file_name() else { return Ok(String::new()) };
    let name = name.to_str().map(str::to_owned);
    name.ok_or_else(|| {
        Fault::of(FileFault::Encoding, "the folder's name is not in UTF-8, which a manifest's must be")
            .at(&full)
            .help("rename the folder")
    })
}

/// Whatever changes a clip's files: parts that differ in it are parts of different exports.
fn settings(
    lesson: &Lesson,
    clip: usize,
    request: &Request,
    output: &crate::project::Output,
) -> Result<BTreeMap<String, String>> {
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
        ("lesson".to_owned(), state_of(lesson, clip)?),
    ]);
    if let Some(width) = request.width {
        all.insert("width".into(), width.name().into());
    }
    if request.thesis && request.formats.contains(&Format::Smil) {
        all.insert("smil".into(), "thesis".into());
    }
    Ok(all)
}

/// Folders in folders beyond this depth are no part of a lesson.
const DEEP: u32 = 8;

/// Sixteen digits that change with the files a clip, its faces, figures and styles are kept in. No file's place or time is
/// among them, so that copies of a lesson on several machines agree. Links count by where they lead, and what is neither
/// file nor folder by its name.
fn state_of(lesson: &Lesson, clip: usize) -> Result<String> {
    let mut sum = Sha256::new();
    let root = &lesson.root;
    add(&mut sum, root, &root.join("lianpu.toml"), DEEP)?;
    add(&mut sum, root, &root.join("clips").join(&lesson.clips[clip].entry.name), DEEP)?;
    for folder in ["faces", "figures", "styles", "layers"] {
        add(&mut sum, root, &root.join(folder), DEEP)?;
    }
    Ok(hex(&sum.finalize())[..16].to_owned())
}

fn add(sum: &mut Sha256, root: &Path, path: &Path, deep: u32) -> Result<()> {
    let fault = |e| Fault::io("cannot read it", path, e);
    let about = match fs::symlink_metadata(path) {
        Ok(about) => about,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(()),
        Err(e) => return Err(fault(e)),
    };
    let name = within(root, path);
    sum.update(name.len().to_le_bytes());
    sum.update(name);
    if about.is_symlink() {
        sum.update(fs::read_link(path).map_err(fault)?.as_os_str().as_encoded_bytes());
    } else if about.is_file() {
        sum.update(about.len().to_le_bytes());
        let mut file = disk::open(path).map_err(fault)?;
        add_content(sum, &mut file).map_err(fault)?;
    } else if about.is_dir() && deep > 0 {
        let paths = disk::list(path).map_err(fault)?;
        for path in paths.iter().filter(|p| p.file_name().is_some_and(|n| !n.to_string_lossy().starts_with('.'))) {
            add(sum, root, path, deep - 1)?;
        }
    }
    Ok(())
}

/// Two files of one name would be one; no file can be where a folder is; and the manifests have names of their own.
fn check_names(all: &[Asked], by_project: bool) -> Result<()> {
    let is_manifest = |path: &str| path.starts_with("manifest") && path.ends_with(".json") && !by_project;
    let above = |path: &str| path.rsplit_once('/').map(|(folder, _)| folder.to_owned());
    let folders: HashSet<String> = all
        .iter()
        .flat_map(|a| a.whole.iter().filter_map(|path| above(path)).chain([a.folder.clone()]))
        .filter(|folder| !folder.is_empty())
        .collect();
    let mut seen = HashSet::new();
    for path in all.iter().flat_map(|a| &a.whole) {
        if is_manifest(path) || folders.contains(path) || !seen.insert(path) {
            return Err(Fault::of(
                ExportFault::NamesClash,
                format!("two files of this export, or a file and a folder, would be `{path}`"),
            )
            .help(message![
                "export the formats or clips one by one with ",
                Setting::Clip,
                " and ",
                Setting::Out,
                ", or rename a clip"
            ])
            .of_the_call());
        }
    }
    Ok(())
}
