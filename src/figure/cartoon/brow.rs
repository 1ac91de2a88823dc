//! The brows, drawn over the hair, since brows under a fringe cannot act; and the lines that a frown sets between them.

use super::Palette;
use crate::drawing::Item;
use crate::face::rig::Deformed;
use crate::geometry::{Vec2, brush};

/// How full a brow is, from its inner to its outer end.
const PROFILE: [f64; 15] = [0.10, 0.58, 0.80, 0.91, 0.97, 1.0, 1.0, 0.96, 0.90, 0.81, 0.70, 0.58, 0.45, 0.26, 0.04];

/// Both brows, then the frown. `height` is that of the brows as measured, in face units.
pub(super) fn brows(face: &Deformed, height: f64, palette: &Palette, ink: f64, ink_only: bool) -> Vec<Item> {
    let width = (0.95 * height).clamp(7.5, 15.0) * if ink_only { 0.8 } else { 1.0 };
    let mut items = Vec::with_capacity(4);
    for (side, (name, line)) in [-1.0, 1.0].into_iter().zip(["left-brow", "right-brow"].into_iter().zip(face.brows)) {
        let mut line = line;
        line[0] += Vec2::new(1.5 * side, 1.0);
        items.push(Item::area(name, brush(&line, width, &PROFILE), palette.brow));
    }
    let frown = face.expression.frown.min(1.0);
    if frown > 0.02 {
        for (side, brow) in [-1.0, 1.0].into_iter().zip(&face.brows) {
            let at = |x: f64, y: f64| brow[0] - Vec2::new(side * x, -y);
            let line = [at(6.0, -4.0), at(8.0, 3.0), at(7.0, 9.0)];
            let path = brush(&line, 0.9 * ink, &[0.0, 1.0, 0.0]);
            items.push(Item::area("frown", path, palette.line.faded(0.9 * frown)));
        }
    }
    items
}
