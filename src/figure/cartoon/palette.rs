//! The colours of a cartoon: what was measured in the photo, carried over in OKLCH into colours that look drawn.
//!
//! A photo's skin taken as it is looks grey, brightened without holding its hue it looks pink; so lightness is
//! stretched, chroma raised and hue drawn toward a warm middle. Every shade is a step from the skin it lies on.

use serde::Deserialize;

use crate::drawing::{Colour, Oklch};
use crate::face::Colours;

macro_rules! palette {
    ($($name:ident $what:literal;)*) => {
        /// Every colour that a cartoon is drawn with.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub(crate) struct Palette {
            $(#[doc = concat!($what, ".")] pub $name: Colour,)*
        }

        /// Colours that an author has chosen herself. Where a colour has shades, they follow it unless chosen too.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
        #[serde(deny_unknown_fields, default)]
        pub(crate) struct Chosen {
            $(#[doc = concat!($what, ".")] pub $name: Option<Colour>,)*
        }

        impl Palette {
            /// The same with what an author has chosen.
            fn with(mut self, chosen: &Chosen) -> Self {
                $(if let Some(colour) = chosen.$name { self.$name = colour; })*
                self
            }

            /// One colour for everything.
            const fn plain(colour: Colour) -> Self {
                Self { $($name: colour,)* }
            }
        }
    };
}

palette! {
    skin "Skin in the light";
    shade "Skin away from the light";
    deep "Skin in a shadow, such as the chin's on the neck";
    under_chin "The darkest of that shadow";
    light "Skin that shines: the bridge of the nose";
    blush "Cheeks";
    line "Thin ink on skin";
    ink "Strong ink: lids, nostrils";
    hair "Hair";
    hair_shade "Hair away from the light, and behind the head";
    hair_light "Hair that shines";
    hair_ink "The outline of hair";
    strand "Single strands of hair";
    hair_tint "Shaved hair, under which skin shows";
    lip "The lower lip";
    lip_upper "The upper lip, away from the light";
    lip_light "Where the lower lip shines";
    lip_line "The line between the lips";
    brow "Brows";
    iris "The ring round the pupil";
    iris_light "Its lower part, which the light reaches";
    iris_ring "Its rim";
    pupil "Pupils";
    sclera "The white of the eyes";
    sclera_shade "The white of the eyes under the lid";
    mouth "The inside of the mouth";
    teeth "Teeth";
    tongue "The tongue";
    tongue_shade "Its middle";
    beard "A beard, before it is thinned";
    shirt "The shirt";
    shirt_light "The band round its neck";
    shirt_shade "Under the band";
    ground "What lies behind everything";
    disc "The disc behind the head";
    frame "Frames of glasses";
}

/// Below this lightness of drawn skin lips, blush and lines take other steps: what darkens light skin is lost on dark.
const DARK: f64 = 0.6;

impl Palette {
    /// The colours of a drawing in colour. `shirt` is a hue in degrees; ground and disc are chosen to suit it.
    #[must_use]
    pub(crate) fn of(measured: &Colours, shirt: f64, chosen: &Chosen) -> Self {
        let photo = signed(measured.skin);
        let skin = chosen.skin.map_or_else(|| drawn_skin(photo), signed);
        let dark = skin.l < DARK;
        let on_skin = |l: f64, c: f64, h: f64| Oklch::new(skin.l + l, (skin.c + c).max(0.0), skin.h + h).colour();
        let mut p = Self::plain(Colour::BLACK);

        p.skin = skin.colour();
        // On very dark skin full steps would run into the ink.
        let step = (skin.l / DARK).min(1.0);
        p.shade = on_skin(-0.075 * step, 0.018, -6.0);
        p.deep = on_skin(-0.15 * step, 0.03, -9.0);
        p.under_chin = on_skin(-0.109 * step, 0.0235, -7.3);
        p.light = Oklch::new((skin.l + if dark { 0.075 } else { 0.05 }).min(0.97), skin.c * 0.8, skin.h + 4.0).colour();
        p.blush = on_skin(-0.04, if dark { 0.03 } else { 0.05 }, -24.0);
        p.ink = Oklch::new((0.42 * skin.l - 0.10).max(0.14), (0.75 * skin.c).min(0.06), skin.h - 14.0).colour();
        p.line =
            Oklch::new((0.60 - 0.12 * (1.0 - step)) * skin.l, skin.c + if dark { 0.0 } else { 0.028 }, skin.h - 12.0)
                .colour();

        let hair = chosen.hair.map_or_else(|| drawn_hair(signed(measured.hair)), signed);
        let fair = hair.l > 0.63;
        let of_hair = |l: f64, c: f64, h: f64| Oklch::new(l, hair.c * c, hair.h + h).colour();
        p.hair = hair.colour();
        p.hair_shade = of_hair(hair.l - if fair { 0.085 } else { 0.055 }, 1.05, -6.0);
        // Dark hair shines more against itself.
        p.hair_light = of_hair(hair.l + if hair.l < 0.33 { 0.105 } else { 0.085 }, 1.05, 2.0);
        p.hair_ink = of_hair((0.55 * hair.l).max(0.13), 0.9, -8.0);
        // On dark hair a darker strand cannot be seen.
        p.strand = if hair.l < 0.33 { p.hair_light } else { p.hair_shade };
        p.hair_tint = Oklch::new(skin.l - 0.20, 0.55 * skin.c, skin.h).colour();

        let lip = chosen.lip.map_or_else(|| drawn_lip(signed(measured.lips), photo, skin), signed);
        p.lip = lip.colour();
        p.lip_upper = Oklch::new(lip.l - if dark { 0.075 } else { 0.055 }, lip.c + 0.004, lip.h - 1.0).colour();
        p.lip_light = Oklch::new(lip.l + 0.09, 0.85 * lip.c, lip.h + 3.0).colour();
        p.lip_line = Oklch::new((lip.l - 0.30).max(0.2), lip.c.min(0.075), lip.h).colour();

        let brow = signed(measured.brows);
        let warm = if (15.0..110.0).contains(&brow.h) { brow.h } else { 50.0 };
        let lightness = (0.8 * brow.l + 0.2 * hair.l).min(skin.l - 0.2).clamp(0.2, 0.55);
        p.brow = Oklch::new(lightness, (1.2 * brow.c).clamp(0.01, 0.06), warm).colour();

        let iris = chosen.iris.map_or_else(|| drawn_iris(signed(measured.iris)), signed);
        p.iris = iris.colour();
        p.iris_light = Oklch::new(iris.l + 0.14, 1.15 * iris.c, iris.h).colour();
        p.iris_ring = Oklch::new((iris.l - 0.2).max(0.16), 0.8 * iris.c, iris.h).colour();
        p.pupil = Colour::rgb(0x17, 0x11, 0x0f);
        p.sclera = Oklch::new(if dark { 0.94 } else { 0.965 }, 0.006, 80.0).colour();
        p.sclera_shade = Oklch::new(0.83, 0.014, if skin.l > 0.5 { 60.0 } else { 50.0 }).colour();

        p.mouth = Oklch::new(0.25, 0.07, 18.0).colour();
        p.teeth = Oklch::new(0.965, 0.008, 85.0).colour();
        p.tongue = Oklch::new(0.60, 0.12, 20.0).colour();
        p.tongue_shade = Oklch::new(0.48, 0.11, 18.0).colour();
        let beard = signed(measured.beard);
        p.beard = Oklch::new((0.78 * beard.l).min(skin.l - 0.24).max(0.17), 0.028, 50.0).colour();

        let cloth = chosen.shirt.map_or(Oklch::new(0.60, 0.085, shirt), Oklch::from);
        p.shirt = cloth.colour();
        p.shirt_light = Oklch::new(cloth.l + 0.08, 0.94 * cloth.c, cloth.h).colour();
        p.shirt_shade = Oklch::new(cloth.l - 0.08, cloth.c, cloth.h - 4.0).colour();
        p.ground = Oklch::new(0.93, 0.028, shirt + 25.0).colour();
        p.disc = Oklch::new(0.885, 0.042, shirt + 25.0).colour();
        p.frame = Oklch::new(0.27, 0.02, 40.0).colour();
        p.with(chosen)
    }

    /// The colours of a drawing in ink alone: paper and one ink, and nothing for what only shades.
    #[must_use]
    pub(crate) fn of_ink(chosen: &Chosen) -> Self {
        let ink = chosen.ink.unwrap_or(Colour::rgb(0x26, 0x20, 0x1d));
        let paper = chosen.ground.unwrap_or(Colour::WHITE);
        let mut p = Self::plain(Colour { a: 0, ..paper });
        for inked in [
            &mut p.line,
            &mut p.ink,
            &mut p.hair_ink,
            &mut p.strand,
            &mut p.lip_line,
            &mut p.brow,
            &mut p.pupil,
            &mut p.mouth,
            &mut p.beard,
            &mut p.iris_ring,
            &mut p.frame,
        ] {
            *inked = ink;
        }
        for blank in [&mut p.skin, &mut p.hair, &mut p.sclera, &mut p.teeth, &mut p.iris, &mut p.tongue, &mut p.shirt] {
            *blank = paper;
        }
        (p.ground, p.disc, p.hair_shade) = (paper, paper, paper);
        p.with(chosen)
    }
}

/// A colour with its hue from -180 to 180, so that reds lie beside each other.
fn signed(colour: Colour) -> Oklch {
    let lch = Oklch::from(colour);
    Oklch { h: if lch.h < 180.0 { lch.h } else { lch.h - 360.0 }, ..lch }
}

/// Skin of a photo as skin of a drawing: measured 0.30 to 0.80 becomes 0.31 to 0.875 in lightness.
fn drawn_skin(photo: Oklch) -> Oklch {
    let l = (0.31 + 0.605 * (photo.l - 0.30) / 0.5).clamp(0.31, 0.875);
    let c = (1.3 * photo.c).clamp(0.05, 0.10);
    let c = if l < DARK { c.clamp(0.06, 0.085) } else { c };
    Oklch::new(l, c, (54.0 + 0.6 * (photo.h - 42.0)).clamp(46.0, 64.0))
}

/// Hair: fair hair is lifted, which photos show too dark against a bright wall; a hue that hair does not have is grey's.
fn drawn_hair(photo: Oklch) -> Oklch {
    let fair = photo.l > 0.5;
    let (h, c) = match photo {
        Oklch { h, c, .. } if (20.0..110.0).contains(&h) && c > 0.012 => (h, c),
        Oklch { c, .. } => (50.0, c.min(0.012)),
    };
    let c = (c * if fair { 2.4 } else { 1.6 }).clamp(0.012, 0.105);
    Oklch::new((photo.l + if fair { 0.16 } else { 0.03 }).clamp(0.235, 0.84), c, h)
}

/// Lips carry their contrast to the skin over, not their colour: taken as it is it paints men.
fn drawn_lip(photo: Oklch, photo_skin: Oklch, skin: Oklch) -> Oklch {
    if skin.l < DARK {
        return Oklch::new(skin.l + 0.01, skin.c + 0.022, 27.0);
    }
    let l = (1.15 * (photo.l - photo_skin.l)).clamp(-0.20, -0.095);
    let c = (1.2 * (photo.c - photo_skin.c)).clamp(0.018, 0.055);
    Oklch::new(skin.l + l, skin.c + c, photo.h.clamp(16.0, 32.0))
}

/// The iris is too small in a photo for its very colour: it snaps to brown, hazel, grey-green, blue or grey-blue.
fn drawn_iris(photo: Oklch) -> Oklch {
    match photo.h {
        _ if photo.l < 0.335 => Oklch::new(0.33, 0.055, 48.0),
        h if photo.l < 0.37 && (15.0..85.0).contains(&h) && photo.c > 0.005 => Oklch::new(0.36, 0.052, 50.0),
        h if (35.0..85.0).contains(&h) && photo.c > if h < 70.0 { 0.011 } else { 0.016 } => Oklch::new(0.46, 0.06, h),
        h if (35.0..140.0).contains(&h) => Oklch::new(0.55, 0.04, 125.0),
        _ if photo.c < 0.01 => Oklch::new(0.58, 0.025, 225.0),
        _ => Oklch::new(0.60, 0.05, 235.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(skin: Colour) -> Colours {
        let brown = Colour::rgb(0x4a, 0x36, 0x2c);
        Colours { skin, hair: brown, lips: Colour::rgb(0xb0, 0x70, 0x68), iris: brown, brows: brown, beard: skin }
    }

    #[test]
    fn shades_stay_darker_than_the_skin_and_lights_lighter_on_any_skin() {
        for grey in (40..=245_u8).step_by(5) {
            let share = |s: f64| (f64::from(grey) * s) as u8;
            let p = Palette::of(&measured(Colour::rgb(grey, share(0.8), share(0.7))), 200.0, &Chosen::default());
            let l = |c: Colour| Oklch::from(c).l;
            assert!(l(p.ink) < l(p.line) && l(p.line) < l(p.deep) && l(p.deep) < l(p.shade), "{grey}");
            assert!(l(p.shade) < l(p.skin) && l(p.skin) < l(p.light), "{grey}");
        }
    }

    #[test]
    fn shades_follow_a_chosen_colour_unless_they_are_chosen_too() {
        let green = Colour::rgb(0x60, 0xb0, 0x60);
        let chosen = Chosen { skin: Some(green), lip: Some(green), ..Chosen::default() };
        let p = Palette::of(&measured(Colour::rgb(200, 160, 140)), 200.0, &chosen);
        assert_eq!((p.skin, p.lip), (green, green));
        assert!((Oklch::from(p.shade).h - Oklch::from(green).h).abs() < 12.0);
        let p = Palette::of(&measured(green), 200.0, &Chosen { shade: Some(Colour::BLACK), ..chosen });
        assert_eq!(p.shade, Colour::BLACK);
    }
}
