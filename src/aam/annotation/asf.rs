//! The `.asf` of the IMM face database: the number of points, a point a line in shares of the picture's size, and the
//! picture's name. Whatever follows a `#` is a comment.
//!
//! A point's line holds: number of its line, type, x, y, its own number, the point it is joined from, the one it is
//! joined to, and in later files three fields for the user. Of the type's bits one says that the line is open.

use std::fmt::Write as _;

use super::number::{coordinate, count, miscounted, short};
use super::{Annotation, Line, Unit};
use crate::disk::{Fault, FileFault, Result};
use crate::geometry::Point;

/// The bit of a point's type which says that its line does not close.
const OPEN: u32 = 4;
/// How far outside the picture a point may lie, in its sizes.
const MAX_SHARE: f64 = 10.0;

pub(super) fn parse(text: &str) -> Result<Annotation> {
    let mut rows = text
        .lines()
        .enumerate()
        .map(|(i, l)| (i + 1, l.split('#').next().unwrap_or_default().trim()))
        .filter(|(_, l)| !l.is_empty());
    let Some((at, first)) = rows.next() else {
        return Err(Fault::of(FileFault::Empty, "there are no points")
            .line(1)
            .help("is the file empty? copy it again"));
    };
    let said = count(first, at)?;
    let mut annotation = Annotation { unit: Unit::Shares, ..Annotation::default() };
    let mut line_of: Option<&str> = None;
    let mut last = at;
    for _ in 0..said {
        let Some((number, row)) = rows.next() else {
            return Err(miscounted(said, annotation.points.len(), at));
        };
        last = number;
        let words: Vec<&str> = row.split_whitespace().collect();
        // A file of fewer points than it says goes on with the picture's name.
        if words.len() < 4 {
            return Err(match annotation.points.len() {
                0 => not_a_point(row, number),
                found => miscounted(said, found, at),
            });
        }
        if words.len() < 7 {
            return Err(not_a_point(row, number));
        }
        let [x, y] = [coordinate(words[2], number)?, coordinate(words[3], number)?];
        if x.abs().max(y.abs()) > MAX_SHARE {
            let what = format!("`{} {}` lies far outside the picture", short(words[2]), short(words[3]));
            return Err(Fault::new(what).line(number).help("places are shares of the picture's size, from 0 to 1"));
        }
        let kind: u32 = words[1].parse().map_err(|_| not_a_point(row, number))?;
        let n = annotation.points.len();
        match annotation.lines.last_mut() {
            Some(line) if line_of == Some(words[0]) => line.count += 1,
            _ => annotation.lines.push(Line { first: n, count: 1, closed: kind & OPEN == 0 }),
        }
        line_of = Some(words[0]);
        annotation.points.push(Point::new(x, y));
    }
    match rows.next() {
        Some((number, row)) if looks_like_a_point(row) => Err(miscounted(said, said + 1, number)),
        Some((_, row)) => {
            annotation.picture = Some(row.to_owned());
            Ok(annotation)
        }
        None => Err(Fault::of(FileFault::Missing, "the picture's name is missing")
            .line(last)
            .help("is the file cut off? after the points comes the name of the picture they are of")),
    }
}

fn looks_like_a_point(row: &str) -> bool {
    row.split_whitespace().count() >= 7 && row.split_whitespace().all(|w| w.parse::<f64>().is_ok())
}

fn not_a_point(row: &str, line: usize) -> Fault {
    Fault::new(format!("`{}` is not a point", short(row)))
        .line(line)
        .help("a point has seven fields: line, type, x, y, number, joined from, joined to")
}

pub(super) fn write(annotation: &Annotation) -> Result<String> {
    if annotation.unit != Unit::Shares {
        return Err(Fault::new("an .asf holds shares of the picture's size").help("write .pts, or give the size"));
    }
    let n = annotation.points.len();
    let whole = [Line { first: 0, count: n, closed: false }];
    let lines = if annotation.lines.is_empty() { &whole[..] } else { &annotation.lines };
    let mut text = format!("# AAM Shape File\n\n# number of model points\n{n}\n\n# model points\n");
    text.push_str("# format: <path#> <type> <x rel.> <y rel.> <point#> <connects from> <connects to>\n");
    for (number, line) in lines.iter().enumerate() {
        let last = line.first + line.count.max(1) - 1;
        for (i, point) in annotation.points.iter().enumerate().skip(line.first).take(line.count) {
            let from = if i > line.first { i - 1 } else { ends(line.closed, last, i) };
            let to = if i < last { i + 1 } else { ends(line.closed, line.first, i) };
            let kind = if line.closed { 0 } else { OPEN };
            let _ = writeln!(text, "{number} \t{kind} \t{:.8} \t{:.8} \t{i} \t{from} \t{to}", point.x, point.y);
        }
    }
    let _ = writeln!(text, "\n# host image\n{}", annotation.picture.as_deref().unwrap_or("unknown"));
    Ok(text)
}

/// What the end of a line is joined to: its other end, or itself.
fn ends(closed: bool, other: usize, own: usize) -> usize {
    if closed { other } else { own }
}
