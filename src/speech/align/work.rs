//! One take on its way to an alignment.

use std::borrow::Cow;

use super::chain::Chain;
use super::coarse;
use super::confidence::{self, SIGNS};
use super::features::{self, FRAMES, Features};
use super::model::{Gaussian, Model, judge};
use super::search::{Costs, Search, Section, Way};
use super::sections::sections;
use super::units::{ANY, SILENCE, Unit};
use super::{outcome, voice};
use crate::disk::{Fault, Result};
use crate::speech::SpeechFault;
use crate::speech::{Alignment, Note, Pin, Take};

/// How much the sound counts: frames overlap and follow each other, and say much the same.
const SOUND: f32 = 0.2;

/// What leaving the way costs. With 40 for words beside the script nothing is noted in any of 130 synthesised recordings
/// with their own script, and 7 in 10 single syllables too many are; people's speech fits less well and needs more.
const COSTS: Costs = Costs { pause: 6.0, other: 46.0, skip: 46.0 };

/// So many times dearer it is to leave the script where it is first looked how well the voice fits it.
const STRAIGHT: f32 = 4.0;

/// A syllable that is found in no more than this, in frames, beside something said that is not in the script: 60 ms.
const SQUEEZED: usize = 12;

/// No syllable lasts longer than so many times the usual.
const LONGEST: f64 = 2.0;

/// Frames to either side of a rough way that are searched.
const WIDE: usize = 200;

/// Frames to either side of a way that was searched once.
const NARROW: usize = 80;

/// A voice is at least this loud, in dB below full; dither and a dead cable are not.
const FAINTEST: f32 = -75.0;

/// And at least so much louder than what the recording is quietest in, in dB.
const FLATTEST: f32 = 3.0;

/// Nobody speaks a syllable in less, in seconds.
const SHORTEST: f64 = 0.05;

/// A script that fits the sound by less than this better than its syllables the other way round, a syllable, is not
/// what is said. Of 208 synthesised recordings with their own script the least was 5.5, of as many with that of another
/// one in ten was above 6.2.
const SENSELESS: f32 = 5.0;

/// What is this much below the loud frames, in dB, is not heard as the beginning of a word: breath, a closing mouth. (Set
/// with an eye on the pauses that a person marked in `f1_P8`.) In noise nothing is that faint, and nothing is taken off.
const FAINT: f32 = -30.0;

/// So much is taken off the beginning of a syllable at most, in frames: 60 ms.
const TRIM: usize = 12;

/// A take on its way to an alignment.
pub struct Work {
    /// What is heard.
    pub heard: Features,
    /// What is looked for.
    pub chain: Chain,
    pins: Vec<Pin>,
    units: Vec<Unit>,
    silence: Option<Gaussian>,
    sections: Vec<Section>,
    ways: Vec<Way>,
    /// The signs by which each syllable's confidence is judged.
    pub signs: Vec<[f32; SIGNS]>,
    /// How well the script fits the sound before the model was moved, in logarithms a frame against any voice.
    pub fit: f32,
    /// How much better the script fits than its syllables the other way round, a syllable; nothing where it is pinned.
    pub sense: f32,
    rate: f32,
    passes: usize,
    duration: f64,
    /// How far the voice stands out of the noise, in dB, where that is too little.
    noisy: Option<f64>,
}

impl Work {
    /// Hears a take.
    ///
    /// # Errors
    /// No syllables, no voice, too short.
    pub(crate) fn of(take: &Take<'_>) -> Result<Self> {
        let chain = Chain::of(take.script);
        let count = chain.syllables.len();
        if count == 0 {
            return Err(Fault::of(SpeechFault::NoScript, "the script has no syllables")
                .help("write down what is said in the recording"));
        }
        let duration = take.sound.duration();
        let quality = take.sound.quality();
        let least = SHORTEST * count as f64;
        if duration < least {
            return Err(Fault::of(
                SpeechFault::TooShort,
                format!("the recording is {duration:.2} s long, too short for the {count} syllables of its script"),
            )
            .help("check that this is its script, and that the recording is whole"));
        }
        let samples: Cow<'_, [f32]> = take.sound.resampled(features::RATE);
        let heard = Features::of(&samples);
        if heard.voice < FAINTEST || heard.snr < FLATTEST || heard.sounding() < SHORTEST {
            return Err(Fault::of(SpeechFault::NoVoice, "there is no voice in the recording")
                .help("listen to it; check the microphone and its level"));
        }
        let usual = chain.usual(0..chain.links.len());
        let rate = (heard.sounding() / usual).clamp(0.4, 2.5) as f32;
        let silence = voice::silence(&heard);
        let sections = sections(heard.len(), count, take.pins);
        let units = chain.units();
        let pins = take.pins.iter().copied().filter(|p| p.syllable < count).collect();
        let (ways, signs) = (Vec::new(), Vec::new());
        Ok(Self {
            heard,
            chain,
            pins,
            units,
            silence,
            sections,
            ways,
            signs,
            fit: 0.0,
            sense: f32::INFINITY,
            rate,
            passes: 0,
            duration,
            noisy: quality.is_noisy().then_some(quality.snr_db),
        })
    }

    /// Searches once, by a model.
    pub(crate) fn pass(&mut self, model: &Model) {
        let (terms, rows) = voice::ready(model, &self.units, self.silence.as_ref());
        let mut scores = judge(&terms, &self.heard);
        // Against any voice: so scores stay near 0, and what is said beside the script has none.
        let (silence, rest) = scores.split_at_mut(1);
        let (any, rest) = rest.split_at_mut(1);
        for row in silence.iter_mut().chain(rest) {
            for (value, any) in row.iter_mut().zip(&any[0]) {
                *value = SOUND * (*value - any);
            }
        }
        any[0].fill(0.0);
        let first = self.ways.is_empty();
        let mut search = Search {
            chain: &self.chain,
            scores: &scores,
            rows: &rows,
            rate: self.rate,
            costs: COSTS.times(STRAIGHT),
            beside: 0.0,
        };
        // How well this voice fits the script: by the pass before, or by a rough way that hardly leaves the script.
        search.beside = if first {
            let rough = |s: &Section| Way { links: coarse::about(&search, s), ..Way::default() };
            let ways: Vec<Way> = self.sections.iter().map(rough).collect();
            usual_fit(&search, &self.sections, &ways)
        } else {
            usual_fit(&search, &self.sections, &self.ways)
        };
        search.costs = COSTS;
        let rough: Vec<_> =
            self.sections.iter().map(|s| if self.passes < 2 { coarse::roughly(&search, s) } else { None }).collect();
        let mut ways: Vec<Way> = Vec::new();
        for (number, section) in self.sections.iter().enumerate() {
            // The first two passes look at it as a whole; the others about where the one before was.
            let fresh = rough[number].as_ref().map(|r| r.0.as_slice());
            let near = self.ways.get(number).map(|w| w.links.as_slice());
            let mut way = if first || fresh.is_none() { None } else { near.map(|n| search.way(section, n, NARROW)) };
            let far =
                |a: &[(usize, usize)], b: &[(usize, usize)]| a.iter().zip(b).any(|(a, b)| a.0.abs_diff(b.0) > NARROW);
            if first || fresh.zip(near).is_some_and(|(f, n)| far(f, n)) {
                let other = coarse::way(&search, section, fresh, if first { WIDE } else { NARROW });
                if way.as_ref().is_none_or(|w| other.score > w.score) {
                    way = Some(other);
                }
            }
            ways.push(way.unwrap_or_else(|| coarse::way(&search, section, near, NARROW)));
        }
        let snr = self.heard.snr;
        self.signs = self
            .sections
            .iter()
            .zip(&ways)
            .flat_map(|(section, way)| confidence::signs(&search, section, way, snr))
            .collect();
        if first {
            self.fit = fit(&search, &self.sections, &ways);
            let reversed = self.chain.reversed();
            let other = (0..self.chain.syllables.len()).filter(|n| self.chain.differs(&reversed, *n)).count();
            if self.pins.is_empty() && other > 0 {
                let score = |chain: &Chain| {
                    let search = Search { chain, ..search };
                    let near = coarse::roughly(&search, &self.sections[0]).map(|r| r.0);
                    coarse::way(&search, &self.sections[0], near.as_deref(), NARROW).score
                };
                self.sense = ((score(&self.chain) - score(&reversed)) / other as f64) as f32;
            }
        }
        self.passes += 1;
        self.ways = ways;
        self.rate = self.heard_rate();
    }

    /// How many times slower than usual is spoken, by what was found.
    fn heard_rate(&self) -> f32 {
        let (mut usual, mut real) = (0.0, 0.0);
        for (section, way) in self.sections.iter().zip(&self.ways) {
            let start = self.chain.syllables[section.first].start;
            for (offset, (from, to)) in way.links.iter().enumerate().filter(|(_, (a, b))| b > a) {
                usual += self.chain.usual(start + offset..start + offset + 1);
                real += (to - from) as f64 / FRAMES;
            }
        }
        if usual > 0.0 { ((real / usual) as f32).clamp(0.4, 2.5) } else { self.rate }
    }

    /// A syllable for which no place was left beside something not in the script that lasts as long as a syllable is that
    /// syllable, said otherwise than it is written: it is put there. Its confidence stays what it was, near none.
    fn otherwise(&self) -> Vec<Way> {
        let mut ways = self.ways.clone();
        for (section, way) in self.sections.iter().zip(&mut ways).filter(|(s, _)| !s.full) {
            let start = self.chain.syllables[section.first].start;
            for syllable in section.first..section.last {
                let links = self.chain.syllables[syllable].clone();
                let own = links.start - start..links.end - start;
                let found = way.links[own.end - 1].1 - way.links[own.start].0;
                let usual = self.chain.usual(links.clone()) * f64::from(self.rate) * FRAMES;
                let offset = syllable - section.first;
                for place in [offset, offset + 1] {
                    let Some((from, to)) = way.beside[place] else { continue };
                    if found > SQUEEZED || (to - from) as f64 > LONGEST * usual {
                        continue;
                    }
                    let mut at = 0.0;
                    for link in links.clone() {
                        let share =
                            |at: f64| from + ((to - from) as f64 * at * FRAMES * f64::from(self.rate) / usual) as usize;
                        let next = at + self.chain.usual(link..link + 1);
                        way.links[link - start] = (share(at), share(next).min(to));
                        at = next;
                    }
                    way.links[own.end - 1].1 = to;
                    way.beside[place] = None;
                    break;
                }
            }
        }
        ways
    }

    /// The unit of every frame.
    #[must_use]
    pub(crate) fn labels(&self) -> Vec<Unit> {
        let mut labels = vec![SILENCE; self.heard.len()];
        for (section, way) in self.sections.iter().zip(&self.ways) {
            let links = &self.chain.links[self.chain.syllables[section.first].start..];
            for (link, (from, to)) in links.iter().zip(&way.links) {
                labels[*from..*to].fill(link.unit);
            }
            for (from, to) in way.beside.iter().flatten() {
                labels[*from..*to].fill(ANY);
            }
        }
        labels
    }

    /// The ways with syllables after a pause beginning where they are heard: a person sets the boundary there, not where
    /// a closure begins that nobody hears.
    fn trimmed(&self, ways: &[Way]) -> Vec<Way> {
        let mut ways = ways.to_vec();
        for (section, way) in self.sections.iter().zip(&mut ways).filter(|(s, _)| !s.full) {
            let start = self.chain.syllables[section.first].start;
            let mut before = section.from;
            for syllable in section.first..section.last {
                let links = self.chain.syllables[syllable].clone();
                let first = &mut way.links[links.start - start];
                if first.0 > before || syllable == section.first {
                    let most = (first.0 + TRIM).min(first.1.saturating_sub(1));
                    while first.0 < most && self.heard.levels.get(first.0).is_some_and(|l| *l < FAINT) {
                        first.0 += 1;
                    }
                }
                before = way.links[links.end - 1 - start].1;
            }
        }
        ways
    }

    /// What was found.
    #[must_use]
    pub fn alignment(&self, model: &Model) -> Alignment {
        let found = self.otherwise();
        let ways = self.trimmed(&found);
        let confidence: Vec<f64> = self.signs.iter().map(|s| confidence::confidence(s, &model.confidence)).collect();
        let syllables = outcome::spoken(&self.chain, &self.sections, &ways, &self.pins, &confidence, self.duration);
        let mut notes = Vec::new();
        notes.extend(self.noisy.map(|snr| Note::Noisy { snr }));
        let missing = syllables.iter().filter(|s| !s.heard).count() as f32 / syllables.len() as f32;
        if self.sense < SENSELESS || (self.sense < 2.0 * SENSELESS && missing > 0.15) || missing > 0.5 {
            notes.push(Note::Doubtful);
        } else {
            notes.extend(outcome::partings(&self.sections, &found, &syllables));
        }
        Alignment { syllables, notes }
    }
}

/// How well a voice fits the script where it does not fit it best, a frame, at most 0: two in three of the syllables
/// that are heard fit better. (A mean would hang on the few that are not said at all.)
fn usual_fit(search: &Search<'_>, sections: &[Section], ways: &[Way]) -> f32 {
    let mut fits = Vec::new();
    for (section, way) in sections.iter().zip(ways) {
        let start = search.chain.syllables[section.first].start;
        for links in &search.chain.syllables[section.first..section.last] {
            let (mut sum, mut frames) = (0.0_f32, 0_usize);
            for link in links.clone() {
                let (from, to) = way.links[link - start];
                sum += search.of_link(link)[from..to].iter().sum::<f32>();
                frames += to - from;
            }
            if frames > 0 {
                fits.push(sum / frames as f32);
            }
        }
    }
    fits.sort_by(f32::total_cmp);
    fits.get(fits.len() / 3).copied().unwrap_or(0.0).min(0.0)
}

/// How well the script fits, a frame.
fn fit(search: &Search<'_>, sections: &[Section], ways: &[Way]) -> f32 {
    let (mut sum, mut frames) = (0.0_f64, 0_usize);
    for (section, way) in sections.iter().zip(ways) {
        let start = search.chain.syllables[section.first].start;
        for (offset, (from, to)) in way.links.iter().enumerate() {
            sum += search.of_link(start + offset)[*from..*to].iter().map(|v| f64::from(*v)).sum::<f64>();
            frames += to - from;
        }
    }
    (sum / frames.max(1) as f64) as f32
}
