//! Colour as hue, saturation and intensity (thesis sec. 3.3, fig. 3.4).

use super::{Photo, Plane};

/// A photo's three channels of HSI.
#[derive(Debug, Clone, PartialEq)]
pub struct Hsi {
    /// Hue in 256 whole steps round the circle, −127 to 128: red 0, green 85, blue −85. Skin lies near 0 and so never
    /// at the seam. Greys have no hue and are given red's (0).
    pub hue: Plane,
    /// Saturation, 0 grey to 1.
    pub saturation: Plane,
    /// Intensity, the mean of the three channels, 0 black to 1 white.
    pub intensity: Plane,
}

impl Hsi {
    /// The channels of a photo.
    #[must_use]
    pub(crate) fn of(photo: &Photo) -> Self {
        let plane = |of: &dyn Fn([u8; 3]) -> f32| photo.map(|p| of(*p));
        let sum = |p: [u8; 3]| f32::from(u16::from(p[0]) + u16::from(p[1]) + u16::from(p[2]));
        Self {
            hue: plane(&hue),
            saturation: plane(&|p| {
                let least = f32::from(p[0].min(p[1]).min(p[2]));
                if sum(p) > 0.0 { 1.0 - 3.0 * least / sum(p) } else { 0.0 }
            }),
            intensity: plane(&|p| sum(p) / 765.0),
        }
    }
}

/// The hue of a pixel; see [`Hsi::hue`].
#[must_use]
pub fn hue([r, g, b]: [u8; 3]) -> f32 {
    let [r, g, b] = [r, g, b].map(f32::from);
    // The angle round the axis of greys, the same as the arc cosine that is usually printed but steady near red.
    let angle = (3.0_f32.sqrt() * (g - b)).atan2(2.0 * r - g - b);
    let steps = (angle * (128.0 / std::f32::consts::PI)).round();
    if steps <= -128.0 { 128.0 } else { steps }
}

/// How far two hues are apart on the circle, 0 to 128 (thesis eq. 3.8).
#[must_use]
pub fn hue_distance(a: f32, b: f32) -> f32 {
    let apart = (a - b).abs().rem_euclid(256.0);
    apart.min(256.0 - apart)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hues_go_round_the_circle_with_red_in_the_middle_and_skin_beside_it() {
        let of = |r, g, b| hue([r, g, b]);
        assert_eq!([of(255, 0, 0), of(0, 255, 0), of(0, 0, 255), of(0, 255, 255)], [0.0, 85.0, -85.0, 128.0]);
        assert_eq!([of(7, 7, 7), of(0, 0, 0), of(255, 255, 255)], [0.0; 3]);
        assert!((5.0..25.0).contains(&of(224, 172, 140)));
        assert_eq!(hue_distance(-127.0, 128.0), 1.0);
        assert_eq!(hue_distance(10.0, -30.0), 40.0);
    }

    #[test]
    fn saturation_and_intensity_keep_their_ranges() {
        let hsi = Hsi::of(&Photo::new(4, 1, vec![[0; 3], [255; 3], [255, 0, 0], [128, 64, 64]]));
        assert_eq!(hsi.saturation.pixels(), [0.0, 0.0, 1.0, 0.25]);
        assert_eq!(hsi.intensity.pixels()[1], 1.0);
        assert!((hsi.intensity.pixels()[2] - 1.0 / 3.0).abs() < 1e-6);
    }
}
