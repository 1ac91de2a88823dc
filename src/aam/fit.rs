//! The fit: from a start to the shape, coarse to fine.

use super::fitted::Fit;
use super::ground::Ground;
use super::level::Level;
use super::model::Model;
use super::shape::State;
use super::simultaneous;
use super::steady::steadied;
use super::sums::{products, square};
use crate::geometry::{Point, Rect, Similarity};
use crate::photo::Grey;

/// Where a fit begins.
#[derive(Debug, Clone, Copy)]
pub enum Start<'a> {
    /// With this shape, in pixels of the picture.
    Points(&'a [Point]),
    /// With the mean shape in this box, in pixels of the picture.
    Box(Rect),
    /// With this shape, near enough for the finest level alone: that of the frame before.
    Near(&'a [Point]),
}

/// A step is short when it moves no point by more than this, in pixels of the level.
const SHORT: f32 = 0.1;
/// So many steps at most at a level.
const MOST_STEPS: usize = 30;
/// How far round the start's box the picture is looked at, in the start's widths.
const ROUND: f64 = 0.3;

/// Where a fit that has failed is tried again: how far beside its start, in widths, how many times as large, and by how
/// many radians turned.
const ROUND_A_START: [[f32; 4]; 14] = [
    [0.15, 0.0, 1.0, 0.0],
    [-0.15, 0.0, 1.0, 0.0],
    [0.0, 0.15, 1.0, 0.0],
    [0.0, -0.15, 1.0, 0.0],
    [0.0, 0.0, 0.8, 0.0],
    [0.0, 0.0, 1.25, 0.0],
    [0.0, 0.0, 1.0, 0.25],
    [0.0, 0.0, 1.0, -0.25],
    [0.2, 0.2, 1.0, 0.0],
    [-0.2, 0.2, 1.0, 0.0],
    [0.2, -0.2, 1.0, 0.0],
    [-0.2, -0.2, 1.0, 0.0],
    [0.0, 0.3, 1.0, 0.0],
    [0.0, -0.3, 1.0, 0.0],
];

impl Model {
    /// Finds the shape in a picture; for more than one picture a [`Fitter`] keeps its memory.
    #[must_use]
    pub fn fit(&self, grey: &Grey, start: Start) -> Fit {
        Fitter::new(self).fit(grey, start)
    }
}

/// Fits, one after the other, in memory that stays.
#[derive(Debug, Clone)]
pub struct Fitter<'m> {
    model: &'m Model,
    ground: Ground,
    reading: Vec<f32>,
    sums: Vec<f32>,
    x: Vec<f32>,
    y: Vec<f32>,
    next: [Vec<f32>; 2],
    moved: Vec<f32>,
    bends: Vec<[f32; 4]>,
    state: State,
    /// Where a level began, to go back to from where it was lost.
    begun: [Vec<f32>; 2],
}

/// How a descent at one level ended.
#[derive(Debug, Clone, Copy)]
struct Descent {
    steps: usize,
    converged: bool,
    residual: f32,
}

impl<'m> Fitter<'m> {
    /// A fitter of a model.
    #[must_use]
    pub fn new(model: &'m Model) -> Self {
        let n = model.shapes.count();
        Self {
            model,
            ground: Ground::default(),
            reading: Vec::new(),
            sums: Vec::new(),
            x: vec![0.0; n],
            y: vec![0.0; n],
            next: [vec![0.0; n], vec![0.0; n]],
            moved: vec![0.0; 2 * n],
            bends: vec![[0.0; 4]; n],
            state: State { along: vec![0.0; model.shapes.modes().len()], ..State::default() },
            begun: [vec![0.0; n], vec![0.0; n]],
        }
    }

    /// Finds the shape in a picture.
    ///
    /// # Panics
    /// When the start's points are not as many as the model's.
    #[must_use]
    pub fn fit(&mut self, grey: &Grey, start: Start) -> Fit {
        self.begin(start);
        let near = matches!(start, Start::Near(_));
        let levels = &self.model.levels;
        let (first, fine) = if near { (levels.len() - 1, &levels[..0]) } else { (0, &levels[1..]) };
        let began = [self.x.clone(), self.y.clone()];
        let mut last = self.descend(grey, &levels[first], self.model.simultaneous);
        let mut steps = last.steps;
        for level in fine {
            last = self.descend(grey, level, self.model.simultaneous);
            steps += last.steps;
        }
        let fit = self.said(steps, last);
        if near || fit.confidence >= 0.5 { fit } else { self.fit_from_round(grey, &began, fit) }
    }

    /// Tries again from round a start that has led nowhere: at the coarsest level from each, at the others from the best.
    fn fit_from_round(&mut self, grey: &Grey, began: &[Vec<f32>; 2], failed: Fit) -> Fit {
        let levels = &self.model.levels;
        let mut steps = failed.iterations;
        let mut best: Option<(Descent, [Vec<f32>; 2])> = None;
        for [dx, dy, larger, turn] in ROUND_A_START {
            self.displace(began, [dx, dy], larger, turn);
            let end = self.descend(grey, &levels[0], self.model.simultaneous);
            steps += end.steps;
            if best.as_ref().is_none_or(|(b, _)| end.residual < b.residual) {
                best = Some((end, [self.x.clone(), self.y.clone()]));
            }
        }
        let Some((mut last, [x, y])) = best.filter(|(b, _)| b.residual.is_finite()) else { return failed };
        (self.x, self.y) = (x, y);
        for level in &levels[1..] {
            last = self.descend(grey, level, self.model.simultaneous);
            steps += last.steps;
        }
        let fit = self.said(steps, last);
        if fit.confidence > failed.confidence { fit } else { Fit { iterations: steps, ..failed } }
    }

    /// Begins beside where it began: moved by shares of its width, larger, turned.
    fn displace(&mut self, [xs, ys]: &[Vec<f32>; 2], by: [f32; 2], larger: f32, turn: f32) {
        let n = xs.len() as f32;
        let (cx, cy) = (xs.iter().sum::<f32>() / n, ys.iter().sum::<f32>() / n);
        let reach = |v: &[f32], c: f32| v.iter().map(|v| (v - c).abs()).fold(0.0, f32::max);
        let width = 2.0 * reach(xs, cx);
        let (a, b) = (larger * turn.cos(), larger * turn.sin());
        for (((x, y), x0), y0) in self.x.iter_mut().zip(&mut self.y).zip(xs).zip(ys) {
            let (dx, dy) = (x0 - cx, y0 - cy);
            *x = cx + by[0] * width + a * dx - b * dy;
            *y = cy + by[1] * width + b * dx + a * dy;
        }
    }

    /// Finds the shape in the frame after one with this fit: begins with its points at the finest level, and at the
    /// coarsest where that fails. What moves by less than a fit trembles is held (`steady`).
    #[must_use]
    pub fn follow(&mut self, grey: &Grey, before: &Fit) -> Fit {
        let mut fit = self.fit(grey, Start::Near(&before.ended));
        if fit.confidence < 0.5 {
            let again = self.fit(grey, Start::Points(&before.points));
            if again.confidence > fit.confidence {
                fit = again;
            }
        }
        if before.confidence >= 0.5 {
            steadied(&self.model.shapes, before, &mut fit);
        }
        fit
    }

    /// The same fit closer, shape and look found at once: for stills, where a few milliseconds do not matter. Where that
    /// leads away, the fit as it was.
    #[must_use]
    pub fn refine(&mut self, grey: &Grey, fit: &Fit) -> Fit {
        let Some(level) = self.model.levels.last() else { return fit.clone() };
        self.begin(Start::Near(&fit.points));
        let last = self.descend(grey, level, true);
        let refined = self.said(fit.iterations + last.steps, last);
        if refined.residual <= fit.residual { refined } else { fit.clone() }
    }

    fn begin(&mut self, start: Start) {
        self.state = State { along: vec![0.0; self.state.along.len()], ..State::default() };
        match start {
            Start::Points(points) | Start::Near(points) => {
                assert_eq!(points.len(), self.model.count(), "a start has the model's points");
                for ((x, y), p) in self.x.iter_mut().zip(&mut self.y).zip(self.model.skirted(points)) {
                    (*x, *y) = (sane(p.x), sane(p.y));
                }
            }
            Start::Box(rect) => {
                let mean = self.model.shapes.mean();
                let marked = &mean[..self.model.count()];
                let high = |f: fn(&Point) -> f64| marked.iter().map(f).fold(f64::MIN, f64::max);
                let low = |f: fn(&Point) -> f64| marked.iter().map(f).fold(f64::MAX, f64::min);
                let own = Rect::new(low(|p| p.x), low(|p| p.y), high(|p| p.x), high(|p| p.y));
                let scale = (rect.area().abs() / own.area().max(1e-9)).sqrt();
                let centre = own.center();
                for ((x, y), p) in self.x.iter_mut().zip(&mut self.y).zip(&mean) {
                    let at = rect.center() + (*p - centre) * scale;
                    (*x, *y) = (sane(at.x), sane(at.y));
                }
            }
        }
    }

    /// Goes down at one level from where the points are, in the picture; where it gets lost they stay there.
    fn descend(&mut self, grey: &Grey, level: &Level, together: bool) -> Descent {
        let lost = |steps| Descent { steps, converged: false, residual: f32::INFINITY };
        let shapes = &self.model.shapes;
        if !shapes.project(&mut self.x, &mut self.y, level.modes, &mut self.state) {
            return lost(0);
        }
        self.begun[0].copy_from_slice(&self.x);
        self.begun[1].copy_from_slice(&self.y);
        let scale = self.state.scale();
        let (halvings, smooth) = prepared(scale / level.width, level.smooth);
        self.ground.lay(grey, around(&self.x, &self.y, scale), halvings, smooth, level.channels);
        self.ground.enter(&mut self.x, &mut self.y);
        shapes.project(&mut self.x, &mut self.y, level.modes, &mut self.state);
        let (first, from) = (self.state.scale(), self.state.at);
        let short = SHORT * first / level.width;
        self.reading.clear();
        self.reading.resize(level.len(), 0.0);
        self.sums.resize(level.step_count().max(level.look_count()), 0.0);
        let mut end = lost(0);
        let mut least = 0.0;
        for steps in 1..=MOST_STEPS {
            level.table.read(&self.ground, &self.x, &self.y, &mut self.reading);
            let sums = &mut self.sums[..level.step_count()];
            let contrast = if together {
                let deviations = shapes.deviations();
                if !simultaneous::step(level, &self.reading, &self.state.along, deviations, sums) {
                    self.back(level);
                    return lost(steps);
                }
                1.0
            } else {
                products(&level.steps, &self.reading, sums);
                sums[level.step_count() - 1]
            };
            if steps == 1 && !together {
                // A start far off shows little of the mean texture; its steps must not grow beyond measure.
                let all = square(&self.reading);
                let ones = self.reading.iter().sum::<f32>();
                least =
                    0.25 * (all - ones * ones / (level.table.count() * level.channels.count()) as f32).max(1.0).sqrt();
            }
            self.step(level, contrast.max(least));
            let longest = self.compose();
            end.steps = steps;
            let [dx, dy] = [self.state.at[0] - from[0], self.state.at[1] - from[1]];
            let grown = self.state.scale() / first;
            // Also true of what is no number.
            if !(longest.is_finite() && (0.4..2.5).contains(&grown) && dx.hypot(dy) < 1.2 * first) {
                self.back(level);
                return lost(steps);
            }
            if longest < short {
                end.converged = true;
                break;
            }
        }
        end.residual = self.residual(level);
        self.ground.leave(&mut self.x, &mut self.y);
        shapes.project(&mut self.x, &mut self.y, level.modes, &mut self.state);
        end
    }

    /// Back to where the level began.
    fn back(&mut self, level: &Level) {
        self.x.copy_from_slice(&self.begun[0]);
        self.y.copy_from_slice(&self.begun[1]);
        self.model.shapes.project(&mut self.x, &mut self.y, level.modes, &mut self.state);
    }

    /// Moves the points by what the sums say.
    fn step(&mut self, level: &Level, contrast: f32) {
        let n = self.x.len();
        self.moved.fill(0.0);
        for (direction, by) in level.directions.iter().zip(&self.sums) {
            let by = by / contrast;
            self.moved.iter_mut().zip(direction).for_each(|(m, d)| *m += by * d);
        }
        self.bends.fill([0.0; 4]);
        for (t, inverse) in &level.triangles {
            let [i, j, k] = *t;
            let (ax, ay) = (self.x[i], self.y[i]);
            let (bx, by) = (self.x[j] - ax, self.y[j] - ay);
            let (cx, cy) = (self.x[k] - ax, self.y[k] - ay);
            // What the mean shape's triangle became: sides now, times the inverse of the sides then.
            let [e, f, g, h] = *inverse;
            let bend = [bx * e + cx * g, bx * f + cx * h, by * e + cy * g, by * f + cy * h];
            for v in *t {
                self.bends[v].iter_mut().zip(bend).for_each(|(s, b)| *s += b);
            }
        }
        let (mx, my) = self.moved.split_at(n);
        let [nx, ny] = &mut self.next;
        for i in 0..n {
            let share = level.shares[i];
            let [a, b, c, d] = self.bends[i].map(|v| v * share);
            nx[i] = self.x[i] - (a * mx[i] + b * my[i]);
            ny[i] = self.y[i] - (c * mx[i] + d * my[i]);
        }
        self.model.shapes.project(nx, ny, level.modes, &mut self.state);
    }

    /// Takes the new points; the longest way that one of them moved, along x or y.
    fn compose(&mut self) -> f32 {
        let [nx, ny] = &self.next;
        let mut longest = 0.0_f32;
        for (now, next) in [(&mut self.x, nx), (&mut self.y, ny)] {
            for (v, n) in now.iter_mut().zip(next) {
                let by = (*n - *v).abs();
                // A move that is no number must not be lost in a comparison.
                longest = if by > longest || by.is_nan() { by } else { longest };
                *v = *n;
            }
        }
        longest
    }

    /// How much of the last reading's contrast the looks leave over.
    fn residual(&mut self, level: &Level) -> f32 {
        let sums = &mut self.sums[..level.look_count()];
        products(&level.looks, &self.reading, sums);
        let all = square(&self.reading) - sums[0] * sums[0];
        let held: f32 = sums[1..].iter().map(|s| s * s).sum();
        if all > 1.0 { ((all - held).max(0.0) / all).sqrt() } else { f32::INFINITY }
    }

    fn said(&self, iterations: usize, last: Descent) -> Fit {
        let marked = self.x.iter().zip(&self.y).take(self.model.count());
        let points: Vec<Point> = marked.map(|(x, y)| Point::new(f64::from(*x), f64::from(*y))).collect();
        let State { a, b, at: [x, y], along } = &self.state;
        Fit {
            ended: points.clone(),
            points,
            p: along.iter().map(|p| f64::from(*p)).collect(),
            q: Similarity { a: f64::from(*a), b: f64::from(*b), origin: Point::new(f64::from(*x), f64::from(*y)) },
            confidence: self.model.trust.confidence(last.residual),
            residual: f64::from(last.residual.min(1.0)),
            iterations,
            converged: last.converged,
        }
    }
}

/// A coordinate that can be reckoned with.
fn sane(v: f64) -> f32 {
    if v.is_finite() { v.clamp(-1e6, 1e6) as f32 } else { 0.0 }
}

/// How often a picture is halved that has so many pixels to one of the level, until there are fewer than 1.6; and how often
/// it is then smoothed that is smoothed `least` times anyway: once more where it is still finer than the level.
pub(super) fn prepared(ratio: f32, least: u32) -> (u32, u32) {
    let mut left = ratio;
    let mut halvings = 0;
    while left >= 1.6 && halvings < 12 {
        left /= 2.0;
        halvings += 1;
    }
    (halvings, least + u32::from(left > 1.12))
}

/// The box of the points, and what lies round it.
fn around(xs: &[f32], ys: &[f32], scale: f32) -> Rect {
    let low = |v: &[f32]| f64::from(v.iter().copied().fold(f32::MAX, f32::min));
    let high = |v: &[f32]| f64::from(v.iter().copied().fold(f32::MIN, f32::max));
    let margin = ROUND * f64::from(scale);
    Rect::new(low(xs), low(ys), high(xs), high(ys)).inflate(margin, margin)
}
