//! The studio without a terminal: keys go in as text, states and screens come out.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use lianpu::disk::Fault;
use lianpu::project::Lesson;
use lianpu::studio::{Colours, ExportRequest, Exporter, Player, Progress, Show, State, Studio};
use lianpu::timeline::{KeyValue, Track};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use unicode_width::UnicodeWidthStr;

/// A lesson of two syllables, 1.6 s long. `times` are those of its syllables; without them they are guessed.
fn lesson(root: &Path, times: Option<[(f64, f64); 2]>, more: &[(&str, &str)]) {
    let clip = root.join("clips/nihao");
    std::fs::create_dir_all(&clip).unwrap();
    let manifest = "format = 1\ntitle = \"您好\"\n\n[[clip]]\nname = \"nihao\"\nscript_system = \"han\"\n";
    std::fs::write(root.join("lianpu.toml"), manifest).unwrap();
    std::fs::write(clip.join("script.txt"), "您好。\n").unwrap();
    let spec =
        hound::WavSpec { channels: 1, sample_rate: 8000, bits_per_sample: 16, sample_format: hound::SampleFormat::Int };
    let mut wav = hound::WavWriter::create(clip.join("speech.wav"), spec).unwrap();
    for i in 0..12_800 {
        let t = f64::from(i) / 8000.0;
        let loud = if (0.3..0.75).contains(&t) {
            0.3
        } else if (0.77..1.28).contains(&t) {
            0.6
        } else {
            0.0
        };
        wav.write_sample((loud * (t * 200.0 * std::f64::consts::TAU).sin() * 32_000.0) as i16).unwrap();
    }
    wav.finalize().unwrap();
    if let Some([a, b]) = times {
        let grid = format!(
            "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0\nxmax = 1.6\ntiers? <exists>\nsize = 1\n\
             item []:\n    item [1]:\n        class = \"IntervalTier\"\n        name = \"syllables\"\n        xmin = 0\n        xmax = 1.6\n        \
             intervals: size = 2\n        intervals [1]:\n            xmin = {}\n            xmax = {}\n            text = \"nin2\"\n        \
             intervals [2]:\n            xmin = {}\n            xmax = {}\n            text = \"hao3\"\n",
            a.0, a.1, b.0, b.1
        );
        std::fs::write(clip.join("timing.TextGrid"), grid).unwrap();
    }
    for (name, text) in more {
        std::fs::write(clip.join(name), text).unwrap();
    }
}

const TIMES: [(f64, f64); 2] = [(0.3, 0.75), (0.77, 1.28)];
const TOUCHING: [(f64, f64); 2] = [(0.3, 0.75), (0.75, 1.28)];

const SCORE: (&str, &str) = (
    "score.toml",
    "seed = 5\n\n[[key]]\ntrack = \"emotion\"\ntime = 0.0\nvalue = { neutral = 1.0 }\n\n[[key]]\ntrack = \"emotion\"\n\
     time = 0.6\nvalue = { surprised = 0.35 }\n\n[[key]]\ntrack = \"emotion\"\ntime = 1.12\nvalue = { surprised = 0.9 }\n\n\
     [[key]]\ntrack = \"blink\"\ntime = 0.28\nvalue = 0.22\n",
);

/// A studio that is being used.
struct Bench {
    studio: Studio,
    dir: tempfile::TempDir,
}

impl Bench {
    /// The timeline of the only clip of a lesson.
    fn new(times: Option<[(f64, f64); 2]>, more: &[(&str, &str)]) -> Self {
        Self::with(times, more, Box::new(|_, _, _| Ok("exported".into())))
    }

    fn with(times: Option<[(f64, f64); 2]>, more: &[(&str, &str)], exporter: Exporter) -> Self {
        let dir = tempfile::tempdir().unwrap();
        lesson(&dir.path().join("nihao"), times, more);
        let mut bench = Self { studio: Studio::new(State::new(dir.path(), Colours::None).unwrap(), exporter), dir };
        bench.keys("Enter Enter");
        bench
    }

    /// Presses keys, as the table calls them, with spaces between; `'…'` is typed letter by letter.
    fn keys(&mut self, keys: &str) -> &mut Self {
        for (index, part) in keys.split('\'').enumerate() {
            let names: Vec<String> = match index % 2 {
                0 => part.split_whitespace().map(str::to_owned).collect(),
                _ => part.chars().map(|c| if c == ' ' { "Space".into() } else { c.to_string() }).collect(),
            };
            for name in names {
                self.studio.key(&name);
                self.studio.settle();
            }
        }
        self
    }

    fn times(&self) -> Vec<(f64, f64)> {
        self.studio.state.clip().unwrap().intervals().iter().map(|i| (i.start, i.end)).collect()
    }

    fn cursor(&self) -> f64 {
        self.studio.state.editor.as_ref().unwrap().cursor
    }

    fn message(&self) -> String {
        self.studio.state.message.as_ref().map_or(String::new(), |m| m.text.clone())
    }

    fn keys_of(&self, track: Track) -> Vec<(f64, KeyValue)> {
        let clip = self.studio.state.clip().unwrap();
        clip.score.sorted_keys().filter(|k| k.value.track() == track).map(|k| (k.time, k.value)).collect()
    }

    fn screen(&mut self, width: u16, height: u16) -> String {
        let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
        terminal.draw(|frame| self.studio.draw(frame)).unwrap();
        let folder = self.dir.path().display().to_string();
        text_of(terminal.backend().buffer()).replace(&folder, "FOLDER")
    }

    fn file(&self, name: &str) -> String {
        std::fs::read_to_string(self.dir.path().join("nihao/clips/nihao").join(name)).unwrap_or_default()
    }
}

/// A screen as text: wide letters take two cells, ends of lines are cut.
fn text_of(buffer: &Buffer) -> String {
    let mut text = String::new();
    for y in 0..buffer.area.height {
        let (mut line, mut x) = (String::new(), 0);
        while x < buffer.area.width {
            let symbol = buffer[(x, y)].symbol();
            line.push_str(symbol);
            x += (symbol.width() as u16).max(1);
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

#[test]
fn lessons_clips_and_the_timeline_fit_80_by_24_and_fill_200_by_50() {
    let mut bench = Bench::new(Some(TIMES), &[SCORE]);
    bench.keys("Tab");
    insta::assert_snapshot!("timeline_80x24", bench.screen(80, 24));
    insta::assert_snapshot!("timeline_200x50", bench.screen(200, 50));
    bench.keys("?");
    insta::assert_snapshot!("help_80x24", bench.screen(80, 24));
    bench.keys("Esc q");
    insta::assert_snapshot!("lesson_80x24", bench.screen(80, 24));
    bench.keys("q");
    insta::assert_snapshot!("lessons_80x24", bench.screen(80, 24));
}

#[test]
fn guessed_times_are_marked_until_the_author_sets_them() {
    let mut bench = Bench::new(None, &[]);
    assert!(bench.screen(80, 24).contains("您?") && bench.screen(80, 24).contains("guessed?"));
    bench.keys("Tab ]");
    let screen = bench.screen(80, 24);
    assert!(!screen.contains("您?") && screen.contains("好?"), "{screen}");
    bench.keys("s");
    assert!(bench.file("score.toml").contains("guessed = true"));
    assert!(bench.file("score.toml").contains("pins = [0]"));
}

#[test]
fn a_boundary_moves_by_hundredths_and_frames_and_undo_brings_it_back() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    assert_eq!(bench.keys("l l ] ]").times(), [(0.32, 0.75), (0.77, 1.28)]);
    assert_eq!(bench.keys("u").times(), [(0.31, 0.75), (0.77, 1.28)]);
    assert_eq!(bench.keys("u u u").times(), TIMES);
    assert_eq!(bench.keys("Ctrl-r }").times(), [(0.35, 0.75), (0.77, 1.28)]);
    assert_eq!(bench.keys("Tab Tab > ,").times(), [(0.35, 0.75), (0.77, 1.31)]);
}

#[test]
fn a_shared_boundary_moves_both_syllables_and_a_gap_closes_before_it_does() {
    let mut bench = Bench::new(Some(TOUCHING), &[]);
    assert_eq!(bench.keys(".").times(), [(0.3, 0.76), (0.76, 1.28)]);
    assert_eq!(bench.keys("u").times(), TOUCHING);
    let mut bench = Bench::new(Some(TIMES), &[]);
    assert_eq!(bench.keys("> ").times(), [(0.3, 0.77), (0.77, 1.28)]);
    assert_eq!(bench.keys(".").times(), [(0.3, 0.78), (0.78, 1.28)]);
}

#[test]
fn a_gap_opens_between_two_touching_syllables_and_moves_only_the_chosen_one() {
    let mut bench = Bench::new(Some(TOUCHING), &[]);
    assert_eq!(bench.keys("g g").times(), [(0.3, 0.73), (0.75, 1.28)]);
    assert_eq!(bench.keys("u u Tab Tab G").times(), [(0.3, 0.75), (0.76, 1.28)]);
    assert_eq!(bench.keys("[ [").times(), [(0.3, 0.74), (0.74, 1.28)], "a gap closes before both move");
}

#[test]
fn no_boundary_leaves_the_clip_or_makes_a_syllable_too_short() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("{ { { { { { { { { {");
    assert_eq!(bench.times()[0].0, 0.0);
    assert!(bench.message().contains("no room"), "{}", bench.message());
    bench.keys("} } } } } } } } } } } } } } } } } } } } } }");
    assert_eq!(bench.times()[0], (0.73, 0.75));
    bench.keys("End > > > > > > > > > >");
    assert_eq!(bench.times()[1].1, 1.6);
}

#[test]
fn a_reading_is_checked_and_written_as_the_label_and_empty_gives_it_back_to_the_dictionary() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("Tab Tab Enter Ctrl-u 'xyz' Enter");
    assert!(bench.screen(80, 24).contains("hang2"), "what is allowed is said");
    bench.keys("Ctrl-u 'hào' Enter");
    let clip = bench.studio.state.clip().unwrap();
    assert_eq!((clip.intervals()[1].label.as_str(), clip.syllables[1].pinyin.as_str()), ("好{hao4}", "hao4"));
    bench.keys("r Ctrl-u 'hai' Enter");
    assert!(bench.message().contains("read hai, neutral tone or no tone given"), "{}", bench.message());
    bench.keys("r Ctrl-u Enter");
    let clip = bench.studio.state.clip().unwrap();
    assert_eq!((clip.intervals()[1].label.as_str(), clip.syllables[1].pinyin.as_str()), ("好", "hao3"));
    bench.keys("u u u");
    assert_eq!(bench.studio.state.clip().unwrap().intervals()[1].label, "hao3");
}

#[test]
fn keys_are_added_changed_moved_and_deleted_on_every_lane() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("Right Right j j a 'happy 0.6, fear 0.2' Enter");
    let [(time, KeyValue::Emotion(ratios))] = bench.keys_of(Track::Emotion)[..] else { panic!() };
    assert!((time - 0.08).abs() < 1e-9 && (ratios.0[1] - 0.6).abs() < 1e-9 && (ratios.0[0] - 0.2).abs() < 1e-9);
    bench.keys(") )");
    assert!((bench.keys_of(Track::Emotion)[0].0 - 0.16).abs() < 1e-9);
    assert!((bench.cursor() - 0.16).abs() < 1e-9, "the cursor goes with the key");
    bench.keys("Enter Ctrl-u 'sad 1' Enter");
    assert_eq!(bench.keys_of(Track::Emotion).len(), 1);
    bench.keys("j a Enter j a '0.3 -0.1' Enter j a '0 0 5' Enter");
    assert_eq!(bench.keys_of(Track::Blink).len(), 1);
    assert_eq!(bench.keys_of(Track::Gaze).len(), 1);
    assert_eq!(bench.keys_of(Track::Head).len(), 1);
    bench.keys("x k x k Delete k x");
    assert!(bench.studio.state.clip().unwrap().score.keys.is_empty(), "{}", bench.message());
    bench.keys("u");
    assert_eq!(bench.keys_of(Track::Emotion).len(), 1);
}

#[test]
fn a_key_of_speech_is_taken_over_by_moving_or_changing_it_and_deleting_gives_it_back() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("j n n )");
    let clip = bench.studio.state.clip().unwrap();
    let [own] = clip.score.keys[..] else { panic!("{:?}", clip.score.keys) };
    assert!((own.time - own.replaces.unwrap() - 0.04).abs() < 1e-9);
    let author = |b: &Bench| {
        let keys = b.studio.state.editor.as_ref().unwrap().timeline.mouth_keys().to_vec();
        keys.iter().filter(|k| k.origin == lianpu::timeline::Origin::Author).count()
    };
    assert_eq!(author(&bench), 1);
    assert!(bench.screen(80, 24).contains("[n]"), "{}", bench.screen(80, 24));
    bench.keys("x");
    assert_eq!(author(&bench), 0);
    bench.keys("p n x");
    assert!(bench.message().contains("speech"), "{}", bench.message());
    bench.keys("Enter Ctrl-u 'o' Enter");
    assert_eq!(author(&bench), 1);
}

#[test]
fn a_stretch_of_the_record_is_marked_and_changed() {
    let rows: String = (0..40).map(|i| format!("{i},{:.2},0.5,0.5,0,0,0,0,0,1\n", f64::from(i) * 0.04)).collect();
    let record = format!("frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\n{rows}");
    let mut bench = Bench::new(Some(TIMES), &[("ratios.csv", &record)]);
    bench.keys("Tab v Tab v 'happy *0.5' Enter");
    let happy = |b: &Bench, t| b.studio.state.editor.as_ref().unwrap().timeline.ratios(t).0[1];
    assert!((happy(&bench, 0.52) - 0.25).abs() < 1e-9 && (happy(&bench, 1.2) - 0.5).abs() < 1e-9);
    bench.keys("X");
    assert!((happy(&bench, 0.52) - 0.5).abs() < 1e-9, "{}", bench.message());
    assert!(Bench::new(Some(TIMES), &[]).keys("v").message().contains("none"));
}

#[test]
fn an_edited_stretch_is_told_under_the_cursor_and_enter_changes_it_as_one_change() {
    let rows: String = (0..40).map(|i| format!("{i},{:.2},0.5,0.5,0,0,0,0,0,1\n", f64::from(i) * 0.04)).collect();
    let record = format!("frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\n{rows}");
    let mut bench = Bench::new(Some(TIMES), &[("ratios.csv", &record)]);
    bench.keys("Tab v Tab v 'happy *0.5' Enter Left j j");
    assert!(bench.screen(80, 24).contains("edit 0.30 to 0.77 s: happy *0.5"), "{}", bench.screen(80, 24));
    bench.keys("Enter");
    assert!(bench.screen(80, 24).contains("> happy *0.5"));
    bench.keys("'happy *0.2' Enter");
    let scales =
        |b: &Bench| -> Vec<f64> { b.studio.state.clip().unwrap().score.ranges.iter().map(|r| r.scale[1]).collect() };
    assert_eq!(scales(&bench), [0.2]);
    assert_eq!(scales(bench.keys("u")), [0.5]);
}

#[test]
fn the_first_emotion_key_says_that_it_colours_what_came_before() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("Tab j j a 'angry' Enter");
    assert!(bench.message().contains("from the start too"), "{}", bench.message());
    assert!(bench.screen(80, 24).contains("otherwise"), "a long message takes two rows");
    bench.keys("Home a 'neutral' Enter");
    assert!(!bench.message().contains("from the start too"));
}

#[test]
fn saving_writes_what_was_edited_and_the_lesson_reads_back_so() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("] j j a 'happy' Enter");
    assert!(bench.studio.state.is_unsaved() && bench.screen(80, 24).contains("unsaved"));
    bench.keys("Ctrl-s");
    assert!(!bench.studio.state.is_unsaved());
    assert!(bench.message().contains("score.toml") && bench.message().contains("timing.TextGrid"));
    let read = Lesson::read(&bench.dir.path().join("nihao")).unwrap();
    assert!((read.clips[0].intervals()[0].start - 0.31).abs() < 1e-9);
    assert_eq!(read.clips[0].score.keys.len(), 1);
}

#[test]
fn the_foot_offers_what_the_lane_is_for_and_saving_always() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    let foot = |b: &mut Bench, width| b.screen(width, 24).lines().last().unwrap_or_default().to_owned();
    let said = foot(&mut bench, 80);
    for hint in ["Space play", "↑↓ lane", "[] start", ",. end", "r read", "u undo", "s save", "? help", "q back"] {
        assert!(said.contains(hint), "{hint}: {said}");
    }
    bench.keys("j");
    let keys = foot(&mut bench, 80);
    for hint in ["Space play", "a add", "Enter change", "x delete", "u undo", "s save", "? help", "q back"] {
        assert!(keys.contains(hint), "{hint}: {keys}");
    }
    assert!(foot(&mut bench, 140).contains("zoom") && foot(&mut bench, 60).contains("s save"));
}

#[test]
fn a_clip_that_is_opened_again_is_where_it_was_left() {
    let mut bench = Bench::new(Some(TIMES), &[SCORE]);
    bench.keys("Tab Tab + j j");
    let (there, screen) = (bench.cursor(), bench.screen(80, 24));
    bench.keys("q Enter");
    assert_eq!((bench.cursor(), bench.screen(80, 24)), (there, screen));
}

#[test]
fn leaving_with_unsaved_changes_asks_and_does_what_is_answered() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("] q q");
    assert!(bench.screen(80, 24).contains("discard them"));
    bench.keys("Esc");
    assert!(bench.studio.state.is_unsaved() && bench.studio.state.open.is_some());
    bench.keys("q d");
    assert!(bench.studio.state.open.is_none());
    bench.keys("Enter Enter");
    assert_eq!(bench.times(), TIMES, "what was discarded does not come back");
    bench.keys("] Ctrl-c s");
    assert!(bench.studio.state.leaving);
    let read = Lesson::read(&bench.dir.path().join("nihao")).unwrap();
    assert!((read.clips[0].intervals()[0].start - 0.31).abs() < 1e-9);
}

#[test]
fn what_a_lost_connection_left_in_the_journal_is_brought_back() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("] ]");
    let Bench { studio, dir } = bench;
    drop(studio);
    let studio = Studio::new(State::new(dir.path(), Colours::None).unwrap(), Box::new(|_, _, _| Ok(String::new())));
    let mut bench = Bench { studio, dir };
    bench.keys("Enter");
    assert!(bench.message().contains("2 unsaved changes"), "{}", bench.message());
    assert_eq!(bench.keys("Enter").times()[0].0, 0.32);
}

#[test]
fn playing_shows_frames_by_the_clock_and_says_once_that_it_is_silent() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("Space");
    assert!(bench.message().contains("without sound"));
    assert!(!bench.studio.advance(0.01), "no new frame, no drawing");
    assert!(bench.studio.advance(0.05));
    assert_eq!(bench.cursor(), 0.04);
    assert!(bench.studio.advance(0.5), "a late frame is left out, not queued");
    assert_eq!(bench.cursor(), 0.56);
    assert!(bench.studio.advance(9.0));
    assert!(bench.studio.beat().is_none() && (bench.cursor() - 1.56).abs() < 1e-9);
    assert_eq!(bench.message(), "", "what is said of playing ends with it");
    bench.keys("Space");
    assert_eq!((bench.message().as_str(), bench.studio.beat().is_some()), ("", true));
    bench.keys("l");
    assert!(bench.studio.beat().is_none());
}

#[test]
fn zooming_in_spreads_the_syllables_and_fit_shows_all_again() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    let whole = bench.screen(80, 24);
    bench.keys("Tab + +");
    assert_eq!(bench.studio.state.editor.as_ref().unwrap().window.span, 0.4);
    assert_ne!(bench.screen(80, 24), whole);
    bench.keys("PageDown PageDown Home 0");
    assert_eq!(bench.screen(80, 24), whole);
}

#[test]
fn an_export_shows_how_far_it_is_and_can_be_stopped() {
    let exporter: Exporter = Box::new(|request: ExportRequest, progress, cancel: &AtomicBool| {
        assert_eq!((request.clip.as_deref(), request.formats.as_str()), (Some("nihao"), "png,srt"));
        progress(Progress { done: 3, total: 40, what: "frames".into() });
        for _ in 0..500 {
            if cancel.load(Ordering::Relaxed) {
                return Err(Fault::new("the export was stopped").help("start it again to finish it"));
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        Ok("never".into())
    });
    let mut bench = Bench::with(Some(TIMES), &[], exporter);
    bench.keys("] e 'png jpg' Enter");
    assert!(bench.screen(80, 24).contains("`jpg` is no format: svg png"), "a faulty word keeps the prompt open");
    bench.keys("Ctrl-u 'png srt'");
    bench.studio.key("Enter");
    assert!(!bench.studio.state.is_unsaved(), "what is exported is what is on the screen");
    let report = bench.studio.reports().recv_timeout(Duration::from_secs(5)).unwrap();
    bench.studio.receive(report);
    assert!(bench.screen(80, 24).contains("3 of 40   frames"));
    bench.studio.key("Ctrl-c");
    assert!(!bench.studio.state.leaving && bench.message().contains("running"));
    bench.keys("Esc");
    assert!(bench.message().contains("stopped"), "{}", bench.message());
    assert!(bench.studio.state.overlays.is_empty());
}

#[test]
fn a_damaged_lesson_shows_what_is_wrong_and_where() {
    let dir = tempfile::tempdir().unwrap();
    lesson(&dir.path().join("nihao"), Some(TIMES), &[("score.toml", "[[key]]\ntrack = \"mouht\"\n")]);
    let studio = Studio::new(State::new(dir.path(), Colours::None).unwrap(), Box::new(|_, _, _| Ok(String::new())));
    let mut bench = Bench { studio, dir };
    bench.keys("Enter Enter Enter s e u");
    let screen = bench.screen(80, 24);
    assert!(screen.contains("it does not open") && screen.contains("score.toml:2"), "{screen}");
    assert!(!screen.contains("s save") && !screen.contains("e export"), "{screen}");
}

#[test]
fn a_second_studio_may_look_and_not_touch() {
    let mut first = Bench::new(Some(TIMES), &[]);
    let state = State::new(first.dir.path(), Colours::None).unwrap();
    let mut second = Studio::new(state, Box::new(|_, _, _| Ok(String::new())));
    for key in ["Enter", "Enter", "]"] {
        second.key(key);
        second.settle();
    }
    assert!(second.state.message.as_ref().is_some_and(|m| m.is_fault && m.text.contains("another window")));
    assert_eq!(first.keys("]").times()[0].0, 0.31);
}

#[test]
fn a_terminal_that_is_too_small_is_told_so_and_none_is_too_small_to_draw_on() {
    let mut bench = Bench::new(Some(TIMES), &[SCORE]);
    assert!(bench.screen(40, 10).contains("too small"));
    for keys in ["", "?", "Esc", "r"] {
        bench.keys(keys);
        for (width, height) in
            [(1, 1), (3, 2), (59, 19), (60, 20), (61, 28), (80, 21), (500, 20), (60, 120), (300, 100)]
        {
            bench.screen(width, height);
        }
    }
}

#[test]
fn where_nothing_can_be_seen_no_key_but_quitting_does_anything_and_changes_wait_in_the_journal() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("]");
    let text = bench.screen(30, 10).replace('\n', " ");
    assert!(text.contains("too small") && text.contains("Ctrl-c quits"), "{text}");
    bench.keys("] q x");
    assert!((bench.times()[0].0 - 0.31).abs() < 1e-9 && bench.studio.state.editor.is_some());
    bench.keys("Ctrl-c");
    assert!(bench.studio.state.leaving);
    let Bench { studio, dir } = bench;
    drop(studio);
    let studio = Studio::new(State::new(dir.path(), Colours::None).unwrap(), Box::new(|_, _, _| Ok(String::new())));
    let mut bench = Bench { studio, dir };
    assert!(bench.keys("Enter").message().contains("brought back 1 unsaved change from last time"));
}

#[test]
fn a_low_terminal_shows_time_and_syllable_and_the_ratios_that_are_not_zero() {
    let mut bench = Bench::new(Some(TIMES), &[SCORE]);
    bench.keys("Tab");
    insta::assert_snapshot!("timeline_60x20", bench.screen(60, 20));
    bench.keys("j j Enter");
    insta::assert_snapshot!("prompt_80x24", bench.screen(80, 24));
}

#[test]
fn pasted_text_goes_into_a_line_being_typed_and_is_no_command() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.studio.paste("]]]q");
    assert_eq!(bench.times(), TIMES);
    bench.keys("r Ctrl-u");
    bench.studio.paste("nin3");
    bench.keys("Enter");
    assert_eq!(bench.studio.state.clip().unwrap().syllables[0].pinyin, "nin3");
}

#[test]
fn the_player_plays_seeks_and_loops() {
    let dir = tempfile::tempdir().unwrap();
    lesson(dir.path(), Some(TIMES), &[]);
    let show = Show::of_clip(&Lesson::read(dir.path()).unwrap(), 0).unwrap();
    let mut player = Player::new(show, Colours::None);
    assert!(player.advance(0.45) && player.frame() == 11);
    let mut terminal = Terminal::new(TestBackend::new(80, 24)).unwrap();
    terminal.draw(|frame| player.draw(frame)).unwrap();
    insta::assert_snapshot!("player_80x24", text_of(terminal.backend().buffer()));
    player.key("Space");
    assert!(!player.advance(1.0));
    player.key("Right");
    assert_eq!(player.frame(), 12);
    player.key("Space");
    player.advance(9.0);
    assert_eq!(player.frame(), 39);
    player.key("l");
    player.key("Space");
    assert!(player.advance(1.7) && player.frame() == 2, "{}", player.frame());
}
