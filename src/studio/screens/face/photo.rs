//! Reading the photo of a shot in a thread, with the stages of the search.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::page::FaceScreen;
use crate::aam::Annotation;
use crate::disk::{Result, read_text};
use crate::drawing::Drawing;
use crate::face::FeaturePoint;
use crate::geometry::Point;
use crate::photo::{Photo, Stages};
use crate::pose::Emotion;
use crate::project::Lesson;
use crate::studio::app::stack::{Job, Reporter, Stack};

/// The fault where a photo breaks the program.
pub(super) const BROKEN: [&str; 2] = ["the photo cannot be looked at", "save it again as PNG and try that"];

/// Reads the photo of a face, and works out the stages of the search.
pub(super) struct PhotoJob {
    root: PathBuf,
    face: usize,
    /// The shot.
    shot: Emotion,
    path: PathBuf,
    /// The pupils, where they are known.
    eyes: Option<[Point; 2]>,
    /// Somebody else's annotation of it.
    dots: Option<PathBuf>,
    /// Whether the stages are wanted.
    stages: bool,
}

/// A photo, and the points of somebody else's annotation of it.
type Shot = (Arc<Photo>, Vec<Point>);

impl PhotoJob {
    /// The job for a shot of a face; none where it has no photo.
    pub(crate) fn of(lesson: &Lesson, face: usize, shot: Emotion, stages: bool) -> Option<Self> {
        let of = &lesson.faces[face];
        Some(Self {
            root: lesson.root.clone(),
            face,
            shot,
            path: of.photo_of(shot)?.clone(),
            eyes: of.face.as_ref().map(|f| [FeaturePoint::P3_6, FeaturePoint::P3_5].map(|p| f.points[p.index()].at)),
            dots: of.shot(shot).and_then(|s| s.foreign.clone()),
            stages,
        })
    }
}

impl Job for PhotoJob {
    /// The stages, each with its caption.
    type Made = Vec<(String, Drawing)>;
    const BROKEN: [&'static str; 2] = BROKEN;

    fn run(&mut self, reporter: &Reporter) -> Result<Self::Made> {
        let (root, face, shot) = (self.root.clone(), self.face, self.shot);
        let (photo, dots) = read(&self.path, self.dots.as_deref())?;
        let shown = Arc::clone(&photo);
        reporter.tell(move |stack| {
            stack.with(|screen: &mut FaceScreen, cx| {
                screen.work_on(&root, face, cx, |work| {
                    if work.desk.shot == shot {
                        (work.desk.photo, work.desk.dots) = (Some(photo), dots);
                    }
                });
            });
        });
        Ok(if self.stages { stages(&shown, self.eyes) } else { Vec::new() })
    }

    fn done(self, made: Result<Self::Made>, stack: &mut Stack) {
        stack.with(|screen: &mut FaceScreen, cx| {
            screen.work_on(&self.root, self.face, cx, |work| match made {
                Ok(stages) if self.stages => work.desk.stages = stages,
                Ok(_) => {}
                Err(fault) => work.cx.shell.say_fault(&fault),
            });
        });
    }
}

fn read(path: &Path, dots: Option<&Path>) -> Result<Shot> {
    let photo = Photo::read(path)?;
    let Some(dots) = dots else { return Ok((Arc::new(photo), Vec::new())) };
    let list = Annotation::parse(&read_text(dots)?).map_err(|f| f.at(dots))?;
    let points = list.first().map(|a| a.in_pixels([photo.width(), photo.height()])).unwrap_or_default();
    Ok((Arc::new(photo), points))
}

/// The stages of the search; from the eyes of the face on, where they are known.
fn stages(photo: &Photo, eyes: Option<[Point; 2]>) -> Vec<(String, Drawing)> {
    let stages = match eyes {
        Some([left, right]) => Stages::with_eyes(photo, left, right),
        None => Stages::of(photo),
    };
    crate::plot::stages(&stages)
}
