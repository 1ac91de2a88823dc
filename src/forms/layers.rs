//! A figure in layers, for drawing programs: what never moves, and every part that does with all its looks, of which the
//! one at rest is seen. Inkscape shows them as layers; other programs as groups with their names.

use std::fmt::Write;

use super::svg_marks::{Defs, write_marks};
use super::{escaped, smil};
use crate::drawing::Colour;
use crate::figure::Figure;
use crate::forms::parts::{self, Part};
use crate::pose::{Emotion, Lids, MouthPose, MouthPreset, MouthShape, Pose, Ratios};

/// The poses that are in it, by name: at rest, the nine mouth shapes, the lids closed, the six emotions.
fn poses(mouths: MouthPreset) -> Vec<(String, Pose)> {
    let rest = Pose::default();
    let mut all = vec![("rest".to_owned(), rest)];
    for shape in MouthShape::ALL {
        all.push((shape.to_string(), Pose { mouth: MouthPose::of(shape, mouths), ..rest }));
    }
    all.push(("closed".to_owned(), Pose { lids: Lids { left: 0.0, right: 0.0 }, ..rest }));
    for emotion in &Emotion::ALL[1..] {
        all.push((emotion.name().to_owned(), Pose::of(Ratios::pure(*emotion))));
    }
    all
}

/// The layered SVG of a figure.
pub(crate) fn layered(
    figure: &Figure,
    mouths: MouthPreset,
    size: [u32; 2],
    background: Option<Option<Colour>>,
    title: &str,
) -> String {
    let poses = poses(mouths);
    let parts = parts::of_poses(figure, poses.iter().map(|p| p.1), size, background);
    let [width, height] = size;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
         width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n<title>{}</title>\n",
        escaped(title)
    );
    let ground = smil::backdrop(&parts);
    if !ground.is_empty() {
        let _ = writeln!(out, "{}{ground}</g>", begin("ground", "ground", true));
    }
    let mut defs = Defs::default();
    for part in parts.sheets.iter().flat_map(|s| &s.parts) {
        let mut layer = begin(&part.name, &part.name, true);
        let on_grid = smil::on_grid(&parts);
        if part.is_still() {
            layer.push_str(&on_grid);
            write_marks(&mut layer, part.marks(0), &mut defs);
            layer.push_str("</g>\n");
        } else {
            for pose in 0..part.poses.len() as u32 {
                let names = names_of(part, pose, &poses);
                layer.push_str(&begin(&format!("{}-{}", part.name, names.replace(' ', "-")), &names, pose == 0));
                layer.push_str(&on_grid);
                write_marks(&mut layer, part.marks(pose), &mut defs);
                layer.push_str("</g>\n</g>\n");
            }
        }
        if !defs.text.is_empty() {
            let _ = writeln!(out, "<defs>{}</defs>", std::mem::take(&mut defs.text));
        }
        out.push_str(&layer);
        out.push_str("</g>\n");
    }
    out.push_str("</svg>\n");
    out
}

fn begin(id: &str, label: &str, seen: bool) -> String {
    let hidden = if seen { "" } else { " style=\"display:none\"" };
    format!("<g id=\"{id}\" inkscape:groupmode=\"layer\" inkscape:label=\"{label}\"{hidden}>\n")
}

/// The names of the poses in which a part has this look.
fn names_of(part: &Part, pose: u32, poses: &[(String, Pose)]) -> String {
    let mut names = Vec::new();
    for (i, (from, own)) in part.runs.iter().enumerate() {
        let until = part.runs.get(i + 1).map_or(poses.len(), |next| next.0 as usize);
        if *own == pose {
            names.extend(poses[*from as usize..until].iter().map(|p| p.0.as_str()));
        }
    }
    names.join(" ")
}
