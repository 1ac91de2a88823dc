//! The XML of dlib's imglab: pictures, in them boxes, in these named parts.
//!
//! dlib orders parts by their names, which are numbers padded with zeros; so does this, and unpadded ones come out in
//! the order of their numbers. A box without parts is a face that nobody has marked: it is passed over.

use std::fmt::Write as _;

use roxmltree::{Document, Node, ParsingOptions};

use super::number::{coordinate, count, short};
use super::{Annotation, MAX_PICTURES, Unit};
use crate::disk::{Fault, FileFault, Result};
use crate::geometry::{Point, Rect};

pub(super) fn parse(text: &str) -> Result<Vec<Annotation>> {
    let options = ParsingOptions { allow_dtd: false, nodes_limit: 20_000_000, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let line = error.pos().row as usize;
        Fault::of(FileFault::CutOff, format!("this is not whole XML: {error}"))
            .line(line)
            .help("is the file cut off? copy it again")
    })?;
    let line_of = |node: Node| document.text_pos_at(node.range().start).row as usize;
    let mut list = Vec::new();
    for image in document.descendants().filter(|n| n.has_tag_name("image")) {
        let Some(file) = image.attribute("file") else {
            return Err(Fault::of(FileFault::Missing, "an image has no `file`")
                .line(line_of(image))
                .help("write <image file='NAME'>"));
        };
        for node in image.children().filter(|n| n.has_tag_name("box")) {
            if let Some(annotation) = face(node, file, &line_of)? {
                list.push(annotation);
            }
            if list.len() > MAX_PICTURES {
                return Err(Fault::of(FileFault::TooLarge, format!("there are more than {MAX_PICTURES} faces"))
                    .line(line_of(node))
                    .help("split the file"));
            }
        }
    }
    if list.is_empty() {
        return Err(Fault::new("no box in it has parts")
            .line(1)
            .help("mark points with imglab --parts, and save again"));
    }
    Ok(list)
}

/// The face of a box; none where nobody has marked its parts.
fn face(node: Node, file: &str, line_of: &dyn Fn(Node) -> usize) -> Result<Option<Annotation>> {
    let line = line_of(node);
    let number = |node: Node, name: &str| match node.attribute(name) {
        Some(word) => coordinate(word, line_of(node)),
        None => {
            let what = format!("a {} has no `{name}`", node.tag_name().name());
            Err(Fault::new(what).line(line_of(node)).help("boxes have top, left, width, height; parts name, x, y"))
        }
    };
    let (left, top) = (number(node, "left")?, number(node, "top")?);
    let (width, height) = (number(node, "width")?, number(node, "height")?);
    let mut parts: Vec<(&str, Point)> = Vec::new();
    for part in node.children().filter(|n| n.has_tag_name("part")) {
        let name = part.attribute("name").unwrap_or_default();
        parts.push((name, Point::new(number(part, "x")?, number(part, "y")?)));
        count(&parts.len().to_string(), line_of(part))?;
    }
    let rank = |name: &str| name.parse::<u32>().map_or((1, 0), |n| (0, n));
    parts.sort_by(|(a, _), (b, _)| (rank(a), *a).cmp(&(rank(b), *b)));
    if let Some(twice) = parts.windows(2).find(|w| w[0].0 == w[1].0) {
        let what = format!("a box has two parts of the name `{}`", short(twice[0].0));
        return Err(Fault::new(what).line(line).help("give every part of a box a name of its own"));
    }
    let points: Vec<Point> = parts.into_iter().map(|(_, p)| p).collect();
    let face = Some(Rect::new(left, top, left + width, top + height));
    let annotation = Annotation { picture: Some(file.to_owned()), points, face, ..Annotation::default() };
    Ok((!annotation.points.is_empty()).then_some(annotation))
}

pub(super) fn write(list: &[Annotation]) -> Result<String> {
    let mut text = String::from("<?xml version='1.0' encoding='UTF-8'?>\n<dataset>\n<images>\n");
    for faces in list.chunk_by(|a, b| a.picture == b.picture) {
        let file = faces.first().and_then(|f| f.picture.as_deref());
        let Some(file) = file else {
            return Err(Fault::of(FileFault::Missing, "a picture has no name").help("dlib's XML names every picture"));
        };
        let _ = writeln!(text, "  <image file='{}'>", escaped(file));
        for face in faces {
            if face.unit != Unit::Pixels {
                return Err(Fault::of(
                    FileFault::Missing,
                    "dlib's XML holds pixels, and the size of a picture is not known",
                ));
            }
            let around = || {
                let around = |r: Option<Rect>, p: &Point| Some(r.map_or(Rect::from_points(*p, *p), |r| r.union_pt(*p)));
                face.points.iter().fold(None, around).unwrap_or(Rect::ZERO)
            };
            let r = face.face.unwrap_or_else(around);
            let (left, top, width, height) = (r.x0.round(), r.y0.round(), r.width().round(), r.height().round());
            let _ = writeln!(text, "    <box top='{top}' left='{left}' width='{width}' height='{height}'>");
            for (i, p) in face.points.iter().enumerate() {
                let _ = writeln!(text, "      <part name='{i:03}' x='{:.3}' y='{:.3}'/>", p.x, p.y);
            }
            text.push_str("    </box>\n");
        }
        text.push_str("  </image>\n");
    }
    text.push_str("</images>\n</dataset>\n");
    Ok(text)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('\'', "&apos;")
}
