//! The thesis's figures 3.6 to 3.18 for one's own photo.

use super::axes::{TEXT, chart, rule};
use super::pixels::{LIGHT, cut_out, faded, hue_image, image, mask_image, pixels_image, plane_image};
use super::{GREY, INK};
use crate::drawing::{Anchor, Colour, Drawing, Item};
use crate::geometry::{Affine, BezPath, Circle, Point, Rect, Shape, Vec2, stroke_outline};
use crate::photo::{Bounds, Feature, Located, Photo, Stages};

/// Width of a figure.
const WIDTH: f64 = 600.0;
/// What is marked as chosen: bluish green of Okabe and Ito.
const CHOSEN: Colour = Colour::rgb(0x00, 0x9E, 0x73);
/// What is only considered: their orange.
const CANDIDATE: Colour = Colour::rgb(0xE6, 0x9F, 0x00);
/// Lines that divide: their vermilion.
const DIVIDE: Colour = Colour::rgb(0xD5, 0x5E, 0x00);
/// Search ranges: their sky blue.
const SEARCH: Colour = Colour::rgb(0x56, 0xB4, 0xE9);

/// Every stage as a drawing with its caption: what it shows, a colon, where it comes from. Stages that need eyes are
/// left out where none were found.
#[must_use]
pub fn stages(stages: &Stages) -> Vec<(String, Drawing)> {
    let all = Rect::new(0.0, 0.0, stages.photo.width() as f64, stages.photo.height() as f64);
    let whole = |items: Vec<Item>| figure(all, items);
    let photo = || image(&stages.photo);
    let first = &stages.first;
    let central = outline(box_of(&stages.central), 2.0, CANDIDATE);
    let mut parts = vec![
        (
            "Photo: as it was worked on, with the central rectangle whose colours are taken for the face's".into(),
            whole(vec![photo(), central]),
        ),
        (
            format!(
                "Light and dark: B1, intensity above t1 = m1 \u{2212} s1 = {:.2} \u{2212} {:.2} (fig. 3.6, eq. 3.4)",
                first.mean, first.deviation
            ),
            whole(vec![mask_image(&first.light, LIGHT, INK)]),
        ),
    ];
    parts.push(candidates(stages, &whole));
    if let Some(pair) = stages.pairs.best() {
        let mut items = vec![photo()];
        items.extend([pair.left, pair.right].map(|r| outline(box_of(&r.bounds), 3.0, CHOSEN)));
        let caption = format!("The best pair: of largest score, {:.2} (fig. 3.7 c, eq. 3.5)", pair.score);
        parts.push((caption.replace('-', "\u{2212}"), whole(items)));
    }
    parts.push((
        format!(
            "Hue: the nearer to the face's, {:.0} \u{00B1} {:.0} of 256 steps, the warmer (fig. 3.8 b, eqs. 3.6 to 3.8)",
            stages.second.mean, stages.second.deviation
        )
        .replace(" -", " \u{2212}"),
        whole(vec![hue_image(&stages.hsi, stages.second.mean as f32)]),
    ));
    parts.push((
        "Face and ground: B2, dark where the hue is the face's (fig. 3.8 c, eq. 3.9)".into(),
        whole(vec![mask_image(&stages.second.ground, LIGHT, INK)]),
    ));
    parts.push((
        "Face: F_final, with what it encloses (fig. 3.10 a, eq. 3.10)".into(),
        whole(vec![cut_out(&stages.photo, &stages.refined.face)]),
    ));
    parts.push((
        "Light ground: B3, light and not face (fig. 3.10 b, eq. 3.11)".into(),
        whole(vec![mask_image(&stages.refined.light_ground, LIGHT, INK)]),
    ));
    parts.push((
        "Hair and all in front of the wall: H_final (fig. 3.10 c, eq. 3.12)".into(),
        whole(vec![cut_out(&stages.photo, &stages.refined.hair)]),
    ));
    if let Some(located) = &stages.located {
        parts.extend(after_eyes(stages, located, all));
    }
    parts
}

/// Dark regions that may be eyes, and which of them may be a pair.
fn candidates(stages: &Stages, whole: &dyn Fn(Vec<Item>) -> Drawing) -> (String, Drawing) {
    let pairs = &stages.pairs;
    let mut items = vec![mask_image(&stages.first.light, LIGHT, Colour::rgb(0xB9, 0xB9, 0xBE))];
    items.extend(pairs.candidates.iter().map(|r| outline(box_of(&r.bounds), 2.0, CANDIDATE)));
    for pair in &pairs.pairs {
        let [a, b] = [pair.left, pair.right].map(|r| shown(r.bounds.centre()));
        items.push(rule(a, b, 1.2, CANDIDATE));
    }
    let count = |n: usize, one: &str| if n == 1 { format!("1 {one}") } else { format!("{n} {one}s") };
    let caption = format!(
        "What may be eyes: {} of dark, {} by Chan's rules (fig. 3.7 b)",
        count(pairs.candidates.len(), "region"),
        count(pairs.pairs.len(), "pair")
    );
    (caption, whole(items))
}

/// The stages from the eyeballs on.
fn after_eyes(stages: &Stages, located: &Located, all: Rect) -> Vec<(String, Drawing)> {
    let photo = || image(&stages.photo);
    let eyes = &located.eyes;
    let square = box_of(&located.edges.square);
    // Figures of features show the square and a little round it.
    let near = square.inflate(0.08 * square.width(), 0.08 * square.width()).intersect(all);
    let unit = near.width() / WIDTH;

    let mut balls = vec![photo(), outline(square, 2.4 * unit, CHOSEN)];
    balls.push(rule(shown(eyes.left.centre), shown(eyes.right.centre), 2.0 * unit, CHOSEN));
    balls.extend([eyes.left, eyes.right].map(|ball| {
        Item::area(
            "eyeball",
            stroke_outline(&Circle::new(shown(ball.centre), ball.radius).to_path(0.05), 2.0),
            CANDIDATE,
        )
    }));

    let edges = &located.edges;
    let largest = edges.sobel.pixels().iter().copied().fold(1e-6, f32::max);
    // The square root shows weak edges too.
    let sobel = plane_image(&edges.mirrored, |v| 255.0 - 255.0 * (v / largest).sqrt());
    let mut binary = vec![mask_image(&edges.binary, INK, LIGHT), outline(square, 1.5 * unit, CHOSEN)];
    let lines = [
        (edges.divisions.brow_eye, "brows | eyes"),
        (edges.divisions.eye_nose, "eyes | nose"),
        (edges.divisions.nose_mouth, "nose | mouth"),
    ];
    for (y, name) in lines {
        binary.push(rule(Point::new(square.x0, y + 0.5), Point::new(square.x1, y + 0.5), 2.0 * unit, DIVIDE));
        let at = Point::new(square.x1 - 6.0 * unit, y - 5.0 * unit);
        let size = 1.9 * TEXT * unit;
        let back = Rect::new(at.x - 0.62 * size * name.len() as f64, at.y - size, square.x1, y);
        binary.push(Item::area("", back.to_path(0.1), LIGHT.faded(0.8)));
        binary.push(Item::text(at, size, Anchor::End, DIVIDE, name));
    }

    let features = &located.features;
    let named = [
        (&features.brow, "brow", SEARCH),
        (&features.eye, "eye", CANDIDATE),
        (&features.nose, "nose", CHOSEN),
        (&features.mouth, "mouth", Colour::rgb(0xCC, 0x79, 0xA7)),
    ];
    let label = |b: Rect, name: &str, colour: Colour| {
        let size = 1.9 * TEXT * unit;
        let back = Rect::new(b.x0, b.y0 - 1.25 * size, b.x0 + (0.6 * name.len() as f64 + 0.5) * size, b.y0);
        let text = Item::text(Point::new(b.x0 + 0.25 * size, b.y0 - 0.32 * size), size, Anchor::Start, LIGHT, name);
        Item::moved(name, Affine::IDENTITY, vec![Item::area("", back.to_path(0.1), colour), text])
    };
    let mut ranges = vec![photo()];
    let mut regions = vec![faded(&stages.photo)];
    for (feature, name, colour) in named {
        let search = box_of(&feature.search);
        ranges.push(outline(search, 2.4 * unit, colour));
        ranges.push(label(search, name, colour));
        regions.push(feature_pixels(feature, &stages.photo, colour));
        regions.push(outline(box_of(&feature.bounds), 2.0 * unit, colour));
        regions.push(label(box_of(&feature.bounds), name, colour));
    }
    vec![
        (
            format!("Eyeballs: d = {:.0} pixels apart, with the square of 2d \u{00D7} 2d (fig. 3.11)", eyes.distance()),
            figure(near, balls),
        ),
        (
            "Edges: by Sobel's operator, the right half of the square mapped onto the left (fig. 3.13 a, eq. 3.13)"
                .into(),
            figure(near, vec![sobel, outline(square, 1.5 * unit, CHOSEN)]),
        ),
        (
            "Binary edges: thresholds of their own for brows, eyes, nose and mouth (fig. 3.13 b)".into(),
            figure(near, binary),
        ),
        ("Search ranges: estimated from the eyeballs (figs. 3.14, 3.15 a)".into(), figure(near, ranges)),
        ("Features: edges grown from the search ranges (fig. 3.15 b)".into(), figure(near, regions)),
        cuts(stages, located, near, unit),
        cheeks(stages, located, all),
    ]
}

/// The symmetry cuts of nose and mouth, with how unlike both sides are at each column.
fn cuts(stages: &Stages, located: &Located, near: Rect, unit: f64) -> (String, Drawing) {
    let mut items = vec![faded(&stages.photo)];
    let parts = [(&located.features.nose, &located.nose_cut), (&located.features.mouth, &located.mouth_cut)];
    for (feature, cut) in parts {
        let b = box_of(&feature.bounds);
        items.push(outline(b, 1.4 * unit, GREY));
        let most = cut.unlike.iter().copied().fold(1e-9, f64::max);
        let mut path = BezPath::new();
        for (i, unlike) in cut.unlike.iter().enumerate() {
            let p = Point::new((cut.first + i) as f64 + 0.5, b.y1 - unlike / most * b.height());
            if i == 0 { path.move_to(p) } else { path.line_to(p) }
        }
        items.push(Item::area("", stroke_outline(&path, 2.0 * unit), SEARCH));
        let x = cut.x as f64 + 0.5;
        let over = Vec2::new(0.0, 10.0 * unit);
        items.push(rule(Point::new(x, b.y0) - over, Point::new(x, b.y1) + over, 2.6 * unit, DIVIDE));
    }
    let caption =
        "Middle of nose and mouth: where both sides are least unlike; the blue curve is D_x (eqs. 3.14, 3.15)";
    (caption.into(), figure(near, items))
}

/// The projection of the face's region, the boundaries of the cheeks, and the ears.
fn cheeks(stages: &Stages, located: &Located, all: Rect) -> (String, Drawing) {
    let cheeks = &located.cheeks;
    let mut items = vec![faded(&stages.photo)];
    let middle = located.eyes.middle().x.round() + 0.5;
    let (top, bottom) = (cheeks.rows.0 as f64, cheeks.rows.1 as f64);
    let most = f64::from(cheeks.projection.iter().copied().max().unwrap_or(1).max(1));
    // The curve stands on the floor of the counted rows, a quarter of their height at most.
    let y = |v: u32| bottom - 0.25 * (bottom - top) * f64::from(v) / most;
    for side in [-1.0, 1.0] {
        let mut area = BezPath::new();
        area.move_to(Point::new(middle, bottom));
        for (offset, v) in cheeks.projection.iter().enumerate() {
            area.line_to(Point::new(middle + side * offset as f64, y(*v)));
        }
        area.line_to(Point::new(middle + side * (cheeks.projection.len() - 1) as f64, bottom));
        area.close_path();
        items.push(Item::area("projection", area, SEARCH.faded(0.75)));
    }
    for x in [cheeks.left, cheeks.right] {
        let x = x as f64 + 0.5;
        items.push(rule(Point::new(x, top), Point::new(x, bottom), 2.5, DIVIDE));
    }
    for ear in cheeks.ears.iter().flatten() {
        items.push(pixels_image(&ear.pixels, &ear.bounds, CANDIDATE.faded(0.8)));
    }
    let caption = "Cheeks and ears: pixels of the face's region by column, both sides added; the boundary is a minimum near d \
                   from the middle (fig. 3.16)";
    (caption.into(), figure(all, items))
}

/// Places are centres of pixels; a drawing's pixels have their corners there.
fn shown(p: Point) -> Point {
    p + Vec2::new(0.5, 0.5)
}

fn box_of(b: &Bounds) -> Rect {
    Rect::new(b.x0 as f64, b.y0 as f64, b.x1 as f64, b.y1 as f64)
}

fn outline(rect: Rect, width: f64, colour: Colour) -> Item {
    Item::area("", stroke_outline(&rect.to_path(0.1), width), colour)
}

/// A figure of what `shown` of the working photo shows, [`WIDTH`] wide.
fn figure(shown: Rect, items: Vec<Item>) -> Drawing {
    let scale = WIDTH / shown.width();
    let place = Affine::scale(scale) * Affine::translate(-shown.origin().to_vec2());
    chart(
        "Stage",
        "A stage of finding a face's features.",
        WIDTH,
        scale * shown.height(),
        vec![Item::moved("", place, items)],
    )
}

fn feature_pixels(feature: &Feature, photo: &Photo, colour: Colour) -> Item {
    // The limits of what was grown may lie outside the search range, never outside the photo.
    pixels_image(&feature.pixels, &Bounds::whole(photo.width(), photo.height()), colour)
}
