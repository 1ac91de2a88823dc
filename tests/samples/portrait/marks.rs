//! Where the named points of the face lie on a head, whatever it does: the truth of a rendered picture.

use crate::hair::on_skin;
use crate::head::{EYE, Head};
use crate::skull::CENTRE;
use crate::vector::V;

/// The points of the right half and of the middle, by the names of both sides (left in the picture, right), as places of
/// the even face at rest. Those of the middle have one name.
fn places(head: &Head) -> Vec<([&'static str; 2], V)> {
    let l = &head.lines;
    let line = l.lip_line.at(0.0);
    let brow = |x: f32| 0.5 * (l.brow_upper.at(x) + l.brow_lower.at(x));
    let w = head.person.nose;
    let jaw = head.skull.surface((V(95.0, 103.0, 28.0) - CENTRE).unit());
    let temple = head.skull.surface((V(84.0, -84.0, 62.0) - CENTRE).unit());
    let on = |x: f32, y: f32| V(x, y, f32::NAN);
    let chin = head.skull.surface((V(0.0, 174.0 + head.person.chin, 117.0) - CENTRE).unit());
    vec![
        (["4.6", "4.5"], on(88.0, brow(88.0))),
        (["4.4a", "4.3a"], on(66.0, brow(66.0))),
        (["4.4", "4.3"], on(43.0, brow(43.0))),
        (["4.2", "4.1"], on(21.0, brow(21.0))),
        (["3.12", "3.7"], on(66.8, 2.4)),
        (["3.8", "3.11"], on(25.4, 6.0)),
        (["3.2", "3.1"], on(47.0, l.lid_upper.at(47.0))),
        (["3.4", "3.3"], on(47.0, l.lid_lower.at(47.0))),
        (["9.6", "9.7"], on(11.0, 8.0)),
        (["9.14", "9.13"], on(19.0 * w, 46.0)),
        (["9.2", "9.1"], on(26.0 * w, 57.0)),
        (["9.4", "9.5"], on(12.5 * w, 67.0)),
        (["9.15", ""], on(0.0, 70.0)),
        (["8.4", "8.3"], on(38.0, l.lip_line.at(38.0))),
        (["8.9", "8.10"], on(10.5, l.lip_upper.at(10.5))),
        (["8.1", ""], on(0.0, l.lip_upper.at(0.0))),
        (["2.2", ""], on(0.0, line - 0.01)),
        (["2.3", ""], on(0.0, line + 0.01)),
        (["8.2", ""], on(0.0, l.lip_lower.at(0.0))),
        (["2.1", ""], chin),
        (["2.14", "2.13"], jaw),
        (["11.2", "11.3"], temple),
        (["11.1", ""], on(0.0, l.hairline.at(0.0))),
    ]
}

/// The named points on a head that does something; `at_rest` is the same head.
pub fn marks(head: &Head, at_rest: &Head) -> Vec<(&'static str, V)> {
    let mut all = Vec::new();
    for ((names, place), (_, now)) in places(at_rest).into_iter().zip(places(head)) {
        for (name, side) in names.into_iter().zip([-1.0, 1.0]).filter(|(n, _)| !n.is_empty()) {
            let q = V(place.0 * side, place.1, place.2);
            let depth = if q.2.is_nan() {
                let at = at_rest.sway(V(q.0, q.1, 125.0));
                on_skin(at_rest, at.0, at.1).2
            } else {
                q.2
            };
            // Lids slide over the ball: they have places of their own.
            all.push((name, head.sway(V(q.0, now.1, depth))));
        }
    }
    for (name, side) in [("3.6", -1.0), ("3.5", 1.0)] {
        let q = V(side * (EYE.0 - 0.4) + head.act.gaze_x, 0.6 + head.act.gaze_y, 121.0);
        all.push((name, head.sway(q)));
    }
    all
}
