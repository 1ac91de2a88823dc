//! The nine mouth shapes of a face as pictures: for programs that put a mouth chart together with times, as Moho and
//! Papagayo do.

use std::path::{Path, PathBuf};

use super::File;
use crate::disk::Result;
use crate::drawing::{Colour, Drawing};
use crate::figure::Figure;
use crate::plot;
use crate::pose::{MouthPose, MouthPreset, MouthShape, Pose};
use crate::render::{Painter, encode_png, to_svg};

/// The files of [`mouths`].
pub(crate) fn paths(base: &Path) -> Vec<PathBuf> {
    let folder = super::with_ending(base, "mouths");
    let shapes = MouthShape::ALL.map(|shape| shape.to_string());
    let names = [REST.to_owned()].into_iter().chain(shapes).chain([CHART.to_owned()]);
    names.flat_map(|name| ["svg", "png"].map(|ending| folder.join(format!("{name}.{ending}")))).collect()
}

/// What the mouth at rest and the chart are called.
const REST: &str = "rest";
const CHART: &str = "chart";

/// Every shape and the mouth at rest, each as SVG and PNG of the whole picture, so that they lie over each other; and a
/// chart of them all.
///
/// # Errors
/// When a picture cannot be painted.
pub(crate) fn mouths(
    figure: &Figure,
    preset: MouthPreset,
    size: [u32; 2],
    background: Option<Option<Colour>>,
    base: &Path,
) -> Result<Vec<File>> {
    let folder = super::with_ending(base, "mouths");
    let rest = Pose::default();
    let mut poses = vec![(REST.to_owned(), rest)];
    poses.extend(
        MouthShape::ALL.map(|s| (s.to_string(), Pose { mouth: MouthPose::of(s, preset), shape: Some(s), ..rest })),
    );
    let mut files = Vec::new();
    let mut painter = Painter::new(size[0], size[1])?;
    for (name, pose) in &poses {
        let mut drawing = figure.draw(pose);
        drawing.title = format!("{}, mouth {name}", figure.title());
        drawing.background = background.unwrap_or(drawing.background);
        files.push(File {
            path: folder.join(format!("{name}.svg")),
            bytes: to_svg(&drawing, size[0], size[1]).into_bytes(),
        });
        files.push(File { path: folder.join(format!("{name}.png")), bytes: encode_png(&painter.paint(&drawing), "")? });
    }
    let close = figure.close_up(1.0);
    let cells: Vec<_> = poses.iter().map(|(name, pose)| (name.clone(), close.draw(pose), None)).collect();
    let chart: Drawing = plot::faces("Mouth shapes", &cells);
    let [width, height] = [chart.view.width(), chart.view.height()].map(|v| v.round() as u32);
    files.push(File { path: folder.join(format!("{CHART}.svg")), bytes: to_svg(&chart, width, height).into_bytes() });
    let painted = Painter::new(width, height)?.paint(&chart);
    files.push(File { path: folder.join(format!("{CHART}.png")), bytes: encode_png(&painted, "")? });
    Ok(files)
}
