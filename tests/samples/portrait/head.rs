//! The head as a distance: the skull with nose, lips, lids, folds and ears on it, and the balls of the eyes in it.

use std::sync::Arc;

use crate::act::Act;
use crate::curve::Curve;
use crate::flesh::Flesh;
use crate::hair::hairline;
use crate::noise::grain;
use crate::person::Person;
use crate::skull::{CENTRE, Skull};
use crate::vector::{V, ball, carve, join, limb, mix, smooth, spot};

/// The ball that carries the lids. It is larger than an eye's (18 units): lids cover it from corner to corner.
pub const EYE: V = V(47.5, 1.0, 95.0);
pub const EYE_RADIUS: f32 = 26.0;
pub const IRIS: f32 = 8.4;

/// What a mouth has opened.
pub const GAPE: f32 = 31.0;

/// The lines of the face, right half: x from the midline or the inner corner outwards.
#[derive(Clone)]
pub struct Lines {
    pub lid_upper: Curve,
    pub lid_lower: Curve,
    pub crease: Curve,
    pub brow_upper: Curve,
    pub brow_lower: Curve,
    pub lip_upper: Curve,
    pub lip_line: Curve,
    pub lip_lower: Curve,
    pub hairline: Curve,
}

pub struct Head {
    pub person: Person,
    pub skull: Arc<Skull>,
    pub lines: Lines,
    /// What it does.
    pub act: Act,
    /// Its moved flesh; none of a face at rest.
    flesh: Option<Flesh>,
}

impl Lines {
    fn of(person: &Person) -> Lines {
        let h = person.lip_height;
        let lift = person.brow_lift;
        let up = |y: f32| 102.2 + (y - 102.2) * h;
        let brow = |points: [(f32, f32); 6]| {
            let flat = |x: f32| 7.0 * (1.0 - person.arch) * spot((x - 63.0) / 22.0);
            Curve::through(&points.map(|(x, y)| (x, y - lift + flat(x))))
        };
        Lines {
            lid_upper: Curve::through(&[
                (25.4, 6.0),
                (29.5, 2.2),
                (35.5, -3.2),
                (42.0, -5.6 + person.droop),
                (49.0, -6.6 + person.droop),
                (56.0, -5.5 + person.droop),
                (61.5, -2.6),
                (66.8, 2.4),
            ]),
            lid_lower: Curve::through(&[
                (25.4, 6.0),
                (30.0, 6.9),
                (37.0, 8.3),
                (47.0, 9.4),
                (55.0, 8.9),
                (61.0, 6.8),
                (66.8, 2.4),
            ]),
            crease: Curve::through(&[(28.0, -3.0), (36.0, -10.0), (48.0, -13.2), (60.0, -10.8), (71.0, -2.5)]),
            brow_upper: brow([
                (21.0, -26.5),
                (30.0, -30.2),
                (46.0, -32.0),
                (62.0, -34.0),
                (76.0, -29.0),
                (90.0, -15.5),
            ]),
            brow_lower: brow([
                (21.0, -20.0),
                (30.0, -22.2),
                (46.0, -24.0),
                (62.0, -26.8),
                (76.0, -24.0),
                (90.0, -14.5),
            ]),
            lip_upper: Curve::through(&[
                (0.0, up(92.4)),
                (4.5, up(91.2)),
                (10.5, up(89.6)),
                (17.0, up(91.6)),
                (26.0, up(96.6)),
                (38.0, 103.2),
            ]),
            lip_line: Curve::through(&[(0.0, 102.8), (5.0, 102.0), (13.0, 101.8), (24.0, 102.5), (38.0, 103.4)]),
            hairline: hairline(person.cut),
            lip_lower: Curve::through(&[
                (0.0, up(117.4)),
                (9.0, up(117.0)),
                (18.0, up(115.0)),
                (28.0, up(110.6)),
                (38.0, 103.8),
            ]),
        }
    }

    /// With the lids as the muscles have them.
    fn with_lids(mut self, act: &Act) -> Lines {
        let rest = self.clone();
        let wide = |x: f32| (1.0 - ((x - 46.0) / 21.0).powi(2)).max(0.0).sqrt();
        let upper = |x: f32| rest.lid_upper.at(x) + act.lid_upper * wide(x);
        let lower = |x: f32| rest.lid_lower.at(x) - act.lid_lower * wide(x);
        // Closed lids meet low.
        let meet = |x: f32| mix(lower(x), upper(x), 0.14);
        self.lid_upper = rest.lid_upper.altered(|x, _| mix(upper(x), meet(x), act.closed));
        self.lid_lower = rest.lid_lower.altered(|x, _| mix(lower(x), meet(x), act.closed));
        let follows = 0.45 * act.lid_upper + 3.0 * act.closed;
        self.crease = rest.crease.altered(|_, y| y + follows);
        self
    }

    /// Signed distance in the picture's plane from the opening between the lids; negative within.
    pub fn aperture(&self, x: f32, y: f32) -> f32 {
        let (a, b) = (-self.lid_upper.below(x, y), self.lid_lower.below(x, y));
        a.max(b).max(self.lid_upper.from - x).max(x - self.lid_upper.to)
    }

    /// 1 on the lips, 0 on the skin around them, with an edge about `soft` wide.
    pub fn on_lips(&self, x: f32, y: f32, soft: f32) -> f32 {
        let (a, b) = (self.lip_upper.below(x, y), -self.lip_lower.below(x, y));
        smooth(-soft, soft, a.min(b)) * smooth(39.5, 36.5, x)
    }
}

impl Head {
    pub fn new(person: Person) -> Head {
        let skull = Skull::through(&person.points(), 2e-5);
        let lines = Lines::of(&person);
        Head { person, skull: Arc::new(skull), lines, act: Act::default(), flesh: None }
    }

    /// The same head with its face moved.
    pub fn doing(&self, act: Act) -> Head {
        let flesh = Some(Flesh::new(act, &self.lines.lip_line));
        let lines = Lines::of(&self.person).with_lids(&act);
        Head { person: self.person.clone(), skull: Arc::clone(&self.skull), lines, act, flesh }
    }

    /// How far the mouth is open, in units.
    pub fn gape(&self) -> f32 {
        GAPE * self.person.open + self.flesh.as_ref().map_or(0.0, Flesh::gape)
    }

    /// How far the lower teeth and the tongue have come down.
    fn jaw(&self) -> f32 {
        GAPE * self.person.open + self.act.jaw + 0.35 * self.act.lower
    }

    /// How far within the hairline a place on the head lies; negative on the face and the neck.
    pub fn within_hairline(&self, p: V) -> f32 {
        self.lines.hairline.at(p.0.abs().atan2(p.2 - CENTRE.2)) - p.1
    }

    /// How far the lower lip has left the upper one at `x`.
    pub fn gap(&self, x: f32) -> f32 {
        let u = x / 35.0;
        GAPE * self.person.open * (1.0 - u * u).max(0.0).sqrt()
    }

    /// Where the flesh at `p` would be if the face were even and the mouth closed.
    pub fn rest(&self, p: V) -> V {
        // Nobody is symmetric: the midline sways and one side lies a little lower.
        let mut q = Head::even(p);
        let open = self.person.open;
        let line = 102.4;
        if open > 0.0 && q.1 > line {
            let gap = self.gap(q.0.abs());
            let drop = GAPE * 0.9 * open * smooth(-10.0, 80.0, q.2);
            let below = q.1 - line;
            q.1 -= below.min(gap) + (drop - gap.min(drop)) * smooth(gap, gap + 62.0, below);
        }
        match &self.flesh {
            Some(flesh) => flesh.back(q),
            None => q,
        }
    }

    /// Where the skin's pattern at a place on this face is taken from: it moves with the flesh.
    pub fn pattern(&self, p: V) -> V {
        if self.flesh.is_some() { self.rest(p) } else { p }
    }

    /// The place on the even face, moved as this one, of a place `p` on this face.
    fn even(p: V) -> V {
        let front = smooth(20.0, 100.0, p.2);
        let mut q = p;
        q.0 += front * (0.9 * (p.1 * 0.021 + 1.0).sin() - 0.5);
        q.1 += front * (0.012 * p.0 + 0.8 * (p.0 * 0.03 + p.1 * 0.01).sin());
        q
    }

    /// The place on this face of a place `q` on the even face: the inverse of [`Head::rest`] for a closed mouth.
    pub fn sway(&self, q: V) -> V {
        let q = self.flesh.as_ref().map_or(q, |f| f.forth(q));
        let mut p = q;
        for _ in 0..3 {
            p = p + (q - Head::even(p));
        }
        p
    }

    /// Signed distance from the skin of the head; a little less than true where the form is steep.
    pub fn distance(&self, p: V) -> f32 {
        let (q, mut d);
        if self.flesh.is_some() {
            q = self.rest(p);
            d = self.skull.distance(q);
            if d > 45.0 {
                return d - 25.0;
            }
            // Beside the nose nothing stands out by more than lips.
            let x = q.0.abs();
            if d > 16.0 && x < 76.0 && (x > 36.0 || q.1 < -30.0 || q.1 > 84.0) {
                return d - 11.0;
            }
        } else {
            let far = self.skull.distance(p);
            if far > 45.0 {
                return far - 25.0;
            }
            q = self.rest(p);
            d = self.skull.distance(q);
        }
        let f = q.folded();
        if q.2 > 60.0 && q.1 > -50.0 && q.1 < 175.0 {
            if f.0 < 42.0 && q.1 < 90.0 {
                d = self.nose(f, d);
            }
            if q.1 < 30.0 && f.0 > 12.0 {
                d = self.lids(f, d);
            }
            if q.1 > 66.0 {
                d = self.mouth(f, d, p);
            }
            d -= self.folds(f);
            if self.flesh.is_some() {
                d -= self.worked(f);
                if q.1 > 74.0 {
                    d = self.opened(Head::even(p), d);
                }
            }
        }
        if f.0 > 78.0 {
            d = self.ear(f, d);
        }
        d
    }

    fn nose(&self, p: V, d: f32) -> f32 {
        let w = self.person.nose;
        let mut n = limb(p, V(0.0, -12.0, 131.5), V(0.0, 40.0, 150.0), 6.0, 7.6);
        n = join(n, limb(p, V(4.0, 16.0, 127.0), V(9.0 * w, 50.0, 138.0), 8.0, 9.5), 14.0);
        let mut nose = join(d, n, 19.0);
        let tip = ball(p, V(0.0, 50.0, 150.0), V(12.5 * w, 11.0, 12.5));
        let lobe = ball(p, V(4.5 * w, 51.0, 152.0), V(8.0, 8.5, 8.5));
        nose = join(nose, join(tip, lobe, 5.0), 9.0);
        let wing = ball(p, V(18.2 * w, 56.5, 139.0), V(8.3 * w, 9.6, 12.0));
        nose = join(nose, wing, 6.5);
        let pillar = limb(p, V(0.0, 61.0, 150.0), V(0.0, 68.5, 138.0), 4.2, 5.0);
        nose = join(nose, pillar, 5.0);
        let hole = ball(p, V(9.6 * w, 65.5, 146.0), V(5.2 * w, 5.2, 9.0));
        carve(nose, hole, 3.0)
    }

    fn lids(&self, p: V, d: f32) -> f32 {
        let l = &self.lines;
        let shell = (p - EYE).len() - EYE_RADIUS - 2.4;
        let mut lid = join(d, shell, 7.0);
        // The fold over the lid, and the soft skin that hangs above it.
        let c = l.crease.below(p.0, p.1);
        let along = smooth(25.0, 32.0, p.0) * smooth(76.0, 64.0, p.0);
        lid += along * (2.0 * spot(c / 1.5) - 1.4 * spot((c + 5.0) / 4.5));
        // Under the eye: a soft bag and its lower edge.
        let low = l.lid_lower.below(p.0, p.1);
        let under = smooth(26.0, 36.0, p.0) * smooth(70.0, 58.0, p.0);
        lid +=
            under * (0.4 * spot((low - 2.2) / 1.2) - 0.4 * spot((low - 4.8) / 2.4) + 0.25 * spot((low - 10.0) / 3.5));
        if p.2 > EYE.2 { carve(lid, l.aperture(p.0, p.1), 1.6) } else { lid }
    }

    fn mouth(&self, p: V, d: f32, true_place: V) -> f32 {
        let l = &self.lines;
        let x = p.0;
        let mut d = d;
        // The groove under the nose, between two ridges.
        let above = smooth(67.0, 72.0, p.1) * smooth(93.0, 86.0, p.1);
        d += above * (1.2 * spot(x / 3.6) - 0.6 * spot((x - 6.8) / 3.0));
        if x < 46.0 && p.1 < 135.0 {
            let u = (x / 39.0).min(1.0);
            let taper = (1.0 - u * u).sqrt();
            let (top, line, low) = (l.lip_upper.at(x), l.lip_line.at(x), l.lip_lower.at(x));
            let full = 0.5 + 0.5 * self.person.lip_height;
            let mut out = 0.0;
            if p.1 > top - 3.0 && p.1 < line + 0.5 {
                let t = (p.1 - top) / (line - top).max(1.0);
                // The border rises at once, the tubercle in the middle hangs forward.
                let swell = smooth(-0.25, 0.75, t) * (1.0 - 0.75 * smooth(0.72, 1.05, t));
                out = (4.3 + 1.3 * spot(x / 6.0)) * swell * taper * full;
            } else if p.1 >= line {
                let t = (p.1 - line) / (low - line).max(1.0);
                let swell = smooth(-0.1, 0.38, t) * smooth(1.25, 0.5, t);
                out = (5.4 - 0.8 * spot(x / 5.0)) * swell * taper.powf(0.8) * full;
            }
            d -= out;
            let seam = spot(l.lip_line.below(x, p.1) / 1.1) * smooth(40.5, 36.0, x);
            d += 2.3 * seam;
            // Fine lines across the lips.
            if out > 0.5 && (self.flesh.is_none() || d < 3.0) {
                d += 0.16 * grain(V(true_place.0 * 0.75 + 0.02 * true_place.0 * (p.1 - 102.0), p.1 * 0.10, 7.0));
            }
        }
        // The corner sinks in.
        d += 1.8 * spot((x - 40.0) / 4.0) * spot((p.1 - 104.5) / 4.0);
        if self.person.open > 0.0 {
            let (y, gap) = (true_place.1, self.gap(x));
            let line = l.lip_line.at(x);
            let cut = ((line - y).max(y - line - gap) * 0.8).max(x - 35.0);
            let hollow = cut.max(84.0 - true_place.2);
            d = carve(d, hollow, 3.0);
        }
        d
    }

    /// The mouth opened by the flesh's moves, cut out of `d`; `p` is a place of the moved even face.
    fn opened(&self, p: V, d: f32) -> f32 {
        let Some(flesh) = &self.flesh else { return d };
        let x = p.0.abs();
        let (up, low) = flesh.edges(x);
        let gap = low - up;
        if gap < 0.25 || x > flesh.corner() {
            return d;
        }
        let cut = ((up - p.1).max(p.1 - low) * 0.8).max(x - flesh.corner());
        carve(d, cut.max(84.0 - p.2), (0.5 * gap).clamp(0.3, 2.4))
    }

    /// What the muscles do to the skin itself: folds, cheeks, lips pushed out. How far they lift it.
    fn worked(&self, p: V) -> f32 {
        let a = &self.act;
        let (x, y) = (p.0, p.1);
        let mut out = 0.0;
        if y < -34.0 {
            let lines = spot((y + 50.0) / 2.2) + spot((y + 63.0 + 0.02 * x) / 2.2) + 0.7 * spot((y + 76.0) / 2.2);
            out -= 0.9 * a.forehead * lines * smooth(80.0, 40.0, x);
        } else if y < 12.0 {
            let line = spot((x - 7.0 - 0.08 * (y + 24.0)) / 1.6) * smooth(-44.0, -34.0, y) * smooth(-8.0, -18.0, y);
            let bulge = spot((x - 13.0) / 4.5) * spot((y + 24.0) / 10.0);
            out += a.frown * (1.0 * bulge - 1.5 * line);
            let across = spot((y + 8.0) / 1.6) + spot((y + 2.0) / 1.6) + 0.7 * spot((y - 4.5) / 1.6);
            out -= 0.9 * a.wrinkle * across * smooth(16.0, 8.0, x);
        } else {
            out += 0.55 * a.cheek * spot(((x - 58.0) / 17.0).hypot((y - 44.0) / 13.0));
            out += 3.0 * a.pout * spot((x / 30.0).hypot((y - 103.0) / 20.0));
        }
        out
    }

    /// How far folds lift (or, negative, sink) the skin.
    fn folds(&self, p: V) -> f32 {
        let a = self.person.folds + 1.5 * self.act.crease;
        // From the wing of the nose to beside the mouth.
        let line = |p: V, from: (f32, f32), to: (f32, f32)| {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let l = (dx * dx + dy * dy).sqrt();
            let t = ((p.0 - from.0) * dx + (p.1 - from.1) * dy) / (l * l);
            let across = ((p.0 - from.0) * dy - (p.1 - from.1) * dx) / l;
            (t, across)
        };
        let (t, across) = line(p, (29.0, 58.0), (50.0, 101.0));
        let along = smooth(-0.05, 0.2, t) * smooth(1.1, 0.5, t);
        let mut out = a * along * (1.3 * spot((across - 6.0) / 6.0) - 1.1 * spot(across / 2.4));
        // The trough from the inner corner of the eye.
        let (t, across) = line(p, (26.0, 10.0), (52.0, 29.0));
        out -= (0.4 + 0.4 * a) * smooth(-0.1, 0.25, t) * smooth(1.15, 0.5, t) * spot(across / 3.4);
        // The crease round the wing of the nose.
        let w = self.person.nose;
        let round = ((p.0 - 18.0 * w) / 10.0 / w).hypot((p.1 - 56.0) / 10.5);
        out - 0.7 * spot((round - 1.03) / 0.2) * smooth(16.0, 22.0, p.0) * smooth(40.0, 50.0, p.1)
    }

    fn ear(&self, p: V, d: f32) -> f32 {
        let q = p - V(99.0, 34.0, 4.0);
        let back = V(0.50, -0.10, -0.86);
        let out = V(0.86, 0.0, 0.50);
        let (a, b, c) = (q.dot(back), q.1 + 0.08 * q.0, q.dot(out));
        let wide = 26.0 - 4.0 * smooth(-5.0, 40.0, b) - 2.0 * smooth(-20.0, -44.0, b);
        // Rounder below than an oval: the lobe.
        let (u, v) = (((a - 19.0) / wide).abs(), (b + 1.0) / 41.0);
        let round = if v > 0.0 { (u.powi(3) + v.powi(3)).cbrt() } else { u.hypot(v) };
        if round > 2.0 || c.abs() > 40.0 {
            return d;
        }
        let helix = 5.0 * spot((round - 0.87) / 0.13) * smooth(36.0, 12.0, b);
        let inner = 4.0 * spot((round - 0.50) / 0.16) * smooth(2.0, 14.0, a) * smooth(30.0, 14.0, b);
        let bowl = 9.0 * spot(((a - 12.0) / 10.0).hypot((b - 8.0) / 14.0));
        let sheet = (c - 3.0 - helix - inner + bowl).abs() - 3.0;
        let ear = -join(-sheet, -(round - 1.0) * 18.0, 5.0);
        let lug = ball(p, V(104.0, 38.0, 14.0), V(6.0, 8.0, 7.0));
        join(join(d, ear * 0.75, 7.0), lug, 5.0)
    }

    /// Signed distance from the balls of the eyes.
    pub fn eyes(&self, p: V) -> f32 {
        (self.rest(p).folded() - EYE).len() - EYE_RADIUS
    }

    /// Signed distance from the teeth.
    pub fn teeth(&self, p: V) -> f32 {
        if self.gape() <= 0.0 {
            return f32::MAX;
        }
        let f = p.folded();
        let arch = (f.0 / 34.0).hypot((p.2 - 92.0) / 36.0);
        let gap = 0.35 * spot((f.0 - (f.0 / 8.2).round() * 8.2) / 0.5);
        let row = (arch - 1.0) * 30.0 + gap;
        let mut teeth = row.max(p.1 - 108.5 + 0.03 * f.0).max(92.0 - p.1);
        if self.flesh.is_some() {
            // The lower row stands a little behind the upper one.
            let top = 107.0 + self.jaw();
            let arch = (f.0 / 31.0).hypot((p.2 - 92.0) / 33.0);
            let gap = 0.35 * spot((f.0 - (f.0 / 6.0).round() * 6.0) / 0.5);
            teeth = teeth.min(((arch - 1.0) * 28.0 + gap).max(top - p.1).max(p.1 - top - 14.0));
        }
        teeth * 0.8
    }

    /// Signed distance from the tongue.
    pub fn tongue(&self, p: V) -> f32 {
        if self.gape() <= 0.0 {
            return f32::MAX;
        }
        ball(p, V(0.0, 102.0 + self.jaw() + 6.0, 100.0), V(26.0, 15.0, 26.0)) * 0.8
    }
}
