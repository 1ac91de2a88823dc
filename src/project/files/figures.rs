//! Which figure a face is drawn as: the cartoon of its points in a style, or a line figure.

use std::path::Path;

use super::face::LessonFace;
use super::manifest::{LayerEntry, MANIFEST};
use super::names::FACE_FILE;
use crate::disk::{Fault, FileFault, Result, Task, inside, message, read_bytes, read_text};
use crate::figure::cartoon::Style;
use crate::figure::{AuthorLayer, Cartoon, Figure, LineFigure, MAX_LAYER_BYTES};
use crate::project::ProjectFault;

/// The figure of a face; the line face where there is no face.
pub(in crate::project) fn figure(root: &Path, face: Option<&LessonFace>) -> Result<Figure> {
    let Some(face) = face else { return LineFigure::built_in("line").map(Figure::from) };
    let default = if face.has_cartoon() { "cartoon" } else { "line" };
    let named = face.entry.figure.as_deref().unwrap_or(default);
    if named == "cartoon" {
        return cartoon(root, face);
    }
    if named.starts_with("figures/") {
        let path = own_file(root, "figure", named, "write figure = \"line\"")?;
        return LineFigure::parse(&read_text(&path)?).map(Figure::from).map_err(|f| f.at(&path));
    }
    LineFigure::built_in(named).map(Figure::from).map_err(|f| in_manifest(root, "figure", named, f))
}

/// The cartoon of a face in its style, with its author's layers.
pub(in crate::project) fn cartoon(root: &Path, face: &LessonFace) -> Result<Figure> {
    let points = face.points()?.ok_or_else(|| {
        let help = match face.photo {
            Some(_) => message![Task::FindFace, " finds them"],
            None => {
                format!("put a photo there as faces/{}/neutral.png, or write figure = \"line\"", face.entry.name).into()
            }
        };
        Fault::of(
            ProjectFault::Incomplete,
            format!("the face `{}` has no points yet, so its cartoon cannot be drawn", face.entry.name),
        )
        .at(face.folder.join(FACE_FILE))
        .help(help)
    })?;
    let style = style(root, face)?;
    let mut cartoon = Cartoon::new(&points, &style);
    if let Some(file) = &face.calibration {
        cartoon = cartoon.with_expressions(file.calibration.expressions());
    }
    if face.entry.layers.is_empty() {
        return Ok(cartoon.into());
    }
    let view = cartoon.view();
    let layers =
        face.entry.layers.iter().map(|entry| Ok(layer(root, entry)?.extra(view))).collect::<Result<Vec<_>>>()?;
    Ok(cartoon.with(layers).into())
}

/// The style that a face names, built in or a file of the lesson.
pub(in crate::project) fn style(root: &Path, face: &LessonFace) -> Result<Style> {
    let named = face.entry.style.as_deref().unwrap_or("normal");
    if named.starts_with("styles/") {
        let path = own_file(root, "style", named, "write style = \"normal\"")?;
        return Style::parse(&read_text(&path)?).map_err(|f| f.at(&path));
    }
    Style::built_in(named).map_err(|f| in_manifest(root, "style", named, f))
}

/// An author's own layer.
pub(in crate::project) fn layer(root: &Path, entry: &LayerEntry) -> Result<AuthorLayer> {
    let path = own_file(root, "file", &entry.file, "take the layer out of lianpu.toml")?;
    let bytes = read_bytes(&path, MAX_LAYER_BYTES)?;
    let text = std::str::from_utf8(&bytes).map_err(|_| {
        Fault::of(FileFault::Encoding, "the file is not UTF-8 text").at(&path).help("save it as plain SVG")
    })?;
    AuthorLayer::parse(text, entry.place).map_err(|f| f.at(&path))
}

/// A file of the lesson that the manifest names.
fn own_file(root: &Path, key: &str, named: &str, else_do: &str) -> Result<std::path::PathBuf> {
    let path = inside(root, named).map_err(|f| in_manifest(root, key, named, f))?;
    if path.is_file() {
        return Ok(path);
    }
    let fault =
        Fault::new(format!("there is no file `{named}` in the lesson")).help(format!("put it there, or {else_do}"));
    Err(in_manifest(root, key, named, fault))
}

/// The fault at the manifest's line that names the thing.
fn in_manifest(root: &Path, key: &str, named: &str, fault: Fault) -> Fault {
    let line = read_text(&root.join(MANIFEST))
        .ok()
        .and_then(|text| text.lines().position(|l| l.contains(key) && l.contains(named)));
    let fault = fault.at(root.join(MANIFEST));
    match line {
        Some(line) => fault.line(line + 1),
        None => fault,
    }
}
