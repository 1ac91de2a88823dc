//! A mouth in a pose: its eight points and the curves between them (recipe part 4).

use super::{smoothstep, within};
use crate::face::{FeaturePoint as P, Points};
use crate::geometry::{CubicBez, ParamCurve, Point, Vec2, lerp};

/// The lips of a pose. Curves run from the image's left to its right.
#[derive(Debug, Clone, PartialEq)]
pub struct Mouth {
    /// 8.4 and 8.3.
    pub corners: [Point; 2],
    /// 8.9 and 8.10.
    pub peaks: [Point; 2],
    /// 8.1, the middle of the upper lip's edge.
    pub bow: Point,
    /// 2.2 and 2.3, the inner edges in the middle; one place where the lips meet.
    pub inner: [Point; 2],
    /// 8.2, the bottom of the lower lip.
    pub bottom: Point,
    /// The outer edge of the upper lip: corner, peak, middle, peak, corner.
    pub upper_edge: [CubicBez; 4],
    /// The outer edge of the lower lip: corner, middle, corner.
    pub lower_edge: [CubicBez; 2],
    /// The upper lip's inner edge, between the inner corners. Where the lips meet it is the line between them.
    pub upper_inner: [CubicBez; 4],
    /// The lower lip's inner edge. It stands at the same x as the upper one's at every parameter and nowhere above it.
    pub lower_inner: [CubicBez; 4],
    /// MW0, the width of the mouth at rest.
    pub neutral_width: f64,
    /// How rounded it is by narrowing, 0 to 1.
    pub rounded: f64,
    /// How far the upper teeth stand on the lower lip, 0 to 1: they then fill the opening.
    pub bite: f64,
    /// How far the tongue is raised, 0 to 1.
    pub tongue: f64,
}

/// What gives the curves their look besides where the points are, each 0 to 1.
#[derive(Clone, Copy)]
pub(super) struct Look {
    pub(super) rounded: f64,
    pub(super) pout: f64,
    pub(super) sneer: f64,
}

const FLAT: CubicBez = CubicBez { p0: Point::ZERO, p1: Point::ZERO, p2: Point::ZERO, p3: Point::ZERO };

impl Mouth {
    /// The mouth through its points: corners, peaks, and from above the four of the middle: 8.1, 2.2, 2.3, 8.2.
    pub(super) fn through(corners: [Point; 2], peaks: [Point; 2], middles: [Point; 4], look: Look) -> Self {
        let [bow, upper, lower, bottom] = middles;
        let mut mouth = Self {
            corners,
            peaks,
            bow,
            inner: [upper, lower],
            bottom,
            upper_edge: [FLAT; 4],
            lower_edge: [FLAT; 2],
            upper_inner: [FLAT; 4],
            lower_inner: [FLAT; 4],
            neutral_width: corners[1].x - corners[0].x,
            rounded: look.rounded,
            bite: 0.0,
            tongue: 0.0,
        };
        // Round: 0 a flat arc from corner to middle, 1 a quarter of an ellipse.
        let gap = mouth.gap();
        let round = within((1.9 * gap / mouth.width()).max(look.rounded * (gap / 6.0).min(1.0)), 0.0, 1.0);
        mouth.inner_edges(round, look.pout);
        mouth.outer_edges(round, look.sneer);
        mouth
    }

    /// How far the inner edges stand apart in the middle, in face units.
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.inner[1].y - self.inner[0].y
    }

    /// How far one can see into the mouth, in face units: the gap, where the teeth do not fill it.
    #[must_use]
    pub fn opening(&self) -> f64 {
        self.gap() * (1.0 - self.bite)
    }

    /// From corner to corner, in face units.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.corners[1].x - self.corners[0].x
    }

    /// How far it is open as a mouth, not a line: 0 to 1.
    #[must_use]
    pub(crate) fn parted(&self) -> f64 {
        smoothstep(0.3, 3.0, self.gap())
    }

    /// Puts the eight points of the mouth where the lips are.
    pub(super) fn place(&self, points: &mut Points) {
        let named = [P::P8_4, P::P8_3, P::P8_9, P::P8_10, P::P8_1, P::P2_2, P::P2_3, P::P8_2];
        let [left, right] = self.corners;
        let places = [left, right, self.peaks[0], self.peaks[1], self.bow, self.inner[0], self.inner[1], self.bottom];
        for (p, place) in named.into_iter().zip(places) {
            points[p] = place;
        }
    }

    /// Both inner edges, a half at a time. The control points of a half stand at the same x in both, the lower one's
    /// nowhere above the upper one's.
    fn inner_edges(&mut self, round: f64, pout: f64) {
        let (width, parted) = (self.width(), self.parted());
        let between = self.inner[0].midpoint(self.inner[1]);
        // Rounded lips close in from the sides, so that what is open of an *u* is as round as it is small.
        let inset = width * (0.02 + parted * (0.025 + 0.13 * self.rounded) * (1.0 - 0.3 * round));
        for side in 0..2 {
            let corner = self.corners[side];
            let inward = if side == 0 { inset } else { -inset };
            let share = inset / (0.5 * width);
            let start = Point::new(corner.x + inward, lerp(corner.y, between.y, 0.8 * share));
            let edge = |lip: usize| {
                let middle = self.inner[lip];
                let open = open_half(start, middle, round);
                let closed = closed_half(start, middle, width, pout);
                // Cubics of the same x, so a blend of the control points keeps their order.
                std::array::from_fn::<CubicBez, 2, _>(|i| blend(&closed[i], &open[i], parted))
            };
            let (upper, lower) = (edge(0), edge(1));
            let place = |halves: [CubicBez; 2]| {
                if side == 0 { halves } else { [reversed(&halves[1]), reversed(&halves[0])] }
            };
            let (upper, lower) = (place(upper), place(lower));
            let from = 2 * side;
            self.upper_inner[from..from + 2].copy_from_slice(&upper);
            self.lower_inner[from..from + 2].copy_from_slice(&lower);
        }
    }

    fn outer_edges(&mut self, round: f64, sneer: f64) {
        let (width, rounded) = (self.width(), self.rounded);
        let (lean_x, lean_y) = (lerp(0.40, 0.04, rounded), lerp(0.30, 0.56, rounded));
        let level = lerp(0.34, 0.52, rounded);
        let hang = lerp(0.22, 0.08, round);
        let lift = 0.02 * width * (1.0 - round) * (1.0 - sneer);
        let [left, right] = self.corners;
        let [peak_left, peak_right] = self.peaks;
        let slope = |corner: Point, peak: Point| {
            let v = peak - corner;
            CubicBez::new(
                corner,
                corner + Vec2::new(v.x * lean_x, v.y * lean_y),
                peak + Vec2::new(-v.x * level, lift),
                peak,
            )
        };
        let bow = |peak: Point| {
            let by = Vec2::new(0.45 * (self.bow.x - peak.x), 0.0);
            CubicBez::new(peak, peak + by, self.bow - by, self.bow)
        };
        self.upper_edge =
            [slope(left, peak_left), bow(peak_left), reversed(&bow(peak_right)), reversed(&slope(right, peak_right))];
        let hanging = |corner: Point| {
            let v = self.bottom - corner;
            let handle = corner + Vec2::new(v.x * hang, 0.55 * v.y);
            CubicBez::new(corner, handle, self.bottom - Vec2::new(0.55 * v.x, 0.0), self.bottom)
        };
        self.lower_edge = [hanging(left), reversed(&hanging(right))];
    }
}

/// Half an inner edge of an open mouth, from its corner to the middle, in two pieces: nearly straight at `round` 0, a
/// quarter ellipse at 1.
fn open_half(corner: Point, middle: Point, round: f64) -> [CubicBez; 2] {
    let v = middle - corner;
    let whole = CubicBez::new(
        corner,
        corner + Vec2::new(v.x * lerp(0.42, 0.04, round), v.y * lerp(0.62, 0.56, round)),
        middle - Vec2::new(v.x * lerp(0.42, 0.56, round), 0.0),
        middle,
    );
    [whole.subsegment(0.0..0.6), whole.subsegment(0.6..1.0)]
}

/// Half the line between closed lips: down from the corner, a shallow rise, and the small dip under 8.1. A pout bends
/// it up.
fn closed_half(corner: Point, middle: Point, width: f64, pout: f64) -> [CubicBez; 2] {
    let toward = if corner.x < middle.x { -width } else { width };
    let up = 0.035 * width * pout;
    let at = |x: f64, y: f64| Point::new(middle.x + toward * x, middle.y + width * y);
    let joint = at(0.144, -0.008) - Vec2::new(0.0, 0.5 * up);
    [
        CubicBez::new(
            corner,
            Point::new(corner.x - toward * 0.12, lerp(corner.y, middle.y, 0.5)),
            at(0.24, -0.012) - Vec2::new(0.0, up),
            joint,
        ),
        CubicBez::new(joint, at(0.072, -0.006), at(0.048, 0.008), at(0.0, 0.010)),
    ]
}

fn blend(a: &CubicBez, b: &CubicBez, t: f64) -> CubicBez {
    CubicBez::new(a.p0.lerp(b.p0, t), a.p1.lerp(b.p1, t), a.p2.lerp(b.p2, t), a.p3.lerp(b.p3, t))
}

fn reversed(c: &CubicBez) -> CubicBez {
    CubicBez::new(c.p3, c.p2, c.p1, c.p0)
}
