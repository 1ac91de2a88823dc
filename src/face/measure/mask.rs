//! Masks and fields on the coarse grid of the frame, two units a cell: polygons, blurs, distances, pieces.
//!
//! Hair and background are told apart on this grid; outlines pass between its cells, so they are finer than it.

use super::frame::{Frame, HEIGHT, Lab, VIEW, WIDTH, scan};
use crate::geometry::Point;

/// Units a cell.
pub(super) const CELL: f64 = 2.0;
/// Cells in a row.
pub(super) const COLUMNS: usize = WIDTH / 2;
/// Rows of cells.
pub(super) const ROWS: usize = HEIGHT / 2;
/// Cells.
pub(super) const CELLS: usize = COLUMNS * ROWS;

/// Where the middle of a cell is, in units.
pub(super) fn centre(cell: usize) -> Point {
    let (row, column) = (cell / COLUMNS, cell % COLUMNS);
    // A cell is the mean of frame pixels 2i and 2i + 1.
    Point::new(VIEW.x0 + column as f64 * CELL + 0.5, VIEW.y0 + row as f64 * CELL + 0.5)
}

/// The row of cells at a height in units.
pub(super) fn row_at(y: f64) -> usize {
    ((y - VIEW.y0 - 0.5) / CELL).round().clamp(0.0, (ROWS - 1) as f64) as usize
}

/// The column of cells at a place in units.
pub(super) fn column_at(x: f64) -> usize {
    ((x - VIEW.x0 - 0.5) / CELL).round().clamp(0.0, (COLUMNS - 1) as f64) as usize
}

/// The colours of the cells, and which of them the photo shows.
pub(super) fn cells(frame: &Frame) -> (Vec<Lab>, Vec<bool>) {
    let mut lab = Vec::with_capacity(CELLS);
    let mut inside = Vec::with_capacity(CELLS);
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let first = 2 * row * WIDTH + 2 * column;
            let four = [first, first + 1, first + WIDTH, first + WIDTH + 1];
            lab.push(std::array::from_fn(|k| four.iter().map(|i| frame.lab[*i][k]).sum::<f32>() / 4.0));
            inside.push(four.iter().all(|i| frame.inside[*i]));
        }
    }
    (lab, inside)
}

/// Yes or no for every cell, row by row.
#[derive(Clone, PartialEq)]
pub(super) struct Mask(pub Vec<bool>);

impl Mask {
    /// No cell.
    pub fn none() -> Self {
        Self(vec![false; CELLS])
    }

    /// The cells for which `test` holds of their index.
    pub fn of(test: impl FnMut(usize) -> bool) -> Self {
        Self((0..CELLS).map(test).collect())
    }

    /// The cells whose middles lie inside a polygon given in units.
    pub fn polygon(polygon: &[Point]) -> Self {
        let mut mask = Self::none();
        let cells: Vec<Point> =
            polygon.iter().map(|p| Point::new((p.x - VIEW.x0 - 0.5) / CELL, (p.y - VIEW.y0 - 0.5) / CELL)).collect();
        scan(&cells, COLUMNS, ROWS, |row, from, to| mask.0[row * COLUMNS + from..row * COLUMNS + to].fill(true));
        mask
    }

    /// How many cells.
    pub fn count(&self) -> usize {
        self.0.iter().filter(|v| **v).count()
    }

    /// Its area in square units.
    pub fn area(&self) -> f64 {
        self.count() as f64 * CELL * CELL
    }

    /// Cells of both.
    pub fn and(&self, other: &Self) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(a, b)| *a && *b).collect())
    }

    /// Cells of either.
    pub fn or(&self, other: &Self) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(a, b)| *a || *b).collect())
    }

    /// Cells of this that are not cells of the other.
    pub fn without(&self, other: &Self) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(a, b)| *a && !*b).collect())
    }

    /// All other cells.
    pub fn not(&self) -> Self {
        Self(self.0.iter().map(|a| !a).collect())
    }

    /// Indices of the cells.
    pub fn cells(&self) -> impl Iterator<Item = usize> + '_ {
        self.0.iter().enumerate().filter(|(_, v)| **v).map(|(i, _)| i)
    }

    /// 1 and 0.
    pub fn field(&self) -> Vec<f32> {
        self.0.iter().map(|v| f32::from(u8::from(*v))).collect()
    }

    /// Every cell at most `radius` units from one of its cells; for a negative radius every cell farther than that
    /// from all others.
    pub fn grown(&self, radius: f64) -> Self {
        let reach = radius.abs() / CELL;
        let mut out = Self::none();
        let Some(window) = self.window(if radius >= 0.0 { reach.ceil() as usize } else { 1 }) else { return out };
        let grows = radius >= 0.0;
        let distances = distances_within(&window, |cell| self.0[cell] == grows);
        let reach = (reach * reach) as f32;
        for (near, cell) in distances.into_iter().zip(window.cells()) {
            out.0[cell] = if grows { near <= reach } else { near > reach };
        }
        out
    }

    /// The rows and columns that hold its cells, and `margin` more on every side; none where it has no cell.
    fn window(&self, margin: usize) -> Option<Window> {
        let first = self.0.iter().position(|v| *v)? / COLUMNS;
        let last = self.0.iter().rposition(|v| *v)? / COLUMNS;
        let (mut left, mut right) = (COLUMNS, 0);
        for row in self.0[first * COLUMNS..(last + 1) * COLUMNS].chunks_exact(COLUMNS) {
            if let (Some(l), Some(r)) = (row.iter().position(|v| *v), row.iter().rposition(|v| *v)) {
                left = left.min(l);
                right = right.max(r);
            }
        }
        Some(Window {
            top: first.saturating_sub(margin),
            bottom: (last + 1 + margin).min(ROWS),
            left: left.saturating_sub(margin),
            right: (right + 1 + margin).min(COLUMNS),
        })
    }

    /// Without all parts narrower than twice `radius` units.
    pub fn opened(&self, radius: f64) -> Self {
        self.grown(-radius).grown(radius)
    }

    /// With all gaps filled that are narrower than twice `radius` units.
    pub fn closed(&self, radius: f64) -> Self {
        // Beyond the frame nothing is known, so the border is no gap.
        self.grown(radius).grown(-radius).or(self)
    }

    /// Its connected pieces (sharing an edge) of more than 20 square units, largest first.
    pub fn pieces(&self) -> Vec<Self> {
        let mut seen = vec![false; CELLS];
        let mut found: Vec<Vec<usize>> = Vec::new();
        let mut stack = Vec::new();
        for start in self.cells() {
            if seen[start] {
                continue;
            }
            seen[start] = true;
            stack.push(start);
            let mut piece = Vec::new();
            while let Some(cell) = stack.pop() {
                piece.push(cell);
                let (row, column) = (cell / COLUMNS, cell % COLUMNS);
                let near = [
                    (row > 0).then(|| cell - COLUMNS),
                    (row + 1 < ROWS).then_some(cell + COLUMNS),
                    (column > 0).then(|| cell - 1),
                    (column + 1 < COLUMNS).then_some(cell + 1),
                ];
                for next in near.into_iter().flatten() {
                    if self.0[next] && !seen[next] {
                        seen[next] = true;
                        stack.push(next);
                    }
                }
            }
            found.push(piece);
        }
        found.sort_by_key(|piece| std::cmp::Reverse(piece.len()));
        found
            .into_iter()
            .take_while(|piece| piece.len() > 5)
            .take(80)
            .map(|piece| {
                let mut mask = Self::none();
                piece.into_iter().for_each(|cell| mask.0[cell] = true);
                mask
            })
            .collect()
    }

    /// With all holes smaller than `area` square units filled.
    pub fn without_holes(mut self, area: f64) -> Self {
        for hole in self.not().pieces() {
            let open = hole.cells().any(|c| c % COLUMNS == 0 || c % COLUMNS == COLUMNS - 1 || c / COLUMNS == 0);
            if !open && hole.area() < area {
                self = self.or(&hole);
            }
        }
        self
    }
}

/// A rectangle of cells.
struct Window {
    top: usize,
    bottom: usize,
    left: usize,
    right: usize,
}

impl Window {
    /// Its cells, row by row.
    fn cells(&self) -> impl Iterator<Item = usize> + '_ {
        (self.top..self.bottom).flat_map(|row| (self.left..self.right).map(move |column| row * COLUMNS + column))
    }
}

/// The squared distance of every cell to the nearest of the mask, in cells; infinite where it has none.
pub(super) fn squared_distances(mask: &Mask) -> Vec<f32> {
    distances_within(&Window { top: 0, bottom: ROWS, left: 0, right: COLUMNS }, |cell| mask.0[cell])
}

/// The squared distances of the window's cells to the nearest of them for which `test` holds (Felzenszwalb and
/// Huttenlocher 2012, lower envelopes of parabolas).
fn distances_within(window: &Window, test: impl Fn(usize) -> bool) -> Vec<f32> {
    // Larger than any squared distance on the grid, small enough that adding to it loses nothing.
    const FAR: f32 = 1e9;
    let (wide, tall) = (window.right - window.left, window.bottom - window.top);
    let mut field: Vec<f32> = window.cells().map(|cell| if test(cell) { 0.0 } else { FAR }).collect();
    let longest = wide.max(tall);
    let (mut line, mut out) = (vec![0.0; longest], vec![0.0; longest]);
    let (mut sites, mut starts) = (vec![0_usize; longest], vec![0.0_f32; longest + 1]);
    for column in 0..wide {
        for row in 0..tall {
            line[row] = field[row * wide + column];
        }
        envelope(&line[..tall], &mut out[..tall], &mut sites, &mut starts);
        for row in 0..tall {
            field[row * wide + column] = out[row];
        }
    }
    for row in field.chunks_exact_mut(wide) {
        line[..wide].copy_from_slice(row);
        envelope(&line[..wide], row, &mut sites, &mut starts);
    }
    field.into_iter().map(|d| if d >= FAR { f32::INFINITY } else { d }).collect()
}

/// One line of the distance transform: `out[i]` = the least of `line[j]` + (i - j)².
fn envelope(line: &[f32], out: &mut [f32], sites: &mut [usize], starts: &mut [f32]) {
    let square = |i: usize| (i * i) as f32;
    let mut k = 0;
    sites[0] = 0;
    starts[0] = f32::NEG_INFINITY;
    starts[1] = f32::INFINITY;
    for q in 1..line.len() {
        let meet = |site: usize| ((line[q] + square(q)) - (line[site] + square(site))) / (2 * (q - site)) as f32;
        let mut s = meet(sites[k]);
        while s <= starts[k] {
            k -= 1;
            s = meet(sites[k]);
        }
        k += 1;
        sites[k] = q;
        starts[k] = s;
        starts[k + 1] = f32::INFINITY;
    }
    k = 0;
    for (q, o) in out.iter_mut().enumerate() {
        while starts[k + 1] < q as f32 {
            k += 1;
        }
        let site = sites[k];
        *o = line[site] + square(q.abs_diff(site));
    }
}

/// The mean of a field over squares of `2 radius + 1` cells, cut at the border.
pub(super) fn boxed(field: &[f32], radius: usize) -> Vec<f32> {
    let mut across = vec![0.0; field.len()];
    for (row, out) in field.chunks_exact(COLUMNS).zip(across.chunks_exact_mut(COLUMNS)) {
        let mut sum: f32 = row[..radius].iter().sum();
        for (c, o) in out.iter_mut().enumerate() {
            if c + radius < COLUMNS {
                sum += row[c + radius];
            }
            if c > radius {
                sum -= row[c - radius - 1];
            }
            let count = (c + radius + 1).min(COLUMNS) - c.saturating_sub(radius);
            *o = sum / count as f32;
        }
    }
    let mut out = vec![0.0; field.len()];
    let mut sums = vec![0.0_f32; COLUMNS];
    let add = |sums: &mut [f32], row: usize, sign: f32| {
        sums.iter_mut().zip(&across[row * COLUMNS..(row + 1) * COLUMNS]).for_each(|(s, v)| *s += sign * v);
    };
    (0..radius).for_each(|row| add(&mut sums, row, 1.0));
    for row in 0..ROWS {
        if row + radius < ROWS {
            add(&mut sums, row + radius, 1.0);
        }
        if row > radius {
            add(&mut sums, row - radius - 1, -1.0);
        }
        let share = 1.0 / ((row + radius + 1).min(ROWS) - row.saturating_sub(radius)) as f32;
        out[row * COLUMNS..(row + 1) * COLUMNS].iter_mut().zip(&sums).for_each(|(o, s)| *o = s * share);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_a_search_over_all_cells() {
        let mask = Mask::of(|c| c == 5 * COLUMNS + 7 || c == 200 * COLUMNS + 100 || c == 280 * COLUMNS + 3);
        let found = squared_distances(&mask);
        let at = |c: usize| ((c / COLUMNS) as f32, (c % COLUMNS) as f32);
        for c in (0..CELLS).step_by(97) {
            let nearest = mask.cells().map(|m| (at(m).0 - at(c).0).powi(2) + (at(m).1 - at(c).1).powi(2));
            assert!((nearest.fold(f32::INFINITY, f32::min) - found[c]).abs() < 0.5, "cell {c}");
        }
        assert!(squared_distances(&Mask::none()).iter().all(|d| d.is_infinite()));
    }

    #[test]
    fn opening_takes_strips_away_and_closing_fills_gaps() {
        let wide = Mask::of(|c| (50..90).contains(&(c / COLUMNS)) && (50..90).contains(&(c % COLUMNS)));
        let strip = Mask::of(|c| (60..63).contains(&(c / COLUMNS)) && (90..150).contains(&(c % COLUMNS)));
        let opened = wide.or(&strip).opened(8.0);
        assert!(opened.and(&strip).count() < 20);
        assert!(wide.without(&opened).count() < 60);
        let slit = Mask::of(|c| (50..90).contains(&(c / COLUMNS)) && (68..71).contains(&(c % COLUMNS)));
        assert!(slit.without(&wide.without(&slit).closed(6.0)).count() < 10);
    }

    #[test]
    fn a_box_mean_keeps_constants_and_sums_what_it_covers() {
        assert!(boxed(&vec![0.25; CELLS], 6).iter().all(|v| (v - 0.25).abs() < 1e-4));
        let mut one = vec![0.0; CELLS];
        one[100 * COLUMNS + 100] = 1.0;
        let mean = boxed(&one, 2);
        assert!((mean[102 * COLUMNS + 98] - 0.04).abs() < 1e-6 && mean[103 * COLUMNS + 98].abs() < 1e-6);
    }
}
