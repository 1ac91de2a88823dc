//! A person's own expressions for the cartoon, from the calibrated shapes.

use super::{Calibration, Source};
use crate::face::FeaturePoint as P;
use crate::face::rig::{EXPRESSION_NUMBERS, Expression, Expressions};
use crate::geometry::Point;
use crate::pose::Emotion;

/// Numbers of an expression that points tell: brows, lids, lips and corners.
const TOLD: [usize; 10] = [0, 1, 2, 3, 4, 5, 8, 9, 10, 11];
/// How much of a drawing's expression is the person's own; the rest is everybody's, so that it stays readable.
const OWN: f64 = 0.6;
/// What is measured is drawn so many times as large, at least and at most.
const LARGER: (f64, f64) = (0.8, 3.0);

impl Calibration {
    /// What the emotions do to the cartoon of this person: the pattern of the person's own moves at a cartoon's size,
    /// blended with everybody's. What points cannot tell (wrinkles, cheeks, pout) is everybody's, and so is all of an
    /// emotion that has no shot.
    #[must_use]
    pub fn expressions(&self) -> Expressions {
        let general = Expressions::general();
        let rest = general.expression(Emotion::Neutral).to_array();
        let list: [Expression; 7] = std::array::from_fn(|i| {
            let emotion = Emotion::ALL[i];
            let usual = general.expression(emotion).to_array();
            if i == 0 || self.shapes()[i].source == Source::Modelled {
                return Expression::from_array(usual);
            }
            // A shape that is doubted counts less.
            let own = match self.shapes()[i].source {
                Source::Found(c) => OWN * (2.0 * c).min(1.0),
                _ => OWN,
            };
            let Some(measured) = self.measured(i) else { return Expression::from_array(usual) };
            let spans = spans();
            // The strongest moves get the size that the cartoon's have, each number against its own span.
            let size = |v: &dyn Fn(usize) -> f64| TOLD.iter().map(|k| (v(*k) / spans[*k]).powi(2)).sum::<f64>().sqrt();
            let theirs = size(&|k| measured[k]);
            let ours = size(&|k| usual[k] - rest[k]);
            let larger = (ours / theirs.max(1e-6)).clamp(LARGER.0, LARGER.1);
            let mut mixed = usual;
            for k in TOLD {
                let moved = rest[k] + (measured[k] * larger).clamp(-spans[k], spans[k]);
                mixed[k] = usual[k] + own * (moved - usual[k]);
            }
            Expression::from_array(mixed)
        });
        Expressions::of(&list)
    }

    /// How each number of an expression differs from neutral in a shape, the mean of both sides; 0 of what points do not
    /// tell. None where the model does not bind the points it takes.
    fn measured(&self, i: usize) -> Option<[f64; EXPRESSION_NUMBERS]> {
        let at = |shape: &[Point], p: P| self.binding().at(shape, p);
        let (rest, now) = (&self.laid()[0], &self.laid()[i]);
        let down = |p: P| Some(at(now, p)?.y - at(rest, p)?.y);
        let both = |a: P, b: P| Some(0.5 * (down(a)? + down(b)?));
        let wide = |shape: &[Point], a: P, b: P| Some(at(shape, a)?.distance(at(shape, b)?));
        let width = wide(rest, P::P8_4, P::P8_3)?.max(1e-3);
        let unit = (at(rest, P::P8_1)?.y - at(rest, P::P9_15)?.y).abs().max(0.33 * width);
        let eye = 0.5 * (wide(rest, P::P3_2, P::P3_4)? + wide(rest, P::P3_1, P::P3_3)?).max(0.04);
        // Lids against the corners of their eye: gaze moves the eyeball's middle, and a nod all.
        let lid = |shape: &[Point], lid: P, inner: P, outer: P| {
            Some(at(shape, lid)?.y - at(shape, inner)?.midpoint(at(shape, outer)?).y)
        };
        let lids = |a: P, b: P| {
            let left = lid(now, a, P::P3_8, P::P3_12)? - lid(rest, a, P::P3_8, P::P3_12)?;
            let right = lid(now, b, P::P3_11, P::P3_7)? - lid(rest, b, P::P3_11, P::P3_7)?;
            Some(0.5 * (left + right))
        };
        let eyes = 0.25 * (down(P::P3_12)? + down(P::P3_8)? + down(P::P3_11)? + down(P::P3_7)?);
        let nose = down(P::P9_15)?;
        let mut out = [0.0; EXPRESSION_NUMBERS];
        out[0] = 0.5 * (wide(rest, P::P4_2, P::P4_1)? - wide(now, P::P4_2, P::P4_1)?);
        out[1] = both(P::P4_2, P::P4_1)? - eyes;
        out[2] = both(P::P4_4A, P::P4_3A)? - eyes;
        out[3] = both(P::P4_6, P::P4_5)? - eyes;
        // 1 is as far above the eyeball's middle as at rest, which is about 0.6 of the eye.
        out[4] = -lids(P::P3_2, P::P3_1)? / (0.6 * eye);
        out[5] = -lids(P::P3_4, P::P3_3)? / eye;
        out[8] = (down(P::P2_2).or_else(|| down(P::P8_1))? - nose) / unit;
        out[9] = (down(P::P2_3).or_else(|| down(P::P8_2))? - nose) / unit;
        out[10] = 0.5 * (wide(now, P::P8_4, P::P8_3)? - width) / width;
        out[11] = (both(P::P8_4, P::P8_3)? - nose) / unit;
        Some(out)
    }
}

/// How far each number goes on everybody's faces: the largest difference to neutral.
fn spans() -> [f64; EXPRESSION_NUMBERS] {
    let general = Expressions::general();
    let rest = general.expression(Emotion::Neutral).to_array();
    std::array::from_fn(|k| {
        let far = |e: &Emotion| (general.expression(*e).to_array()[k] - rest[k]).abs();
        Emotion::ALL.iter().map(far).fold(1e-3, f64::max)
    })
}
