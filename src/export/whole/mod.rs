//! The forms that hold a clip or a lesson whole, as one file or a few: which files there will be, and writing each of them
//! whole or not at all. What is there and still right is kept.

mod moving;

use std::path::PathBuf;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::manifest::within;
use super::plan::{checked_output, chosen_clips, out_folder, plan, root_folder};
use super::run::elsewhere;
use super::{Entry, Format, Ledger, Progress, Report, Request};
use crate::disk::{Message, Result, read_old, write_whole};
use crate::forms::parts::{self, Parts};
use crate::forms::sound::Encoded;
use crate::forms::{File, Watch, epub, html, layers, lottie, mouths, ratios, said, shapes, smil, sound, with_ending};
use crate::media::Ffmpeg;
use crate::project::{Clip, Lesson, Output};
use crate::script::System;
use crate::timing::MOHO_FPS;

/// What a file is called that all clips are in.
pub(super) const TOGETHER: &str = "lesson";

/// Files that hold a clip or a lesson in one form, to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Whole {
    /// The form.
    pub format: Format,
    /// The clip; none where the lesson's clips are in it together.
    pub clip: Option<String>,
    /// The path without what the form adds to it, such as `OUT/CLIP`.
    base: PathBuf,
    /// The clips that are in it, by number.
    clips: Vec<usize>,
}

/// What became of a [`Whole`].
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Written {
    /// Its files.
    pub paths: Vec<PathBuf>,
    /// What the author should know, a line each.
    pub notes: Vec<Message>,
    /// How many files were written and kept, and how many bytes.
    pub report: Report,
}

impl Report {
    /// The same with whole files counted in.
    #[must_use]
    pub(crate) fn with(mut self, made: &[Written]) -> Self {
        for written in made {
            self.written += written.report.written;
            self.kept += written.report.kept;
            self.bytes += written.report.bytes;
        }
        self
    }
}

/// The whole files of an export, clip by clip and then the lesson's. Nothing is written yet.
///
/// Where the work is shared they belong to the part that has the clip's first frame, and those of all clips together to
/// the part that has the first clip's. `--frames` has a say in moving pictures alone.
///
/// # Errors
/// When the clip that is asked for is not there, or size or frame rate cannot be used.
pub fn wholes(lesson: &Lesson, request: &Request) -> Result<Vec<Whole>> {
    checked_output(lesson, request)?;
    let clips = chosen_clips(lesson, request)?;
    let out = out_folder(lesson, request);
    let is_ours = |place: usize| request.share_of(place).is_none_or(|share| share.whole_files);
    let wanted = |format: &&Format| !format.is_frames() && !format.is_text();
    let formats: Vec<Format> = request.formats.iter().filter(wanted).copied().collect();
    let mut all = Vec::new();
    for (_, number) in clips.iter().enumerate().filter(|(place, _)| is_ours(*place)) {
        let name = &lesson.clips[*number].entry.name;
        // A clip that is asked for by name has a page and a book of its own.
        let own = |format: &&Format| !format.is_of_the_lesson() || request.clip.is_some();
        all.extend(formats.iter().filter(own).map(|format| Whole {
            format: *format,
            clip: Some(name.clone()),
            base: out.join(name),
            clips: vec![*number],
        }));
    }
    if request.clip.is_none() && is_ours(0) {
        let together = formats.iter().filter(|f| f.is_of_the_lesson());
        all.extend(together.map(|format| Whole {
            format: *format,
            clip: None,
            base: out.join(TOGETHER),
            clips: clips.clone(),
        }));
    }
    Ok(all)
}

impl Whole {
    /// The files that it becomes.
    pub(super) fn paths(&self, lesson: &Lesson) -> Vec<PathBuf> {
        let with = |endings: &[&str]| endings.iter().map(|ending| with_ending(&self.base, ending)).collect();
        match self.format {
            Format::Smil => with(&["svg"]),
            Format::Lottie => with(&["json"]),
            Format::Layers => with(&["layers.svg"]),
            Format::Ratios => with(&["ratios.csv", "ratios.json"]),
            Format::Rhubarb => shapes::RHUBARB.iter().map(|f| shapes::rhubarb_path(&self.base, *f)).collect(),
            Format::Moho => with(&[crate::timing::Format::Moho.extension()]),
            Format::Mouths => mouths::paths(&self.base),
            Format::Wav => match self.clips.first().and_then(|clip| lesson.clips[*clip].sound.as_ref()) {
                Some(_) => with(&["wav"]),
                None => Vec::new(),
            },
            Format::Html | Format::Epub | Format::Lpr | Format::Mp4 | Format::Webm | Format::Gif | Format::Apng => {
                with(&[self.format.name()])
            }
            Format::Svg | Format::Png | Format::TextGrid | Format::Srt | Format::Vtt | Format::Poses => Vec::new(),
        }
    }
}

/// Writes whole files one after the other. `tell` hears before each of them, and of moving pictures frame by frame. `stop`
/// ends it between two files or frames; what is missing then was not written.
///
/// # Errors
/// When a figure cannot be used or a file cannot be written. Every file that is there is whole.
pub fn write_wholes(
    lesson: &Lesson,
    request: &Request,
    wholes: &[Whole],
    ledger: &mut Ledger,
    tell: &dyn Fn(&Whole, Progress),
    stop: &AtomicBool,
) -> Result<Vec<Written>> {
    let root = root_folder(lesson, request);
    let mut workshop = Workshop::new(lesson, request)?;
    let mut done = Vec::new();
    for whole in wholes {
        if stop.load(Ordering::Relaxed) {
            break;
        }
        tell(whole, Progress { done: 0, of: 1 });
        if whole.format.is_moving() {
            match workshop.film(whole, ledger, tell, stop)? {
                Some(written) => done.push(written),
                None => break,
            }
            continue;
        }
        let mut written = Written::default();
        for file in workshop.make(whole, &mut written.notes)? {
            if read_old(&file.path).is_some_and(|old| old == file.bytes) {
                written.report.kept += 1;
            } else {
                ledger.set_aside(&file.path, Some(&file.bytes))?;
                write_whole(&file.path, &file.bytes).map_err(elsewhere)?;
                written.report.written += 1;
                written.report.bytes += file.bytes.len() as u64;
            }
            ledger.add([Entry::of(within(&root, &file.path), &file.bytes)]);
            written.paths.push(file.path);
        }
        tell(whole, Progress { done: 1, of: 1 });
        done.push(written);
    }
    Ok(done)
}

/// What several forms of one clip have in common, made once.
struct Workshop<'a> {
    lesson: &'a Lesson,
    request: &'a Request,
    output: Output,
    encoder: Option<Ffmpeg>,
    parts: Option<(usize, Rc<Parts>)>,
    /// The sounds by clip, each with the note on how it is encoded.
    sounds: Vec<(usize, Rc<Encoded>, Option<Message>)>,
}

impl<'a> Workshop<'a> {
    fn new(lesson: &'a Lesson, request: &'a Request) -> Result<Self> {
        let output = checked_output(lesson, request)?;
        Ok(Self { lesson, request, output, encoder: Ffmpeg::on_path(), parts: None, sounds: Vec::new() })
    }

    fn make(&mut self, whole: &Whole, notes: &mut Vec<Message>) -> Result<Vec<File>> {
        let Some(first) = whole.clips.first().copied() else { return Ok(Vec::new()) };
        let lesson = self.lesson;
        let clip = &lesson.clips[first];
        let base = whole.base.as_path();
        let one = |ending: &str, bytes: Vec<u8>| vec![File { path: with_ending(base, ending), bytes }];
        let files = match whole.format {
            Format::Smil => {
                let sound = self.sound(first, notes);
                let parts = self.parts(first)?;
                let title = self.title(clip);
                let words = smil::Words { title: &title, description: &self.description(clip) };
                let text = if self.request.thesis {
                    smil::of_the_thesis(&parts, &words, sound.as_deref())
                } else {
                    smil::animated(&parts, &words, sound.as_deref())
                };
                one("svg", text.into_bytes())
            }
            Format::Html => one("html", self.page(&whole.clips, notes)?.into_bytes()),
            Format::Epub => one("epub", self.book(&whole.clips, notes)?),
            Format::Wav => match &clip.sound {
                Some(sound) => one("wav", sound::wav(sound)?),
                None => {
                    notes.push(format!("the clip {} has no sound", clip.entry.name).into());
                    Vec::new()
                }
            },
            Format::Rhubarb => shapes::rhubarb(&self.shapes(first, notes), base),
            Format::Moho => shapes::moho(self.shapes(first, notes), self.request.fps.unwrap_or(MOHO_FPS), base),
            Format::Ratios => ratios::tables(clip, &lesson.timeline(first, Some(self.output.fps)), base),
            Format::Lpr => ratios::compact(clip, &lesson.timeline(first, Some(self.output.fps)), base)?,
            Format::Lottie => {
                let parts = self.parts(first)?;
                one("json", lottie::lottie(&parts, &self.title(clip)).into_bytes())
            }
            Format::Mouths => {
                let figure = self.request.figure_of(lesson, &clip.entry)?;
                let preset = lesson.mouths_of(&clip.entry);
                mouths::mouths(&figure, preset, self.output.size, self.request.background, base)?
            }
            Format::Layers => {
                let figure = self.request.figure_of(lesson, &clip.entry)?;
                let (preset, ground) = (lesson.mouths_of(&clip.entry), self.request.background);
                let text = layers::layered(&figure, preset, self.output.size, ground, &self.title(clip));
                one("layers.svg", text.into_bytes())
            }
            // Moving pictures are written as they are painted, frames and times by the jobs.
            Format::Mp4 | Format::Webm | Format::Gif | Format::Apng => Vec::new(),
            Format::Svg | Format::Png | Format::TextGrid | Format::Srt | Format::Vtt | Format::Poses => Vec::new(),
        };
        Ok(files)
    }

    /// Writes a moving picture as it is painted; none where it was stopped. All frames that were asked for are in it,
    /// whatever share of them this part has.
    fn film(
        &self,
        whole: &Whole,
        ledger: &mut Ledger,
        tell: &dyn Fn(&Whole, Progress),
        stop: &AtomicBool,
    ) -> Result<Option<Written>> {
        let alone =
            Request { formats: vec![Format::Png], clip: whole.clip.clone(), shares: None, ..self.request.clone() };
        let jobs = plan(self.lesson, &alone)?;
        let (Some(job), Some(number)) = (jobs.first(), whole.clips.first()) else { return Ok(None) };
        let of = u32::try_from(job.frames.len()).unwrap_or(u32::MAX);
        let progress = |done| tell(whole, Progress { done, of });
        let path = with_ending(&whole.base, whole.format.name());
        let film = moving::Moving { job, clip: &self.lesson.clips[*number], format: whole.format };
        film.write(&path, ledger, &Watch { progress: &progress, stop })
    }

    /// The page of some clips.
    fn page(&mut self, clips: &[usize], notes: &mut Vec<Message>) -> Result<String> {
        let lesson = self.lesson;
        let mut page = html::Page::default();
        for number in clips {
            let clip = &lesson.clips[*number];
            let sound = self.sound(*number, notes);
            let parts = self.parts(*number)?;
            page.add(&html::Shown {
                name: &clip.entry.name,
                title: &lesson.manifest.title,
                description: self.description(clip),
                duration: clip.duration(),
                parts: &parts,
                sound: sound.as_deref(),
                phrases: said::phrases(clip),
                zhuyin: clip.entry.script_system == Some(System::Zhuyin),
            });
        }
        Ok(page.done(&lesson.manifest.title))
    }

    /// The book of some clips.
    fn book(&mut self, clips: &[usize], notes: &mut Vec<Message>) -> Result<Vec<u8>> {
        let lesson = self.lesson;
        let mut chapters = Vec::new();
        for number in clips {
            let clip = &lesson.clips[*number];
            let sound = self.sound_of_a_book(*number, notes);
            let parts = self.parts(*number)?;
            let (title, description) = (self.title(clip), self.description(clip));
            let words = smil::Words { title: &title, description: &description };
            let mut first =
                self.request.figure_of(lesson, &clip.entry)?.draw(&lesson.timeline(*number, None).pose(0.0));
            first.background = self.request.background.unwrap_or(first.background);
            chapters.push(epub::Chapter {
                svg: smil::animated(&parts, &words, None),
                poster: epub::poster(&first, self.output.size)?,
                title: if lesson.clips.len() > 1 { clip.entry.name.clone() } else { title },
                description,
                duration: clip.duration(),
                sound,
                phrases: said::phrases(clip),
                zhuyin: clip.entry.script_system == Some(System::Zhuyin),
                fps: parts.fps,
                size: self.output.size,
            });
        }
        let figure = match clips.first() {
            Some(first) => self.request.figure_of(lesson, &lesson.clips[*first].entry)?,
            None => return Ok(Vec::new()),
        };
        epub::book(&lesson.manifest.title, &figure, &chapters)
    }

    /// A sound that readers of books must know: MP3 or AAC. Where no encoder is there, the recording itself may be such.
    fn sound_of_a_book(&mut self, clip: usize, notes: &mut Vec<Message>) -> Option<Encoded> {
        let (sound, _) = self.encoded(clip)?;
        if sound.is_for_books() {
            return Some((*sound).clone());
        }
        let own = self.lesson.clips[clip].sound_path.as_deref().and_then(sound::own);
        if own.is_none() {
            notes.push("there is no `ffmpeg`, and books take no FLAC: the book has no sound".into());
        }
        own
    }

    /// The clip's figure in parts.
    fn parts(&mut self, clip: usize) -> Result<Rc<Parts>> {
        if let Some((_, parts)) = self.parts.as_ref().filter(|(number, _)| *number == clip) {
            return Ok(Rc::clone(parts));
        }
        let figure = self.request.figure_of(self.lesson, &self.lesson.clips[clip].entry)?;
        let timeline = self.lesson.timeline(clip, Some(self.output.fps));
        let parts = Rc::new(parts::parts(&figure, &timeline, self.output.size, self.request.background));
        self.parts = Some((clip, Rc::clone(&parts)));
        Ok(parts)
    }

    /// The clip's sound as small as it gets here; none where it has none.
    fn sound(&mut self, clip: usize, notes: &mut Vec<Message>) -> Option<Rc<Encoded>> {
        let (sound, note) = self.encoded(clip)?;
        notes.extend(note);
        Some(sound)
    }

    /// The clip's sound, and the note on how it is encoded; made once.
    fn encoded(&mut self, clip: usize) -> Option<(Rc<Encoded>, Option<Message>)> {
        if let Some((_, sound, note)) = self.sounds.iter().find(|(number, ..)| *number == clip) {
            return Some((Rc::clone(sound), note.clone()));
        }
        let sound = self.lesson.clips[clip].sound.as_ref()?;
        let (encoded, note) = sound::encoded(sound, self.encoder.as_ref());
        let (encoded, note) = (Rc::new(encoded), note.map(Message::from));
        self.sounds.push((clip, Rc::clone(&encoded), note.clone()));
        Some((encoded, note))
    }

    fn shapes(&self, clip: usize, notes: &mut Vec<Message>) -> crate::timing::Timing {
        let own = &self.lesson.clips[clip];
        let timing = shapes::shapes(own, self.output.fps, self.lesson.mouths_of(&own.entry));
        if timing.shapes().is_none_or(|t| t.intervals.is_empty()) {
            notes.push(format!("the clip {} says nothing, so its mouth rests all the time", own.entry.name).into());
        }
        timing
    }

    /// What a clip is called: by the lesson, and by its own name where there are several.
    fn title(&self, clip: &Clip) -> String {
        let title = &self.lesson.manifest.title;
        if self.lesson.clips.len() > 1 { format!("{title}: {}", clip.entry.name) } else { title.clone() }
    }

    /// What is said, for those who cannot see or hear it.
    fn description(&self, clip: &Clip) -> String {
        let mut said = String::new();
        for phrase in said::phrases(clip) {
            // Chinese has no blanks between its words.
            if said.ends_with(|c: char| c.is_ascii()) {
                said.push(' ');
            }
            said.push_str(&phrase.text());
        }
        if said.is_empty() { "A face moves.".to_owned() } else { format!("A face says: {said}") }
    }
}
