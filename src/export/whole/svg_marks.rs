//! Marks as SVG, as short as they can be written: whole numbers, relative, without a blank that is not needed.

use std::collections::HashMap;
use std::fmt::Write;

use super::base64::data_uri_of;
use crate::drawing::Colour;
use crate::export::parts::{Mark, Path};
use crate::geometry::Affine;

/// What marks refer to, each once: clip paths and gradients.
#[derive(Default)]
pub(super) struct Defs {
    known: HashMap<String, usize>,
    /// The definitions that are not written yet, in order.
    pub text: String,
}

impl Defs {
    /// The id of a definition; `body` is the element from its name on, where `#` stands for the id.
    fn id(&mut self, body: &str) -> String {
        let next = self.known.len();
        let number = *self.known.entry(body.to_owned()).or_insert(next);
        let id = format!("D{number}");
        if number == next {
            self.text.push_str(&body.replacen('#', &id, 1));
        }
        id
    }
}

/// Writes marks.
pub(super) fn write_marks<'a>(out: &mut String, marks: impl Iterator<Item = &'a Mark>, defs: &mut Defs) {
    for mark in marks {
        match mark {
            Mark::Path { path, colour } => {
                out.push_str("<path");
                fill(out, *colour);
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
                fill(out, *colour);
                let _ = write!(out, ">{}</text>", super::escaped(text));
            }
            Mark::Picture { pixels, place } => {
                let [a, b, c, d, e, f] = place.map(|v| v as f64 / 1e5);
                let _ = write!(
                    out,
                    "<image width=\"{}\" height=\"{}\" transform=\"matrix({a} {b} {c} {d} {e} {f})\" href=\"{}\"/>",
                    pixels.0.width(),
                    pixels.0.height(),
                    data_uri_of(&pixels.0)
                );
            }
            Mark::Clip { path, inside } => {
                let mut data = String::new();
                path_data(&mut data, path);
                let id = defs.id(&format!("<clipPath id=\"#\"><path d=\"{data}\"/></clipPath>"));
                let _ = write!(out, "<g clip-path=\"url(#{id})\">");
                write_marks(out, inside.iter(), defs);
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
pub(super) fn short(colour: Colour) -> String {
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
pub(super) fn share(alpha: u8) -> String {
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
    let fewer = kurbo::simplify::simplify_bezpath(path.to_bez(), 1.0, &kurbo::simplify::SimplifyOptions::default());
    Path::of(&fewer, Affine::IDENTITY).filter(|p| p.verbs.len() < path.verbs.len())
}

/// The data of a path, relative.
pub(super) fn path_data(out: &mut String, path: &Path) {
    let fewer = simpler(path);
    let path = fewer.as_ref().unwrap_or(path);
    let (mut at, mut start) = ([0, 0], [0, 0]);
    let mut last = 0;
    for (verb, points) in path.pieces() {
        let to = points.last().copied().unwrap_or(start);
        let moved = [to[0] - at[0], to[1] - at[1]];
        let verb = match verb {
            b'M' => b'm',
            b'L' if moved[1] == 0 => b'h',
            b'L' if moved[0] == 0 => b'v',
            b'L' => b'l',
            b'Q' => b'q',
            b'C' => b'c',
            _ => b'z',
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
            _ => points.iter().for_each(|p| {
                number(p[0] - at[0]);
                number(p[1] - at[1]);
            }),
        }
        if verb == b'm' {
            start = to;
        }
        at = to;
        last = verb;
    }
}
