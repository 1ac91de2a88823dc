//! Aligning and tracking an open project from its files to its files: the course of work behind `align` and `track`. The
//! studio runs the same jobs in threads and takes their results by the same changes.

use std::path::{Path, PathBuf};

use super::align::AlignJob;
use super::prepare::Tracking;
use super::tracking::{Followed, Method, TrackJob};
use crate::calibration::Kept;
use crate::disk::{Fault, Message, NextStep, Result, Setting, Task, message};
use crate::project::ProjectFault;
use crate::project::edit::{Lesson, refusal};
use crate::project::files::Clip;
use crate::speech::{Alignment, Note};
use crate::track::Options;

/// The result of aligning a project.
#[derive(Debug, Default)]
pub struct AlignReport {
    /// The clips that were aligned, by number.
    pub aligned: Vec<usize>,
    /// What an author should know.
    pub notes: Vec<Message>,
    /// The clips that could not be aligned.
    pub failed: Vec<(usize, Fault)>,
}

/// The clips to track, and how.
#[derive(Debug, Clone, Default)]
pub struct TrackRequest {
    /// One clip by number, whatever ratios it has; `None` for every clip whose video or calibration has changed.
    pub clip: Option<usize>,
    /// The method.
    pub method: Method,
    /// How ratios are read from points.
    pub options: Options,
    /// Whether ratios that were not found in the video are replaced.
    pub replace: bool,
}

/// An event of tracking a project.
#[derive(Debug)]
pub enum TrackEvent<'a> {
    /// Something an author should know.
    Note(&'a Message),
    /// A clip was tracked, and its files are written.
    Tracked(&'a Clip),
    /// A clip could not be tracked.
    Failed(&'a Clip, Fault),
}

impl Lesson {
    /// Opens a project whose files are to be written at once. `what` is the noun phrase for what is to be written.
    ///
    /// # Errors
    /// When it cannot be opened, is read-only, or has changes that were never saved.
    pub fn open_to_write(root: &Path, what: &str) -> Result<Self> {
        let lesson = Self::open(root)?;
        if let Some(why) = &lesson.read_only {
            return Err(refusal(&format!("changed, so {what} cannot be kept"), why).at(root));
        }
        lesson.check_saved()?;
        Ok(lesson)
    }

    /// Makes sure that the files are what the project is.
    ///
    /// # Errors
    /// When there are changes that were never saved.
    pub fn check_saved(&self) -> Result<()> {
        if !self.is_unsaved() {
            return Ok(());
        }
        Err(Fault::of(ProjectFault::Unsaved, "the lesson has changes that were never saved")
            .at(&self.root)
            .help(message!["open it in ", Task::Open, " and save or discard them"]))
    }

    /// Calibrates a face from its files and saves what is found. Returns it and the files that were written.
    ///
    /// # Errors
    /// When there is no such face, its shots cannot be used, or a file cannot be written.
    pub fn calibrate(&mut self, face: usize) -> Result<(Kept, Vec<PathBuf>)> {
        let folder = self.faces.get(face).map(|f| f.folder.clone());
        let folder =
            folder.ok_or_else(|| Fault::of(ProjectFault::NoSuchFace, format!("there is no face number {face}")))?;
        let kept = Kept::make(&folder)?;
        let written = self.keep_calibration(face, &kept)?;
        Ok((kept, written))
    }

    /// The clips with a recording and a script, by number.
    #[must_use]
    pub(crate) fn spoken_clips(&self) -> Vec<usize> {
        let spoken = |c: &Clip| c.sound.is_some() && !c.syllables.is_empty();
        self.clips.iter().enumerate().filter(|(_, c)| spoken(c)).map(|(n, _)| n).collect()
    }

    /// Finds the times of one clip, or of every clip whose sound or script has changed, and saves them; with `keep` false
    /// they stay in memory.
    ///
    /// # Errors
    /// When a chosen clip has no recording or script, or a file cannot be written.
    pub fn align(&mut self, chosen: Option<usize>, keep: bool) -> Result<AlignReport> {
        let mut report = AlignReport { notes: self.state_notes(), ..AlignReport::default() };
        let wanted = match chosen {
            Some(number) => vec![number],
            None => self.to_align(&mut report.notes),
        };
        if wanted.is_empty() && self.spoken_clips().is_empty() {
            report.notes.push("no clip has both a recording and a script, so there is nothing to align".into());
        }
        for (number, found) in AlignJob::of(self, &wanted)?.run() {
            let found = match found {
                Ok(found) => found,
                Err(fault) => {
                    report.failed.push((number, fault));
                    continue;
                }
            };
            let clip = &self.clips[number];
            let named = |note: Message| note.after(format!("clip {}: ", clip.entry.name));
            report.notes.extend(clip.alignment_notes(&found).into_iter().map(|(_, note)| named(note)));
            match self.aligned(number, &found) {
                Some(change) if keep => self.change(change)?,
                Some(_) => self.take_alignment(number, &found),
                None => {}
            }
            report.aligned.push(number);
        }
        if keep && self.is_unsaved() {
            self.save()?;
        }
        Ok(report)
    }

    /// The clips to align where none is named. Times that somebody made are only replaced when asked for by name.
    fn to_align(&self, notes: &mut Vec<Message>) -> Vec<usize> {
        let mut wanted = Vec::new();
        for number in self.spoken_clips() {
            let clip = &self.clips[number];
            let name = &clip.entry.name;
            if clip.wants_alignment() {
                wanted.push(number);
            } else if clip.score.aligned.is_none() {
                let own = format!("clip {name} has times of its own, which stay; ");
                notes.push(message![own, Setting::Clip.of(name), " finds them anew"]);
            } else if clip.labels_are_script && clip.found_for_another() {
                let own = format!("clip {name} has no script but what its times say, so they stay; ");
                notes.push(message![own, Setting::Clip.of(name), " finds them anew"]);
            } else if clip.score.pins.is_empty() {
                notes.push(format!("clip {name}: neither its sound nor its script has changed, its times stay").into());
            } else {
                // What an author has set since moves what lies between.
                wanted.push(number);
            }
        }
        wanted
    }

    /// Follows the faces in the clips' videos and saves what is found, clip by clip.
    ///
    /// # Errors
    /// When the chosen clip has no video, a file cannot be written, or `event` fails.
    pub fn track(
        &mut self,
        request: &TrackRequest,
        tracking: Tracking<'_>,
        event: &mut dyn FnMut(TrackEvent<'_>) -> Result<()>,
    ) -> Result<()> {
        let mut notes = self.state_notes();
        let wanted = self.to_track(request, &mut notes)?;
        notes.iter().try_for_each(|note| event(TrackEvent::Note(note)))?;
        for number in wanted {
            let name = self.clips[number].entry.name.clone();
            let job = TrackJob::of(self, number, request.method, request.options);
            match job.and_then(|job| job.run(&mut |done, of| tracking(&name, done, of))) {
                Ok(found) => {
                    for note in found.all_notes() {
                        event(TrackEvent::Note(&note.after(format!("clip {name}: "))))?;
                    }
                    if let Some(change) = self.tracked(number, &found.tracked, &found.checksum) {
                        self.change(change)?;
                        self.save()?;
                    }
                    event(TrackEvent::Tracked(&self.clips[number]))?;
                }
                Err(fault) => event(TrackEvent::Failed(&self.clips[number], fault))?,
            }
        }
        Ok(())
    }

    /// The clips to track. A record that somebody made otherwise is only replaced when that is asked for.
    fn to_track(&self, request: &TrackRequest, notes: &mut Vec<Message>) -> Result<Vec<usize>> {
        let chosen = request.clip;
        let mut wanted = Vec::new();
        for (number, clip) in self.clips.iter().enumerate().filter(|(n, _)| chosen.is_none_or(|c| c == *n)) {
            let name = &clip.entry.name;
            if clip.video.is_none() {
                if chosen.is_some() {
                    return Err(Fault::of(ProjectFault::Incomplete, format!("the clip `{name}` has no video"))
                        .at(&clip.folder)
                        .help("put it there as video.mp4, or as pictures in a folder frames/"));
                }
                continue;
            }
            let own = clip.record.is_some() && clip.score.tracked.is_none();
            if own && !request.replace {
                let stay = format!("clip {name} has ratios of its own, which stay; ");
                let step = NextStep::default().and(Setting::Replace);
                notes.push(message![stay, step, " puts the video's in their place"]);
            } else if chosen.is_some() || own || self.is_tracked_anew(number, request.method, &request.options)? {
                wanted.push(number);
            } else {
                let same = "neither its video nor the calibration has changed, what was found stays";
                notes.push(format!("clip {name}: {same}").into());
            }
        }
        if self.clips.iter().all(|c| c.video.is_none()) {
            notes.push("no clip has a video, so there is nothing to follow".into());
        }
        Ok(wanted)
    }
}

impl Clip {
    /// What an author should know of an alignment of this clip: the flaws of its recording, and where sound and script
    /// part. Each with its time in seconds; `None` where it concerns the clip as a whole.
    #[must_use]
    pub(crate) fn alignment_notes(&self, found: &Alignment) -> Vec<(Option<f64>, Message)> {
        let mut notes: Vec<(Option<f64>, Message)> = Vec::new();
        if let Some(sound) = &self.sound {
            let flaws = sound.warnings.iter().cloned().chain(sound.quality().remarks());
            notes.extend(flaws.map(|flaw| (None, flaw.into())));
        }
        for note in &found.notes {
            let at = match note {
                // The qualities of the sound have it.
                Note::Noisy { .. } => continue,
                Note::NotHeard { at, .. } => Some(*at),
                Note::NotInScript { start, .. } => Some(*start),
                Note::Doubtful => None,
            };
            notes.push((at, note.to_string().into()));
        }
        notes
    }
}

impl Followed {
    /// What an author should know: of the calibration, then of the video.
    #[must_use]
    pub fn all_notes(&self) -> Vec<Message> {
        self.notes.iter().chain(&self.tracked.notes).cloned().collect()
    }
}
