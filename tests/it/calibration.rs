//! Calibration on real faces: how near the points of shots are found, what a calibration says of itself, its file.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use crate::support::test_data;
use std::collections::BTreeMap;
use std::path::Path;

use lianpu::aam::Annotation;
use lianpu::calibration::{Binding, Calibrated, CalibrationFile, Choice, Inputs, Marks, ShotFiles, Source, calibrate};
use lianpu::face::find::find;
use lianpu::face::{FeaturePoint as P, How, Part, Placed};
use lianpu::geometry::Point;
use lianpu::photo::Grey;
use lianpu::pose::Emotion;

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
fn measure(
    names: &[std::path::PathBuf],
    neutral: &(Grey, Vec<Point>),
    shots: &[(Grey, Vec<Point>)],
    own: &mut Errors,
    foreign: &mut Errors,
    base: &mut Errors,
) {
    let (grey, truth) = neutral;
    let Ok(found) = find(&grey.to_photo(), &[]) else {
        println!("no face in the neutral photo");
        return;
    };
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
        let mut inputs =
            if k == 0 { Inputs::own(grey, &found.points) } else { Inputs::foreign(grey, truth, &named).unwrap() };
        for ((grey, _), emotion) in shots.iter().zip(EMOTIONS) {
            inputs = inputs.with(emotion, grey, Vec::new()).unwrap();
        }
        let made = calibrate(&inputs).unwrap();
        for ((g, truth), emotion) in shots.iter().zip(EMOTIONS) {
            let Some(points) = &made.shots[emotion.index()] else {
                println!("not found: {:?}", made.quality.notes);
                continue;
            };
            let mut sums = (0.0, 0);
            if k == 0 {
                let raw = find(&g.to_photo(), &[]).unwrap();
                for (i, p) in &scored {
                    let part = match p.part() {
                        Part::Brows => "brow",
                        Part::Eyes => "eye",
                        Part::Nose => "nose",
                        Part::Mouth => "mouth",
                        _ => "face",
                    };
                    let at = hang.at(truth, *p).unwrap();
                    let e = 100.0 * at.distance(points[*i].at) / pupils;
                    if let Ok(path) = std::env::var("OVER") {
                        use std::io::Write;
                        let mut f = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
                        let q = points[*i].at;
                        writeln!(
                            f,
                            "{} {} {} {} {} {}",
                            names[EMOTIONS.iter().position(|e| *e == emotion).unwrap()].display(),
                            p,
                            q.x,
                            q.y,
                            at.x,
                            at.y
                        )
                        .unwrap();
                    }
                    own.entry(part).or_default().push(e);
                    own.entry("all").or_default().push(e);
                    base.entry(part).or_default().push(100.0 * at.distance(raw.points[p.index()].at) / pupils);
                    sums = (sums.0 + e, sums.1 + 1);
                }
            } else {
                for (i, at) in truth.iter().enumerate() {
                    let near = named
                        .iter()
                        .min_by(|a, b| {
                            let d = |p: &(P, Point)| p.1.distance(neutral.1[i]);
                            d(a).total_cmp(&d(b))
                        })
                        .unwrap()
                        .0;
                    let part = match near.part() {
                        Part::Brows => "brow",
                        Part::Eyes => "eye",
                        Part::Nose => "nose",
                        Part::Mouth => "mouth",
                        _ => "face",
                    };
                    let e = 100.0 * at.distance(points[i].at) / pupils;
                    foreign.entry(part).or_default().push(e);
                    foreign.entry("all").or_default().push(e);
                    sums = (sums.0 + e, sums.1 + 1);
                }
            }
            if let Source::Found(c) = made.calibration.shapes()[emotion.index()].source {
                let mut l: Vec<f64> = points.iter().map(|p| p.confidence).collect();
                l.sort_by(f64::total_cmp);
                println!(
                    "   {k} {emotion}: error {:.2}, confidence {c:.2}, points {:.2}..{:.2}",
                    sums.0 / sums.1 as f64,
                    l[0],
                    l[l.len() - 1]
                );
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
        let shots: Vec<_> =
            ["0075", "0260", "1080", "1090", "1095", "1195"].iter().map(|n| load(&folder, n, "pts")).collect();
        let names: Vec<_> =
            ["0075", "0260", "1080", "1090", "1095", "1195"].iter().map(|n| folder.join(format!("{n}.jpg"))).collect();
        measure(&names, &load(&folder, "0565", "pts"), &shots, &mut own, &mut foreign, &mut base);
    } else {
        let folder = test_data::find("faces/imm_frontal").unwrap();
        for p in ["01", "03", "05", "06", "09", "11"] {
            println!("person {p}");
            let shots: Vec<_> =
                [4, 6, 7, 8, 9, 10].iter().map(|k| load(&folder, &format!("{p}_{k:02}"), "asf")).collect();
            let names: Vec<_> = [4, 6, 7, 8, 9, 10].iter().map(|k| folder.join(format!("{p}_{k:02}.jpg"))).collect();
            measure(&names, &load(&folder, &format!("{p}_01"), "asf"), &shots, &mut own, &mut foreign, &mut base);
        }
    }
    print("finder alone", &base);
    print("own points", &own);
    print("foreign points", &foreign);
}

/// The talking man's neutral shot, and others as emotions.
fn franck(shots: &[&str], marked: bool) -> Option<Calibrated> {
    let folder = test_data::find("faces/franck/calibration")?;
    let (grey, points) = load(&folder, "0565", "pts");
    let found = find(&grey.to_photo(), &[]).unwrap();
    let named: Vec<(P, Point)> = Binding::own_points().map(|p| (p, found.points[p.index()].at)).collect();
    let loaded: Vec<_> = shots.iter().map(|n| load(&folder, n, "pts")).collect();
    let mut inputs = Inputs::foreign(&grey, &points, &named).unwrap();
    for ((grey, points), emotion) in loaded.iter().zip(EMOTIONS) {
        let sure = |p: &Point| Placed { at: *p, confidence: 1.0, how: How::Hand };
        let points = if marked { points.iter().map(sure).collect() } else { Vec::new() };
        inputs = inputs.with(emotion, grey, points).unwrap();
    }
    Some(calibrate(&inputs).unwrap())
}

/// Each shot returns its own emotion, whatever place, turn and size it is given in.
fn returns_its_own(made: &Calibrated) {
    for (shape, emotion) in made.calibration.shapes().iter().zip(Emotion::ALL) {
        let moved: Vec<Point> =
            shape.points.iter().map(|p| Point::new(3.0 * p.x - 0.8 * p.y + 90.0, 0.8 * p.x + 3.0 * p.y)).collect();
        let ratios = made.calibration.read(&moved, Choice::Paper).unwrap().ratios;
        for other in Emotion::ALL {
            let want = if other == emotion { 1.0 } else { 0.0 };
            assert!((ratios[other] - want).abs() < 0.01, "{emotion}: {ratios:?}");
        }
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn each_marked_shot_returns_its_own_emotion_and_the_file_keeps_all() {
    let Some(made) = franck(&["0075", "0260", "1080", "1090", "1095", "1195"], true) else { return };
    returns_its_own(&made);
    let q = &made.quality;
    println!("condition {:.1}, nearest {:?}, retake {:?}", q.condition, q.nearest, q.retake);
    println!("{:#?}", q.notes);
    assert!(q.condition.is_finite() && q.condition > 1.0);
    assert!(q.shots[1..].iter().all(|s| s.confidence == 1.0 && s.strength > 1.0 && s.residual < 3.0), "{:?}", q.shots);
    let inputs = [("neutral.png".to_owned(), "0a".repeat(32))].into();
    let file = CalibrationFile { calibration: made.calibration, quality: made.quality, model: "ab".repeat(32), inputs };
    let text = file.to_toml().unwrap();
    let again = CalibrationFile::parse(&text).unwrap();
    assert_eq!(again.to_toml().unwrap(), text);
    assert_eq!(again.calibration.shapes(), file.calibration.shapes());
    assert_eq!(again.calibration.laid(), file.calibration.laid());
    assert_eq!(again.quality, file.quality);
    for (from, to, what) in [
        ("format = 1", "format = 2", "format 2"),
        ("points = 154", "points = 153", "has 154 points"),
        ("source = \"marked\"", "source = \"guessed\"", "guessed"),
        (&"0a".repeat(32), "0a", "SHA-256"),
        ("[shapes.happy]", "[shapes.hapy]", "hapy"),
    ] {
        let wrong = text.replacen(from, to, 1);
        assert_ne!(wrong, text, "{from}");
        let fault = CalibrationFile::parse(&wrong).unwrap_err();
        assert!(fault.line_number().is_some() && fault.to_string().contains(what), "{fault}");
    }
    for cut in (0..text.len()).step_by(997) {
        if text.is_char_boundary(cut) {
            assert!(CalibrationFile::parse(&text[..cut]).is_err(), "{cut}");
        }
    }
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn shots_that_nobody_marked_are_found_and_a_missing_one_is_modelled_and_said() {
    let Some(folder) = test_data::find("faces/imm_frontal") else { return };
    let (neutral, _) = load(&folder, "05_01", "asf");
    let (smile, _) = load(&folder, "05_07", "asf");
    let found = find(&neutral.to_photo(), &[]).unwrap();
    let inputs = Inputs::own(&neutral, &found.points).with(Emotion::Happy, &smile, Vec::new()).unwrap();
    let made = calibrate(&inputs).unwrap();
    returns_its_own(&made);
    assert!(matches!(made.calibration.shapes()[1].source, Source::Found(c) if c > 0.4));
    assert!(made.calibration.shapes()[2..].iter().all(|s| s.source == Source::Modelled));
    assert!(made.quality.notes.iter().any(|n| n.contains("modelled")), "{:?}", made.quality.notes);
    // What a hand sets stands, exactly, and is not found again.
    let mut points = made.shots[1].clone().unwrap();
    points[33] = Placed { at: points[33].at + lianpu::geometry::Vec2::new(4.0, 2.0), confidence: 1.0, how: How::Hand };
    let corrected = points[33];
    let inputs = Inputs::own(&neutral, &found.points).with(Emotion::Happy, &smile, points).unwrap();
    assert_eq!(calibrate(&inputs).unwrap().shots[1].as_ref().unwrap()[33], corrected);
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_neutral_face_alone_still_gives_a_calibration_and_says_what_that_costs() {
    let Some(made) = franck(&[], true) else { return };
    returns_its_own(&made);
    assert!(made.quality.notes.iter().any(|n| n.contains("six")), "{:?}", made.quality.notes);
    assert!(made.quality.retake.is_none() && made.shots[1..].iter().all(Option::is_none));
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_folder_is_read_and_what_was_found_is_written_and_read_back() {
    let Some(from) = test_data::find("faces/franck/calibration") else { return };
    let room = tempfile::tempdir().unwrap();
    for (name, to) in [("0565", "neutral"), ("0075", "happy"), ("1095", "surprised")] {
        for ending in ["jpg", "pts"] {
            std::fs::copy(from.join(format!("{name}.{ending}")), room.path().join(format!("{to}.{ending}"))).unwrap();
        }
    }
    let files = ShotFiles::of(room.path()).unwrap();
    assert!(!files.are_own() && files.photos.iter().flatten().count() == 3 && files.sums.len() == 6);
    let made = calibrate(&files.inputs().unwrap()).unwrap();
    assert_eq!(made.calibration.shapes()[6].source, Source::Marked);
    std::fs::remove_file(room.path().join("neutral.pts")).unwrap();
    let fault = ShotFiles::of(room.path()).unwrap_err();
    assert!(fault.what().contains("points of the neutral photo"), "{fault}");
    let points: Vec<Placed> = Binding::own_points()
        .enumerate()
        .map(|(i, _)| Placed { at: Point::new(1.5 * i as f64, 2.25), confidence: 0.5, how: How::Found })
        .collect();
    let marks = Marks { points, photo: "0a".repeat(32) };
    assert_eq!(Marks::parse(&marks.to_toml()).unwrap(), marks);
    let fault = Marks::parse(&marks.to_toml().replace("\"8.4\" =", "\"8.44\" =")).unwrap_err();
    assert!(fault.line_number().is_some() && fault.what().contains("8.44"), "{fault}");
}

#[test]
#[cfg_attr(not(has_data), ignore = "needs LIANPU_DATA")]
fn a_persons_expressions_are_as_large_as_everybodys_and_turn_nothing_inside_out() {
    use lianpu::face::rig::{Expressions, Neutral, Proportions};
    use lianpu::pose::{Pose, Ratios};
    let Some(made) = franck(&["0075", "0260", "1080", "1090", "1095", "1195"], true) else { return };
    let own = made.calibration.expressions();
    assert_ne!(&own, Expressions::general());
    assert_eq!(own.expression(Emotion::Neutral), Expressions::general().expression(Emotion::Neutral));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/faces/mei.toml");
    let face = lianpu::face::Face::parse(&std::fs::read_to_string(path).unwrap()).unwrap();
    let places = face.places();
    let frame = lianpu::face::to_face_frame(places[P::P3_6], places[P::P3_5]);
    let points = lianpu::face::Points(places.0.map(|p| frame * p));
    let neutral = Neutral::of(&points, &Proportions::NORMAL).with_expressions(own);
    for emotion in Emotion::ALL {
        for amount in [0.5, 1.0, 2.0] {
            let posed = neutral.pose(&Pose::of(Ratios::some(emotion, amount)));
            assert!(posed.points.0.iter().all(|p| p.x.is_finite() && p.y.is_finite()));
            assert!(posed.eyes.iter().all(|e| e.opening() >= 0.0) && posed.mouth.gap() >= -1e-9);
        }
    }
    // With nothing calibrated it is everybody's.
    let alone = franck(&[], true).unwrap();
    assert_eq!(&alone.calibration.expressions(), Expressions::general());
}

/// How well the person's model follows the talking man, of so many shots, by agreement with another tracker.
#[test]
#[ignore = "a measure, not a check"]
fn followed() {
    use lianpu::aam::{Fitter, Start};
    let folder = test_data::find("faces/franck").unwrap();
    let calibration = folder.join("calibration");
    let neutral = load(&calibration, "0565", "pts");
    let found = find(&neutral.0.to_photo(), &[]).unwrap();
    let named: Vec<(P, Point)> = Binding::own_points().map(|p| (p, found.points[p.index()].at)).collect();
    let table = std::fs::read_to_string(folder.join("agreement_points.csv")).unwrap();
    let rows: Vec<Vec<Point>> = table
        .lines()
        .skip(1)
        .map(|line| {
            let numbers: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
            numbers[1..].chunks_exact(2).map(|c| Point::new(c[0], c[1])).collect()
        })
        .collect();
    let greys: Vec<Grey> =
        (0..rows.len()).step_by(2).map(|n| Grey::read(&folder.join(format!("frames/{n:04}.jpg"))).unwrap()).collect();
    for (what, marked, given) in [("seven marked", true, 6), ("six found", false, 6), ("neutral alone", false, 0)] {
        let mut inputs = Inputs::foreign(&neutral.0, &neutral.1, &named).unwrap();
        let shots: Vec<_> = ["0075", "0260", "1080", "1090", "1095", "1195"]
            .iter()
            .take(given)
            .map(|n| load(&calibration, n, "pts"))
            .collect();
        for ((g, points), e) in shots.iter().zip(EMOTIONS) {
            let placed = points.iter().map(|p| Placed { at: *p, confidence: 1.0, how: How::Hand }).collect();
            inputs = inputs.with(e, g, if marked { placed } else { Vec::new() }).unwrap();
        }
        let before = std::time::Instant::now();
        let made = calibrate(&inputs).unwrap();
        let took = before.elapsed();
        let mut fitter = Fitter::new(&made.model);
        let mut last: Option<lianpu::aam::Fit> = None;
        let (mut sum, mut lost, mut lids) = (0.0, 0, 0.0);
        for (k, grey) in greys.iter().enumerate() {
            let truth = &rows[2 * k];
            let fit = match &last {
                Some(l) => fitter.follow(grey, l),
                None => fitter.fit(grey, Start::Points(truth)),
            };
            let pupils = truth[152].distance(truth[153]);
            sum += fit.points.iter().zip(truth).map(|(a, b)| a.distance(*b)).sum::<f64>() / truth.len() as f64 / pupils;
            let b = made.calibration.binding();
            lids += [P::P3_2, P::P3_4, P::P8_4, P::P8_3, P::P8_2, P::P8_1]
                .iter()
                .map(|p| b.at(&fit.points, *p).unwrap().distance(b.at(truth, *p).unwrap()))
                .sum::<f64>()
                / 6.0
                / pupils;
            lost += usize::from(fit.confidence < 0.5);
            if fit.confidence >= 0.5 || last.is_none() {
                last = Some(fit);
            }
        }
        let n = greys.len() as f64;
        println!(
            "{what}: agreement {:.2} %, lids and lips {:.2} %, lost {lost} of {}, {:?} to calibrate, {} modes, notes {:?}",
            100.0 * sum / n,
            100.0 * lids / n,
            greys.len(),
            took,
            made.model.shapes().modes().len(),
            made.quality.notes
        );
    }
}
