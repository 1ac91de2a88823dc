//! Pictures in, and what can be read from a photo of a face without a model of one: colour in HSI, thresholds,
//! regions, eyes, edges, search ranges (thesis ch. 3).
//!
//! It knows nothing of feature points; what makes a face of all this is `face`.

mod plane;
mod grey;
mod limits;
mod jpeg;
mod read;
mod mask;
mod morphology;
mod hsi;
mod threshold;
mod regions;
mod eye_pair;
mod refine;
mod eyeballs;
mod edges;
mod ranges;
mod cuts;
mod cheeks;
mod stages;
mod quality;
mod strip;
mod write;

pub use cheeks::{Cheeks, Ear};
pub use cuts::Cut;
pub use edges::{Divisions, Edges};
pub use eye_pair::{EyePair, EyePairs};
pub use eyeballs::{Eyeball, Eyeballs};
pub use grey::Grey;
pub(crate) use grey::halve;
pub use hsi::{Hsi, hue, hue_distance};
pub use jpeg::jpeg_luma;
pub use limits::MAX_PHOTO_SIDE;
pub use mask::{Bounds, Mask};
pub use plane::Plane;
pub use quality::Quality;
pub use ranges::{Feature, Features};
pub use read::{MAX_PHOTO_BYTES, sha256};
pub use refine::Refined;
pub use regions::{Neighbours, Region, Regions};
pub use stages::{Located, Stages};
pub(crate) use strip::without_metadata;
pub use threshold::{FaceGround, LightDark};
pub use write::to_clean_png;

use crate::drawing::{Colour, Image};

/// A photo as it is looked at: upright, opaque, straight sRGB of 8 bits a channel.
pub type Photo = Image<[u8; 3]>;

impl Photo {
    /// The pixel at `x`, `y` as a colour; beyond the border the nearest one.
    #[must_use]
    pub fn colour(&self, x: isize, y: isize) -> Colour {
        let [r, g, b] = self.at(x, y);
        Colour::rgb(r, g, b)
    }

    /// The photo at most `side` pixels wide and high, by averaging whole areas; the photo itself where it is not
    /// larger. Returns how many of its pixels make one of the small one.
    #[must_use]
    pub fn at_most(&self, side: usize) -> (std::borrow::Cow<'_, Self>, f64) {
        let longest = self.width().max(self.height());
        if longest <= side {
            return (std::borrow::Cow::Borrowed(self), 1.0);
        }
        let factor = longest as f64 / side as f64;
        let width = ((self.width() as f64 / factor).round() as usize).max(1);
        let height = ((self.height() as f64 / factor).round() as usize).max(1);
        let columns = spans(self.width(), width, factor);
        let rows = spans(self.height(), height, factor);
        let mut pixels = Vec::with_capacity(width * height);
        for (top, bottom) in &rows {
            let mut sums = vec![[0_u32; 3]; width];
            for y in *top..*bottom {
                let row = self.row(y);
                for (sum, (left, right)) in sums.iter_mut().zip(&columns) {
                    for pixel in &row[*left..*right] {
                        for (s, v) in sum.iter_mut().zip(pixel) {
                            *s += u32::from(*v);
                        }
                    }
                }
            }
            pixels.extend(sums.iter().zip(&columns).map(|(sum, (left, right))| {
                let count = ((right - left) * (bottom - top)) as u32;
                sum.map(|s| ((s + count / 2) / count) as u8)
            }));
        }
        (std::borrow::Cow::Owned(Self::new(width, height, pixels)), factor)
    }
}

/// Which of `from` pixels make each of `to`: at least one, none left out.
fn spans(from: usize, to: usize, factor: f64) -> Vec<(usize, usize)> {
    (0..to)
        .map(|i| {
            let start = ((i as f64 * factor) as usize).min(from - 1);
            let end = if i + 1 == to { from } else { (((i + 1) as f64 * factor) as usize).clamp(start + 1, from) };
            (start, end)
        })
        .collect()
}
