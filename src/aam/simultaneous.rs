//! The fit of shape and look at once (fast simultaneous inverse compositional, Tzimiropoulos and Pantic 2013): the steepest
//! descent images are made anew at every step, from the look that the picture shows just now instead of from the mean.
//! That costs a hundred times as much as projecting out, and is what fits people whom a model has not seen.

use nalgebra::{DMatrix, DVector};

use super::level::Level;
use super::sums::{products, square};

/// How far a shape may be from the mean before the picture must speak louder: the residuals of neighbouring pixels go
/// together, so that there are this many times fewer than they seem.
const ALIKE: f32 = 200.0;

/// How far to move along a level's directions; false where the picture says nothing. `along` is where the shape is along
/// the modes, `deviations` how far that usually is, both in widths.
pub(super) fn step(level: &Level, reading: &[f32], along: &[f32], deviations: &[f32], out: &mut [f32]) -> bool {
    let n = level.directions.len();
    let len = level.len();
    let pixels = level.table.len();
    let looks = level.look_count();
    let mut held = vec![0.0; looks];
    products(&level.looks, reading, &mut held);
    let mut slopes = [vec![0.0_f32; len], vec![0.0_f32; len]];
    for (by, [x, y]) in held[1..].iter().zip(&level.slopes.looks) {
        slopes[0].iter_mut().zip(x).for_each(|(s, v)| *s += by * v);
        slopes[1].iter_mut().zip(y).for_each(|(s, v)| *s += by * v);
    }
    let mut images = vec![0.0_f32; n * len];
    for (image, [wx, wy]) in images.chunks_exact_mut(len).zip(&level.slopes.warps) {
        for (channel, image) in image.chunks_exact_mut(pixels).enumerate() {
            let span = channel * pixels..(channel + 1) * pixels;
            let (gx, gy) = (&slopes[0][span.clone()], &slopes[1][span]);
            for ((((o, gx), gy), wx), wy) in image.iter_mut().zip(gx).zip(gy).zip(wx).zip(wy) {
                *o = gx * wx + gy * wy;
            }
        }
    }
    let mut in_looks = DMatrix::<f64>::zeros(looks, n);
    let mut hessian = DMatrix::<f64>::zeros(n, n);
    let mut pull = DVector::<f64>::zeros(n);
    let mut sums = vec![0.0; looks.max(n)];
    for (k, image) in images.chunks_exact(len).enumerate() {
        products(&level.looks, image, &mut sums[..looks]);
        (0..looks).for_each(|i| in_looks[(i, k)] = f64::from(sums[i]));
        products(&images, image, &mut sums[..n]);
        (0..n).for_each(|i| hessian[(i, k)] = f64::from(sums[i]));
    }
    products(&images, reading, &mut sums[..n]);
    (0..n).for_each(|k| pull[k] = f64::from(sums[k]));
    hessian -= in_looks.transpose() * &in_looks;
    pull -= in_looks.transpose() * DVector::from_iterator(looks, held.iter().map(|v| f64::from(*v)));
    // The usual shape, as strong as the noise says.
    let left = (square(reading) - held.iter().map(|v| v * v).sum::<f32>()).max(0.0) / len as f32;
    for (k, (p, sd)) in along.iter().zip(deviations).enumerate().take(n - 4) {
        let sd = f64::from((sd * level.width).max(1e-6));
        let weight = f64::from(ALIKE * left) / (sd * sd);
        hessian[(4 + k, 4 + k)] += weight;
        pull[4 + k] += weight * f64::from(p * level.width);
    }
    let slight = 1e-9 * hessian.trace().max(1e-12) / n as f64;
    (0..n).for_each(|k| hessian[(k, k)] += slight);
    let Some(solved) = hessian.cholesky() else { return false };
    let moved = solved.solve(&pull);
    out.iter_mut().zip(moved.iter()).for_each(|(o, v)| *o = *v as f32);
    out[..n].iter().all(|v| v.is_finite())
}
