//! The mouth: what can be seen inside it, the lips, and the line between them (recipe part 4).

use super::Palette;
use crate::drawing::Item;
use crate::face::rig::Mouth;
use crate::geometry::{BezPath, CubicBez, Ellipse, ParamCurve, PathEl, Point, Shape, Vec2, brush, lerp, spline};

/// The mouth, back to front. `ink` is the width of the face's ink in face units, `ink_only` whether the style has no
/// colours.
pub(super) fn mouth(mouth: &Mouth, palette: &Palette, ink: f64, ink_only: bool) -> Vec<Item> {
    let mut items = Vec::with_capacity(12);
    if !ink_only {
        items.push(Item::area("lip-shadow", shadow(mouth), palette.shade));
    }
    if mouth.parted() > 0.0 {
        items.push(inside(mouth, palette, ink_only));
    }
    if ink_only {
        let below: Vec<Point> = lines(&mouth.lower_edge, 12)[5..20].to_vec();
        items.push(Item::area("lip-lower", brush(&below, 0.8 * ink, &[0.0, 1.0, 0.0]), palette.ink));
        let above = lines(&mouth.upper_edge, 6);
        items.push(Item::area("lip-upper", brush(&above, 0.7 * ink, &[0.3, 0.8, 0.6, 0.8, 0.3]), palette.ink));
    } else {
        items.push(Item::area("lip-lower", lip(&mouth.lower_edge, &mouth.lower_inner), palette.lip));
        items.push(Item::area("lip-light", light(mouth), palette.lip_light.faded(0.75)));
        items.push(Item::area("lip-upper", lip(&mouth.upper_edge, &mouth.upper_inner), palette.lip_upper));
    }
    items.extend(line_between(mouth, palette, ink));
    items
}

/// The skin under the lower lip.
fn shadow(mouth: &Mouth) -> BezPath {
    let (at, width) = (mouth.bottom, mouth.width());
    let p = |x: f64, y: f64| at + Vec2::new(x * width, y);
    let mut path = BezPath::new();
    path.push(PathEl::MoveTo(p(-0.30, 1.0)));
    path.push(PathEl::CurveTo(p(-0.15, 5.0), p(0.15, 5.0), p(0.30, 1.0)));
    path.push(PathEl::CurveTo(p(0.10, -1.0), p(-0.10, -1.0), p(-0.30, 1.0)));
    path.push(PathEl::ClosePath);
    path
}

/// A lip between its outer edge and its inner one, both from left to right.
fn lip(outer: &[CubicBez], inner: &[CubicBez]) -> BezPath {
    let mut path = BezPath::new();
    path.push(PathEl::MoveTo(outer[0].p0));
    for c in outer {
        path.push(PathEl::CurveTo(c.p1, c.p2, c.p3));
    }
    back_along(&mut path, inner);
    path
}

/// Goes back from right to left along an inner edge, and closes.
fn back_along(path: &mut BezPath, inner: &[CubicBez]) {
    path.push(PathEl::LineTo(inner[inner.len() - 1].p3));
    for c in inner.iter().rev() {
        path.push(PathEl::CurveTo(c.p2, c.p1, c.p0));
    }
    path.push(PathEl::ClosePath);
}

/// Where the lower lip shines.
fn light(mouth: &Mouth) -> BezPath {
    let (top, width) = (mouth.inner[1], mouth.width());
    let height = mouth.bottom.y - top.y;
    let p = |x: f64, y: f64| top + Vec2::new(x * width, y * height);
    spline(&[p(-0.20, 0.36), p(0.0, 0.30), p(0.13, 0.36), p(0.02, 0.56), p(-0.12, 0.54)], true)
}

/// Tongue and teeth between the inner edges.
fn inside(mouth: &Mouth, palette: &Palette, ink_only: bool) -> Item {
    let mut hole = BezPath::new();
    hole.push(PathEl::MoveTo(mouth.upper_inner[0].p0));
    for c in &mouth.upper_inner {
        hole.push(PathEl::CurveTo(c.p1, c.p2, c.p3));
    }
    back_along(&mut hole, &mouth.lower_inner);
    let (gap, width, [top, bottom]) = (mouth.gap(), mouth.width(), mouth.inner);
    let open_width = mouth.upper_inner[3].p3.x - mouth.upper_inner[0].p0.x;
    let mut items = vec![Item::area("mouth-inside", hole.clone(), palette.mouth)];

    // The tongue rests on the lower lip, sinks as the mouth closes, and rises behind the teeth for *n*.
    let rest = (0.52 * gap).min(0.22 * width);
    let sunk = (1.0 - (gap - 4.0) / 5.0).clamp(0.0, 1.0).max(mouth.bite) * (1.0 - mouth.tongue) * rest;
    let middle = lerp(bottom.y + 0.25 * rest + sunk, top.y + 0.72 * gap, mouth.tongue);
    let radii = (lerp(0.36, 0.34, mouth.tongue) * open_width, lerp(rest, 0.5 * gap, mouth.tongue));
    let tongue = Ellipse::new(Point::new(top.x, middle), radii, 0.0).to_path(0.02);
    items.push(Item::area("tongue", tongue, palette.tongue));
    if !ink_only {
        let groove = [Point::new(top.x, middle - 0.35 * radii.1), Point::new(top.x, bottom.y + gap)];
        let path = brush(&groove, 0.03 * width, &[0.0, 1.0, 1.0]);
        items.push(Item::area("tongue-middle", path, palette.tongue_shade.faded(0.7)));
    }
    items.push(Item::area("teeth", teeth(mouth, open_width), palette.teeth));
    if !ink_only {
        items.push(Item::area("lip-shade", under_lip(mouth), palette.mouth.faded(0.28)));
    }
    Item::clipped("mouth-open", hole, items)
}

/// The upper teeth: a band whose lower edge is a flat U, for they bend away from the viewer. More of them shows in a
/// spread mouth, less in a rounded one; a bite fills the opening with them.
fn teeth(mouth: &Mouth, open_width: f64) -> BezPath {
    let (gap, top) = (mouth.gap(), mouth.inner[0]);
    let spread = ((mouth.width() / mouth.neutral_width - 1.0) / 0.2).clamp(0.0, 1.0);
    let share = lerp(lerp(0.42, 0.60, spread), 0.26, mouth.tongue);
    let free = (share * gap).max(3.2).min(0.105 * mouth.neutral_width);
    // On the way from a bite to a vowel the lip leaves the teeth at once.
    let filled = ((mouth.bite - 0.5) / 0.5).clamp(0.0, 1.0);
    let deep = lerp(free * lerp(1.0, 0.35, mouth.rounded), 1.2 * gap + 1.0, filled);
    let half = lerp(0.46, 0.40, mouth.rounded) * open_width;
    let p = |x: f64, y: f64| Point::new(top.x + x * half, top.y + y);
    let side = lerp(0.35, 1.0, filled) * deep;
    let mut path = BezPath::new();
    path.push(PathEl::MoveTo(p(-1.0, -25.0)));
    path.push(PathEl::LineTo(p(-1.0, side)));
    path.push(PathEl::CurveTo(p(-0.6, 0.95 * deep), p(-0.3, deep), p(0.0, deep)));
    path.push(PathEl::CurveTo(p(0.3, deep), p(0.6, 0.95 * deep), p(1.0, side)));
    path.push(PathEl::LineTo(p(1.0, -25.0)));
    path.push(PathEl::ClosePath);
    path
}

/// What the upper lip shades of the teeth: a strip along its inner edge.
fn under_lip(mouth: &Mouth) -> BezPath {
    let down = Vec2::new(0.0, (0.16 * mouth.gap()).min(2.2));
    let edge = &mouth.upper_inner;
    let mut path = BezPath::new();
    path.push(PathEl::MoveTo(edge[0].p0));
    for c in edge {
        path.push(PathEl::CurveTo(c.p1, c.p2, c.p3));
    }
    path.push(PathEl::LineTo(edge[3].p3 + down));
    for c in edge.iter().rev() {
        path.push(PathEl::CurveTo(c.p2 + down, c.p1 + down, c.p0 + down));
    }
    path.push(PathEl::ClosePath);
    path
}

/// The line between the lips, from corner to corner and a little past each: one firm line where they meet, the edge of
/// either where not.
fn line_between(mouth: &Mouth, palette: &Palette, ink: f64) -> Vec<Item> {
    /// Shares of the width, from past one corner to past the other.
    const CLOSED: [f64; 13] = [0.0, 0.7, 0.65, 0.8, 0.95, 1.05, 0.95, 1.05, 0.95, 0.8, 0.65, 0.7, 0.0];
    const OPEN: [f64; 13] = [0.0, 0.9, 0.85, 0.9, 1.0, 1.0, 1.0, 1.0, 1.0, 0.9, 0.85, 0.9, 0.0];
    let parted = mouth.parted();
    // The tick past a corner goes up where corners are raised above the middle, and down where they hang. Gathered
    // lips have nearly none.
    let middle = mouth.inner[0].midpoint(mouth.inner[1]).y;
    let tick = |side: usize| {
        let corner = mouth.corners[side];
        let hang = ((corner.y - middle) / (0.05 * mouth.neutral_width)).clamp(-1.0, 1.0);
        let out = lerp(3.0, 0.8, mouth.rounded);
        corner + Vec2::new(if side == 0 { -out } else { out }, lerp(-0.9, 1.6, 0.5 + 0.5 * hang) * out / 3.0)
    };
    let mut line = vec![tick(0), mouth.corners[0]];
    line.extend(lines(&mouth.upper_inner, 5));
    line.extend([mouth.corners[1], tick(1)]);
    let profile: [f64; 13] = std::array::from_fn(|i| lerp(CLOSED[i], OPEN[i], parted));
    let upper = brush(&line, ink * lerp(1.25, 0.8, parted), &profile);
    let mut items = Vec::with_capacity(2);
    if parted > 0.0 {
        let lower = brush(&lines(&mouth.lower_inner, 5), 0.5 * ink, &[0.7, 1.0, 0.7]);
        items.push(Item::area("lip-line-lower", lower, palette.lip_line.faded(0.8 * parted)));
    }
    items.push(Item::area("lip-line", upper, palette.lip_line));
    items
}

/// Points along a chain of curves, `each` steps a curve.
fn lines(chain: &[CubicBez], each: usize) -> Vec<Point> {
    let mut line = Vec::with_capacity(each * chain.len() + 1);
    line.extend(chain.first().map(|c| c.p0));
    for c in chain {
        line.extend((1..=each).map(|i| c.eval(i as f64 / each as f64)));
    }
    line
}
