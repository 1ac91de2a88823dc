//! Learning the shapes of faces and the cascade that finds their points.

use lianpu::face::find::training::{Block, Chip, DESCRIPTOR, Matrix, Moves, ShapeModel, Stage};
use lianpu::geometry::{Point, Similarity, Vec2};
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::chance::Chance;
use crate::photos::Scheme;
use crate::ridge;
use crate::whole::Picture;

/// How a stage is to be.
pub struct Plan {
    pub scale: f64,
    pub cell: f64,
    pub kept: usize,
    pub modes: usize,
    pub blocks: Vec<(Vec<usize>, Vec<usize>)>,
    pub all_sites: Vec<usize>,
}

/// Groups of points that move together in the last stages.
pub fn groups(scheme: &Scheme) -> Vec<(Vec<usize>, Vec<usize>)> {
    let of = |names: &[&str]| names.iter().map(|n| scheme.index(n)).collect::<Vec<_>>();
    let first = scheme.features.len();
    // Further points by their place in the table of pairs.
    let more = |pairs: &[usize]| pairs.iter().flat_map(|p| [first + 2 * p, first + 2 * p + 1]).collect::<Vec<_>>();
    let one = |pairs: &[usize], side: usize| pairs.iter().map(|p| first + 2 * p + side).collect::<Vec<_>>();
    let mut list: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
    for (side, eye, brow) in [
        (0, ["3.12", "3.8", "3.2", "3.4", "3.6"], ["4.6", "4.4a", "4.4", "4.2"]),
        (1, ["3.7", "3.11", "3.1", "3.3", "3.5"], ["4.5", "4.3a", "4.3", "4.1"]),
    ] {
        let (mut eyes, mut brows) = (of(&eye), of(&brow));
        brows.extend(one(&[21, 22, 23, 24, 25, 26], side));
        eyes.extend(one(&[17, 18, 19, 20], side));
        let both = [eyes.clone(), brows.clone()].concat();
        list.push((both.clone(), eyes.clone()));
        list.push(([brows.clone(), eyes].concat(), brows));
    }
    let mut nose = of(&["9.2", "9.1", "9.4", "9.5", "9.15"]);
    nose.extend(more(&[13, 14, 15, 16]));
    list.push((nose.clone(), nose));
    let mut mouth = of(&["8.4", "8.3", "8.9", "8.10", "8.1", "2.2", "2.3", "8.2"]);
    mouth.extend(more(&[10, 11, 12]));
    let near = [mouth.clone(), of(&["9.4", "9.5", "9.15", "2.1"])].concat();
    list.push((near, mouth));
    let mut edge = of(&["2.1", "2.14", "2.13"]);
    edge.extend(more(&[0, 1, 2]));
    list.push(([edge.clone(), of(&["8.4", "8.3", "8.2"])].concat(), edge));
    let mut top = of(&["11.1", "11.2", "11.3"]);
    top.extend(more(&[3, 4, 5, 6]));
    list.push((top.clone(), top));
    let mut ears = of(&["10.2", "10.4", "10.6", "10.1", "10.3", "10.5"]);
    ears.extend(more(&[7, 8, 9]));
    list.push((ears.clone(), ears));
    list
}

/// Mean and modes of people's shapes.
pub fn shapes(truths: &[&[Point]], scheme: &Scheme, count: usize) -> ShapeModel {
    let names = [
        "3.12", "3.8", "3.6", "3.11", "3.7", "3.5", "9.2", "9.1", "9.4", "9.5", "9.15", "8.4", "8.3", "8.1", "4.2",
        "4.1",
    ];
    let steady: Vec<usize> = names.iter().map(|n| scheme.index(n)).collect();
    let pick = |points: &[Point]| steady.iter().map(|i| points[*i]).collect::<Vec<_>>();
    let pupils = (scheme.index("3.6"), scheme.index("3.5"));
    let own = |p: &[Point]| {
        let frame = Similarity::spanning(p[pupils.0], p[pupils.1]);
        p.iter().map(|q| frame.undo(*q)).collect::<Vec<_>>()
    };
    let mut aligned: Vec<Vec<Point>> = truths.iter().map(|t| own(t)).collect();
    let mut mean = Vec::new();
    for _ in 0..4 {
        let n = aligned.len() as f64;
        mean = (0..scheme.count())
            .map(|i| (aligned.iter().fold(Vec2::ZERO, |s, a| s + a[i].to_vec2()) / n).to_point())
            .collect::<Vec<_>>();
        mean = own(&mean);
        for shape in &mut aligned {
            let frame = Similarity::between(&pick(&mean), &pick(shape)).expect("points apart");
            shape.iter_mut().for_each(|p| *p = frame.undo(*p));
        }
    }
    let size = 2 * mean.len();
    // Turn, scale and the two moves of the mean, made orthonormal.
    let mut modes: Vec<Vec<f64>> = vec![
        mean.iter().flat_map(|p| [p.x, p.y]).collect(),
        mean.iter().flat_map(|p| [-p.y, p.x]).collect(),
        (0..size).map(|i| f64::from(u8::from(i % 2 == 0))).collect(),
        (0..size).map(|i| f64::from(u8::from(i % 2 == 1))).collect(),
    ];
    modes.swap(0, 2);
    modes.swap(1, 3);
    let orthonormal = |modes: &mut Vec<Vec<f64>>, from: usize| {
        for i in from..modes.len() {
            for j in 0..i {
                let along: f64 = modes[i].iter().zip(&modes[j]).map(|(a, b)| a * b).sum();
                let other = modes[j].clone();
                modes[i].iter_mut().zip(other).for_each(|(a, b)| *a -= along * b);
            }
            let length = modes[i].iter().map(|v| v * v).sum::<f64>().sqrt();
            modes[i].iter_mut().for_each(|v| *v /= length);
        }
    };
    orthonormal(&mut modes, 0);
    let rows = DMatrix::from_fn(aligned.len(), size, |i, j| {
        let d = aligned[i][j / 2] - mean[j / 2];
        (if j.is_multiple_of(2) { d.x } else { d.y }) as f32
    });
    let mut rest = rows;
    for mode in &modes {
        let m = nalgebra::DVector::from_iterator(size, mode.iter().map(|v| *v as f32));
        let along = &rest * &m;
        rest -= along * m.transpose();
    }
    let (_, main, lengths) = ridge::directions(&rest, count);
    for n in 0..main.rows {
        modes.push(main.row(n).iter().map(|v| f64::from(*v)).collect());
    }
    orthonormal(&mut modes, 4);
    let root = (mean.len() as f32).sqrt();
    // A face is known to a tenth of a pupil distance and a tenth of its size before it is looked at closely.
    let mut spread = vec![0.1 * root, 0.1 * root, 0.1 * root, 0.1 * root];
    spread.extend(lengths.iter().map(|l| l.sqrt()));
    let values = modes.iter().flatten().map(|v| *v as f32).collect();
    ShapeModel { mean, modes: Matrix { rows: modes.len(), columns: size, values }, spread, steady }
}

/// A sample: which picture, where its face is taken to be, and the shape so far.
#[derive(Clone)]
pub struct Sample {
    pub picture: usize,
    pub person: usize,
    pub frame: Similarity,
    pub shape: Vec<Point>,
    /// The truth in the photo.
    pub truth: Vec<Point>,
}

/// A frame near the true one, as far off as a detector may be.
pub fn shaken(model: &ShapeModel, truth: &[Point], chance: &mut Chance) -> Similarity {
    let frame = model.frame_of(truth);
    let by = Similarity::new(
        Point::new(chance.normal() * 0.08, chance.normal() * 0.08),
        (chance.normal() * 0.08).exp(),
        chance.normal() * 0.10,
    );
    frame.after(&by)
}

/// Learns the coarse and the fine stages. `pictures` are those that the samples name.
pub fn cascade(
    model: &ShapeModel,
    pictures: &[Picture],
    mut samples: Vec<Sample>,
    plans: &(Vec<Plan>, Vec<Vec<Plan>>),
    folds: usize,
) -> (Vec<Stage>, Vec<Vec<Stage>>) {
    let mut chance = Chance(7);
    let mut people: Vec<usize> = samples.iter().map(|s| s.person).collect();
    people.sort_unstable();
    people.dedup();
    let fold: Vec<usize> =
        samples.iter().map(|s| people.iter().position(|p| *p == s.person).expect("known") % folds).collect();
    let coarse = plans.0.iter().map(|plan| stage(model, pictures, &mut samples, plan, &fold)).collect();
    for sample in &mut samples {
        let turn = model.frame_of(&sample.shape);
        sample.shape.iter_mut().for_each(|p| *p = turn.undo(*p));
        sample.frame = sample.frame.after(&turn);
    }
    let mut chain = |plans: &Vec<Plan>| {
        let mut samples = samples.clone();
        for sample in &mut samples {
            let by = Similarity::new(
                Point::new(chance.normal() * 0.02, chance.normal() * 0.02),
                (chance.normal() * 0.02).exp(),
                chance.normal() * 0.02,
            );
            sample.shape.iter_mut().for_each(|p| *p = by.apply(*p));
        }
        plans.iter().map(|plan| stage(model, pictures, &mut samples, plan, &fold)).collect()
    };
    let fine = plans.1.iter().map(&mut chain).collect();
    (coarse, fine)
}

/// Learns a stage and moves the samples as it would move people whom it has not seen.
fn stage(model: &ShapeModel, pictures: &[Picture], samples: &mut [Sample], plan: &Plan, fold: &[usize]) -> Stage {
    let begun = std::time::Instant::now();
    let before = error(samples);
    // Long descriptors of every sample at every site.
    let sites = &plan.all_sites;
    let long: Vec<Vec<f32>> = samples
        .par_iter()
        .map(|s| {
            let chip = Chip::of(&pictures[s.picture].pyramid, &s.frame, plan.scale).spread(plan.cell);
            let mut out = vec![0.0; sites.len() * DESCRIPTOR];
            for (site, part) in sites.iter().zip(out.chunks_exact_mut(DESCRIPTOR)) {
                chip.describe(s.shape[*site], part);
            }
            out
        })
        .collect();
    let some: Vec<&[f32]> = long
        .iter()
        .flat_map(|l| l.chunks_exact(DESCRIPTOR))
        .step_by(sites.len() * samples.len() / 20_000 + 1)
        .collect();
    let rows = DMatrix::from_fn(some.len(), DESCRIPTOR, |i, j| some[i][j]);
    let (usual, basis, _) = ridge::directions(&rows, plan.kept);
    let mut stage = Stage { scale: plan.scale, cell: plan.cell, basis, usual, blocks: Vec::new() };
    let short: Vec<Vec<f32>> = long
        .par_iter()
        .map(|l| {
            let mut out = vec![0.0; sites.len() * plan.kept];
            for (place, part) in l.chunks_exact(DESCRIPTOR).zip(out.chunks_exact_mut(plan.kept)) {
                let off: Vec<f32> = place.iter().zip(&stage.usual).map(|(v, m)| v - m).collect();
                stage.basis.times(&off, part);
            }
            out
        })
        .collect();
    drop(long);
    let goals: Vec<Vec<Point>> = samples.iter().map(|s| s.truth.iter().map(|p| s.frame.undo(*p)).collect()).collect();
    let whole = [(sites.clone(), Vec::new())];
    let blocks = if plan.blocks.is_empty() { &whole[..] } else { &plan.blocks[..] };
    let mut moved: Vec<Vec<Point>> = samples.iter().map(|s| s.shape.clone()).collect();
    let mut penalties = Vec::new();
    for (own, points) in blocks {
        let columns: Vec<usize> = own
            .iter()
            .flat_map(|site| {
                let at = sites.iter().position(|s| s == site).expect("a site of the plan");
                at * plan.kept..(at + 1) * plan.kept
            })
            .collect();
        let features = DMatrix::from_fn(samples.len(), columns.len(), |i, j| short[i][columns[j]]);
        let (moves, targets) = if points.is_empty() {
            let along: Vec<Vec<f32>> = samples.iter().zip(&goals).map(|(s, g)| model.along(&s.shape, g)).collect();
            (Moves::Modes, DMatrix::from_fn(samples.len(), plan.modes, |i, j| along[i][j]))
        } else {
            let to = |i: usize, j: usize| {
                let point = points[j / 2];
                let d = goals[i][point] - samples[i].shape[point];
                (if j.is_multiple_of(2) { d.x } else { d.y }) as f32
            };
            (Moves::Points(points.clone()), DMatrix::from_fn(samples.len(), 2 * points.len(), to))
        };
        let learned = ridge::learn(&features, &targets, fold, &[0.003, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0]);
        let mut own_penalties = learned.penalties.clone();
        own_penalties.sort_by(f32::total_cmp);
        penalties.push(own_penalties[own_penalties.len() / 2]);
        for (i, shape) in moved.iter_mut().enumerate() {
            let by: Vec<f32> = learned.honest.row(i).iter().copied().collect();
            match &moves {
                Moves::Modes => model.moved(shape, &by),
                Moves::Points(points) => {
                    for (point, d) in points.iter().zip(by.chunks_exact(2)) {
                        shape[*point] += Vec2::new(f64::from(d[0]), f64::from(d[1]));
                    }
                }
            }
        }
        stage.blocks.push(Block { sites: own.clone(), moves, weights: learned.weights, bias: learned.bias });
    }
    for (sample, shape) in samples.iter_mut().zip(moved) {
        sample.shape = shape;
    }
    println!(
        "  stage {} {}: {:.2} % to {:.2} % by people unseen, penalties {penalties:?}, {:.1} s",
        plan.scale,
        plan.cell,
        100.0 * before,
        100.0 * error(samples),
        begun.elapsed().as_secs_f64()
    );
    stage
}

/// Mean distance from the truth, in pupil distances.
fn error(samples: &[Sample]) -> f64 {
    let of = |s: &Sample| {
        let off = s.shape.iter().zip(&s.truth).map(|(p, t)| p.distance(s.frame.undo(*t)));
        off.sum::<f64>() / s.shape.len() as f64
    };
    samples.iter().map(of).sum::<f64>() / samples.len() as f64
}
