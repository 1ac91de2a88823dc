//! The studio without a terminal: keys and reports go in, a frame comes out.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use crossbeam_channel::{Receiver, Sender, unbounded};
use ratatui::Frame;
use ratatui::layout::Rect;

use super::aligning::{self, Aligner};
use super::draw::{self, FaceLayout, Layout, Pictures};
use super::execute::{SILENT, execute};
use super::export::{Exporter, Progress};
use super::face_desk::FaceDesk;
use super::job::Job;
use super::listening::Tone;
use super::overlay::Overlay;
use super::picture::FacePicture;
use super::state::Hear;
use super::state::{Open, State};
use super::voice::Voice;
use super::{Action, Place, calibrating, face_edits, following, keys, places, tap_desk, work};
use crate::calibration::Kept;
use crate::disk::Result;
use crate::drawing::Drawing;
use crate::face::Created;
use crate::geometry::Point;
use crate::media::Source;
use crate::photo::Photo;
use crate::pose::Emotion;
use crate::project::Followed;
use crate::project::{Finding, Lesson};
use crate::speech::{Alignment, Heard, Spectrogram};

/// What a thread has to tell.
#[derive(Debug)]
pub enum Report {
    /// A lesson was opened, or does not open.
    Opened {
        /// The folder's name.
        name: String,
        /// The lesson.
        lesson: Box<Result<Lesson>>,
        /// What a check found.
        findings: Vec<Finding>,
    },
    /// The files of a lesson were checked.
    Checked {
        /// The lesson's folder.
        root: PathBuf,
        /// What was found.
        findings: Vec<Finding>,
    },
    /// The outline of a sound is ready.
    Outlined {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// Its loudest sample.
        loudest: f32,
    },
    /// The search for times has ended: each clip's number with what was found.
    Aligned {
        /// The lesson's folder.
        root: PathBuf,
        /// What was found.
        found: Vec<(usize, Result<Alignment>)>,
    },
    /// How far the following of a face is: frames done, of how many.
    Following(usize, Option<usize>),
    /// The face in a clip's video was followed, or could not be.
    Followed {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// What was found.
        found: Box<Result<Followed>>,
    },
    /// A clip's video was opened, or cannot be.
    VideoOpened {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// Its frames.
        source: Box<Result<Source>>,
    },
    /// A frame of a clip's video was read, or cannot be.
    FrameRead {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// Which frame.
        number: u32,
        /// What it shows.
        photo: Box<Result<Photo>>,
    },
    /// Something was heard in the sound of a clip; nothing where listening broke off.
    Listened {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the clip.
        clip: usize,
        /// What.
        what: Option<Listening>,
    },
    /// The photo of a face was read, or cannot be.
    PhotoRead {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the face.
        face: usize,
        /// Which of its shots.
        shot: Emotion,
        /// The photo, and the points of somebody else's annotation.
        read: Box<Result<(Arc<Photo>, Vec<Point>)>>,
    },
    /// A face was calibrated, or cannot be.
    Calibrated {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the face.
        face: usize,
        /// What was found; nothing of it is written yet.
        made: Box<Result<Kept>>,
    },
    /// The stages of a photo are ready.
    Staged {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the face.
        face: usize,
        /// Each with its caption; none where they were not asked for.
        stages: Option<Vec<(String, Drawing)>>,
    },
    /// The points of a face were found, or not.
    FaceFound {
        /// The lesson's folder.
        root: PathBuf,
        /// Number of the face.
        face: usize,
        /// The face, and what there is to say of it.
        found: Box<Result<Created>>,
    },
    /// An export goes on.
    Exporting(Progress),
    /// An export has ended.
    Exported(Result<crate::export::CourseReport>),
}

/// What was listened for.
#[derive(Debug)]
pub enum Listening {
    /// The spectrogram.
    Spectrogram(Arc<Spectrogram>),
    /// The pitch.
    Tone(Arc<Tone>),
    /// Where syllables are.
    Syllables(Heard),
}

/// The studio: state, work under way, and the picture of the face.
pub struct Studio {
    /// Everything it knows.
    pub state: State,
    exporter: Arc<Mutex<Exporter>>,
    aligner: Aligner,
    voice: Option<Voice>,
    reports: (Sender<Report>, Receiver<Report>),
    /// Threads that have not reported their end.
    under_way: usize,
    face: FacePicture,
    /// The cartoon on the page of a face, and the stage of the search that is shown.
    cartoon: FacePicture,
    stage: FacePicture,
    /// Whether the last frame had no room for anything: nobody can see then what a key would do.
    too_small: bool,
}

impl Studio {
    /// A studio over a state; `exporter` makes the exports.
    #[must_use]
    pub fn new(state: State, exporter: Exporter) -> Self {
        Self {
            state,
            exporter: Arc::new(Mutex::new(exporter)),
            aligner: Aligner::default(),
            voice: None,
            reports: unbounded(),
            under_way: 0,
            face: FacePicture::default(),
            cartoon: FacePicture::default(),
            stage: FacePicture::default(),
            too_small: false,
        }
    }

    /// Finds times by another aligner.
    #[must_use]
    pub fn with_aligner(mut self, aligner: Aligner) -> Self {
        self.aligner = aligner;
        self
    }

    /// Lets itself be heard, where there is a player for sound on this side of the connection.
    pub(super) fn find_voice(&mut self) {
        self.voice = Voice::found();
        self.state.can_hear = self.voice.is_some();
    }

    /// Takes a key by its name in the key table. Keys that mean nothing here are let pass.
    pub fn key(&mut self, name: &str) -> bool {
        if self.too_small {
            // No question could be seen. What is unsaved waits in the journal, as after a lost connection.
            self.state.leaving |= name == "Ctrl-c";
            return self.state.leaving;
        }
        let place = self.state.place();
        // While a lesson opens, keys would go to a screen that is about to change.
        if self.state.busy.is_some() && place == Place::Projects && !matches!(name, "q" | "Ctrl-c" | "Esc") {
            return false;
        }
        let action = keys::action_of(place, name);
        if let Some(action) = action {
            self.handle(action);
        }
        action.is_some()
    }

    /// Carries out an action.
    pub fn handle(&mut self, action: Action) {
        for job in execute(&mut self.state, action) {
            self.start(job);
        }
        self.speak();
    }

    /// Lets be heard what is to be heard.
    fn speak(&mut self) {
        let Some(hear) = self.state.hear.take() else { return };
        let sound = self.state.clip().and_then(|c| c.sound.clone());
        match (&self.voice, hear, sound) {
            (Some(voice), Hear::Clip { from, speed }, Some(sound)) => voice.play(sound, from, speed),
            (Some(voice), Hear::Soon { from, speed }, Some(sound)) => voice.prepare(sound, from, speed),
            (Some(voice), Hear::Clicks(times), _) => voice.click(times),
            (Some(voice), ..) => voice.stop(),
            (None, ..) => {}
        }
    }

    /// Takes pasted text: it goes into a line being typed and nowhere else.
    pub fn paste(&mut self, text: &str) {
        if let Some(Overlay::Prompt(prompt)) = self.state.overlays.last_mut() {
            prompt.line.put(text);
        }
    }

    /// Lets so many seconds of playing pass; whether another frame is due.
    pub fn advance(&mut self, seconds: f64) -> bool {
        if self.state.editor.as_ref().is_some_and(|e| e.tapping.is_some()) {
            let new = tap_desk::advance(&mut self.state, seconds);
            self.speak();
            return new;
        }
        let clips = self.state.open.as_ref().and_then(|o| o.lesson.as_ref().ok()).map(|l| &l.clips);
        let (Some(clips), Some(editor)) = (clips, &mut self.state.editor) else { return false };
        let Some(at) = editor.playing.map(|t| t + seconds) else { return false };
        let before = editor.frame();
        let over = at >= editor.timeline.duration();
        let frame = (at * editor.timeline.fps()).floor() / editor.timeline.fps();
        editor.go(&clips[editor.clip], frame);
        editor.playing = (!over).then_some(at);
        let new = over || editor.frame() != before;
        if let Some(job) = following::missing(&mut self.state) {
            self.start(job);
        }
        if over {
            self.state.message.take_if(|m| m.text == SILENT);
        }
        new
    }

    /// Seconds to the next frame while it plays; none while nothing moves.
    #[must_use]
    pub fn beat(&self) -> Option<f64> {
        let editor = self.state.editor.as_ref()?;
        let fps = editor.timeline.fps();
        if let Some(tapping) = &editor.tapping {
            return tapping.beat(fps);
        }
        editor.playing.map(|at| ((at * fps + 1e-6).floor() + 1.0) / fps - at)
    }

    /// What threads report.
    #[must_use]
    pub fn reports(&self) -> &Receiver<Report> {
        &self.reports.1
    }

    /// Takes a report.
    pub fn receive(&mut self, report: Report) {
        match report {
            Report::Opened { name, lesson, findings } => {
                self.under_way -= 1;
                self.state.busy = None;
                if let Ok(lesson) = lesson.as_ref()
                    && let Some(note) = lesson.notes.first()
                {
                    self.state.say(super::wording::worded(note));
                }
                if let Ok(lesson) = lesson.as_ref()
                    && lesson.recovered > 0
                {
                    let many = if lesson.recovered == 1 { "change" } else { "changes" };
                    self.state.say(format!("brought back {} unsaved {many} from last time", lesson.recovered));
                }
                if let Ok(lesson) = lesson.as_ref()
                    && lesson.lost > 0
                {
                    self.state.refuse(format!(
                        "{} unsaved changes fit the files no more: brought back {}, all are kept in .lianpu/journal.lost",
                        lesson.lost, lesson.recovered
                    ));
                }
                self.state.open = Some(Open::new(name, *lesson, findings));
            }
            Report::Checked { root, findings } => {
                self.under_way -= 1;
                let open = self.state.open.as_mut();
                if let Some(open) = open.filter(|o| o.lesson.as_ref().is_ok_and(|l| l.root == root)) {
                    open.findings = findings;
                }
            }
            Report::Outlined { root, clip, loudest } => {
                self.under_way -= 1;
                // The author may have gone to another lesson in the meantime.
                if self.state.lesson().is_none_or(|l| l.root != root) {
                    return;
                }
                if let Some(editor) = self.state.editor.as_mut().filter(|e| e.clip == clip) {
                    editor.loudest = Some(loudest);
                }
            }
            Report::Aligned { root, found } => {
                self.under_way -= 1;
                if let Some(job) = aligning::found(&mut self.state, &root, found) {
                    self.start(job);
                }
            }
            Report::Following(done, of) => following::goes_on(&mut self.state, (done, of)),
            Report::Followed { root, clip, found } => {
                self.under_way -= 1;
                following::found(&mut self.state, &root, clip, *found);
            }
            Report::VideoOpened { root, clip, source } => {
                self.under_way -= 1;
                if let Some(job) = following::opened(&mut self.state, &root, clip, *source) {
                    self.start(job);
                }
            }
            Report::FrameRead { root, clip, number, photo } => {
                self.under_way -= 1;
                if let Some(job) = following::read(&mut self.state, &root, clip, number, *photo) {
                    self.start(job);
                }
            }
            Report::Listened { root, clip, what } => {
                self.under_way -= 1;
                let open = self.state.open.as_mut().filter(|o| o.lesson.as_ref().is_ok_and(|l| l.root == root));
                let Some(heard) = open.map(|o| o.heard.entry(clip).or_default()) else { return };
                match what {
                    Some(Listening::Spectrogram(spectrogram)) => heard.spectrogram = Some(spectrogram),
                    Some(Listening::Tone(tone)) => heard.tone = Some(tone),
                    Some(Listening::Syllables(found)) => places::found(&mut self.state, &root, clip, &found),
                    None => self.state.refuse("this sound cannot be listened to"),
                }
            }
            Report::PhotoRead { root, face, shot, read } => match *read {
                Ok((photo, dots)) => {
                    if let Some(desk) = self.desk_of(&root, face).filter(|desk| desk.shot == shot) {
                        desk.photo = Some(photo);
                        desk.dots = dots;
                    }
                }
                Err(fault) => {
                    if self.desk_of(&root, face).is_some() {
                        self.state.say_fault(&fault);
                    }
                }
            },
            Report::Staged { root, face, stages } => {
                self.under_way -= 1;
                if let Some((desk, stages)) = self.desk_of(&root, face).zip(stages) {
                    desk.stages = stages;
                }
            }
            Report::Calibrated { root, face, made } => {
                self.under_way -= 1;
                self.state.busy = None;
                if let Some(job) = calibrating::made(&mut self.state, &root, face, *made) {
                    self.start(job);
                }
            }
            Report::FaceFound { root, face, found } => {
                self.under_way -= 1;
                self.state.busy = None;
                if self.desk_of(&root, face).is_none() {
                    return;
                }
                match *found {
                    Ok(created) => {
                        face_edits::found(&mut self.state, face, &created.face);
                        if let Some(desk) = &mut self.state.face {
                            desk.remarks = created.warnings.iter().map(ToString::to_string).collect();
                        }
                    }
                    Err(fault) => {
                        if let Some(desk) = &mut self.state.face {
                            desk.remarks = vec!["where the search fails, o places the face by hand".into()];
                        }
                        self.state.say_fault(&fault);
                    }
                }
            }
            Report::Exporting(now) => {
                if let Some(Overlay::Export { progress, .. }) = self.export() {
                    *progress = now;
                }
            }
            Report::Exported(done) => {
                self.under_way -= 1;
                super::export::exported(&mut self.state, done);
            }
        }
    }

    /// Waits for everything that is under way, and takes it: for tests and tools, which have no loop.
    pub fn settle(&mut self) {
        while self.under_way > 0 {
            match self.reports.1.recv() {
                Ok(report) => self.receive(report),
                Err(_) => return,
            }
        }
    }

    /// Draws the state. The face is painted anew only where its pose or its size has changed.
    pub fn draw(&mut self, frame: &mut Frame<'_>) {
        self.too_small = draw::has_no_room(frame.area());
        let layout = Layout::of(frame.area(), &self.state);
        if let (Some(layout), Some(editor)) = (&layout, &self.state.editor) {
            self.face.show(&editor.figure, &editor.pose(), layout.face, self.state.colours);
        }
        self.paint_desk(frame.area());
        let pictures = Pictures { face: &self.face, cartoon: &self.cartoon, stage: &self.stage };
        draw::screen(frame, &self.state, layout.as_ref(), pictures);
    }

    /// Paints what the page of a face shows, where it has changed.
    fn paint_desk(&mut self, area: Rect) {
        let Some(desk) = self.state.face.as_ref().filter(|_| !self.too_small) else { return };
        let layout = FaceLayout::of(area, desk);
        if let Some(figure) = &desk.figure {
            self.cartoon.show(figure, &desk.pose(), layout.cartoon, self.state.colours);
        }
        if let Some((_, drawing)) = desk.stage.and_then(|s| desk.stages.get(s)) {
            self.stage.show_drawing(drawing, layout.photo, self.state.colours);
        }
    }

    /// The desk, where it holds that face of that lesson.
    fn desk_of(&mut self, root: &Path, face: usize) -> Option<&mut FaceDesk> {
        let here = self.state.lesson().is_some_and(|l| l.root == root);
        self.state.face.as_mut().filter(|desk| here && desk.face == face)
    }

    fn export(&mut self) -> Option<&mut Overlay> {
        self.state.overlays.iter_mut().find(|o| matches!(o, Overlay::Export { .. }))
    }

    fn start(&mut self, job: Job) {
        self.under_way += 1;
        work::start(job, self.reports.0.clone(), Arc::clone(&self.exporter), self.aligner.clone());
    }
}
