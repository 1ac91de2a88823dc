//! What is behind the head: a smooth surface of colour fitted to what lies far from the face, and how plain it is.

use super::frame::Lab;
use super::mask::{CELLS, COLUMNS, ROWS, centre, no_cells};
use super::mixture::Mixture;
use super::shape::Shape;
use crate::geometry::Point;
use crate::photo::Mask;

/// 1, u, v, u², uv, v².
const TERMS: usize = 6;
/// Of every so many cells one is fitted to.
const STRIDE: usize = 5;

/// How much darker than the surface a shadow of the head is, as a spread of lightness. In a photo without colour
/// nothing would tell dark hair from it, so there it counts for nothing.
const SHADOW: f32 = 0.025;

/// The colours behind the head.
pub(super) struct Backdrop {
    surface: [[f32; TERMS]; 3],
    spread: Lab,
    log_peak: f32,
    others: Option<Mixture>,
    coloured: bool,
    /// The share of what lies far from the face that the smooth surface explains, 0 to 1.
    pub plain: f64,
}

fn terms(cell: usize) -> [f32; TERMS] {
    let u = (cell % COLUMNS) as f32 / COLUMNS as f32 - 0.5;
    let v = (cell / COLUMNS) as f32 / ROWS as f32 - 0.5;
    [1.0, u, v, u * u, u * v, v * v]
}

impl Backdrop {
    /// Fits the surface to the border of what the photo shows, and then to all beyond the head that it explains:
    /// what of it is hair or clothes does not fit, and falls out.
    pub(crate) fn of(lab: &[Lab], inside: &[bool], shape: &Shape) -> Self {
        let border = border(inside);
        let far = |p: Point| {
            let middle = (shape.brows + shape.chin) / 2.0 - 30.0;
            let (x, y) = (p.x / (1.45 * shape.half_jaw.max(60.0)), (p.y - middle) / 175.0);
            x * x + y * y > 1.0 && p.y < shape.chin + 10.0
        };
        let beyond: Vec<usize> = (0..CELLS)
            .filter(|c| (c % COLUMNS + c / COLUMNS * 2).is_multiple_of(STRIDE) && inside[*c] && far(centre(*c)))
            .collect();
        // Straight above the head high hair may reach the border.
        let seeds: Vec<usize> =
            beyond.iter().copied().filter(|c| border.pixels()[*c] && centre(*c).x.abs() > 100.0).collect();
        let start = if seeds.len() < 40 { beyond.clone() } else { seeds };
        let mut chosen = start.clone();
        let mut surface = [[0.0; TERMS]; 3];
        let mut spread = [0.05, 0.02, 0.02];
        for round in 0..6 {
            surface = fitted(lab, &chosen);
            spread =
                scatter(lab, &chosen, &surface, if round < 2 { [0.03, 0.01, 0.01] } else { [0.008, 0.003, 0.003] });
            let pool = if round < 2 { &start } else { &beyond };
            let fits: Vec<usize> =
                pool.iter().copied().filter(|c| squared(lab[*c], &surface, spread, *c) < 9.0).collect();
            if fits.len() < 40 {
                break;
            }
            chosen = fits;
        }
        let explained = start.iter().filter(|c| squared(lab[**c], &surface, spread, **c) < 12.0).count();
        let plain = explained as f64 / start.len().max(1) as f64;
        let spread: Lab = std::array::from_fn(|k| spread[k].max([0.012, 0.004, 0.004][k]));
        // What of the border the surface leaves over has colours of its own: furniture, a window, other people.
        let left: Vec<(Lab, f32)> =
            start.iter().filter(|c| squared(lab[**c], &surface, spread, **c) >= 12.0).map(|c| (lab[*c], 1.0)).collect();
        let others = (plain < 0.85).then(|| Mixture::of(&left, 4, [0.03, 0.01, 0.01])).flatten();
        let coloured = lab.iter().step_by(7).filter(|c| c[1].hypot(c[2]) > 0.01).count() > lab.len() / 7 / 20;
        let volume: f32 = spread.iter().product();
        Self { surface, spread, log_peak: -2.757 - volume.ln(), others, coloured, plain }
    }

    /// The colour of the surface at a cell.
    pub(crate) fn colour(&self, cell: usize) -> Lab {
        value(&self.surface, cell)
    }

    /// The logarithm of the density of a colour at a cell.
    pub(crate) fn log(&self, lab: Lab, cell: usize) -> f32 {
        let wall = value(&self.surface, cell);
        // The head's shadow on the wall: less light scales all of OKLab alike.
        let scale = (lab[0] / wall[0].max(0.05)).clamp(0.6, 1.0);
        let shadow = if self.coloured { SHADOW.min(0.06 * wall[0]) } else { 0.0 };
        let spread = if scale < 1.0 { self.spread[0].max(shadow) } else { self.spread[0] };
        let [l, a, b] = [lab[0] - wall[0], lab[1] - scale * wall[1], lab[2] - scale * wall[2]];
        let d = (l / spread).powi(2) + (a / self.spread[1]).powi(2) + (b / self.spread[2]).powi(2);
        // Heavier tails than a Gaussian's: walls have spots, shadows and noise.
        let smooth = self.log_peak - (0.5 * d).min(1.5 + 0.25 * d);
        let share = self.plain.clamp(0.05, 0.95) as f32;
        match &self.others {
            Some(others) => (smooth + share.ln()).max(others.log(lab) + (1.0 - share).ln()),
            None => smooth,
        }
    }
}

/// A band of 30 units at the left, upper and right border of what the photo shows.
fn border(inside: &[bool]) -> Mask {
    const BAND: usize = 15;
    let mut mask = no_cells();
    for row in 0..ROWS {
        let cells = &inside[row * COLUMNS..(row + 1) * COLUMNS];
        let (Some(first), Some(last)) = (cells.iter().position(|v| *v), cells.iter().rposition(|v| *v)) else {
            continue;
        };
        let above = row >= BAND && inside[(row - BAND) * COLUMNS + (first + last) / 2];
        for column in first..=last {
            mask[(column, row)] = !above || column < first + BAND || column + BAND > last;
        }
    }
    mask
}

fn value(surface: &[[f32; TERMS]; 3], cell: usize) -> Lab {
    let t = terms(cell);
    surface.map(|s| s.iter().zip(t).map(|(a, b)| a * b).sum())
}

/// The squared distance of a colour from the surface, in spreads.
fn squared(lab: Lab, surface: &[[f32; TERMS]; 3], spread: Lab, cell: usize) -> f32 {
    let is = value(surface, cell);
    (0..3).map(|k| ((lab[k] - is[k]) / spread[k]).powi(2)).sum()
}

/// Least squares of the three channels.
fn fitted(lab: &[Lab], cells: &[usize]) -> [[f32; TERMS]; 3] {
    let mut normal = nalgebra::SMatrix::<f64, TERMS, TERMS>::zeros();
    let mut right = nalgebra::SMatrix::<f64, TERMS, 3>::zeros();
    for cell in cells {
        let t = terms(*cell).map(f64::from);
        for i in 0..TERMS {
            for j in 0..TERMS {
                normal[(i, j)] += t[i] * t[j];
            }
            for k in 0..3 {
                right[(i, k)] += t[i] * f64::from(lab[*cell][k]);
            }
        }
    }
    // With few or crowded cells slopes are not determined; a little weight on flatness settles them.
    for i in 0..TERMS {
        normal[(i, i)] += if i == 0 { 1e-6 } else { 1e-3 * cells.len() as f64 + 1e-6 };
    }
    let Some(solved) = normal.cholesky().map(|c| c.solve(&right)) else { return [[0.0; TERMS]; 3] };
    std::array::from_fn(|k| std::array::from_fn(|i| solved[(i, k)] as f32))
}

/// Robust spreads about the surface: 1.48 times the median of the absolute residuals.
fn scatter(lab: &[Lab], cells: &[usize], surface: &[[f32; TERMS]; 3], least: Lab) -> Lab {
    std::array::from_fn(|k| {
        let mut off: Vec<f32> = cells.iter().map(|c| (lab[*c][k] - value(surface, *c)[k]).abs()).collect();
        if off.is_empty() {
            return least[k];
        }
        let middle = off.len() / 2;
        let (_, median, _) = off.select_nth_unstable_by(middle, f32::total_cmp);
        (1.48 * *median).max(least[k])
    })
}
