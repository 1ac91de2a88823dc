//! Roughly when each unit is said: the best way through the script in steps of 10 ms, with a beam. Its cost grows with
//! the length of the recording, not with its square.

use std::ops::Range;

use super::search::{Search, Section, Way};
use super::units::{ANY, UNITS};

/// Frames in a step.
pub(crate) const STEP: usize = 2;

/// Ways that lie so far behind the best are given up. Scores are in units of the search.
const BEAM: f32 = 250.0;

/// So many places in the script are looked at once at most: some 80 syllables, a quarter of a minute of speech.
const WIDEST: usize = 512;

const NEVER: f32 = f32::NEG_INFINITY;

/// A place of the way: a unit, or what may lie before a syllable.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Pause,
    Other,
    Unit(usize),
}

/// A place and the ways into it: how many places back, and the cost.
struct Step {
    place: Place,
    ways: Vec<(usize, f32)>,
}

/// The best way through a section: within `width` frames of `near`, or of a rough way where there is none.
pub(super) fn way(search: &Search<'_>, section: &Section, near: Option<&[(usize, usize)]>, width: usize) -> Way {
    match near {
        Some(near) => search.way(section, near, width),
        None => search.way(section, &about(search, section), width),
    }
}

/// A rough way through a section; everything one after the other where that is lost.
pub(super) fn about(search: &Search<'_>, section: &Section) -> Vec<(usize, usize)> {
    roughly(search, section).map_or_else(|| search.spread(section), |rough| rough.0)
}

/// For each link of the section the frames in which it begins and ends, roughly; a syllable that is not heard has no
/// length. None where the beam lost the way.
pub(super) fn roughly(search: &Search<'_>, section: &Section) -> Option<(Vec<(usize, usize)>, f64)> {
    let steps = steps(search, section);
    let count = (section.to - section.from) / STEP;
    if count == 0 {
        return None;
    }
    let beam = Beam::run(search, section, &steps, count);
    // From the end, back.
    let ends = steps.len() - 1..steps.len();
    let last_unit = steps.len() - 4;
    let candidates = (steps.len() - 3..ends.end).chain([last_unit]);
    let scores = &beam.scores;
    let last = candidates.filter(|p| beam.alive.contains(p)).max_by(|a, b| scores[*a].total_cmp(&scores[*b]))?;
    if scores[last] == NEVER {
        return None;
    }
    let score = beam.score + f64::from(scores[last]);
    let links = search.chain.syllables[section.first].start..search.chain.syllables[section.last - 1].end;
    let found = beam.traced(section, &steps, last, links)?;
    // What was passed over lies where the next thing begins.
    let mut next = section.to;
    let mut out: Vec<(usize, usize)> = found
        .into_iter()
        .rev()
        .map(|entry| {
            let entry = entry.unwrap_or((next, next));
            next = entry.0;
            entry
        })
        .collect();
    out.reverse();
    Some((out, score))
}

/// A Viterbi search with a beam: only the places whose score is near the best go on.
struct Beam {
    /// The ways taken at each step, for the places in its window.
    taken: Vec<u8>,
    /// For each step the first place of its window, and where that begins in `taken`.
    windows: Vec<(usize, usize)>,
    /// The places that the beam still has at the end.
    alive: Range<usize>,
    /// The score of each place at the end, less `score`.
    scores: Vec<f32>,
    /// The sum of what the best place of each step scored.
    score: f64,
}

impl Beam {
    fn run(search: &Search<'_>, section: &Section, steps: &[Step], count: usize) -> Self {
        let rows = |link: usize| match search.chain.links[link].unit {
            ANY => 1,
            unit => search.rows[usize::from(unit)],
        };
        let beside = vec![search.beside; section.to];
        let row_of: Vec<&[f32]> = steps
            .iter()
            .map(|s| match s.place {
                Place::Pause => &search.scores[0][..],
                Place::Other => &beside,
                Place::Unit(link) => &search.scores[rows(link)][..],
            })
            .collect();
        let mut before = vec![NEVER; steps.len()];
        let mut now = vec![NEVER; steps.len()];
        let mut taken = Vec::new();
        let mut windows = Vec::with_capacity(count);
        // Into the first place comes everything that can begin.
        let (mut low, mut high) = (0, 1);
        let reach = steps.iter().flat_map(|s| s.ways.iter().map(|w| w.0)).max().unwrap_or(1);
        let mut score = 0.0;
        for t in 0..count {
            let frame = section.from + t * STEP;
            let to = (high + reach).min(steps.len());
            windows.push((low, taken.len()));
            let mut best = NEVER;
            for place in low..to {
                let (mut value, way) = match t {
                    0 => (steps[place].begins(place), u8::MAX),
                    _ => steps[place].best_way(place, low, &before),
                };
                let row = row_of[place];
                value += row[frame] + row[frame + 1];
                now[place] = value;
                best = best.max(value);
                taken.push(way);
            }
            score += f64::from(best);
            let (first, last) = kept(&now, low..to, best);
            for value in &mut now[first..last] {
                *value -= best;
            }
            now[low..first].fill(NEVER);
            now[last..to].fill(NEVER);
            before[low..high].fill(NEVER);
            (low, high) = (first, last);
            std::mem::swap(&mut before, &mut now);
        }
        Self { taken, windows, alive: low..high, scores: before, score }
    }

    /// The frames in which each link begins and ends, on the way that ends at the place `last`; none where the way passes
    /// it over.
    fn traced(
        &self,
        section: &Section,
        steps: &[Step],
        last: usize,
        links: Range<usize>,
    ) -> Option<Vec<Option<(usize, usize)>>> {
        let mut place = last;
        let mut found: Vec<Option<(usize, usize)>> = vec![None; links.len()];
        for (t, (window, at)) in self.windows.iter().enumerate().rev() {
            let frame = section.from + t * STEP;
            if let Place::Unit(link) = steps[place].place {
                let entry = found[link - links.start].get_or_insert((frame, frame + STEP));
                entry.0 = frame;
            }
            let way = usize::from(self.taken[at + place - window]);
            if t > 0 {
                place -= steps[place].ways.get(way)?.0;
            }
        }
        Some(found)
    }
}

impl Step {
    /// The score of beginning at this step, which is the place `place`.
    fn begins(&self, place: usize) -> f32 {
        if place == 0 || self.ways.iter().any(|w| w.0 == place + 1) { 0.0 } else { NEVER }
    }

    /// The best score with which this step, the place `place`, is entered from the places from `low` on, and the number of
    /// the way.
    fn best_way(&self, place: usize, low: usize, before: &[f32]) -> (f32, u8) {
        let (mut value, mut way) = (NEVER, u8::MAX);
        for (number, (back, cost)) in self.ways.iter().enumerate() {
            if *back + low <= place && *back <= place {
                let candidate = before[place - back] + cost;
                if candidate > value {
                    (value, way) = (candidate, number as u8);
                }
            }
        }
        (value, way)
    }
}

/// The places of a window that go on: what is too far behind falls out at either side.
fn kept(now: &[f32], window: Range<usize>, best: f32) -> (usize, usize) {
    let alive = |p: &usize| now[*p] > best - BEAM;
    let mut first = window.clone().find(alive).unwrap_or(window.start);
    let mut last = window.clone().rev().find(alive).unwrap_or(window.start) + 1;
    while last - first > WIDEST {
        if now[first] < now[last - 1] { first += 1 } else { last -= 1 }
    }
    (first, last)
}

fn steps(search: &Search<'_>, section: &Section) -> Vec<Step> {
    let (chain, rate, costs) = (search.chain, search.rate, &search.costs);
    let mut steps: Vec<Step> = Vec::new();
    // The last unit of each syllable, and where the places before it begin.
    let mut lasts: Vec<usize> = Vec::new();
    let mut gaps: Vec<usize> = Vec::new();
    // The logarithms of going on and of leaving, for a unit that usually lasts so long.
    let leave = |link: usize| {
        let usual = UNITS[usize::from(chain.links[link].unit)].usual * rate / (1000.0 / 200.0) / STEP as f32;
        let share = 1.0 / usual.max(1.25);
        ((1.0 - share).ln(), share.ln())
    };
    let mut left = 0.0;
    for syllable in section.first..=section.last {
        let gap = steps.len();
        let entered = left;
        let from_last = move |offset: usize, cost: f32, lasts: &[usize]| {
            // One place beyond the start stands for where everything begins.
            lasts.last().map_or((gap + offset + 1, cost), |last| (gap + offset - last, cost + entered))
        };
        let pause_cost = if lasts.is_empty() || syllable == section.last { 0.0 } else { -costs.pause };
        // Of the syllable before this gap.
        let skip = if syllable > section.first { search.skip(chain.syllables[syllable - 1].clone()) } else { 0.0 };
        let skipped = |offset: usize, gaps: &[usize]| gaps.last().map(|g| (gap - g, -skip)).filter(|_| offset < 3);
        let mut pause = vec![(0, 0.0), from_last(0, pause_cost, &lasts)];
        pause.extend(skipped(0, &gaps));
        steps.push(Step { place: Place::Pause, ways: pause });
        let mut other = vec![(0, 0.0), from_last(1, -costs.other, &lasts), (1, -costs.other)];
        other.extend(skipped(1, &gaps));
        steps.push(Step { place: Place::Other, ways: other });
        let mut pause = vec![(0, 0.0), (1, 0.0)];
        pause.extend(skipped(2, &gaps));
        steps.push(Step { place: Place::Pause, ways: pause });
        if syllable == section.last {
            break;
        }
        for (number, link) in chain.syllables[syllable].clone().enumerate() {
            let at = steps.len();
            let (stay, go) = leave(link);
            let mut ways = vec![(0, stay)];
            if number == 0 {
                ways.extend([(1, 0.0), (2, 0.0), (3, 0.0), from_last(3, 0.0, &lasts)]);
                if let Some(before) = lasts.len().checked_sub(2).map(|i| lasts[i]) {
                    ways.push((at - before, -skip - 3.0));
                }
            } else {
                ways.push((1, left));
            }
            steps.push(Step { place: Place::Unit(link), ways });
            left = go;
        }
        lasts.push(steps.len() - 1);
        gaps.push(gap);
    }
    steps
}
