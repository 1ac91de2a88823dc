//! A box of a picture.

use crate::geometry::Point;
use crate::photo::Grey;
use crate::photo::{Bounds, Mask};

/// A box of a picture that is looked at.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window<'g> {
    grey: &'g Grey,
    pub bounds: Bounds,
}

impl<'g> Window<'g> {
    /// The pixels between two corners; none where less than half of them are in the picture.
    pub(crate) fn of(grey: &'g Grey, from: Point, to: Point) -> Option<Self> {
        let whole = (to.x - from.x) * (to.y - from.y);
        let bounds = Bounds::between(from, to, grey.width(), grey.height());
        let there = whole.is_finite() && whole >= 4.0 && bounds.area() as f64 >= 0.5 * whole;
        there.then_some(Self { grey, bounds })
    }

    /// Its luma, row by row.
    pub(crate) fn values(&self) -> impl Iterator<Item = f32> + Clone + use<'g> {
        let (b, grey) = (self.bounds, self.grey);
        (b.y0..b.y1).flat_map(move |y| grey.row(y)[b.x0..b.x1].iter().map(|v| f32::from(*v)))
    }

    /// The pixels at most as light as `threshold`, in the window's own columns and rows.
    pub(crate) fn dark(&self, threshold: f32) -> Mask {
        let b = self.bounds;
        self.grey.crop(b.x0..b.x1, b.y0..b.y1).map(|v| f32::from(*v) <= threshold)
    }
}

/// So many standard deviations below the mean; none of no values.
pub(super) fn below(values: &[f32], deviations: f64) -> Option<f32> {
    let n = values.len() as f64;
    let mean = values.iter().map(|v| f64::from(*v)).sum::<f64>() / n;
    let square = values.iter().map(|v| (f64::from(*v) - mean).powi(2)).sum::<f64>() / n;
    (n > 0.0).then(|| (mean - deviations * square.sqrt()) as f32)
}
