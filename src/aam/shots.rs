//! A folder of pictures and their annotations.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::annotation::Annotation;
use crate::disk::{Fault, FileFault, Result, inside, list};
use crate::geometry::Point;
use crate::photo::Grey;

/// A picture and the points in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// The picture's file.
    pub path: PathBuf,
    /// Its luma.
    pub grey: Grey,
    /// The points in pixels.
    pub points: Vec<Point>,
}

/// The endings of annotations.
const ANNOTATIONS: [&str; 4] = ["pts", "asf", "xml", "toml"];
/// The endings of pictures, as they are looked for beside an annotation.
const PICTURES: [&str; 5] = ["png", "jpg", "jpeg", "webp", "JPG"];
/// The most pictures that a folder is read for: a model of more has nothing to gain.
const MOST: usize = 2000;

impl Shot {
    /// The annotated pictures of a folder, in the order of their names. A picture belongs to an annotation that names
    /// it or that has its name but for the ending; beside a `face.toml` it is `neutral`.
    ///
    /// # Errors
    /// When the folder or a file in it cannot be read, a picture is missing, or one is annotated twice.
    pub fn read_folder(folder: &Path) -> Result<Vec<Self>> {
        let paths = list(folder).map_err(|e| Fault::io("cannot open the folder", folder, e))?;
        let files: Vec<PathBuf> = paths.into_iter().filter(|p| is_annotation(p)).collect();
        let mut shots: Vec<Self> = Vec::new();
        let mut seen = BTreeSet::new();
        for file in &files {
            for annotation in Annotation::read(file)? {
                let path = picture_of(folder, file, &annotation)?;
                let boxed = annotation.face.is_some();
                if !seen.insert(path.clone()) && !boxed {
                    return Err(Fault::of(FileFault::Duplicate, "a picture is annotated twice")
                        .at(&path)
                        .help("keep one annotation a picture in the folder"));
                }
                if shots.len() == MOST {
                    return Err(Fault::of(FileFault::TooLarge, format!("there are more than {MOST} pictures"))
                        .at(folder)
                        .help("take fewer"));
                }
                let grey = Grey::read(&path)?;
                let points = annotation.in_pixels([grey.width(), grey.height()]);
                shots.push(Self { path, grey, points });
            }
        }
        if shots.is_empty() {
            return Err(Fault::of(FileFault::Empty, "there are no annotated pictures")
                .at(folder)
                .help("put pictures and their .pts, .asf or dlib .xml there"));
        }
        Ok(shots)
    }
}

fn is_annotation(path: &Path) -> bool {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    // Of our own files only a face has points.
    let own = ending == "toml" && path.file_name().is_none_or(|n| n != "face.toml");
    ANNOTATIONS.contains(&ending.as_str()) && !own && path.is_file()
}

/// The picture that an annotation is of.
fn picture_of(folder: &Path, file: &Path, annotation: &Annotation) -> Result<PathBuf> {
    if let Some(name) = &annotation.picture {
        let named = inside(folder, name).map_err(|f| f.at(file));
        match named {
            Ok(path) if path.is_file() => return Ok(path),
            // imglab writes paths; an .asf may have been renamed with its picture.
            Err(fault) if annotation.face.is_some() => return Err(fault),
            _ => {}
        }
    }
    let neutral = file.file_name().is_some_and(|n| n == "face.toml");
    let stem = if neutral { folder.join("neutral.x") } else { file.to_owned() };
    let beside = PICTURES.iter().map(|e| stem.with_extension(e)).find(|p| p.is_file());
    beside.ok_or_else(|| {
        let name = annotation.picture.clone().unwrap_or_else(|| stem.with_extension("jpg").display().to_string());
        Fault::of(FileFault::Missing, format!("the picture of an annotation is missing: `{name}`"))
            .at(file)
            .help("put it beside its annotation")
    })
}
