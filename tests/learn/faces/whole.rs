//! Learning everything from the photos of some people.

use lianpu::face::find::training::{Block, Candidate, Chip, DESCRIPTOR, Looks, Matrix, Moves, ShapeModel, Stage};
use lianpu::face::find::{Fit, Model, Pyramid};
use lianpu::geometry::{Point, Similarity};
use lianpu::photo::Plane;
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::chance::Chance;
use crate::photos::{Scheme, Shot, varied};
use crate::points::{self, Plan, Sample};
use crate::windows::{self, Scene};
use crate::{others, ridge};

/// Variants of each neutral photo: as it is; in other light and mostly before another wall; the same and turned a
/// little.
pub const VARIANTS: usize = 4;

/// A picture to learn from.
pub struct Picture {
    pub pyramid: Pyramid,
    pub person: usize,
    /// Empty where it is not known or there is no face.
    pub truth: Vec<Point>,
}

/// All pictures that any fold may learn from, made once.
pub struct Material {
    pub scheme: Scheme,
    pub neutral: Vec<Shot>,
    pub smiling: Vec<Shot>,
    pub faces: Vec<Picture>,
    pub smiles: Vec<Picture>,
    /// Without a face, or with one that is turned away; drawn ones belong to nobody (person 0).
    pub without: Vec<Picture>,
}

impl Material {
    pub fn new(scheme: Scheme, neutral: Vec<Shot>, smiling: Vec<Shot>) -> Self {
        let pupils = (scheme.index("3.6"), scheme.index("3.5"));
        let frame = |truth: &[Point]| Similarity::spanning(truth[pupils.0], truth[pupils.1]);
        let faces = (0..neutral.len() * VARIANTS)
            .into_par_iter()
            .map(|i| {
                let (shot, variant) = (&neutral[i / VARIANTS], i % VARIANTS);
                let mut chance = Chance(i as u64 * 77 + 5);
                let person = shot.person;
                if variant < 3 {
                    return Picture {
                        pyramid: varied(&shot.photo, variant, &mut chance),
                        person,
                        truth: shot.truth.clone(),
                    };
                }
                let yaw = chance.between(0.06, 0.36) * if chance.share() < 0.5 { -1.0 } else { 1.0 };
                let (photo, truth) = others::turned(&shot.photo, &frame(&shot.truth), yaw, &shot.truth);
                Picture { pyramid: varied(&photo, variant, &mut chance), person, truth }
            })
            .collect();
        let smiles = smiling
            .par_iter()
            .enumerate()
            .map(|(i, s)| {
                let pyramid = varied(&s.photo, i / 2 % 2, &mut Chance(i as u64 * 3 + 50_000));
                Picture { pyramid, person: s.person, truth: Vec::new() }
            })
            .collect();
        let mut without: Vec<Picture> = (0..90)
            .into_par_iter()
            .map(|i| {
                let mut chance = Chance(i as u64 + 9_000);
                let plane = others::drawn(i, 420, &mut chance);
                Picture { pyramid: Pyramid::over(plane, 1.0, Point::ORIGIN), person: 0, truth: Vec::new() }
            })
            .collect();
        let torn = neutral.par_iter().chain(&smiling).enumerate().flat_map_iter(|(i, shot)| {
            let mut chance = Chance(i as u64 + 30_000);
            let mut planes: Vec<Plane> = Vec::new();
            let plane = Plane::luma(&shot.photo);
            match i % 4 {
                0 => planes.push(others::quarters(&plane, 2)),
                1 => planes.push(others::quarters(&plane, 1 + 2 * chance.below(2))),
                2 => {
                    let tile = 40 + chance.below(90);
                    planes.push(others::shuffled(&plane, tile, &mut chance));
                }
                _ => {}
            }
            if !shot.truth.is_empty() && i % 2 == usize::from(i / 2 % 2 == 0) {
                let yaw = chance.between(0.95, 1.45) * if chance.share() < 0.5 { -1.0 } else { 1.0 };
                planes.push(Plane::luma(&others::turned(&shot.photo, &frame(&shot.truth), yaw, &[]).0));
            }
            let person = shot.person;
            planes.into_iter().map(move |plane| Picture {
                pyramid: Pyramid::over(plane, 1.0, Point::ORIGIN),
                person,
                truth: Vec::new(),
            })
        });
        without.extend(torn.collect::<Vec<_>>());
        Self { scheme, neutral, smiling, faces, smiles, without }
    }
}

fn env(name: &str, or: usize) -> usize {
    std::env::var(name).map_or(or, |v| v.parse().unwrap())
}

/// The coarse stages, and the chains of fine ones.
pub fn plans(scheme: &Scheme) -> (Vec<Plan>, Vec<Vec<Plan>>) {
    let all: Vec<usize> = (0..scheme.count()).collect();
    let stage = |scale, cell, kept, modes, blocks| Plan { scale, cell, kept, modes, blocks, all_sites: all.clone() };
    let groups = || points::groups(scheme);
    let (k, g) = (env("K", 32), env("G", 40));
    let chains = vec![
        vec![stage(60.0, 0.13, k, 28, vec![]), stage(60.0, 0.13, g, 0, groups()), stage(60.0, 0.08, g, 0, groups())],
        vec![stage(60.0, 0.11, k, 28, vec![]), stage(60.0, 0.10, k, 32, vec![]), stage(60.0, 0.08, g, 0, groups())],
    ];
    let mask = env("CHAINS", 7);
    let chains = chains.into_iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1).map(|c| c.1).collect();
    (vec![stage(24.0, 0.25, 24, 16, vec![]), stage(24.0, 0.17, 24, 24, vec![])], chains)
}

/// Learns from the people for whom `of` says so.
pub fn learn(material: &Material, starts: usize, of: impl Fn(usize) -> bool + Sync) -> Model {
    let scheme = &material.scheme;
    let begun = std::time::Instant::now();
    let (shapes, coarse, fine) = fitted(material, starts, &of);
    let mut looks = looks(material, &shapes, &fine[0][0], &of);
    trust(material, starts, &of, &mut looks);
    println!("  points: {:.1} s", begun.elapsed().as_secs_f64());

    // Where the smiling faces are: near where the same person's neutral face is, then as the cascade says.
    let begun = std::time::Instant::now();
    let places: Vec<Option<Similarity>> = material
        .smiling
        .iter()
        .zip(&material.smiles)
        .map(|(shot, picture)| {
            let twin = material.neutral.iter().find(|n| n.person == shot.person && n.mirrored == shot.mirrored)?;
            let fit = Fit::at(&shapes, shapes.frame_of(&twin.truth));
            let fit = fit.through(&shapes, &coarse, &picture.pyramid, &[], 1.0);
            of(shot.person).then(|| shapes.frame_of(&fit.places()))
        })
        .collect();
    let mut scenes: Vec<Scene> = Vec::new();
    for picture in material.faces.iter().filter(|p| of(p.person)) {
        scenes.push(Scene { picture: &picture.pyramid, face: Some(shapes.frame_of(&picture.truth)) });
    }
    for (picture, place) in material.smiles.iter().zip(&places) {
        if let Some(frame) = place {
            scenes.push(Scene { picture: &picture.pyramid, face: Some(*frame) });
        }
    }
    for picture in material.without.iter().filter(|p| p.person == 0 || of(p.person)) {
        scenes.push(Scene { picture: &picture.pyramid, face: None });
    }
    let detector = windows::learn(&scenes, 3);
    println!("  detector: {:.1} s", begun.elapsed().as_secs_f64());

    let begun = std::time::Instant::now();
    let silent = |like: &Stage| {
        let blocks = vec![Block {
            sites: vec![],
            moves: Moves::Modes,
            weights: Matrix { rows: 1, columns: 0, values: vec![] },
            bias: vec![0.0],
        }];
        Stage { blocks, ..like.clone() }
    };
    let judges = [silent(&coarse[1]), silent(&fine[0][0])];
    let mut model = Model { detector, shapes, coarse, fine, judges, looks };
    let seen: Vec<(usize, bool, [Candidate; 2])> = scenes
        .par_iter()
        .enumerate()
        .flat_map_iter(|(i, scene)| {
            let near = |c: &Candidate, f: &Similarity| {
                let (a, b) = (&c.fit.frame, f);
                a.origin.distance(b.origin) < 0.2 * b.scale() && (0.8..1.25).contains(&(a.scale() / b.scale()))
            };
            let mut found = Vec::new();
            let both = |rough: Candidate| [model.closely_in(scene.picture, &rough, &[]), rough];
            for candidate in model.candidates(scene.picture, &[]) {
                match &scene.face {
                    Some(face) if near(&candidate, face) => found.push((i, true, both(candidate))),
                    Some(face) if candidate.fit.frame.origin.distance(face.origin) < 0.5 * face.scale() => {}
                    _ => found.push((i, false, both(candidate))),
                }
            }
            if let Some(face) = &scene.face {
                // Fits from the true place, tilted, and lost ones, which start far off.
                let mut chance = Chance(i as u64 + 70_000);
                let by = Similarity::new(
                    Point::new(chance.normal() * 0.07, chance.normal() * 0.07),
                    (chance.normal() * 0.08).exp(),
                    chance.normal() * 0.09,
                );
                let good = model.roughly(scene.picture, face.after(&by), 0.0, &[]);
                if near(&good, face) {
                    found.push((i, true, both(good)));
                }
                #[allow(clippy::approx_constant, reason = "the shipped numbers were learned so")]
                let angle = chance.between(0.0, 6.28);
                let far = chance.between(0.5, 1.0);
                let by = Similarity::new(
                    Point::new(angle.cos() * far, angle.sin() * far),
                    (chance.normal() * 0.3).exp(),
                    chance.normal() * 0.2,
                );
                let bad = model.roughly(scene.picture, face.after(&by), 0.0, &[]);
                if !near(&bad, face) && bad.fit.frame.origin.distance(face.origin) > 0.25 * face.scale() {
                    found.push((i, false, both(bad)));
                }
            }
            found
        })
        .collect();
    let count = seen.iter().filter(|s| s.1).count();
    println!("  judges from {count} faces and {} others", seen.len() - count);
    // The inner face: what lies round it differs more from photo to photo than from face to face.
    let first = scheme.features.len();
    let inner = |i: &usize| scheme.groups.get(*i).map_or(*i >= first + 20, |g| g != "ear" && g != "contour");
    let sites: Vec<usize> = (0..scheme.count()).filter(inner).collect();
    for which in [0, 1] {
        let judge = &model.judges[which];
        let long: Vec<Vec<f32>> = seen
            .par_iter()
            .map(|(scene, _, fits)| {
                let fit = &fits[1 - which].fit;
                let turn = model.shapes.frame_of(&fit.shape);
                let chip = Chip::of(scenes[*scene].picture, &fit.frame.after(&turn), judge.scale).spread(judge.cell);
                let mut out = vec![0.0; sites.len() * DESCRIPTOR];
                for (site, part) in sites.iter().zip(out.chunks_exact_mut(DESCRIPTOR)) {
                    chip.describe(turn.undo(fit.shape[*site]), part);
                }
                out
            })
            .collect();
        const KEPT: usize = 16;
        let some: Vec<&[f32]> = long
            .iter()
            .flat_map(|l| l.chunks_exact(DESCRIPTOR))
            .step_by(long.len() * sites.len() / 20_000 + 1)
            .collect();
        let (usual, basis, _) = ridge::directions(&DMatrix::from_fn(some.len(), DESCRIPTOR, |i, j| some[i][j]), KEPT);
        let short = |l: &Vec<f32>| {
            let mut out = vec![0.0; sites.len() * KEPT];
            for (place, part) in l.chunks_exact(DESCRIPTOR).zip(out.chunks_exact_mut(KEPT)) {
                let off: Vec<f32> = place.iter().zip(&usual).map(|(v, m)| v - m).collect();
                basis.times(&off, part);
            }
            out
        };
        let rows =
            |face: bool| seen.iter().zip(&long).filter(|(s, _)| s.1 == face).map(|(_, l)| short(l)).collect::<Vec<_>>();
        let (weights, bias) = windows::logistic(&rows(true), &rows(false), 1e-2, None);
        let columns = weights.len();
        let block = Block {
            sites: sites.clone(),
            moves: Moves::Modes,
            weights: Matrix { rows: 1, columns, values: weights },
            bias: vec![bias],
        };
        let judge = &mut model.judges[which];
        judge.basis = basis;
        judge.usual = usual;
        judge.blocks = vec![block];
    }
    println!("  judges: {:.1} s", begun.elapsed().as_secs_f64());
    model
}

/// The shapes and the stages.
pub fn fitted(
    material: &Material,
    starts: usize,
    of: &(impl Fn(usize) -> bool + Sync),
) -> (ShapeModel, Vec<Stage>, Vec<Vec<Stage>>) {
    let scheme = &material.scheme;
    let shapes = points::shapes(
        &material.faces.iter().filter(|p| of(p.person)).map(|p| &p.truth[..]).collect::<Vec<_>>(),
        scheme,
        32,
    );
    let mut chance = Chance(99);
    let mut samples = Vec::new();
    for (i, picture) in material.faces.iter().enumerate().filter(|(_, p)| of(p.person)) {
        for _ in 0..starts {
            let frame = points::shaken(&shapes, &picture.truth, &mut chance);
            samples.push(Sample {
                picture: i,
                person: picture.person,
                frame,
                shape: shapes.mean.clone(),
                truth: picture.truth.clone(),
            });
        }
    }
    let (coarse, fine) = points::cascade(&shapes, &material.faces, samples, &plans(scheme), 5);
    (shapes, coarse, fine)
}

/// What faces look like at each point where a person has set it.
fn looks(material: &Material, shapes: &ShapeModel, stage: &Stage, of: &(impl Fn(usize) -> bool + Sync)) -> Looks {
    let sites: Vec<usize> = (0..shapes.count()).collect();
    let kept = stage.basis.rows;
    let rows: Vec<Vec<f32>> = material
        .faces
        .par_iter()
        .filter(|p| of(p.person))
        .map(|p| {
            let frame = shapes.frame_of(&p.truth);
            let shape: Vec<Point> = p.truth.iter().map(|q| frame.undo(*q)).collect();
            let chip = Chip::of(&p.pyramid, &frame, stage.scale).spread(stage.cell);
            let mut short = Vec::new();
            stage.describe(&chip, &shape, &sites, &mut short);
            short
        })
        .collect();
    let n = rows.len() as f32;
    let mean: Vec<f32> = (0..sites.len() * kept).map(|j| rows.iter().map(|r| r[j]).sum::<f32>() / n).collect();
    let sharp = (0..mean.len()).map(|j| {
        let square = rows.iter().map(|r| (r[j] - mean[j]).powi(2)).sum::<f32>() / n;
        1.0 / square.sqrt().max(1e-3)
    });
    let sharp = sharp.collect();
    let matrix = |values| Matrix { rows: sites.len(), columns: kept, values };
    Looks {
        usual: matrix(mean),
        sharpness: matrix(sharp),
        base: vec![0.0; material.scheme.features.len()],
        slopes: vec![0.0; 2],
    }
}

/// How the error of a point follows from the spread of the starts and from its looks, by people whom stages have not
/// seen: four times, a quarter of the people is kept apart.
fn trust(material: &Material, starts: usize, of: &(impl Fn(usize) -> bool + Sync), looks: &mut Looks) {
    const PARTS: usize = 4;
    let count = material.scheme.features.len();
    let mut people: Vec<usize> = material.neutral.iter().map(|s| s.person).filter(|p| of(*p)).collect();
    people.dedup();
    let part = |person: usize| people.iter().position(|p| *p == person).map(|i| i % PARTS);
    // Logarithms of error, spread and strangeness, of each point of each picture.
    let mut rows: Vec<Vec<[f32; 3]>> = vec![Vec::new(); count];
    for k in 0..PARTS {
        let (shapes, coarse, fine) = fitted(material, starts.min(2), &|person| part(person).is_some_and(|p| p != k));
        let own = self::looks(material, &shapes, &fine[0][0], &|person| part(person).is_some_and(|p| p != k));
        let pictures: Vec<&Picture> = material.faces.iter().filter(|p| part(p.person) == Some(k)).collect();
        let seen: Vec<Vec<[f32; 3]>> = pictures
            .par_iter()
            .enumerate()
            .map(|(i, p)| {
                let frame = points::shaken(&shapes, &p.truth, &mut Chance(i as u64 + 4_000));
                let fit = Fit::at(&shapes, frame).through(&shapes, &coarse, &p.pyramid, &[], 1.0);
                let fit = fit.by_all(&shapes, &fine, &p.pyramid, &[]);
                let turn = shapes.frame_of(&fit.shape);
                let shape: Vec<Point> = fit.shape.iter().map(|p| turn.undo(*p)).collect();
                let chip = Chip::of(&p.pyramid, &fit.frame.after(&turn), fine[0][0].scale).spread(fine[0][0].cell);
                let strange = own.strangeness(&fine[0][0], &chip, &shape);
                (0..count)
                    .map(|n| {
                        let error = fit.shape[n].distance(fit.frame.undo(p.truth[n])) as f32;
                        let [a, b] = own.features(fit.spread[n], strange[n]);
                        [(error + 0.002).ln(), a, b]
                    })
                    .collect()
            })
            .collect();
        for picture in seen {
            for (row, values) in rows.iter_mut().zip(picture) {
                row.push(values);
            }
        }
    }
    // Slopes are common to all points; each has its own base.
    let means: Vec<[f32; 3]> =
        rows.iter().map(|r| [0, 1, 2].map(|k| r.iter().map(|v| v[k]).sum::<f32>() / r.len() as f32)).collect();
    let mut sums = [[0.0_f32; 3]; 3];
    for (row, mean) in rows.iter().zip(&means) {
        for v in row {
            for i in 0..3 {
                for j in 0..3 {
                    sums[i][j] += (v[i] - mean[i]) * (v[j] - mean[j]);
                }
            }
        }
    }
    let [_, [ya, aa, ab], [yb, _, bb]] = sums;
    let determinant = aa * bb - ab * ab;
    looks.slopes = vec![(ya * bb - yb * ab) / determinant, (yb * aa - ya * ab) / determinant];
    looks.base = means.iter().map(|m| m[0] - looks.slopes[0] * m[1] - looks.slopes[1] * m[2]).collect();
    println!(
        "  trust: slopes {:.2} and {:.2}; correlations of the logarithms {:.2} and {:.2}",
        looks.slopes[0],
        looks.slopes[1],
        ya / (aa * sums[0][0]).sqrt(),
        yb / (bb * sums[0][0]).sqrt()
    );
}
