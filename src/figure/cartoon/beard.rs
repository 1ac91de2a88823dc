//! Beards: full, round the mouth, or a moustache, by where the skin was found darker (recipe part 3, layer 7).
//!
//! A beard is drawn before the lips, which lie over it: one that stopped short of them would leave a seam of skin.

use super::dice::Dice;
use super::head::Outline;
use super::{Pen, at};
use crate::drawing::Item;
use crate::face::{Beard, FeaturePoint as P, Points, Units};
use crate::geometry::{BezPath, PathEl, Point, Vec2, brush_in_steps, lerp, spline};

/// Which hair grows on a face, and how thick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Growth {
    /// Along the whole jaw, up to the ears.
    jaw: bool,
    /// On the chin.
    chin: bool,
    /// On the upper lip.
    lip: bool,
    /// How opaque.
    chin_cover: f64,
    lip_cover: f64,
    /// A shaved moustache is a shadow of the skin's own colour.
    faint: bool,
}

impl Growth {
    /// From how much darker the four places are; none where there is no beard. `wanted` draws one all the same.
    pub(super) fn of(dark: &Beard, light_skin: bool, wanted: bool) -> Option<Self> {
        let full = dark.chin > 0.10 || wanted;
        // A nose throws a shadow as dark as a faint moustache; who shaves one has a darker jaw too.
        let shaved = dark.lip > 0.11 && dark.jaw > 0.14;
        if !shaved && !full {
            return None;
        }
        let jaw = dark.cheek > 0.2 && dark.jaw > 0.22 && (0.1..0.28).contains(&dark.lip);
        let darkest = if full { dark.chin.max(if wanted { 0.14 } else { 0.0 }) } else { dark.lip };
        let cover = (3.6 * darkest).clamp(0.22, 0.85);
        let faint = if light_skin { 0.40 } else { 0.28 };
        Some(Self {
            jaw: full && jaw,
            chin: full,
            lip: dark.lip > 0.075 || jaw || wanted,
            chin_cover: 0.95 * cover,
            lip_cover: cover * if dark.lip > 0.2 || wanted { 0.95 } else { faint },
            faint: !(full || dark.lip > 0.2),
        })
    }

    /// The beard on a face in a pose.
    pub(super) fn draw(&self, pen: &Pen, points: &Points, units: &Units, outline: &Outline) -> Vec<Item> {
        let place = Place::of(points, units);
        // Ink has no shade as faint as a shaved lip's.
        if pen.ink_only && self.faint {
            return Vec::new();
        }
        if pen.ink_only {
            return vec![self.stubble(pen, &place, outline)];
        }
        let colour = pen.palette.beard;
        let mut items = Vec::new();
        if self.jaw {
            items.push(Item::area("beard", place.full(outline), colour.faded(self.chin_cover * 0.84)));
            return items;
        }
        if self.chin {
            items.push(Item::area("beard-jaw", place.along_jaw(outline), colour.faded(0.31 * self.chin_cover)));
            items.push(Item::area("beard", place.goatee(), colour.faded(self.chin_cover)));
        }
        if self.lip {
            let colour = if self.faint { pen.palette.hair_tint } else { colour };
            items.push(Item::area("moustache", place.moustache(), colour.faded(self.lip_cover)));
        }
        if self.faint {
            items.push(Item::area("beard-jaw", place.along_jaw(outline), pen.palette.hair_tint.faded(0.20)));
        }
        items
    }

    /// Ticks on a grid, for a drawing in ink.
    fn stubble(&self, pen: &Pen, place: &Place, outline: &Outline) -> Item {
        const GRID: f64 = 5.5;
        let mut dice = Dice(3);
        let mut ink = BezPath::new();
        let (top, bottom) = (place.nose + 0.4 * place.room, place.chin.y);
        let across = outline.half_width(place.corner);
        let (mut y, steps) = (top, (2.0 * across / GRID) as i32);
        while y < bottom - 2.0 {
            for i in 0..steps {
                let x = -across + GRID * f64::from(i) + dice.between(-2.0, 2.0);
                let y = y + dice.between(-2.0, 2.0);
                if self.grows(place, x, y) && x.abs() < outline.half_width(y + 4.0) - 3.0 {
                    let out = x - place.x;
                    let tick = [at(x, y), at(x + 0.03 * out, y + 2.6), at(x + 0.05 * out, y + 5.0)];
                    ink.extend(brush_in_steps(&tick, 0.62 * pen.ink, &[0.6, 1.0, 0.0], 4));
                }
            }
            y += GRID;
        }
        Item::area("beard", ink, pen.palette.beard)
    }

    fn grows(&self, p: &Place, x: f64, y: f64) -> bool {
        let out = (x - p.x).abs();
        let lips = out < 1.16 * p.half && (p.peaks - 3.0..p.lower + 5.0).contains(&y);
        let moustache = self.lip && out < 1.1 * p.half && y < p.corner + 4.0;
        let chin = self.chin && out < 0.8 * p.half && y > p.lower;
        let jaw = self.jaw
            && y > p.corner - 4.0 - 0.35 * (out - 1.2 * p.half).max(0.0)
            && (y > p.lower || out > 1.2 * p.half);
        !lips && (moustache || chin || jaw)
    }
}

/// How much of the mouth's spreading and rounding the hair round it follows.
const FOLLOWS: f64 = 0.4;

/// Where mouth, nose and chin are.
struct Place {
    x: f64,
    /// Half the width of the mouth that the beard follows.
    half: f64,
    corner: f64,
    peaks: f64,
    lower: f64,
    nose: f64,
    /// From nose to lip.
    room: f64,
    chin: Point,
    jaws: [Point; 2],
    jaw_height: f64,
}

impl Place {
    fn of(points: &Points, units: &Units) -> Self {
        let (left, right) = (points[P::P8_4], points[P::P8_3]);
        Self {
            x: left.x.midpoint(right.x),
            half: lerp(units.mouth_width, right.x - left.x, FOLLOWS) / 2.0,
            corner: left.y.midpoint(right.y),
            peaks: points[P::P8_9].y,
            lower: points[P::P8_2].y,
            nose: points[P::P9_15].y,
            room: units.mouth_nose,
            chin: points[P::P2_1],
            jaws: [points[P::P2_14], points[P::P2_13]],
            jaw_height: units.jaw_height,
        }
    }

    /// The left half mirrored to the right about the mouth's middle, and back to the start.
    fn mirrored(&self, left: &[Point]) -> Vec<Point> {
        let right = left.iter().rev().filter(|p| (p.x - self.x).abs() > 1e-6);
        left.iter().copied().chain(right.map(|p| at(2.0 * self.x - p.x, p.y))).collect()
    }

    /// Over the upper lip and round the corners of the mouth.
    fn moustache(&self) -> BezPath {
        let (x, m, y) = (self.x, self.half, self.corner);
        let left = [
            at(x, y),
            at(x - 0.6 * m, y - 0.5),
            at(x - 0.96 * m, y + 2.0),
            at(x - 1.12 * m, y + 0.42 * (self.lower - y) + 2.0),
            at(x - 1.13 * m, y + 3.0),
            at(x - 0.86 * m, y - 0.30 * self.room - 2.0),
            at(x - 0.42 * m, self.nose + 0.36 * self.room),
            at(x, self.nose + 0.46 * self.room),
        ];
        spline(&self.mirrored(&left), true)
    }

    /// Under the lower lip and on the chin.
    fn goatee(&self) -> BezPath {
        let (x, m, y) = (self.x, self.half, self.lower);
        let high = self.chin.y - y;
        let left = [
            at(x, y + 1.0),
            at(x - 5.0, y + 3.0),
            at(x - 5.5, y + 0.22 * high),
            at(x - 0.62 * m, y + 0.42 * high),
            at(x - 0.88 * m, y + 0.72 * high),
            at(x - 0.72 * m, self.chin.y - 3.0),
            at(x - 0.3 * m, self.chin.y - 0.5),
            at(x, self.chin.y),
        ];
        spline(&self.mirrored(&left), true)
    }

    /// The outline's lower part between two points at its sides, and a line above back to its start.
    fn down_to_jaw(outline: &Outline, from: f64, above: &[Point]) -> BezPath {
        let edge: Vec<Point> = outline.lower().into_iter().filter(|p| p.y >= from).collect();
        let mut path = spline(&edge, false);
        if edge.is_empty() {
            return path;
        }
        // The upper line leaves and reaches the edge without a corner's overshoot: it is a spline of its own.
        let mut back = vec![edge[edge.len() - 1]];
        back.extend_from_slice(above);
        back.push(edge[0]);
        path.extend(spline(&back, false).elements().iter().skip(1).copied());
        path.push(PathEl::ClosePath);
        path
    }

    /// From ear to ear under the cheeks, over the upper lip; the lips are let out.
    fn full(&self, outline: &Outline) -> BezPath {
        let (x, m, y) = (self.x, self.half, self.corner);
        let [left, right] = self.jaws;
        let line = [
            at(x - 1.3 * m, y - 12.0),
            at(x - 0.62 * m, self.nose + 0.36 * self.room),
            at(x, self.nose + 0.45 * self.room),
        ];
        let upper: Vec<Point> = [at(right.x - 5.0, self.nose + 4.0), at(0.76 * right.x, y - 6.0)]
            .into_iter()
            .chain(self.mirrored(&line).into_iter().rev())
            .chain([at(0.76 * left.x, y - 6.0), at(left.x + 5.0, self.nose + 4.0)])
            .collect();
        Self::down_to_jaw(outline, self.nose - 10.0, &upper)
    }

    /// A darker jaw, where little grows.
    fn along_jaw(&self, outline: &Outline) -> BezPath {
        let [left, right] = self.jaws;
        let y = self.chin.y;
        let upper = [
            right + Vec2::new(-6.0, 0.0),
            at(0.72 * right.x, y - 0.45 * self.jaw_height),
            at(0.6 * self.half, y - 8.0),
            at(0.0, y - 5.0),
            at(-0.6 * self.half, y - 8.0),
            at(0.72 * left.x, y - 0.45 * self.jaw_height),
            left + Vec2::new(6.0, 0.0),
        ];
        Self::down_to_jaw(outline, left.y.midpoint(right.y) - 20.0, &upper)
    }
}
