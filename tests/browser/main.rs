//! Lessons in a real browser: the page is played as its reader plays it, and animated SVG shows what the frames show.
//! Where there is no Chromium they are ignored. Lottie is shown by lottie-web where `LIANPU_LOTTIE_WEB` names its
//! `lottie.min.js` (npm: `lottie-web`, in `build/player`).

#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

mod chromium;
#[path = "../it/support/two_clips.rs"]
mod two_clips;

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use chromium::{Chromium, Tab, from_base64};
use lianpu::drawing::Picture;
use lianpu::export::{Format, Job, Ledger, Request, Shard, plan};
use lianpu::project::Lesson;
use lianpu::render::Painter;

const SIZE: [u32; 2] = [640, 360];

/// Two clips: 您好 as the sample says it, and a smile without a word.
fn lesson() -> (tempfile::TempDir, Lesson) {
    two_clips::lesson("您好 & \\\"再見\\\"", "你好", "smile", 25)
}

/// Writes one form of the lesson into a folder whose name a browser has to be told with care.
fn export(folder: &Path, lesson: &Lesson, format: Format, thesis: bool) -> PathBuf {
    let out = folder.join("out 課 #1");
    let request = Request { out: Some(out.clone()), thesis, ..Request::new(vec![format]) };
    let mut ledger = Ledger::open(&out, Shard::WHOLE);
    lianpu::export::export(lesson, &request, &mut ledger, &|_| {}, &AtomicBool::new(false)).unwrap();
    out
}

fn job(lesson: &Lesson) -> Job {
    plan(lesson, &Request::new(vec![Format::Png])).unwrap().remove(0)
}

/// How far a picture of the browser is from ours: the mean over pixels of the channel that differs most, and how many
/// pixels differ by more than an edge that is half a pixel off makes them.
fn difference(ours: &Picture, png: &[u8]) -> (f64, usize) {
    let theirs = image::load_from_memory_with_format(png, image::ImageFormat::Png).unwrap().to_rgba8();
    assert_eq!(theirs.dimensions(), (SIZE[0], SIZE[1]));
    let (mut sum, mut far) = (0_u64, 0);
    for (x, y, pixel) in theirs.enumerate_pixels() {
        let own = ours[(x as usize, y as usize)];
        let most = own.iter().zip(pixel.0).map(|(a, b)| a.abs_diff(b)).max().unwrap();
        sum += u64::from(most);
        far += usize::from(most > 96);
    }
    (sum as f64 / f64::from(SIZE[0] * SIZE[1]), far)
}

/// Another rasteriser smooths edges a little otherwise, and a mouth may be half a pixel off.
fn are_alike((mean, far): (f64, usize)) -> bool {
    mean < 0.4 && far < 12
}

fn assert_alike(ours: &Picture, png: &[u8], what: &str) {
    let (mean, far) = difference(ours, png);
    assert!(are_alike((mean, far)), "{what}: {mean:.3} on average, {far} pixels far off");
}

/// Some frames of a clip, the first, the middle one and the last among them.
fn some(count: u32) -> impl Iterator<Item = u32> {
    [0, count / 5, count / 3, count / 2, count * 3 / 4, count - 1].into_iter()
}

fn number(tab: &mut Tab<'_>, expression: &str) -> f64 {
    tab.eval(expression).as_f64().unwrap_or_else(|| panic!("no number: {expression}"))
}

/// One after the other: pages that are played at once take the time from each other.
#[test]
#[cfg_attr(not(has_chromium), ignore = "needs Chromium")]
fn lessons_play_in_a_real_browser() {
    let Some(mut browser) = Chromium::start() else { return };
    let (folder, lesson) = lesson();
    the_page_plays_as_its_reader_wants(&mut browser, folder.path(), &lesson);
    animated_svg_shows_what_the_frames_show(&mut browser, folder.path(), &lesson);
    lottie_shows_what_the_frames_show(&mut browser, folder.path(), &lesson);
}

fn the_page_plays_as_its_reader_wants(browser: &mut Chromium, folder: &Path, lesson: &Lesson) {
    let page = export(folder, lesson, Format::Html, false).join("lesson.html");
    let mut tab = browser.open(&page, [1000, 700]);
    tab.wait("document.documentElement.dataset.ready === 'yes'");
    // The canvas as large as the frames, so that they can be compared.
    tab.eval("document.querySelector('.picture').style.cssText += ';width:640px;border:0'");
    tab.wait("document.querySelector('canvas').width === 640");
    let job = job(lesson);
    let mut painter = Painter::new(SIZE[0], SIZE[1]).unwrap();
    for frame in some(job.count) {
        let place = format!(
            "(() => {{ const s = document.getElementById('seek'); s.value = {}; s.oninput({{ target: s }}); \
             return document.querySelector('canvas').toDataURL().split(',')[1]; }})()",
            f64::from(frame) / 25.0
        );
        let seen = from_base64(tab.eval(&place).as_str().unwrap());
        assert_alike(&painter.paint(&job.drawing(frame)), &seen, &format!("frame {frame}"));
        if frame == job.count / 2 {
            let other = difference(&painter.paint(&job.drawing(0)), &seen);
            assert!(!are_alike(other), "an open mouth is not a closed one");
        }
    }
    plays(&mut tab);
    keys(&mut tab);
    is_told(&mut tab);
    silent_clip(&mut tab);
    broken_sound(&mut tab);
    assert!(tab.faults.is_empty(), "{:?}", tab.faults);
    // Data of the page itself are no requests to anyone.
    let outside: Vec<&String> = tab.requests.iter().filter(|r| !r.starts_with("data:")).collect();
    assert_eq!(outside.len(), 1, "{outside:?}");
}

const PLAYING: &str = "document.documentElement.classList.contains('playing')";

/// Speed 0.5, from the beginning to the end: the mouth goes with the sound, and so does the light on the script.
fn plays(tab: &mut Tab<'_>) {
    tab.eval(
        "(() => { const s = document.getElementById('speed'); s.value = 0.5; s.oninput({ target: s }); \
         const seek = document.getElementById('seek'); seek.value = 0; seek.oninput({ target: seek }); \
         window.heard = []; const a = document.querySelector('audio'), c = document.querySelector('canvas'); \
         const look = () => { requestAnimationFrame(look); if (a.paused) return; \
           const lit = document.querySelector('.lit'); \
           heard.push([a.currentTime, +c.dataset.frame, lit ? +lit.dataset.from : -1, lit ? +lit.dataset.to : -1]); }; \
         look(); return true; })()",
    );
    tab.key(" ");
    tab.wait(PLAYING);
    tab.wait("document.querySelector('audio').currentTime > 0.3");
    assert_eq!(tab.eval("document.querySelector('audio').playbackRate"), 0.5);
    assert_eq!(tab.eval("document.querySelector('audio').preservesPitch"), true);
    tab.wait(&format!("!{PLAYING}"));
    let heard = tab.eval("heard");
    let rows: Vec<[f64; 4]> = serde_json::from_value(heard).unwrap();
    assert!(rows.len() > 10, "{} looks", rows.len());
    // A machine that is busy with other tests leaves frames out: the middle one counts.
    let mut apart: Vec<f64> = rows.iter().map(|r| (r[1] / 25.0 - r[0]).abs()).collect();
    apart.sort_by(f64::total_cmp);
    assert!(apart[apart.len() / 2] < 0.025, "mouth and sound are {:.3} s apart", apart[apart.len() / 2]);
    let lit: Vec<&[f64; 4]> = rows.iter().filter(|r| r[2] >= 0.0).collect();
    let right = lit.iter().filter(|r| r[0] > r[2] - 0.1 && r[0] < r[3] + 0.1).count();
    assert!(lit.len() > 5 && right * 10 >= lit.len() * 9, "{right} of {} lights at their time", lit.len());
    let mut lights: Vec<u64> = lit.iter().map(|r| r[2].to_bits()).collect();
    lights.dedup();
    assert_eq!(lights.len(), 2, "two syllables, one after the other");
}

fn keys(tab: &mut Tab<'_>) {
    let class = "document.documentElement.className";
    assert!(tab.eval(class).as_str().unwrap().contains("show-pinyin"));
    tab.key("r");
    assert!(tab.eval(class).as_str().unwrap().contains("show-zhuyin"));
    assert_eq!(tab.eval("getComputedStyle(document.querySelector('rt.pinyin')).display"), "none");
    assert_ne!(tab.eval("getComputedStyle(document.querySelector('rt.zhuyin')).display"), "none");
    tab.key("]");
    assert_eq!(tab.eval("document.getElementById('rate').textContent"), "0.55×");
    tab.key("[");
    // A syllable is said, and then it is still again.
    tab.key(",");
    tab.wait(PLAYING);
    tab.wait(&format!("!{PLAYING}"));
    let ends = "[...document.querySelectorAll('[data-to]')].map(e => +e.dataset.to)";
    let rest = number(
        tab,
        &format!("Math.min(...{ends}.map(t => Math.abs(t - document.querySelector('audio').currentTime)))"),
    );
    assert!(rest < 0.05, "it rests {rest} s from the end of a syllable");
    // The mouth alone, at once where motion is to be little.
    let picture = "document.querySelector('canvas').toDataURL()";
    let whole = tab.eval(picture);
    tab.prefer("prefers-reduced-motion", "reduce");
    tab.key("m");
    let close = tab.eval(picture);
    assert_ne!(close, whole);
    tab.key("m");
    assert_eq!(tab.eval(picture), whole);
    // A sentence that is repeated begins again.
    tab.eval(
        "(() => { const s = document.getElementById('speed'); s.value = 1; s.oninput({ target: s }); return true; })()",
    );
    tab.key("l");
    tab.eval("window.turns = 0; document.querySelector('audio').addEventListener('seeking', () => turns++); true");
    tab.key(" ");
    tab.wait("turns > 0");
    assert_eq!(tab.eval(PLAYING), true);
    tab.key("l");
    tab.key(" ");
    tab.wait(&format!("!{PLAYING}"));
}

fn is_told(tab: &mut Tab<'_>) {
    let told = tab.told();
    let has = |role: &str, name: &str| told.iter().any(|(r, n)| r == role && n.contains(name));
    for (role, name) in [
        ("button", "Play"),
        ("slider", "Place in the clip"),
        ("slider", "Speed"),
        ("button", "Repeat sentence"),
        ("button", "Mouth"),
        ("combobox", "Reading"),
        ("button", "Play sentence 1"),
        ("heading", "您好"),
        ("image", "您好"),
    ] {
        assert!(has(role, name), "no {role} {name}: {told:?}");
    }
    let plays = told.iter().filter(|(r, n)| r == "button" && n == "Play").count();
    assert_eq!(plays, 1, "the picture's own button is for the mouse alone");
}

fn silent_clip(tab: &mut Tab<'_>) {
    tab.eval("document.querySelectorAll('nav button')[1].click()");
    tab.wait("document.getElementById('seek').max === '1'");
    assert_eq!(tab.eval("document.getElementById('said-1').innerText.trim()"), "Nothing is said in this clip.");
    tab.key(" ");
    tab.wait("+document.querySelector('canvas').dataset.frame > 3");
    tab.wait(&format!("!{PLAYING}"));
    assert_eq!(tab.eval("document.querySelector('canvas').dataset.frame"), "24");
    tab.eval("document.querySelectorAll('nav button')[0].click()");
    tab.wait("document.getElementById('said-1').hidden");
}

fn broken_sound(tab: &mut Tab<'_>) {
    assert_eq!(tab.eval("document.getElementById('notice').textContent"), "");
    tab.eval("document.querySelector('audio').src = 'data:audio/mpeg;base64,AAAA'; true");
    tab.wait("document.getElementById('notice').textContent.includes('cannot play the sound')");
    tab.key(" ");
    tab.wait("+document.querySelector('canvas').dataset.frame > 3");
    tab.key(" ");
}

fn animated_svg_shows_what_the_frames_show(browser: &mut Chromium, folder: &Path, lesson: &Lesson) {
    let job = job(lesson);
    let mut painter = Painter::new(SIZE[0], SIZE[1]).unwrap();
    for thesis in [false, true] {
        let file = export(folder, lesson, Format::Smil, thesis).join("你好.svg");
        let mut tab = browser.open(&file, SIZE);
        // It waits for its sound, whose player lies over the picture.
        tab.eval("document.querySelector('foreignObject').style.display = 'none'; true");
        assert_eq!(tab.eval("document.documentElement.animationsPaused()"), true);
        for frame in some(job.count) {
            tab.eval(&format!("document.documentElement.setCurrentTime({}); true", (f64::from(frame) + 0.25) / 25.0));
            let what = format!("frame {frame} of {}", file.display());
            assert_alike(&painter.paint(&job.drawing(frame)), &tab.seen(), &what);
        }
        // Its clock goes with the sound.
        tab.eval(
            "document.querySelector('audio').currentTime = 0; document.querySelector('audio').play().then(() => true)",
        );
        tab.wait("document.querySelector('audio').currentTime > 0.3");
        let apart = number(
            &mut tab,
            "new Promise(r => requestAnimationFrame(() => { const svg = document.documentElement; \
             r(Math.abs(svg.getCurrentTime() - document.querySelector('audio').currentTime - 0.02)); }))",
        );
        assert!(apart < 0.06, "picture and sound are {apart:.3} s apart");
        assert!(tab.faults.is_empty(), "{:?}", tab.faults);
    }
}

fn lottie_shows_what_the_frames_show(browser: &mut Chromium, folder: &Path, lesson: &Lesson) {
    let Some(player) = std::env::var_os("LIANPU_LOTTIE_WEB") else {
        println!("LIANPU_LOTTIE_WEB does not name lottie.min.js: no Lottie was played");
        return;
    };
    let player = std::fs::read_to_string(player).unwrap();
    let out = export(folder, lesson, Format::Lottie, false);
    let job = job(lesson);
    let mut painter = Painter::new(SIZE[0], SIZE[1]).unwrap();
    let data = std::fs::read_to_string(out.join("你好.json")).unwrap().replace('<', "\\u003c");
    for renderer in ["svg", "canvas"] {
        let page = out.join(format!("{renderer}.html"));
        let text = format!(
            "<!DOCTYPE html><meta charset=\"utf-8\"><body style=\"margin:0\"><div id=\"a\" style=\"width:640px;height:360px\">\
             </div><script>{player}</script><script>var player = lottie.loadAnimation({{ container: a, renderer: \
             '{renderer}', loop: false, autoplay: false, animationData: {data} }});</script>"
        );
        std::fs::write(&page, text).unwrap();
        let mut tab = browser.open(&page, SIZE);
        tab.wait("player.isLoaded");
        assert_eq!(tab.eval("player.totalFrames"), job.count);
        for frame in some(job.count) {
            tab.eval(&format!("player.goToAndStop({frame}, true); true"));
            assert_alike(&painter.paint(&job.drawing(frame)), &tab.seen(), &format!("frame {frame} by {renderer}"));
        }
        assert!(tab.faults.is_empty(), "{:?}", tab.faults);
    }
}
