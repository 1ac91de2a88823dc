//! Marks as SVG, as short as they can be written: whole numbers, relative, without a blank that is not needed.

use std::collections::HashMap;
use std::fmt::Write;

use super::base64::data_uri_of;
use super::fewer::fewer;
use crate::drawing::Colour;
use crate::forms::parts::{Mark, Path};
use crate::geometry::Affine;

/// What marks refer to, each once: clip paths and gradients.
#[derive(Default)]
pub(crate) struct Defs {
    known: HashMap<String, usize>,
    /// The definitions that are not written yet, in order.
    pub text: String,
    /// Colours that are written as classes, by number; none where each is written where it is.
    classes: Option<Vec<Colour>>,
}

impl Defs {
    /// Definitions of a picture in which colours are classes: it is smaller by some, but not what drawing programs like.
    pub(crate) fn with_classes() -> Self {
        Self { classes: Some(Vec::new()), ..Self::default() }
    }

    /// The style of the classes.
    pub(crate) fn style(&self) -> String {
        let mut text = String::new();
        for (number, colour) in self.classes.iter().flatten().enumerate() {
            let _ = write!(text, ".{}{{fill:{}", short_name(number as u32), short(*colour));
            if colour.a != 255 {
                let _ = write!(text, ";fill-opacity:{}", share(colour.a));
            }
            text.push('}');
        }
        text
    }

    /// Writes the attributes of a colour.
    fn fill(&mut self, out: &mut String, colour: Colour) {
        let Some(known) = self.classes.as_mut().filter(|_| colour != Colour::BLACK) else { return fill(out, colour) };
        let number = known.iter().position(|c| *c == colour).unwrap_or_else(|| {
            known.push(colour);
            known.len() - 1
        });
        let _ = write!(out, " class=\"{}\"", short_name(number as u32));
    }

    /// The id of a definition; `body` is the element from its name on, where `#` stands for the id, and `@` for
    /// that of a part of it, which has an `E` for its `D`.
    fn id(&mut self, body: &str) -> String {
        let next = self.known.len();
        let number = *self.known.entry(body.to_owned()).or_insert(next);
        let id = format!("D{number}");
        if number == next {
            self.text.push_str(&body.replacen('#', &id, 1).replacen('@', &format!("E{number}"), 1));
        }
        id
    }
}

/// Writes marks.
pub(crate) fn write_marks<'a>(out: &mut String, marks: impl Iterator<Item = &'a Mark>, defs: &mut Defs) {
    for mark in marks {
        match mark {
            Mark::Path { path, colour } => {
                out.push_str("<path");
                defs.fill(out, *colour);
                out.push_str(" d=\"");
                path_data(out, path);
                out.push_str("\"/>");
            }
            Mark::Glow { at, radii, colour } => {
                let id = defs.id(&format!(
                    "<radialGradient id=\"#\"><stop offset=\"0\" stop-color=\"{0}\" stop-opacity=\"{1}\"/><stop offset=\"1\" \
                     stop-color=\"{0}\" stop-opacity=\"0\"/></radialGradient>",
                    colour.hex(),
                    share(colour.a)
                ));
                let _ = write!(
                    out,
                    "<ellipse cx=\"{}\" cy=\"{}\" rx=\"{}\" ry=\"{}\" fill=\"url(#{id})\"/>",
                    at[0], at[1], radii[0], radii[1]
                );
            }
            Mark::Text { at, size, anchor, colour, text } => {
                let anchor = ["start", "middle", "end"][usize::from(*anchor).min(2)];
                let _ = write!(
                    out,
                    "<text x=\"{}\" y=\"{}\" font-family=\"Inter,sans-serif\" font-size=\"{size}\" text-anchor=\"{anchor}\"",
                    at[0], at[1]
                );
                defs.fill(out, *colour);
                let _ = write!(out, ">{}</text>", super::escaped(text));
            }
            Mark::Picture { pixels, place } => {
                let [a, b, c, d, e, f] = place.map(|v| v as f64 / 1e5);
                let _ = write!(
                    out,
                    "<image width=\"{}\" height=\"{}\" transform=\"matrix({a} {b} {c} {d} {e} {f})\" href=\"{}\"/>",
                    pixels.0.picture().width(),
                    pixels.0.picture().height(),
                    data_uri_of(&pixels.0)
                );
            }
            Mark::Clip { path, inside } => {
                let mut data = String::new();
                path_data(&mut data, path);
                // What is clipped begins with the ground of the hole, of the hole's own shape: it is written once.
                let ground = match inside.first() {
                    Some(Mark::Path { path: own, colour }) if own == path => Some(*colour),
                    _ => None,
                };
                let name = if ground.is_some() { " id=\"@\"" } else { "" };
                let id = defs.id(&format!("<clipPath id=\"#\"><path{name} d=\"{data}\"/></clipPath>"));
                let _ = write!(out, "<g clip-path=\"url(#{id})\">");
                if let Some(colour) = ground {
                    let _ = write!(out, "<use href=\"#{}\"", id.replacen('D', "E", 1));
                    defs.fill(out, colour);
                    out.push_str("/>");
                }
                write_marks(out, inside.iter().skip(usize::from(ground.is_some())), defs);
                out.push_str("</g>");
            }
        }
    }
}

/// The attributes of a colour.
fn fill(out: &mut String, colour: Colour) {
    if colour != Colour::BLACK {
        let _ = write!(out, " fill=\"{}\"", short(colour));
    }
    if colour.a != 255 {
        let _ = write!(out, " fill-opacity=\"{}\"", share(colour.a));
    }
}

/// `#aabbcc` as `#abc`.
pub(crate) fn short(colour: Colour) -> String {
    let hex = colour.hex();
    let digits = hex.as_bytes();
    match digits {
        [_, a, b, c, d, e, f] if a == b && c == d && e == f => {
            format!("#{}{}{}", char::from(*a), char::from(*c), char::from(*e))
        }
        _ => hex,
    }
}

/// An alpha as a share of 1, to a thousandth.
pub(crate) fn share(alpha: u8) -> String {
    let thousandths = (u32::from(alpha) * 1000 + 127) / 255;
    match thousandths {
        1000.. => "1".to_owned(),
        0 => "0".to_owned(),
        n => format!(".{n:03}").trim_end_matches('0').to_owned(),
    }
}

/// The same path in fewer curves, no further from it than a step of the grid, where it has many.
fn simpler(path: &Path) -> Option<Path> {
    const MANY: usize = 6;
    let curves = path.verbs.iter().filter(|v| **v == b'C').count();
    if curves <= MANY {
        return None;
    }
    Path::of(&fewer(&path.to_bez(), 1.0), Affine::IDENTITY).filter(|p| p.verbs.len() < path.verbs.len())
}

/// The data of a path, relative.
pub(crate) fn path_data(out: &mut String, path: &Path) {
    let fewer = simpler(path);
    let path = fewer.as_ref().unwrap_or(path);
    let (mut at, mut start) = ([0, 0], [0, 0]);
    let mut last = 0;
    // Where a curve goes on to that leaves as the one before it came.
    let mut onward: Option<[i32; 2]> = None;
    for (verb, mut points) in path.pieces() {
        let to = points.last().copied().unwrap_or(start);
        let moved = [to[0] - at[0], to[1] - at[1]];
        let offset = |p: [i32; 2]| [0, 1].map(|i| even(p[i] - at[i], moved[i]));
        let is_smooth = |first: [i32; 2]| onward.is_some_and(|o| (0..2).all(|i| offset(first)[i].abs_diff(o[i]) <= 1));
        let verb = match verb {
            b'M' => b'm',
            b'L' if moved[1] == 0 => b'h',
            b'L' if moved[0] == 0 => b'v',
            b'L' => b'l',
            b'Q' => b'q',
            b'C' if is_smooth(points[0]) => {
                points = &points[1..];
                b's'
            }
            b'C' => b'c',
            _ => b'z',
        };
        onward = match points {
            [.., second, _] if verb != b'q' => {
                let second = offset(*second);
                Some([0, 1].map(|i| moved[i] - second[i]))
            }
            _ => None,
        };
        // The same verb again needs no letter; after a move it would be a line.
        let mut fresh = verb != last || verb == b'm' || verb == b'z';
        if fresh {
            out.push(char::from(verb));
        }
        let mut number = |n: i32| {
            if !fresh && n >= 0 {
                out.push(' ');
            }
            fresh = false;
            let _ = write!(out, "{n}");
        };
        match verb {
            b'z' => {}
            b'h' => number(moved[0]),
            b'v' => number(moved[1]),
            _ => points.iter().flat_map(|p| offset(*p)).for_each(&mut number),
        }
        if verb == b'm' {
            start = to;
        }
        at = to;
        last = verb;
    }
}

/// The place of a handle to two steps of the grid, which packs better and bends no curve by a tenth of a pixel; an end
/// stays where it is, and so does a handle that lies level with it.
fn even(handle: i32, end: i32) -> i32 {
    if handle == end { handle } else { handle - handle % 2 }
}

/// `a`, `b` … `y`, then `za`, `zb` …: none is the beginning of a number or of another name.
pub(crate) fn short_name(number: u32) -> String {
    format!("{}{}", "z".repeat((number / 25) as usize), char::from(b'a' + (number % 25) as u8))
}
