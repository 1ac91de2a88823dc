//! `lianpu plot`.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::output::spare;
use super::print::{self, say};
use crate::disk::{Fault, Result, read_bytes, shown, write_output};
use crate::drawing::Drawing;
use crate::plot;
use crate::pose::{Emotion, Pose, Ratios};
use crate::project::Lesson;
use crate::render::{FontFile, MAX_SIDE, Painter, encode_png, to_svg, uncovered_in};
use crate::timeline::Timeline;

/// Draw charts of a clip.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The project.
    #[arg(value_name = "PROJECT")]
    project: PathBuf,
    /// Which chart.
    #[arg(long, value_enum)]
    what: What,
    /// Moments in seconds, with commas between them: for `frame` one, for `faces` as many as you like.
    #[arg(long, value_name = "TIME", value_delimiter = ',', allow_negative_numbers = true)]
    at: Vec<f64>,
    /// The clip; the first where left out.
    #[arg(long)]
    clip: Option<String>,
    /// Where to, an .svg or .png file; PROJECT/export/CLIP-WHAT.svg where left out.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// A font with Chinese characters for .png files; without one they are drawn as Pinyin.
    #[arg(long, value_name = "FILE")]
    font: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum What {
    /// The seven ratios over time.
    Ratios,
    /// How fast they change.
    Change,
    /// Sound, syllables, mouth shapes and ratios.
    Timeline,
    /// The figure's seven drawings; with --at, moments with their ratios.
    Faces,
    /// A moment's drawing beside its seven ratios, and the frame of its video.
    Frame,
    /// The shapes of the person's seven emotions, laid over each other.
    Shots,
}

/// Draws the chart and prints where it is.
pub(crate) fn run(args: &Args, out: &mut dyn Write) -> Result<()> {
    if let Some(path) = &args.out {
        let inputs: Vec<&Path> = args.font.iter().map(PathBuf::as_path).collect();
        spare(path, &inputs)?;
    }
    let lesson = Lesson::read(&args.project)?;
    let index = lesson.clip_named(args.clip.as_deref()).map_err(Fault::of_the_call)?;
    let clip = &lesson.clips[index];
    let timeline = lesson.timeline(index, None);
    for at in &args.at {
        if !(0.0..=timeline.duration()).contains(at) {
            return Err(Fault::new(format!("there is nothing at {at} s"))
                .help(format!("the clip `{}` lasts from 0 to {:.2} s", clip.entry.name, timeline.duration()))
                .of_the_call());
        }
    }
    let figure = lesson.figure_of(&clip.entry)?;
    let title = format!("{} · {}", lesson.manifest.title, clip.entry.name);
    let samples: Vec<(f64, Ratios)> = (0..=timeline.frames())
        .map(|k| timeline.time_of(k).min(timeline.duration()))
        .map(|t| (t, timeline.ratios(t)))
        .collect();
    let moment = |t: f64| {
        let pose = timeline.pose(t);
        (format!("{t:.2} s"), figure.draw(&pose), Some(pose.ratios))
    };
    let only_latin = args.font.is_none()
        && args.out.as_ref().is_some_and(|p| p.extension().is_some_and(|e| e == "png"))
        && crate::render::uncovered(&clip.script).is_some();
    let (name, drawing) = match args.what {
        What::Ratios => ("ratios", plot::ratios(&title, &samples)),
        What::Change => ("change", plot::change(&title, &samples)),
        What::Timeline => ("timeline", score_of(&title, clip, &timeline, &samples, only_latin)),
        What::Faces if args.at.is_empty() => {
            let pure = |e: Emotion| (e.name().to_owned(), figure.draw(&Pose::of(Ratios::pure(e))), None);
            ("faces", plot::faces(figure.title(), &Emotion::ALL.map(pure)))
        }
        What::Faces => ("faces", plot::faces(&title, &args.at.iter().map(|t| moment(*t)).collect::<Vec<_>>())),
        What::Shots => ("shots", shots(&lesson, index)?),
        What::Frame => {
            let &[at] = args.at.as_slice() else {
                return Err(Fault::new("a frame needs its moment")
                    .help("give --at with one time in seconds")
                    .of_the_call());
            };
            let pose = timeline.pose(at);
            ("frame", {
                let video = clip.frame_at(at)?;
                plot::frame(&format!("{title}, {at:.2} s"), video.as_ref(), &figure.draw(&pose), &pose.ratios)
            })
        }
    };
    let path = match &args.out {
        Some(path) => path.clone(),
        None => args.project.join("export").join(format!("{}-{name}.svg", clip.entry.name)),
    };
    write_chart(&path, drawing, args.font.as_deref())?;
    say(out, shown(&path))
}

/// The calibration of the clip's face (paper fig. 3).
fn shots(lesson: &Lesson, clip: usize) -> Result<Drawing> {
    let entry = lesson.manifest.face_of(&lesson.clips[clip].entry);
    let face = entry.and_then(|e| lesson.faces.iter().find(|f| f.entry.name == e.name));
    let calibrated = face.and_then(|f| Some((f, f.calibration.as_ref()?)));
    let Some((face, file)) = calibrated else {
        return Err(Fault::new("the face of this clip is not calibrated yet")
            .at(&lesson.root)
            .help("`lianpu calibrate PROJECT` does that, from faces/NAME/happy.png and so on"));
    };
    let mut said: [String; 7] = Default::default();
    for (said, shot) in said.iter_mut().zip(&file.quality.shots) {
        if shot.emotion != Emotion::Neutral {
            *said = format!("{:.1} % from neutral, residual {:.1} %", shot.strength, shot.residual);
        }
    }
    let title = format!("{} · {}", lesson.manifest.title, face.entry.name);
    Ok(plot::shots(&title, &file.calibration, &said))
}

fn score_of(
    title: &str,
    clip: &crate::project::Clip,
    timeline: &Timeline,
    samples: &[(f64, Ratios)],
    only_latin: bool,
) -> Drawing {
    let duration = timeline.duration();
    let peaks = clip.sound.as_ref().map(|s| s.peaks(0.0, duration, 1250)).unwrap_or_default();
    let name = if clip.timing.guessed { "guessed" } else { "said" };
    let said = clip.intervals().iter().zip(&clip.syllables);
    let text = said.clone().map(|(i, s)| (i.start, i.end, s.text.clone())).collect();
    let sounds = said.map(|(i, s)| (i.start, i.end, crate::script::with_marks(&s.pinyin))).collect();
    let shapes = timeline
        .mouth_keys()
        .iter()
        .filter_map(|k| k.shape.map(|s| (k.time, k.time, s.letter().to_string())))
        .collect();
    let blinks = timeline.blinks().iter().map(|b| (b.start, b.start + b.length, String::new())).collect();
    let mut rows = vec![plot::Row { name, spans: text }];
    if clip.syllables.iter().any(|s| !s.pinyin.is_empty() && s.pinyin != s.text) {
        rows.push(plot::Row { name: "pinyin", spans: sounds });
    }
    if only_latin && rows.len() == 2 {
        // Both rows would be Pinyin.
        rows.remove(0);
        rows[0].name = name;
    }
    rows.push(plot::Row { name: "mouth", spans: shapes });
    rows.push(plot::Row { name: "blinks", spans: blinks });
    plot::timeline(title, duration, &peaks, &rows, samples)
}

/// The largest font file that is read; fonts of all Chinese characters have some 20 MB.
const MAX_FONT_BYTES: u64 = 200 << 20;

/// Writes a chart as what its file's name says.
fn write_chart(path: &Path, mut drawing: Drawing, font: Option<&Path>) -> Result<()> {
    let size = |v: f64| (v.ceil() as u32).clamp(1, MAX_SIDE);
    let (width, height) = (size(drawing.view.width()), size(drawing.view.height()));
    match path.extension().and_then(|e| e.to_str()) {
        Some("svg") => write_output(path, to_svg(&drawing, width, height).as_bytes()),
        Some("png") => {
            let font = font
                .map(|file| read_bytes(file, MAX_FONT_BYTES).and_then(FontFile::new).map_err(|f| f.at(file)))
                .transpose()?;
            if font.is_none() && uncovered_in(&drawing).is_some() {
                print::note("Chinese is drawn as Pinyin; give --font FILE with the characters, or an .svg file");
                drawing = drawing.with_texts(&crate::script::in_latin);
            }
            let picture = Painter::new(width, height)?.with_font(font).paint(&drawing);
            write_output(path, &encode_png(&picture, "")?)
        }
        _ => Err(Fault::new(format!("`{}` ends in neither .svg nor .png", path.display()))
            .help("name the chart's file so")
            .of_the_call()),
    }
}
