//! A drawing as one readable SVG file: a group a layer, every shape under its own name, title and description for
//! screen readers, and no more digits than can be seen.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::TOLERANCE;
use super::escaped::Escaped;
use crate::drawing::{Anchor, Drawing, Item};
use crate::geometry::{Affine, BezPath, PathEl, Point, outline};

/// The SVG text of a drawing, `width` × `height` pixels large. Text stays text.
#[must_use]
pub fn to_svg(drawing: &Drawing, width: u32, height: u32) -> String {
    let mut out = String::with_capacity(16 << 10);
    let v = drawing.view;
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"{} {} {} {}\" \
         role=\"img\" aria-labelledby=\"picture-title picture-description\">",
        Short(v.x0),
        Short(v.y0),
        Short(v.width()),
        Short(v.height())
    );
    let _ = writeln!(out, "<title id=\"picture-title\">{}</title>", Escaped(&drawing.title));
    let _ = writeln!(out, "<desc id=\"picture-description\">{}</desc>", Escaped(&drawing.description));
    if let Some(colour) = drawing.background {
        // Beyond the view box too, which is fitted whole and leaves margins where the proportions differ.
        let scale = (f64::from(width) / v.width()).min(f64::from(height) / v.height());
        let (w, h) = (f64::from(width) / scale, f64::from(height) / scale);
        let corner = v.center() - crate::geometry::Vec2::new(w / 2.0, h / 2.0);
        let _ = writeln!(
            out,
            "<rect id=\"picture-background\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>",
            Short(corner.x),
            Short(corner.y),
            Short(w),
            Short(h),
            fill(colour)
        );
    }
    let mut names = Names::default();
    for layer in &drawing.layers {
        let _ = writeln!(out, "<g id=\"{}\">", Escaped(&layer.name));
        for item in &layer.items {
            write_item(&mut out, item, &mut names);
        }
        out.push_str("</g>\n");
    }
    out.push_str("</svg>\n");
    out
}

/// The names given so far. In one file a name stands once: the second nostril is `nostril-2`.
#[derive(Default)]
struct Names {
    used: BTreeMap<String, usize>,
    clips: usize,
}

impl Names {
    /// The attribute of a name; nothing for what has none.
    fn id(&mut self, name: &str) -> String {
        if name.is_empty() {
            return String::new();
        }
        let times = self.used.entry(name.to_owned()).or_default();
        *times += 1;
        match *times {
            1 => format!(" id=\"{}\"", Escaped(name)),
            n => format!(" id=\"{}-{n}\"", Escaped(name)),
        }
    }

    /// A number for something that is named by number.
    fn next(&mut self) -> usize {
        self.clips += 1;
        self.clips
    }
}

fn write_item(out: &mut String, item: &Item, names: &mut Names) {
    match item {
        Item::Area(area) => write_path(out, &names.id(&area.name), &area.path, &fill(area.colour)),
        Item::Ink(ink) => write_path(out, &names.id(&ink.name), &outline(&ink.strokes, TOLERANCE), &fill(ink.colour)),
        Item::Text(text) => {
            let anchor = match text.anchor {
                Anchor::Start => "",
                Anchor::Middle => " text-anchor=\"middle\"",
                Anchor::End => " text-anchor=\"end\"",
            };
            let _ = writeln!(
                out,
                "<text x=\"{}\" y=\"{}\" font-family=\"Inter, sans-serif\" font-size=\"{}\"{anchor}{}>{}</text>",
                Short(text.at.x),
                Short(text.at.y),
                Short(text.size),
                fill(text.colour),
                Escaped(&text.text)
            );
        }
        Item::Glow(glow) => {
            let clips = names.next();
            let _ = writeln!(
                out,
                "<radialGradient id=\"picture-glow-{clips}\"><stop offset=\"0\" stop-color=\"{0}\" stop-opacity=\"{1}\"/>\
                 <stop offset=\"1\" stop-color=\"{0}\" stop-opacity=\"0\"/></radialGradient>",
                glow.colour.hex(),
                Short(f64::from(glow.colour.a) / 255.0)
            );
            let _ = writeln!(
                out,
                "<ellipse{} cx=\"{}\" cy=\"{}\" rx=\"{}\" ry=\"{}\" fill=\"url(#picture-glow-{clips})\"/>",
                names.id(&glow.name),
                Short(glow.at.x),
                Short(glow.at.y),
                Short(glow.radii.x),
                Short(glow.radii.y)
            );
        }
        Item::Shared(shared) => shared.items().iter().for_each(|item| write_item(out, item, names)),
        Item::Group(group) => {
            let mut clip = String::new();
            if let Some(path) = &group.clip {
                let clips = names.next();
                let _ = write!(clip, " clip-path=\"url(#picture-clip-{clips})\"");
                let _ = writeln!(out, "<clipPath id=\"picture-clip-{clips}\"><path d=\"{}\"/></clipPath>", data(path));
            }
            let _ = writeln!(out, "<g{}{clip}{}>", names.id(&group.name), transform(group.transform));
            for item in &group.items {
                write_item(out, item, names);
            }
            out.push_str("</g>\n");
        }
        Item::Picture(raster) => {
            let id = names.id(&raster.name);
            let _ = writeln!(
                out,
                "<image{id} width=\"{}\" height=\"{}\"{} href=\"{}\"/>",
                raster.picture().width(),
                raster.picture().height(),
                transform(raster.place()),
                super::raster::data_uri(raster)
            );
        }
    }
}

fn write_path(out: &mut String, id: &str, path: &BezPath, fill: &str) {
    if path.elements().is_empty() {
        return;
    }
    let _ = writeln!(out, "<path{id} d=\"{}\"{fill}/>", data(path));
}

fn fill(colour: crate::drawing::Colour) -> String {
    if colour.a == 255 {
        format!(" fill=\"{}\"", colour.hex())
    } else {
        format!(" fill=\"{}\" fill-opacity=\"{}\"", colour.hex(), Short(f64::from(colour.a) / 255.0))
    }
}

fn transform(affine: Affine) -> String {
    if affine == Affine::IDENTITY {
        return String::new();
    }
    let [a, b, c, d, e, f] = affine.as_coeffs();
    // A hundredth of a unit over a thousand units wide needs five digits in the linear part.
    format!(
        " transform=\"matrix({} {} {} {} {} {})\"",
        Digits(a, 5),
        Digits(b, 5),
        Digits(c, 5),
        Digits(d, 5),
        Short(e),
        Short(f)
    )
}

fn data(path: &BezPath) -> String {
    let mut d = String::with_capacity(path.elements().len() * 24);
    for element in path.elements() {
        match *element {
            PathEl::MoveTo(p) => write_points(&mut d, 'M', &[p]),
            PathEl::LineTo(p) => write_points(&mut d, 'L', &[p]),
            PathEl::QuadTo(a, p) => write_points(&mut d, 'Q', &[a, p]),
            PathEl::CurveTo(a, b, p) => write_points(&mut d, 'C', &[a, b, p]),
            PathEl::ClosePath => d.push('Z'),
        }
    }
    d
}

fn write_points(d: &mut String, command: char, points: &[Point]) {
    d.push(command);
    for (i, p) in points.iter().enumerate() {
        let gap = if i == 0 { "" } else { " " };
        let _ = write!(d, "{gap}{} {}", Short(p.x), Short(p.y));
    }
}

/// A number to a hundredth of a unit, without trailing zeros.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        Digits(self.0, 2).fmt(f)
    }
}

/// A number to so many digits after the point, without trailing zeros, and 0 without a sign.
struct Digits(f64, i32);

impl std::fmt::Display for Digits {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let step = 10f64.powi(self.1);
        let rounded = (self.0 * step).round() / step;
        write!(f, "{}", if rounded == 0.0 { 0.0 } else { rounded })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_carry_no_more_digits_than_can_be_seen() {
        let shown = |x: f64| Short(x).to_string();
        assert_eq!(shown(1.0), "1");
        assert_eq!(shown(-0.001), "0");
        assert_eq!(shown(2.3456), "2.35");
        assert_eq!(shown(1e7), "10000000");
    }
}
