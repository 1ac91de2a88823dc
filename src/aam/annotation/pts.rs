//! iBUG's `.pts`: a few `name: value` lines, then a point a line between braces.

use std::fmt::Write as _;

use super::number::{coordinate, count, miscounted, short};
use super::{Annotation, Unit};
use crate::disk::{Fault, FileFault, Result};
use crate::geometry::Point;

pub(super) fn parse(text: &str) -> Result<Annotation> {
    let mut said = None;
    let mut points = Vec::new();
    let mut inside = false;
    let mut last = 1;
    for (number, line) in text.lines().enumerate().map(|(i, l)| (i + 1, l.trim())) {
        last = number;
        // Comments as VOSM writes them.
        if line.is_empty() || line.starts_with('#') || line.starts_with("//") {
            continue;
        }
        match (inside, line) {
            (false, "{") => inside = true,
            (true, "}") => {
                return match said {
                    Some((said, at)) if said != points.len() => Err(miscounted(said, points.len(), at)),
                    _ if points.is_empty() => {
                        Err(Fault::of(FileFault::Empty, "there are no points").line(number).help(SHAPE))
                    }
                    _ => Ok(Annotation::of_points(points)),
                };
            }
            (false, line) => match line.split_once(':') {
                Some((name, value)) if name.trim() == "n_points" => said = Some((count(value.trim(), number)?, number)),
                Some(_) => {}
                None => return Err(Fault::new(format!("`{}` is not expected", short(line))).line(number).help(SHAPE)),
            },
            (true, line) => {
                let words: Vec<&str> = line.split_whitespace().collect();
                let [x, y] = words[..] else {
                    let what = format!("`{}` is not a point", short(line));
                    return Err(Fault::new(what).line(number).help("a point is its x and its y, with a space between"));
                };
                points.push(Point::new(coordinate(x, number)?, coordinate(y, number)?));
                count(&points.len().to_string(), number)?;
            }
        }
    }
    Err(Fault::of(FileFault::CutOff, "the closing brace is missing")
        .line(last)
        .help("is the file cut off? copy it again"))
}

const SHAPE: &str = "after `version: 1` and `n_points: N` come `{`, a point a line, and `}`";

pub(super) fn write(annotation: &Annotation) -> Result<String> {
    if annotation.unit != Unit::Pixels {
        return Err(Fault::of(FileFault::Missing, "a .pts holds pixels, and the size of the picture is not known")
            .help("write .asf"));
    }
    let mut text = format!("version: 1\nn_points: {}\n{{\n", annotation.points.len());
    for point in &annotation.points {
        let _ = writeln!(text, "{:.3} {:.3}", point.x, point.y);
    }
    text.push_str("}\n");
    Ok(text)
}
