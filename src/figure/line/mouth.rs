//! The mouth of a line figure: the emotion's own, and on top of it what speech does.
//!
//! A table of seven drawings has no spoken mouths. They come from a model mouth, two cubics a lip from the middle to
//! each corner, that any shape sets by the moves of its four control points (thesis 5.2.3) away from where the
//! emotion has them; the figure's lip lines are then pieces of the model.

use super::lips::{closed_between, crossing, edge, mid_x, seated};
use super::{Line, LineFigure};
use crate::disk::{Fault, Result};
use crate::drawing::Item;
use crate::geometry::{
    Affine, BezPath, CubicBez, Ellipse, Knot, ParamCurve, ParamCurveDeriv, Point, Rect, Ribbon, Shape, Vec2, hermite,
    lerp,
};
use crate::pose::MouthPose;

/// How much of the emotion's own opening stays while a syllable is spoken. All of it, added to an open vowel, would
/// shout; none would lose a grin.
const EMOTION_WHILE_SPEAKING: f64 = 0.3;

/// The narrowest half mouth, as a share of MW0: an *u* of a pursed mouth is still a mouth.
const NARROWEST: f64 = 0.11;

/// An opening below this share of M is hidden under the ink of the lips.
const SLIVER: f64 = 0.05;

/// How far *f* lifts the upper lip off the lower one, in M, to show the teeth that stand on it.
const BITE: f64 = 0.17;

/// The mouth of a figure and its units.
#[derive(Debug, Clone)]
pub(super) struct Mouth {
    /// Lines of each lip from the image's left to its right.
    upper: Vec<usize>,
    lower: Vec<usize>,
    /// For every line of the mouth, where its four control points lie on the model.
    seats: Vec<Seat>,
    centre: Point,
    /// MW0 and M of the neutral mouth (thesis 4.4.1; recipe: M = max(MNS0, .33 MW0)).
    width: f64,
    unit: f64,
}

/// A line's place on the model: the model's parameters at its two ends, −1 the left corner, 0 the middle, 1 the right.
#[derive(Debug, Clone)]
struct Seat {
    line: usize,
    upper: bool,
    from: f64,
    to: f64,
}

/// Where the emotion has its mouth.
struct Frame {
    /// Between the corners, between the lips.
    origin: Point,
    /// Half the distance of the corners.
    half: f64,
    /// The corners' height below the origin.
    corner: f64,
    /// How far the emotion alone parts the lips.
    opening: f64,
}

/// The model set to one mouth, relative to a frame's origin, y down.
struct Model {
    /// From the middle to the right corner.
    upper: CubicBez,
    lower: CubicBez,
}

impl Mouth {
    pub(super) fn new(
        upper: Vec<usize>,
        lower: Vec<usize>,
        nose: Point,
        neutral: &[Knot],
        lines: &[Line],
    ) -> Result<Self> {
        let points = || upper.iter().chain(&lower).flat_map(|l| lines[*l].points).map(|p| neutral[p].point());
        let left = points().map(|p| p.x).fold(f64::INFINITY, f64::min);
        let right = points().map(|p| p.x).fold(f64::NEG_INFINITY, f64::max);
        let lip = upper.iter().flat_map(|l| lines[*l].points).map(|p| neutral[p].y).fold(f64::INFINITY, f64::min);
        let bottom = points().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
        let width = right - left;
        if !(width > 0.0 && width.is_finite() && lip > nose.y) {
            return Err(Fault::new("the mouth has no width, or lies above its `nose`")
                .help("give `upper`, `lower` and the base of the nose, which lies above the lips"));
        }
        let mut mouth = Self {
            upper,
            lower,
            seats: Vec::new(),
            centre: Point::new(f64::midpoint(left, right), f64::midpoint(lip, bottom)),
            width,
            // The recipe's M = max(MNS0, .33 MW0), and not above .40 MW0: a line face's long upper lip would open
            // its vowels down to the chin.
            unit: (lip - nose.y).clamp(0.33 * width, 0.40 * width),
        };
        let rest = mouth.model(&MouthPose::REST, &mouth.neutral_frame());
        for (list, is_upper) in [(&mouth.upper, true), (&mouth.lower, false)] {
            for line in list {
                let ends = lines[*line].points;
                let seat = |p: usize| rest.parameter_at(neutral[p].x - mouth.centre.x);
                mouth.seats.push(Seat { line: *line, upper: is_upper, from: seat(ends[0]), to: seat(ends[3]) });
            }
        }
        Ok(mouth)
    }

    /// The model mouth of a pose in a frame, relative to the frame's origin. The curves are the recipe's: nearly
    /// straight where closed, rounder the further it opens and the narrower it gets.
    fn model(&self, mouth: &MouthPose, frame: &Frame) -> Model {
        let parting = mouth.parting();
        // A mouth that was measured has the emotion's opening and width in it already.
        let measured = (mouth.speaking - 1.0).clamp(0.0, 1.0);
        let kept = 0.5 * EMOTION_WHILE_SPEAKING * frame.opening * (1.0 - mouth.closure) * (1.0 - measured);
        let upper = (mouth.upper * parting - BITE * mouth.bite) * self.unit - kept;
        let lower = mouth.lower * parting * self.unit + kept;
        // A mouth that the emotion has narrowed already gives way less to a rounded vowel.
        let wide = lerp(frame.half, 0.5 * self.width, measured);
        let narrowing = mouth.corner_in * self.width * (2.0 * wide / self.width).min(1.0).powi(2);
        let half = (wide - narrowing).max(NARROWEST * self.width);
        let narrowed = ((1.0 - 2.0 * half / self.width) / 0.34).clamp(0.0, 1.0);
        let gap = (lower - upper).max(0.0);
        let mut round = (1.9 * gap / (2.0 * half)).clamp(0.0, 1.0);
        if gap > SLIVER * self.unit {
            round = round.max(narrowed);
        }
        // Pursed lips gather: a rounded vowel has no room for the emotion's raised or hanging corners.
        let gathered = (mouth.corner_in / 0.22).clamp(0.0, 1.0);
        let corner = Point::new(half, frame.corner * (1.0 - 0.6 * gathered) + mouth.corner_down * self.unit);
        let lip = |middle: f64, round: f64| {
            let rise = middle - corner.y;
            CubicBez::new(
                Point::new(0.0, middle),
                Point::new(lerp(0.42, 0.56, round) * half, middle),
                corner + Vec2::new(-lerp(0.42, 0.04, round) * half, lerp(0.62, 0.56, round) * rise),
                corner,
            )
        };
        Model { upper: lip(upper, 0.85 * round), lower: lip(lower, round) }
    }

    /// Brings speech into blended points. Where a syllable is spoken the lips are the model's, set in the emotion's
    /// own frame: its corners, its width, the line between its lips; at rest they are the table's.
    pub(super) fn speak(&self, knots: &mut [Knot], neutral: &[Knot], mouth: &MouthPose, lines: &[Line]) {
        let spoken = mouth.speaking.max(mouth.closure).clamp(0.0, 1.0);
        if spoken == 0.0 {
            return;
        }
        let frame = self.frame_of(knots, lines);
        let model = self.model(mouth, &frame);
        // What is the figure's own about its closed lips, such as a cat's, goes as the lips part.
        let own = (1.0 - 2.0 * mouth.opening()).max(0.0);
        let level = self.model(&MouthPose::REST, &self.neutral_frame());
        let mut placed = vec![false; knots.len()];
        for seat in &self.seats {
            let (piece, level) = (model.piece(seat), level.piece(seat));
            for ((place, level), p) in piece.into_iter().zip(level).zip(lines[seat.line].points) {
                // Corners belong to both lips and are placed once.
                if std::mem::replace(&mut placed[p], true) {
                    continue;
                }
                let knot = &mut knots[p];
                let character = (neutral[p].point() - self.centre - level.to_vec2()) * own;
                let place = frame.origin + place.to_vec2() + character;
                knot.x = lerp(knot.x, place.x, spoken);
                knot.y = lerp(knot.y, place.y, spoken);
                // Closed lips are one firm line, as neutral ones are; parted ones thin out.
                knot.w = lerp(knot.w, neutral[p].w * (1.0 - 0.3 * mouth.opening().min(1.0)), spoken);
            }
        }
    }

    fn neutral_frame(&self) -> Frame {
        Frame { origin: self.centre, half: 0.5 * self.width, corner: 0.0, opening: 0.0 }
    }

    /// Corners, width and opening of the emotion's mouth.
    fn frame_of(&self, knots: &[Knot], lines: &[Line]) -> Frame {
        let end = |line: usize, i: usize| knots[lines[line].points[i]].point();
        let corner = |line: usize, right: bool| {
            let (a, b) = (end(line, 0), end(line, 3));
            if (a.x > b.x) == right { a } else { b }
        };
        let (left, right) = match (self.upper.first(), self.upper.last()) {
            (Some(first), Some(last)) => (corner(*first, false), corner(*last, true)),
            _ => (self.centre, self.centre),
        };
        // Where each lip's middle is: the mean of its lines' heights at their innermost ends, weighted by nothing,
        // for figures draw their lips level there.
        let middle = |list: &[usize]| {
            let inner = |line: &usize| {
                let (a, b) = (end(*line, 0), end(*line, 3));
                if (a.x - self.centre.x).abs() < (b.x - self.centre.x).abs() { a.y } else { b.y }
            };
            list.iter().map(inner).sum::<f64>() / list.len().max(1) as f64
        };
        let (above, below) = (middle(&self.upper), middle(&self.lower));
        // Lips that close under an open expression meet where neutral ones do, as far as that lies between them.
        let meet = self.centre.y.clamp(above.min(below), below.max(above));
        let origin = Point::new(f64::midpoint(left.x, right.x), meet);
        Frame {
            origin,
            half: 0.5 * (right.x - left.x).abs(),
            corner: f64::midpoint(left.y, right.y) - origin.y,
            opening: (below - above).max(0.0),
        }
    }

    /// x of the mouth's middle, which is the face's.
    pub(super) fn middle(&self) -> f64 {
        self.centre.x
    }

    pub(super) fn has(&self, line: usize) -> bool {
        self.seats.iter().any(|s| s.line == line)
    }

    /// The mouth back to front: inside, tongue, teeth, lips.
    pub(super) fn draw(&self, figure: &LineFigure, knots: &[Knot], mouth: &MouthPose) -> Vec<Item> {
        let lip = |list: &[usize]| seated(list.iter().map(|l| figure.ribbon(*l, knots)).collect());
        let (upper, lower) = (lip(&self.upper), lip(&self.lower));
        let (top, bottom) = (edge(&upper), edge(&lower));
        let mut items = Vec::new();
        let middle = |curves: &[CubicBez]| crossing(curves, mid_x(&top));
        if let (Some(above), Some(below)) = (middle(&top), middle(&bottom)) {
            let gap = below - above;
            if gap > SLIVER * self.unit {
                items.extend(self.inside(figure, &top, &bottom, (above, below), mouth));
            }
        }
        for (name, lines, strokes) in [("upper-lip", &self.upper, upper), ("lower-lip", &self.lower, lower)] {
            let ink =
                |(line, stroke): (&usize, Ribbon)| figure.ink(&figure.lines[*line].name, &[stroke], figure.colours.ink);
            items.push(Item::moved(name, Affine::IDENTITY, lines.iter().zip(strokes).map(ink).collect()));
        }
        items
    }

    fn inside(
        &self,
        figure: &LineFigure,
        top: &[CubicBez],
        bottom: &[CubicBez],
        (above, below): (f64, f64),
        mouth: &MouthPose,
    ) -> Option<Item> {
        let opening = closed_between(top, bottom);
        let (left, right) = (top.first()?.p0.x, top.last()?.p3.x);
        let (x, width, gap) = (f64::midpoint(left, right), right - left, below - above);
        let colours = &figure.colours;
        let hole = Item::area("mouth-inside", opening.clone(), colours.mouth);
        // Tongue and teeth by the recipe's part 4; a raised tongue (n) stands higher and closer.
        let rise = lerp(1.0, 0.72, mouth.tongue);
        let tongue = Ellipse::new(
            Point::new(x, above + rise * gap),
            (0.29 * width, lerp((0.52 * gap).min(0.22 * width), 0.5 * gap, mouth.tongue) * 0.8),
            0.0,
        );
        let mut deep = (0.42 * gap).max(3.2).min(0.105 * self.width);
        if width < 0.68 * self.width {
            deep *= 0.55;
        }
        let deep = lerp(deep, gap + 2.0, mouth.bite);
        let band = Rect::new(left, opening.bounding_box().y0 - 2.0, right, above + deep);
        let mut teeth = BezPath::new();
        // The band's lower edge is a flat U: the teeth bend away from the viewer toward the corners.
        teeth.move_to((x - 0.42 * width, band.y0));
        teeth.line_to((x + 0.42 * width, band.y0));
        teeth.line_to((x + 0.40 * width, band.y1 - 0.22 * deep));
        teeth.quad_to((x + 0.36 * width, band.y1), (x + 0.2 * width, band.y1));
        teeth.line_to((x - 0.2 * width, band.y1));
        teeth.quad_to((x - 0.36 * width, band.y1), (x - 0.40 * width, band.y1 - 0.22 * deep));
        teeth.close_path();
        let inner = vec![
            hole,
            Item::area("tongue", tongue.to_path(0.02), colours.tongue),
            Item::area("teeth", teeth, colours.teeth),
        ];
        Some(Item::clipped("mouth-open", opening, inner))
    }
}

impl Model {
    /// The model's parameter where a lip crosses `x`, from −1 at the left corner to 1 at the right one.
    fn parameter_at(&self, x: f64) -> f64 {
        let target = x.abs();
        // A corner is a corner, not nearly one: both lips must reach it at the same place.
        if target >= self.upper.p3.x - 1e-6 {
            return 1f64.copysign(x);
        }
        let (mut low, mut high) = (0.0, 1.0);
        // x grows along a half lip, so halving finds the place; 40 halvings leave 1e-12.
        for _ in 0..40 {
            let t = f64::midpoint(low, high);
            if self.upper.eval(t).x < target { low = t } else { high = t }
        }
        f64::midpoint(low, high).copysign(x)
    }

    /// Place and derivative on a lip at a parameter from −1 to 1.
    fn at(&self, upper: bool, s: f64) -> (Point, Vec2) {
        let curve = if upper { self.upper } else { self.lower };
        let t = s.abs();
        let (p, d) = (curve.eval(t), curve.deriv().eval(t).to_vec2());
        if s < 0.0 { (Point::new(-p.x, p.y), Vec2::new(d.x, -d.y)) } else { (p, d) }
    }

    /// The four control points of the model's piece between a seat's ends. Exact within a half; across the middle,
    /// where both halves run level, a cubic of the same ends and directions.
    fn piece(&self, seat: &Seat) -> [Point; 4] {
        let ((a, da), (b, db)) = (self.at(seat.upper, seat.from), self.at(seat.upper, seat.to));
        let span = seat.to - seat.from;
        let c = hermite(a, da * span, b, db * span);
        [c.p0, c.p1, c.p2, c.p3]
    }
}
