//! The files of a face's folder that a calibration is made of.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::inputs::Inputs;
use super::marks::Marks;
use crate::aam::Annotation;
use crate::calibration::Binding;
use crate::disk::{Fault, FileFault, Result, Task, inside, message, read_bytes, read_text};
use crate::face::find::find;
use crate::face::{Face, FeaturePoint as P, How, Placed};
use crate::geometry::Point;
use crate::photo::Grey;
use crate::photo::{MAX_PHOTO_BYTES, sha256};
use crate::pose::Emotion;

/// Endings of photos, in the order they are looked for.
const PHOTOS: [&str; 4] = ["png", "jpg", "jpeg", "webp"];
/// Endings of somebody's own annotations.
const ANNOTATIONS: [&str; 2] = ["pts", "asf"];

/// What tells the points of a face from others, as a calibration keeps it.
#[must_use]
pub(crate) fn sum_of_face(face: &Face) -> String {
    let line = |p: P| {
        let at = face.points[p.index()].at;
        format!("{p} {:.1} {:.1}\n", at.x, at.y)
    };
    sha256(P::fixed().map(line).collect::<String>().as_bytes())
}

/// The same of what a hand has set in a shot; none where nothing was set.
#[must_use]
pub(crate) fn sum_of_marks(points: &[Placed]) -> Option<String> {
    // As exactly as the file says it, so that writing and reading it changes nothing.
    let by_hand = points.iter().enumerate().filter(|(_, p)| p.how == How::Hand);
    let set: String = by_hand.map(|(k, p)| format!("{k} {:.2} {:.2}\n", p.at.x, p.at.y)).collect();
    (!set.is_empty()).then(|| sha256(set.as_bytes()))
}

/// The shots of a face's folder and what is known of their points.
#[derive(Debug, Clone)]
pub struct ShotFiles {
    /// The photo of each emotion; none where there is none.
    pub photos: [Option<PathBuf>; 7],
    /// The SHA-256 of every file that was read, by its name in the folder.
    pub sums: BTreeMap<String, String>,
    greys: [Option<Grey>; 7],
    points: [Vec<Placed>; 7],
    named: Vec<(P, Point)>,
    face: Option<Face>,
}

/// The first of the files `name.ENDING` that is there. A link that leads out of the folder is not followed.
fn beside(folder: &Path, name: &str, endings: &[&str]) -> Option<PathBuf> {
    let own = |ending: &&str| inside(folder, &format!("{name}.{ending}")).ok();
    endings.iter().filter_map(own).find(|p| p.is_file())
}

impl ShotFiles {
    /// Reads a folder: `neutral.png` with `face.toml` or `neutral.pts`, `happy.png` … with `happy.toml` or `happy.pts`
    /// where there are such (`.jpg`, `.jpeg`, `.webp` and `.asf` too).
    ///
    /// # Errors
    /// When the neutral photo or its points are missing, a file cannot be read, or annotations do not go together.
    pub fn of(folder: &Path) -> Result<Self> {
        let mut files = Self {
            photos: Default::default(),
            sums: BTreeMap::new(),
            greys: Default::default(),
            points: Default::default(),
            named: Vec::new(),
            face: None,
        };
        files.read_photos(folder)?;
        let Some(neutral) = &files.greys[0] else {
            return Err(Fault::of(FileFault::Missing, "there is no neutral photo")
                .at(folder)
                .help("put neutral.png there: the face at rest, eyes open, mouth closed"));
        };
        let size = [neutral.width(), neutral.height()];
        let seen = neutral.to_photo();
        files.read_face(folder)?;
        match beside(folder, "neutral", &ANNOTATIONS) {
            Some(path) => {
                files.points[0] = files.annotation(&path, size)?;
                if files.face.is_none() {
                    let found = find(&seen, &[]).map_err(|refusal| {
                        Fault::from(refusal).at(folder).help(message![
                            "use ",
                            Task::FindFace,
                            ", and set the pupils by hand"
                        ])
                    })?;
                    files.named = P::fixed().map(|p| (p, found.points[p.index()].at)).collect();
                }
            }
            None if files.face.is_none() => {
                return Err(Fault::of(FileFault::Missing, "the points of the neutral photo are not known")
                    .at(folder)
                    .help(message!["use ", Task::FindFace, ", which writes face.toml"]));
            }
            None => {}
        }
        let foreign = !files.points[0].is_empty();
        for emotion in &Emotion::ALL[1..] {
            let Some(grey) = &files.greys[emotion.index()] else { continue };
            let size = [grey.width(), grey.height()];
            match foreign {
                true => files.read_annotation(folder, *emotion, size)?,
                false => files.read_marks(folder, *emotion)?,
            }
        }
        Ok(files)
    }

    fn read_photos(&mut self, folder: &Path) -> Result<()> {
        for emotion in Emotion::ALL {
            let Some(path) = beside(folder, emotion.name(), &PHOTOS) else { continue };
            let bytes = read_bytes(&path, MAX_PHOTO_BYTES)?;
            self.note(&path, &bytes);
            self.greys[emotion.index()] = Some(Grey::decode(&bytes).map_err(|f| f.at(&path))?);
            self.photos[emotion.index()] = Some(path);
        }
        Ok(())
    }

    /// Reads `face.toml`, where there is one.
    fn read_face(&mut self, folder: &Path) -> Result<()> {
        let path = folder.join("face.toml");
        if path.is_file() {
            let text = read_text(&path)?;
            let face = Face::parse(&text).map_err(|f| f.at(&path))?;
            self.named = P::fixed().map(|p| (p, face.points[p.index()].at)).collect();
            // Of the face only its points matter here: a new colour of hair makes no calibration stale.
            self.sums.insert("face.toml".into(), sum_of_face(&face));
            self.face = Some(face);
        }
        Ok(())
    }

    /// Reads the annotation of a shot, where there is one: the same points as those of the neutral photo.
    fn read_annotation(&mut self, folder: &Path, emotion: Emotion, size: [usize; 2]) -> Result<()> {
        let Some(path) = beside(folder, emotion.name(), &ANNOTATIONS) else { return Ok(()) };
        let points = self.annotation(&path, size)?;
        if points.len() != self.points[0].len() {
            let what = format!("it has {} points, the neutral one {}", points.len(), self.points[0].len());
            return Err(Fault::new(what).at(&path).help("mark the same points in every shot"));
        }
        self.points[emotion.index()] = points;
        Ok(())
    }

    /// Reads the points of a shot, where they are of its photo.
    fn read_marks(&mut self, folder: &Path, emotion: Emotion) -> Result<()> {
        let path = folder.join(format!("{emotion}.toml"));
        if !path.is_file() {
            return Ok(());
        }
        let text = read_text(&path)?;
        let marks = Marks::parse(&text).map_err(|f| f.at(&path))?;
        // Points of another photo, one that has been retaken since, say nothing of this one.
        let photo = self.photos[emotion.index()].as_ref().and_then(|p| p.file_name());
        let photo = photo.map(|n| n.to_string_lossy().into_owned());
        if photo.is_none_or(|name| self.sums.get(&name) != Some(&marks.photo)) {
            return Ok(());
        }
        // What was found is made of the other files and says nothing new; what a hand has set does.
        if let Some(sum) = sum_of_marks(&marks.points) {
            self.sums.insert(format!("{emotion}.toml"), sum);
        }
        self.points[emotion.index()] = marks.points;
        Ok(())
    }

    fn note(&mut self, path: &Path, bytes: &[u8]) {
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        self.sums.insert(name, sha256(bytes));
    }

    fn annotation(&mut self, path: &Path, size: [usize; 2]) -> Result<Vec<Placed>> {
        let text = read_text(path)?;
        self.note(path, text.as_bytes());
        let list = Annotation::parse(&text).map_err(|f| f.at(path))?;
        let one = list.first().ok_or_else(|| Fault::of(FileFault::Missing, "it has no points").at(path))?;
        let placed = |at: Point| Placed { at, confidence: 1.0, how: How::Hand };
        Ok(one.in_pixels(size).into_iter().map(placed).collect())
    }

    /// Whether the points are our own 41, so that those found are written to `happy.toml` and so on.
    #[must_use]
    pub fn are_own(&self) -> bool {
        self.points[0].is_empty()
    }

    /// What to calibrate from.
    ///
    /// # Errors
    /// As [`Inputs::foreign`] and [`Inputs::with`].
    pub fn inputs(&self) -> Result<Inputs<'_>> {
        let missing = || Fault::of(FileFault::Missing, "there is no neutral photo");
        let neutral = self.greys[0].as_ref().ok_or_else(missing)?;
        let mut inputs = match &self.face {
            Some(face) if self.are_own() => Inputs::own(neutral, &face.points),
            _ => {
                let points: Vec<Point> = self.points[0].iter().map(|p| p.at).collect();
                Inputs::foreign(neutral, &points, &self.named)?
            }
        };
        for emotion in &Emotion::ALL[1..] {
            if let Some(grey) = &self.greys[emotion.index()] {
                inputs = inputs.with(*emotion, grey, self.points[emotion.index()].clone())?;
            }
        }
        Ok(inputs)
    }

    /// The file of a shot's points, as calibrating writes it: `happy.toml`'s text. None of a shot that there is not, and of
    /// somebody's own annotation.
    #[must_use]
    pub(crate) fn marks(&self, emotion: Emotion, points: &[Placed]) -> Option<Marks> {
        let path = self.photos[emotion.index()].as_ref()?;
        let photo = self.sums.get(&path.file_name()?.to_string_lossy().into_owned())?.clone();
        let ours = self.are_own() && emotion != Emotion::Neutral && points.len() == Binding::own_points().count();
        ours.then(|| Marks { points: points.to_vec(), photo })
    }
}
