//! Renders what `projects/xiyang` is made from: seven calibration shots and the frames of a man who says 夕陽真美, with the
//! ratios of every frame known, and where the points of his face are. He does not exist.
//!
//! ```sh
//! python3 tests/samples/xiyang.py projects/xiyang/clips/xiyang tests/truth
//! cargo run --release --features tools --example xiyang -- projects/xiyang tests/truth
//! ```
//!
//! The first command makes the sound and the times by which his mouth moves. `--only happy,20,40` renders that shot
//! and those frames alone into the first folder, for trying things out.

#![allow(dead_code, reason = "the portrait uses parts of what paints that this does not")]

use std::error::Error;
use std::fmt::Write;
use std::path::Path;

use image::codecs::jpeg::JpegEncoder;
use lianpu::calibration::Binding;
use lianpu::pose::{Emotion, MouthPreset, Ratios};
use lianpu::ratios::{Record, Row};
use lianpu::timeline::{Score, Sources, Spoken, Timeline};
use lianpu::timing::{Format, mouth_shape};

#[path = "portrait/act.rs"]
mod act;
#[path = "portrait/body.rs"]
mod body;
#[path = "portrait/curve.rs"]
mod curve;
#[path = "portrait/eye.rs"]
mod eye;
#[path = "portrait/figure.rs"]
mod figure;
#[path = "portrait/film.rs"]
mod film;
#[path = "portrait/flesh.rs"]
mod flesh;
#[path = "portrait/hair.rs"]
mod hair;
#[path = "portrait/head.rs"]
mod head;
#[path = "portrait/marks.rs"]
mod marks;
#[path = "portrait/mass.rs"]
mod mass;
#[path = "portrait/noise.rs"]
mod noise;
#[path = "portrait/person.rs"]
mod person;
#[path = "portrait/skin.rs"]
mod skin;
#[path = "portrait/skull.rs"]
mod skull;
#[path = "xiyang/story.rs"]
mod story;
#[path = "portrait/strand.rs"]
mod strand;
#[path = "xiyang/studio.rs"]
mod studio;
#[path = "portrait/vector.rs"]
mod vector;
#[path = "portrait/view.rs"]
mod view;

use story::{DURATION, FPS, Moment};
use studio::{Studio, Taken};

/// Sides of a frame and of a calibration shot, in pixels.
const FRAME: usize = 288;
const SHOT: usize = 480;

/// Quality of JPEG: of the frames and of the shots.
const FRAMES_QUALITY: u8 = 60;
const SHOTS_QUALITY: u8 = 85;

fn main() -> Result<(), Box<dyn Error>> {
    let usage = "xiyang PROJECT TRUTH [--only NAME,NAME…]";
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (project, truth, only) = match words.as_slice() {
        [project, truth] => (Path::new(project), Path::new(truth), None),
        [project, truth, flag, names] if flag == "--only" => {
            (Path::new(project), Path::new(truth), Some(names.split(',')))
        }
        _ => return Err(usage.into()),
    };
    let timeline = spoken(&truth.join("xiyang.TextGrid"))?;
    if let Some(names) = only {
        let studio = Studio::new(FRAME);
        for name in names {
            let taken = if let Ok(emotion) = name.parse::<Emotion>() {
                studio.take(&act::Act::mixed(&Ratios::pure(emotion).0), story::still(emotion), 0)
            } else {
                let moment = Moment::at(&timeline, name.parse()?);
                studio.take(&moment.act, moment.held, 0)
            };
            film::write(&project.join(format!("{name}.png")), FRAME, &taken.pixels)?;
        }
        return Ok(());
    }
    shots(&project.join("faces/teacher"), truth)?;
    frames(&timeline, &project.join("clips/xiyang/frames"), truth)
}

/// The seven calibration shots and their points.
fn shots(folder: &Path, truth: &Path) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(folder)?;
    let studio = Studio::new(SHOT);
    let mut text = format!("emotion,{}\n", columns());
    for emotion in Emotion::ALL {
        let act = act::Act::mixed(&Ratios::pure(emotion).0);
        let taken = studio.take(&act, story::still(emotion), 100 + emotion.index() as u64);
        match emotion {
            Emotion::Neutral => film::write(&folder.join("neutral.png"), SHOT, &taken.pixels)?,
            _ => std::fs::write(folder.join(format!("{}.jpg", emotion.name())), jpeg(&taken, SHOT, SHOTS_QUALITY)?)?,
        }
        writeln!(text, "{},{}", emotion.name(), points(&taken))?;
    }
    std::fs::write(truth.join("xiyang-shots.csv"), text)?;
    Ok(())
}

/// The frames, their ratios and their points.
fn frames(timeline: &Timeline, folder: &Path, truth: &Path) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(folder)?;
    let studio = Studio::new(FRAME);
    let mut record = Record::default();
    let mut text = format!("frame,speaking,closed,{}\n", columns());
    for frame in 0..(DURATION * FPS) as usize {
        let moment = Moment::at(timeline, frame);
        let taken = studio.take(&moment.act, moment.held, frame as u64);
        std::fs::write(folder.join(format!("{frame:04}.jpg")), jpeg(&taken, FRAME, FRAMES_QUALITY)?)?;
        let time = frame as f64 / FPS;
        record.rows.push(Row { frame: frame as u32, time, ratios: moment.ratios, confidence: 1.0 });
        writeln!(text, "{frame},{:.3},{:.3},{}", moment.speaking, moment.act.closed, points(&taken))?;
    }
    std::fs::write(truth.join("xiyang-ratios.csv"), record.to_csv())?;
    std::fs::write(truth.join("xiyang-points.csv"), text)?;
    Ok(())
}

/// A JPEG, its colour halved in each direction as cameras do it: the encoder does not.
fn jpeg(taken: &Taken, side: usize, quality: u8) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut pixels = taken.pixels.clone();
    for block in 0..(side / 2) * (side / 2) {
        let (x, y) = (block % (side / 2) * 2, block / (side / 2) * 2);
        let at = [0, 1].map(|j| [0, 1].map(|i| 3 * ((y + j) * side + x + i)));
        let places = [at[0][0], at[0][1], at[1][0], at[1][1]];
        let luma = |p: &[u8]| 0.299 * f32::from(p[0]) + 0.587 * f32::from(p[1]) + 0.114 * f32::from(p[2]);
        for channel in 0..3 {
            let over = |at: usize| f32::from(taken.pixels[at + channel]) - luma(&taken.pixels[at..at + 3]);
            let mean = places.iter().map(|at| over(*at)).sum::<f32>() / 4.0;
            for at in places {
                pixels[at + channel] = (luma(&taken.pixels[at..at + 3]) + mean + 0.5).clamp(0.0, 255.0) as u8;
            }
        }
    }
    let mut bytes = Vec::new();
    let wide = side as u32;
    JpegEncoder::new_with_quality(&mut bytes, quality).encode(&pixels, wide, wide, image::ExtendedColorType::Rgb8)?;
    Ok(bytes)
}

/// The columns of a table of points: the points of a model of our own, in its order.
fn columns() -> String {
    Binding::own_points().map(|p| format!("{p}x,{p}y")).collect::<Vec<_>>().join(",")
}

fn points(taken: &Taken) -> String {
    let of = |name: &str| taken.points.iter().find(|(n, _)| *n == name).map_or((f32::NAN, f32::NAN), |(_, at)| *at);
    let cell = |p: lianpu::face::FeaturePoint| {
        let (x, y) = of(&p.name());
        format!("{x:.2},{y:.2}")
    };
    Binding::own_points().map(cell).collect::<Vec<_>>().join(",")
}

/// The mouth of speech, by the synthesiser's own times.
fn spoken(path: &Path) -> Result<Timeline, Box<dyn Error>> {
    let timing = lianpu::timing::parse(&std::fs::read(path)?, Format::TextGrid)?;
    let tier = timing.shapes().ok_or("the times have no tier of shapes")?;
    let spoken: Vec<Spoken> = tier
        .spoken()
        .filter_map(|i| {
            let shape = mouth_shape(&i.label)?;
            Some(Spoken { start: i.start, end: i.end, shapes: vec![(0.0, shape)], exact: true })
        })
        .collect();
    Ok(Timeline::build(&Sources {
        duration: DURATION,
        fps: FPS,
        spoken: &spoken,
        record: None,
        tracks: None,
        score: &Score::default(),
        mouths: MouthPreset::Distinct,
    }))
}
