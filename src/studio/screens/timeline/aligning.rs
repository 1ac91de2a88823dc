//! Times found in the sound, one search at a time in a thread; the result is one change of the project.

use std::path::PathBuf;

use crate::disk::Result;
use crate::project::{AlignJob, Clip, counted};
use crate::speech::Alignment;
use crate::studio::app::aligner::{Aligner, Aligning, Standing};
use crate::studio::app::project::OpenProject;
use crate::studio::app::shell::Shell;
use crate::studio::app::stack::{Context, Job, Reporter, Stack};
use crate::studio::app::wording;

/// Finds the times of a clip that was opened and whose times nobody has found yet, once.
pub(super) fn start_by_itself(project: &mut OpenProject, clip: usize, cx: &mut Context<'_>) {
    let wanted = project.lesson.read_only.is_none() && project.lesson.clips[clip].wants_alignment();
    if wanted && project.aligned.insert(clip) {
        start(project, clip, false, cx);
    }
}

/// Finds the times of a clip, after the search that is under way. `asked` tells whether the author asked for it.
pub(in crate::studio) fn start(project: &mut OpenProject, clip: usize, asked: bool, cx: &mut Context<'_>) {
    if asked && !project.may_change(cx.shell) || project.lesson.read_only.is_some() {
        return;
    }
    let root = project.lesson.root.clone();
    if let Some(now) = &mut cx.shell.aligning {
        now.next = Some((root, clip, asked));
        cx.shell.say(format!("{} is aligned next", project.lesson.clips[clip].entry.name));
        return;
    }
    match AlignJob::of(&project.lesson, &[clip]) {
        Ok(job) => {
            project.aligned.insert(clip);
            let of = Standing::of(&project.lesson.clips[clip]);
            cx.shell.aligning = Some(Aligning { root: root.clone(), of, asked, next: None });
            let aligner = cx.shell.aligner.clone();
            cx.start(SearchJob { root, clip, job: Box::new(job), aligner });
        }
        Err(fault) if asked => cx.shell.say_fault(&fault),
        Err(_) => {}
    }
}

/// Finds a clip's times in its sound.
struct SearchJob {
    root: PathBuf,
    clip: usize,
    job: Box<AlignJob>,
    aligner: Aligner,
}

impl Job for SearchJob {
    type Made = Vec<(usize, Result<Alignment>)>;
    const BROKEN: [&'static str; 2] = ["the search for the times broke off", "please report what `lianpu align` says"];

    fn run(&mut self, _: &Reporter) -> Result<Self::Made> {
        Ok(self.aligner.run(&self.job))
    }

    fn done(self, made: Result<Self::Made>, stack: &mut Stack) {
        let Some(Aligning { of, asked, next, .. }) = stack.shell.aligning.take_if(|now| now.root == self.root) else {
            return;
        };
        let is_on_desk = stack.editor(&self.root, self.clip).is_some();
        // The author may have gone to another project in the meantime.
        if let Some(project) = stack.project(&self.root) {
            let (project, shell) = (&mut *project.borrow_mut(), &mut stack.shell);
            let found = made.unwrap_or_else(|fault| vec![(self.clip, Err(fault))]);
            for (number, alignment) in found.into_iter().filter(|(n, _)| *n == self.clip) {
                match alignment {
                    Ok(alignment) => {
                        take(project, number, &Search { of: &of, asked, is_on_desk }, &alignment, shell);
                    }
                    Err(fault) => shell.say_fault(&fault),
                }
            }
        }
        if let Some((root, clip, asked)) = next
            && let Some(project) = stack.project(&root)
        {
            start(&mut project.borrow_mut(), clip, asked, &mut stack.context());
        }
    }
}

/// What a search was begun with.
struct Search<'a> {
    of: &'a Standing,
    asked: bool,
    /// Whether the clip is the one that is edited.
    is_on_desk: bool,
}

/// Takes what a search has found, where the clip is as it was.
fn take(project: &mut OpenProject, number: usize, search: &Search<'_>, alignment: &Alignment, shell: &mut Shell) {
    let clip = &project.lesson.clips[number];
    let name = clip.entry.name.clone();
    if Standing::of(clip) != *search.of {
        shell.refuse(format!("{name} was changed while its times were looked for, and stays as it is: A looks again"));
        return;
    }
    let change = project.lesson.aligned(number, alignment);
    let is_new = change.is_some();
    if change.is_some_and(|change| !project.change(change, shell)) {
        return;
    }
    let clip = &project.lesson.clips[number];
    // The others have a place, and are among the doubts.
    let whole = clip.alignment_notes(alignment).into_iter().filter(|(at, _)| at.is_none());
    let notes: Vec<String> = whole.map(|(_, note)| wording::worded(&note)).collect();
    let worst = notes.last().cloned();
    let doubts = clip.doubts().len();
    project.notes.insert(number, notes);
    let what = format!("aligned {}", counted(alignment.syllables.len(), "syllable"));
    let name = if search.is_on_desk { "" } else { &format!("{name}: ") };
    let which = match (is_new, search.asked) {
        (false, _) => format!("{name}the times are as they were found"),
        (true, true) => format!("{name}{what}"),
        (true, false) => format!("{name}{what} by their sound (u takes it back)"),
    };
    let rest = match doubts {
        0 => "no doubts".to_owned(),
        many => format!("{many} to look at: d goes there, o lists them"),
    };
    match worst {
        Some(note) => shell.refuse(format!("{which}; {rest}; {note}")),
        None => shell.say(format!("{which}; {rest}")),
    }
}

/// How a clip's times came to be, in a word or two.
#[must_use]
pub(in crate::studio) fn origin(clip: &Clip) -> String {
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
