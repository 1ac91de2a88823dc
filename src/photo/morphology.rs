//! Shapes of masks: grown, shrunk, opened and closed by distance.

use super::{Bounds, Mask, Plane};

impl Mask {
    /// Every pixel at most `radius` pixels from a set one; for a negative radius every pixel farther than that from all
    /// that are not set. Beyond the border nothing is set or unset.
    #[must_use]
    pub(crate) fn grown(&self, radius: f64) -> Self {
        let mut out = Self::filled(self.width(), self.height(), false);
        let grows = radius >= 0.0;
        let margin = if grows { radius.ceil() as usize } else { 1 };
        let Some(window) = self.window(margin) else { return out };
        let distances = distances_within(&window, |x, y| self[(x, y)] == grows);
        let reach = (radius * radius) as f32;
        for ((x, y), near) in window.pixels().zip(distances) {
            out[(x, y)] = if grows { near <= reach } else { near > reach };
        }
        out
    }

    /// Without all parts narrower than twice `radius` pixels.
    #[must_use]
    pub(crate) fn opened(&self, radius: f64) -> Self {
        self.grown(-radius).grown(radius)
    }

    /// With all gaps filled that are narrower than twice `radius` pixels. Beyond the border nothing is known, so the
    /// border is no gap.
    #[must_use]
    pub(crate) fn closed(&self, radius: f64) -> Self {
        self.grown(radius).grown(-radius).or(self)
    }

    /// The squared distance of every pixel to the nearest set one, in pixels; infinite where none is set.
    #[must_use]
    pub(crate) fn squared_distances(&self) -> Plane {
        let (width, height) = (self.width(), self.height());
        let all = Bounds::whole(width, height);
        Plane::new(width, height, distances_within(&all, |x, y| self[(x, y)]))
    }

    /// The box of the set pixels, and `margin` more on every side; none where none is set.
    fn window(&self, margin: usize) -> Option<Bounds> {
        let first = self.pixels().iter().position(|v| *v)? / self.width();
        let last = self.pixels().iter().rposition(|v| *v)? / self.width();
        let (mut left, mut right) = (self.width(), 0);
        for row in (first..=last).map(|y| self.row(y)) {
            if let (Some(l), Some(r)) = (row.iter().position(|v| *v), row.iter().rposition(|v| *v)) {
                left = left.min(l);
                right = right.max(r);
            }
        }
        Some(Bounds {
            x0: left.saturating_sub(margin),
            y0: first.saturating_sub(margin),
            x1: (right + 1 + margin).min(self.width()),
            y1: (last + 1 + margin).min(self.height()),
        })
    }
}

/// The squared distances of a box's pixels to the nearest of them for which `test` holds (Felzenszwalb and
/// Huttenlocher 2012, lower envelopes of parabolas), row by row.
fn distances_within(window: &Bounds, test: impl Fn(usize, usize) -> bool) -> Vec<f32> {
    // Larger than any squared distance in a picture of 20,000 pixels a side, small enough that adding to it loses nothing.
    const FAR: f32 = 1e9;
    let (wide, tall) = (window.width(), window.height());
    let mut field: Vec<f32> = window.pixels().map(|(x, y)| if test(x, y) { 0.0 } else { FAR }).collect();
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

#[cfg(test)]
mod tests {
    use super::*;

    fn of(width: usize, height: usize, test: impl Fn(usize, usize) -> bool) -> Mask {
        Mask::new(width, height, (0..width * height).map(|i| test(i % width, i / width)).collect())
    }

    #[test]
    fn distances_are_those_of_a_search_over_all_pixels() {
        let set = [(7, 5), (100, 200), (3, 280)];
        let found = of(230, 290, |x, y| set.contains(&(x, y))).squared_distances();
        for i in (0..230 * 290).step_by(97) {
            let (x, y) = (i % 230, i / 230);
            let nearest = set.map(|(u, v)| u.abs_diff(x).pow(2) + v.abs_diff(y).pow(2)).into_iter().min().unwrap();
            assert!((nearest as f32 - found[(x, y)]).abs() < 0.5, "{x} {y}");
        }
        assert!(of(9, 9, |_, _| false).squared_distances().pixels().iter().all(|d| d.is_infinite()));
    }

    #[test]
    fn opening_takes_strips_away_and_closing_fills_gaps() {
        let within = |columns: std::ops::Range<usize>, rows: std::ops::Range<usize>| {
            of(230, 290, |x, y| columns.contains(&x) && rows.contains(&y))
        };
        let (wide, strip) = (within(50..90, 50..90), within(90..150, 60..63));
        let opened = wide.or(&strip).opened(4.0);
        assert!(opened.and(&strip).count() < 20);
        assert!(wide.without(&opened).count() < 60);
        let slit = within(68..71, 50..90);
        assert!(slit.without(&wide.without(&slit).closed(3.0)).count() < 10);
    }
}
