//! Photos and videos brought into a new lesson: made small enough, rid of what is said about them, with the points that
//! somebody has marked on them.

use std::path::{Path, PathBuf};

use super::names::FACE_FILE;
use super::recordings::{FRAMES, VIDEOS};
use crate::aam::{Annotation, annotation};
use crate::disk::{Fault, FileFault, Result, copy, make_folder, open, read_bytes, replace, write_whole};
use crate::face::{Anchors, Created, create};
use crate::geometry::Point;
use crate::media::Source;
use crate::photo::{MAX_PHOTO_BYTES, Photo, sha256, to_clean_png, without_metadata};
use crate::pose::Emotion;

/// A photo is kept at most so many pixels wide and high: a cartoon needs no more, and a repository thanks for it.
const KEPT_SIDE: usize = 2000;

/// The largest video that is copied.
const MAX_VIDEO_BYTES: u64 = 16 << 30;

/// A photo as a lesson keeps it.
pub(in crate::project) struct Brought {
    photo: Photo,
    png: Vec<u8>,
    /// The points beside it in a file of its name, `.pts` or `.asf`.
    marked: Option<Vec<Point>>,
    /// How many of its own pixels one kept pixel is wide.
    factor: f64,
}

impl Brought {
    pub(in crate::project) fn read(path: &Path) -> Result<Self> {
        let photo = Photo::read(path)?;
        let mut brought = Self::of(&photo)?;
        let beside = ["pts", "asf"].map(|e| path.with_extension(e)).into_iter().find(|p| p.is_file());
        if let Some(file) = beside {
            let mut list = Annotation::read(&file)?;
            let (Some(one), true) = (list.pop(), list.is_empty()) else {
                return Err(Fault::of(FileFault::TooLarge, "it annotates more than one face")
                    .at(&file)
                    .help("keep one face in it"));
            };
            let points = one.in_pixels([photo.width(), photo.height()]);
            let small = |p: &Point| Point::new(p.x / brought.factor, p.y / brought.factor);
            brought.marked = Some(points.iter().map(small).collect());
        }
        Ok(brought)
    }

    pub(in crate::project) fn of(photo: &Photo) -> Result<Self> {
        let (kept, factor) = photo.at_most(KEPT_SIDE);
        Ok(Self { png: to_clean_png(&kept)?, photo: kept.into_owned(), marked: None, factor })
    }

    /// The face in it.
    pub(in crate::project) fn face(&self, anchors: Option<Anchors>) -> Result<Created> {
        let small = |p: Point| Point::new(p.x / self.factor, p.y / self.factor);
        let anchors = anchors.map(|a| Anchors {
            left_eye: small(a.left_eye),
            right_eye: small(a.right_eye),
            mouth: small(a.mouth),
            chin: small(a.chin),
        });
        create(&self.photo, &sha256(&self.png), None, anchors.as_ref())
    }

    /// Writes it as the shot of an emotion.
    pub(in crate::project) fn write(&self, folder: &Path, emotion: Emotion) -> Result<()> {
        make_folder(folder).map_err(|e| Fault::io("cannot make the folder", folder, e))?;
        write_whole(&folder.join(format!("{emotion}.png")), &self.png)?;
        match &self.marked {
            Some(points) => {
                let text = Annotation::write(&[Annotation::of_points(points.clone())], annotation::Format::Pts)?;
                write_whole(&folder.join(format!("{emotion}.pts")), text.as_bytes())
            }
            None => Ok(()),
        }
    }
}

/// Writes the points of a new face.
pub(in crate::project) fn write_face(folder: &Path, created: &Created) -> Result<()> {
    write_whole(&folder.join(FACE_FILE), created.face.to_toml().as_bytes())
}

/// A frame of a video as the neutral photo.
pub(in crate::project) fn frame_of(video: &Path, fps: f64, number: u32) -> Result<Brought> {
    Brought::of(&Source::of(video, fps)?.frame(number)?)
}

/// Copies a video into a clip's folder: a folder of pictures as `frames/`, a file as `video.*`.
pub(in crate::project) fn copy_video(video: &Path, clip: &Path) -> Result<()> {
    if video.is_dir() {
        return copy_frames(video, &clip.join(FRAMES));
    }
    let extension = video.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    if !VIDEOS.contains(&extension.as_str()) {
        return Err(Fault::of(FileFault::Unsupported, "it has none of the endings of a video")
            .at(video)
            .help(format!("give a folder of pictures, or a file that ends in {}", VIDEOS.join(", ")))
            .of_the_call());
    }
    let size =
        open(video).and_then(|file| file.metadata()).map_err(|e| Fault::io("cannot look at it", video, e))?.len();
    if size > MAX_VIDEO_BYTES {
        return Err(Fault::new(format!("it has {} GB", size >> 30)).at(video).help("cut it into clips first"));
    }
    let to = clip.join(format!("video.{extension}"));
    copy(video, &to).map(|_| ()).map_err(|e| Fault::io("cannot copy it", video, e))
}

fn copy_frames(from: &Path, to: &Path) -> Result<()> {
    make_folder(to).map_err(|e| Fault::io("cannot make the folder", to, e))?;
    let names: Vec<PathBuf> = Source::of(from, 25.0)?.files().to_vec();
    let digits = names.len().to_string().len().max(4);
    for (number, path) in names.iter().enumerate() {
        let bytes = read_bytes(path, MAX_PHOTO_BYTES)?;
        // What is turned upright or packed otherwise by what is said about it is packed anew.
        let (bytes, extension) = match without_metadata(&bytes) {
            Some(stripped) if stripped.starts_with(&[0xFF, 0xD8]) => (stripped, "jpg"),
            Some(stripped) => (stripped, "png"),
            None => (to_clean_png(&Photo::decode(&bytes).map_err(|f| f.at(path))?)?, "png"),
        };
        let path = to.join(format!("{number:0digits$}.{extension}"));
        // Not flushed one by one: the lesson's folder appears whole or not at all.
        replace(&path, &bytes)?;
    }
    Ok(())
}
