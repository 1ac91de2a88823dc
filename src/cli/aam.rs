//! `lianpu aam`: active appearance models, trained, fitted and looked at.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Subcommand, ValueEnum};
use serde_json::json;

use super::output::spare;
use super::output_fault;
use super::print::say;
use crate::aam::{Annotation, Fit, Fitter, Kind, Model, Options, Shot, Start};
use crate::disk::{self, Fault, Result, printable_json, shown, write_output};
use crate::face::find::find;
use crate::geometry::{Point, Rect};
use crate::photo::Grey;
use crate::plot;
use crate::render::to_png;

/// Train, fit and look at active appearance models.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Learn a model from a folder of annotated pictures: .pts, .asf, dlib .xml or face.toml.
    Train(Train),
    /// Find a model's points in pictures.
    Fit(FitArgs),
    /// Draw a model: its mean and its modes at two deviations to either side.
    Inspect(Inspect),
}

#[derive(Debug, clap::Args)]
struct Train {
    /// The folder of pictures with their annotations.
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// Where the model goes.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Whom it is to fit.
    #[arg(long, value_enum, default_value = "person", value_name = "WHOM")]
    of: Whom,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Whom {
    /// The one person in the pictures: quick and close.
    Person,
    /// People who are not in the pictures too: slower, and less close.
    Anyone,
}

#[derive(Debug, clap::Args)]
struct FitArgs {
    /// The model.
    #[arg(value_name = "MODEL")]
    model: PathBuf,
    /// The pictures: PNG, JPEG or WebP.
    #[arg(value_name = "IMAGES", required = true)]
    images: Vec<PathBuf>,
    /// A JSON object a picture, a line each.
    #[arg(long)]
    json: bool,
    /// Begin with the points of an annotation of the model's order.
    #[arg(long, value_name = "FILE", conflicts_with = "box")]
    start: Option<PathBuf>,
    /// Begin with the mean shape in this box, in pixels. Else the face is searched for.
    #[arg(long = "box", value_name = "X,Y,W,H", allow_hyphen_values = true)]
    r#box: Option<String>,
    /// The pictures follow each other: begin each with the points of the one before.
    #[arg(long)]
    sequence: bool,
}

#[derive(Debug, clap::Args)]
struct Inspect {
    /// The model.
    #[arg(value_name = "MODEL")]
    model: PathBuf,
    /// The picture to write.
    #[arg(long, value_name = "PNG")]
    out: PathBuf,
}

/// Runs one of them.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    match &args.what {
        What::Train(args) => train(args, out),
        What::Fit(args) => fit(args, out),
        What::Inspect(args) => inspect(args, out),
    }
}

fn train(args: &Train, out: &mut dyn Write) -> Result<()> {
    let inputs = disk::list(&args.folder).unwrap_or_default();
    spare(&args.out, &inputs.iter().map(PathBuf::as_path).collect::<Vec<_>>())?;
    let shots = Shot::read_folder(&args.folder)?;
    let pairs: Vec<(&Grey, &[Point])> = shots.iter().map(|s| (&s.grey, &s.points[..])).collect();
    let kind = match args.of {
        Whom::Person => Kind::Person,
        Whom::Anyone => Kind::Anyone,
    };
    let model = Model::train(&pairs, &Options::of(kind)).map_err(|f| f.at(&args.folder))?;
    model.write(&args.out)?;
    let [pixels, parameters] = model.size();
    writeln!(
        out,
        "wrote {}: {} pictures, {} points, {} modes of the shape; {pixels} pixels and {parameters} parameters are fitted",
        args.out.display(),
        shots.len(),
        model.count(),
        model.shapes().modes().len(),
    )
    .map_err(output_fault)
}

fn fit(args: &FitArgs, out: &mut dyn Write) -> Result<()> {
    let area = args.r#box.as_deref().map(of_box).transpose()?;
    let model = Model::read(&args.model)?;
    let start = args.start.as_deref().map(|path| of_file(path, &model)).transpose()?;
    let mut fitter = Fitter::new(&model);
    let mut last: Option<Fit> = None;
    for path in &args.images {
        let grey = Grey::read(path)?;
        let before = last.take().filter(|f| args.sequence && f.confidence >= 0.5);
        let fit = match (&before, &start, area) {
            (Some(before), ..) => fitter.follow(&grey, before),
            (None, Some(points), _) => {
                let points = points.in_pixels([grey.width(), grey.height()]);
                fitter.fit(&grey, Start::Points(&points))
            }
            (None, None, Some(area)) => fitter.fit(&grey, Start::Box(area)),
            (None, None, None) => {
                let found = find(&grey.to_photo(), &[]).map_err(|refusal| {
                    Fault::new(refusal.to_string())
                        .at(path)
                        .help("say where the face is: --start FILE.pts or --box X,Y,W,H")
                })?;
                let points = model.start(&found).ok_or_else(|| {
                    Fault::new("the model does not know where its points lie on a face that was searched for")
                        .at(&args.model)
                        .help("say where the face is: --start FILE.pts or --box X,Y,W,H")
                })?;
                fitter.fit(&grey, Start::Points(&points))
            }
        };
        let fit = if args.sequence { fit } else { fitter.refine(&grey, &fit) };
        let line = if args.json { printable_json(&as_json(path, &fit)).into_owned() } else { in_words(path, &fit) };
        say(out, line)?;
        last = Some(fit);
    }
    Ok(())
}

fn as_json(path: &Path, fit: &Fit) -> String {
    let round = |v: f64, steps: f64| (v * steps).round() / steps;
    let points: Vec<[f64; 2]> = fit.points.iter().map(|p| [round(p.x, 1000.0), round(p.y, 1000.0)]).collect();
    json!({
        "image": path.display().to_string(),
        "points": points,
        "converged": fit.converged,
        "confidence": round(fit.confidence, 1000.0),
        "iterations": fit.iterations,
    })
    .to_string()
}

fn in_words(path: &Path, fit: &Fit) -> String {
    let said = if fit.confidence >= 0.5 { "found" } else { "not sure" };
    let percent = 100.0 * fit.confidence;
    format!("{}: {said}, confidence {percent:.0} %, {} steps", path.display(), fit.iterations)
}

/// The points to begin with, of a file that annotates one face.
fn of_file(path: &Path, model: &Model) -> Result<Annotation> {
    let mut list = Annotation::read(path)?;
    let count = model.count();
    match (list.pop(), list.is_empty()) {
        (Some(one), true) if one.points.len() == count => Ok(one),
        (Some(one), true) => Err(Fault::new(format!("it has {} points, and the model {count}", one.points.len()))
            .at(path)
            .help("begin with points in the order of the model's training annotation")),
        _ => Err(Fault::new("it annotates more than one face")
            .at(path)
            .help("give a file with the points to begin with")),
    }
}

fn of_box(text: &str) -> Result<Rect> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|t| t.trim().parse::<f64>().ok().filter(|v| v.abs() < 1e5)).collect();
    match numbers.as_deref() {
        Some(&[x, y, w, h]) if w > 1.0 && h > 1.0 => Ok(Rect::new(x, y, x + w, y + h)),
        _ => Err(Fault::new(format!("`{text}` is no box"))
            .help("give left, top, width and height of the points' box in pixels: --box 210,150,180,220")
            .of_the_call()),
    }
}

fn inspect(args: &Inspect, out: &mut dyn Write) -> Result<()> {
    if args.out.extension().is_none_or(|e| !e.eq_ignore_ascii_case("png")) {
        return Err(Fault::new(format!("`{}` does not end in .png", args.out.display()))
            .help("give a file that ends in .png")
            .of_the_call());
    }
    spare(&args.out, &[&args.model])?;
    let model = Model::read(&args.model)?;
    let drawing = plot::model(&model);
    let scale = (1800.0 / drawing.view.width()).min(2.0);
    let size = [drawing.view.width(), drawing.view.height()].map(|v| (v * scale).round().max(16.0) as u32);
    write_output(&args.out, &to_png(&drawing, size[0], size[1])?)?;
    say(out, shown(&args.out))
}
