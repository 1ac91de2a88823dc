//! How sure the times of a syllable are: from how much worse the script fits with its boundaries elsewhere, how well it
//! fits at all, and how clear the recording is. Calibrated on synthesised voices that were not learned from, changed
//! and with noise.

use super::lasting::Lasting;
use super::search::{Search, Section, Way};

/// What the confidence of a syllable is judged by.
pub const SIGNS: usize = 6;

/// Boundaries this far away, in frames, are wrong: 50 ms.
const FAR: usize = 10;

/// A boundary that is this much better than any far from it is certain.
const CERTAIN: f32 = 24.0;

/// As far as other places are looked at, in frames: 300 ms.
const REACH: usize = 60;

/// The signs of each syllable of a section; 0 for those that are not heard.
#[must_use]
pub(crate) fn signs(search: &Search<'_>, section: &Section, way: &Way, snr: f32) -> Vec<[f32; SIGNS]> {
    let start = search.chain.syllables[section.first].start;
    // What every frame is taken for.
    let mut taken: Vec<&[f32]> = vec![&search.scores[0]; section.to - section.from];
    for (offset, (from, to)) in way.links.iter().enumerate() {
        taken[from - section.from..to - section.from].fill(search.of_link(start + offset));
    }
    let sides = Sides { search, taken: &taken, from: section.from };
    let mut out = Vec::new();
    for syllable in section.first..section.last {
        let links = search.chain.syllables[syllable].clone();
        let own = &way.links[links.start - start..links.end - start];
        if own.iter().all(|(a, b)| a == b) {
            out.push([0.0; SIGNS]);
            continue;
        }
        let (mut fit, mut frames, mut odd) = (0.0, 0.0, 0.0);
        for (link, (from, to)) in links.clone().zip(own) {
            fit += search.of_link(link)[*from..*to].iter().sum::<f32>();
            frames += (to - from) as f32;
            let lasting = search.lasting(link);
            let best = lasting.values.iter().copied().fold(f32::MIN, f32::max);
            odd += best - lasting.at(to - from);
        }
        // The link before and the one after, where they are not apart from it.
        let near = |link: usize, is: bool| {
            let span = way.links.get(link.wrapping_sub(start)).copied()?;
            (is && span.1 > span.0).then_some((link, span.0, span.1))
        };
        let (first, last) = (links.start, links.end - 1);
        let (begins, ends) = (own[0].0, own[own.len() - 1].1);
        let before = first.checked_sub(1).and_then(|l| near(l, l >= start)).filter(|n| n.2 == begins);
        let after = near(last + 1, true).filter(|n| n.1 == ends);
        let margins = [sides.margin(before, near(first, true), begins), sides.margin(near(last, true), after, ends)];
        out.push([
            1.0,
            margins[0].min(margins[1]) / CERTAIN,
            margins[0].max(margins[1]) / CERTAIN,
            (fit / frames).clamp(-2.0, 2.0),
            (odd / links.len() as f32 / 4.0).min(4.0),
            (snr / 20.0).clamp(0.0, 2.0),
        ]);
    }
    out
}

/// A link with its first frame and one beyond its last.
type Span = (usize, usize, usize);

struct Sides<'a> {
    search: &'a Search<'a>,
    taken: &'a [&'a [f32]],
    from: usize,
}

impl Sides<'_> {
    /// How much worse the best boundary is that lies more than 50 ms from where it was found: what is left of it going
    /// on to the right, or the right one to the left. Without a link there is silence.
    fn margin(&self, left: Option<Span>, right: Option<Span>, at: usize) -> f32 {
        let silence = &self.search.scores[0];
        let row = |side: Option<Span>| side.map_or(silence.as_slice(), |s| self.search.of_link(s.0));
        let lasting = |side: Option<Span>| side.map(|s| (self.search.lasting(s.0), s.2 - s.1));
        let (lefts, rights) = (lasting(left), lasting(right));
        let more = |l: &Option<(Lasting, usize)>, by: isize| {
            l.as_ref().map_or(0.0, |(l, n)| l.at(n.saturating_add_signed(by).max(l.least)) - l.at(*n))
        };
        let mut worst = CERTAIN;
        for (step, row) in [(1_isize, row(left)), (-1, row(right))] {
            let mut lost = 0.0;
            for by in 1..=REACH as isize {
                let place = if step > 0 { at as isize + by - 1 } else { at as isize - by };
                let Some(taken) = usize::try_from(place - self.from as isize).ok().and_then(|i| self.taken.get(i))
                else {
                    break;
                };
                lost += taken[place as usize] - row[place as usize];
                if by > FAR as isize {
                    let times = more(&lefts, step * by) + more(&rights, -step * by);
                    worst = worst.min(lost - times);
                }
            }
        }
        worst.max(0.0)
    }
}

/// The share of syllables with such signs whose boundaries are both right within 50 ms.
#[must_use]
pub fn confidence(signs: &[f32; SIGNS], weights: &[f32; SIGNS]) -> f64 {
    let sum: f32 = signs.iter().zip(weights).map(|(s, w)| s * w).sum();
    1.0 / (1.0 + f64::from(-sum).exp())
}

#[cfg(test)]
mod tests {
    use super::super::chain::Chain;
    use super::super::search::Costs;
    use super::super::units::UNITS;
    use super::*;
    use crate::script::{System, syllables};

    #[test]
    fn a_clear_boundary_is_surer_than_a_blurred_one() {
        let chain = Chain::of(&syllables("sa1 mi2", System::Hanyu).unwrap());
        let spans = [(20, 40), (40, 65), (65, 78), (78, 100)];
        let signs_with = |contrast: f32| {
            let mut rows = vec![1; UNITS.len()];
            let mut scores = vec![vec![contrast; 120], vec![0.0; 120]];
            for (link, (from, to)) in chain.links.iter().zip(&spans) {
                rows[usize::from(link.unit)] = scores.len();
                scores.push(vec![-contrast; 120]);
                scores[0][*from..*to].fill(-contrast);
                let own = scores.len() - 1;
                scores[own][*from..*to].fill(contrast);
            }
            let costs = Costs { pause: 6.0, other: 40.0, skip: 40.0 };
            let search = Search { chain: &chain, scores: &scores, rows: &rows, rate: 1.0, costs, beside: 0.0 };
            let section = Section { from: 0, to: 120, first: 0, last: 2, full: false };
            let way = Way { links: spans.to_vec(), ..Way::default() };
            signs(&search, &section, &way, 30.0)
        };
        let (clear, blurred) = (signs_with(1.0), signs_with(0.05));
        let weights = [-2.0, 3.0, 1.0, 1.0, -0.5, 0.5];
        for (c, b) in clear.iter().zip(&blurred) {
            assert!(c[1] > b[1] + 0.2 && c[2] >= c[1], "{c:?} {b:?}");
            let (c, b) = (confidence(c, &weights), confidence(b, &weights));
            assert!(c > b && (0.0..=1.0).contains(&c) && (0.0..=1.0).contains(&b));
        }
    }
}
