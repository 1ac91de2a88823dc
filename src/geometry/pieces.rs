//! The outline of strokes with always the same elements: for outputs that let one shape change into another.

use kurbo::{BezPath, CubicBez, PathEl, Vec2};

use super::Ribbon;
use super::envelope::between;
use super::outline::turned;
use super::pen::{Pen, Track};

/// The outline of a chain with always the same elements, to be filled non-zero. A stroke is one closed part of `pieces`
/// cubics a side and two a cap, also where it is too narrow to be seen. At four pieces a side the lines of a face are
/// about 0.1 % of their ink off the union of their discs, at eight 0.01 %; where the envelope folds it is less exact
/// than [`outline`](super::outline).
#[must_use]
pub fn outline_in_pieces(chain: &[Ribbon], pieces: usize) -> BezPath {
    let mut path = BezPath::new();
    let pieces = pieces.max(1);
    for ribbon in chain {
        let track = Track::of(ribbon);
        let step = 1.0 / pieces as f64;
        let pens: Vec<Pen> = (0..=pieces).map(|i| track.pen(i as f64 * step)).collect();
        path.push(PathEl::MoveTo(pens[0].contact(1.0)));
        for pair in pens.windows(2) {
            add(&mut path, between(&pair[0], &pair[1], step / 3.0, 1.0));
        }
        let (start, end) = (&pens[0], &pens[pieces]);
        half_turns(&mut path, end, end.outward(1.0), -2.0 * end.angle());
        for pair in pens.windows(2).rev() {
            let c = between(&pair[0], &pair[1], step / 3.0, -1.0);
            add(&mut path, CubicBez::new(c.p3, c.p2, c.p1, c.p0));
        }
        half_turns(&mut path, start, start.outward(-1.0), 2.0 * start.angle() - std::f64::consts::TAU);
        path.push(PathEl::ClosePath);
    }
    path
}

fn add(path: &mut BezPath, c: CubicBez) {
    path.push(PathEl::CurveTo(c.p1, c.p2, c.p3));
}

/// Round the pen's disc in two cubics, whatever the turn.
fn half_turns(path: &mut BezPath, pen: &Pen, from: Vec2, turn: f64) {
    let start = from.atan2();
    add(path, turned(pen.at, pen.radius, start, turn / 2.0));
    add(path, turned(pen.at, pen.radius, start + turn / 2.0, turn / 2.0));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Knot;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(128))]

        #[test]
        fn an_outline_in_pieces_has_always_the_same_elements(
            c in prop::array::uniform4((0.0..100.0f64, 0.0..100.0f64, -5.0..20.0f64)),
            pieces in 1_usize..9,
        ) {
            let ribbon = Ribbon(c.map(|(x, y, w)| Knot::new(x, y, w)));
            let kinds = |path: &BezPath| path.elements().iter().map(std::mem::discriminant).collect::<Vec<_>>();
            let nothing = Ribbon([Knot::default(); 4]);
            let path = outline_in_pieces(&[ribbon, nothing], pieces);
            prop_assert_eq!(kinds(&path), kinds(&outline_in_pieces(&[nothing, nothing], pieces)));
            prop_assert_eq!(path.elements().len(), 2 * (2 * pieces + 6));
            prop_assert!(path.is_finite());
        }
    }
}
