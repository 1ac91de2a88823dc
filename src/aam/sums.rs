//! Sums of products over all pixels, in a fixed order.

/// Sums run in so many lanes, which are added up in the end.
pub(super) const LANES: usize = 8;
/// So many rows are summed at a time.
const ROWS: usize = 4;

/// The product of each row of a matrix with a reading. Rows are as long as the reading, which is a multiple of
/// [`LANES`].
pub(super) fn products(matrix: &[f32], reading: &[f32], out: &mut [f32]) {
    let n = reading.len();
    let (reading, _) = reading.as_chunks::<LANES>();
    let mut four = matrix.chunks_exact(ROWS * n.max(1));
    let mut outs = out.chunks_exact_mut(ROWS);
    for (rows, out) in (&mut four).zip(&mut outs) {
        let (a, rest) = rows.split_at(n);
        let (b, rest) = rest.split_at(n);
        let (c, d) = rest.split_at(n);
        let [a, b, c, d] = [a, b, c, d].map(|r| r.as_chunks::<LANES>().0);
        let mut sums = [[0.0_f32; LANES]; ROWS];
        for ((((v, a), b), c), d) in reading.iter().zip(a).zip(b).zip(c).zip(d) {
            for l in 0..LANES {
                sums[0][l] += v[l] * a[l];
                sums[1][l] += v[l] * b[l];
                sums[2][l] += v[l] * c[l];
                sums[3][l] += v[l] * d[l];
            }
        }
        for (out, sums) in out.iter_mut().zip(&sums) {
            *out = total(sums);
        }
    }
    for (row, out) in four.remainder().chunks_exact(n.max(1)).zip(outs.into_remainder()) {
        let mut sums = [0.0_f32; LANES];
        for (v, a) in reading.iter().zip(row.as_chunks::<LANES>().0) {
            for l in 0..LANES {
                sums[l] += v[l] * a[l];
            }
        }
        *out = total(&sums);
    }
}

/// The sum of squares of a reading.
pub(super) fn square(reading: &[f32]) -> f32 {
    let mut sums = [0.0_f32; LANES];
    for v in reading.as_chunks::<LANES>().0 {
        for l in 0..LANES {
            sums[l] += v[l] * v[l];
        }
    }
    total(&sums)
}

fn total(s: &[f32; LANES]) -> f32 {
    ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_summed_whatever_their_number() {
        let reading: Vec<f32> = (0..16).map(|i| i as f32 - 3.0).collect();
        for rows in 1..10 {
            let matrix: Vec<f32> = (0..rows * 16).map(|i| ((i * 7) % 5) as f32).collect();
            let mut out = vec![0.0; rows];
            products(&matrix, &reading, &mut out);
            for (r, v) in out.iter().enumerate() {
                let expected: f32 = (0..16).map(|i| matrix[r * 16 + i] * reading[i]).sum();
                assert!((v - expected).abs() < 1e-3);
            }
        }
        assert_eq!(square(&reading), reading.iter().map(|v| v * v).sum::<f32>());
    }
}
