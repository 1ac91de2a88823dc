//! The best way through a recording and its script: each unit has a beginning and an end, as likely as the sound between
//! them and how long it lasts; before every syllable there may be a pause, or something that is not in the script, and a
//! syllable may be missing. Semi-Markov Viterbi, within bands about a first rough way.

use std::ops::Range;

use super::chain::Chain;
use super::features::FRAMES;
use super::lasting::Lasting;
use super::reach::{Band, NEVER, Reached, extend};
use super::units::{ANY, SILENCE, Unit};

/// What leaving the straight way costs, in logarithms of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Costs {
    /// A pause between two syllables.
    pub pause: f32,
    /// Something said that is not in the script.
    pub other: f32,
    /// A syllable that is not heard.
    pub skip: f32,
}

impl Costs {
    /// So many times dearer to leave the script; pauses cost the same.
    #[must_use]
    pub(crate) fn times(self, times: f32) -> Self {
        Self { other: times * self.other, skip: times * self.skip, ..self }
    }
}

/// The shortest pause, in frames: 30 ms. A stop has a closure of its own.
const PAUSE: usize = 6;

/// The shortest thing that is said beside the script, in frames: 150 ms.
const OTHER: usize = 30;

/// How often bands are made wider.
const TRIES: usize = 3;

/// Frames of a long recording: a minute and a half.
const LONG: usize = 18_000;

/// So many links to either side of where a way touches the edge of its band are given a wider one.
const NEIGHBOURS: usize = 12;

/// The widest band that is tried, in frames to either side: 6 s.
const WIDEST: usize = 1200;

/// A stretch of sound and what is said in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Section {
    /// The first frame.
    pub from: usize,
    /// One beyond the last frame.
    pub to: usize,
    /// The first syllable.
    pub first: usize,
    /// One beyond the last syllable.
    pub last: usize,
    /// Whether it is full of them from its first frame to its last: somebody has set it.
    pub full: bool,
}

/// What lies before a syllable, or after the last: something beside the script, frames.
pub(crate) type Beside = Option<(usize, usize)>;

/// The way that was found through a section.
#[derive(Debug, Clone, Default)]
pub(crate) struct Way {
    /// For each link its first frame and one beyond its last; equal where its syllable is not heard.
    pub links: Vec<(usize, usize)>,
    /// For each syllable and the end, what is said before it that is not in the script.
    pub beside: Vec<Beside>,
    /// How likely it all is.
    pub score: f64,
}

/// What a search looks at.
pub(crate) struct Search<'a> {
    /// The script.
    pub chain: &'a Chain,
    /// The scores of silence, of any voice, and of every unit of the script, frame by frame.
    pub scores: &'a [Vec<f32>],
    /// For each unit the row of its scores.
    pub rows: &'a [usize],
    /// How many times slower than usual is spoken.
    pub rate: f32,
    /// What leaving the way costs.
    pub costs: Costs,
    /// What every frame of something beside the script scores, at most 0: how well this voice fits the script elsewhere.
    /// What is beside it has to be less like the script than that.
    pub beside: f32,
}

/// What may lie in a gap.
#[derive(Debug, Clone, Copy)]
struct Crossover {
    /// Whether a pause costs nothing: before the first syllable and after the last.
    free: bool,
    /// Whether there is no gap.
    full: bool,
}

/// How a frame was reached across a gap.
#[derive(Debug, Clone, Copy, Default)]
struct Crossing {
    /// Where the syllable before ended.
    from: u32,
    /// What lies beside the script, where something does.
    beside: Option<(u32, u32)>,
}

impl Search<'_> {
    fn row(&self, unit: Unit) -> &[f32] {
        match unit {
            SILENCE => &self.scores[0],
            ANY => &self.scores[1],
            unit => &self.scores[self.rows[usize::from(unit)]],
        }
    }

    /// The scores of a link of the script.
    #[must_use]
    pub(crate) fn of_link(&self, link: usize) -> &[f32] {
        self.row(self.chain.links[link].unit)
    }

    /// What it costs to leave out the syllable of some links.
    pub(super) fn skip(&self, links: Range<usize>) -> f32 {
        let usual = (self.chain.usual(links) * FRAMES) as f32 * self.rate;
        self.costs.skip - self.beside * usual
    }

    /// How long a link of the script may last.
    #[must_use]
    pub(crate) fn lasting(&self, link: usize) -> Lasting {
        Lasting::of(self.chain.links[link].unit, self.rate, link + 1 == self.chain.links.len())
    }

    /// The best way through a section that lies within `width` frames of the way `rough`.
    #[must_use]
    pub(crate) fn way(&self, section: &Section, rough: &[(usize, usize)], width: usize) -> Way {
        let mut widths = vec![width; rough.len()];
        // In a long recording some edge is always touched; all of it is not searched again and again for that.
        let tries = if section.to - section.from > LONG { 1 } else { TRIES };
        for _ in 0..tries {
            let (way, touched) = self.within(section, rough, &widths);
            if touched.is_empty() && way.score > NEVER {
                return way;
            }
            // A way along the edge of its band may lie beyond it: there the band is made wider.
            let mut wider = widths.clone();
            for link in touched {
                let about = link.saturating_sub(NEIGHBOURS)..(link + NEIGHBOURS).min(widths.len());
                for at in about {
                    wider[at] = (3 * widths[at]).min(WIDEST);
                }
            }
            if way.score == NEVER {
                wider = widths.iter().map(|w| (3 * w).min(WIDEST)).collect();
            }
            if wider == widths {
                break;
            }
            widths = wider;
        }
        let (way, _) = self.within(section, rough, &widths);
        // Where nothing fits, at least everything is in order.
        if way.score > NEVER { way } else { self.evenly(section) }
    }

    fn evenly(&self, section: &Section) -> Way {
        Way { links: self.spread(section), beside: vec![None; section.last - section.first + 1], score: NEVER }
    }

    /// Everything one after the other, evenly: where nothing better is known.
    pub(super) fn spread(&self, section: &Section) -> Vec<(usize, usize)> {
        let links = self.chain.syllables[section.first].start..self.chain.syllables[section.last - 1].end;
        let (count, length) = (links.len(), section.to - section.from);
        (0..count).map(|i| (section.from + i * length / count, section.from + (i + 1) * length / count)).collect()
    }

    fn within(&self, section: &Section, rough: &[(usize, usize)], widths: &[usize]) -> (Way, Vec<usize>) {
        let band = |t: usize, width: usize, before: Band| Band {
            low: t.saturating_sub(width).max(section.from).max(before.low),
            high: (t + width).min(section.to).max(before.high),
        };
        let first_link = self.chain.syllables[section.first].start;
        let start = Band { low: section.from, high: section.from };
        let mut reached = Reached { band: start, scores: vec![0.0] };
        let mut crossings: Vec<(Band, Vec<Crossing>)> = Vec::new();
        let mut lengths: Vec<(Band, Vec<u16>)> = Vec::new();
        let mut skips: Vec<Vec<bool>> = Vec::new();
        for syllable in section.first..section.last {
            let links = self.chain.syllables[syllable].clone();
            let width = widths[links.start - first_link];
            let begin = band(rough[links.start - first_link].0, width, Band { low: reached.band.low, ..start });
            let how_to = Crossover { free: syllable == section.first, full: section.full };
            let (entered, how) = self.cross(&reached, begin, how_to);
            crossings.push((begin, how));
            let mut now = Reached { band: entered.band, scores: entered.scores.clone() };
            for link in links.clone() {
                let end = band(rough[link - first_link].1, widths[link - first_link], now.band);
                let (next, how) = extend(&now, end, self.of_link(link), &self.lasting(link));
                lengths.push((end, how));
                now = next;
            }
            // A syllable that is not heard; of the others, none fits better than this voice does.
            let skip = f64::from(self.skip(links));
            let mut skipped = vec![false; now.scores.len()];
            for (i, (score, skipped)) in now.scores.iter_mut().zip(&mut skipped).enumerate().filter(|_| !section.full) {
                let without = entered.at(now.band.low + i) - skip;
                if without > *score {
                    (*score, *skipped) = (without, true);
                }
            }
            skips.push(skipped);
            reached = now;
        }
        let end = Band { low: section.to, high: section.to };
        let (finished, how) = self.cross(&reached, end, Crossover { free: true, full: section.full });
        crossings.push((end, how));
        let mut way = Way { score: finished.at(section.to), ..Way::default() };
        if way.score == NEVER {
            return (way, Vec::new());
        }
        // Back from the end.
        let mut touched = Vec::new();
        let edge = |t: usize, b: Band| (t == b.low && b.low > section.from) || (t == b.high && b.high < section.to);
        let mut t = section.to;
        let mut link = lengths.len();
        for number in (0..=section.last - section.first).rev() {
            let (band, how) = &crossings[number];
            let crossing = how[t - band.low];
            if number + section.first < section.last && edge(t, *band) {
                touched.push(link.min(widths.len() - 1));
            }
            way.beside.push(crossing.beside.map(|(a, b)| (a as usize, b as usize)));
            t = crossing.from as usize;
            let Some(number) = number.checked_sub(1) else { break };
            let links = self.chain.syllables[section.first + number].len();
            let end = lengths[link - 1].0;
            if skips[number][t - end.low] {
                way.links.extend(std::iter::repeat_n((t, t), links));
                link -= links;
                continue;
            }
            for _ in 0..links {
                link -= 1;
                let (band, how) = &lengths[link];
                if edge(t, *band) {
                    touched.push(link);
                }
                let length = usize::from(how[t - band.low]);
                way.links.push((t - length, t));
                t -= length;
            }
        }
        way.links.reverse();
        way.beside.reverse();
        (way, touched)
    }

    /// From the end of a syllable to the beginning of the next: straight on, over a pause, over something beside the
    /// script, or over both.
    fn cross(&self, before: &Reached, to: Band, how: Crossover) -> (Reached, Vec<Crossing>) {
        if how.full {
            let here = |t: usize| Crossing { from: t as u32, beside: None };
            let scores = (to.low..=to.high).map(|t| before.at(t)).collect();
            return (Reached { band: to, scores }, (to.low..=to.high).map(here).collect());
        }
        let silence = self.row(SILENCE);
        let (low, score) = (before.band.low, f64::from(self.beside));
        let (pause, cost) = if how.free { (1, 0.0) } else { (PAUSE, f64::from(self.costs.pause)) };
        let mut out = Vec::with_capacity(to.high + 1 - to.low);
        let mut how = Vec::with_capacity(to.high + 1 - to.low);
        // Sums of the scores of silence up to each frame, and the best beginnings so far.
        let mut sum = 0.0;
        let mut sums: Vec<f64> = Vec::with_capacity(to.high + 1 - low);
        let (mut paused, mut paused_at) = (NEVER, 0);
        let (mut beside, mut beside_how) = (NEVER, Crossing::default());
        let (mut after, mut after_how) = (NEVER, Crossing::default());
        // What was reached OTHER and PAUSE frames ago.
        let mut quiet: Vec<(f64, u32)> = Vec::with_capacity(to.high + 1 - low);
        let mut said: Vec<(f64, Crossing)> = Vec::with_capacity(to.high + 1 - low);
        for t in low..=to.high {
            sums.push(sum);
            let i = t - low;
            let direct = before.at(t);
            if let Some(from) = i.checked_sub(pause) {
                let value = before.at(low + from) - sums[from];
                if value > paused {
                    (paused, paused_at) = (value, low + from);
                }
            }
            let over = paused + sum - cost;
            let one = if over > direct { (over, paused_at as u32) } else { (direct, t as u32) };
            quiet.push(one);
            beside += score;
            if let Some(from) = i.checked_sub(OTHER) {
                let value = quiet[from].0 - f64::from(self.costs.other) + score * OTHER as f64;
                if value > beside {
                    beside = value;
                    beside_how = Crossing { from: quiet[from].1, beside: Some(((low + from) as u32, 0)) };
                }
            }
            let here = Crossing { beside: beside_how.beside.map(|b| (b.0, t as u32)), ..beside_how };
            said.push((beside, here));
            if let Some(from) = i.checked_sub(PAUSE) {
                let value = said[from].0 - sums[from];
                if value > after {
                    (after, after_how) = (value, said[from].1);
                }
            }
            let mut best = (one.0, Crossing { from: one.1, beside: None });
            if beside > best.0 {
                best = (beside, here);
            }
            if after + sum > best.0 {
                best = (after + sum, after_how);
            }
            if t >= to.low {
                out.push(best.0);
                how.push(best.1);
            }
            sum += f64::from(silence.get(t).copied().unwrap_or(0.0));
        }
        (Reached { band: to, scores: out }, how)
    }
}

#[cfg(test)]
mod tests {
    use super::super::coarse;
    use super::*;
    use crate::script::{System, syllables};

    const COSTS: Costs = Costs { pause: 6.0, other: 40.0, skip: 40.0 };

    /// Scores by which exactly these spans of frames fit their links, in a recording of so many frames.
    fn painted(chain: &Chain, spans: &[(usize, usize)], frames: usize) -> (Vec<Vec<f32>>, Vec<usize>) {
        let units = chain.units();
        let mut rows = vec![1; super::super::units::UNITS.len()];
        rows[0] = 0;
        let mut scores = vec![vec![1.0; frames], vec![0.0; frames]];
        for unit in units {
            rows[usize::from(unit)] = scores.len();
            scores.push(vec![-2.0; frames]);
        }
        for (link, (from, to)) in chain.links.iter().zip(spans) {
            scores[0][*from..*to].fill(-2.0);
            scores[rows[usize::from(link.unit)]][*from..*to].fill(1.5);
        }
        (scores, rows)
    }

    fn whole(chain: &Chain, frames: usize) -> Section {
        Section { from: 0, to: frames, first: 0, last: chain.syllables.len(), full: false }
    }

    fn way(chain: &Chain, spans: &[(usize, usize)], frames: usize) -> Way {
        let (scores, rows) = painted(chain, spans, frames);
        let search = Search { chain, scores: &scores, rows: &rows, rate: 1.0, costs: COSTS, beside: 0.0 };
        coarse::way(&search, &whole(chain, frames), None, 200)
    }

    #[test]
    fn units_are_found_where_they_fit_across_pauses_long_and_short() {
        let chain = Chain::of(&syllables("sa1 mi2 lu3", System::Hanyu).unwrap());
        let spans = [(300, 320), (320, 345), (345, 358), (358, 380), (2600, 2612), (2612, 2630)];
        let found = way(&chain, &spans, 3000);
        assert_eq!(found.links, spans);
        assert_eq!(found.beside, [None; 4]);
    }

    #[test]
    fn a_syllable_that_is_not_said_has_no_length_and_leaves_the_others_in_their_places() {
        let chain = Chain::of(&syllables("sa1 mi2 lu3", System::Hanyu).unwrap());
        let spans = [(300, 320), (320, 345), (345, 345), (345, 345), (360, 372), (372, 390)];
        let found = way(&chain, &spans, 500);
        assert_eq!((&found.links[..2], &found.links[4..]), (&spans[..2], &spans[4..]));
        assert!(found.links[2..4].iter().all(|(a, b)| a == b), "{:?}", found.links);
    }

    #[test]
    fn what_is_said_beside_the_script_is_left_out() {
        let chain = Chain::of(&syllables("sa1 lu3", System::Hanyu).unwrap());
        let spans = [(300, 320), (320, 345), (500, 512), (512, 530)];
        let (mut scores, rows) = painted(&chain, &spans, 800);
        for row in [0, rows[usize::from(chain.links[0].unit)], rows[usize::from(chain.links[1].unit)]] {
            scores[row][345..470].fill(-3.0);
        }
        for link in &chain.links[2..] {
            scores[rows[usize::from(link.unit)]][345..470].fill(-3.0);
        }
        let search = Search { chain: &chain, scores: &scores, rows: &rows, rate: 1.0, costs: COSTS, beside: 0.0 };
        let found = coarse::way(&search, &whole(&chain, 800), None, 200);
        assert_eq!(found.links, spans);
        assert_eq!(found.beside, [None, Some((345, 470)), None]);
    }

    #[test]
    fn a_section_that_is_full_has_neither_pause_nor_gap() {
        let chain = Chain::of(&syllables("sa1", System::Hanyu).unwrap());
        let (scores, rows) = painted(&chain, &[(20, 40), (40, 60)], 100);
        let search = Search { chain: &chain, scores: &scores, rows: &rows, rate: 1.0, costs: COSTS, beside: 0.0 };
        for (from, to) in [(10, 80), (38, 42), (40, 41), (50, 50)] {
            let section = Section { from, to, full: true, ..whole(&chain, 100) };
            let found = coarse::way(&search, &section, None, 200);
            assert_eq!((found.links[0].0, found.links[1].1), (from, to));
            assert_eq!(found.links[0].1, found.links[1].0);
        }
    }

    #[test]
    fn far_too_much_script_is_spread_or_left_out_but_in_order() {
        let chain = Chain::of(&syllables(&"shuang1 ".repeat(40), System::Hanyu).unwrap());
        let (scores, rows) = painted(&chain, &[], 60);
        let search = Search { chain: &chain, scores: &scores, rows: &rows, rate: 1.0, costs: COSTS, beside: 0.0 };
        let found = coarse::way(&search, &whole(&chain, 60), None, 200);
        assert!(
            found.links.windows(2).all(|w| w[0].1 <= w[1].0) && found.links.iter().all(|l| l.0 <= l.1 && l.1 <= 60)
        );
    }
}
