//! Work in threads: opening a lesson, the outline of its sounds, times, frequencies and pitch, exports. Each reports through one channel.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;

use crossbeam_channel::Sender;

use super::aligning::Aligner;
use super::export::Exporter;
use super::job::Job;
use super::listening::Tone;
use super::studio::{Listening, Report};
use crate::aam::Annotation;
use crate::calibration::Kept;
use crate::disk::{Fault, Result, read_text};
use crate::drawing::Drawing;
use crate::face::{Anchors, Created, Face};
use crate::geometry::Point;
use crate::media::Source;
use crate::photo::{Photo, Stages};
use crate::project::{Finding, Lesson, check};
use crate::speech::{Spectrogram, nuclei, pitch};

/// Starts a job. Whatever becomes of it, it reports its end.
pub(super) fn start(job: Job, reports: Sender<Report>, exporter: Arc<Mutex<Exporter>>, aligner: Aligner) {
    // A report that nobody waits for any more is dropped.
    thread::spawn(move || {
        let _ = match job {
            Job::Open(root) => {
                let name = root.file_name().map_or_else(|| "lesson".into(), |n| n.to_string_lossy().into_owned());
                let lesson = catch_unwind(|| {
                    let lesson = Lesson::open(&root);
                    let notes =
                        lesson.iter().flat_map(|l| l.notes.iter().cloned().map(Finding::Odd)).collect::<Vec<_>>();
                    (lesson, notes.into_iter().chain(check(&root)).collect())
                });
                let (lesson, findings) = lesson.unwrap_or_else(|_| {
                    (
                        Err(Fault::new("the lesson cannot be opened").help("please report what `lianpu check` says")),
                        Vec::new(),
                    )
                });
                reports.send(Report::Opened { name, lesson: Box::new(lesson), findings })
            }
            Job::Check(root) => {
                let findings = catch_unwind(|| check(&root)).unwrap_or_default();
                reports.send(Report::Checked { root, findings })
            }
            Job::Outline { root, clip, sound } => {
                // One column over everything builds the whole outline.
                let (low, high) = sound.peaks(0.0, sound.duration(), 1).first().copied().unwrap_or_default();
                reports.send(Report::Outlined { root, clip, loudest: high.max(-low) })
            }
            Job::Align { root, job } => {
                let found = catch_unwind(AssertUnwindSafe(|| aligner.run(&job)));
                reports.send(Report::Aligned { root, found: found.unwrap_or_default() })
            }
            Job::Follow { root, clip, job, stop } => {
                let mut told = 0;
                let mut go_on = |done: usize, of: Option<usize>| {
                    // A report a percent, or a frame where nobody knows how many there are.
                    let now = of.map_or(done / 10, |of| 100 * done / of.max(1));
                    if now != told {
                        told = now;
                        let _ = reports.send(Report::Following(done, of));
                    }
                    !stop.load(Ordering::Relaxed)
                };
                let found = catch_unwind(AssertUnwindSafe(|| job.run(&mut go_on)));
                let broken =
                    || Fault::new("the face cannot be followed").help("please report what `lianpu track` says");
                let found = Box::new(found.unwrap_or_else(|_| Err(broken())));
                reports.send(Report::Followed { root, clip, found })
            }
            Job::Video { root, clip, path, fps } => {
                let opened = catch_unwind(AssertUnwindSafe(|| Source::of(&path, fps)));
                let source = Box::new(opened.unwrap_or_else(|_| Err(broken_photo())));
                reports.send(Report::VideoOpened { root, clip, source })
            }
            Job::Frame { root, clip, source, number } => {
                let read = catch_unwind(AssertUnwindSafe(|| source.frame(number)));
                let photo = Box::new(read.unwrap_or_else(|_| Err(broken_photo())));
                reports.send(Report::FrameRead { root, clip, number, photo })
            }
            Job::Spectrogram { root, clip, sound } => {
                let made = catch_unwind(|| Listening::Spectrogram(Arc::new(Spectrogram::of(&sound))));
                reports.send(Report::Listened { root, clip, what: made.ok() })
            }
            Job::Pitch { root, clip, sound } => {
                let made = catch_unwind(|| Listening::Tone(Arc::new(Tone::new(pitch(&sound)))));
                reports.send(Report::Listened { root, clip, what: made.ok() })
            }
            Job::Nuclei { root, clip, sound } => {
                let made = catch_unwind(|| Listening::Syllables(nuclei(&sound)));
                reports.send(Report::Listened { root, clip, what: made.ok() })
            }
            Job::Photo { root, face, shot, path, eyes, dots, stages: wanted } => {
                let read = catch_unwind(|| shot_of(&path, dots.as_deref())).unwrap_or_else(|_| Err(broken_photo()));
                let shown = read.as_ref().ok().filter(|_| wanted).map(|read| Arc::clone(&read.0));
                let _ = reports.send(Report::PhotoRead { root: root.clone(), face, shot, read: Box::new(read) });
                let stages = shown.and_then(|photo| catch_unwind(|| stages(&photo, eyes)).ok());
                reports.send(Report::Staged { root, face, stages })
            }
            Job::Calibrate { root, face, folder } => {
                let made = catch_unwind(|| Kept::make(&folder));
                let broken =
                    || Fault::new("the face cannot be calibrated").help("please report what `lianpu calibrate` says");
                let made = Box::new(made.unwrap_or_else(|_| Err(broken())));
                reports.send(Report::Calibrated { root, face, made })
            }
            Job::FindFace { root, face, path, kept, anchors } => {
                let found = catch_unwind(|| find_face(&path, kept.as_deref(), anchors.as_ref()));
                let found = found.unwrap_or_else(|_| Err(broken_photo()));
                reports.send(Report::FaceFound { root, face, found: Box::new(found) })
            }
            Job::Export { request, cancel } => {
                let exporter = exporter.lock().unwrap_or_else(PoisonError::into_inner);
                let progress = |now| {
                    let _ = reports.send(Report::Exporting(now));
                };
                let done = catch_unwind(AssertUnwindSafe(|| exporter(request, &progress, &cancel)));
                let broken = || Fault::new("the export broke off").help("what it had written is incomplete: try again");
                reports.send(Report::Exported(done.unwrap_or_else(|_| Err(broken()))))
            }
        };
    });
}

/// A photo, and the points of somebody else's annotation of it.
fn shot_of(path: &Path, dots: Option<&Path>) -> Result<(Arc<Photo>, Vec<Point>)> {
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

fn find_face(path: &Path, kept: Option<&Face>, anchors: Option<&Anchors>) -> Result<Created> {
    let (photo, sha256) = Photo::read_with_sum(path)?;
    crate::face::create(&photo, &sha256, kept, anchors).map_err(|f| f.at(path))
}

fn broken_photo() -> Fault {
    Fault::new("the photo cannot be looked at").help("save it again as PNG and try that")
}
