//! `lianpu.toml`: what a lesson is called, whose faces and which clips it has, and what comes out.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::disk::{
    Fault, FileFault, Result, Task, clean_line, confine, from_toml, message, plain_name, read_text, suggestion,
};
use crate::figure::LayerPlace;
use crate::pose::MouthPreset;
use crate::project::ProjectFault;
use crate::render::MAX_SIDE;
use crate::script::{OnsetPreset, System};

/// The file's name.
pub const MANIFEST: &str = "lianpu.toml";

/// The version of the format that is read and written.
const FORMAT: u32 = 1;

/// Frames a second that make sense: below, a closure is not seen; above, no screen shows them.
const FPS: std::ops::RangeInclusive<f64> = 1.0..=240.0;

/// A lesson's manifest.
#[derive(Debug, Clone, PartialEq)]
pub struct Manifest {
    /// What the lesson is called.
    pub title: String,
    /// Its faces.
    pub faces: Vec<FaceEntry>,
    /// Its clips, in the order of the lesson.
    pub clips: Vec<ClipEntry>,
    /// What comes out unless an export says otherwise.
    pub output: Output,
}

/// A face of the lesson; its files are in `faces/NAME/`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FaceEntry {
    /// Its name, which is its folder's.
    pub name: String,
    /// `cartoon`, `line`, `cat`, or a file `figures/NAME.toml`; where left out `cartoon` once the face has points,
    /// else `line`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub figure: Option<String>,
    /// The cartoon's style: `normal`, `brows`, `cute`, `ink`, or a file `styles/NAME.toml`. Line figures have only
    /// their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub style: Option<String>,
    /// Which nine mouth shapes.
    #[serde(default, skip_serializing_if = "is_default")]
    pub mouths: MouthPreset,
    /// Layers of the author's own, back to front.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<LayerEntry>,
}

/// A layer of the author's own: an SVG file that covers the figure's whole view.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LayerEntry {
    /// `layers/NAME.svg`.
    pub file: String,
    /// Where it is drawn.
    #[serde(default, skip_serializing_if = "is_default")]
    pub place: LayerPlace,
}

/// A clip of the lesson, one recording; its files are in `clips/NAME/`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClipEntry {
    /// Its name, which is its folder's.
    pub name: String,
    /// Who speaks; may be left out where there is one face.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub face: Option<String>,
    /// How the script is written; told from the text where left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub script_system: Option<System>,
    /// When the shapes of a syllable start.
    #[serde(default, skip_serializing_if = "is_default")]
    pub onsets: OnsetPreset,
    /// The clip that this one is another take of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub take_of: Option<String>,
    /// Frames a second of a video that is a folder of pictures; 25 where left out. A video file knows its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub video_fps: Option<f64>,
}

/// What comes out.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// Frames a second.
    pub fps: f64,
    /// Width and height in pixels.
    pub size: [u32; 2],
}

impl Default for Output {
    fn default() -> Self {
        Self { fps: 25.0, size: [1280, 720] }
    }
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: u32,
    title: String,
    #[serde(default, rename = "face")]
    faces: Vec<toml::Spanned<FaceEntry>>,
    #[serde(default, rename = "clip")]
    clips: Vec<toml::Spanned<ClipEntry>>,
    #[serde(default)]
    output: Option<toml::Spanned<Output>>,
}

impl Manifest {
    /// Reads and checks the manifest of the project in `root`, which no path in it leads out of from now on.
    ///
    /// # Errors
    /// With file and line, what was found and what is allowed.
    pub(crate) fn read(root: &Path) -> Result<Self> {
        confine(root);
        let path = root.join(MANIFEST);
        if !path.is_file() {
            let (what, at) = match root.is_dir() {
                true => ("there is no lesson here", path.as_path()),
                false => ("there is no such folder", root),
            };
            return Err(Fault::of(ProjectFault::NoProject, what).at(at).help(message![
                "make one with ",
                Task::New,
                ", or give the folder that has a lianpu.toml"
            ]));
        }
        Self::parse(&read_text(&path)?).map_err(|f| f.at(&path))
    }

    /// Reads and checks the text of a manifest.
    ///
    /// # Errors
    /// With the line, what was found and what is allowed.
    pub(crate) fn parse(text: &str) -> Result<Self> {
        let file: File = from_toml(text)?;
        let line = |span: std::ops::Range<usize>| 1 + text[..span.start.min(text.len())].matches('\n').count();
        if file.format != FORMAT {
            return Err(Fault::of(FileFault::Version, format!("`format` is {}", file.format))
                .help(format!("this program reads lessons of format {FORMAT}")));
        }
        let output = match file.output {
            Some(output) => {
                let at = line(output.span());
                let output = output.into_inner();
                check_output(&output).map_err(|f| f.line(line_of(text, "[output]", at)))?;
                output
            }
            None => Output::default(),
        };
        let mut faces: Vec<FaceEntry> = Vec::new();
        for face in file.faces {
            let at = line(face.span());
            let face = face.into_inner();
            plain_name(&face.name).map_err(|f| f.line(at))?;
            if faces.iter().any(|f| f.name == face.name) {
                return Err(Fault::of(FileFault::Duplicate, format!("two faces are called `{}`", face.name))
                    .line(at)
                    .help("rename one"));
            }
            faces.push(face);
        }
        let mut clips: Vec<ClipEntry> = Vec::new();
        for clip in file.clips {
            let at = line(clip.span());
            let clip = clip.into_inner();
            plain_name(&clip.name).map_err(|f| f.line(at))?;
            if clips.iter().any(|c| c.name == clip.name) {
                return Err(Fault::of(FileFault::Duplicate, format!("two clips are called `{}`", clip.name))
                    .line(at)
                    .help("rename one"));
            }
            check_face_of(&clip, &faces).map_err(|f| f.line(at))?;
            clips.push(clip);
        }
        for clip in &clips {
            let is_other = |take: &String| clips.iter().any(|c| c.name == *take && c.name != clip.name);
            if let Some(take) = clip.take_of.as_ref().filter(|take| !is_other(take)) {
                return Err(Fault::of(
                    FileFault::Unknown,
                    format!("`{}` is a take of `{take}`, which is no other clip here", clip.name),
                )
                .help(format!("clips: {}", names(clips.iter().map(|c| &c.name)))));
            }
        }
        Ok(Self { title: clean_line(&file.title, 200), faces, clips, output })
    }

    /// The text of the manifest.
    #[must_use]
    pub(crate) fn to_toml(&self) -> String {
        use std::fmt::Write;
        let quoted = |s: &str| toml::Value::String(s.to_owned()).to_string();
        let mut out = format!("format = {FORMAT}\ntitle = {}\n", quoted(&self.title));
        for face in &self.faces {
            let _ = write!(out, "\n[[face]]\n{}", toml::to_string(face).unwrap_or_default());
        }
        for clip in &self.clips {
            let _ = write!(out, "\n[[clip]]\n{}", toml::to_string(clip).unwrap_or_default());
        }
        let [width, height] = self.output.size;
        let _ = write!(out, "\n[output]\nfps = {}\nsize = [{width}, {height}]\n", self.output.fps);
        out
    }

    /// The face that a clip has: the one it names, else the only one, else none (and the line face is drawn).
    #[must_use]
    pub(crate) fn face_of(&self, clip: &ClipEntry) -> Option<&FaceEntry> {
        match &clip.face {
            Some(name) => self.faces.iter().find(|f| f.name == *name),
            None => self.faces.first(),
        }
    }
}

/// The line of the first key after a table's heading; spans of a table start at its first key or at its heading.
fn line_of(text: &str, heading: &str, fallback: usize) -> usize {
    text.lines().position(|l| l.trim() == heading).map_or(fallback, |i| i + 1)
}

fn check_face_of(clip: &ClipEntry, faces: &[FaceEntry]) -> Result<()> {
    let known = || faces.iter().map(|f| f.name.as_str()).collect::<Vec<_>>();
    match &clip.face {
        Some(name) if faces.iter().all(|f| f.name != *name) => Err(Fault::of(
            FileFault::Unknown,
            format!("the clip `{}` has the face `{name}`, which is not in the lesson", clip.name),
        )
        .help(suggestion(name, "faces", &known()))),
        None if faces.len() > 1 => Err(Fault::new(format!("the clip `{}` does not say whose face it has", clip.name))
            .help(format!("add face = \"NAME\"; faces: {}", known().join(", ")))),
        _ => Ok(()),
    }
}

/// Checks numbers that an export can change as well.
///
/// # Errors
/// When fps or size are beyond their limits.
pub(crate) fn check_output(output: &Output) -> Result<()> {
    if !FPS.contains(&output.fps) {
        return Err(Fault::of(FileFault::OutOfRange, format!("`fps` is {}", output.fps)).help(format!(
            "give frames a second from {} to {}",
            FPS.start(),
            FPS.end()
        )));
    }
    let [width, height] = output.size;
    if [width, height].iter().any(|s| !(16..=MAX_SIDE).contains(s)) {
        return Err(Fault::of(FileFault::OutOfRange, format!("`size` is [{width}, {height}]"))
            .help(format!("give width and height in pixels, each from 16 to {MAX_SIDE}")));
    }
    Ok(())
}

fn names<'a>(names: impl Iterator<Item = &'a String>) -> String {
    names.cloned().collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "format = 1\ntitle = \"您好\"\n\n[[face]]\nname = \"teacher\"\nfigure = \"line\"\n\n[[clip]]\nname = \"nihao\"\nscript_system = \"han\"\n\n[output]\nfps = 25\nsize = [1280, 720]\n";

    #[test]
    fn a_manifest_is_read_as_it_is_written() {
        let manifest = Manifest::parse(GOOD).unwrap();
        assert_eq!(manifest.to_toml(), GOOD);
    }

    #[test]
    fn every_fault_names_its_line_and_what_is_allowed() {
        for (bad, line, word) in [
            (GOOD.replace("fps = 25", "fps = 0"), 12, "1 to 240"),
            (GOOD.replace("size = [1280, 720]", "size = [100000, 720]"), 12, "16384"),
            (GOOD.replace("fps = 25", "fps = nan"), 12, "1 to 240"),
            (GOOD.replace("figure =", "figur ="), 6, "did you mean `figure`"),
            (GOOD.replace("name = \"nihao\"", "name = \"../up\""), 8, "letters"),
            (GOOD.replace("name = \"nihao\"", "name = \"n\"\nface = \"techer\""), 8, "did you mean `teacher`"),
        ] {
            let fault = Manifest::parse(&bad).unwrap_err();
            assert!(fault.line_number().is_some_and(|l| l.abs_diff(line) <= 1), "{fault}");
            assert!(fault.next_step().contains(word), "{fault}");
        }
    }
}
