//! The parts of a face apart: which items of a figure change together, each pose of each part once, and which pose is
//! seen when. It is what animated SVG, the player, Lottie and layered SVG are made of.
//!
//! Nothing here knows a figure: parts are found from the drawings of all frames. A lesson of four minutes has some
//! thousand frames, but only some hundred mouths and some dozen eyes.

mod alike;
mod mark;
mod split;
mod survey;

use std::collections::HashMap;
use std::sync::Arc;

pub(crate) use mark::{Mark, Path, STEPS};
pub(crate) use survey::{ABSENT, Move};
use survey::{Survey, Tracked};

use alike::Looks;

use super::rounded;
use crate::drawing::{Colour, Drawing, fit};
use crate::figure::Figure;
use crate::geometry::Rect;
use crate::pose::Pose;
use crate::timeline::Timeline;

/// Looks of an item that are within so many steps of the grid of each other are one: an eighth of a pixel.
const ONE_LOOK: i32 = 1;

/// Poses of a part likewise, the first of these that makes it small: an eighth, or three. Together half a pixel at most,
/// where a curve is drawn whose edge is a pixel wide; of a long lesson's mouths four times as many would be written
/// without it.
const ONE_POSE: [i32; 2] = [1, 3];

/// Bytes of the poses of a small part.
const SMALL: u64 = 24_000;

/// Where the grid of the parts lies in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    /// Pixels of the whole picture.
    pub size: [u32; 2],
    /// The pixels at which the grid's origin lies.
    pub origin: [f64; 2],
    /// Steps of the grid in a unit of the figure.
    pub scale: f64,
}

impl Grid {
    /// The grid of a figure that is fitted whole into a picture.
    pub(crate) fn new(view: Rect, size: [u32; 2]) -> Self {
        let frame = Rect::new(0.0, 0.0, f64::from(size[0]), f64::from(size[1]));
        let [scale, _, _, _, x, y] = fit(view, frame).as_coeffs();
        Self { size, origin: [x, y], scale: scale * STEPS }
    }
}

/// A figure in parts, over all frames of a clip.
#[derive(Debug)]
pub(crate) struct Parts {
    /// Where everything lies.
    pub grid: Grid,
    /// What lies behind everything, also beyond the figure; none is transparent.
    pub background: Option<Colour>,
    /// How many frames there are, at least one.
    pub frames: u32,
    /// Frames a second.
    pub fps: f64,
    /// The box on the grid in which lips, teeth and tongue are seen, over all frames: left, top, right, bottom.
    pub mouth: Option<[i32; 4]>,
    /// Back to front.
    pub sheets: Vec<Sheet>,
}

/// Parts that move together.
#[derive(Debug)]
pub(crate) struct Sheet {
    /// From which frame on they are moved how; a single one that is no move where they rest.
    pub moves: Vec<(u32, Move)>,
    /// Back to front.
    pub parts: Vec<Part>,
}

/// Items that change together.
#[derive(Debug)]
pub(crate) struct Part {
    /// What it is, in a word; no two have the same.
    pub name: String,
    /// The different looks, in the order they are first seen. One of no marks is nothing.
    pub poses: Vec<Looks>,
    /// The same item by item, for forms in which items are apart.
    pub items: Vec<OneItem>,
    /// From which frame on which of them is seen.
    pub runs: Vec<(u32, u32)>,
}

/// An item of a part.
#[derive(Debug)]
pub(crate) struct OneItem {
    /// What the figure calls it.
    pub name: String,
    /// Its different looks.
    pub states: Vec<Arc<[Mark]>>,
    /// Which of them it has in each pose of the part; [`ABSENT`] where it is not there.
    pub at: Vec<u32>,
}

impl Part {
    /// The marks of a pose, back to front.
    pub(crate) fn marks(&self, pose: u32) -> impl Iterator<Item = &Mark> {
        self.poses.get(pose as usize).into_iter().flatten().flat_map(|marks| marks.iter())
    }

    /// Whether it looks the same in every frame.
    pub(crate) fn is_still(&self) -> bool {
        self.runs.len() <= 1
    }
}

/// A clip's poses, frame by frame; at least one.
fn poses(timeline: &Timeline) -> impl Iterator<Item = Pose> + '_ {
    (0..timeline.frames().max(1)).map(|frame| timeline.pose(timeline.time_of(frame)))
}

/// All items of a figure over some poses. Looks within `near` steps of the grid of each other are one.
fn survey(figure: &Figure, poses: impl Iterator<Item = Pose>, grid: &Grid, near: i32) -> Survey {
    let mut survey = Survey::new(grid.scale, near);
    let mut last: Option<Pose> = None;
    for pose in poses {
        // As frames show it; the shape is a name, and not drawn.
        let bare = Pose { shape: None, ..rounded(&pose) };
        if last.as_ref() == Some(&bare) {
            survey.repeat();
        } else {
            survey.take(&figure.draw(&bare));
            last = Some(bare);
        }
    }
    survey
}

/// A figure's parts over all frames of its clip. `background` is instead of the figure's own.
pub(crate) fn parts(figure: &Figure, timeline: &Timeline, size: [u32; 2], background: Option<Option<Colour>>) -> Parts {
    Parts { fps: timeline.fps(), ..of_poses(figure, poses(timeline), size, background) }
}

/// A figure's parts over some poses, one a second.
pub(crate) fn of_poses(
    figure: &Figure,
    poses: impl Iterator<Item = Pose>,
    size: [u32; 2],
    background: Option<Option<Colour>>,
) -> Parts {
    let first: Drawing = figure.draw(&Pose::default());
    let grid = Grid::new(first.view, size);
    let survey = survey(figure, poses, &grid, ONE_LOOK);
    let frames = survey.frames;
    let (items, moves) = survey.done();
    Parts {
        grid,
        background: background.unwrap_or(first.background),
        frames: frames as u32,
        fps: 1.0,
        mouth: mouth_box(&items),
        sheets: sheets(&items, &moves, frames),
    }
}

/// The items cut into parts, and parts that move together put together.
fn sheets(items: &[Tracked], moves: &[Move], frames: usize) -> Vec<Sheet> {
    let mut sheets: Vec<Sheet> = Vec::new();
    let mut names = HashMap::new();
    for range in split::split(items, frames) {
        let own = &items[range];
        let moved = moves_of(own, moves, frames);
        let part = part_of(own, frames, &mut names);
        match sheets.last_mut() {
            Some(sheet) if sheet.moves == moved => sheet.parts.push(part),
            _ => sheets.push(Sheet { moves: moved, parts: vec![part] }),
        }
    }
    sheets
}

/// What of a figure is its mouth.
const MOUTH: [&str; 4] = ["lip", "mouth", "teeth", "tongue"];

fn mouth_box(items: &[Tracked]) -> Option<[i32; 4]> {
    let own = items.iter().filter(|i| MOUTH.iter().any(|word| i.name.contains(word)));
    let mut seen: Option<[i32; 4]> = None;
    for [x, y] in own.flat_map(|i| i.states.iter()).flat_map(|marks| marks.iter()).flat_map(Mark::outer_points) {
        let [a, b, c, d] = seen.unwrap_or([*x, *y, *x, *y]);
        seen = Some([a.min(*x), b.min(*y), c.max(*x), d.max(*y)]);
    }
    seen
}

fn moves_of(items: &[Tracked], moves: &[Move], frames: usize) -> Vec<(u32, Move)> {
    let mut runs: Vec<(u32, Move)> = Vec::new();
    for frame in 0..frames {
        let there = items.iter().map(|i| i.moved[frame]).find(|m| *m != ABSENT);
        // A part that is not seen may stay where it is.
        let Some(moved) = there.and_then(|m| moves.get(m as usize)) else { continue };
        match runs.last() {
            None => runs.push((0, *moved)),
            Some((_, last)) if last != moved => runs.push((frame as u32, *moved)),
            Some(_) => {}
        }
    }
    if runs.is_empty() {
        runs.push((0, Move::default()));
    }
    runs
}

fn part_of(items: &[Tracked], frames: usize, names: &mut HashMap<String, u32>) -> Part {
    // What is seen when, before any pose stands for another.
    let mut known: HashMap<Vec<u32>, usize> = HashMap::new();
    let mut all: Vec<Vec<u32>> = Vec::new();
    let mut seen: Vec<usize> = Vec::with_capacity(frames);
    for frame in 0..frames {
        let key: Vec<u32> = items.iter().map(|i| i.at[frame]).collect();
        seen.push(*known.entry(key).or_insert_with_key(|key| {
            all.push(key.clone());
            all.len() - 1
        }));
    }
    let looks = |key: &Vec<u32>| -> Looks {
        let there = items.iter().zip(key).filter_map(|(i, at)| i.states.get(*at as usize).cloned());
        there.filter(|marks| !marks.is_empty()).collect()
    };
    let distinct: Vec<Looks> = all.iter().map(looks).collect();
    let mut stands = Vec::new();
    for steps in ONE_POSE {
        stands = alike::standing_for(&distinct, steps);
        let own = distinct.iter().enumerate().filter(|(i, _)| stands[*i] == *i);
        let weight: u64 = own.flat_map(|(_, looks)| looks.iter()).flat_map(|l| l.iter()).map(Mark::weight).sum();
        if weight <= SMALL {
            break;
        }
    }
    let mut numbers: HashMap<usize, u32> = HashMap::new();
    let mut poses = Vec::new();
    let one = |i: &Tracked| OneItem { name: i.name.clone(), states: i.states.clone(), at: Vec::new() };
    let mut own: Vec<OneItem> = items.iter().map(one).collect();
    let mut runs: Vec<(u32, u32)> = Vec::new();
    for (frame, seen) in seen.iter().enumerate() {
        let pose = *numbers.entry(stands[*seen]).or_insert_with_key(|of| {
            poses.push(distinct[*of].clone());
            own.iter_mut().zip(&all[*of]).for_each(|(item, at)| item.at.push(*at));
            poses.len() as u32 - 1
        });
        if runs.last().is_none_or(|(_, last)| *last != pose) {
            runs.push((frame as u32, pose));
        }
    }
    let what = called(items);
    let times = names.entry(what.to_owned()).or_insert(0);
    *times += 1;
    let name = if *times == 1 { what.to_owned() } else { format!("{what}-{times}") };
    Part { name, poses, items: own, runs }
}

/// A word for what changes in a part.
fn called(items: &[Tracked]) -> &'static str {
    const WORDS: [(&str, &[&str]); 5] = [
        ("mouth", &MOUTH),
        ("eyes", &["eye", "lid", "iris", "pupil"]),
        ("brows", &["brow"]),
        ("jaw", &["jaw", "chin", "contour", "lower", "beard", "fold"]),
        ("head", &["hair", "head", "ear", "face"]),
    ];
    let changing = || items.iter().filter(|i| i.at.windows(2).any(|w| w[0] != w[1]));
    if changing().next().is_none() {
        return "still";
    }
    let counts = WORDS.map(|(word, signs)| {
        let is = |i: &&Tracked| signs.iter().any(|s| i.name.contains(s));
        (changing().filter(is).map(|i| i.states.len()).sum::<usize>(), word)
    });
    // The first of the greatest.
    let best = counts.into_iter().fold((0, "face"), |best, next| if next.0 > best.0 { next } else { best });
    best.1
}
