//! Videos tracked: real frames followed to ratios, eyes, mouth and head; what is lost is said; streams that are cut.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use lianpu::aam::{Annotation, Grey, Kind, Model, Options as Training};
use lianpu::emotion::{Binding, Calibration, Shape, Source as From};
use lianpu::face::find::find;
use lianpu::geometry::Point;
use lianpu::photo::Photo;
use lianpu::track::{Options, Source, Tracked, by_aam};

mod test_data;

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
    let binding = Binding::by_place(points, &named, points[152].distance(points[153]));
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

#[test]
fn a_talking_man_is_tracked_without_loss() {
    let Some(franck) = &*FRANCK else { return };
    let source = Source::of(&franck.folder.join("frames"), 25.0).unwrap();
    let began = std::time::Instant::now();
    let tracked = tracked(franck, &source);
    println!("{:.2?}", began.elapsed());
    println!("{:?}", tracked.notes);
    if let Some(out) = std::env::var_os("TRACK_OUT") {
        std::fs::write(Path::new(&out).join("ratios.csv"), tracked.record.to_csv()).unwrap();
        std::fs::write(Path::new(&out).join("tracks.csv"), tracked.tracks.to_csv()).unwrap();
    }
    assert!(tracked.record.rows.iter().all(|r| r.confidence >= 0.5));
}
