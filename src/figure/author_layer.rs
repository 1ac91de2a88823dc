//! An author's own layer: an SVG file of hers as areas of a drawing. What is not a filled or stroked shape (scripts,
//! links, pictures, fonts, filters) has no counterpart in a drawing and is left out, which is what makes it clean.

use usvg::{Node, Paint, Transform, tiny_skia_path as skia};

use super::cartoon::{Extra, Sheet};
use super::layer_bounds::{check, too_much};
use crate::disk::{Fault, FileFault, Result};
use crate::drawing::{Colour, Group, Item, fit};
use crate::geometry::{Affine, BezPath, Point, Rect, Shape};

/// The longest text of a layer that is read; drawings by hand are far below.
pub(crate) const MAX_LAYER_BYTES: u64 = 8 << 20;
/// The most shapes of a layer: each one costs time in every frame.
const MAX_SHAPES: usize = 5_000;
/// The most dashes of all strokes.
const MAX_DASHES: f64 = 20_000.0;
/// The most segments of all stroked paths: the outline of each has some ten.
const MAX_STROKED: usize = 50_000;
/// The farthest that a path may reach in its own coordinates: a curve's outline is divided the finer, the larger it is.
const MAX_COORDINATE: f64 = 1e7;
/// How far the outline of a stroke may lie from the true one, in units of the layer.
const TOLERANCE: f64 = 0.05;

/// An author's own layer, in its own coordinates.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AuthorLayer {
    /// Where it is drawn.
    pub place: LayerPlace,
    /// The part of its plane that covers the figure's view.
    pub view: Rect,
    /// Back to front.
    pub items: Vec<Item>,
    /// What was left out, in words for its author.
    pub left_out: Vec<&'static str>,
}

/// Where an author's layer is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LayerPlace {
    /// Behind everything but the ground.
    Behind,
    /// On the body and behind the head: clothing.
    #[default]
    Body,
    /// On the head, moving with it: a hat, glasses, a flower.
    Head,
}

impl AuthorLayer {
    /// Reads the text of an SVG file. Shapes become filled areas, strokes their outlines, gradients the middle of
    /// their colours.
    ///
    /// # Errors
    /// When it is not SVG, or has more shapes, dashes or segments than a frame can bear.
    pub(crate) fn parse(text: &str, place: LayerPlace) -> Result<Self> {
        check(text)?;
        // Pictures are not looked at: neither files nor data inside the text.
        let options = usvg::Options {
            image_href_resolver: usvg::ImageHrefResolver {
                resolve_data: Box::new(|_, _, _| None),
                resolve_string: Box::new(|_, _| None),
            },
            ..usvg::Options::default()
        };
        let tree = usvg::Tree::from_str(text, &options)
            .map_err(|e| Fault::new(format!("this is not an SVG drawing: {e}")).help("save it as plain SVG"))?;
        let mut reader = Reader::default();
        let items = reader.group(tree.root());
        if let Some(what) = reader.over {
            return Err(too_much(what));
        }
        if reader.shapes > MAX_SHAPES {
            return Err(Fault::of(FileFault::TooLarge, format!("the layer has more than {MAX_SHAPES} shapes"))
                .help("simplify the drawing: every shape is drawn in every frame"));
        }
        let mut left_out = reader.left_out;
        let mut miss = |found: bool, what: &'static str| {
            if found {
                left_out.push(what);
            }
        };
        miss(text.contains("<text"), "text: turn it into paths");
        miss(text.contains("<image"), "pictures");
        miss(text.contains("<script") || text.contains("onload="), "scripts");
        left_out.sort_unstable();
        left_out.dedup();
        let size = tree.size();
        let view = Rect::new(0.0, 0.0, f64::from(size.width()), f64::from(size.height()));
        Ok(Self { place, view, items, left_out })
    }

    /// The layer as things of a cartoon that fills `view`.
    #[must_use]
    pub(crate) fn extra(&self, view: Rect) -> Extra {
        let sheet = match self.place {
            LayerPlace::Behind => Sheet::Ground,
            LayerPlace::Body => Sheet::Shirt,
            LayerPlace::Head => Sheet::Hair,
        };
        Extra { sheet, over: true, items: vec![self.over(view)] }
    }

    fn over(&self, view: Rect) -> Item {
        Item::Group(Group {
            name: String::new(),
            // As an exported frame shows the figure: whole and centred on the sheet. So a drawing made over a frame of
            // any shape lies where it was drawn.
            transform: fit(view, self.view).inverse(),
            clip: Some(self.view.to_path(0.1)),
            items: self.items.clone(),
        })
    }
}

#[derive(Default)]
struct Reader {
    shapes: usize,
    dashes: f64,
    stroked: usize,
    /// The bound that was exceeded.
    over: Option<&'static str>,
    left_out: Vec<&'static str>,
}

impl Reader {
    fn group(&mut self, group: &usvg::Group) -> Vec<Item> {
        let mut items = Vec::new();
        for node in group.children() {
            if self.shapes > MAX_SHAPES || self.over.is_some() {
                break;
            }
            match node {
                Node::Group(inner) => items.extend(self.inner_group(inner)),
                Node::Path(path) if path.is_visible() => self.path(path, &mut items),
                Node::Path(_) => {}
                Node::Image(_) => self.left_out.push("pictures"),
                Node::Text(_) => self.left_out.push("text: turn it into paths"),
            }
        }
        items
    }

    fn inner_group(&mut self, group: &usvg::Group) -> Option<Item> {
        if !group.filters().is_empty() {
            self.left_out.push("filters");
        }
        if group.mask().is_some() {
            self.left_out.push("masks");
        }
        let clip = group.clip_path().map(|clip| {
            let mut outline = BezPath::new();
            outline_of(clip.root(), affine(clip.transform()), &mut outline);
            // What is cut by nothing is not seen.
            outline
        });
        if group.blend_mode() != usvg::BlendMode::Normal {
            self.left_out.push("blending");
        }
        let mut items = self.group(group);
        let opacity = f64::from(group.opacity().get());
        if opacity < 0.999 {
            items.iter_mut().for_each(|item| fade(item, opacity));
        }
        (!items.is_empty())
            .then(|| Item::Group(Group { name: String::new(), transform: affine(group.transform()), clip, items }))
    }

    fn path(&mut self, path: &usvg::Path, items: &mut Vec<Item>) {
        self.shapes += 1;
        let outline = bez_path(path.data());
        let mut fill = || {
            let fill = path.fill()?;
            let colour = self.paint(fill.paint(), fill.opacity().get())?;
            if fill.rule() == usvg::FillRule::EvenOdd {
                self.left_out.push("even-odd fills: drawn without their holes");
            }
            Some(Item::area("", outline.clone(), colour))
        };
        let filled = fill();
        let mut draw_stroke = || {
            let stroke = path.stroke()?;
            let colour = self.paint(stroke.paint(), stroke.opacity().get())?;
            self.bound(&outline, stroke)?;
            Some(Item::area("", stroked(&outline, stroke), colour))
        };
        let drawn = draw_stroke();
        match path.paint_order() {
            usvg::PaintOrder::FillAndStroke => items.extend(filled.into_iter().chain(drawn)),
            usvg::PaintOrder::StrokeAndFill => items.extend(drawn.into_iter().chain(filled)),
        }
    }

    /// Counts what a stroke's outline will have; none where that is beyond the bounds.
    fn bound(&mut self, path: &BezPath, stroke: &usvg::Stroke) -> Option<()> {
        self.stroked += path.elements().len();
        if let Some(dashes) = stroke.dasharray() {
            let period: f64 = dashes.iter().map(|d| f64::from(*d)).sum();
            self.dashes += dashes.len() as f64 * (1.0 + polygon_length(path) / period);
        }
        let reach = path.control_box();
        let is_near = [reach.x0, reach.y0, reach.x1, reach.y1, f64::from(stroke.width().get())]
            .iter()
            .all(|v| v.abs() <= MAX_COORDINATE);
        self.over = if self.dashes.is_nan() || self.dashes > MAX_DASHES {
            Some("its strokes have more than 20,000 dashes")
        } else if self.stroked > MAX_STROKED {
            Some("its stroked paths have more than 50,000 segments")
        } else if !is_near {
            Some("a stroke reaches farther than 10,000,000 units")
        } else {
            return Some(());
        };
        None
    }

    /// A paint as one colour: of a gradient the mean of its stops.
    fn paint(&mut self, paint: &Paint, opacity: f32) -> Option<Colour> {
        let of_stops = |stops: &[usvg::Stop]| {
            let n = stops.len().max(1) as f32;
            let mean = |f: &dyn Fn(&usvg::Stop) -> f32| stops.iter().map(f).sum::<f32>() / n;
            let channel = |f: &dyn Fn(&usvg::Stop) -> u8| mean(&|s| f32::from(f(s))).round() as u8;
            Colour::rgb(channel(&|s| s.color().red), channel(&|s| s.color().green), channel(&|s| s.color().blue))
                .faded(f64::from(mean(&|s| s.opacity().get())))
        };
        let colour = match paint {
            Paint::Color(c) => Colour::rgb(c.red, c.green, c.blue),
            Paint::LinearGradient(gradient) => {
                self.left_out.push("gradients: drawn in their middle colour");
                of_stops(gradient.stops())
            }
            Paint::RadialGradient(gradient) => {
                self.left_out.push("gradients: drawn in their middle colour");
                of_stops(gradient.stops())
            }
            Paint::Pattern(_) => {
                self.left_out.push("patterns");
                return None;
            }
        };
        Some(colour.faded(f64::from(opacity)))
    }
}

/// Everything inside a clip path, as one outline.
fn outline_of(group: &usvg::Group, moved: Affine, out: &mut BezPath) {
    for node in group.children() {
        match node {
            Node::Group(inner) => outline_of(inner, moved * affine(inner.transform()), out),
            Node::Path(path) => out.extend((moved * bez_path(path.data())).elements().iter().copied()),
            Node::Image(_) | Node::Text(_) => {}
        }
    }
}

fn fade(item: &mut Item, opacity: f64) {
    match item {
        Item::Area(area) => area.colour = area.colour.faded(opacity),
        Item::Group(group) => group.items.iter_mut().for_each(|item| fade(item, opacity)),
        _ => {}
    }
}

fn stroked(path: &BezPath, stroke: &usvg::Stroke) -> BezPath {
    let cap = match stroke.linecap() {
        usvg::LineCap::Butt => kurbo::Cap::Butt,
        usvg::LineCap::Round => kurbo::Cap::Round,
        usvg::LineCap::Square => kurbo::Cap::Square,
    };
    let join = match stroke.linejoin() {
        usvg::LineJoin::Round => kurbo::Join::Round,
        usvg::LineJoin::Bevel => kurbo::Join::Bevel,
        _ => kurbo::Join::Miter,
    };
    let mut style = kurbo::Stroke::new(f64::from(stroke.width().get())).with_caps(cap).with_join(join);
    style.miter_limit = f64::from(stroke.miterlimit().get());
    if let Some(dashes) = stroke.dasharray() {
        let dashes: Vec<f64> = dashes.iter().map(|d| f64::from(*d)).collect();
        // An odd number of dashes repeats after two rounds. Whole rounds are left out, for the offset is counted off dash by dash.
        let round = dashes.iter().sum::<f64>() * if dashes.len() % 2 == 1 { 2.0 } else { 1.0 };
        let offset = f64::from(stroke.dashoffset());
        style = style.with_dashes(if offset > round { offset % round } else { offset }, dashes);
    }
    kurbo::stroke(path.iter(), &style, &kurbo::StrokeOpts::default(), TOLERANCE)
}

/// The length of a path's control polygon, which its curves do not exceed.
fn polygon_length(path: &BezPath) -> f64 {
    use kurbo::PathEl;
    let (mut start, mut at, mut length) = (Point::ZERO, Point::ZERO, 0.0);
    for element in path.elements() {
        let points: &[Point] = match element {
            PathEl::MoveTo(p) => {
                (start, at) = (*p, *p);
                continue;
            }
            PathEl::LineTo(p) => &[*p],
            PathEl::QuadTo(a, p) => &[*a, *p],
            PathEl::CurveTo(a, b, p) => &[*a, *b, *p],
            PathEl::ClosePath => &[start],
        };
        for next in points {
            length += at.distance(*next);
            at = *next;
        }
    }
    length
}

fn affine(t: Transform) -> Affine {
    Affine::new([t.sx, t.ky, t.kx, t.sy, t.tx, t.ty].map(f64::from))
}

fn bez_path(path: &skia::Path) -> BezPath {
    let point = |p: skia::Point| Point::new(f64::from(p.x), f64::from(p.y));
    let mut out = BezPath::new();
    for segment in path.segments() {
        match segment {
            skia::PathSegment::MoveTo(p) => out.move_to(point(p)),
            skia::PathSegment::LineTo(p) => out.line_to(point(p)),
            skia::PathSegment::QuadTo(a, p) => out.quad_to(point(a), point(p)),
            skia::PathSegment::CubicTo(a, b, p) => out.curve_to(point(a), point(b), point(p)),
            skia::PathSegment::Close => out.close_path(),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_come_in_and_scripts_links_and_pictures_stay_out() {
        let text = r##"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="100" height="200" onload="alert(1)">
            <script>alert(2)</script><image xlink:href="file:///etc/passwd" width="5" height="5"/>
            <a xlink:href="https://example.org"><rect x="10" y="20" width="30" height="40" fill="#ff0000" fill-opacity=".5"/></a>
            <path d="M0 0L50 0" stroke="#00f" stroke-width="4" fill="none"/></svg>"##;
        let layer = AuthorLayer::parse(text, LayerPlace::Body).unwrap();
        assert_eq!(layer.view.size(), Rect::new(0.0, 0.0, 100.0, 200.0).size());
        assert!(layer.left_out.contains(&"pictures") && layer.left_out.contains(&"scripts"), "{:?}", layer.left_out);
        let drawing = crate::drawing::Drawing {
            view: layer.view,
            title: String::new(),
            description: String::new(),
            background: None,
            layers: vec![crate::drawing::Layer { name: "own".into(), items: vec![layer.over(layer.view)] }],
        };
        let shown = format!("{drawing:?}");
        assert_eq!(shown.matches("Area(").count(), 2);
        assert!(!shown.contains("passwd") && !shown.contains("alert"));
    }

    #[test]
    fn what_is_no_svg_is_refused_with_what_to_do() {
        let fault = AuthorLayer::parse("<html></html>", LayerPlace::Head).unwrap_err();
        assert!(fault.next_step().contains("plain SVG"), "{fault}");
    }

    /// Refused with a next step, and at once.
    fn refused(body: &str, because: &str) {
        let text = format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="100" height="100">{body}</svg>"##
        );
        let begun = std::time::Instant::now();
        let fault = AuthorLayer::parse(&text, LayerPlace::Body).expect_err(because);
        assert!(fault.what().contains(because), "{fault}");
        assert!(fault.next_step().contains("simplify"), "{fault}");
        assert!(begun.elapsed().as_secs_f64() < 5.0, "{because}: {:?}", begun.elapsed());
    }

    #[test]
    fn strokes_of_too_many_dashes_are_refused() {
        let fault =
            AuthorLayer::parse(include_str!("../../tests/bombs/dash-bomb.svg"), LayerPlace::Body).expect_err("a bomb");
        assert!(fault.what().contains("dashes") && fault.next_step().contains("simplify"), "{fault}");
        let line = |dashes: &str, more: &str| {
            format!(r##"<path d="M0 0L1000 1000" stroke="red" stroke-dasharray="{dashes}" {more}/>"##)
        };
        refused(&line("0.0001 0.0001", ""), "dashes");
        refused(&line("1e-6%", ""), "dashes");
        refused(&format!(r##"<g transform="scale(1e-5)">{}</g>"##, line("1e-3", "")), "dashes");
        refused(&line("0 1e-30 0", ""), "dashes");
        refused(&line("1", "").repeat(30), "dashes");
        refused(r##"<path d="M0 0C1e6 0 0 1e6 5 5" stroke="red" stroke-dasharray=".1"/>"##, "dashes");
    }

    #[test]
    fn an_offset_of_many_rounds_is_that_of_the_rest() {
        let dashed = |offset: &str| {
            let text = format!(
                r##"<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><path d="M0 0L90 0" stroke="red" stroke-dasharray="4 2 2" stroke-dashoffset="{offset}"/></svg>"##
            );
            AuthorLayer::parse(&text, LayerPlace::Body).unwrap().items
        };
        assert_eq!(dashed("1600000003"), dashed("1600000003"));
        assert_eq!(dashed("35"), dashed("3"));
    }

    #[test]
    fn strokes_that_reach_too_far_or_have_too_many_segments_are_refused() {
        refused(r##"<path d="M0 0C1e20 0 0 1e20 5 5" stroke="red"/>"##, "10,000,000 units");
        refused(r##"<path d="M0 0L9 9" stroke="red" stroke-width="1e12"/>"##, "10,000,000 units");
        let long = format!(r##"<path d="M0 0{}" stroke="red" fill="none"/>"##, "l1 1".repeat(60_000));
        refused(&long, "50,000 segments");
        refused(&format!(r##"<path d="M0 0{}"/>"##, "l1 1".repeat(600_000)), "500000 segments");
    }

    #[test]
    fn what_references_stand_for_is_bounded_before_it_is_made() {
        // Each level stands for ten of the one before.
        let levels = |one: &dyn Fn(usize) -> String| (1..9).map(one).collect::<String>();
        let uses = levels(&|n| {
            let copies = format!(r##"<use xlink:href="#a{}"/>"##, n - 1).repeat(10);
            format!(r##"<g id="a{n}">{copies}</g>"##)
        });
        refused(
            &format!(r##"<defs><rect id="a0" width="1" height="1"/>{uses}</defs><use xlink:href="#a8"/>"##),
            "elements",
        );
        let patterns = levels(&|n| {
            let fills = format!(r##"<rect width="9" height="9" fill="url(#p{})"/>"##, n - 1).repeat(10);
            format!(r##"<pattern id="p{n}" width="1" height="1">{fills}</pattern>"##)
        });
        refused(&format!(r##"{patterns}<rect width="9" height="9" fill="url(#p8)"/>"##), "elements");
        let shapes = r##"<path d="M0 0L1 1"/>"##.repeat(200);
        let dots = "1 1 ".repeat(2000);
        refused(
            &format!(
                r##"<marker id="m">{shapes}</marker><polyline points="{dots}" stroke="red" marker-mid="url(#m)"/>"##
            ),
            "elements",
        );
        refused(
            &format!(
                r##"<style>polyline {{ marker: url(#m) }}</style><marker id="m">{shapes}</marker><polyline points="{dots}"/>"##
            ),
            "elements",
        );
        refused(&format!("{}{}", "<g>".repeat(300), "</g>".repeat(300)), "100 deep");
    }

    #[test]
    fn entities_that_stand_for_too_much_are_refused() {
        let text = format!(
            r##"<!DOCTYPE svg [<!ENTITY a "{}">]><svg xmlns="http://www.w3.org/2000/svg"><desc>{}</desc></svg>"##,
            "x".repeat(50_000),
            "&a;".repeat(1000)
        );
        let fault = AuthorLayer::parse(&text, LayerPlace::Body).unwrap_err();
        assert!(fault.what().contains("entities"), "{fault}");
        let small = r##"<!DOCTYPE svg [<!ENTITY ns "http://www.w3.org/2000/svg">]><svg xmlns="&ns;" width="9" height="9"><path d="M0 0L9 9L0 9"/></svg>"##;
        assert_eq!(AuthorLayer::parse(small, LayerPlace::Body).unwrap().items.len(), 1);
    }
}
