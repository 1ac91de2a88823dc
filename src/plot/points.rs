//! Feature points over the photo that they were found in.

use super::axes::{TEXT, block, chart};
use super::pixels::image;
use super::{GREY, INK};
use crate::drawing::{Anchor, Colour, Drawing, Item};
use crate::face::{Face, FeaturePoint as P, How, Part, Placed};
use crate::geometry::{Affine, BezPath, Circle, Point, Rect, Shape, Vec2, stroke_outline};
use crate::photo::Photo;

/// Width of the drawing.
const WIDTH: f64 = 900.0;
/// Height of the line under the photo that says what colours mean.
const FOOT: f64 = 44.0;
/// The longest side of a photo as it is drawn; more cannot be seen.
const PHOTO_SIDE: usize = 1600;

/// The colour of a point that came to be so.
const fn colour_of(how: How) -> Colour {
    match how {
        How::Found => Colour::rgb(0x3B, 0xD9, 0xA4),
        How::Rule => Colour::rgb(0xFF, 0xB7, 0x2B),
        How::Hand => Colour::rgb(0xF2, 0x78, 0xC8),
    }
}

/// A face's points over its photo; see [`points_over`].
#[must_use]
pub fn face_over(photo: &Photo, face: &Face, names: bool) -> Drawing {
    let points: Vec<(P, Placed)> = P::all().filter_map(|p| Some((p, *face.placed(p)?))).collect();
    let mut hair = face.hair.front.clone();
    if let Some(first) = hair.first_mut() {
        *first = face.hair_outline();
    }
    points_over(photo, &points, &hair, names)
}

/// Points over the photo that they were found in, cut to the head: a dot's colour says how it came to be, its size how
/// sure it is. Brows, eyes, nose, lips, jaw and the outlines of hair are joined by thin lines. Coordinates are pixels
/// of the photo, whose pixel centres are whole numbers.
#[must_use]
pub fn points_over(photo: &Photo, points: &[(P, Placed)], hair: &[Vec<Point>], names: bool) -> Drawing {
    let (small, factor) = photo.at_most(PHOTO_SIDE);
    let all = Rect::new(0.0, 0.0, photo.width() as f64, photo.height() as f64);
    let at = |p: P| points.iter().find(|(q, _)| *q == p).map(|(_, placed)| shown(placed.at));
    let unit = match (at(P::P3_6), at(P::P3_5)) {
        (Some(a), Some(b)) => a.distance(b).max(1.0),
        _ => all.width() / 5.0,
    };
    let view = head(points, hair, unit, all);
    let scale = WIDTH / view.width();
    let place = Affine::scale(scale) * Affine::translate(-view.origin().to_vec2());
    let mut items = vec![Item::moved("photo", place * Affine::scale(factor), vec![image(&small)])];

    // Lines first, in page units, a dark one under a light one so that they show on skin and on hair.
    let mut lines = BezPath::new();
    for (part, closed) in joined() {
        let places: Vec<Point> = part.iter().filter_map(|p| at(*p)).collect();
        if places.len() == part.len() {
            lines.extend(curve(&places, closed).iter());
        }
    }
    for outline in hair {
        let places: Vec<Point> = outline.iter().map(|p| shown(*p)).collect();
        lines.extend(polygon(&places).iter());
    }
    let lines = place * lines;
    items.push(Item::area("", stroke_outline(&lines, 3.0), Colour::BLACK.faded(0.25)));
    items.push(Item::area("outlines", stroke_outline(&lines, 1.3), Colour::WHITE.faded(0.85)));

    for (point, placed) in points {
        let centre = place * shown(placed.at);
        // From 60 to 100 % of the full size.
        let radius = 5.2 * (0.6 + 0.4 * placed.confidence.clamp(0.0, 1.0));
        items.push(dot("", centre, radius + 1.3, INK.faded(0.85)));
        items.push(dot(&point.name(), centre, radius, colour_of(placed.how)));
    }
    if names {
        items.extend(labels(points, place));
    }
    let height = scale * view.height();
    items.push(block(Rect::new(0.0, height, WIDTH, height + FOOT), Colour::WHITE));
    items.extend(legend(points, height + 0.62 * FOOT));
    chart("Feature points", "The feature points of a face over its photo.", WIDTH, height + FOOT, items)
}

/// What of the photo is shown: all points and outlines with a margin, within the photo.
fn head(points: &[(P, Placed)], hair: &[Vec<Point>], unit: f64, all: Rect) -> Rect {
    let places = points.iter().map(|(_, placed)| placed.at).chain(hair.iter().flatten().copied());
    let bounds =
        places.fold(None, |bounds: Option<Rect>, p| Some(bounds.map_or(Rect::from_points(p, p), |b| b.union_pt(p))));
    let view = bounds.map_or(all, |b| b.inflate(0.5 * unit, 0.45 * unit).intersect(all));
    // Points that lie far outside would leave nothing to show.
    if view.width() < 8.0 || view.height() < 8.0 { all } else { view }
}

/// Which points are joined, and whether the line closes.
fn joined() -> [(Vec<P>, bool); 10] {
    [
        (vec![P::P4_6, P::P4_4A, P::P4_4, P::P4_2], false),
        (vec![P::P4_5, P::P4_3A, P::P4_3, P::P4_1], false),
        (vec![P::P3_12, P::P3_2, P::P3_8, P::P3_4], true),
        (vec![P::P3_11, P::P3_1, P::P3_7, P::P3_3], true),
        (vec![P::P8_4, P::P8_9, P::P8_1, P::P8_10, P::P8_3, P::P8_2], true),
        (vec![P::P8_4, P::P2_2, P::P8_3], false),
        (vec![P::P8_4, P::P2_3, P::P8_3], false),
        (vec![P::P9_14, P::P9_2, P::P9_4, P::P9_15, P::P9_5, P::P9_1, P::P9_13], false),
        (vec![P::P10_2, P::P10_4, P::P10_6], false),
        (vec![P::P10_1, P::P10_3, P::P10_5], false),
    ]
}

/// A smooth line through places (Catmull and Rom): handles are a sixth of the way between neighbours.
fn curve(places: &[Point], closed: bool) -> BezPath {
    let n = places.len();
    let mut path = BezPath::new();
    let Some(first) = places.first() else { return path };
    path.move_to(*first);
    let at = |i: isize| match closed {
        true => places[i.rem_euclid(n as isize) as usize],
        false => places[i.clamp(0, n as isize - 1) as usize],
    };
    for i in 0..(if closed { n } else { n - 1 }) as isize {
        let (a, b) = (at(i), at(i + 1));
        path.curve_to(a + (b - at(i - 1)) / 6.0, b - (at(i + 2) - a) / 6.0, b);
    }
    path
}

fn polygon(places: &[Point]) -> BezPath {
    let mut path = BezPath::new();
    for (i, p) in places.iter().enumerate() {
        if i == 0 { path.move_to(*p) } else { path.line_to(*p) }
    }
    if !places.is_empty() {
        path.close_path();
    }
    path
}

/// Names beside their points, each on the side that leads away from the middle of its part, where it hides least.
fn labels(points: &[(P, Placed)], place: Affine) -> Vec<Item> {
    let mut items = Vec::new();
    let mut taken: Vec<Rect> = Vec::new();
    let size = TEXT - 1.0;
    for (point, placed) in points {
        let own: Vec<Point> =
            points.iter().filter(|(q, _)| side(*q) == side(*point)).map(|(_, placed)| placed.at).collect();
        let middle = (own.iter().fold(Vec2::ZERO, |s, p| s + p.to_vec2()) / own.len() as f64).to_point();
        let out = placed.at - middle;
        let centre = place * shown(placed.at);
        let name = point.name();
        let width = 0.56 * size * name.len() as f64;
        let start = if out.hypot() < 1e-6 { -std::f64::consts::FRAC_PI_2 } else { out.atan2() };
        // Tries places round the point, the outward one first.
        let turns = [0.0, 0.6, -0.6, 1.2, -1.2, 1.9, -1.9, 2.6, -2.6, std::f64::consts::PI];
        let frame = |turn: f64, far: f64| {
            let way = Vec2::from_angle(start + turn);
            let middle = centre + Vec2::new(way.x * (far + width / 2.0), way.y * (far + size / 2.0));
            Rect::from_center_size(middle, (width + 2.0, size))
        };
        let free = |r: &Rect| taken.iter().all(|t| t.intersect(*r).area() < 1.0);
        let tried = [9.0, 15.0, 24.0].into_iter().flat_map(|far| turns.map(|turn| (turn, far)));
        let rect = tried.map(|(turn, far)| frame(turn, far)).find(free).unwrap_or_else(|| frame(0.0, 9.0));
        taken.push(rect);
        let base = Point::new(rect.center().x, rect.y1 - 0.15 * size);
        items.push(block(rect.inflate(1.0, 1.0), INK.faded(0.45)));
        items.push(Item::text(base, size, Anchor::Middle, Colour::WHITE, name));
    }
    items
}

/// The part of a face that a point belongs to, brows, eyes and ears each by itself.
fn side(point: P) -> (Part, bool) {
    let own = matches!(point.part(), Part::Brows | Part::Eyes | Part::Ears);
    (point.part(), own && point.index() < point.mirror().index())
}

/// What the colours mean, with how many points are so.
fn legend(points: &[(P, Placed)], y: f64) -> Vec<Item> {
    let mut items = Vec::new();
    let mut x = 20.0;
    for (how, name) in [(How::Found, "found"), (How::Rule, "placed by a rule"), (How::Hand, "set by hand")] {
        let count = points.iter().filter(|(_, placed)| placed.how == how).count();
        if count == 0 {
            continue;
        }
        items.push(dot("", Point::new(x + 6.0, y - 4.5), 6.5, INK.faded(0.85)));
        items.push(dot("", Point::new(x + 6.0, y - 4.5), 5.2, colour_of(how)));
        let text = format!("{count} {name}");
        items.push(Item::text(Point::new(x + 20.0, y), TEXT + 1.0, Anchor::Start, INK, text.clone()));
        x += 48.0 + 0.56 * (TEXT + 1.0) * text.len() as f64;
    }
    items.push(Item::text(Point::new(WIDTH - 20.0, y), TEXT, Anchor::End, GREY, "smaller: less sure"));
    items
}

fn dot(name: &str, centre: Point, radius: f64, colour: Colour) -> Item {
    Item::area(name, Circle::new(centre, radius).to_path(0.05), colour)
}

/// Places are centres of pixels; a drawing's pixels have their corners there.
fn shown(p: Point) -> Point {
    p + Vec2::new(0.5, 0.5)
}
