//! OKLab and OKLCH (Ottosson 2020): a space in which lightness, colourfulness and hue are what an eye sees as such.

use super::Colour;

/// A colour as OKLab has it: lightness 0 to 1, green to red, blue to yellow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Oklab {
    /// Lightness, 0 black to 1 white.
    pub l: f64,
    /// Green (negative) to red.
    pub a: f64,
    /// Blue (negative) to yellow.
    pub b: f64,
}

/// The same in polar form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Oklch {
    /// Lightness, 0 black to 1 white.
    pub l: f64,
    /// Chroma: 0 grey; the colours of skin lie near 0.06.
    pub c: f64,
    /// Hue in degrees, 0 to 360; red is near 29, yellow near 110.
    pub h: f64,
}

impl From<Colour> for Oklab {
    fn from(colour: Colour) -> Self {
        let [r, g, b] = [colour.r, colour.g, colour.b].map(|v| linear(f64::from(v) / 255.0));
        let l = (0.412_221_470_8 * r + 0.536_332_536_3 * g + 0.051_445_992_9 * b).cbrt();
        let m = (0.211_903_498_2 * r + 0.680_699_545_1 * g + 0.107_396_956_6 * b).cbrt();
        let s = (0.088_302_461_9 * r + 0.281_718_837_6 * g + 0.629_978_700_5 * b).cbrt();
        Self {
            l: 0.210_454_255_3 * l + 0.793_617_785 * m - 0.004_072_046_8 * s,
            a: 1.977_998_495_1 * l - 2.428_592_205 * m + 0.450_593_709_9 * s,
            b: 0.025_904_037_1 * l + 0.782_771_766_2 * m - 0.808_675_766 * s,
        }
    }
}

impl Oklab {
    /// Linear sRGB; outside 0 to 1 where the screen cannot show the colour.
    fn linear_rgb(self) -> [f64; 3] {
        let l = (self.l + 0.396_337_777_4 * self.a + 0.215_803_757_3 * self.b).powi(3);
        let m = (self.l - 0.105_561_345_8 * self.a - 0.063_854_172_8 * self.b).powi(3);
        let s = (self.l - 0.089_484_177_5 * self.a - 1.291_485_548 * self.b).powi(3);
        [
            4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
            -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
            -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701 * s,
        ]
    }
}

impl From<Oklab> for Oklch {
    fn from(lab: Oklab) -> Self {
        Self { l: lab.l, c: lab.a.hypot(lab.b), h: lab.b.atan2(lab.a).to_degrees().rem_euclid(360.0) }
    }
}

impl From<Oklch> for Oklab {
    fn from(lch: Oklch) -> Self {
        let (sin, cos) = lch.h.to_radians().sin_cos();
        Self { l: lch.l, a: lch.c * cos, b: lch.c * sin }
    }
}

impl From<Colour> for Oklch {
    fn from(colour: Colour) -> Self {
        Oklab::from(colour).into()
    }
}

impl Oklch {
    /// From lightness, chroma and hue in degrees.
    #[must_use]
    pub(crate) const fn new(l: f64, c: f64, h: f64) -> Self {
        Self { l, c, h }
    }

    /// The nearest colour of this lightness and hue that a screen can show: chroma gives way.
    #[must_use]
    pub(crate) fn colour(self) -> Colour {
        let l = self.l.clamp(0.0, 1.0);
        let mut c = self.c.max(0.0);
        let mut rgb = Oklab::from(Self { l, c, h: self.h }).linear_rgb();
        // A few steps of 8 % end inside the screen's colours for all that occur here, and 40 for any.
        for _ in 0..40 {
            if rgb.iter().all(|v| (-0.001..=1.001).contains(v)) {
                break;
            }
            c *= 0.92;
            rgb = Oklab::from(Self { l, c, h: self.h }).linear_rgb();
        }
        let [r, g, b] = rgb.map(|v| (encoded(v.clamp(0.0, 1.0)) * 255.0).round() as u8);
        Colour::rgb(r, g, b)
    }
}

impl From<Oklab> for Colour {
    fn from(lab: Oklab) -> Self {
        Oklch::from(lab).colour()
    }
}

/// The sRGB curve undone.
fn linear(v: f64) -> f64 {
    if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// The sRGB curve.
fn encoded(v: f64) -> f64 {
    if v <= 0.003_130_8 { v * 12.92 } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_colour_of_the_screen_comes_back_through_oklch() {
        for r in (0..=255).step_by(15) {
            for g in (0..=255).step_by(15) {
                for b in (0..=255).step_by(15) {
                    let colour = Colour::rgb(r, g, b);
                    let back = Oklch::from(colour).colour();
                    let off = |x: u8, y: u8| x.abs_diff(y);
                    assert!(off(back.r, r).max(off(back.g, g)).max(off(back.b, b)) <= 1, "{colour} became {back}");
                }
            }
        }
    }
}
