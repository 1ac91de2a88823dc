//! A face followed from frame to frame: found again where it is lost, and never taken for found where it is not.

use crate::aam::{Fit, Fitter, Model, Start};
use crate::calibration::Calibration;
use crate::face::find::{Found, find};
use crate::geometry::{Point, Similarity};
use crate::photo::Grey;

/// Follows one face: that of a calibration, by its model.
#[derive(Debug, Clone)]
pub struct Follower<'m> {
    model: &'m Model,
    calibration: &'m Calibration,
    fitter: Fitter<'m>,
    /// The last fit that could be used.
    last: Option<Fit>,
    /// Frames since.
    lost: u32,
    /// How much of the contrast the looks have left over of late.
    usual: f64,
}

/// From this confidence on a fit is used: the model says so of fits with an error of up to 3 % of the pupil distance.
const USABLE: f64 = 0.5;
/// From one frame to the next a face does not grow by more, nor shrink by as much.
const GROWN: f64 = 1.6;
/// The share of the points that must lie in the picture.
const INSIDE: f64 = 0.8;
/// A face's numbers along the modes are no larger than this in their deviations, root mean square. Of a man talking they
/// reach 2.0; flat pictures are fitted by shapes of 2.8 and more.
const FAR: f64 = 2.3;
/// Nothing real is known as exactly: it is a fit to something without contrast.
const TOO_GOOD: f64 = 0.004;
/// A face of which the looks leave over more than this, and so many times as much as of late, is partly hidden.
const STRANGE: f64 = 0.3;
const STRANGER: f64 = 1.9;
/// A picture whose luma spans less shows nothing.
const LEAST_SPAN: u8 = 24;
/// Searching takes longer than anything else. A lost face is searched for in the first frames, then in every few.
const AT_ONCE: u32 = 3;
const EVERY: u32 = 4;
/// After so many frames without a face, in every sixteenth.
const LONG: u32 = 100;
const EVERY_LATER: u32 = 16;

impl<'m> Follower<'m> {
    /// Ready for the first frame. Model and calibration have the same points.
    #[must_use]
    pub fn new(model: &'m Model, calibration: &'m Calibration) -> Self {
        Self { model, calibration, fitter: Fitter::new(model), last: None, lost: 0, usual: 0.0 }
    }

    /// The face in the next frame; none where it is lost.
    pub fn next(&mut self, grey: &Grey) -> Option<&Fit> {
        let fit = if shows_nothing(grey) { None } else { self.seen(grey) };
        match fit.filter(|fit| self.is_itself(fit)) {
            Some(fit) => {
                self.lost = 0;
                self.last = Some(fit);
                self.last.as_ref()
            }
            None => {
                self.lost = self.lost.saturating_add(1);
                None
            }
        }
    }

    /// Whether a face looks as it did of late. What comes before a part of it changes how much of it the model knows from one
    /// frame to the next; light and turning do so slowly, and a lasting change becomes what is usual.
    fn is_itself(&mut self, fit: &Fit) -> bool {
        if self.usual == 0.0 {
            self.usual = fit.residual;
        }
        let strange = fit.residual > STRANGE && fit.residual > STRANGER * self.usual;
        self.usual += if strange { 0.01 } else { 0.1 } * (fit.residual - self.usual);
        !strange
    }

    fn seen(&mut self, grey: &Grey) -> Option<Fit> {
        if let Some(last) = self.last.as_ref().filter(|_| self.lost == 0) {
            let fit = self.fitter.follow(grey, last);
            let grown = fit.q.scale() / last.q.scale();
            if self.is_usable(&fit, grey) && (1.0 / GROWN..GROWN).contains(&grown) {
                return Some(fit);
            }
        }
        // Whatever hid it may be gone from where it was; and a face that was calibrated in this video is where it was then.
        let place = self.last.as_ref().map_or(&self.calibration.shapes()[0].points, |l| &l.points);
        let fit = self.fitter.fit(grey, Start::Points(place));
        if self.is_usable(&fit, grey) {
            return Some(fit);
        }
        let every = if self.lost < LONG { EVERY } else { EVERY_LATER };
        if self.lost >= AT_ONCE && !self.lost.is_multiple_of(every) {
            return None;
        }
        let start = self.start(&find(&grey.to_photo(), &[]).ok()?)?;
        let fit = self.fitter.fit(grey, Start::Points(&start));
        self.is_usable(&fit, grey).then_some(fit)
    }

    /// Whether a fit is that of a face: one that the model trusts, in the picture, of a shape that it knows.
    fn is_usable(&self, fit: &Fit, grey: &Grey) -> bool {
        let (w, h) = (grey.width() as f64, grey.height() as f64);
        let inside = fit.points.iter().filter(|p| (0.0..w).contains(&p.x) && (0.0..h).contains(&p.y)).count();
        let deviations = self.model.shapes().deviations().iter().map(|d| f64::from(*d).max(1e-12));
        let squares: f64 = fit.p.iter().zip(deviations).map(|(p, d)| (p / d).powi(2)).sum();
        fit.confidence >= USABLE
            && fit.residual > TOO_GOOD
            && squares <= FAR * FAR * fit.p.len().max(1) as f64
            && inside as f64 >= INSIDE * fit.points.len() as f64
    }

    /// Where a fit begins in a face that was found: as the model has learned, or with the neutral shape laid over it.
    fn start(&self, found: &Found) -> Option<Vec<Point>> {
        self.model.start(found).or_else(|| {
            let neutral = &self.calibration.laid()[0];
            let binding = self.calibration.binding();
            let pairs = binding
                .rows()
                .iter()
                .filter_map(|(name, _)| Some((binding.at(neutral, *name)?, found.points.get(name.index())?.at)));
            let (from, to): (Vec<Point>, Vec<Point>) = pairs.unzip();
            let q = Similarity::between(&from, &to)?;
            Some(neutral.iter().map(|p| q.apply(*p)).collect())
        })
    }
}

/// Whether a picture is one flat colour, or nearly.
fn shows_nothing(grey: &Grey) -> bool {
    let (low, high) = grey.pixels().iter().fold((u8::MAX, 0), |(low, high), v| (low.min(*v), high.max(*v)));
    high.saturating_sub(low) < LEAST_SPAN
}
