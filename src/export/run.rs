//! Runs the jobs of an export: frames in parallel, each file whole or not at all.

use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};

use rayon::prelude::*;

use super::aside::{Aside, put_aside};
use super::digests::Digests;
use super::manifest::within;
use super::repeats::{Dedupe, Repeats, repeat};
use super::{Entry, ExportFault, Format, Job};
use crate::disk::{self, Fault, Result, Setting, message, read_old, replace, write_whole};
use crate::drawing::Drawing;
use crate::forms::rounded;
use crate::render::{ClipCoder, FrameCoder, REVISION, decode_key, to_svg};

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

/// Runs jobs on `threads` threads (0: as many as there are processors). What is in the way goes `aside`. `progress` is called from any of them.
/// `stop` ends it early, between two frames. Returns also what there is now of what was asked for.
///
/// # Errors
/// When a file cannot be written. Every file that is there is whole.
pub fn run(
    jobs: &[Job],
    threads: usize,
    aside: &Aside,
    progress: &(dyn Fn(Progress) + Sync),
    stop: &AtomicBool,
) -> Result<(Report, Vec<Entry>)> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| Fault::of(ExportFault::Threads, format!("cannot start the export's threads: {e}")))?;
    let tally = Tally::new(jobs.iter().map(|j| j.frames.len() as u32).sum(), aside);
    let mut report = Report::default();
    let mut files = Vec::new();
    for job in jobs {
        for (path, text) in &job.texts {
            files.push(Entry::of(within(&job.root, path), text.as_bytes()));
            if read_old(path).is_some_and(|old| old == text.as_bytes()) {
                report.kept += 1;
            } else {
                write_whole(path, text.as_bytes()).map_err(elsewhere)?;
                report.written += 1;
                report.bytes += text.len() as u64;
            }
        }
        if job.clears && !job.formats.is_empty() {
            report.removed += remove_left_over(job, aside);
        }
        if job.formats.is_empty() || job.frames.is_empty() {
            continue;
        }
        disk::make_folder(&job.folder).map_err(|e| elsewhere(Fault::io("cannot make the folder", &job.folder, e)))?;
        files.extend(pool.install(|| write_frames(job, &tally, progress, stop))?);
    }
    report.written += tally.written.load(Ordering::Relaxed);
    report.kept += tally.kept.load(Ordering::Relaxed);
    report.bytes += tally.bytes.load(Ordering::Relaxed);
    report.stopped = stop.load(Ordering::Relaxed) && tally.done.load(Ordering::Relaxed) < tally.of;
    Ok((report, files))
}

struct Tally<'a> {
    done: AtomicU32,
    of: u32,
    written: AtomicU32,
    kept: AtomicU32,
    aside: &'a Aside,
    bytes: AtomicU64,
}

impl<'a> Tally<'a> {
    fn new(of: u32, aside: &'a Aside) -> Self {
        let none = || AtomicU32::new(0);
        Self { done: none(), of, written: none(), kept: none(), aside, bytes: AtomicU64::new(0) }
    }

    /// Sets aside what is where a frame goes and is no frame of this program. What was cut off while it was written, such
    /// as by a power cut, is nobody's work.
    fn make_room(&self, job: &Job, path: &Path) -> Result<()> {
        let is_taken = path.symlink_metadata().is_ok_and(|there| !there.is_dir());
        if is_taken && !is_exported(job, path, self.aside) && !is_cut_off(path) {
            put_aside(path)?;
            self.aside.frames.fetch_add(1, Ordering::Relaxed);
        }
        Ok(())
    }

    fn step(&self, progress: &(dyn Fn(Progress) + Sync)) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        progress(Progress { done, of: self.of });
    }

    /// Keeps what is there already where it is right, and says what is there then.
    fn keep_or_write<B: AsRef<[u8]>>(
        &self,
        job: &Job,
        path: &Path,
        right: Option<Vec<u8>>,
        digests: &mut Digests,
        bytes: impl FnOnce() -> Result<B>,
    ) -> Result<Entry> {
        let mut entry = |content: &[u8]| {
            let (path, sha256) = (within(&job.root, path), digests.of(content));
            Entry { path, bytes: content.len() as u64, sha256, key: None }
        };
        if let Some(there) = right {
            self.kept.fetch_add(1, Ordering::Relaxed);
            return Ok(entry(&there));
        }
        let bytes = bytes()?;
        let bytes = bytes.as_ref();
        self.make_room(job, path)?;
        replace(path, bytes).map_err(elsewhere)?;
        self.written.fetch_add(1, Ordering::Relaxed);
        self.bytes.fetch_add(bytes.len() as u64, Ordering::Relaxed);
        Ok(entry(bytes))
    }
}

/// The same fault with the advice to write to another folder.
pub(super) fn elsewhere(fault: Fault) -> Fault {
    fault.help(message!["choose another place with ", Setting::Out])
}

impl Job {
    /// The drawing of a frame, titled by lesson and time. Its pose is rounded, by less than can be seen, so that equal
    /// instants of a movement are equal frames.
    #[must_use]
    pub fn drawing(&self, frame: u32) -> Drawing {
        let time = self.timeline.time_of(frame);
        let mut drawing = self.figure.draw(&rounded(&self.timeline.pose(time)));
        drawing.title = format!("{}, {time:.2} s", self.title);
        if let Some(background) = self.background {
            drawing.background = background;
        }
        drawing
    }
}

/// Writes the frames of a job: each thread its own stretch, for neighbours have most in common.
fn write_frames(
    job: &Job,
    tally: &Tally<'_>,
    progress: &(dyn Fn(Progress) + Sync),
    stop: &AtomicBool,
) -> Result<Vec<Entry>> {
    let mut files = Vec::new();
    if job.formats.contains(&Format::Svg) {
        // An SVG says its time, so no two are equal.
        let steps = !job.formats.contains(&Format::Png);
        files = by_stretches(&job.frames, stop, |frame, digests: &mut Digests| {
            let path = job.path_of(frame, Format::Svg);
            let text = to_svg(&job.drawing(frame), job.size[0], job.size[1]).into_bytes();
            let right = read_old(&path).filter(|old| *old == text);
            let entry = tally.keep_or_write(job, &path, right, digests, || Ok(text));
            if steps {
                tally.step(progress);
            }
            entry
        })?;
    }
    if job.formats.contains(&Format::Png) {
        files.extend(write_pngs(job, tally, progress, stop)?);
    }
    Ok(files)
}

/// Calls `each` for frames on all threads, with something that the frames of a stretch share.
fn by_stretches<S: Default, T: Send>(
    frames: &[u32],
    stop: &AtomicBool,
    each: impl Fn(u32, &mut S) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    let stretch = frames.len().div_ceil(rayon::current_num_threads()).max(1);
    let stretches: Vec<Vec<T>> = frames
        .par_chunks(stretch)
        .map(|frames| {
            let mut shared = S::default();
            let going = frames.iter().take_while(|_| !stop.load(Ordering::Relaxed));
            going.map(|frame| each(*frame, &mut shared)).collect()
        })
        .collect::<Result<_>>()?;
    Ok(stretches.into_iter().flatten().collect())
}

/// What a thread needs for its PNG files.
#[derive(Default)]
struct Desk<'a> {
    coder: Option<FrameCoder<'a>>,
    file: Vec<u8>,
    digests: Digests,
}

/// Of frames that are equal the first is written, and then the others.
fn write_pngs(
    job: &Job,
    tally: &Tally<'_>,
    progress: &(dyn Fn(Progress) + Sync),
    stop: &AtomicBool,
) -> Result<Vec<Entry>> {
    let pose = |frame| rounded(&job.timeline.pose(job.timeline.time_of(frame)));
    let frames = match job.dedupe {
        Dedupe::None => Repeats { first: job.frames.clone(), others: Vec::new() },
        _ => Repeats::of(&job.frames, pose),
    };
    let clip = ClipOf { job, coder: OnceLock::new() };
    let made: Vec<Made> = by_stretches(&frames.first, stop, |frame, desk: &mut Desk<'_>| {
        let drawing = job.drawing(frame);
        let path = job.path_of(frame, Format::Png);
        let key = key_of(&drawing, job.size);
        let right = with_key(&path, &key);
        let Desk { coder, file, digests } = desk;
        let entry = tally.keep_or_write(job, &path, right, digests, || {
            clip.encode(coder, &drawing, &key, file)?;
            Ok(&*file)
        })?;
        tally.step(progress);
        Ok(Made { key, entry })
    })?;
    if stop.load(Ordering::Relaxed) {
        return Ok(made.into_iter().map(|m| m.entry).collect());
    }
    let others = frames.others.par_iter().map(|(frame, like)| {
        if stop.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let path = job.path_of(*frame, Format::Png);
        let name = within(&job.root, &path);
        let Made { key, entry } = &made[*like];
        let entry = match with_key(&path, key) {
            Some(there) => {
                tally.kept.fetch_add(1, Ordering::Relaxed);
                Entry::of(name, &there)
            }
            None => {
                let first = job.path_of(frames.first[*like], Format::Png);
                tally.make_room(job, &path)?;
                let bytes = repeat(&first, &path, job.dedupe).map_err(elsewhere)?;
                tally.written.fetch_add(1, Ordering::Relaxed);
                tally.bytes.fetch_add(bytes, Ordering::Relaxed);
                Entry { path: name, ..entry.clone() }
            }
        };
        tally.step(progress);
        Ok(Some(entry))
    });
    let others: Vec<Option<Entry>> = others.collect::<Result<_>>()?;
    Ok(made.into_iter().map(|m| m.entry).chain(others.into_iter().flatten()).collect())
}

/// A PNG file that is there.
struct Made {
    key: String,
    entry: Entry,
}

/// What the PNG files of a clip have in common, learned when the first of them is to be written.
struct ClipOf<'a> {
    job: &'a Job,
    coder: OnceLock<Result<ClipCoder>>,
}

/// Frames of the clip, evenly over it, that the others are written after.
const SAMPLES: u32 = 12;

impl ClipOf<'_> {
    /// The same samples whichever frames are asked for.
    fn learn(&self) -> Result<ClipCoder> {
        let last = self.job.count.saturating_sub(1);
        let mut samples: Vec<u32> =
            (0..SAMPLES).map(|i| (u64::from(last) * u64::from(i) / u64::from(SAMPLES - 1)) as u32).collect();
        samples.dedup();
        let drawings: Vec<Drawing> = samples.into_iter().map(|frame| self.job.drawing(frame)).collect();
        let [width, height] = self.job.size;
        ClipCoder::new(width, height, &drawings)
    }

    /// Makes `file` the frame's.
    fn encode<'b>(
        &'b self,
        coder: &mut Option<FrameCoder<'b>>,
        drawing: &Drawing,
        key: &str,
        file: &mut Vec<u8>,
    ) -> Result<()> {
        let coder = match coder {
            Some(coder) => coder,
            None => match self.coder.get_or_init(|| self.learn()) {
                Ok(clip) => coder.insert(clip.frames()?),
                Err(fault) => return Err(Fault::new(fault.what()).help(fault.advice())),
            },
        };
        file.clear();
        coder.encode_into(drawing, key, file)
    }
}

/// A file that is a whole PNG with that key.
fn with_key(path: &Path, key: &str) -> Option<Vec<u8>> {
    read_old(path).filter(|old| decode_key(old).as_deref() == Some(key))
}

/// Says what a PNG shows and what made it: the drawing, the size, and this version of the program and its renderer.
fn key_of(drawing: &Drawing, size: [u32; 2]) -> String {
    let [width, height] = size;
    format!("{} {REVISION} {width}x{height} {:016x}", env!("CARGO_PKG_VERSION"), drawing.fingerprint())
}

/// Removes frames beyond the clip's end that an earlier export left: a video made of the folder would show them.
/// Only numbered files that an export wrote are touched.
fn remove_left_over(job: &Job, aside: &Aside) -> u32 {
    let Ok(paths) = disk::list(&job.folder) else { return 0 };
    let mut removed = 0;
    for path in paths {
        let number = path.file_stem().and_then(|s| s.to_str()).filter(|s| s.len() == 6).and_then(|s| s.parse().ok());
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let beyond = number.is_some_and(|n: u32| n >= job.count);
        let asked = job.formats.iter().any(|f| f.name() == extension);
        if beyond && asked && is_exported(job, &path, aside) && disk::remove(&path).is_ok() {
            removed += 1;
        }
    }
    removed
}

/// Whether a picture's file begins as this program writes it and lacks its end.
fn is_cut_off(path: &Path) -> bool {
    let Some(bytes) = read_old(path) else { return false };
    let holds = |end: &[u8]| bytes.windows(end.len()).any(|part| part == end);
    let is_png = bytes.starts_with(b"\x89PNG") && !holds(b"IEND\xAEB\x60\x82");
    bytes.is_empty() || is_png || (bytes.starts_with(b"<svg ") && !holds(b"</svg>"))
}

/// Whether a picture's file is one that an export wrote, and nobody has changed since as far as the manifest says.
fn is_exported(job: &Job, path: &Path, aside: &Aside) -> bool {
    let Some(bytes) = read_old(path) else { return false };
    let is_ours = match path.extension().and_then(|e| e.to_str()) {
        Some("png") => decode_key(&bytes).is_some(),
        _ => String::from_utf8_lossy(&bytes).contains("<g id=\"dynamic\">"),
    };
    is_ours && aside.may_be_exported(&within(&job.root, path), &bytes)
}
