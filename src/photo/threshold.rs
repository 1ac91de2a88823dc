//! Thresholds: light and dark by intensity, face and background by hue (thesis sec. 3.3.1 to 3.3.4), and the one that
//! keeps a picture's moments (Tsai 1985).

use super::hsi::hue_distance;
use super::{Bounds, Mask, Plane};

/// The first level of the hierarchy: light against dark (thesis sec. 3.3.2).
#[derive(Debug, Clone, PartialEq)]
pub struct LightDark {
    /// m₁, mean intensity in the central rectangle (eq. 3.1).
    pub mean: f64,
    /// s₁, standard deviation there (eq. 3.2).
    pub deviation: f64,
    /// t₁ = m₁ − s₁ (eq. 3.3).
    pub threshold: f64,
    /// B₁, set where it is light (eq. 3.4).
    pub light: Mask,
}

/// The second level: face against background (thesis sec. 3.3.4).
#[derive(Debug, Clone, PartialEq)]
pub struct FaceGround {
    /// m₂, mean hue in the central rectangle (eq. 3.6).
    pub mean: f64,
    /// s₂, standard deviation there (eq. 3.7).
    pub deviation: f64,
    /// B₂, set where it is not face (eq. 3.9).
    pub ground: Mask,
}

/// The mean of a plane within a box and its standard deviation over n − 1; the deviation of one pixel is 0.
#[must_use]
pub(crate) fn mean_deviation(plane: &Plane, within: &Bounds) -> (f64, f64) {
    let rows = || (within.y0..within.y1).map(|y| &plane.row(y)[within.x0..within.x1]);
    let count = within.area() as f64;
    let mean = rows().flatten().map(|v| f64::from(*v)).sum::<f64>() / count;
    let squares = rows().flatten().map(|v| (f64::from(*v) - mean).powi(2)).sum::<f64>();
    (mean, (squares / (count - 1.0).max(1.0)).sqrt())
}

impl LightDark {
    /// Splits intensity at one deviation below the mean of the central rectangle (thesis eqs. 3.1 to 3.4).
    #[must_use]
    pub(crate) fn of(intensity: &Plane, central: &Bounds) -> Self {
        let (mean, deviation) = mean_deviation(intensity, central);
        let threshold = mean - deviation;
        Self { mean, deviation, threshold, light: intensity.map(|v| f64::from(*v) > threshold) }
    }
}

impl FaceGround {
    /// Keeps as face what is light and whose hue is within one deviation of the central rectangle's (thesis eqs. 3.6
    /// to 3.9). Dark pixels of that hue, for which eq. 3.9 has no case, are not face.
    #[must_use]
    pub(crate) fn of(hue: &Plane, light: &Mask, central: &Bounds) -> Self {
        let (mean, deviation) = mean_deviation(hue, central);
        let far = hue.map(|v| hue_distance(*v, mean as f32) > deviation as f32);
        Self { mean, deviation, ground: far.with(light, |far, light| *far || !light) }
    }
}

/// The threshold that keeps the first three moments when every value becomes one of two (Tsai 1985). None where all
/// values are equal, or there are none.
///
/// Values must be 0 or more; they are counted in 1024 steps up to the largest.
#[must_use]
pub(crate) fn moment_preserving(values: impl Iterator<Item = f32> + Clone) -> Option<f32> {
    const STEPS: usize = 1024;
    let largest = values.clone().fold(0.0_f32, f32::max);
    if largest <= 0.0 || !largest.is_finite() {
        return None;
    }
    let mut counts = [0_u32; STEPS];
    let scale = STEPS as f32 / largest;
    values.for_each(|v| counts[((v * scale) as usize).min(STEPS - 1)] += 1);
    let total = f64::from(counts.iter().sum::<u32>());
    let moment = |power: i32| {
        let level = |i: usize| ((i as f64 + 0.5) / STEPS as f64).powi(power);
        counts.iter().enumerate().map(|(i, n)| level(i) * f64::from(*n)).sum::<f64>() / total
    };
    let (m1, m2, m3) = (moment(1), moment(2), moment(3));
    let spread = m2 - m1 * m1;
    if spread < 1e-12 {
        return None;
    }
    // The two values are the roots of z² + c1 z + c0.
    let (c0, c1) = ((m1 * m3 - m2 * m2) / spread, (m1 * m2 - m3) / spread);
    let root = (c1 * c1 - 4.0 * c0).max(0.0).sqrt();
    let (low, high) = ((-c1 - root) / 2.0, (-c1 + root) / 2.0);
    if high - low < 1e-12 {
        return None;
    }
    let below = (high - m1) / (high - low) * total;
    let mut seen = 0.0;
    let step = counts.iter().position(|n| {
        seen += f64::from(*n);
        seen >= below
    });
    step.map(|i| (i + 1) as f32 / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_levels_are_told_apart_and_one_has_no_threshold() {
        let two = [0.1_f32, 0.1, 0.1, 0.9].into_iter();
        let t = moment_preserving(two).unwrap();
        assert!((0.1..0.9).contains(&t), "{t}");
        assert_eq!(moment_preserving([0.4_f32; 9].into_iter()), None);
        assert_eq!(moment_preserving(std::iter::empty()), None);
    }

    #[test]
    fn both_sides_keep_the_mean() {
        // Skewed noise: a share p0 below the threshold, so that p0 z0 + p1 z1 is the mean.
        let values: Vec<f32> = (0..5000).map(|i| ((i as f32 * 0.618).fract()).powi(4)).collect();
        let t = moment_preserving(values.iter().copied()).unwrap();
        let below = values.iter().filter(|v| **v <= t).count() as f64 / 5000.0;
        // The moments of x⁴ on [0, 1] are 1/5, 1/9 and 1/13, which put 0.785 below.
        assert!((below - 0.785).abs() < 0.01, "{below}");
    }

    #[test]
    fn a_dark_pixel_of_the_faces_hue_is_not_face() {
        let hue = Plane::new(4, 1, vec![10.0, 12.0, 11.0, 90.0]);
        let light = Mask::new(4, 1, vec![true, true, false, true]);
        let split = FaceGround::of(&hue, &light, &Bounds { x0: 0, y0: 0, x1: 3, y1: 1 });
        assert_eq!((split.mean, split.deviation), (11.0, 1.0));
        assert_eq!(split.ground.pixels(), [false, false, true, true]);
    }
}
