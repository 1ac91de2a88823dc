//! Videos tracked: real frames followed to ratios, eyes, mouth and head; what is lost is said; streams that are cut.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

mod closely;
mod live;
mod lost;
mod regions;
mod streams;

use crate::support::test_data;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use lianpu::aam::{Annotation, Kind, Model, Options as Training};
use lianpu::calibration::{Binding, Calibration, Shape, Source as From};
use lianpu::face::FeaturePoint as P;
use lianpu::face::find::find;
use lianpu::geometry::Point;
use lianpu::media::Source;
use lianpu::photo::Grey;
use lianpu::photo::Photo;
use lianpu::track::{Options, Tracked, by_aam};

/// The shots of a man talking, in the order of the seven emotions. Only the first two are what they are called.
const SHOTS: [&str; 7] = ["0565", "0075", "1090", "1195", "0260", "1080", "1095"];

struct Franck {
    folder: PathBuf,
    model: Model,
    calibration: Calibration,
}

static FRANCK: LazyLock<Option<Franck>> = LazyLock::new(|| {
    let folder = test_data::find("faces/franck")?;
    let shots = SHOTS.map(|name| load(&folder.join("calibration"), name));
    let pairs: Vec<(&Grey, &[Point])> = shots.iter().map(|(g, s)| (g, &s[..])).collect();
    let model = Model::train(&pairs, &Training::of(Kind::Person)).unwrap();
    let neutral = Photo::read(&folder.join("calibration/0565.jpg")).unwrap();
    let found = find(&neutral, &[]).unwrap();
    let named: Vec<_> = Binding::own_points().map(|p| (p, found.points[p.index()].at)).collect();
    let points = &shots[0].1;
    let placed = Binding::by_place(points, &named, points[152].distance(points[153]));
    // Where lips meet one picture does not tell which point is whose; these are the upper and the lower lip's.
    let lips = [(P::P8_1, 0), (P::P2_2, 8), (P::P2_3, 9), (P::P8_2, 10)];
    let rows = placed.rows().iter().map(|(name, sum)| match lips.iter().find(|(lip, _)| lip == name) {
        Some((_, point)) => (*name, vec![(*point, 1.0)]),
        None => (*name, sum.clone()),
    });
    let binding = Binding::of_rows(points.len(), rows.collect());
    let shapes = shots.clone().map(|(_, points)| Shape { points, source: From::Marked });
    Some(Franck { folder, model, calibration: Calibration::new(shapes, binding).unwrap() })
});

fn load(folder: &Path, name: &str) -> (Grey, Vec<Point>) {
    let grey = Grey::read(&folder.join(format!("{name}.jpg"))).unwrap();
    let points = Annotation::read(&folder.join(format!("{name}.pts"))).unwrap().remove(0).points;
    (grey, points)
}

fn tracked(franck: &Franck, source: &Source) -> Tracked {
    by_aam(source, &franck.model, &franck.calibration, &Options::default(), &mut |_, _| true).unwrap()
}

fn frame_path(franck: &Franck, n: usize) -> PathBuf {
    franck.folder.join(format!("frames/{n:04}.jpg"))
}

fn quantiles(values: &[f64]) -> [f64; 5] {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    [0.0, 0.05, 0.5, 0.95, 1.0].map(|q| sorted[(q * (sorted.len() - 1) as f64) as usize])
}

/// Frames of franck from `first` on, changed, in a folder of their own. `change` gives what each becomes, from its number
/// among `count`.
fn staged(franck: &Franck, first: usize, count: usize, change: impl Fn(usize, &Grey) -> Grey) -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    for n in 0..count {
        let grey = change(n, &Grey::read(&frame_path(franck, first + n)).unwrap());
        let image = image::GrayImage::from_raw(grey.width() as u32, grey.height() as u32, grey.pixels().to_vec());
        image.unwrap().save(dir.path().join(format!("{n}.png"))).unwrap();
    }
    dir
}

fn pixels(like: &Grey, at: impl Fn(isize, isize) -> u8) -> Grey {
    let (w, h) = (like.width(), like.height());
    Grey::new(w, h, (0..w * h).map(|i| at((i % w) as isize, (i / w) as isize)).collect())
}

/// The picture moved to the right; what comes in from the left is its border.
fn shifted(grey: &Grey, by: isize) -> Grey {
    let (w, photo) = (grey.width() as isize, grey.pixels());
    pixels(grey, |x, y| photo[(y * w + (x - by).clamp(0, w - 1)) as usize])
}
