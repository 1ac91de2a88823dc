//! Edits in the studio: boundaries, readings, keys and stretches, by keys.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use crate::support::studio_bench::{Bench, TIMES, TOUCHING};
use lianpu::timeline::{KeyValue, Track};

#[test]
fn guessed_times_are_marked_until_the_author_sets_them() {
    let mut bench = Bench::new(None, &[]);
    assert!(bench.message().contains("no voice is heard"), "{}", bench.message());
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
    let clip = bench.clip();
    assert_eq!((clip.intervals()[1].label.as_str(), clip.syllables[1].pinyin.as_str()), ("好{hao4}", "hao4"));
    bench.keys("r Ctrl-u 'hai' Enter");
    assert!(bench.message().contains("read hai, neutral tone or no tone given"), "{}", bench.message());
    bench.keys("r Ctrl-u Enter");
    let clip = bench.clip();
    assert_eq!((clip.intervals()[1].label.as_str(), clip.syllables[1].pinyin.as_str()), ("好", "hao3"));
    bench.keys("u u u");
    assert_eq!(bench.clip().intervals()[1].label, "hao3");
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
    assert!(bench.clip().score.keys.is_empty(), "{}", bench.message());
    bench.keys("u");
    assert_eq!(bench.keys_of(Track::Emotion).len(), 1);
}

#[test]
fn a_key_of_speech_is_taken_over_by_moving_or_changing_it_and_deleting_gives_it_back() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.keys("j n n )");
    let clip = bench.clip();
    let [own] = clip.score.keys[..] else { panic!("{:?}", clip.score.keys) };
    assert!((own.time - own.replaces.unwrap() - 0.04).abs() < 1e-9);
    let author = |b: &Bench| {
        let keys = b.editor().borrow().timeline.mouth_keys().to_vec();
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
    let happy = |b: &Bench, t| b.editor().borrow().timeline.ratios(t).0[1];
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
    let scales = |b: &Bench| -> Vec<f64> { b.clip().score.ranges.iter().map(|r| r.scale[1]).collect() };
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
fn pasted_text_goes_into_a_line_being_typed_and_is_no_command() {
    let mut bench = Bench::new(Some(TIMES), &[]);
    bench.studio.paste("]]]q");
    assert_eq!(bench.times(), TIMES);
    bench.keys("r Ctrl-u");
    bench.studio.paste("nin3");
    bench.keys("Enter");
    assert_eq!(bench.clip().syllables[0].pinyin, "nin3");
}
