//! Who is painted: every number that tells one invented person from another.
//!
//! A unit of length is a pixel of a 600 × 600 passport frame, where the pupils lie 95 units apart (about 63 mm); the
//! origin is the point between the pupils, in depth the axis between the ears. The places in x and y are averages over
//! the 72 neutral faces of the Face Research Lab London Set (DeBruine and Jones 2017, CC BY 4.0) with small departures
//! by hand; the depths are by common anthropometry. Nobody in particular is drawn.

use crate::vector::{V, smooth};

/// How the hair is worn.
#[derive(Clone, Copy, PartialEq)]
pub enum Cut {
    /// To the chin, parted at the side.
    Bob,
    /// A few fingers on the crown, shorter at the sides.
    Short,
}

/// One invented person. Colours are linear RGB.
#[derive(Clone)]
pub struct Person {
    pub seed: u64,
    pub skin: V,
    /// How much cheeks, nose and ears redden.
    pub blush: f32,
    pub lips: V,
    pub iris: V,
    pub hair: V,
    pub cut: Cut,
    /// How thick the hairs of the head are, and how dark they make the scalp.
    pub hair_width: f32,
    pub scalp: f32,
    /// Hairs of one brow, and how thick they are.
    pub brow_hairs: usize,
    pub brow_width: f32,
    /// Lengths of the upper and lower lashes.
    pub lashes: (f32, f32),
    /// Width of the jaw, of the nose and height of the lips, as parts of the average.
    pub jaw: f32,
    pub nose: f32,
    pub lip_height: f32,
    /// How far the chin lies below the average.
    pub chin: f32,
    /// How strongly the brow overhangs, 0 for a smooth forehead.
    pub ridge: f32,
    /// How far the brows are raised.
    pub brow_lift: f32,
    /// How far the brows arch: 1 for a full arch, 0 for none.
    pub arch: f32,
    /// How far the upper lids hang below the average.
    pub droop: f32,
    /// How wide the neck is.
    pub neck: f32,
    pub shirt: V,
    /// Shadow of a shaved beard.
    pub stubble: f32,
    /// Depth of the folds that age brings.
    pub folds: f32,
    /// How far the mouth is open, 0 to 1.
    pub open: f32,
}

impl Person {
    /// A woman of about 35 with dark brown hair to the chin, light olive skin and brown eyes.
    pub fn woman() -> Person {
        Person {
            seed: 35,
            skin: V(0.60, 0.385, 0.27),
            blush: 1.0,
            lips: V(0.48, 0.212, 0.172),
            iris: V(0.13, 0.062, 0.028),
            hair: V(0.030, 0.0165, 0.0098),
            cut: Cut::Bob,
            hair_width: 1.0,
            scalp: 0.66,
            brow_hairs: 850,
            brow_width: 0.28,
            lashes: (8.5, 4.0),
            jaw: 0.88,
            nose: 0.82,
            lip_height: 1.08,
            chin: -4.0,
            ridge: 0.0,
            brow_lift: 3.0,
            arch: 0.9,
            droop: 0.0,
            neck: 0.93,
            shirt: V(0.10, 0.145, 0.19),
            stubble: 0.0,
            folds: 0.6,
            open: 0.0,
        }
    }

    /// A man of about 40 with short black hair and dark skin.
    pub fn man() -> Person {
        Person {
            seed: 40,
            skin: V(0.20, 0.105, 0.062),
            blush: 0.55,
            lips: V(0.17, 0.078, 0.062),
            iris: V(0.05, 0.024, 0.012),
            hair: V(0.014, 0.011, 0.009),
            cut: Cut::Short,
            hair_width: 1.0,
            scalp: 0.66,
            brow_hairs: 900,
            brow_width: 0.34,
            lashes: (5.5, 3.0),
            jaw: 0.98,
            nose: 1.14,
            lip_height: 1.22,
            chin: 5.0,
            ridge: 1.0,
            brow_lift: 0.0,
            arch: 0.5,
            droop: 1.0,
            neck: 1.24,
            shirt: V(0.50, 0.50, 0.48),
            stubble: 0.5,
            folds: 1.0,
            open: 0.0,
        }
    }

    /// A man of about 30 with short black hair and light skin, who teaches.
    pub fn teacher() -> Person {
        Person {
            seed: 30,
            skin: V(0.50, 0.315, 0.215),
            blush: 0.85,
            lips: V(0.36, 0.165, 0.135),
            iris: V(0.055, 0.026, 0.013),
            hair: V(0.013, 0.0105, 0.009),
            cut: Cut::Short,
            hair_width: 1.7,
            scalp: 0.93,
            brow_hairs: 1000,
            brow_width: 0.34,
            lashes: (5.5, 3.0),
            jaw: 0.93,
            nose: 0.98,
            lip_height: 1.10,
            chin: 0.0,
            ridge: 0.4,
            brow_lift: 1.0,
            arch: 0.55,
            droop: 0.6,
            neck: 1.12,
            shirt: V(0.10, 0.16, 0.13),
            stubble: 0.22,
            folds: 0.55,
            open: 0.0,
        }
    }

    /// The points of the right half that the skull goes through.
    pub fn points(&self) -> Vec<V> {
        SKULL
            .iter()
            .map(|&(x, y, z)| {
                let low = smooth(30.0, 135.0, y);
                let x = x * (1.0 + (self.jaw - 1.0) * (low + 0.6 * smooth(120.0, 165.0, y)));
                let y = y + self.chin * smooth(115.0, 170.0, y) * smooth(20.0, 90.0, z);
                let brow = smooth(-55.0, -28.0, y) * smooth(-5.0, -24.0, y) * smooth(85.0, 110.0, z);
                V(x, y, z + self.ridge * 4.0 * brow)
            })
            .collect()
    }
}

#[rustfmt::skip]
const SKULL: &[(f32, f32, f32)] = &[
    // The midline, from the nape over the crown and down the face to the throat; the nose is left out.
    (0.0, 85.0, -88.0), (0.0, 40.0, -118.0), (0.0, -25.0, -136.0), (0.0, -85.0, -116.0), (0.0, -125.0, -75.0),
    (0.0, -146.0, -25.0), (0.0, -148.0, 20.0), (0.0, -138.0, 66.0), (0.0, -113.0, 109.0), (0.0, -92.0, 126.0),
    (0.0, -68.0, 136.0), (0.0, -45.0, 141.0), (0.0, -25.0, 141.5), (0.0, -6.0, 135.0), (0.0, 15.0, 134.0),
    (0.0, 40.0, 135.0), (0.0, 62.0, 136.0), (0.0, 78.0, 138.5), (0.0, 90.0, 139.0), (0.0, 103.0, 138.0),
    (0.0, 117.0, 137.0), (0.0, 129.0, 133.5), (0.0, 142.0, 136.0), (0.0, 155.0, 137.0), (0.0, 166.0, 132.0),
    (0.0, 174.0, 120.0), (0.0, 175.0, 100.0), (0.0, 168.0, 66.0), (0.0, 158.0, 35.0),
    // Forehead and temples.
    (40.0, -113.0, 98.0), (70.0, -113.0, 66.0), (91.0, -110.0, 12.0), (90.0, -110.0, -35.0), (70.0, -112.0, -78.0),
    (38.0, -112.0, -98.0), (48.0, -139.0, 40.0), (52.0, -139.0, -10.0), (42.0, -136.0, -48.0),
    (35.0, -90.0, 117.0), (35.0, -65.0, 131.0), (35.0, -45.0, 134.5), (65.0, -85.0, 92.0), (65.0, -60.0, 108.0),
    (66.0, -42.0, 114.0), (88.0, -60.0, 74.0), (102.0, -60.0, 30.0), (107.0, -60.0, -20.0), (99.0, -60.0, -75.0),
    (70.0, -60.0, -112.0), (36.0, -55.0, -130.0), (93.0, -35.0, 72.0), (104.0, -25.0, 25.0), (109.0, -20.0, -25.0),
    (98.0, -10.0, -80.0), (66.0, -5.0, -118.0), (95.0, 35.0, -62.0), (62.0, 40.0, -100.0), (78.0, 80.0, -50.0),
    (45.0, 82.0, -78.0),
    // Brow and orbit: the lids come later, as a shell over the ball.
    (14.0, -27.0, 140.0), (30.0, -29.0, 137.0), (48.0, -30.0, 132.0), (66.0, -28.0, 122.0), (80.0, -22.0, 106.0),
    (92.0, -12.0, 80.0), (17.0, -8.0, 126.0), (23.0, 2.0, 114.0), (30.0, -12.0, 119.0), (47.0, -15.0, 121.0),
    (62.0, -13.0, 115.0), (74.0, 0.0, 101.0), (47.0, 6.0, 115.0), (33.0, 14.0, 115.0), (47.0, 19.0, 118.0),
    (62.0, 14.0, 112.0), (84.0, 0.0, 91.0), (97.0, 3.0, 62.0),
    // Cheekbone, cheek and the side of the face.
    (20.0, 20.0, 121.0), (24.0, 35.0, 124.0), (38.0, 32.0, 121.0), (55.0, 34.0, 119.5), (70.0, 34.0, 114.0),
    (84.0, 31.0, 101.0), (96.0, 26.0, 74.0), (103.0, 18.0, 42.0), (106.0, 10.0, 8.0), (30.0, 52.0, 127.0),
    (46.0, 52.0, 123.0), (64.0, 52.0, 115.5), (80.0, 50.0, 101.0), (94.0, 48.0, 72.0), (101.0, 45.0, 38.0),
    (103.0, 42.0, 0.0), (18.0, 72.0, 134.5), (32.0, 74.0, 128.0), (50.0, 78.0, 119.0), (68.0, 78.0, 106.0),
    (84.0, 78.0, 82.0), (95.0, 78.0, 48.0), (99.0, 74.0, 8.0),
    // Mouth, chin and jaw.
    (18.0, 90.0, 136.0), (18.0, 104.0, 134.5), (18.0, 118.0, 132.5), (36.0, 92.0, 127.0), (38.0, 104.0, 124.0),
    (37.0, 117.0, 121.0), (56.0, 104.0, 112.0), (74.0, 104.0, 91.0), (87.0, 104.0, 62.0), (95.0, 102.0, 28.0),
    (95.0, 96.0, -8.0), (16.0, 131.0, 130.0), (16.0, 146.0, 133.0), (16.0, 158.0, 132.0), (18.0, 169.0, 122.0),
    (36.0, 132.0, 119.0), (36.0, 148.0, 119.5), (36.0, 160.0, 112.0), (34.0, 168.0, 100.0), (56.0, 130.0, 102.0),
    (56.0, 147.0, 98.0), (58.0, 156.0, 78.0), (74.0, 128.0, 78.0), (77.0, 140.0, 56.0), (87.0, 122.0, 42.0),
    (88.0, 122.0, 10.0), (30.0, 168.0, 70.0), (55.0, 158.0, 45.0), (72.0, 142.0, 20.0), (74.0, 118.0, -25.0),
];
