//! Everything the studio knows: which lessons there are, which is open, what is on the desk, what lies on top.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use super::Place;
use super::aligning::Aligning;
use super::editor::{Editor, Left};
use super::face_desk::FaceDesk;
use super::following::{Following, Footage};
use super::listening::{Listened, SoundView};
use super::look::Colours;
use super::overlay::Overlay;
use crate::disk::Result;
use crate::project::{Clip, Finding, Lesson, Manifest, projects_in};

/// The studio's state. Drawing reads it, `execute` changes it.
#[derive(Debug)]
pub struct State {
    /// The folder that was opened.
    pub folder: PathBuf,
    /// The lessons in it.
    pub lessons: Vec<Listed>,
    /// Which lesson is chosen.
    pub chosen: usize,
    /// The open lesson.
    pub open: Option<Open>,
    /// The clip on the desk.
    pub editor: Option<Editor>,
    /// The face on the desk.
    pub face: Option<FaceDesk>,
    /// What lies on top, the last one topmost.
    pub overlays: Vec<Overlay>,
    /// What there is to say.
    pub message: Option<Message>,
    /// What is being waited for.
    pub busy: Option<String>,
    /// The search for times that is under way.
    pub aligning: Option<Aligning>,
    /// The following of a face that is under way.
    pub following: Option<Following>,
    /// The video of the clip on the desk.
    pub footage: Footage,
    /// How sound is shown.
    pub view: SoundView,
    /// Whether the pitch of the voice is shown.
    pub tone: bool,
    /// How many seconds after the sound a tap comes, once that was measured.
    pub latency: Option<f64>,
    /// What is to be heard, until the studio's voice has taken it.
    pub hear: Option<Hear>,
    /// Whether there is a player for sound on this side of the connection.
    pub can_hear: bool,
    /// What the terminal can show.
    pub colours: Colours,
    /// Whether it was said that playing is silent.
    pub said_silent: bool,
    /// Whether the studio is to be left.
    pub leaving: bool,
    /// Whether the whole screen is to be drawn anew.
    pub redraw: bool,
}

/// A lesson in the list.
#[derive(Debug)]
pub struct Listed {
    /// Its folder.
    pub root: PathBuf,
    /// The folder's name.
    pub name: String,
    /// Its title and number of clips, or what is wrong with its manifest.
    pub manifest: Result<(String, usize)>,
}

/// The open lesson, or why it does not open; and what a check found.
#[derive(Debug)]
pub struct Open {
    /// The folder's name.
    pub name: String,
    /// The lesson.
    pub lesson: Result<Lesson>,
    /// What is there, missing or wrong.
    pub findings: Vec<Finding>,
    /// Which clip is chosen.
    pub chosen: usize,
    /// Where the author was on the clips that she has left, by their numbers.
    pub left: BTreeMap<usize, Left>,
    /// The clips whose times were looked for: what was taken back is not done again unasked.
    pub aligned: BTreeSet<usize>,
    /// The clips whose face was followed: what was taken back is not done again unasked.
    pub followed: BTreeSet<usize>,
    /// What was heard of the clips so far, by their numbers.
    pub heard: BTreeMap<usize, Listened>,
    /// What the last search found odd of a clip as a whole.
    pub notes: BTreeMap<usize, Vec<String>>,
}

/// Something to be heard, or silence.
#[derive(Debug, Clone, PartialEq)]
pub enum Hear {
    /// The sound of the clip on the desk, from a time in seconds, at a speed.
    Clip {
        /// Seconds.
        from: f64,
        /// 1 is as it was spoken.
        speed: f64,
    },
    /// Nothing yet: that is what will be heard next, to be made ready.
    Soon {
        /// Seconds.
        from: f64,
        /// 1 is as it was spoken.
        speed: f64,
    },
    /// Clicks at these times, in seconds.
    Clicks(Vec<f64>),
    /// Nothing more.
    Nothing,
}

/// Something to say.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// What.
    pub text: String,
    /// Whether something could not be done.
    pub is_fault: bool,
}

impl Open {
    /// A lesson that was just opened, or does not open.
    #[must_use]
    pub fn new(name: String, lesson: Result<Lesson>, findings: Vec<Finding>) -> Self {
        Self {
            name,
            lesson,
            findings,
            chosen: 0,
            left: BTreeMap::new(),
            aligned: BTreeSet::new(),
            followed: BTreeSet::new(),
            heard: BTreeMap::new(),
            notes: BTreeMap::new(),
        }
    }
}

impl State {
    /// The lessons of a folder, or the one it is.
    ///
    /// # Errors
    /// When the folder cannot be listed.
    pub fn new(folder: impl Into<PathBuf>, colours: Colours) -> Result<Self> {
        let folder = folder.into();
        let lessons = projects_in(&folder)?.into_iter().map(Listed::of).collect();
        Ok(Self {
            folder,
            lessons,
            chosen: 0,
            open: None,
            editor: None,
            face: None,
            overlays: Vec::new(),
            message: None,
            busy: None,
            aligning: None,
            following: None,
            footage: Footage::default(),
            view: SoundView::default(),
            tone: false,
            latency: None,
            hear: None,
            can_hear: false,
            colours,
            said_silent: false,
            leaving: false,
            redraw: false,
        })
    }

    /// Where a key is pressed: on top, or on the screen.
    #[must_use]
    pub fn place(&self) -> Place {
        let is_tapping = self.editor.as_ref().is_some_and(|e| e.tapping.is_some());
        match (self.overlays.last(), self.screen()) {
            (Some(overlay), _) => overlay.place(),
            (None, Place::Timeline) if is_tapping => Place::Tapping,
            (None, screen) => screen,
        }
    }

    /// The screen below everything that lies on top.
    #[must_use]
    pub fn screen(&self) -> Place {
        if self.open.is_some() && self.face.is_some() {
            return Place::Face;
        }
        match (&self.open, &self.editor) {
            (Some(_), Some(_)) => Place::Timeline,
            (Some(_), None) => Place::Lesson,
            (None, _) => Place::Projects,
        }
    }

    /// The lesson that is open.
    #[must_use]
    pub fn lesson(&self) -> Option<&Lesson> {
        self.open.as_ref()?.lesson.as_ref().ok()
    }

    /// The lesson that is open, to change.
    pub fn lesson_mut(&mut self) -> Option<&mut Lesson> {
        self.open.as_mut()?.lesson.as_mut().ok()
    }

    /// The clip on the desk.
    #[must_use]
    pub fn clip(&self) -> Option<&Clip> {
        self.lesson()?.clips.get(self.editor.as_ref()?.clip)
    }

    /// What was heard of the clip on the desk.
    #[must_use]
    pub fn heard(&self) -> Option<&Listened> {
        self.open.as_ref()?.heard.get(&self.editor.as_ref()?.clip)
    }

    /// Whether there are changes that are not in the files.
    #[must_use]
    pub fn is_unsaved(&self) -> bool {
        self.lesson().is_some_and(Lesson::is_unsaved)
    }

    /// Says something.
    pub fn say(&mut self, text: impl Into<String>) {
        self.message = Some(Message { text: text.into(), is_fault: false });
    }

    /// Says that something could not be done, and what to do.
    pub fn refuse(&mut self, text: impl Into<String>) {
        self.message = Some(Message { text: text.into(), is_fault: true });
    }

    /// Says what went wrong: what, and what to do, in one line.
    pub fn say_fault(&mut self, fault: &crate::disk::Fault) {
        self.refuse(super::wording::in_a_line(fault));
    }
}

impl Listed {
    fn of(root: PathBuf) -> Self {
        // The folder may be given as `.`, which has no name.
        let whole = root.canonicalize().unwrap_or_else(|_| root.clone());
        let name = whole.file_name().map_or_else(|| "lesson".into(), |n| n.to_string_lossy().into_owned());
        let manifest = Manifest::read(&root).map(|m| (m.title, m.clips.len()));
        Self { name: crate::disk::clean_line(&name, 60), root, manifest }
    }
}
