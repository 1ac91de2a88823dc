//! Times found in the sound, for the studio: one search at a time in a thread, its result one change of the lesson; and
//! the places that it is not sure of, to go to.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::action::Action;
use super::job::Job;
use super::overlay::Overlay;
use super::state::State;
use crate::disk::Result;
use crate::project::{AlignJob, Clip, Doubt};
use crate::speech::Alignment;
use crate::timing::Interval;

/// What finds times: the job goes in, each wanted clip's number comes out with what was found.
#[derive(Clone)]
pub struct Aligner(Arc<Search>);

type Search = dyn Fn(&AlignJob) -> Vec<(usize, Result<Alignment>)> + Send + Sync;

impl Aligner {
    /// An aligner of another kind, for tests.
    pub fn new(search: impl Fn(&AlignJob) -> Vec<(usize, Result<Alignment>)> + Send + Sync + 'static) -> Self {
        Self(Arc::new(search))
    }

    /// Runs a job.
    #[must_use]
    pub fn run(&self, job: &AlignJob) -> Vec<(usize, Result<Alignment>)> {
        (self.0)(job)
    }
}

impl Default for Aligner {
    fn default() -> Self {
        Self::new(AlignJob::run)
    }
}

impl fmt::Debug for Aligner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Aligner")
    }
}

/// A search that is under way.
#[derive(Debug)]
pub struct Aligning {
    root: PathBuf,
    clip: usize,
    /// The clip when the search began: what is found fits this and nothing else.
    of: Standing,
    /// Whether the author asked for it.
    asked: bool,
    /// The one that comes after it, of which lesson; a newer one takes its place.
    next: Option<(PathBuf, usize, bool)>,
}

/// What a search goes by.
#[derive(Debug, PartialEq)]
struct Standing {
    script: String,
    intervals: Vec<Interval>,
    pins: Vec<usize>,
}

impl Standing {
    fn of(clip: &Clip) -> Self {
        Self { script: clip.script.clone(), intervals: clip.intervals().to_vec(), pins: clip.score.pins.clone() }
    }
}

/// A place to look at, as the list shows it.
#[derive(Debug, Clone, PartialEq)]
pub struct Spotted {
    /// Where, in seconds; none where it concerns the whole clip.
    pub at: Option<f64>,
    /// The syllable.
    pub syllable: Option<usize>,
    /// What there is.
    pub text: String,
}

/// The clip that is on the desk or chosen in the list.
fn chosen(state: &State) -> Option<usize> {
    state.editor.as_ref().map(|e| e.clip).or_else(|| state.open.as_ref().map(|o| o.chosen))
}

/// Aligns the clip on the desk, or the chosen one.
pub(super) fn ask(state: &mut State) -> Option<Job> {
    let clip = chosen(state)?;
    start(state, clip, true)
}

/// Aligns a clip that was opened and whose times nobody has found yet, once.
pub(super) fn of_itself(state: &mut State, clip: usize) -> Option<Job> {
    let open = state.open.as_mut()?;
    let lesson = open.lesson.as_ref().ok()?;
    if lesson.read_only.is_some() || !lesson.clips.get(clip)?.wants_alignment() || !open.aligned.insert(clip) {
        return None;
    }
    start(state, clip, false)
}

fn start(state: &mut State, clip: usize, asked: bool) -> Option<Job> {
    let lesson = state.lesson()?;
    let name = lesson.clips.get(clip)?.entry.name.clone();
    if let Some(why) = &lesson.read_only {
        let why = format!("the lesson cannot be changed: {why}");
        if asked {
            state.refuse(why);
        }
        return None;
    }
    let of = Standing::of(&lesson.clips[clip]);
    let (root, job) = (lesson.root.clone(), AlignJob::of(lesson, &[clip]));
    if let Some(now) = &mut state.aligning {
        now.next = Some((root, clip, asked));
        state.say(format!("{name} is aligned next"));
        return None;
    }
    match job {
        Ok(job) => {
            if let Some(open) = &mut state.open {
                open.aligned.insert(clip);
            }
            state.aligning = Some(Aligning { root: root.clone(), clip, of, asked, next: None });
            Some(Job::Align { root, job: Box::new(job) })
        }
        Err(fault) => {
            if asked {
                state.say_fault(&fault);
            }
            None
        }
    }
}

/// Takes what a search has found; the job that waited for its end.
pub(super) fn found(state: &mut State, root: &Path, found: Vec<(usize, Result<Alignment>)>) -> Option<Job> {
    let Aligning { clip, of, asked, next, .. } = state.aligning.take_if(|now| now.root == root)?;
    // The author may have gone to another lesson in the meantime.
    let is_open = |state: &State, root: &Path| state.lesson().is_some_and(|l| l.root == root);
    if is_open(state, root) {
        if found.is_empty() {
            state.refuse("the search for the times broke off: please report what `lianpu align` says");
        }
        for (number, alignment) in found.into_iter().filter(|(n, _)| *n == clip) {
            match alignment {
                Ok(alignment) => take(state, number, &of, asked, &alignment),
                Err(fault) => state.say_fault(&fault),
            }
        }
    }
    let (_, clip, asked) = next.filter(|(root, ..)| is_open(state, root))?;
    start(state, clip, asked)
}

fn take(state: &mut State, number: usize, of: &Standing, asked: bool, alignment: &Alignment) {
    let Some(clip) = state.lesson().and_then(|l| l.clips.get(number)) else { return };
    let name = clip.entry.name.clone();
    if Standing::of(clip) != *of {
        state.refuse(format!("{name} was changed while its times were looked for, and stays as it is: A looks again"));
        return;
    }
    let change = state.lesson().and_then(|l| l.aligned(number, alignment));
    let is_new = change.is_some();
    if let Some(change) = change
        && !super::edits::change(state, change)
    {
        return;
    }
    let Some(clip) = state.lesson().and_then(|l| l.clips.get(number)) else { return };
    // The others have a place, and are among the doubts.
    let whole = clip.alignment_notes(alignment).into_iter().filter(|(at, _)| at.is_none());
    let notes: Vec<String> = whole.map(|(_, note)| super::wording::worded(&note)).collect();
    let worst = notes.last().cloned();
    if let Some(open) = &mut state.open {
        open.notes.insert(number, notes);
    }
    let Some(clip) = state.lesson().and_then(|l| l.clips.get(number)) else { return };
    let doubts = clip.doubts().len();
    let what = format!("aligned {}", crate::project::counted(alignment.syllables.len(), "syllable"));
    let name = if state.editor.as_ref().is_some_and(|e| e.clip == number) { "" } else { &format!("{name}: ") };
    let which = match (is_new, asked) {
        (false, _) => format!("{name}the times are as they were found"),
        (true, true) => format!("{name}{what}"),
        (true, false) => format!("{name}{what} by their sound (u takes it back)"),
    };
    let rest = match doubts {
        0 => "no doubts".to_owned(),
        many => format!("{many} to look at: d goes there, o lists them"),
    };
    match worst {
        Some(note) => state.refuse(format!("{which}; {rest}; {note}")),
        None => state.say(format!("{which}; {rest}")),
    }
}

/// Goes to places that the alignment is not sure of, or lists them.
pub(super) fn look(state: &mut State, action: Action) {
    let Some(clip) = state.clip() else { return };
    let doubts = clip.to_look_at();
    if doubts.is_empty() && action != Action::Doubts {
        let unknown = clip.timing.tier("confidence").is_none() && clip.score.tracked.is_none();
        state.say(if unknown {
            "not aligned yet: A finds the times"
        } else {
            "nothing to look at: everything found is sure"
        });
        return;
    }
    match action {
        Action::Doubt(by) => {
            let cursor = state.editor.as_ref().map_or(0.0, |e| e.cursor);
            let on = state.editor.as_ref().and_then(|e| e.syllable);
            // The doubt that one stands on, by its syllable, is neither before nor after.
            let is_here = |d: &Doubt| d.syllable.is_some() && d.syllable == on && (d.start - cursor).abs() < 0.02;
            let beyond = |d: &&Doubt| !is_here(d) && (d.start - cursor) * f64::from(by) > 1e-3;
            let found = if by > 0 { doubts.iter().find(beyond) } else { doubts.iter().rev().find(beyond) };
            match found {
                Some(doubt) => {
                    let said = clip.told(doubt);
                    go(state, doubt.start, doubt.syllable);
                    state.say(said);
                }
                None => {
                    let side = if by > 0 { "after" } else { "before" };
                    state.say(format!("nothing more to look at {side} here; {} in all", doubts.len()));
                }
            }
        }
        Action::Doubts => {
            let list = spotted(state);
            if list.is_empty() {
                state.say("there is nothing to look at");
                return;
            }
            let cursor = state.editor.as_ref().map_or(0.0, |e| e.cursor);
            let after = list.iter().position(|s| s.at.is_some_and(|at| at >= cursor - 0.02));
            let chosen = after.unwrap_or(list.len() - 1);
            state.overlays.push(Overlay::Doubts { list, chosen });
        }
        _ => {}
    }
}

/// Everything there is to look at in the clip on the desk: what concerns all of it, then place by place.
fn spotted(state: &State) -> Vec<Spotted> {
    let (Some(clip), Some(number)) = (state.clip(), chosen(state)) else { return Vec::new() };
    let notes = state.open.iter().filter_map(|o| o.notes.get(&number)).flatten();
    let whole = notes.map(|n| Spotted { at: None, syllable: None, text: n.clone() });
    let doubts = clip.to_look_at();
    let places = doubts.iter().map(|d| Spotted { at: Some(d.start), syllable: d.syllable, text: clip.told(d) });
    whole.chain(places).collect()
}

/// Goes to what is chosen in the list.
pub(super) fn go_there(state: &mut State) {
    let Some(Overlay::Doubts { list, chosen }) = state.overlays.last() else { return };
    let Some(spotted) = list.get(*chosen).cloned() else { return };
    if let Some(at) = spotted.at {
        state.overlays.pop();
        go(state, at, spotted.syllable);
        state.say(spotted.text);
    }
}

fn go(state: &mut State, time: f64, syllable: Option<usize>) {
    let clips = state.open.as_ref().and_then(|o| o.lesson.as_ref().ok()).map(|l| &l.clips);
    if let (Some(clips), Some(editor)) = (clips, &mut state.editor) {
        editor.go(&clips[editor.clip], time);
        editor.syllable = syllable.or(editor.syllable);
        if syllable.is_some() {
            editor.lane = super::Lane::Syllables;
        }
    }
}

/// How a clip's times came to be, in a word or two.
#[must_use]
pub(super) fn origin(clip: &Clip) -> String {
    let (pins, all) = (clip.score.pins.len(), clip.syllables.len());
    let by_hand = if pins > 0 { format!(", {pins} by hand") } else { String::new() };
    match clip.doubts().len() {
        _ if all == 0 => String::new(),
        _ if pins >= all => "set by hand".into(),
        _ if clip.timing.guessed => format!("guessed?{by_hand}"),
        0 if clip.timing.tier("confidence").is_some() => format!("aligned{by_hand}"),
        0 => format!("times given{by_hand}"),
        many => format!("aligned, {many} to look at!{by_hand}"),
    }
}
