//! Calibration on real faces: how near the points of shots are found, what a calibration says of itself, its file.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::collections::BTreeMap;
use std::path::Path;

use lianpu::aam::{Annotation, Grey};
use lianpu::emotion::{Binding, Inputs, Source, calibrate};
use lianpu::face::find::find;
use lianpu::face::{FeaturePoint as P, Part};
use lianpu::geometry::Point;
use lianpu::pose::Emotion;

mod test_data;

fn load(folder: &Path, name: &str, ending: &str) -> (Grey, Vec<Point>) {
    let grey = Grey::read(&folder.join(format!("{name}.jpg"))).unwrap();
    let list = Annotation::read(&folder.join(format!("{name}.{ending}"))).unwrap();
    let points = list[0].in_pixels([grey.width(), grey.height()]);
    (grey, points)
}

type Errors = BTreeMap<&'static str, Vec<f64>>;

fn print(what: &str, errors: &Errors) {
    let mut line = format!("{what:28}");
    for (part, list) in errors {
        let mean = list.iter().sum::<f64>() / list.len().max(1) as f64;
        let far = list.iter().filter(|e| **e > 6.0).count() as f64 / list.len().max(1) as f64;
        line += &format!(" {part} {mean:.2} ({:.0}% >6)", 100.0 * far);
    }
    println!("{line}");
}

const EMOTIONS: [Emotion; 6] =
    [Emotion::Happy, Emotion::Anger, Emotion::Disgust, Emotion::Sadness, Emotion::Fear, Emotion::Surprised];

/// Found points against the truth, by part: our own points, and somebody's.
fn measure(names: &[std::path::PathBuf], neutral: &(Grey, Vec<Point>), shots: &[(Grey, Vec<Point>)], own: &mut Errors, foreign: &mut Errors, base: &mut Errors) {
    let (grey, truth) = neutral;
    let Ok(found) = find(&grey.to_photo(), &[]) else { println!("no face in the neutral photo"); return };
    let named: Vec<(P, Point)> = Binding::own_points().map(|p| (p, found.points[p.index()].at)).collect();
    let pupils = found.points[P::P3_6.index()].at.distance(found.points[P::P3_5.index()].at);
    let hang = Binding::by_place(truth, &named, pupils);
    // Points that hang well within the annotation.
    let scored: Vec<(usize, P)> = Binding::own_points()
        .enumerate()
        .filter(|(_, p)| hang.rows().iter().any(|(n, sum)| n == p && sum.iter().all(|(_, s)| *s > -0.3)))
        .filter(|(_, p)| ![P::P2_2, P::P2_3, P::P3_6, P::P3_5].contains(p))
        .collect();
    for k in [0, 1] {
        let mut inputs = if k == 0 {
            Inputs::own(grey, &found.points)
        } else {
            Inputs::foreign(grey, truth, &named).unwrap()
        };
        for ((grey, _), emotion) in shots.iter().zip(EMOTIONS) {
            inputs = inputs.with(emotion, grey, Vec::new()).unwrap();
        }
        let made = calibrate(&inputs).unwrap();
        for ((g, truth), emotion) in shots.iter().zip(EMOTIONS) {
            let Some(points) = &made.shots[emotion.index()] else { println!("not found: {:?}", made.quality.notes); continue };
            let mut sums = (0.0, 0);
            if k == 0 {
                let raw = find(&g.to_photo(), &[]).unwrap();
                for (i, p) in &scored {
                    let part = match p.part() { Part::Brows => "brow", Part::Eyes => "eye", Part::Nose => "nose", Part::Mouth => "mouth", _ => "face" };
                    let at = hang.at(truth, *p).unwrap();
                    let e = 100.0 * at.distance(points[*i].at) / pupils;
                    if let Ok(path) = std::env::var("OVER") {
                        use std::io::Write;
                        let mut f = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
                        let q = points[*i].at;
                        writeln!(f, "{} {} {} {} {} {}", names[EMOTIONS.iter().position(|e| *e == emotion).unwrap()].display(), p, q.x, q.y, at.x, at.y).unwrap();
                    }
                    own.entry(part).or_default().push(e);
                    own.entry("all").or_default().push(e);
                    base.entry(part).or_default().push(100.0 * at.distance(raw.points[p.index()].at) / pupils);
                    sums = (sums.0 + e, sums.1 + 1);
                }
            } else {
                for (i, at) in truth.iter().enumerate() {
                    let near = named.iter().min_by(|a, b| {
                        let d = |p: &(P, Point)| p.1.distance(neutral.1[i]);
                        d(a).total_cmp(&d(b))
                    }).unwrap().0;
                    let part = match near.part() { Part::Brows => "brow", Part::Eyes => "eye", Part::Nose => "nose", Part::Mouth => "mouth", _ => "face" };
                    let e = 100.0 * at.distance(points[i].at) / pupils;
                    foreign.entry(part).or_default().push(e);
                    foreign.entry("all").or_default().push(e);
                    sums = (sums.0 + e, sums.1 + 1);
                }
            }
            if let Source::Found(c) = made.calibration.shapes()[emotion.index()].source {
                let mut l: Vec<f64> = points.iter().map(|p| p.confidence).collect();
                l.sort_by(f64::total_cmp);
                println!("   {k} {emotion}: error {:.2}, confidence {c:.2}, points {:.2}..{:.2}", sums.0 / sums.1 as f64, l[0], l[l.len() - 1]);
            }
        }
    }
}

#[test]
#[ignore = "a measure, not a check"]
fn measured() {
    let which = std::env::var("SET").unwrap_or("imm240".into());
    let (mut own, mut foreign, mut base) = (Errors::new(), Errors::new(), Errors::new());
    if which == "imm240" {
        let folder = test_data::find("faces/imm240").unwrap();
        let people: usize = std::env::var("N").map_or(10, |n| n.parse().unwrap());
        for p in std::env::var("FROM").map_or(1, |n| n.parse().unwrap())..=people {
            let name = |k: usize| {
                let of = |sex: &str| format!("{p:02}-{k}{sex}");
                if folder.join(of("m") + ".jpg").exists() { of("m") } else { of("f") }
            };
            println!("person {p}");
            let shots: Vec<_> = [2, 6].iter().map(|k| load(&folder, &name(*k), "asf")).collect();
            let names: Vec<_> = [2, 6].iter().map(|k| folder.join(name(*k) + ".jpg")).collect();
            measure(&names, &load(&folder, &name(1), "asf"), &shots, &mut own, &mut foreign, &mut base);
        }
    } else if which == "franck" {
        let folder = test_data::find("faces/franck/calibration").unwrap();
        let shots: Vec<_> = ["0075", "0260", "1080", "1090", "1095", "1195"].iter().map(|n| load(&folder, n, "pts")).collect();
        let names: Vec<_> = ["0075", "0260", "1080", "1090", "1095", "1195"].iter().map(|n| folder.join(format!("{n}.jpg"))).collect();
        measure(&names, &load(&folder, "0565", "pts"), &shots, &mut own, &mut foreign, &mut base);
    } else {
        let folder = test_data::find("faces/imm_frontal").unwrap();
        for p in ["01", "03", "05", "06", "09", "11"] {
            println!("person {p}");
            let shots: Vec<_> = [4, 6, 7, 8, 9, 10].iter().map(|k| load(&folder, &format!("{p}_{k:02}"), "asf")).collect();
            let names: Vec<_> = [4, 6, 7, 8, 9, 10].iter().map(|k| folder.join(format!("{p}_{k:02}.jpg"))).collect();
            measure(&names, &load(&folder, &format!("{p}_01"), "asf"), &shots, &mut own, &mut foreign, &mut base);
        }
    }
    print("finder alone", &base);
    print("own points", &own);
    print("foreign points", &foreign);
}
