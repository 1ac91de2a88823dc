//! Runs the jobs of an export: frames in parallel, each file whole or not at all.

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};

use rayon::prelude::*;

use super::{Format, Job};
use crate::disk::{Fault, Result, replace, write_whole};
use crate::drawing::Drawing;
use crate::render::{Painter, REVISION, decode_key, encode_png, to_svg};

/// How far an export is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Frames looked at so far, over all jobs.
    pub done: u32,
    /// Frames in all jobs.
    pub of: u32,
}

/// What an export did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Report {
    /// Files written.
    pub written: u32,
    /// Files that were there already and right.
    pub kept: u32,
    /// Frames of an earlier, longer export that were removed.
    pub removed: u32,
    /// Bytes written.
    pub bytes: u64,
    /// Whether it was stopped before its end.
    pub stopped: bool,
}

/// Runs jobs on `threads` threads (0: as many as there are processors). `progress` is called from any of them.
/// `stop` ends it early, between two frames.
///
/// # Errors
/// When a file cannot be written. Every file that is there is whole.
pub fn run(jobs: &[Job], threads: usize, progress: &(dyn Fn(Progress) + Sync), stop: &AtomicBool) -> Result<Report> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| Fault::new(format!("cannot start the export's threads: {e}")))?;
    let tally = Tally { of: jobs.iter().map(|j| j.frames.len() as u32).sum(), ..Tally::default() };
    let mut report = Report::default();
    for job in jobs {
        for (path, text) in &job.texts {
            if std::fs::read(path).is_ok_and(|old| old == text.as_bytes()) {
                report.kept += 1;
            } else {
                write_whole(path, text.as_bytes()).map_err(elsewhere)?;
                report.written += 1;
                report.bytes += text.len() as u64;
            }
        }
        if job.formats.is_empty() {
            continue;
        }
        std::fs::create_dir_all(&job.folder)
            .map_err(|e| elsewhere(Fault::io("cannot make the folder", &job.folder, e)))?;
        if job.whole {
            report.removed += remove_left_over(job);
        }
        let [width, height] = job.size;
        pool.install(|| {
            job.frames.par_iter().try_for_each_init(
                || Painter::new(width, height),
                |painter, frame| {
                    if stop.load(Ordering::Relaxed) {
                        return Ok(());
                    }
                    match painter {
                        Ok(painter) => write_frame(job, *frame, painter, &tally)?,
                        Err(fault) => return Err(Fault::new(fault.what()).help(fault.next_step())),
                    }
                    tally.step(progress);
                    Ok(())
                },
            )
        })?;
    }
    report.written += tally.written.load(Ordering::Relaxed);
    report.kept += tally.kept.load(Ordering::Relaxed);
    report.bytes += tally.bytes.load(Ordering::Relaxed);
    report.stopped = stop.load(Ordering::Relaxed) && tally.done.load(Ordering::Relaxed) < tally.of;
    Ok(report)
}

#[derive(Default)]
struct Tally {
    done: AtomicU32,
    of: u32,
    written: AtomicU32,
    kept: AtomicU32,
    bytes: AtomicU64,
}

impl Tally {
    fn step(&self, progress: &(dyn Fn(Progress) + Sync)) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        progress(Progress { done, of: self.of });
    }

    fn keep_or_write(&self, path: &Path, right: bool, bytes: impl FnOnce() -> Result<Vec<u8>>) -> Result<()> {
        if right {
            self.kept.fetch_add(1, Ordering::Relaxed);
            return Ok(());
        }
        let bytes = bytes()?;
        replace(path, &bytes).map_err(elsewhere)?;
        self.written.fetch_add(1, Ordering::Relaxed);
        self.bytes.fetch_add(bytes.len() as u64, Ordering::Relaxed);
        Ok(())
    }
}

/// A place that cannot be written to is no reason not to export.
fn elsewhere(fault: Fault) -> Fault {
    fault.help("choose another place with --out DIR")
}

/// The drawing of a frame, titled by lesson and time.
fn drawing_of(job: &Job, frame: u32) -> Drawing {
    let time = job.timeline.time_of(frame);
    let mut drawing = job.figure.draw(&job.timeline.pose(time));
    drawing.title = format!("{}, {time:.2} s", job.title);
    if let Some(background) = job.background {
        drawing.background = background;
    }
    drawing
}

fn write_frame(job: &Job, frame: u32, painter: &mut Painter, tally: &Tally) -> Result<()> {
    let drawing = drawing_of(job, frame);
    let [width, height] = job.size;
    for format in &job.formats {
        let path = job.folder.join(format!("{frame:06}.{}", format.name()));
        let old = std::fs::read(&path).ok();
        match format {
            Format::Svg => {
                let svg = to_svg(&drawing, width, height).into_bytes();
                tally.keep_or_write(&path, old.as_deref() == Some(&svg), || Ok(svg))?;
            }
            _ => {
                let key = key_of(&drawing, job.size);
                let right = old.as_deref().and_then(decode_key).as_deref() == Some(&key);
                tally.keep_or_write(&path, right, || encode_png(&painter.paint(&drawing), &key))?;
            }
        }
    }
    Ok(())
}

/// Says what a PNG shows and what made it: the drawing, the size, and this version of the program and its renderer.
fn key_of(drawing: &Drawing, size: [u32; 2]) -> String {
    let [width, height] = size;
    format!("{} {REVISION} {width}x{height} {:016x}", env!("CARGO_PKG_VERSION"), drawing.fingerprint())
}

/// Removes frames beyond the clip's end that an earlier export left: a video made of the folder would show them.
/// Only numbered files that are our own are touched.
fn remove_left_over(job: &Job) -> u32 {
    let Ok(entries) = std::fs::read_dir(&job.folder) else { return 0 };
    let mut removed = 0;
    for path in entries.flatten().map(|e| e.path()) {
        let number = path.file_stem().and_then(|s| s.to_str()).filter(|s| s.len() == 6).and_then(|s| s.parse().ok());
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let beyond = number.is_some_and(|n: u32| n >= job.count);
        let asked = job.formats.iter().any(|f| f.name() == extension);
        if beyond && asked && is_our_own(&path, extension) && std::fs::remove_file(&path).is_ok() {
            removed += 1;
        }
    }
    removed
}

fn is_our_own(path: &Path, extension: &str) -> bool {
    let Ok(bytes) = std::fs::read(path) else { return false };
    match extension {
        "png" => decode_key(&bytes).is_some(),
        _ => String::from_utf8_lossy(&bytes).contains("<g id=\"dynamic\">"),
    }
}
