//! A clip as one animated SVG: every pose of every part once, and one `<use>` a part that is switched from pose to pose
//! (thesis 7.3.2). Written the thesis's way instead, every frame is a hidden group that is shown for its time.
//!
//! SVG's own `<audio>` is played by no browser of today: sound is XHTML in a `foreignObject`, and a few lines of script
//! set the picture's clock by it. Without sound there is no script, and the picture plays wherever SVG is animated.

use std::collections::HashMap;
use std::fmt::Write;

use super::sound::Encoded;
use super::svg_marks::{Defs, short_name, write_marks};
use super::{escaped, svg_marks};
use crate::forms::parts::{Move, Part, Parts};

/// How far picture and sound may part before the picture is set right, in seconds.
const APART: f64 = 0.01;

/// What an animated SVG says beside its picture.
pub(crate) struct Words<'a> {
    /// What it is.
    pub title: &'a str,
    /// What is said in it.
    pub description: &'a str,
}

/// The animated SVG of a clip.
pub(crate) fn animated(parts: &Parts, words: &Words<'_>, sound: Option<&Encoded>) -> String {
    let mut defs = Defs::with_classes();
    let (mut poses, mut scene) = (String::new(), String::new());
    // A letter a part: its poses are named thousands of times.
    let mut letter = 0;
    for sheet in &parts.sheets {
        let moved = begin_moves(&mut scene, &sheet.moves, parts);
        for part in &sheet.parts {
            let _ = write!(scene, "<g id=\"{}\">", part.name);
            if part.is_still() {
                write_marks(&mut scene, part.marks(0), &mut defs);
            } else {
                let prefix = short_name(letter);
                letter += 1;
                let names = write_poses(&mut poses, part, &prefix, &mut defs);
                write_use(&mut scene, part, &names, parts);
            }
            scene.push_str("</g>\n");
        }
        scene.push_str(&"</g>".repeat(moved));
    }
    let mut out = head(parts, words);
    let _ = write!(out, "<style>{}</style>\n<defs>\n{poses}{}</defs>\n", defs.style(), defs.text);
    out.push_str(&backdrop(parts));
    let _ = writeln!(out, "{}{scene}</g>", on_grid(parts));
    out.push_str(&sound_of(parts, sound));
    out.push_str("</svg>\n");
    out
}

/// The thesis's own form: what never changes, then a group a frame.
pub(crate) fn of_the_thesis(parts: &Parts, words: &Words<'_>, sound: Option<&Encoded>) -> String {
    let mut defs = Defs::with_classes();
    let (mut still, mut frames) = (String::new(), String::new());
    // What lies behind the first part that moves is there all the time; what lies before it is drawn in every frame.
    let all: Vec<(&[(u32, Move)], &Part)> =
        parts.sheets.iter().flat_map(|s| s.parts.iter().map(|p| (s.moves.as_slice(), p))).collect();
    let first = all.iter().position(|(moves, part)| moves.len() > 1 || !part.is_still()).unwrap_or(all.len());
    for (moves, part) in &all[..first] {
        let _ = write!(still, "<g{}>", transform(moves.first().map_or(Move::default(), |m| m.1)));
        write_marks(&mut still, part.marks(0), &mut defs);
        still.push_str("</g>\n");
    }
    let length = 1.0 / parts.fps;
    for frame in 0..parts.frames {
        let _ = write!(
            frames,
            "<g visibility=\"hidden\"><set attributeName=\"visibility\" from=\"hidden\" to=\"visible\" begin=\"{:.6}s\" dur=\"{length:.6}s\"{}/>",
            f64::from(frame) * length,
            // The last frame stays, as a film's does.
            if frame + 1 == parts.frames { " fill=\"freeze\"" } else { "" }
        );
        for (moves, part) in &all[first..] {
            let moved = transform(at(moves, frame).unwrap_or_default());
            if !moved.is_empty() {
                let _ = write!(frames, "<g{moved}>");
            }
            write_marks(&mut frames, part.marks(at(&part.runs, frame).unwrap_or_default()), &mut defs);
            if !moved.is_empty() {
                frames.push_str("</g>");
            }
        }
        frames.push_str("</g>\n");
    }
    let mut out = head(parts, words);
    let _ = write!(out, "<style>{}</style>\n<defs>\n{}\n</defs>\n{}", defs.style(), defs.text, backdrop(parts));
    let _ = write!(
        out,
        "{}<g id=\"static\">\n{still}</g>\n<g id=\"dynamic\">\n{frames}</g>\n</g>\n{}</svg>\n",
        on_grid(parts),
        sound_of(parts, sound)
    );
    out
}

/// What holds at a frame.
fn at<T: Copy>(runs: &[(u32, T)], frame: u32) -> Option<T> {
    runs.partition_point(|(from, _)| *from <= frame).checked_sub(1).map(|i| runs[i].1)
}

fn head(parts: &Parts, words: &Words<'_>) -> String {
    let [width, height] = parts.grid.size;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         role=\"img\" aria-labelledby=\"title description\">\n<title id=\"title\">{}</title>\n\
         <desc id=\"description\">{}</desc>\n",
        escaped(words.title),
        escaped(words.description)
    )
}

pub(crate) fn backdrop(parts: &Parts) -> String {
    match parts.background {
        Some(colour) => format!(
            "<path fill=\"{}\" d=\"M0 0h{}v{}H0z\"/>\n",
            svg_marks::short(colour),
            parts.grid.size[0],
            parts.grid.size[1]
        ),
        None => String::new(),
    }
}

/// Begins the group whose unit is the grid's.
pub(crate) fn on_grid(parts: &Parts) -> String {
    let [x, y] = parts.grid.origin.map(|v| (v * 1e4).round() / 1e4);
    format!("<g transform=\"translate({x} {y})scale(.125)\">\n")
}

/// Writes the poses of a part; says what each is called. Two that are written alike are one.
fn write_poses(out: &mut String, part: &Part, prefix: &str, defs: &mut Defs) -> Vec<String> {
    let mut known: HashMap<String, String> = HashMap::new();
    let name = |pose| {
        let mut marks = String::new();
        write_marks(&mut marks, part.marks(pose), defs);
        // What a pose refers to stands just before it, where a packer finds the like of it.
        out.push_str(&std::mem::take(&mut defs.text));
        if let Some(name) = known.get(&marks) {
            return name.clone();
        }
        let name = format!("{prefix}{}", known.len());
        let _ = writeln!(out, "<g id=\"{name}\">{marks}</g>");
        known.insert(marks, name.clone());
        name
    };
    (0..part.poses.len() as u32).map(name).collect()
}

fn write_use(out: &mut String, part: &Part, names: &[String], parts: &Parts) {
    let name = |pose: u32| names.get(pose as usize).map_or("", String::as_str);
    let _ =
        write!(out, "<use href=\"#{}\"><animate attributeName=\"href\"", name(part.runs.first().map_or(0, |r| r.1)));
    keys(out, &part.runs, parts, |pose| format!("#{}", name(*pose)));
    out.push_str("/></use>");
}

/// The key times and values of what holds from frame to frame.
fn keys<T>(out: &mut String, runs: &[(u32, T)], parts: &Parts, value: impl Fn(&T) -> String) {
    let seconds = f64::from(parts.frames) / parts.fps;
    let times: Vec<String> = runs.iter().map(|(frame, _)| share(*frame, parts.frames)).collect();
    let values: Vec<String> = runs.iter().map(|(_, v)| value(v)).collect();
    let _ = write!(
        out,
        " calcMode=\"discrete\" dur=\"{}s\" fill=\"freeze\" keyTimes=\"{}\" values=\"{}\"",
        (seconds * 1e6).round() / 1e6,
        times.join(";"),
        values.join(";")
    );
}

/// When a frame begins, as a share of the whole: never later than it does, and less than a tenth of a frame before.
fn share(frame: u32, of: u32) -> String {
    let digits = of.max(1).ilog10() as usize + 2;
    let part = u64::from(frame) * 10_u64.pow(digits as u32) / u64::from(of.max(1));
    if part == 0 {
        return "0".to_owned();
    }
    format!(".{part:0digits$}").trim_end_matches('0').to_owned()
}

fn turn(moved: Move) -> f64 {
    f64::from(moved.turn) / 1000.0
}

fn transform(moved: Move) -> String {
    if moved == Move::default() {
        return String::new();
    }
    format!(" transform=\"translate({} {})rotate({})\"", moved.x, moved.y, turn(moved))
}

/// Begins the groups that move what follows; says how many there are.
fn begin_moves(out: &mut String, moves: &[(u32, Move)], parts: &Parts) -> usize {
    match moves {
        [] => 0,
        [(_, one)] => {
            let fixed = transform(*one);
            if fixed.is_empty() {
                return 0;
            }
            let _ = write!(out, "<g{fixed}>");
            1
        }
        _ => {
            // A shift and a turn are animated apart: SVG animates no matrix.
            out.push_str("<g><animateTransform attributeName=\"transform\" type=\"translate\"");
            keys(out, moves, parts, |m| format!("{} {}", m.x, m.y));
            out.push_str("/><g><animateTransform attributeName=\"transform\" type=\"rotate\"");
            keys(out, moves, parts, |m| turn(*m).to_string());
            out.push_str("/>");
            2
        }
    }
}

/// The player of the sound, which is not seen where no script can tie it (in an image of a page), and what ties the picture's clock to it.
fn sound_of(parts: &Parts, sound: Option<&Encoded>) -> String {
    let Some(sound) = sound else { return String::new() };
    let [width, height] = parts.grid.size;
    let bar = 54.min(height);
    format!(
        "<foreignObject x=\"0\" y=\"{}\" width=\"{width}\" height=\"{bar}\">\
         <audio xmlns=\"http://www.w3.org/1999/xhtml\" controls=\"\" preload=\"auto\" \
         style=\"display:block;width:100%;height:{bar}px\" src=\"{}\"></audio></foreignObject>\n\
         <style>foreignObject{{visibility:hidden;transition:opacity .3s}}.heard foreignObject{{visibility:visible}}.playing foreignObject:not(:hover):not(:focus-within){{opacity:0}}</style>\n\
         <script><![CDATA[\n{}]]></script>\n",
        height - bar,
        super::base64::data_uri(sound.mime, &sound.bytes),
        TIE.replace("APART", &APART.to_string()).replace("AHEAD", &lead(parts.fps).to_string())
    )
}

/// How far a picture is ahead of its sound, in seconds: half a frame, so that the frame that is seen is the nearest to
/// what is heard, and neither behind it nor before it by more than that.
pub(crate) fn lead(fps: f64) -> f64 {
    (0.5 / fps * 1e4).round() / 1e4
}

/// The picture stands until the sound plays, goes by itself while it does, and is set right when they part.
const TIE: &str = r"(function () {
  var svg = document.documentElement, sound = svg.querySelector('audio');
  function wanted() { return sound.currentTime + (sound.paused ? 0 : AHEAD); }
  function set() { svg.setCurrentTime(wanted()); }
  function stop() { svg.pauseAnimations(); set(); svg.classList.remove('playing'); }
  function tie() {
    if (sound.paused) return;
    if (Math.abs(svg.getCurrentTime() - wanted()) > APART) set();
    requestAnimationFrame(tie);
  }
  svg.classList.add('heard');
  svg.pauseAnimations();
  svg.setCurrentTime(0);
  sound.addEventListener('playing', function () {
    set(); svg.unpauseAnimations(); svg.classList.add('playing'); tie();
  });
  ['pause', 'ended', 'seeking', 'seeked', 'waiting'].forEach(function (name) {
    sound.addEventListener(name, function () { if (name === 'seeking' || name === 'seeked') set(); else stop(); });
  });
  var at = /[#&]t=([0-9.]+)/.exec(location.hash);
  if (at) { sound.currentTime = +at[1]; svg.setCurrentTime(+at[1]); }
})();
";
