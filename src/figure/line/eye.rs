//! The eyes of a line figure, which its table gives lids only: they close, and a pupil looks out between them.

use super::{Line, LineFigure};
use crate::disk::{Fault, Result};
use crate::drawing::Item;
use crate::geometry::{Affine, BezPath, Circle, Ellipse, Knot, ParamCurve, Point, Shape, Vec2, lerp};
use crate::pose::{Emotion, Pose};

/// Where the closed lids meet, between the lower (0) and the upper lid (1): people close from above.
const CLOSED_AT: f64 = 0.18;

/// Below this share of the eye's width an opening is hidden by the ink of the lids, and no iris is drawn in it.
const SLIVER: f64 = 0.05;

/// One eye.
#[derive(Debug, Clone)]
pub(super) struct Eye {
    upper: usize,
    lower: usize,
    /// Upper and lower points that meet when the eye closes.
    pairs: [(usize, usize); 4],
    /// Radius of the iris in the figure's pixels.
    iris: f64,
    slit: bool,
    /// Middle, width and height of the neutral opening.
    pub(super) centre: Point,
    width: f64,
    height: f64,
    left: bool,
}

impl Eye {
    pub(super) fn new(
        (upper, lower): (usize, usize),
        iris: f64,
        slit: bool,
        neutral: &[Knot],
        lines: &[Line],
    ) -> Result<Self> {
        let (u, mut l) = (lines[upper].points, lines[lower].points);
        let apart = |a: usize, b: usize| (neutral[a].point() - neutral[b].point()).hypot();
        // The lower lid may be drawn the other way round.
        if apart(u[0], l[0]) > apart(u[0], l[3]) {
            l.reverse();
        }
        let middle = |p: [usize; 4]| {
            let [a, b, c, d] = p.map(|i| neutral[i].point());
            crate::geometry::CubicBez::new(a, b, c, d).eval(0.5)
        };
        let (top, bottom) = (middle(u), middle(l));
        let (width, height) = (apart(u[0], u[3]), bottom.y - top.y);
        if !(width > 0.0 && height > 0.0 && iris > 0.0 && iris < 10.0 * width) {
            return Err(Fault::new(format!(
                "the eye of `{}` and `{}` is not open",
                lines[upper].name, lines[lower].name
            ))
            .help("in the neutral drawing the upper lid lies above the lower one, and `iris` is its radius"));
        }
        let pairs = std::array::from_fn(|i| (u[i], l[i]));
        let centre = top.midpoint(bottom);
        // Which side it is on is known when the figure's middle is: see `mark_side`.
        Ok(Self { upper, lower, pairs, iris, slit, centre, width, height, left: false })
    }

    pub(super) fn has(&self, line: usize) -> bool {
        self.upper == line || self.lower == line
    }

    /// Whether the eye is at the image's left of `middle`.
    pub(super) fn mark_side(&mut self, middle: f64) {
        self.left = self.centre.x < middle;
    }

    /// Closes the lids of blended points as far as the pose says.
    pub(super) fn close(&self, knots: &mut [Knot], pose: &Pose) {
        let open = if self.left { pose.lids.left } else { pose.lids.right }.clamp(0.0, 1.2);
        if open == 1.0 {
            return;
        }
        for (u, l) in self.pairs {
            let (upper, lower) = (knots[u], knots[l]);
            let meet = (lerp(lower.x, upper.x, CLOSED_AT), lerp(lower.y, upper.y, CLOSED_AT));
            for (i, knot) in [(u, upper), (l, lower)] {
                knots[i].x = lerp(meet.0, knot.x, open);
                knots[i].y = lerp(meet.1, knot.y, open);
            }
        }
    }

    /// The eye back to front: white, iris and pupil between the lids, lids.
    pub(super) fn draw(&self, figure: &LineFigure, knots: &[Knot], pose: &Pose) -> Vec<Item> {
        let (upper, lower) = (figure.ribbon(self.upper, knots), figure.ribbon(self.lower, knots));
        let side = if self.left { "left" } else { "right" };
        let mut items = Vec::new();
        let (top, bottom) = (upper.centre().eval(0.5), lower.centre().eval(0.5));
        if bottom.y - top.y > SLIVER * self.width {
            let opening = self.opening(knots);
            items.push(Item::area(format!("{side}-eye-white"), opening.clone(), figure.colours.eye_white));
            let look = self.iris_at(top.midpoint(bottom), pose);
            items.push(Item::clipped(format!("{side}-eye"), opening, self.iris_items(figure, side, look, pose)));
        }
        for line in [self.lower, self.upper] {
            items.push(figure.ink(&figure.lines[line].name, &[figure.ribbon(line, knots)], figure.colours.ink));
        }
        items
    }

    /// The area between the lids.
    fn opening(&self, knots: &[Knot]) -> BezPath {
        let at = |i: usize| knots[i].point();
        let p = &self.pairs;
        let mut path = BezPath::new();
        path.move_to(at(p[0].0));
        path.curve_to(at(p[1].0), at(p[2].0), at(p[3].0));
        path.line_to(at(p[3].1));
        path.curve_to(at(p[2].1), at(p[1].1), at(p[0].1));
        path.close_path();
        path
    }

    /// Where the iris is: it hangs from the neutral place, follows a third of how the opening moves with the
    /// emotion, and looks where the gaze says, kept on the eyeball.
    fn iris_at(&self, opening: Point, pose: &Pose) -> Point {
        let follow = (opening - self.centre) * 0.33;
        let reach = Vec2::new((0.5 * self.width - 0.72 * self.iris).max(0.0), 0.5 * self.height);
        let gaze = Vec2::new(pose.gaze.x * self.height, pose.gaze.y * self.height);
        let gaze = Vec2::new(gaze.x.clamp(-reach.x, reach.x), gaze.y.clamp(-reach.y, reach.y));
        self.centre + follow + gaze
    }

    fn iris_items(&self, figure: &LineFigure, side: &str, at: Point, pose: &Pose) -> Vec<Item> {
        // Fright and surprise show more white (recipe: iris × .86 and × .88 at the full emotion).
        let shock = (pose.ratios[Emotion::Fear] + pose.ratios[Emotion::Surprised]).clamp(0.0, 1.0);
        let r = self.iris * (1.0 - 0.13 * shock);
        let disc = |centre: Point, radius: f64| Circle::new(centre, radius).to_path(0.02);
        let mut items = vec![Item::area(format!("{side}-iris"), disc(at, r), figure.colours.iris)];
        if self.slit {
            let slit = Ellipse::new(at, (0.3 * r, 0.82 * r), 0.0).to_path(0.02);
            items.push(Item::area(format!("{side}-pupil"), slit, figure.colours.pupil));
        } else if figure.colours.pupil != figure.colours.iris {
            items.push(Item::area(format!("{side}-pupil"), disc(at, 0.56 * r), figure.colours.pupil));
        }
        // One window, up and to the left in both eyes: without it a stare is dead.
        let light = at + Vec2::new(-0.34 * r, -0.38 * r);
        items.push(Item::area(format!("{side}-light"), disc(light, 0.27 * r), figure.colours.eye_white));
        let low = at + Vec2::new(0.36 * r, 0.42 * r);
        items.push(Item::area(format!("{side}-light-low"), disc(low, 0.11 * r), figure.colours.eye_white));
        items
    }
}

/// The transform of the head (thesis 7.3.2): rolled about the pivot and moved in pupil distances.
pub(super) fn head_transform(figure: &LineFigure, pose: &Pose) -> Affine {
    let pupils = match figure.eyes.as_slice() {
        [a, b, ..] => (a.centre - b.centre).hypot(),
        _ => figure.view.width() / 4.0,
    };
    let pivot = figure.pivot.to_vec2();
    Affine::translate(pivot + Vec2::new(pose.head.x * pupils, pose.head.y * pupils))
        * Affine::rotate(pose.head.roll.to_radians())
        * Affine::translate(-pivot)
}
