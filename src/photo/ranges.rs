//! Where brows, eyes, nose and mouth are looked for, and what edges are found there (thesis sec. 3.4.3).

use super::{Bounds, Edges, Eyeballs, Mask, Neighbours, Regions};
use crate::geometry::{Point, Vec2};

/// A feature's search range and what grew from it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Feature {
    /// The initial range.
    pub search: Bounds,
    /// The box of the final region; the search range where no edge was found.
    pub bounds: Bounds,
    /// The edge pixels of the final region, row by row.
    pub pixels: Vec<(usize, usize)>,
}

/// The four features. Brow and eye are the image's left; the right ones mirror them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Features {
    /// R_Left_Eyebrow.
    pub brow: Feature,
    /// R_Left_Eye.
    pub eye: Feature,
    /// R_Nose.
    pub nose: Feature,
    /// R_Mouth.
    pub mouth: Feature,
}

impl Features {
    /// Grows regions of edges from the search ranges. None leaves its part of the square; nose and mouth stay between
    /// the middles of the eyeballs.
    #[must_use]
    pub(crate) fn of(edges: &Edges, eyes: &Eyeballs) -> Self {
        let (width, height) = (edges.binary.width(), edges.binary.height());
        let [brows, eye_part, nose_part, mouth_part] = edges.divisions.parts(&edges.square);
        let between = |from: Point, to: Point| Bounds::between(from, to, width, height);
        let (left, right) = (eyes.left, eyes.right);
        let lines = &edges.divisions;

        let reach = Vec2::new(left.height(), 0.5 * left.height());
        let middle = eyes.middle().x.max(0.0) as usize;
        let left_half = |part: Bounds| Bounds { x1: middle.clamp(part.x0 + 1, part.x1), ..part };
        let eye = grown(&edges.binary, between(left.centre - reach, left.centre + reach), left_half(eye_part));

        // The eye's region, moved up until it lies on the line between brows and eyes.
        let bottom = brows.y1;
        let above = Bounds { y0: bottom.saturating_sub(eye.bounds.height()), y1: bottom.max(1), ..eye.bounds };
        let brow = grown(&edges.binary, above, left_half(brows));

        let columns = between(Point::new(left.centre.x, 0.0), Point::new(right.centre.x, 0.0));
        let inside = |part: Bounds| Bounds { x0: columns.x0, x1: columns.x1, ..part };
        let nose_end = lines.eye_nose + 0.7 * (lines.nose_mouth - lines.eye_nose);
        let nose_search = between(Point::new(left.centre.x, lines.eye_nose), Point::new(right.centre.x, nose_end));
        let mouth_end = lines.nose_mouth + eyes.distance() / 3.0;
        let mouth_search = between(Point::new(left.centre.x, lines.nose_mouth), Point::new(right.centre.x, mouth_end));
        Self {
            brow,
            eye,
            nose: grown(&edges.binary, nose_search, inside(nose_part)),
            mouth: grown(&edges.binary, mouth_search, inside(mouth_part)),
        }
    }
}

/// The edges within `limits` that hang together with one in `search`.
fn grown(binary: &Mask, search: Bounds, limits: Bounds) -> Feature {
    let search = search.shared(&limits).unwrap_or(limits);
    let cut = binary.crop(limits.x0..limits.x1, limits.y0..limits.y1);
    let regions = Regions::of(&cut, Neighbours::Eight);
    let mut seeded = vec![false; regions.list.len() + 1];
    for y in search.y0..search.y1 {
        for x in search.x0..search.x1 {
            seeded[regions.labels[(x - limits.x0, y - limits.y0)] as usize] = true;
        }
    }
    seeded[0] = false;
    let mut pixels = Vec::new();
    for (at, label) in regions.labels.pixels().iter().enumerate() {
        if seeded[*label as usize] {
            pixels.push((limits.x0 + at % cut.width(), limits.y0 + at / cut.width()));
        }
    }
    let mut bounds: Option<Bounds> = None;
    for (x, y) in &pixels {
        bounds.get_or_insert(Bounds { x0: *x, y0: *y, x1: x + 1, y1: y + 1 }).take(*x, *y);
    }
    Feature { search, bounds: bounds.unwrap_or(search), pixels }
}

#[cfg(test)]
mod tests {
    use super::super::regions::drawn;
    use super::*;

    #[test]
    fn a_region_grows_beyond_its_search_range_but_not_its_limits() {
        let edges = drawn(&["#####...##", "....#.....", "#...#####."]);
        let search = Bounds { x0: 3, y0: 1, x1: 6, y1: 3 };
        let feature = grown(&edges, search, Bounds { x0: 1, y0: 0, x1: 8, y1: 3 });
        assert_eq!(feature.bounds, Bounds { x0: 1, y0: 0, x1: 8, y1: 3 });
        assert_eq!(feature.pixels.len(), 9);
        let none = grown(&edges, Bounds { x0: 1, y0: 1, x1: 3, y1: 2 }, Bounds { x0: 1, y0: 1, x1: 4, y1: 2 });
        assert_eq!((none.pixels.len(), none.bounds), (0, none.search));
    }
}
