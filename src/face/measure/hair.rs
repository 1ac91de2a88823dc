//! The hair: what of the mask is hair indeed, its outlines, and the 25 points round it.

use super::colours::median;
use super::frame::Lab;
use super::kind::kind;
use super::mask::{
    CELL, CELLS, COLUMNS, ROWS, area_of, cells_in, centre, column_at, field_of, no_cells, per_cell, pieces_of,
    without_holes,
};
use super::outline::{area, loops, simplified};
use super::segment::{Regions, ear};
use super::shape::Shape;
use crate::face::{FeaturePoint as P, HairKind};
use crate::geometry::{Point, Vec2};
use crate::photo::{Mask, Plane};

/// How far a simplified outline may stray from the measured one, in units: at 2.3 hair keeps 50 to 60 vertices.
const TOLERANCE: f64 = 2.3;
/// The smallest piece of hair, in square units: less is a stray strand.
const LEAST_PIECE: f64 = 350.0;
/// The smallest hole in hair, in square units.
const LEAST_HOLE: f64 = 260.0;

/// The most outlines of what is seen.
const MOST_OUTLINES: usize = 24;

/// The hair in units.
pub(super) struct Found {
    pub kind: HairKind,
    /// Outlines of what is seen, largest first.
    pub front: Vec<Vec<Point>>,
    /// The 25 vertices of the first one.
    pub vertices: Vec<usize>,
    /// Outlines of what lies behind the head.
    pub back: Vec<Vec<Point>>,
    /// The cells of what is seen.
    pub mask: Mask,
    /// How much of the left and the right ear is seen, 0 to 1.
    pub ears: [f64; 2],
    /// The highest place of head or hair.
    pub top: f64,
    /// The median colour of what is seen; none where there is none.
    pub colour: Option<Lab>,
}

/// The hair of segmented cells.
pub(super) fn found(regions: &Regions, shape: &Shape, skin: Lab) -> Found {
    let head = per_cell(|c| regions.inside[c] && regions.back()[c] < 0.5);
    let head = pieces_of(&head).into_iter().next().unwrap_or_else(no_cells);
    let raw = per_cell(|c| regions.hair()[c] > 0.5);
    let mask = without_shade(&raw, regions, shape);
    let (ears, mask) = with_hidden_ears(mask, regions, shape);
    let mask = mask.opened(1.5 / CELL);
    let mask = pieces(&mask, shape);
    let mask = without_holes(without_brows(mask, shape), LEAST_HOLE);
    let mask = pieces(&mask, shape);
    let top = top(&head.or(&mask)).unwrap_or(shape.points[P::P11_1].y);
    let kind = kind(regions, shape, &head, &mask, skin);
    if kind == HairKind::Bald {
        let none = no_cells();
        return Found {
            kind,
            front: Vec::new(),
            vertices: Vec::new(),
            back: Vec::new(),
            mask: none,
            ears,
            top,
            colour: None,
        };
    }
    // Short hair has no locks below the ears.
    let mask = if kind == HairKind::Shaved { per_cell(|c| mask.pixels()[c] && centre(c).y < shape.lobe) } else { mask };
    // Lights on a shaved head are no holes in its hair.
    let mask = if kind == HairKind::Shaved { without_holes(mask, 1e9) } else { mask };
    // Over the brows hair faces the camera; beside the face it lies in the shade.
    let core = mask.grown(-2.0 / CELL);
    let over = core.and(&per_cell(|c| centre(c).y < shape.brows - 10.0 && regions.from_face[c] < 45.0));
    let facing = if area_of(&over) > 1500.0 { over } else { core };
    let mut colours: Vec<Lab> = facing.indices().map(|c| regions.lab[c]).collect();
    if kind == HairKind::Shaved {
        // A shaved head shines: stubble is what does not.
        colours.sort_by(|a, b| a[0].total_cmp(&b[0]));
        colours.truncate(colours.len() / 2);
    }
    let colour = median(&colours);
    let field = field(regions, &mask);
    let (front, vertices) = outlines(&field);
    let back = back(&mask, shape);
    Found { kind, front, vertices, back, mask, ears, top, colour }
}

/// Without what is as dark as hair where none grows: the throat, the neck in the shade, the cheek's edge.
fn without_shade(raw: &Mask, regions: &Regions, shape: &Shape) -> Mask {
    let throat = per_cell(|c| {
        let p = centre(c);
        let x = p.x.abs();
        (p.y > shape.lobe && x < 0.72 * shape.half_jaw) || (p.y > shape.chin - 12.0 && x < 0.9 * shape.half_jaw)
    });
    let clear = raw.without(&throat);
    // Below the lobes, and before the ears below the eyes, hair and shade look alike.
    let low = per_cell(|c| clear.pixels()[c] && centre(c).y > shape.lobe);
    let side = per_cell(|c| {
        let p = centre(c);
        clear.pixels()[c] && p.y <= shape.lobe && p.y > 6.0 && p.x.abs() < shape.ears + 3.0
    });
    let certain = clear.without(&low).without(&side);
    let colours = |mask: &Mask| median(&mask.indices().map(|c| regions.lab[c]).collect::<Vec<_>>());
    let Some(hair) = colours(&certain.grown(-2.0 / CELL)) else { return certain };
    let kept = |doubtful: &Mask, test: &dyn Fn(&Mask) -> bool| {
        let pieces = pieces_of(&doubtful.opened(3.0 / CELL));
        let real = pieces.iter().filter(|p| test(p)).fold(no_cells(), |all, p| all.or(p));
        doubtful.and(&real.grown(3.0 / CELL))
    };
    // Sideburns are as dark as the rest of the hair, or broader than any shade.
    let sideburns = kept(&side, &|piece| {
        colours(piece).is_some_and(|tone| {
            let [l, a, b] = [0, 1, 2].map(|k| tone[k] - hair[k]);
            l < 0.07 && a.hypot(b) < 0.03
        })
    });
    let broad = side.and(&side.opened(6.0 / CELL).grown(4.0 / CELL));
    let locks = kept(&low, &|piece| is_lock(regions, piece));
    certain.or(&sideburns).or(&broad).or(&locks)
}

/// Whether a piece beside the neck is a lock of hair and no shade: shade is smooth, and has no edge towards the skin
/// that it lies on.
fn is_lock(regions: &Regions, piece: &Mask) -> bool {
    // On 72 people shade reaches 2600, 0.019 and 0.09; locks lie above at least one.
    const LARGE: f64 = 3300.0;
    const ROUGH: f32 = 0.021;
    const EDGE: f32 = 0.10;
    let light = |cell: usize| regions.lab[cell][0];
    let core: Vec<usize> =
        piece.grown(-3.0 / CELL).indices().filter(|c| (COLUMNS + 1..CELLS - COLUMNS).contains(c)).collect();
    let rough = core.iter().map(|c| {
        let around = light(c - 1) + light(c + 1) + light(c - COLUMNS) + light(c + COLUMNS);
        (light(*c) - around / 4.0).abs()
    });
    let rough = rough.sum::<f32>() / core.len().max(1) as f32;
    let left = piece.indices().map(|c| centre(c).x).sum::<f64>() < 0.0;
    let mut edges: Vec<f32> = piece
        .rows()
        .enumerate()
        .filter_map(|(row, cells)| {
            let edge = if left { cells.iter().rposition(|v| *v) } else { cells.iter().position(|v| *v) }?;
            let inward = if left { 1 } else { -1 };
            let at = |steps: isize| {
                let column = (edge as isize + inward * steps).clamp(0, COLUMNS as isize - 1);
                light(row * COLUMNS + column as usize)
            };
            Some(at(3) - at(-2))
        })
        .collect();
    edges.sort_by(f32::total_cmp);
    area_of(piece) > LARGE || rough > ROUGH || edges.get(edges.len() / 2).is_some_and(|e| *e > EDGE)
}

/// Notches beside an ear under hair that are narrower than twice this, in face units, are filled.
const NOTCH: f64 = 14.0;

/// How much of each ear is seen; an ear under hair is hair.
fn with_hidden_ears(mut mask: Mask, regions: &Regions, shape: &Shape) -> ([f64; 2], Mask) {
    let p = &shape.points;
    let sides = [[p[P::P10_2], p[P::P10_4], p[P::P10_6]], [p[P::P10_1], p[P::P10_3], p[P::P10_5]]];
    let seen = sides.map(|[top, out, lobe]| {
        let whole = cells_in(&ear(top, out, lobe));
        let skin = whole.indices().filter(|c| regions.skin()[*c] > 0.5 && !mask.pixels()[*c]).count();
        let seen = skin as f64 / whole.count().max(1) as f64;
        if seen < 0.45 {
            mask = mask.or(&per_cell(|c| whole.pixels()[c] && regions.back()[c] < 0.5));
            // What shows of it between hair and cheek would be a notch in the hair.
            let even = mask.closed(NOTCH / CELL);
            let near = |p: Point| p.distance(lobe) < 3.0 * NOTCH && p.y < lobe.y + NOTCH;
            mask = mask.or(&per_cell(|c| even.pixels()[c] && near(centre(c)) && regions.back()[c] < 0.5));
        }
        seen
    });
    (seen, mask)
}

/// The largest piece on the head, and at most three that are neither small against it nor larger: those are clothes.
fn pieces(mask: &Mask, shape: &Shape) -> Mask {
    let pieces = pieces_of(mask);
    let on_head = |piece: &&Mask| piece.indices().any(|c| centre(c).y < shape.ear_top);
    let Some(main) = pieces.iter().find(on_head) else { return no_cells() };
    let largest = area_of(main);
    pieces
        .iter()
        .filter(|p| area_of(p) > LEAST_PIECE && area_of(p) > 0.05 * largest && area_of(p) <= largest)
        .take(4)
        .fold(no_cells(), |all, p| all.or(p))
}

/// With a window round the brows: those under a fringe could not act (recipe part 6).
fn without_brows(mut mask: Mask, shape: &Shape) -> Mask {
    let p = &shape.points;
    for (brow, eye) in
        [([P::P4_6, P::P4_4A, P::P4_4, P::P4_2], P::P3_6), ([P::P4_1, P::P4_3, P::P4_3A, P::P4_5], P::P3_5)]
    {
        let mut window: Vec<Point> = brow.iter().map(|b| p[*b] - Vec2::new(0.0, 7.0)).collect();
        window.extend(brow.iter().rev().map(|b| Point::new(p[*b].x, p[eye].y + 4.0)));
        mask = mask.without(&cells_in(&window));
    }
    mask
}

/// The highest row of the head that is at least 6 units wide; none where there is no such row.
fn top(head: &Mask) -> Option<f64> {
    let row = head.rows().position(|row| row.iter().filter(|v| **v).count() >= 3);
    row.map(|row| centre(row * COLUMNS).y - CELL / 2.0)
}

/// The mask with the soft edges of the labels, blurred by about one and a half units.
fn field(regions: &Regions, mask: &Mask) -> Plane {
    let near = mask.grown(3.0 / CELL);
    let soft: Plane = per_cell(|c| match (mask.pixels()[c], near.pixels()[c]) {
        (true, _) => regions.hair()[c].max(0.55),
        (_, true) => regions.hair()[c].min(0.45),
        _ => 0.0,
    });
    // Twice a mean over three cells has a spread of 1.2 cells.
    soft.boxed(1).boxed(1)
}

/// The outlines with few vertices, and which 25 of the first one the points are.
fn outlines(field: &Plane) -> (Vec<Vec<Point>>, Vec<usize>) {
    let mut front = Vec::new();
    let mut vertices = Vec::new();
    for outline in loops(field) {
        let size = area(&outline);
        if front.is_empty() {
            if size < LEAST_PIECE {
                break;
            }
            let (left, right) = ends(&outline);
            let (few, first) = simplified(&outline, left, right, TOLERANCE, P::HAIR);
            vertices = first;
            front.push(few);
        } else if front.len() < MOST_OUTLINES && !(-LEAST_HOLE / 2.0..=LEAST_PIECE / 2.0).contains(&size) {
            let far = (0..outline.len())
                .max_by(|a, b| outline[*a].distance(outline[0]).total_cmp(&outline[*b].distance(outline[0])));
            let (few, _) = simplified(&outline, 0, far.unwrap_or(0), TOLERANCE, 4);
            front.push(few);
        }
    }
    (front, vertices)
}

/// The lowest vertices at the left and at the right: where `h.1` is, and where the hairline begins.
fn ends(outline: &[Point]) -> (usize, usize) {
    let middle = {
        let (low, high) = outline.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p.x), h.max(p.x)));
        // Hair at one side alone still has two: they are told apart about its own middle.
        if low < -20.0 && high > 20.0 { 0.0 } else { (low + high) / 2.0 }
    };
    let lowest = |side: f64| {
        (0..outline.len())
            .filter(|i| (outline[*i].x - middle) * side >= 0.0)
            .max_by(|a, b| outline[*a].y.total_cmp(&outline[*b].y))
            .unwrap_or(0)
    };
    (lowest(-1.0), lowest(1.0))
}

/// What lies behind the head: every row filled between its sides where it has hair at both, gaps closed.
fn back(mask: &Mask, _shape: &Shape) -> Vec<Vec<Point>> {
    let mut filled = mask.clone();
    for row in 0..ROWS {
        let cells = filled.row_mut(row);
        let (Some(first), Some(last)) = (cells.iter().position(|v| *v), cells.iter().rposition(|v| *v)) else {
            continue;
        };
        let wide = (last - first) as f64 * CELL > 60.0;
        if wide && first < column_at(-30.0) && last > column_at(30.0) {
            cells[first..=last].fill(true);
        }
    }
    let closed = without_holes(filled.closed(14.0 / CELL), 1e9);
    let soft = field_of(&closed).boxed(1).boxed(1);
    loops(&soft)
        .into_iter()
        .filter(|o| area(o) > LEAST_PIECE)
        .take(8)
        .map(|o| {
            let (left, right) = ends(&o);
            simplified(&o, left, right, TOLERANCE, 4).0
        })
        .collect()
}
