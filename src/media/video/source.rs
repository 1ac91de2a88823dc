//! Where a video lies: what can be said of it before it is read, and the ways to its frames.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use image::ImageReader;

use super::ffmpeg::{Ffmpeg, duration_said};
use super::y4m::{MAGIC, Scan, Y4m};
use super::{Frames, MOST_FPS, folder, print};
use crate::disk::{Fault, FileFault, Result, open};
use crate::media::MediaFault;
use crate::photo::Photo;

/// A video that can be read.
#[derive(Debug, Clone)]
pub struct Source {
    kind: Kind,
    fps: f64,
    count: Option<usize>,
    duration: Option<f64>,
    /// Bytes of a decoded frame, about.
    bytes: usize,
    notes: Vec<String>,
}

#[derive(Debug, Clone)]
enum Kind {
    Pictures(PathBuf, Arc<[PathBuf]>),
    /// YUV4MPEG2 in a file; where its first frame begins.
    Plain(PathBuf, u64),
    Video(PathBuf, Ffmpeg),
}

/// How lists of videos begin that ffmpeg would follow.
const LISTS: [&[u8]; 3] = [b"#EXTM3U", b"ffconcat", b"[playlist"];

impl Source {
    /// A folder of PNG, JPEG or WebP frames, shown `fps` a second, or a video file, which knows itself: YUV4MPEG2 is read
    /// as it is, everything else by ffmpeg. Only the folder, or the first frame of the file, is looked at.
    ///
    /// # Errors
    /// When it cannot be read, has no frames, or is a video and ffmpeg is missing or cannot read it; when `fps` is not
    /// between 0.1 and 1000.
    pub fn of(path: &Path, fps: f64) -> Result<Self> {
        if path.is_dir() {
            return Self::of_folder(path, fps);
        }
        let mut file = open(path).map_err(|e| Fault::io("cannot open the video", path, e))?;
        let mut magic = Vec::new();
        let read = file.by_ref().take(MAGIC.len() as u64).read_to_end(&mut magic);
        read.map_err(|e| Fault::io("cannot read the video", path, e))?;
        if magic == MAGIC {
            return Self::of_plain(path, file);
        }
        // A list of other files would have ffmpeg open them, wherever they lie.
        if LISTS.iter().any(|list| magic.starts_with(&list[..list.len().min(MAGIC.len())])) {
            return Err(Fault::new("it is a list of other videos").at(path).help("give the video itself"));
        }
        if magic.is_empty() {
            return Err(Fault::of(FileFault::Empty, "the video's file is empty").at(path).help("copy it again"));
        }
        Self::of_video(path, Ffmpeg::find().map_err(|fault| fault.at(path))?)
    }

    fn of_folder(path: &Path, fps: f64) -> Result<Self> {
        if !(0.1..=MOST_FPS).contains(&fps) {
            return Err(Fault::of(FileFault::OutOfRange, format!("frames cannot be shown {fps} a second"))
                .help("give 0.1 to 1000"));
        }
        let paths: Arc<[PathBuf]> = folder::pictures(path)?.into();
        let count = paths.len();
        // Of a first picture that is damaged, whoever decodes it says what.
        let first = open(&paths[0]).and_then(|file| ImageReader::new(BufReader::new(file)).with_guessed_format());
        let size = first.ok().and_then(|picture| picture.into_dimensions().ok());
        let bytes = size.map_or(3 << 20, |(w, h)| w as usize * h as usize);
        let duration = Some(count as f64 / fps);
        let kind = Kind::Pictures(path.to_owned(), paths);
        Ok(Self { kind, fps, count: Some(count), duration, bytes, notes: Vec::new() })
    }

    fn of_plain(path: &Path, mut file: File) -> Result<Self> {
        let fault = |e| Fault::io("cannot read the video", path, e);
        let length = file.metadata().map_err(fault)?.len();
        file.rewind().map_err(fault)?;
        let mut input = BufReader::with_capacity(1 << 16, file);
        let stream = Y4m::new(&mut input).map_err(|f| f.at(path))?;
        let (head, scan, fps) = (stream.head(), stream.scan(), stream.fps());
        let start = input.stream_position().map_err(fault)?;
        // Each frame has the word FRAME and a line's end before it; other words there are rare, and only cost the count.
        let each = head.bytes() as u64 + 6;
        let whole = (length - start).is_multiple_of(each);
        let count = whole.then(|| ((length - start) / each) as usize);
        let duration = count.map(|n| n as f64 / fps);
        let kind = Kind::Plain(path.to_owned(), start);
        Ok(Self { kind, fps, count, duration, bytes: head.bytes(), notes: of_scan(scan) })
    }

    /// A video, by an ffmpeg that is known.
    ///
    /// # Errors
    /// When ffmpeg cannot read it.
    pub fn of_video(path: &Path, ffmpeg: Ffmpeg) -> Result<Self> {
        let mut running = ffmpeg.video(path, 0.0, Some(1), true)?;
        let mut stream = running.stream()?;
        // Read to the end, so that the program is not stopped in the middle of a word.
        let first = stream.next_frame().map_err(|f| f.at(path))?;
        let (fps, scan, bytes) = (stream.fps(), stream.scan(), stream.head().bytes());
        std::io::copy(&mut stream.into_input(), &mut std::io::sink())
            .map_err(|e| Fault::io("cannot read the video", path, e))?;
        let said = running.ended()?;
        if first.is_none() {
            return Err(Fault::new("the video has no picture").at(path).help("is it a sound recording?"));
        }
        let duration = duration_said(&said);
        let kind = Kind::Video(path.to_owned(), ffmpeg);
        let count = duration.map(|d| (d * fps).round() as usize);
        Ok(Self { kind, fps, count, duration, bytes, notes: of_scan(scan) })
    }

    /// Frames a second.
    #[must_use]
    pub fn fps(&self) -> f64 {
        self.fps
    }

    /// How many frames there are; of a video what its length promises, which may be one off.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        self.count
    }

    /// How long it is, in seconds, where that is known before it is read.
    #[must_use]
    pub fn duration(&self) -> Option<f64> {
        self.duration
    }

    /// What there is to say of it to its author.
    #[must_use]
    pub(crate) fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The folder or the file.
    #[must_use]
    pub(crate) fn path(&self) -> &Path {
        match &self.kind {
            Kind::Pictures(path, _) | Kind::Plain(path, _) | Kind::Video(path, _) => path,
        }
    }

    /// The pictures of a folder, in order; none of a file.
    #[must_use]
    pub(crate) fn files(&self) -> &[PathBuf] {
        match &self.kind {
            Kind::Pictures(_, paths) => paths,
            Kind::Plain(..) | Kind::Video(..) => &[],
        }
    }

    /// All frames from the first on, decoded ahead on a thread of their own.
    ///
    /// # Errors
    /// When the video cannot be opened.
    pub fn frames(&self) -> Result<Frames> {
        match &self.kind {
            Kind::Pictures(_, paths) => Ok(Frames::of_pictures(Arc::clone(paths), self.fps, self.bytes)),
            Kind::Plain(path, _) => {
                let file = open(path).map_err(|e| Fault::io("cannot open the video", path, e))?;
                let mut stream = Y4m::new(BufReader::with_capacity(1 << 20, file)).map_err(|f| f.at(path))?;
                let path = path.clone();
                Ok(Frames::of(2 * self.bytes, None, move || stream.next_frame().map_err(|f| f.at(&path))))
            }
            Kind::Video(path, ffmpeg) => {
                let mut running = ffmpeg.video(path, 0.0, None, false)?;
                let mut stream = running.stream()?;
                let path = path.clone();
                Ok(Frames::of(2 * self.bytes, Some(running), move || stream.next_frame().map_err(|f| f.at(&path))))
            }
        }
    }

    /// The frame of a number, from 0, in colour: for a neutral photo, or to see beside its drawing. Of a folder only
    /// that picture is read.
    ///
    /// # Errors
    /// When there is no such frame, or it cannot be read.
    pub fn frame(&self, number: u32) -> Result<Photo> {
        let none = || {
            let there = self.count.map_or(String::new(), |n| format!(": there are {n}, counted from 0"));
            Fault::of(MediaFault::NoSuchFrame, format!("there is no frame {number}{there}")).at(self.path())
        };
        match &self.kind {
            Kind::Pictures(_, paths) => Photo::read(paths.get(number as usize).ok_or_else(none)?),
            Kind::Plain(path, start) => {
                let fault = |e| Fault::io("cannot read the video", path, e);
                let file = open(path).map_err(fault)?;
                let mut stream = Y4m::new(BufReader::with_capacity(1 << 16, file)).map_err(|f| f.at(path))?;
                if self.count.is_some() {
                    // Frames of equal length: straight to it.
                    let head = stream.head();
                    let mut input = stream.into_input();
                    let at = start + (head.bytes() as u64 + 6) * u64::from(number);
                    input.seek(SeekFrom::Start(at)).map_err(fault)?;
                    stream = Y4m::behind(head, input);
                } else {
                    for _ in 0..number {
                        stream.next_frame()?.ok_or_else(none)?;
                    }
                }
                stream.next_frame().map_err(|f| f.at(path))?.ok_or_else(none)?.photo()
            }
            Kind::Video(path, ffmpeg) => {
                // Half a frame early, so that rounding does not skip it.
                let from = ((f64::from(number) - 0.5) / self.fps).max(0.0);
                let mut running = ffmpeg.video(path, from, Some(1), false)?;
                // Behind the end there is not even a head.
                let mut stream = running.stream().map_err(|f| if number > 0 { none() } else { f })?;
                stream.next_frame().map_err(|f| f.at(path))?.ok_or_else(none)?.photo()
            }
        }
    }

    /// The frame that is shown at a time in seconds; the last one behind the end.
    ///
    /// # Errors
    /// As [`frame`](Self::frame).
    pub fn frame_at(&self, time: f64) -> Result<Photo> {
        let last = self.count.map_or(u32::MAX as usize, |n| n.saturating_sub(1));
        self.frame(((time * self.fps + 1e-6).floor().max(0.0) as usize).min(last) as u32)
    }

    /// What tells this video from another, or from itself before it was changed: names, lengths and samples of its
    /// bytes. Quick: of an hour's folder it takes about a second.
    ///
    /// # Errors
    /// When a file cannot be read.
    pub fn fingerprint(&self) -> Result<String> {
        match &self.kind {
            Kind::Pictures(_, paths) => print::fingerprint(paths.iter().map(PathBuf::as_path), 4),
            Kind::Plain(path, _) | Kind::Video(path, _) => print::fingerprint(std::iter::once(path.as_path()), 256),
        }
    }
}

fn of_scan(scan: Scan) -> Vec<String> {
    match scan {
        Scan::Progressive => Vec::new(),
        Scan::Interlaced => vec![
            "the video is interlaced: what moves fast has a comb at its edges; deinterlace it for closer tracking"
                .into(),
        ],
    }
}
