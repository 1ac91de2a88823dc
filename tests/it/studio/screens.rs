//! The studio without a terminal: keys go in as text, states and screens come out.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::support::studio_bench::{Bench, SCORE, TIMES, lesson, text_of};
use lianpu::disk::Fault;
use lianpu::export::{CourseReport, Format};
use lianpu::project::Lesson;
use lianpu::studio::{Colours, ExportRequest, Exporter, Player, Progress, Show, Studio};
use ratatui::Terminal;
use ratatui::backend::TestBackend;

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
fn saving_writes_what_was_edited_and_the_lesson_reads_back_so() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("] j j a 'happy' Enter");
    assert!(bench.studio.is_unsaved() && bench.screen(80, 24).contains("unsaved"));
    bench.keys("Ctrl-s");
    assert!(!bench.studio.is_unsaved());
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
    assert!(bench.studio.is_unsaved() && bench.studio.project().is_some());
    bench.keys("q d");
    assert!(bench.studio.project().is_none());
    bench.keys("Enter Enter");
    assert_eq!(bench.times(), TIMES, "what was discarded does not come back");
    bench.keys("] Ctrl-c s");
    assert!(bench.studio.shell().leaving);
    let read = Lesson::read(&bench.dir.path().join("nihao")).unwrap();
    assert!((read.clips[0].intervals()[0].start - 0.31).abs() < 1e-9);
}

#[test]
fn what_a_lost_connection_left_in_the_journal_is_brought_back() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("] ]");
    let Bench { studio, dir } = bench;
    drop(studio);
    let studio = Studio::new(dir.path(), Colours::None, Box::new(|_, _, _| Ok(CourseReport::default()))).unwrap();
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
    assert_eq!(bench.editor().borrow().window.span, 0.4);
    assert_ne!(bench.screen(80, 24), whole);
    bench.keys("PageDown PageDown Home 0");
    assert_eq!(bench.screen(80, 24), whole);
}

#[test]
fn an_export_shows_how_far_it_is_and_can_be_stopped() {
    let exporter: Exporter = Box::new(|request: ExportRequest, progress, cancel: &AtomicBool| {
        assert_eq!(
            (request.clip.as_deref(), request.formats.as_slice()),
            (Some("nihao"), &[Format::Png, Format::Srt][..])
        );
        progress(Progress { done: 3, total: 40, what: "frames".into() });
        for _ in 0..500 {
            if cancel.load(Ordering::Relaxed) {
                return Err(Fault::new("the export was stopped").help("start it again to finish it"));
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        Ok(CourseReport::default())
    });
    let mut bench = Bench::with(Some(TIMES), &[], exporter);
    bench.keys("] e 'png jpg' Enter");
    assert!(bench.screen(80, 24).contains("`jpg` is no format: svg png"), "a faulty word keeps the prompt open");
    bench.keys("Ctrl-u 'png srt'");
    bench.studio.key("Enter");
    assert!(!bench.studio.is_unsaved(), "what is exported is what is on the screen");
    let report = bench.studio.reports().recv_timeout(Duration::from_secs(5)).unwrap();
    bench.studio.receive(report);
    assert!(bench.screen(80, 24).contains("3 of 40   frames"));
    bench.studio.key("Ctrl-c");
    assert!(!bench.studio.shell().leaving && bench.message().contains("running"));
    bench.keys("Esc");
    assert!(bench.message().contains("stopped"), "{}", bench.message());
    assert!(!bench.has_box());
}

#[test]
fn a_damaged_lesson_shows_what_is_wrong_and_where() {
    let dir = tempfile::tempdir().unwrap();
    lesson(&dir.path().join("nihao"), Some(TIMES), &[("score.toml", "[[key]]\ntrack = \"mouht\"\n")]);
    let studio = Studio::new(dir.path(), Colours::None, Box::new(|_, _, _| Ok(CourseReport::default()))).unwrap();
    let mut bench = Bench { studio, dir };
    bench.keys("Enter Enter Enter s e u");
    let screen = bench.screen(80, 24);
    assert!(screen.contains("it does not open") && screen.contains("score.toml:2"), "{screen}");
    assert!(!screen.contains("s save") && !screen.contains("e export"), "{screen}");
}

#[test]
fn a_second_studio_may_look_and_not_touch() {
    let mut first = Bench::new(Some(TIMES), &[]);
    let mut second =
        Studio::new(first.dir.path(), Colours::None, Box::new(|_, _, _| Ok(CourseReport::default()))).unwrap();
    for key in ["Enter", "Enter", "]"] {
        second.key(key);
        second.settle();
    }
    assert!(second.shell().message.as_ref().is_some_and(|m| m.is_fault && m.text.contains("another window")));
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
    assert!((bench.times()[0].0 - 0.31).abs() < 1e-9 && bench.studio.editor().is_some());
    bench.keys("Ctrl-c");
    assert!(bench.studio.shell().leaving);
    let Bench { studio, dir } = bench;
    drop(studio);
    let studio = Studio::new(dir.path(), Colours::None, Box::new(|_, _, _| Ok(CourseReport::default()))).unwrap();
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
fn the_player_plays_seeks_and_loops() {
    let dir = tempfile::tempdir().unwrap();
    lesson(dir.path(), Some(TIMES), &[]);
    let show = Show::of_clip(&Lesson::read(dir.path()).unwrap(), 0).unwrap();
    let mut player = Player::new(show, Colours::None);
    assert!(player.advance(0.45) && player.frame() == Some(11));
    let mut terminal = Terminal::new(TestBackend::new(80, 24)).unwrap();
    terminal.draw(|frame| player.draw(frame)).unwrap();
    insta::assert_snapshot!("player_80x24", text_of(terminal.backend().buffer()));
    player.key("Space");
    assert!(!player.advance(1.0));
    player.key("Right");
    assert_eq!(player.frame(), Some(12));
    player.key("Space");
    player.advance(9.0);
    assert_eq!(player.frame(), Some(39));
    player.key("l");
    player.key("Space");
    assert!(player.advance(1.7) && player.frame() == Some(2), "{:?}", player.frame());
}

#[test]
fn syllables_close_together_have_all_their_boundaries_or_none() {
    // 80 columns have 66 of time for 1.6 s: the first syllable has two of them, which is its character alone.
    let mut bench = Bench::new(Some([(0.3, 0.34), (0.34, 1.28)]), &[]);
    let said = |b: &mut Bench, width| -> String {
        b.screen(width, 24).lines().find(|l| l.contains("said")).unwrap_or_default().to_owned()
    };
    assert_eq!(said(&mut bench, 80).matches('│').count(), 1, "the cursor's line alone: {}", said(&mut bench, 80));
    bench.keys("Tab + +");
    assert!(said(&mut bench, 80).matches('│').count() >= 2, "{}", said(&mut bench, 80));
}

#[test]
fn the_changes_of_a_lesson_that_was_moved_are_kept_where_it_is_now() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("] ]");
    let (old, new) = (bench.dir.path().join("nihao"), bench.dir.path().join("moved"));
    std::fs::rename(&old, &new).unwrap();
    bench.keys("s");
    assert!(bench.message().contains("moved while it was open"), "{}", bench.message());
    #[cfg(target_os = "linux")]
    assert!(bench.message().contains("/moved"), "{}", bench.message());
    bench.keys("q q");
    assert!(bench.screen(80, 24).contains("keep them"), "{}", bench.screen(80, 24));
    bench.keys("k");
    assert!(bench.studio.project().is_none());
    assert_eq!(Lesson::open(&new).unwrap().recovered, 2);
}

#[test]
fn a_save_puts_back_what_was_deleted_meanwhile() {
    let mut bench = Bench::new(Some(TIMES), &[SCORE]);
    let root = bench.dir.path().join("nihao");
    let gone = ["lianpu.toml", "clips/nihao/script.txt", "clips/nihao/timing.TextGrid", "clips/nihao/score.toml"];
    let text = |name: &str| std::fs::read_to_string(root.join(name)).unwrap();
    let read = || {
        let mut score = lianpu::timeline::Score::parse(&text(gone[3])).unwrap();
        score.keys.sort_by(|a, b| a.time.total_cmp(&b.time));
        (lianpu::timing::read(&root.join(gone[2])).unwrap(), score)
    };
    let read_before = read();
    let before: Vec<_> = gone.iter().map(|name| std::fs::read(root.join(name)).unwrap()).collect();
    gone.iter().for_each(|name| std::fs::remove_file(root.join(name)).unwrap());
    bench.keys("s");
    assert!(bench.message().contains("saved"), "{}", bench.message());
    for (name, before) in gone.iter().zip(before) {
        let now = std::fs::read(root.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        // What was written by hand comes back as the program writes it.
        assert!(now == before || gone[2..].contains(name), "{name}");
        assert!(bench.message().contains(name.rsplit('/').next().unwrap()), "{name}: {}", bench.message());
    }
    assert_eq!(read(), read_before);
    bench.keys("s");
    assert!(bench.message().contains("nothing had changed"), "{}", bench.message());
}
