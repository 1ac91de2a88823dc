//! Which two dark regions are the eyes (thesis sec. 3.2 and 3.3.3).

use super::{Mask, Neighbours, Region, Regions};

/// Two dark regions that may be the eyes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EyePair {
    /// The one at the image's left.
    pub left: Region,
    /// The one at the image's right.
    pub right: Region,
    /// How likely they are, among the pairs of one photo: eq. 3.5, at most 0.
    pub score: f64,
}

/// The dark regions of a photo and what may be its eyes.
#[derive(Debug, Clone, PartialEq)]
pub struct EyePairs {
    /// D, the dark regions.
    pub dark: Regions,
    /// Those that may be an eye.
    pub candidates: Vec<Region>,
    /// E, pairs of them that may be the eyes, best first.
    pub pairs: Vec<EyePair>,
}

/// A region may be from this to that many times as wide as high.
const ASPECT: (f64, f64) = (0.7, 6.0);
/// The largest region, in heights of the image.
const LARGEST: (f64, f64) = (0.16, 0.10);
/// How far apart the middles of a pair may be, in heights of the image.
const APART: (f64, f64) = (0.10, 0.40);
/// How far from level a pair may be, in degrees.
const TILT: f64 = 10.0;
/// How many times larger one box of a pair may be than the other.
const AREAS: f64 = 3.0;
/// How wide each may be, in distances between them.
const WIDTH: (f64, f64) = (0.12, 0.70);
/// How far the pair's middle may be from the image's, in widths and heights of the image: faces are large and frontal
/// (thesis sec. 3.3.2), and eyes lie in a head's upper half.
const OFF_MIDDLE: (f64, f64) = (0.15, 0.25);

impl EyePairs {
    /// Pairs dark regions by Chan's rules and orders them by eq. 3.5. The rules are those of the sources' page; the
    /// thesis does not print them.
    #[must_use]
    pub(crate) fn of(light: &Mask) -> Self {
        let dark = Regions::of(&light.not(), Neighbours::Four);
        let (width, height) = (dark.labels.width() as f64, dark.labels.height() as f64);
        let candidates: Vec<Region> = dark
            .list
            .iter()
            .filter(|r| {
                let (w, h) = (r.bounds.width() as f64, r.bounds.height() as f64);
                let aspect = w / h;
                (ASPECT.0..=ASPECT.1).contains(&aspect)
                    && w <= LARGEST.0 * height
                    && h <= LARGEST.1 * height
                    // Narrower ones fit no pair; thousands of specks need not be paired.
                    && w >= WIDTH.0 * APART.0 * height
                    && !dark.at_border(r)
            })
            .copied()
            .collect();
        let largest = candidates.iter().map(|r| r.bounds.area()).max().unwrap_or(1) as f64;
        let mut pairs = Vec::new();
        for (i, a) in candidates.iter().enumerate() {
            for b in &candidates[i + 1..] {
                let (left, right) = if a.bounds.centre().x <= b.bounds.centre().x { (a, b) } else { (b, a) };
                let across = right.bounds.centre() - left.bounds.centre();
                let middle = left.bounds.centre().midpoint(right.bounds.centre());
                let distance = across.hypot();
                let areas = [left, right].map(|r| r.bounds.area() as f64);
                let fits = (APART.0..=APART.1).contains(&(distance / height))
                    && across.atan2().to_degrees().abs() <= TILT
                    && areas[0].max(areas[1]) <= AREAS * areas[0].min(areas[1])
                    && [left, right]
                        .iter()
                        .all(|r| (WIDTH.0..=WIDTH.1).contains(&(r.bounds.width() as f64 / distance)))
                    && (middle.x - width / 2.0).abs() <= OFF_MIDDLE.0 * width
                    && (middle.y - height / 2.0).abs() <= OFF_MIDDLE.1 * height;
                if fits {
                    pairs.push(EyePair { left: *left, right: *right, score: score(areas.map(|v| v / largest)) });
                }
            }
        }
        pairs.sort_by(|a, b| b.score.total_cmp(&a.score));
        Self { dark, candidates, pairs }
    }

    /// The pair with the largest score.
    #[must_use]
    pub(crate) fn best(&self) -> Option<&EyePair> {
        self.pairs.first()
    }
}

/// Thesis eq. 3.5 of two areas in (0, 1]: (A₁ A₂ − S²) / 2 with S = A₁ / A₂ ≥ 1, so that large and equal regions win.
fn score([a, b]: [f64; 2]) -> f64 {
    let ratio = a.max(b) / a.min(b);
    (a * b - ratio * ratio) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A light image of 200 × 200 with dark boxes.
    fn with_boxes(boxes: &[[usize; 4]]) -> EyePairs {
        let mut light = Mask::filled(200, 200, true);
        for [x, y, w, h] in boxes {
            for row in *y..y + h {
                light.row_mut(row)[*x..x + w].fill(false);
            }
        }
        EyePairs::of(&light)
    }

    #[test]
    fn two_level_boxes_of_an_eyes_size_are_the_eyes_and_larger_and_more_equal_ones_win() {
        let eyes = [[70, 90, 16, 8], [114, 91, 16, 8]];
        let found = with_boxes(&[eyes[0], eyes[1], [76, 76, 10, 4], [116, 76, 14, 5], [90, 130, 20, 6]]);
        let best = found.best().unwrap();
        assert_eq!((best.left.bounds.x0, best.right.bounds.x0), (70, 114));
        assert!((best.score - (score([1.0, 1.0]))).abs() < 1e-12 && best.score == 0.0);
    }

    #[test]
    fn what_breaks_a_rule_is_no_pair() {
        let none = |boxes: &[[usize; 4]]| assert!(with_boxes(boxes).best().is_none(), "{boxes:?}");
        none(&[[70, 90, 16, 8], [114, 110, 16, 8]]); // not level
        none(&[[70, 90, 16, 8], [82, 90, 16, 8]]); // one
        none(&[[70, 90, 16, 8], [114, 90, 8, 4]]); // areas
        none(&[[70, 90, 16, 24], [114, 90, 16, 24]]); // too high
        none(&[[10, 90, 16, 8], [54, 90, 16, 8]]); // beside the middle
        none(&[[70, 90, 16, 8]]);
        none(&[]);
    }
}
