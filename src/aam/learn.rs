//! Training: from annotated pictures to a model.

use super::appearance::textures;
use super::detected::Detected;
use super::file::WIDTHS;
use super::fit::prepared;
use super::ground::{Channels, Ground};
use super::level::{Look, Texture};
use super::mesh::triangles;
use super::mirror::mirrored;
use super::model::{Model, Parts};
use super::shape::Shapes;
use super::table::Table;
use super::trust::Trust;
use crate::disk::{Fault, Result};
use crate::geometry::{Point, Rect};
use crate::photo::Grey;

/// Whom a model is to fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kind {
    /// The person it is trained on.
    #[default]
    Person,
    /// Others too.
    Anyone,
}

/// How a model is trained.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Whom it is to fit.
    pub kind: Kind,
    /// How many pixels of the mean shape are compared, from coarse to fine.
    pub pixels: Vec<usize>,
    /// How many modes of the shape move at each level.
    pub modes: Vec<usize>,
    /// How often the picture is smoothed at each level.
    pub smooth: Vec<u32>,
    /// The share of the shapes' variance that their modes hold.
    pub shape_share: f64,
    /// The share of the textures' variance that their modes hold.
    pub texture_share: f64,
    /// The most modes of the texture.
    pub texture_most: usize,
    /// Whether to compare where edges run instead of luma.
    pub edges: bool,
    /// Whether what lies just outside the points' border is looked at too.
    pub skirt: bool,
    /// Whether shape and look are fitted at once.
    pub simultaneous: bool,
    /// Whether to learn from mirror images too, where the points are those of something symmetric.
    pub mirror: bool,
    /// Whether to learn, from the pictures, where a fit begins when the face is searched for.
    pub detect: bool,
    /// How many of the pictures, the last ones, were made and not taken: they teach nothing of where faces are found.
    pub made: usize,
}

impl Options {
    /// For a kind.
    #[must_use]
    pub fn of(kind: Kind) -> Self {
        match kind {
            Kind::Person => Self {
                kind,
                pixels: vec![1_700, 11_000],
                modes: vec![3, 20],
                smooth: vec![2, 0],
                shape_share: 0.9999,
                texture_share: 0.9999,
                texture_most: 60,
                detect: true,
                made: 0,
                edges: false,
                mirror: false,
                skirt: false,
                simultaneous: false,
            },
            Kind::Anyone => Self {
                kind,
                pixels: vec![2_100, 13_000],
                modes: vec![4, 16],
                smooth: vec![2, 1],
                shape_share: 0.97,
                texture_share: 0.95,
                texture_most: 60,
                detect: true,
                made: 0,
                edges: true,
                mirror: true,
                skirt: true,
                simultaneous: true,
            },
        }
    }
}

impl Model {
    /// Trains on pictures and the points in them, in pixels.
    ///
    /// # Errors
    /// When there are fewer than two, they do not have equally many points, or nothing can be learned from them.
    pub fn train(shots: &[(&Grey, &[Point])], options: &Options) -> Result<Self> {
        let [(_, first), _, ..] = shots else {
            return Err(Fault::new("a model needs two annotated pictures or more").help("annotate another picture"));
        };
        if let Some(at) = shots.iter().position(|(_, s)| s.len() != first.len()) {
            let what = format!("picture {} has {} points, the first {}", at + 1, shots[at].1.len(), first.len());
            return Err(Fault::new(what).help("mark the same points in every picture"));
        }
        let taken = shots.len().saturating_sub(options.made);
        let twins = if options.mirror { mirrored(shots) } else { Vec::new() };
        let doubled: Vec<(&Grey, &[Point])> =
            shots.iter().copied().chain(twins.iter().map(|(grey, points)| (grey, &points[..]))).collect();
        let shots = &doubled[..];
        let marked: Vec<Vec<Point>> = shots.iter().map(|(_, s)| s.to_vec()).collect();
        let (marked, border) = if options.skirt {
            Self::with_skirts(&marked).unwrap_or((marked, Vec::new()))
        } else {
            (marked, Vec::new())
        };
        let outer: Vec<(&Grey, &[Point])> = shots.iter().zip(&marked).map(|((g, _), s)| (*g, &s[..])).collect();
        let shots = &outer[..];
        let flat = || Fault::new("nothing can be learned from these points").help("are they marked in every picture?");
        let shapes = Shapes::learned(&marked, options.shape_share, 40).ok_or_else(flat)?;
        let triangles = triangles(&shapes.mean());
        let channels = if options.edges { Channels::Edges } else { Channels::Luma };
        let mut stored = Vec::new();
        for ((pixels, modes), smooth) in options.pixels.iter().zip(&options.modes).zip(&options.smooth) {
            let width = width_of(&shapes.mean(), &triangles, *pixels);
            let table = Table::new(&shapes.mean(), &triangles, width);
            let live: Vec<bool> = (0..channels.count()).flat_map(|_| table.places()).map(|at| at.is_some()).collect();
            let readings: Vec<Vec<f32>> = shots
                .iter()
                .map(|(grey, points)| reading(&shapes, &table, grey, points, width, *smooth, channels).ok_or_else(flat))
                .collect::<Result<_>>()?;
            // Of few pictures the weakest modes are what is peculiar to one of them.
            let most = options.texture_most.min((2 * (shots.len() - 1)).div_ceil(3));
            let found = textures(&readings, &live, options.texture_share, most).ok_or_else(|| {
                Fault::new("a picture is one flat grey under its points").help("give a photo of a face")
            })?;
            let packed = |(texture, deviation): &(Vec<f64>, f64)| {
                let values: Vec<f64> = texture.iter().zip(&live).filter(|(_, l)| **l).map(|(v, _)| *v).collect();
                Texture::of(&values, *deviation)
            };
            stored.push(Look {
                width: width as f32,
                modes: (*modes).min(shapes.modes().len()),
                smooth: *smooth,
                channels,
                textures: found.iter().map(packed).collect(),
            });
        }
        let seen = if options.made > 0 { &shots[..taken] } else { shots };
        let detected = if options.detect { Detected::learned(&shapes, seen) } else { None };
        // Measured: of a person's own model fits that are right leave 0.05 to 0.42 over, those that are wrong 0.77 and
        // more; of strangers, by edges, up to 0.75, and 0.89 and more.
        let trust = match options.kind {
            Kind::Person => Trust { even: 0.55, steep: 6.0 },
            Kind::Anyone => Trust { even: 0.82, steep: 14.0 },
        };
        let simultaneous = options.simultaneous;
        Self::of(Parts { shapes, stored, trust, detected, border, simultaneous }).ok_or_else(flat)
    }
}

/// How wide a mean shape of the width 1 is drawn, in pixels, so that its triangles hold so many.
fn width_of(mean: &[Point], triangles: &[[usize; 3]], pixels: usize) -> f64 {
    let area = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|v| mean[v]);
        (b - a).cross(c - a).abs() / 2.0
    };
    let all: f64 = triangles.iter().map(area).sum();
    let [least, most] = [WIDTHS.start(), WIDTHS.end()].map(|w| f64::from(*w));
    (pixels as f64 / all.max(1e-9)).sqrt().clamp(least, most)
}

/// A picture read where a shape lies, as a fit reads it.
fn reading(
    shapes: &Shapes,
    table: &Table,
    grey: &Grey,
    points: &[Point],
    width: f64,
    smooth: u32,
    channels: Channels,
) -> Option<Vec<f32>> {
    let (q, _) = shapes.describe(points)?;
    let mut xs: Vec<f32> = points.iter().map(|p| p.x as f32).collect();
    let mut ys: Vec<f32> = points.iter().map(|p| p.y as f32).collect();
    let first = Rect::from_points(points[0], points[0]);
    let region = points.iter().fold(first, |r, p| r.union_pt(*p)).inflate(0.1 * q.scale(), 0.1 * q.scale());
    let mut ground = Ground::default();
    let (halvings, smooth) = prepared((q.scale() / width) as f32, smooth);
    ground.lay(grey, region, halvings, smooth, channels);
    ground.enter(&mut xs, &mut ys);
    let mut out = vec![0.0; table.len() * channels.count()];
    table.read(&ground, &xs, &ys, &mut out);
    Some(out)
}
