//! From a field to closed outlines (marching squares), and from those to few vertices (Ramer 1972, Douglas and
//! Peucker 1973).

use super::frame::VIEW;
use super::mask::{CELL, COLUMNS, ROWS};
use crate::geometry::Point;
use crate::photo::Plane;

/// Where a field over the cells passes 0.5, as closed loops in units, largest area first. A loop runs clockwise as
/// seen where it holds what is above 0.5, and against that round a hole. Beyond the frame the field is 0.
pub(super) fn loops(field: &Plane) -> Vec<Vec<Point>> {
    const LEVEL: f32 = 0.5;
    const WIDE: usize = COLUMNS + 2;
    const TALL: usize = ROWS + 2;
    let at = |row: usize, column: usize| {
        let inside = (1..=ROWS).contains(&row) && (1..=COLUMNS).contains(&column);
        if inside { field[(column - 1, row - 1)] } else { 0.0 }
    };
    // Edges of the padded grid: 2i is the one from node i to its right, 2i + 1 the one from node i down.
    let across = |row: usize, column: usize| 2 * (row * WIDE + column);
    let down = |row: usize, column: usize| 2 * (row * WIDE + column) + 1;
    const NONE: u32 = u32::MAX;
    let mut next = vec![NONE; 2 * WIDE * TALL];
    let mut starts = Vec::new();
    for row in 0..TALL - 1 {
        let mut code = usize::from(at(row, 0) > LEVEL) * 8 + usize::from(at(row + 1, 0) > LEVEL);
        for column in 0..WIDE - 1 {
            let right = (at(row, column + 1) > LEVEL, at(row + 1, column + 1) > LEVEL);
            code += usize::from(right.0) * 4 + usize::from(right.1) * 2;
            let (top, bottom, left, side) =
                (across(row, column), across(row + 1, column), down(row, column), down(row, column + 1));
            // Corners are top left 8, top right 4, bottom right 2, bottom left 1; what is above stays at the right hand.
            let segments: &[(usize, usize)] = match code {
                1 => &[(left, bottom)],
                2 => &[(bottom, side)],
                3 => &[(left, side)],
                4 => &[(side, top)],
                5 => &[(left, top), (side, bottom)],
                6 => &[(bottom, top)],
                7 => &[(left, top)],
                8 => &[(top, left)],
                9 => &[(top, bottom)],
                10 => &[(bottom, left), (top, side)],
                11 => &[(top, side)],
                12 => &[(side, left)],
                13 => &[(side, bottom)],
                14 => &[(bottom, left)],
                _ => &[],
            };
            for (from, to) in segments {
                next[*from] = *to as u32;
                starts.push(*from);
            }
            code = usize::from(right.0) * 8 + usize::from(right.1);
        }
    }
    let place = |edge: usize| {
        let (row, column) = (edge / 2 / WIDE, edge / 2 % WIDE);
        let (a, b) = (at(row, column), if edge.is_multiple_of(2) { at(row, column + 1) } else { at(row + 1, column) });
        let part = f64::from((LEVEL - a) / (b - a)).clamp(0.0, 1.0);
        let (dx, dy) = if edge.is_multiple_of(2) { (part, 0.0) } else { (0.0, part) };
        let unit = |cells: f64, corner: f64| (cells - 1.0) * CELL + 0.5 + corner;
        Point::new(unit(column as f64 + dx, VIEW.x0), unit(row as f64 + dy, VIEW.y0))
    };
    let mut found = Vec::new();
    for start in starts {
        let mut outline = Vec::new();
        let mut edge = start;
        while next[edge] != NONE {
            outline.push(place(edge));
            edge = std::mem::replace(&mut next[edge], NONE) as usize;
        }
        if outline.len() >= 3 {
            found.push(outline);
        }
    }
    found.sort_by(|a, b| area(b).abs().total_cmp(&area(a).abs()));
    found
}

/// The area that a closed outline encloses; positive where it runs clockwise as seen, y down.
pub(super) fn area(outline: &[Point]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>() / 2.0
}

/// A closed outline with few vertices, beginning at its vertex `start`; `other` is kept too. Vertices are taken in
/// the order of how far the outline strays without them, until it strays no more than `tolerance`, but not fewer
/// than `least` where it has so many. Also returns which `least` of them came first, in the order of the outline.
pub(super) fn simplified(
    outline: &[Point],
    start: usize,
    other: usize,
    tolerance: f64,
    least: usize,
) -> (Vec<Point>, Vec<usize>) {
    let n = outline.len();
    let at = |i: usize| outline[(start + i) % n];
    let other = (other + n - start) % n;
    // Spans of the outline between vertices that are kept; `n` is the start again.
    let mut spans: Vec<(usize, usize, usize, f64)> = Vec::new();
    let stray = |from: usize, to: usize| {
        let (a, b) = (at(from), at(to));
        let along = b - a;
        let length = along.hypot();
        let mut worst = (from, -1.0);
        for i in from + 1..to {
            let v = at(i) - a;
            // The distance from the segment, not from its line: an outline may turn back beyond the end.
            let t = if length > 1e-9 { (v.dot(along) / (length * length)).clamp(0.0, 1.0) } else { 0.0 };
            let d = (v - along * t).hypot();
            if d > worst.1 {
                worst = (i, d);
            }
        }
        (from, to, worst.0, worst.1)
    };
    let mut kept = vec![0];
    if other == 0 {
        spans.push(stray(0, n));
    } else {
        kept.push(other);
        spans.extend([stray(0, other), stray(other, n)]);
    }
    while let Some((k, worst)) = spans.iter().enumerate().max_by(|a, b| a.1.3.total_cmp(&b.1.3)) {
        let (from, to, middle, off) = *worst;
        if off < 0.0 || (off <= tolerance && kept.len() >= least) {
            break;
        }
        kept.push(middle);
        spans[k] = stray(from, middle);
        spans.push(stray(middle, to));
    }
    let mut first: Vec<usize> = kept.iter().copied().take(least).collect();
    first.sort_unstable();
    kept.sort_unstable();
    let places = first.iter().filter_map(|i| kept.binary_search(i).ok()).collect();
    (kept.into_iter().map(at).collect(), places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::face::measure::mask::{centre, field_of, per_cell};

    #[test]
    fn a_ring_gives_a_clockwise_outline_and_a_hole_that_runs_against_it() {
        let ring = per_cell(|c| (30.0..80.0).contains(&(centre(c).to_vec2().hypot())));
        let found = loops(&field_of(&ring));
        assert_eq!(found.len(), 2);
        let disc = |r: f64| std::f64::consts::PI * r * r;
        assert!((area(&found[0]) / disc(80.0) - 1.0).abs() < 0.02, "{}", area(&found[0]));
        assert!((area(&found[1]) / -disc(30.0) - 1.0).abs() < 0.04, "{}", area(&found[1]));
        for p in &found[0] {
            assert!((p.to_vec2().hypot() - 80.0).abs() < 2.0);
        }
    }

    #[test]
    fn what_fills_the_frame_has_its_border_as_outline() {
        let found = loops(&per_cell(|_| 1.0));
        assert_eq!(found.len(), 1);
        assert!((area(&found[0]) - VIEW.area()).abs() < 0.02 * VIEW.area());
    }

    #[test]
    fn simplifying_keeps_corners_strays_no_farther_than_said_and_counts_what_is_asked() {
        let mut square = Vec::new();
        for i in 0..40 {
            square.push(Point::new(f64::from(i), 0.3 * f64::from(i % 2)));
        }
        square.extend((0..40).map(|i| Point::new(40.0, f64::from(i))));
        square.extend((0..40).map(|i| Point::new(40.0 - f64::from(i), 40.0)));
        square.extend((0..40).map(|i| Point::new(0.0, 40.0 - f64::from(i))));
        let (few, places) = simplified(&square, 0, 80, 1.0, 4);
        assert_eq!(few, [Point::new(0.0, 0.0), Point::new(40.0, 0.0), Point::new(40.0, 40.0), Point::new(0.0, 40.0)]);
        assert_eq!(places, [0, 1, 2, 3]);
        let (more, places) = simplified(&square, 3, 80, 1.0, 25);
        assert_eq!((more.len(), places.len()), (25, 25));
        assert!(places.windows(2).all(|p| p[0] < p[1]));
        assert_eq!(more[0], square[3]);
    }
}
