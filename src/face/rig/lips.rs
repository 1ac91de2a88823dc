//! The lips at rest, and how the emotions and speech move them (thesis sec. 4.4.2, recipe part 4).
//!
//! Control points are 8.9, 8.2 and the corners 8.4 and 8.3; the others follow by rule. Openings are meant at the inner
//! edges of the lips, so that the same shape opens thin and full lips alike: a lip that thickens grows outward.

use super::mouth::{Look, Mouth};
use super::{Expression, within};
use crate::face::{FeaturePoint as P, Points};
use crate::geometry::{Point, lerp};
use crate::pose::MouthPose;

/// While a syllable is spoken, how much is left of the emotion's corners, its upper lip and its lower lip.
const CORNERS_SPEAKING: f64 = 0.6;
const UPPER_SPEAKING: f64 = 0.45;
const LOWER_SPEAKING: f64 = 0.0;
/// How far *f* lifts the upper lip off the lower one to show the teeth that stand on it, in M, at least and at most.
const BITE: (f64, f64) = (0.12, 0.24);
/// Where lips meet between the upper (0) and the lower edge (1).
const MEET: f64 = 0.4;
/// The narrowest and the widest mouth, in MW0.
const WIDTHS: (f64, f64) = (0.34, 1.5);
/// However they are pressed, this much of the lips' thickness is left.
const PRESSED: f64 = 0.4;

/// The lips at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lips {
    corners: [Point; 2],
    /// MW0.
    width: f64,
    /// M = max(MNS0, 0.33 MW0), but at most 0.40 MW0.
    unit: f64,
    /// Where the lips meet.
    meet: f64,
    /// UpperLipH and LowerLipH.
    thickness: [f64; 2],
    /// How far the middle of the upper lip hangs below its peaks, and half the distance of those.
    dip: f64,
    peaks: f64,
    /// How high the upper lip may rise, and how far out the corners may lie.
    nose: f64,
    cheeks: [f64; 2],
}

/// What is done to a mouth, the emotions' and speech's moves joined, in face units.
struct Moves {
    /// Inner edges down, before they close.
    inner: [f64; 2],
    /// How much of the way between them is the emotion's.
    felt: f64,
    /// Each corner outward, and down.
    out: f64,
    down: f64,
    /// Thickness of each lip, 1 neutral.
    thick: [f64; 2],
    closure: f64,
    bite: f64,
    tongue: f64,
}

impl Lips {
    /// From points whose mouth is closed. Lips that are drawn need some thickness, so very thin ones gain it, and the
    /// points with them.
    pub(super) fn of(points: &mut Points) -> Self {
        const LEAST: [f64; 2] = [3.5, 5.0];
        let meet = points[P::P2_2].y;
        let corners = [points[P::P8_4], points[P::P8_3]];
        let width = corners[1].x - corners[0].x;
        let thickness = [(meet - points[P::P8_1].y).max(LEAST[0]), (points[P::P8_2].y - meet).max(LEAST[1])];
        let top = points[P::P8_9].y.midpoint(points[P::P8_10].y);
        let dip = within(points[P::P8_1].y - top, 0.0, 0.5 * thickness[0]);
        let peaks = within(0.5 * (points[P::P8_10].x - points[P::P8_9].x), 0.06 * width, 0.24 * width);
        let nose = points[P::P9_15].y;
        let unit = within(meet - thickness[0] - nose, 0.33 * width, 0.40 * width);
        let jaw = points[P::P2_13].x - points[P::P2_14].x;
        let cheeks = [points[P::P2_14].x + 0.04 * jaw, points[P::P2_13].x - 0.04 * jaw];
        let lips = Self { corners, width, unit, meet, thickness, dip, peaks, nose, cheeks };
        let rest = Moves {
            inner: [0.0; 2],
            felt: 0.0,
            out: 0.0,
            down: 0.0,
            thick: [1.0; 2],
            closure: 0.0,
            bite: 0.0,
            tongue: 0.0,
        };
        lips.shaped(&rest, 0.0, 0.0).place(points);
        lips
    }

    /// The lips of a pose: the emotion's own at rest, its corners under speech's openings while a syllable is spoken.
    pub(super) fn pose(&self, e: &Expression, mouth: &MouthPose) -> Mouth {
        let speech = sound(mouth);
        let spoken = speech.speaking.max(speech.closure).min(1.0);
        // A mouth that was measured has the emotion's opening and width in it already.
        let measured = within(speech.speaking - 1.0, 0.0, 1.0);
        let unit = self.unit;
        let felt = [UPPER_SPEAKING, LOWER_SPEAKING].map(|left| unit * lerp(1.0, left, spoken) * (1.0 - measured));
        let felt = [e.upper * felt[0], e.lower * felt[1]];
        let lower_lip = (speech.lower_lip + speech.lower_thinner - speech.thinner) * self.thickness[1];
        let said = [speech.upper * unit, speech.lower * unit + lower_lip];
        // Pursed lips gather: a rounded vowel has no room for the emotion's raised or hanging corners, and a mouth that
        // the emotion has narrowed already gives way less.
        let gathered = within(speech.corner_in / 0.22, 0.0, 1.0);
        let kept = lerp(1.0, CORNERS_SPEAKING, spoken);
        let aside = e.corner_out * kept * (1.0 - measured);
        let out = aside * self.width;
        let already = within(1.0 + 2.0 * aside, 0.4, 1.0).powi(2);
        let narrowing = speech.corner_in * self.width * if speech.corner_in > 0.0 { already } else { 1.0 };
        let moves = Moves {
            inner: [said[0] + felt[0], said[1] + felt[1]],
            felt: felt[1] - felt[0],
            out: out - narrowing,
            down: e.corner_down * unit * lerp(kept, 1.0, measured) * (1.0 - 0.6 * gathered) + speech.corner_down * unit,
            thick: [(1.0 - speech.thinner) * e.thick, (1.0 - speech.lower_thinner) * e.thick],
            closure: speech.closure,
            bite: speech.bite,
            tongue: speech.tongue,
        };
        let quiet = 1.0 - 0.5 * spoken;
        self.shaped(&moves, e.pout * quiet, e.sneer * quiet)
    }

    fn shaped(&self, moves: &Moves, pout: f64, sneer: f64) -> Mouth {
        let neutral_half = 0.5 * self.width;
        let (lowest, highest) = (WIDTHS.0 * neutral_half, WIDTHS.1 * neutral_half);
        let half = within(neutral_half + moves.out, lowest, highest);
        let by = half - neutral_half;
        let x = [
            within(self.corners[0].x - by, self.cheeks[0], self.cheeks[1]),
            within(self.corners[1].x + by, self.cheeks[0], self.cheeks[1]),
        ];
        let width = x[1] - x[0];
        let middle = x[0].midpoint(x[1]);
        let ratio = width / self.width;
        let rounded = within((1.0 - ratio) / 0.34, 0.0, 1.0);

        // The inner edges, brought together where they must meet or have passed each other. On its way a closure takes
        // the emotion's opening in proportion; speech's own closes by its own numbers, and only what they leave is taken.
        let gap = moves.inner[1] - moves.inner[0];
        let shown = moves.bite * within(gap, BITE.0 * self.unit, BITE.1 * self.unit);
        let parted = lerp(gap - moves.felt, shown, moves.closure.powi(4)) + moves.felt * (1.0 - moves.closure);
        let parted = parted.max(0.0);
        let pressed = (-gap).max(0.0) * (1.0 - moves.bite * moves.closure);
        let inner = [
            self.meet + moves.inner[0] + MEET * (gap - parted),
            self.meet + moves.inner[1] - (1.0 - MEET) * (gap - parted),
        ];

        // Lips thin as the mouth widens and thicken as it narrows, and are squeezed where they press together.
        let by_width = within(ratio.powf(-0.35), 0.82, 1.10);
        let thick = |lip: usize, share: f64, extra: f64| {
            let full = self.thickness[lip] * by_width * (moves.thick[lip] + extra);
            (full - share * pressed).max(PRESSED * self.thickness[lip])
        };
        let (upper, lower) = (thick(0, MEET, -0.12 * sneer), thick(1, 1.0 - MEET, 0.10 * pout));
        let dip = self.dip * (1.0 - 0.5 * rounded);
        // The upper lip ends below the nose: it thins before it reaches it, and only then gives way.
        let ceiling = self.nose + (0.18 * self.unit).min(0.5 * (self.meet - self.thickness[0] - dip - self.nose));
        let bow = (inner[0] - upper).max(ceiling + dip);
        let thinnest = 0.45 * self.thickness[0];
        let top = inner[0].max(bow + thinnest);
        let inner = [top, inner[1].max(top)];
        let bottom = inner[1] + lower;

        let peak_half = (self.peaks * ratio.powf(0.9) * (1.0 + 0.15 * sneer)).min(0.3 * width);
        let peak_y = (bow - dip * (1.0 + 0.5 * sneer)).max(ceiling);
        let corner_y = |c: Point| {
            within(c.y + moves.down, (peak_y - 0.25 * self.unit).max(self.nose + 1.0), lerp(inner[1], bottom, 0.9))
        };
        let corners = [Point::new(x[0], corner_y(self.corners[0])), Point::new(x[1], corner_y(self.corners[1]))];
        let peaks = [Point::new(middle - peak_half, peak_y), Point::new(middle + peak_half, peak_y)];
        let middles = [bow, inner[0], inner[1], bottom].map(|y| Point::new(middle, y));
        let mut mouth = Mouth::through(corners, peaks, middles, Look { rounded, pout, sneer });
        mouth.neutral_width = self.width;
        mouth.bite = moves.bite;
        mouth.tongue = moves.tongue;
        mouth
    }
}

/// A mouth whose numbers are such as a score can mean: what is farther out, or no number, is brought in.
fn sound(mouth: &MouthPose) -> MouthPose {
    MouthPose {
        upper: within(mouth.upper, -0.8, 0.8),
        lower: within(mouth.lower, -0.6, 1.8),
        lower_lip: within(mouth.lower_lip, -1.0, 1.0),
        corner_in: within(mouth.corner_in, -0.25, 0.33),
        corner_down: within(mouth.corner_down, -0.8, 0.8),
        thinner: within(mouth.thinner, -0.3, 0.5),
        lower_thinner: within(mouth.lower_thinner, -0.3, 0.5),
        closure: within(mouth.closure, 0.0, 1.0),
        bite: within(mouth.bite, 0.0, 1.0),
        tongue: within(mouth.tongue, 0.0, 1.0),
        speaking: within(mouth.speaking, 0.0, 2.0),
    }
}
