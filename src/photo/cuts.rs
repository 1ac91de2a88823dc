//! The upright line in the middle of nose and mouth: where both sides are least unlike (thesis sec. 3.4.3).

use super::{Bounds, Plane};

/// How unlike the two sides of an upright line are (eq. 3.15), for each column that was tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Cut {
    /// The column where both sides are least unlike.
    pub x: usize,
    /// The first column that was tried.
    pub first: usize,
    /// D_x of the columns from `first`: absolute differences of intensity, summed over the region's height and half
    /// width.
    pub unlike: Vec<f64>,
}

impl Cut {
    /// Tries the columns within an eighth of the region's width from its middle; half its width w (eq. 3.14) is
    /// compared to each side. Of equal columns the one nearest the middle wins.
    #[must_use]
    pub(crate) fn of(intensity: &Plane, region: &Bounds) -> Self {
        let middle = (region.x0 + region.x1 - 1) / 2;
        // Eq. 3.14: (x − x1)/2 + (x2 − x)/2, the same for every x.
        let half = (region.width() / 2).max(1);
        let shift = region.width() / 8;
        let (first, last) = (middle.saturating_sub(shift), (middle + shift).min(intensity.width() - 1));
        let unlike: Vec<f64> = (first..=last)
            .map(|x| {
                let row = |y: usize| {
                    let at = |x: isize| f64::from(intensity.at(x, y as isize));
                    (1..=half as isize).map(|i| (at(x as isize - i) - at(x as isize + i)).abs()).sum::<f64>()
                };
                (region.y0..region.y1).map(row).sum()
            })
            .collect();
        let least = unlike.iter().enumerate().min_by(|(i, a), (j, b)| {
            let off = |k: usize| (first + k).abs_diff(middle);
            a.total_cmp(b).then(off(*i).cmp(&off(*j)))
        });
        Self { x: least.map_or(middle, |(i, _)| first + i), first, unlike }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_of_a_symmetric_picture_is_found_beside_the_middle_of_the_box() {
        let mut values = Vec::new();
        for y in 0..20_i32 {
            values.extend((0..60_i32).map(|x| ((x - 31).pow(2) + 3 * y) as f32));
        }
        let plane = Plane::new(60, 20, values);
        let cut = Cut::of(&plane, &Bounds { x0: 15, y0: 4, x1: 45, y1: 15 });
        assert_eq!((cut.x, cut.unlike[cut.x - cut.first]), (31, 0.0));
        let flat = Cut::of(&Plane::filled(60, 20, 0.5), &Bounds { x0: 15, y0: 4, x1: 45, y1: 15 });
        assert_eq!(flat.x, 29);
    }
}
