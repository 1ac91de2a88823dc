//! Ridge regression by inner products of the samples, with honest predictions for each sample: made without any
//! photo of its person.

use lianpu::face::find::training::Matrix;
use nalgebra::DMatrix;

/// What was learned, and what it would say of people whom it has not seen.
pub struct Ridge {
    pub weights: Matrix,
    pub bias: Vec<f32>,
    pub honest: DMatrix<f32>,
    pub penalties: Vec<f32>,
}

/// Learns `targets` (a row a sample) from `features` (a row a sample). `folds` says which share of the people a sample
/// belongs to. Of the penalties, in shares of the mean square of a sample, the one with the best honest predictions
/// is taken.
pub fn learn(features: &DMatrix<f32>, targets: &DMatrix<f32>, folds: &[usize], penalties: &[f32]) -> Ridge {
    let n = features.nrows();
    let mean_of = |m: &DMatrix<f32>| m.row_mean();
    let (fm, tm) = (mean_of(features), mean_of(targets));
    let mut f = features.clone();
    f.row_iter_mut().for_each(|mut r| r -= &fm);
    let mut t = targets.clone();
    t.row_iter_mut().for_each(|mut r| r -= &tm);
    let gram = &f * f.transpose();
    let unit = gram.trace() / n as f32;
    let count = folds.iter().max().map_or(1, |m| m + 1);
    let parts: Vec<(Vec<usize>, Vec<usize>)> = (0..count).map(|k| (0..n).partition(|i| folds[*i] != k)).collect();
    let predict = |penalty: f32| {
        let mut honest = DMatrix::zeros(n, t.ncols());
        for (inside, outside) in &parts {
            let mut a = DMatrix::from_fn(inside.len(), inside.len(), |i, j| gram[(inside[i], inside[j])]);
            (0..inside.len()).for_each(|i| a[(i, i)] += penalty * unit);
            let b = t.select_rows(inside);
            let x = solve(a, b);
            let across = DMatrix::from_fn(outside.len(), inside.len(), |i, j| gram[(outside[i], inside[j])]);
            let said = across * x;
            for (row, i) in outside.iter().enumerate() {
                honest.row_mut(*i).copy_from(&said.row(row));
            }
        }
        honest
    };
    // Of each number that is to be said, by itself.
    let mut best: Vec<(f32, f32)> = vec![(f32::INFINITY, 0.0); t.ncols()];
    let mut honest = DMatrix::zeros(n, t.ncols());
    for penalty in penalties {
        let said = predict(*penalty);
        for (column, best) in best.iter_mut().enumerate() {
            let error = (said.column(column) - t.column(column)).norm_squared();
            if error < best.0 {
                *best = (error, *penalty);
                honest.column_mut(column).copy_from(&said.column(column));
            }
        }
    }
    honest.row_iter_mut().for_each(|mut r| r += &tm);
    let mut dual = DMatrix::zeros(n, t.ncols());
    for penalty in penalties {
        let columns: Vec<usize> = (0..best.len()).filter(|c| best[*c].1 == *penalty).collect();
        if columns.is_empty() {
            continue;
        }
        let mut a = gram.clone();
        (0..n).for_each(|i| a[(i, i)] += penalty * unit);
        let solved = solve(a, t.select_columns(&columns));
        for (i, column) in columns.iter().enumerate() {
            dual.column_mut(*column).copy_from(&solved.column(i));
        }
    }
    let weights = f.transpose() * dual;
    let bias = &tm - &fm * &weights;
    let values = (0..weights.ncols()).flat_map(|o| weights.column(o).iter().copied().collect::<Vec<_>>()).collect();
    Ridge {
        weights: Matrix { rows: weights.ncols(), columns: weights.nrows(), values },
        bias: bias.iter().copied().collect(),
        honest,
        penalties: best.iter().map(|b| b.1).collect(),
    }
}

/// Solves `a x = b`, `a` symmetric and positive, by a Cholesky factor made a block of columns at a time.
pub fn solve(mut a: DMatrix<f32>, mut b: DMatrix<f32>) -> DMatrix<f32> {
    const BLOCK: usize = 96;
    let n = a.nrows();
    for from in (0..n).step_by(BLOCK) {
        let size = BLOCK.min(n - from);
        let to = from + size;
        let corner = a.view((from, from), (size, size)).into_owned();
        let factor = corner.cholesky().expect("a penalty keeps it positive").unpack();
        if to < n {
            // L21 = A21 L11^-T
            let below = a.view((to, from), (n - to, size)).transpose();
            let below = factor.solve_lower_triangular(&below).expect("no zero on the diagonal").transpose();
            for c in (to..n).step_by(4 * BLOCK) {
                let w = (4 * BLOCK).min(n - c);
                let rows = below.rows(c - to, n - c);
                let update = rows * below.rows(c - to, w).transpose();
                let mut rest = a.view_mut((c, c), (n - c, w));
                rest -= update;
            }
            a.view_mut((to, from), (n - to, size)).copy_from(&below);
        }
        a.view_mut((from, from), (size, size)).copy_from(&factor);
        let top = factor.solve_lower_triangular(&b.rows(from, size).into_owned()).expect("no zero");
        if to < n {
            let update = a.view((to, from), (n - to, size)) * &top;
            let mut rest = b.rows_mut(to, n - to);
            rest -= update;
        }
        b.rows_mut(from, size).copy_from(&top);
    }
    let mut start = (n - 1) / BLOCK * BLOCK;
    loop {
        let size = BLOCK.min(n - start);
        let to = start + size;
        let mut part = b.rows(start, size).into_owned();
        if to < n {
            part -= a.view((to, start), (n - to, size)).transpose() * b.rows(to, n - to);
        }
        let factor = a.view((start, start), (size, size)).into_owned();
        let part = factor.tr_solve_lower_triangular(&part).expect("no zero");
        b.rows_mut(start, size).copy_from(&part);
        if start == 0 {
            return b;
        }
        start -= BLOCK;
    }
}

/// The main directions of rows: their mean and the first `count` directions, longest first.
pub fn directions(rows: &DMatrix<f32>, count: usize) -> (Vec<f32>, Matrix, Vec<f32>) {
    let mean = rows.row_mean();
    let mut centred = rows.clone();
    centred.row_iter_mut().for_each(|mut r| r -= &mean);
    let covariance = centred.transpose() * &centred / rows.nrows() as f32;
    let eigen = covariance.symmetric_eigen();
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    order.truncate(count);
    let values = order.iter().flat_map(|i| eigen.eigenvectors.column(*i).iter().copied().collect::<Vec<_>>()).collect();
    let lengths = order.iter().map(|i| eigen.eigenvalues[*i].max(0.0)).collect();
    (mean.iter().copied().collect(), Matrix { rows: order.len(), columns: rows.ncols(), values }, lengths)
}
