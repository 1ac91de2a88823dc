//! Speech in the studio: times found in the sound, doubts, phones, frequencies and pitch, tapping, words without a
//! script; by keys, with time that passes when it is told to.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::support::studio_bench::{Bench, TIMES, found, lesson};
use lianpu::project::Lesson;
use lianpu::studio::{Aligner, Colours, Phase, Studio};

const FOUND: [(f64, f64); 2] = [(0.31, 0.74), (0.78, 1.12)];

fn line<'a>(screen: &'a str, name: &str) -> &'a str {
    screen.lines().find(|l| l.trim_start_matches('▸').trim_start().starts_with(name)).unwrap_or_default()
}

fn pins(bench: &Bench) -> Vec<usize> {
    bench.clip().score.pins.clone()
}

#[test]
fn guessed_times_are_found_in_the_sound_at_once_and_undo_takes_that_back_for_good() {
    let mut bench = Bench::aligning(None, found());
    assert_eq!(bench.times(), FOUND);
    let said = bench.message();
    assert!(said.contains("aligned 2 syllables") && said.contains("u takes it back"), "{said}");
    assert!(said.contains("2 to look at"), "{said}");
    let guessed = bench.keys("u").times();
    assert_ne!(guessed, FOUND);
    assert_eq!(bench.keys("q Enter").times(), guessed, "what was taken back is not done again unasked");
    assert_eq!(bench.keys("A").times(), FOUND);
    assert!(!bench.message().contains("takes it back"), "it was asked for: {}", bench.message());
    bench.keys("s q");
    let list = bench.screen(80, 24);
    assert!(list.contains("aligned, 2 to look at!"), "{list}");
}

#[test]
fn times_that_were_given_stay_until_they_are_asked_for_and_what_is_found_again_changes_nothing() {
    let mut bench = Bench::aligning(Some(TIMES), found());
    assert_eq!(bench.times(), TIMES);
    assert!(bench.keys("d").message().contains("A finds the times"), "{}", bench.message());
    assert_eq!(bench.keys("A").times(), FOUND);
    assert_eq!(bench.keys("A u").times(), TIMES, "one change to take back");
}

#[test]
fn what_was_edited_while_the_search_ran_is_kept_and_the_search_is_offered_again() {
    let mut bench = Bench::aligning(Some(TIMES), found());
    bench.studio.key("A");
    assert!(bench.screen(80, 24).contains("aligning…"));
    bench.studio.key("]");
    bench.studio.settle();
    assert_eq!(bench.times()[0], (0.31, 0.75));
    assert!(
        bench.message().contains("was changed") && bench.message().contains("A looks again"),
        "{}",
        bench.message()
    );
    assert!(!bench.screen(80, 24).contains("aligning…"));
    // The fake keeps no pins; what it finds now fits.
    assert_eq!(bench.keys("A").times(), FOUND);
}

#[test]
fn a_newer_search_takes_the_place_of_the_one_that_waits() {
    let dir = tempfile::tempdir().unwrap();
    lesson(&dir.path().join("nihao"), Some(TIMES), &[]);
    let runs = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&runs);
    let aligner = Aligner::new(move |_| {
        count.fetch_add(1, Ordering::SeqCst);
        vec![(0, Ok(found()))]
    });
    let studio =
        Studio::new(dir.path(), Colours::None, Box::new(|_, _, _| Ok(lianpu::export::CourseReport::default())))
            .unwrap();
    let mut bench = Bench { studio: studio.with_aligner(aligner), dir };
    bench.keys("Enter Enter");
    for _ in 0..5 {
        bench.studio.key("A");
    }
    bench.studio.settle();
    assert_eq!(runs.load(Ordering::SeqCst), 2);
}

#[test]
fn a_search_asked_for_in_another_lesson_waits_for_the_first_ones_end() {
    let dir = tempfile::tempdir().unwrap();
    lesson(&dir.path().join("first"), Some(TIMES), &[]);
    lesson(&dir.path().join("second"), Some(TIMES), &[]);
    let (gate, opened) = std::sync::mpsc::channel::<()>();
    let opened = std::sync::Mutex::new(opened);
    let aligner = Aligner::new(move |_| {
        opened.lock().unwrap().recv().unwrap();
        vec![(0, Ok(found()))]
    });
    let studio =
        Studio::new(dir.path(), Colours::None, Box::new(|_, _, _| Ok(lianpu::export::CourseReport::default())))
            .unwrap();
    let mut bench = Bench { studio: studio.with_aligner(aligner), dir };
    let open = |bench: &mut Bench| {
        bench.studio.key("Enter");
        while bench.studio.project().is_none() {
            let report = bench.studio.reports().recv().unwrap();
            bench.studio.receive(report);
        }
        bench.studio.key("Enter");
        bench.studio.key("A");
    };
    open(&mut bench);
    for key in ["q", "q", "Down"] {
        bench.studio.key(key);
    }
    open(&mut bench);
    assert!(bench.message().contains("is aligned next"), "{}", bench.message());
    gate.send(()).unwrap();
    gate.send(()).unwrap();
    bench.studio.settle();
    assert!(bench.studio.project().unwrap().borrow().lesson.root.ends_with("second"));
    assert_eq!(bench.times(), FOUND);
}

#[test]
fn a_lesson_that_is_only_looked_at_is_not_aligned() {
    let first = Bench::new(Some(TIMES), &[]);
    let clip = first.dir.path().join("nihao/clips/nihao/timing.TextGrid");
    std::fs::remove_file(clip).unwrap();
    let studio =
        Studio::new(first.dir.path(), Colours::None, Box::new(|_, _, _| Ok(lianpu::export::CourseReport::default())))
            .unwrap();
    let mut second = studio.with_aligner(Aligner::new(|_| vec![(0, Ok(found()))]));
    for key in ["Enter", "Enter"] {
        second.key(key);
        second.settle();
    }
    assert!(second.project().unwrap().borrow().lesson.clips[0].timing.guessed);
    second.key("A");
    assert!(second.shell().message.as_ref().is_some_and(|m| m.is_fault && m.text.contains("another window")));
}

#[test]
fn doubts_have_a_sign_are_gone_to_and_listed_and_a_hand_settles_them() {
    let mut bench = Bench::aligning(None, found());
    let screen = bench.screen(80, 24);
    assert!(line(&screen, "said").contains("好!") && !screen.contains("您!"), "{screen}");
    assert!(line(&screen, "said").contains('░') && screen.contains("2 ! (d)"), "{screen}");
    insta::assert_snapshot!("doubts_80x24", screen);
    bench.keys("d");
    assert_eq!((bench.cursor(), bench.message().as_str()), (0.78, "好 hao3: 41 % sure"));
    assert!(bench.screen(80, 24).contains("41 % sure"));
    bench.keys("d");
    assert_eq!((bench.cursor(), bench.message().as_str()), (1.2, "0.30 s are not in the script"));
    assert!(bench.keys("d").message().contains("nothing more to look at after here; 2 in all"));
    bench.keys("D o");
    insta::assert_snapshot!("doubts_list_80x24", bench.screen(80, 24));
    bench.keys("Down Enter");
    assert_eq!((bench.cursor(), bench.has_box()), (1.2, false));
    bench.keys("D ]");
    let screen = bench.screen(80, 24);
    assert!(!screen.contains("好!") && screen.contains("by hand") && screen.contains("1 ! (d)"), "{screen}");
    bench.keys("o Esc");
    assert!(!bench.has_box());
}

#[test]
fn phones_are_seen_where_they_can_be_read_and_follow_their_syllable() {
    let mut bench = Bench::aligning(None, found());
    let screen = bench.screen(80, 24);
    let phones = line(&screen, "phones");
    assert!(phones.contains('n') && phones.contains('h'), "{screen}");
    bench.keys("- - -");
    let face = |s: &str| s.lines().take(12).map(str::to_owned).collect::<Vec<_>>();
    let before = face(&bench.screen(80, 24));
    let mut long = Bench::aligning(None, found());
    long.editor().borrow_mut().window.span = 30.0;
    let screen = long.screen(80, 24);
    assert!(line(&screen, "phones").is_empty(), "{screen}");
    assert_eq!(face(&screen)[1..5], before[1..5], "zooming leaves the face where it is");
    let place = |b: &mut Bench| {
        let screen = b.screen(200, 50);
        let phones = line(&screen, "phones").to_owned();
        phones.chars().skip(9).position(|c| c == 'h').unwrap()
    };
    let was = place(&mut bench);
    bench.keys("d } }");
    assert!(place(&mut bench) > was);
}

#[test]
fn the_sound_is_seen_as_a_wave_as_frequencies_or_both_and_its_pitch_beside() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    assert!(!line(&bench.screen(80, 24), "sound").is_empty());
    bench.keys("S");
    let screen = bench.screen(80, 24);
    assert!(line(&screen, "sound").is_empty() && !line(&screen, "spectrum").is_empty(), "{screen}");
    bench.keys("S");
    let tall = bench.screen(200, 50);
    assert!(!line(&tall, "sound").is_empty() && !line(&tall, "spectrum").is_empty(), "{tall}");
    let low = bench.screen(80, 24);
    assert!(line(&low, "sound").is_empty() && !line(&low, "spectrum").is_empty(), "one of them where there is no room");
    bench.keys("S P");
    let screen = bench.screen(80, 24);
    assert!(line(&screen, "pitch").contains("Hz") && !line(&screen, "sound").is_empty(), "{screen}");
    assert!(screen.chars().any(|c| ('\u{2801}'..'\u{2900}').contains(&c)));
    bench.keys("P");
    assert!(line(&bench.screen(80, 24), "pitch").is_empty());
    // At every size nothing falls off the screen.
    bench.keys("S S P Tab Enter");
    for (width, height) in [(60, 20), (61, 28), (80, 24), (120, 32), (500, 20), (60, 120)] {
        bench.screen(width, height);
    }
}

#[test]
fn tapped_syllables_become_one_change_and_are_vouched_for() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("t");
    let screen = bench.screen(80, 24);
    assert!(screen.contains("Enter begins") && screen.contains("play the recording yourself"), "{screen}");
    insta::assert_snapshot!("tapping_80x24", screen);
    assert!(bench.studio.beat().is_none(), "nothing moves yet");
    bench.keys("Enter");
    assert!(bench.studio.advance(0.8) && bench.screen(80, 24).contains("   2"));
    assert!(bench.studio.advance(1.3));
    bench.studio.advance(0.4);
    bench.keys("Enter");
    bench.studio.advance(0.45);
    bench.keys("Enter");
    insta::assert_snapshot!("tapped_80x24", bench.screen(80, 24));
    bench.studio.advance(0.4);
    bench.keys("Space");
    assert_eq!(bench.times(), TIMES, "nothing has changed yet");
    bench.keys("q");
    assert_eq!((bench.times(), pins(&bench)), (vec![(0.4, 0.85), (0.85, 1.25)], vec![0, 1]));
    assert!(bench.message().contains("tapped 2 syllables; all are set by hand"), "{}", bench.message());
    bench.keys("u");
    assert_eq!((bench.times(), pins(&bench)), (TIMES.to_vec(), vec![]), "one change");
}

#[test]
fn a_tap_that_is_taken_back_goes_a_second_back_and_the_rest_is_offered_to_the_search() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("t r Enter");
    bench.studio.advance(2.1);
    bench.studio.advance(0.8);
    bench.keys("Enter");
    bench.studio.advance(1.0);
    bench.keys("Enter Backspace");
    let tapping = bench.tapping().unwrap().clone();
    assert_eq!((tapping.at, tapping.next, tapping.taps.len()), (0.0, 1, 1), "no farther back than where it began");
    assert!((tapping.taps[0].at - 0.4).abs() < 1e-9, "at half speed");
    bench.keys("q");
    let times = bench.times();
    assert!((times[0].0 - 0.4).abs() < 1e-9 && times[0].1 <= times[1].0, "{times:?}");
    assert_eq!(pins(&bench), [0]);
    assert!(bench.message().contains("A finds the other 1"), "{}", bench.message());
}

#[test]
fn how_late_taps_come_is_measured_once_and_taken_off() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("t c");
    bench.studio.advance(0.75);
    assert!(bench.screen(80, 24).contains("████████"));
    for _ in 0..8 {
        bench.studio.advance(0.1);
        bench.keys("Enter");
        bench.studio.advance(0.65);
    }
    assert!(bench.message().contains("100 ms after the flash"), "{}", bench.message());
    bench.keys("Enter");
    bench.studio.advance(2.1);
    bench.studio.advance(0.5);
    bench.keys("Enter");
    bench.studio.advance(0.5);
    bench.keys("Enter x t");
    assert!(matches!(bench.tapping().unwrap().phase, Phase::Ready));
    assert!(bench.screen(80, 24).contains("100 ms are taken off"));
    bench.keys("Enter");
    bench.studio.advance(2.1);
    bench.studio.advance(0.5);
    bench.keys("Enter");
    bench.studio.advance(0.5);
    bench.keys("Enter q");
    assert_eq!((bench.times()[0], bench.times()[1].0), ((0.4, 0.9), 0.9));
}

#[test]
fn leaving_while_tapping_keeps_what_was_tapped() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("t Enter");
    bench.studio.advance(2.1);
    bench.studio.advance(0.5);
    bench.keys("Enter ?");
    assert!(bench.studio.beat().is_none(), "below the help time stands still");
    bench.keys("Esc Ctrl-c");
    assert!(bench.screen(80, 24).contains("unsaved"));
    bench.keys("s");
    assert!(bench.studio.shell().leaving);
    let read = Lesson::read(&bench.dir.path().join("nihao")).unwrap();
    assert!((read.clips[0].intervals()[0].start - 0.5).abs() < 1e-6);
}

#[test]
fn a_tap_at_the_very_end_is_kept_and_what_cannot_be_kept_is_not_lost_by_leaving() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    let wav = bench.dir.path().join("nihao/clips/nihao/speech.wav");
    // 1.599875 s: rounded to 1.5999 s, that lies beyond.
    let samples: Vec<i16> = hound::WavReader::open(&wav).unwrap().samples().map(Result::unwrap).take(12_799).collect();
    let spec =
        hound::WavSpec { channels: 1, sample_rate: 8000, bits_per_sample: 16, sample_format: hound::SampleFormat::Int };
    let mut writer = hound::WavWriter::create(&wav, spec).unwrap();
    samples.iter().for_each(|s| writer.write_sample(*s).unwrap());
    writer.finalize().unwrap();
    bench.keys("q q Enter Enter t Enter");
    bench.studio.advance(2.1);
    bench.studio.advance(0.5);
    bench.keys("Enter");
    bench.studio.advance(0.5);
    bench.keys("Enter");
    bench.studio.advance(0.599_86);
    bench.keys("Space q");
    let duration = bench.clip().duration();
    assert!(bench.message().contains("tapped 2"), "{}", bench.message());
    assert!(bench.times()[1].1 > duration - 2e-4 && bench.times()[1].1 <= duration, "{:?}", bench.times());

    // 好 has no room behind 您 that goes on to the end.
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("t Enter");
    bench.studio.advance(2.1);
    bench.studio.advance(0.5);
    bench.keys("Enter");
    bench.studio.advance(1.09);
    bench.keys("Space Ctrl-c");
    assert!(bench.message().contains("no room is left"), "{}", bench.message());
    let taps = |bench: &Bench| bench.tapping().map(|t| t.taps.len());
    assert_eq!((bench.studio.shell().leaving, taps(&bench)), (false, Some(2)));
    bench.keys("x Ctrl-c");
    assert!(bench.studio.shell().leaving);
}

#[test]
fn marked_places_give_way_to_syllables() {
    let mut bench = Bench::new(Some([(0.3, 0.5), (0.9, 1.1)]), &[]);
    bench.editor().borrow_mut().places = vec![(0.5, 0.7), (1.12, 1.5)];
    let places = |bench: &Bench| bench.editor().borrow().places.clone();
    bench.keys("Home .");
    let end = bench.times()[0].1;
    assert_eq!((end > 0.505, places(&bench)), (true, vec![(end, 0.7), (1.12, 1.5)]));
    bench.keys("t Enter");
    bench.studio.advance(2.1);
    bench.studio.advance(0.3);
    bench.keys("Enter");
    bench.studio.advance(0.45);
    bench.keys("Space q");
    assert_eq!((bench.times()[0], places(&bench)), ((0.3, 0.75), vec![(1.12, 1.5)]));
}

/// A lesson of sound alone, three places marked in it.
fn without_script() -> Bench {
    let dir = tempfile::tempdir().unwrap();
    lesson(&dir.path().join("nihao"), None, &[]);
    std::fs::remove_file(dir.path().join("nihao/clips/nihao/script.txt")).unwrap();
    let studio =
        Studio::new(dir.path(), Colours::None, Box::new(|_, _, _| Ok(lianpu::export::CourseReport::default())))
            .unwrap();
    let mut bench = Bench { studio, dir };
    bench.keys("Enter Enter");
    bench.editor().borrow_mut().places = vec![(0.3, 0.5), (0.5, 0.75), (0.77, 1.28)];
    bench
}

#[test]
fn words_are_laid_onto_marked_places_a_syllable_each_and_become_the_script() {
    let mut bench = without_script();
    assert!(bench.screen(80, 24).contains('○'));
    bench.keys("Tab Enter");
    assert!(bench.screen(80, 24).contains("3 places left"), "{}", bench.screen(80, 24));
    bench.keys("'您好嗎我' Enter");
    assert!(bench.screen(80, 24).contains("4 syllables, and 3 places"), "{}", bench.screen(80, 24));
    bench.keys("Ctrl-u '您好' Enter");
    assert_eq!(bench.times(), [(0.3, 0.5), (0.5, 0.75)]);
    assert!(bench.message().contains("1 place left") && (bench.cursor() - 0.77).abs() < 1e-9, "{}", bench.message());
    insta::assert_snapshot!("words_80x24", bench.screen(80, 24));
    bench.keys("Enter '嗎' Enter");
    assert_eq!(bench.times().len(), 3);
    assert!(bench.message().contains("A finds"), "{}", bench.message());
    bench.keys("s");
    assert_eq!(bench.file("script.txt"), "您好嗎\n");
    let read = Lesson::read(&bench.dir.path().join("nihao")).unwrap();
    assert_eq!((read.clips[0].syllables.len(), read.clips[0].timing.guessed), (3, false));
    bench.keys("u u");
    assert!(bench.times().is_empty());
    bench.keys("s");
    assert_eq!(bench.file("script.txt"), "");
    assert!(Lesson::read(&bench.dir.path().join("nihao")).unwrap().clips[0].syllables.is_empty());
}

#[test]
fn words_may_be_put_between_others_and_pins_stay_with_their_syllables() {
    let mut bench = without_script();
    bench.keys("End Tab Shift-Tab Enter '好' Enter [");
    assert_eq!(pins(&bench), [0]);
    bench.keys("Home Tab Enter '你們' Enter");
    let clip = bench.clip();
    let said: Vec<&str> = clip.syllables.iter().map(|s| s.text.as_str()).collect();
    assert_eq!((said.len(), said[2]), (3, "好"), "{said:?} {}", bench.message());
    assert_eq!(pins(&bench), [2]);
    bench.keys("u");
    assert_eq!((bench.times().len(), pins(&bench)), (1, vec![0]));
}
