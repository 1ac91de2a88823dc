//! How good a photo is to find a face in: blur, noise, exposure, light from the side. No model of a face is needed,
//! only where it is.

use super::edges::sobel;
use super::{Bounds, Photo, Plane};

/// Measures of a photo within a box. What follows from them is for others to say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// How much of the variation between neighbours a further blur would leave (Crete and others 2007): 0 sharp to 1
    /// blurred. It depends on the size: where a face is 200 pixels wide, real portraits in focus measure 0.23 to 0.43,
    /// blurred by a Gaussian of one pixel 0.56 to 0.63, of two 0.73 to 0.79.
    pub blur: f64,
    /// Standard deviation of the noise of luma, in steps of 255 (Immerkær 1996, where there are no edges). 1 from a
    /// studio, 6 from an early digital camera.
    pub noise: f64,
    /// Mean luma, 0 to 255.
    pub mean: f64,
    /// From the 5th to the 95th of a hundred lumas in order, 0 to 255.
    pub contrast: f64,
    /// Share of pixels that are nearly black (luma below 8), 0 to 1.
    pub dark: f64,
    /// Share of pixels with a channel at its end (254 and above), 0 to 1.
    pub clipped: f64,
    /// How much lighter the right half is than the left, −1 to 1: (right − left) / (right + left) of their means.
    /// Frontal light stays within 0.14, light from the side is beyond 0.27.
    pub side: f64,
}

impl Quality {
    /// Measures a photo within a box of its pixels; what of the box lies outside is left out. None where it is
    /// smaller than 16 pixels a side, in which nothing can be told.
    #[must_use]
    pub fn of(photo: &Photo, within: &Bounds) -> Option<Self> {
        let b = within.shared(&Bounds::whole(photo.width(), photo.height()))?;
        if b.width() < 16 || b.height() < 16 {
            return None;
        }
        let cut = photo.crop(b.x0..b.x1, b.y0..b.y1);
        let luma = Plane::luma(&cut);
        let count = luma.pixels().len() as f64;
        let share = |n: usize| n as f64 / count;
        let mut sorted = luma.pixels().to_vec();
        sorted.sort_by(f32::total_cmp);
        let at = |share: f64| f64::from(sorted[(share * (sorted.len() - 1) as f64) as usize]);
        let half = luma.width() / 2;
        let sum = |from: usize, to: usize| luma.rows().flat_map(|r| &r[from..to]).map(|v| f64::from(*v)).sum::<f64>();
        let (left, right) = (sum(0, half), sum(luma.width() - half, luma.width()));
        Some(Self {
            blur: blur(&luma),
            noise: noise(&luma),
            mean: luma.pixels().iter().map(|v| f64::from(*v)).sum::<f64>() / count,
            contrast: at(0.95) - at(0.05),
            dark: share(luma.pixels().iter().filter(|v| **v < 8.0).count()),
            clipped: share(cut.pixels().iter().filter(|p| p.iter().any(|c| *c >= 254)).count()),
            side: if left + right > 0.0 { (right - left) / (right + left) } else { 0.0 },
        })
    }
}

/// Crete, Dolmiere, Ladret and Nicolas (2007): the picture is blurred by a mean over nine pixels, down and across; the
/// share of its variation that this leaves is large where it was blurred before. The worse direction counts. A flat
/// picture is blurred (1).
fn blur(luma: &Plane) -> f64 {
    let along = |step: (isize, isize)| {
        let blurred = |x: isize, y: isize| (-4..=4).map(|k| luma.at(x + k * step.0, y + k * step.1)).sum::<f32>() / 9.0;
        let (mut sharp, mut lost) = (0.0_f64, 0.0_f64);
        for y in step.1..luma.height() as isize {
            for x in step.0..luma.width() as isize {
                let own = (luma.at(x, y) - luma.at(x - step.0, y - step.1)).abs();
                let left = (blurred(x, y) - blurred(x - step.0, y - step.1)).abs();
                sharp += f64::from(own);
                lost += f64::from((own - left).max(0.0));
            }
        }
        if sharp > 0.0 { 1.0 - lost / sharp } else { 1.0 }
    };
    along((1, 0)).max(along((0, 1)))
}

/// Immerkær (1996): what a mask that is blind to planes and slopes finds, over the half of the pixels with the least
/// edges, so that texture is not taken for noise.
fn noise(luma: &Plane) -> f64 {
    let edges = sobel(&luma.blurred(1.0));
    let mut sorted = edges.pixels().to_vec();
    let middle = sorted.len() / 2;
    let limit = *sorted.select_nth_unstable_by(middle, f32::total_cmp).1;
    let (mut sum, mut count) = (0.0_f64, 0.0_f64);
    for y in 1..luma.height() as isize - 1 {
        for x in 1..luma.width() as isize - 1 {
            if edges.at(x, y) <= limit {
                let l = |dx: isize, dy: isize| luma.at(x + dx, y + dy);
                let sides = l(-1, 0) + l(1, 0) + l(0, -1) + l(0, 1);
                let corners = l(-1, -1) + l(1, -1) + l(-1, 1) + l(1, 1);
                sum += f64::from((corners - 2.0 * sides + 4.0 * l(0, 0)).abs());
                count += 1.0;
            }
        }
    }
    // The mask's weights have a root of squares of 6; the mean of |N(0, 1)| is √(2/π).
    if count > 0.0 { (std::f64::consts::PI / 2.0).sqrt() * sum / (6.0 * count) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Smooth waves with noise of a given deviation, from a generator of ours.
    fn noisy(deviation: f64) -> Photo {
        let mut state = 7_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let pixels = (0..160 * 160).map(|i| {
            let (x, y) = (f64::from(i % 160), f64::from(i / 160));
            let normal = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
            let v = 128.0 + 40.0 * (x / 25.0).sin() + 30.0 * (y / 31.0).cos() + deviation * normal;
            [v.round().clamp(0.0, 255.0) as u8; 3]
        });
        Photo::new(160, 160, pixels.collect())
    }

    #[test]
    fn noise_is_measured_as_it_was_added() {
        let of = |deviation: f64| Quality::of(&noisy(deviation), &Bounds::whole(160, 160)).unwrap().noise;
        assert!(of(0.0) < 0.6, "{}", of(0.0));
        for deviation in [3.0, 8.0, 15.0] {
            assert!((of(deviation) / deviation - 1.0).abs() < 0.1, "{deviation}: {}", of(deviation));
        }
    }

    #[test]
    fn blurring_raises_blur_and_light_from_the_right_shows() {
        let checks = |x: usize, y: usize| ((x / 8 + y / 8) % 2) as f32;
        let plane = Plane::new(96, 96, (0..96 * 96).map(|i| 40.0 + 160.0 * checks(i % 96, i / 96)).collect());
        let photo = |plane: &Plane| plane.map(|v| [*v as u8; 3]);
        let whole = Bounds::whole(96, 96);
        let blurs: Vec<f64> =
            [0.0, 1.0, 2.0, 3.0].map(|s| Quality::of(&photo(&plane.blurred(s)), &whole).unwrap().blur).to_vec();
        assert!(blurs.windows(2).all(|w| w[0] < w[1]), "{blurs:?}");

        let ramp = Photo::new(96, 96, (0..96 * 96).map(|i| [(50 + i % 96) as u8; 3]).collect());
        let quality = Quality::of(&ramp, &whole).unwrap();
        assert!((quality.side - 48.0 / 195.0).abs() < 1e-3, "{quality:?}");
        assert!((quality.contrast - 86.0).abs() < 3.0 && quality.dark == 0.0 && quality.clipped == 0.0);
    }

    #[test]
    fn flat_black_white_and_tiny_boxes_do_not_break_it() {
        let flat = |v: u8| Quality::of(&Photo::new(20, 20, vec![[v; 3]; 400]), &Bounds::whole(20, 20)).unwrap();
        assert_eq!((flat(0).dark, flat(0).side, flat(0).blur, flat(0).noise), (1.0, 0.0, 1.0, 0.0));
        assert_eq!(flat(255).clipped, 1.0);
        let photo = Photo::new(20, 20, vec![[9; 3]; 400]);
        assert!(Quality::of(&photo, &Bounds { x0: 10, y0: 10, x1: 40, y1: 40 }).is_none());
        assert!(Quality::of(&photo, &Bounds { x0: 30, y0: 30, x1: 60, y1: 60 }).is_none());
    }
}
