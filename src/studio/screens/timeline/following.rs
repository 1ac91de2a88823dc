//! The face in a clip's video, tracked in a thread; the result is one change of the project.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::disk::Result;
use crate::project::{Followed, Method, TrackJob, counted};
use crate::studio::app::project::{Following, OpenProject};
use crate::studio::app::shell::Shell;
use crate::studio::app::stack::{Context, Job, Reporter, Stack};
use crate::studio::app::wording;
use crate::track::Options;

/// Tracks the face in the video of a clip; stops where it does so already.
pub(in crate::studio) fn ask(project: &mut OpenProject, clip: usize, cx: &mut Context<'_>) {
    if let Some(now) = &project.following {
        now.stop.store(true, Ordering::Relaxed);
        cx.shell.say("stopping…");
        return;
    }
    let theirs = &project.lesson.clips[clip];
    let is_theirs = theirs.video.is_some() && theirs.record.is_some() && theirs.score.tracked.is_none();
    if is_theirs && !std::mem::replace(&mut project.replace_asked, true) {
        cx.shell.refuse("these ratios were not found here: T again puts those of the video in their place");
        return;
    }
    project.replace_asked = false;
    start(project, clip, true, cx);
}

/// Tracks the face in the video of a clip that was opened and whose record nobody has made yet, once.
pub(super) fn start_by_itself(project: &mut OpenProject, clip: usize, cx: &mut Context<'_>) {
    let wanted = project.lesson.read_only.is_none() && project.lesson.clips[clip].wants_tracking();
    if wanted && project.following.is_none() && project.followed.insert(clip) {
        start(project, clip, false, cx);
    }
}

fn start(project: &mut OpenProject, clip: usize, asked: bool, cx: &mut Context<'_>) {
    if asked && !project.may_change(cx.shell) || project.lesson.read_only.is_some() {
        return;
    }
    match TrackJob::of(&project.lesson, clip, Method::Aam, Options::default()) {
        Ok(job) => {
            project.followed.insert(clip);
            let stop = Arc::new(AtomicBool::new(false));
            project.following = Some(Following { done: (0, None), stop: Arc::clone(&stop) });
            cx.start(FollowJob { root: project.lesson.root.clone(), clip, job: Box::new(job), stop });
        }
        Err(fault) if asked => cx.shell.say_fault(&fault),
        Err(_) => {}
    }
}

/// Tracks the face in a clip's video.
struct FollowJob {
    root: PathBuf,
    clip: usize,
    job: Box<TrackJob>,
    /// Set to stop it.
    stop: Arc<AtomicBool>,
}

impl Job for FollowJob {
    type Made = Followed;
    const BROKEN: [&'static str; 2] = ["the face cannot be followed", "please report what `lianpu track` says"];

    fn run(&mut self, reporter: &Reporter) -> Result<Followed> {
        let mut told = 0;
        let (root, stop) = (&self.root, &self.stop);
        self.job.run(&mut |done: usize, of: Option<usize>| {
            // A report a percent, or ten frames where nobody knows how many there are.
            let now = of.map_or(done / 10, |of| 100 * done / of.max(1));
            if now != told {
                told = now;
                let root = root.clone();
                reporter.tell(move |stack| {
                    if let Some(project) = stack.project(&root)
                        && let Some(now) = &mut project.borrow_mut().following
                    {
                        now.done = (done, of);
                    }
                });
            }
            !stop.load(Ordering::Relaxed)
        })
    }

    fn done(self, made: Result<Followed>, stack: &mut Stack) {
        // The author may have gone to another project in the meantime, and come back.
        let Some(project) = stack.project(&self.root) else { return };
        let project = &mut *project.borrow_mut();
        let is_this = |now: &mut Following| Arc::ptr_eq(&now.stop, &self.stop);
        if project.following.take_if(is_this).is_none() {
            return;
        }
        match made {
            Ok(followed) => take(project, self.clip, &followed, &mut stack.shell),
            Err(_) if self.stop.load(Ordering::Relaxed) => stack.shell.say("stopped: the clip is as it was"),
            Err(fault) => stack.shell.say_fault(&fault),
        }
    }
}

/// Takes what was found.
fn take(project: &mut OpenProject, clip: usize, followed: &Followed, shell: &mut Shell) {
    let change = project.lesson.tracked(clip, &followed.tracked, &followed.checksum);
    let is_new = change.is_some();
    if change.is_some_and(|change| !project.change(change, shell)) {
        return;
    }
    let notes: Vec<String> = followed.all_notes().iter().map(wording::worded).collect();
    let worst = notes.first().cloned();
    project.notes.entry(clip).or_default().extend(notes);
    let frames = counted(followed.tracked.record.rows.len(), "frame");
    let lost = project.lesson.clips[clip].lost().len();
    let what = if is_new { format!("followed the face through {frames}") } else { "nothing new was found".into() };
    match (lost, worst) {
        (0, None) => shell.say(what),
        (0, Some(note)) => shell.say(format!("{what}; {note}")),
        (many, _) => {
            let places = counted(many, "place");
            shell.refuse(format!("{what}, {places} to look at: d goes there, o lists them"));
        }
    }
}
