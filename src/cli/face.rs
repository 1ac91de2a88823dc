//! `lianpu face`.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::json;

use super::output::spare;
use super::print::say;
use crate::disk::{Fault, Result, printable_json, shown, write_output};
use crate::drawing::Drawing;
use crate::face::{Anchors, Created, Face, FeaturePoint, How, create};
use crate::figure::Cartoon;
use crate::figure::cartoon::Style;
use crate::geometry::Point;
use crate::photo::{Photo, Stages};
use crate::plot;
use crate::pose::{Emotion, MouthPose, MouthPreset, MouthShape, Pose, Ratios};
use crate::project::{Lesson, LessonFace};
use crate::render::to_png;

/// Find the 72 points of a face and what else its cartoon needs.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The project: its face.toml is written; points set by hand stay.
    #[arg(value_name = "PROJECT", required_unless_present = "photo")]
    project: Option<PathBuf>,
    /// Which of its faces; the first where left out.
    #[arg(long, value_name = "NAME", requires = "project")]
    face: Option<String>,
    /// Any photo, without a project: PNG, JPEG or WebP. Nothing is kept.
    #[arg(long, value_name = "FILE", conflicts_with = "project")]
    photo: Option<PathBuf>,
    /// Where the face is, for a photo in which it is not found: the eye at the image's left, the
    /// one at its right, mouth, chin, in pixels.
    #[arg(long, value_name = "X,Y", num_args = 4, allow_hyphen_values = true)]
    at: Vec<String>,
    /// Print points, colours and warnings as JSON.
    #[arg(long)]
    json: bool,
    /// Draw the points over the photo.
    #[arg(long, value_name = "PNG")]
    overlay: Option<PathBuf>,
    /// Draw everything: photo, stages, points, cartoon, mouth shapes, emotions, styles.
    #[arg(long, value_name = "PNG")]
    sheet: Option<PathBuf>,
}

/// Finds the face and prints what was found.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    for path in [&args.overlay, &args.sheet].into_iter().flatten() {
        let inputs: Vec<&Path> = args.photo.iter().map(PathBuf::as_path).collect();
        spare(path, &inputs)?;
        if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("png")) {
            return Err(Fault::new(format!("`{}` does not end in .png", path.display()))
                .help("give a file that ends in .png")
                .of_the_call());
        }
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if !folder.is_dir() {
            return Err(Fault::new("there is no such folder")
                .at(folder)
                .help("make it, or give another")
                .of_the_call());
        }
    }
    let anchors = anchors(&args.at)?;
    let (photo, created, said) = match (&args.photo, &args.project) {
        (Some(path), _) => {
            let (photo, sha256) = Photo::read_with_sum(path)?;
            let created = create(&photo, &sha256, None, anchors.as_ref()).map_err(|f| f.at(path))?;
            (photo, created, None)
        }
        (None, Some(project)) => of_project(project, args, anchors.as_ref())?,
        // The parser asks for one of them.
        (None, None) => return Ok(()),
    };
    if let Some(path) = &args.overlay {
        write_png(path, &plot::face_over(&photo, &created.face, true))?;
    }
    if let Some(path) = &args.sheet {
        write_png(path, &sheet(&photo, &created.face)?)?;
    }
    if args.json {
        let text = serde_json::to_string_pretty(&as_json(&created)).unwrap_or_default();
        return say(out, printable_json(&text));
    }
    let mut line = |text: String| say(out, text);
    line(said.unwrap_or_else(|| summary(&created.face)))?;
    for warning in &created.warnings {
        line(format!("note: {warning}"))?;
    }
    for path in [&args.overlay, &args.sheet].into_iter().flatten() {
        line(shown(path))?;
    }
    Ok(())
}

/// The four places of `--at`.
pub(super) fn anchors(texts: &[String]) -> Result<Option<Anchors>> {
    let point = |text: &String| {
        let (x, y) = text.split_once(',')?;
        let number = |t: &str| t.trim().parse::<f64>().ok().filter(|v| v.is_finite());
        Some(Point::new(number(x)?, number(y)?))
    };
    let points: Option<Vec<Point>> = texts.iter().map(point).collect();
    match points.as_deref() {
        Some([]) => Ok(None),
        Some(&[left_eye, right_eye, mouth, chin]) => Ok(Some(Anchors { left_eye, right_eye, mouth, chin })),
        _ => Err(Fault::new("--at needs four places")
            .help("give left eye, right eye, mouth and chin as X,Y in pixels: --at 251,281 346,277 301,376 305,436")
            .of_the_call()),
    }
}

/// Finds the face of a project anew and writes its face.toml; what was done, in words.
fn of_project(project: &Path, args: &Args, anchors: Option<&Anchors>) -> Result<(Photo, Created, Option<String>)> {
    let mut lesson = Lesson::open(project)?;
    super::note_state(&lesson);
    let number = lesson.face_named(args.face.as_deref()).map_err(Fault::of_the_call)?;
    let face = &lesson.faces[number];
    let path = face.photo.clone().ok_or_else(|| no_photo(face))?;
    let (photo, sha256) = Photo::read_with_sum(&path)?;
    let created = create(&photo, &sha256, face.face.as_ref(), anchors).map_err(|f| f.at(&path))?;
    let done = if lesson.write_face(number, &created.face)? { "wrote" } else { "nothing has changed in" };
    let file = lesson.faces[number].path();
    let said = format!("{done} {}: {}", shown(&file), summary(&created.face));
    Ok((photo, created, Some(said)))
}

fn no_photo(face: &LessonFace) -> Fault {
    Fault::new(format!("the face `{}` has no photo", face.entry.name))
        .at(face.folder.join("neutral.png"))
        .help("put a photo there")
}

/// How many points are of which kind, in words.
fn summary(face: &Face) -> String {
    let count = |how: How| FeaturePoint::all().filter_map(|p| face.placed(p)).filter(|p| p.how == how).count();
    let all = FeaturePoint::all().filter(|p| face.placed(*p).is_some()).count();
    format!("{all} points: {} found, {} by rule, {} by hand", count(How::Found), count(How::Rule), count(How::Hand))
}

fn as_json(created: &Created) -> serde_json::Value {
    let face = &created.face;
    let round = |v: f64, steps: f64| (v * steps).round() / steps;
    let mut points = serde_json::Map::new();
    for point in FeaturePoint::all() {
        let Some(placed) = face.placed(point) else { continue };
        let row = json!({
            "x": round(placed.at.x, 100.0),
            "y": round(placed.at.y, 100.0),
            "confidence": round(placed.confidence, 1000.0),
            "how": placed.how,
        });
        points.insert(point.name(), row);
    }
    let c = &face.colours;
    json!({
        "points": points,
        "colours": {
            "skin": c.skin.hex(), "hair": c.hair.hex(), "lips": c.lips.hex(),
            "iris": c.iris.hex(), "brows": c.brows.hex(), "beard": c.beard.hex(),
        },
        "hair": face.hair.kind,
        "warnings": created.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

/// Photo, stages, points, the cartoon neutral, with its mouth shapes, emotions and styles.
fn sheet(photo: &Photo, face: &Face) -> Result<Drawing> {
    let normal = Style::built_in("normal")?;
    let cartoon = Cartoon::new(face, &normal);
    let [left, right] = [FeaturePoint::P3_6, FeaturePoint::P3_5].map(|p| face.points[p.index()].at);
    let mut stages = plot::stages(&Stages::with_eyes(photo, left, right)).into_iter();
    let mut parts: Vec<(String, Drawing)> = stages.next().into_iter().collect();
    parts.extend([
        ("its points".to_owned(), plot::face_over(photo, face, false)),
        ("the cartoon".to_owned(), cartoon.draw(&Pose::default())),
    ]);
    for name in Style::BUILT_IN.iter().filter(|n| **n != "normal") {
        let styled = Cartoon::new(face, &Style::built_in(name)?);
        parts.push((format!("style {name}"), styled.draw(&Pose::default())));
    }
    for emotion in Emotion::ALL {
        parts.push((emotion.name().to_owned(), cartoon.draw(&Pose::of(Ratios::pure(emotion)))));
    }
    for shape in MouthShape::ALL {
        let pose = Pose { mouth: MouthPose::of(shape, MouthPreset::Distinct), shape: Some(shape), ..Pose::default() };
        parts.push((format!("mouth {}", shape.letter()), cartoon.draw(&pose)));
    }
    parts.extend(stages);
    Ok(plot::sheet(&parts, 6))
}

/// The most pixels that a picture of this command is wide.
const WIDEST: f64 = 1800.0;

fn write_png(path: &Path, drawing: &Drawing) -> Result<()> {
    let view = drawing.view;
    let scale = (WIDEST / view.width()).min(WIDEST * 3.0 / view.height()).min(2.0);
    let (width, height) = ((view.width() * scale).round() as u32, (view.height() * scale).round() as u32);
    write_output(path, &to_png(drawing, width.max(16), height.max(16))?)
}
