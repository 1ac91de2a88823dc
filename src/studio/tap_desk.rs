//! What the keys do while syllables are tapped, and the change that tapping makes of the lesson.

use super::action::Action;
use super::job::Job;
use super::state::{Hear, State};
use super::tapping::{Passed, Tapping};
use crate::project::counted;
use crate::project::{Change, Clip, Edit};

/// How much of the sound is heard before the cursor, so that nobody has to tap at once, in seconds.
const RUN_UP: f64 = 1.0;

/// The shortest a syllable can be, in seconds, as when its edges are moved by hand.
const SHORTEST: f64 = 0.02;

/// A syllable that nothing ends lasts at most so long, in seconds.
const LONGEST_LAST: f64 = 0.6;

/// What syllables that had to give way take each, where there is room, in seconds.
const USUAL: f64 = 0.2;

/// Begins to tap, from the cursor on.
pub(super) fn open(state: &mut State) {
    if let Some(why) = state.lesson().and_then(|l| l.read_only.clone()) {
        state.refuse(format!("the lesson cannot be changed: {why}"));
        return;
    }
    let (Some(editor), Some(clip)) = (&state.editor, state.clip()) else { return };
    let Some(syllable) = editor.syllable else {
        state.refuse("this clip has no syllables to tap: m marks where they are heard");
        return;
    };
    let first = if clip.intervals().first().is_some_and(|i| editor.cursor <= i.start) { 0 } else { syllable };
    let from = (editor.cursor - RUN_UP).max(0.0);
    let home = editor.cursor;
    if let Some(editor) = &mut state.editor {
        editor.tapping = Some(Tapping::new(home, from, first));
        editor.mark = None;
    }
    show(state);
}

/// Carries out what is asked for while tapping.
pub(super) fn execute(state: &mut State, action: Action) -> Option<Job> {
    let latency = state.latency.unwrap_or(0.0);
    let count = state.clip().map_or(0, |c| c.syllables.len());
    let tapping = state.editor.as_mut()?.tapping.as_mut()?;
    match action {
        Action::TapStart => {
            let was_ready = tapping.is_ready();
            tapping.press(false, latency, count);
            if was_ready {
                state.hear = Some(Hear::Soon { from: tapping.from, speed: tapping.speed });
            }
        }
        Action::TapEnd => tapping.press(true, latency, count),
        Action::TapBack if tapping.back() => {
            state.hear = Some(Hear::Clip { from: tapping.at, speed: tapping.speed });
        }
        Action::TapSpeed | Action::TapNext(_) if !tapping.is_ready() => {
            state.say("that can be chosen before it begins: q keeps what was tapped, t goes on from there");
        }
        Action::TapSpeed => {
            tapping.speed = if tapping.speed < 1.0 { 1.0 } else { 0.5 };
            // Slowing down takes its time: it begins before the count does.
            state.hear = Some(Hear::Soon { from: tapping.from, speed: tapping.speed });
        }
        Action::TapNext(by) => {
            let last = count.saturating_sub(1) as i32;
            tapping.next = (tapping.next as i32 + by).clamp(0, last) as usize;
        }
        Action::TapMeasure if tapping.is_ready() => {
            tapping.measure();
            state.hear = Some(Hear::Clicks(Tapping::flashes()));
        }
        Action::TapMeasure => state.say("measure before it begins"),
        Action::TapKeep => {
            keep(state);
        }
        Action::TapDrop => {
            let many = tapping.taps.iter().filter(|t| !t.is_end).count();
            tapping.at = tapping.home;
            show(state);
            close(state);
            state.say(if many == 0 { "nothing was tapped".into() } else { format!("{many} taps dropped") });
        }
        _ => {}
    }
    show(state);
    None
}

/// Lets so many seconds pass; whether there is something new to show.
pub(super) fn advance(state: &mut State, seconds: f64) -> bool {
    let Some((editor, duration)) = state.editor.as_mut().map(|e| {
        let duration = e.timeline.duration();
        (e, duration)
    }) else {
        return false;
    };
    let Some(tapping) = &mut editor.tapping else { return false };
    let frame = (tapping.at * editor.timeline.fps() + 1e-6).floor();
    let passed = tapping.advance(seconds, duration);
    let new = (tapping.at * editor.timeline.fps() + 1e-6).floor() != frame;
    match passed {
        Passed::Begun => state.hear = Some(Hear::Clip { from: tapping.at, speed: tapping.speed }),
        Passed::Measured => {
            let measured = tapping.end_measuring();
            match measured {
                Some(late) => {
                    state.latency = Some(late);
                    let side = if late < 0.0 { "before" } else { "after" };
                    state.say(format!(
                        "your taps come {:.0} ms {side} the flash: taken off from now on",
                        late.abs() * 1e3
                    ));
                }
                None => state.say("too few taps to tell: c measures again"),
            }
        }
        Passed::Seen if !new && state.editor.as_ref().is_some_and(|e| e.tapping.as_ref().is_some_and(is_running)) => {
            return false;
        }
        Passed::Seen => {}
        Passed::Nothing => return false,
    }
    show(state);
    true
}

fn is_running(tapping: &Tapping) -> bool {
    tapping.phase == super::tapping::Phase::Running
}

/// Puts the cursor where the sound is, and selects the syllable that comes next.
fn show(state: &mut State) {
    let clips = state.open.as_ref().and_then(|o| o.lesson.as_ref().ok()).map(|l| &l.clips);
    let (Some(clips), Some(editor)) = (clips, &mut state.editor) else { return };
    let Some((at, next)) = editor.tapping.as_ref().map(|t| (t.at, t.next)) else { return };
    let clip = &clips[editor.clip];
    let fps = editor.timeline.fps();
    editor.go(clip, (at * fps + 1e-6).floor() / fps);
    editor.syllable = Some(next.min(clip.syllables.len().saturating_sub(1)));
}

fn close(state: &mut State) {
    state.hear = Some(Hear::Nothing);
    if let Some(editor) = &mut state.editor {
        editor.tapping = None;
    }
}

/// Keeps what was tapped, as one change, and offers to find the rest; false where that cannot be, and the taps stay.
fn keep(state: &mut State) -> bool {
    let (Some(editor), Some(clip)) = (&state.editor, state.clip()) else { return true };
    let Some(tapping) = &editor.tapping else { return true };
    let spoken = spoken(tapping, clip);
    if spoken.is_empty() {
        close(state);
        state.say("nothing was tapped");
        return true;
    }
    let (first, count) = (spoken[0].0, spoken.len());
    match change_of(editor.clip, clip, &spoken) {
        Ok(change) => {
            if !super::edits::change(state, change) {
                return false;
            }
            close(state);
            select(state, first);
            let rest = state.clip().map_or(0, |c| c.syllables.len() - c.score.pins.len());
            let offer = match rest {
                0 => "all are set by hand now".into(),
                many => format!("A finds the other {many} between them"),
            };
            state.say(format!("tapped {}; {offer}", counted(count, "syllable")));
            true
        }
        Err(why) => {
            state.refuse(why);
            false
        }
    }
}

fn select(state: &mut State, syllable: usize) {
    let clips = state.open.as_ref().and_then(|o| o.lesson.as_ref().ok()).map(|l| &l.clips);
    if let (Some(clips), Some(editor)) = (clips, &mut state.editor) {
        let clip = &clips[editor.clip];
        let start = clip.intervals().get(syllable).map_or(editor.cursor, |i| i.start);
        editor.go(clip, start);
        editor.syllable = Some(syllable);
    }
}

/// Leaves tapping where the studio or the clip is left: what was tapped is kept. False where it cannot be: it would be
/// lost, so it stays on the desk.
pub(super) fn leave(state: &mut State) -> bool {
    pause(state);
    keep(state)
}

/// The tapped syllables with their starts and ends, by their numbers.
fn spoken(tapping: &Tapping, clip: &Clip) -> Vec<(usize, f64, f64)> {
    let duration = clip.duration();
    // What is rounded up must not lie beyond the sound.
    let round = |t: f64| ((t * 1e4).round() / 1e4).min(duration);
    let mut spoken: Vec<(usize, f64, Option<f64>)> = Vec::new();
    for tap in &tapping.taps {
        match (tap.is_end, spoken.last_mut()) {
            (true, Some(last)) => last.2 = Some(round(tap.at)),
            (true, None) => {}
            (false, last) => {
                if let Some(last) = last {
                    last.2 = last.2.or(Some(round(tap.at)));
                }
                spoken.push((tap.syllable, round(tap.at), None));
            }
        }
    }
    let sounding = clip.sound.as_ref().map(|s| s.sounding()).unwrap_or_default();
    let ended = |(syllable, start, end): (usize, f64, Option<f64>)| {
        // What nothing ends goes on as long as there is sound.
        let until = sounding.iter().find(|(from, to)| *from < start + 0.1 && start + SHORTEST < *to).map(|(_, to)| *to);
        let last = until.unwrap_or(start + USUAL).min(start + LONGEST_LAST).min(duration);
        (syllable, start, end.unwrap_or(round(last)))
    };
    let mut spoken: Vec<(usize, f64, f64)> = spoken.into_iter().map(ended).collect();
    spoken.retain(|(_, start, end)| end - start >= SHORTEST - 1e-9);
    spoken
}

/// The change that gives the tapped syllables their times and vouches for them. The others stay where they are, as far
/// as there is room, and give way where there is not.
///
/// # Errors
/// In one line, where those that were not tapped have no room left.
fn change_of(number: usize, clip: &Clip, spoken: &[(usize, f64, f64)]) -> Result<Change, String> {
    let before: Vec<(f64, f64)> = clip.intervals().iter().map(|i| (i.start, i.end)).collect();
    let mut after = before.clone();
    let mut tapped = vec![false; after.len()];
    for (syllable, start, end) in spoken {
        if let Some(times) = after.get_mut(*syllable) {
            *times = (*start, *end);
            tapped[*syllable] = true;
        }
    }
    let is_tapped = |i: usize| tapped[i];
    let mut at = 0;
    while at < after.len() {
        if is_tapped(at) {
            at += 1;
            continue;
        }
        let end = (at..after.len()).find(|i| is_tapped(*i)).unwrap_or(after.len());
        let low = at.checked_sub(1).map_or(0.0, |i| after[i].1);
        let high = after.get(end).map_or(clip.duration(), |t| t.0);
        give_way(&mut after[at..end], low, high).map_err(|()| {
            let name = clip.syllables.get(at).map_or("", |s| s.text.as_str());
            let many = counted(end - at, "syllable");
            format!("no room is left for {many} from {name} on, not tapped: Backspace goes back, x drops the taps")
        })?;
        at = end;
    }
    let moved = |i: &usize| before[*i] != after[*i];
    let first = (0..after.len()).find(moved).unwrap_or(0);
    let last = (0..after.len()).rev().find(moved).map_or(first, |l| l + 1);
    let mut edits = Vec::new();
    if last > first {
        let (before, after) = (before[first..last].to_vec(), after[first..last].to_vec());
        edits.push(Edit::Times { clip: number, first, before, after });
    }
    for index in 0..after.len() {
        let was = clip.score.pins.binary_search(&index).is_ok();
        // Nobody vouches for what had to give way.
        let is = is_tapped(index) || was && !moved(&index);
        if was != is {
            edits.push(Edit::Pin { clip: number, index, pinned: is });
        }
    }
    Ok(Change { label: format!("{} tapped", counted(spoken.len(), "syllable")), edits })
}

/// Moves and shrinks neighbouring syllables so that they lie between two times, no more than is needed.
fn give_way(times: &mut [(f64, f64)], low: f64, high: f64) -> Result<(), ()> {
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return Ok(()) };
    let (from, to) = (first.0, last.1);
    if from >= low - 1e-9 && to <= high + 1e-9 {
        return Ok(());
    }
    let least = SHORTEST * times.len() as f64;
    if high - low < least {
        return Err(());
    }
    let wanted = (USUAL * times.len() as f64).min(high - low).min(to - from).max(least);
    let (mut new_from, mut new_to) = (from.max(low), to.min(high));
    if new_to - new_from < wanted {
        // They keep to the side where they were.
        if from < low {
            (new_from, new_to) = (low, (low + wanted).min(high));
        } else {
            (new_from, new_to) = ((high - wanted).max(low), high);
        }
    }
    // Syllables that take no time at all cannot be drawn out.
    let scale = if to - from > 1e-9 { (new_to - new_from) / (to - from) } else { 0.0 };
    let least_scaled = times.iter().map(|t| (t.1 - t.0) * scale).fold(f64::INFINITY, f64::min);
    let count = times.len() as f64;
    for (index, time) in times.iter_mut().enumerate() {
        *time = if least_scaled < SHORTEST {
            // Shares alike, where some would get too short to be seen.
            let share = |n: usize| new_from + (new_to - new_from) * n as f64 / count;
            (share(index), share(index + 1))
        } else {
            (new_from + (time.0 - from) * scale, new_from + (time.1 - from) * scale)
        };
    }
    Ok(())
}

/// Stops the sound and the clock, where something is put on top of them.
pub(super) fn pause(state: &mut State) {
    if let Some(tapping) = state.editor.as_mut().and_then(|e| e.tapping.as_mut()) {
        tapping.stop();
        state.hear = Some(Hear::Nothing);
    }
}

/// What tapping asks of the author now, line by line.
pub(super) fn lines(state: &State, tapping: &Tapping, clip: &Clip) -> Vec<String> {
    use super::tapping::Phase;
    let name = |i: usize| clip.syllables.get(i).map(|s| format!("{} {}", s.text, s.pinyin).trim_end().to_owned());
    let speed = if tapping.speed < 1.0 { "half speed" } else { "full speed" };
    let source = match state.can_hear {
        true => "the clip is played here; if you hear nothing, play it yourself when the count ends".to_owned(),
        false => format!(
            "no sound from here: play the recording yourself{}, from {:.2} s, when the count ends",
            if tapping.speed < 1.0 { " at half speed" } else { "" },
            tapping.from
        ),
    };
    let late = match state.latency {
        Some(late) => format!("{:.0} ms are taken off each tap", late * 1e3),
        None => "how late your taps come is not known: c measures it".to_owned(),
    };
    let many = tapping.taps.iter().filter(|t| !t.is_end).count();
    let done = format!("{} of {} tapped", many, clip.syllables.len());
    let next = name(tapping.next).map_or("all are tapped: q keeps them".to_owned(), |n| format!("next: {n}"));
    match &tapping.phase {
        Phase::Ready => vec![
            format!("Tapping, {speed}, from {:.2} s", tapping.from),
            next,
            source,
            "Enter begins, after a count of three".into(),
            late,
        ],
        Phase::Counting(_) => vec![tapping.count().map_or(String::new(), |c| format!("   {c}")), next, source],
        Phase::Running => vec![next, done, "Enter: it starts now   Space: a pause starts now".into()],
        Phase::Over => vec![done, "stopped: q keeps them, Backspace goes a second back and on".into()],
        Phase::Measuring { .. } => {
            let light = if tapping.flash().is_some() { "   ████████" } else { "" };
            let many = tapping.measured();
            vec!["Enter with every flash".into(), light.into(), light.into(), format!("{many} taps")]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_tapped_gives_way_no_more_than_it_must() {
        let times = [(1.0, 1.2), (1.2, 1.6)];
        let given = |low, high| {
            let mut times = times;
            give_way(&mut times, low, high).map(|()| times.map(|(a, b)| ((a * 1e4).round(), (b * 1e4).round())))
        };
        assert_eq!(given(0.5, 2.0), Ok([(10000.0, 12000.0), (12000.0, 16000.0)]));
        assert_eq!(given(1.1, 2.0), Ok([(11000.0, 12667.0), (12667.0, 16000.0)]));
        assert_eq!(given(3.0, 9.0), Ok([(30000.0, 31333.0), (31333.0, 34000.0)]));
        assert_eq!(given(0.0, 0.5), Ok([(1000.0, 2333.0), (2333.0, 5000.0)]));
        assert_eq!(given(1.0, 1.05), Ok([(10000.0, 10250.0), (10250.0, 10500.0)]));
        assert_eq!(given(1.0, 1.03), Err(()));
        let mut none = [(1.0, 1.0), (1.0, 1.0)];
        assert_eq!(give_way(&mut none, 2.0, 3.0), Ok(()));
        assert_eq!(
            none.map(|(a, b)| ((a * 1e4_f64).round(), (b * 1e4_f64).round())),
            [(20000.0, 20200.0), (20200.0, 20400.0)]
        );
    }
}
