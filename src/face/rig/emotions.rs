//! What the seven emotions do to a face, as data, and how ratios mix them.

use std::sync::LazyLock;

use super::within;
use crate::pose::{Emotion, Ratios};

/// What a mix of emotions does to each part of a face, away from neutral (recipe part 5). Moves are y down and the
/// same on both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expression {
    /// Inner ends of the brows toward the middle, in ES0.
    pub brow_in: f64,
    /// Inner ends of the brows down, in ES0.
    pub brow_inner: f64,
    /// Middles of the brows down, in ES0.
    pub brow_middle: f64,
    /// Outer ends of the brows down, in ES0.
    pub brow_outer: f64,
    /// How far the upper lid stands above the eyeball's middle: 1 neutral, below 1 lower.
    pub lid_upper: f64,
    /// How far the lower lid is raised, in heights of the eye.
    pub lid_lower: f64,
    /// The iris, 1 neutral.
    pub iris: f64,
    /// Eyes down, in heights of the eye.
    pub look_down: f64,
    /// The upper lip down, in M = max(MNS0, 0.33 MW0).
    pub upper: f64,
    /// The lower lip down, in M.
    pub lower: f64,
    /// Each corner of the mouth outward, in MW0.
    pub corner_out: f64,
    /// Corners of the mouth down, in M.
    pub corner_down: f64,
    /// Thickness of the lips, 1 neutral.
    pub thick: f64,
    /// How far the lower lip is pushed up and out, 0 to 1.
    pub pout: f64,
    /// How far the upper lip is drawn up beside its middle, 0 to 1.
    pub sneer: f64,
    /// How far the cheeks are raised, 0 to 1.
    pub cheek: f64,
    /// The crease from the nose's wing to the mouth's corner, 0 to 1.
    pub crease: f64,
    /// The lines between the brows, 0 to 1.
    pub frown: f64,
    /// The lines on the nose's bridge, 0 to 1.
    pub wrinkle: f64,
    /// The lines of the forehead over raised brows, 0 to 1.
    pub forehead: f64,
}

/// Numbers of an [`Expression`], and columns of the table after the first.
pub(crate) const EXPRESSION_NUMBERS: usize = 20;
/// The first of the columns that say how much of something there is, which is never less than none.
const FIRST_AMOUNT: usize = 13;
/// How far a single ratio counts: the paper's decomposition gives values a little outside 0 to 1, a slip gives any.
const RATIOS: (f64, f64) = (-1.0, 2.0);
/// How far a mix may go beyond the largest and the smallest number of a column, in the column's span. It keeps the
/// overdrawn ratios of the paper's figures alive and turns nothing inside out.
const BEYOND: f64 = 0.25;

impl Expression {
    /// The expression of a mix as everybody has it: [`Expressions::general`] blended.
    #[must_use]
    pub(crate) fn of(ratios: &Ratios) -> Self {
        Expressions::general().mix(ratios)
    }

    /// Its numbers, in the order of the fields.
    #[must_use]
    pub(crate) const fn to_array(self) -> [f64; EXPRESSION_NUMBERS] {
        [
            self.brow_in,
            self.brow_inner,
            self.brow_middle,
            self.brow_outer,
            self.lid_upper,
            self.lid_lower,
            self.iris,
            self.look_down,
            self.upper,
            self.lower,
            self.corner_out,
            self.corner_down,
            self.thick,
            self.pout,
            self.sneer,
            self.cheek,
            self.crease,
            self.frown,
            self.wrinkle,
            self.forehead,
        ]
    }

    /// From its numbers, in the order of the fields.
    #[must_use]
    pub(crate) const fn from_array(a: [f64; EXPRESSION_NUMBERS]) -> Self {
        Self {
            brow_in: a[0],
            brow_inner: a[1],
            brow_middle: a[2],
            brow_outer: a[3],
            lid_upper: a[4],
            lid_lower: a[5],
            iris: a[6],
            look_down: a[7],
            upper: a[8],
            lower: a[9],
            corner_out: a[10],
            corner_down: a[11],
            thick: a[12],
            pout: a[13],
            sneer: a[14],
            cheek: a[15],
            crease: a[16],
            frown: a[17],
            wrinkle: a[18],
            forehead: a[19],
        }
    }
}

/// The expressions of the seven emotions: everybody's, or a person's own.
#[derive(Debug, Clone, PartialEq)]
pub struct Expressions {
    rows: [[f64; EXPRESSION_NUMBERS]; 7],
    /// Between which values a mix of each column is kept.
    spans: [(f64, f64); EXPRESSION_NUMBERS],
}

impl Expressions {
    /// Everybody's: the table of the recipe.
    #[must_use]
    pub fn general() -> &'static Self {
        &TABLE
    }

    /// From the expression of each emotion, in canonical order. What is no number is everybody's; and no number is
    /// taken farther than a mix of everybody's may go: no face is turned inside out.
    #[must_use]
    pub(crate) fn of(list: &[Expression; 7]) -> Self {
        let general = Self::general();
        let mut rows = list.map(|e| e.to_array());
        for (row, usual) in rows.iter_mut().zip(&general.rows) {
            for ((v, usual), (low, high)) in row.iter_mut().zip(usual).zip(&general.spans) {
                *v = if v.is_finite() { within(*v, *low, *high) } else { *usual };
            }
        }
        Self { spans: spans(&rows), rows }
    }

    /// The expression of an emotion alone.
    #[must_use]
    pub fn expression(&self, emotion: Emotion) -> Expression {
        Expression::from_array(self.rows[emotion.index()])
    }

    /// The expression of a mix: the rows blended by the ratios (paper eq. 6), each number kept within a quarter of its
    /// column's span beyond what any one emotion asks for.
    #[must_use]
    pub(crate) fn mix(&self, ratios: &Ratios) -> Expression {
        let neutral = &self.rows[0];
        let mut mix = *neutral;
        for emotion in &Emotion::ALL[1..] {
            let share = within(ratios[*emotion], RATIOS.0, RATIOS.1);
            for ((sum, full), rest) in mix.iter_mut().zip(&self.rows[emotion.index()]).zip(neutral) {
                *sum += share * (full - rest);
            }
        }
        for (sum, (low, high)) in mix.iter_mut().zip(&self.spans) {
            *sum = within(*sum, *low, *high);
        }
        Expression::from_array(mix)
    }
}

/// Between which values mixes of rows are kept.
fn spans(rows: &[[f64; EXPRESSION_NUMBERS]; 7]) -> [(f64, f64); EXPRESSION_NUMBERS] {
    std::array::from_fn(|i| {
        let column = || rows.iter().map(|row| row[i]);
        let (low, high) = (column().fold(f64::INFINITY, f64::min), column().fold(f64::NEG_INFINITY, f64::max));
        let beyond = BEYOND * (high - low);
        (if i < FIRST_AMOUNT { low - beyond } else { 0.0 }, high + beyond)
    })
}

/// `emotions.csv`. The table is part of the program, so a fault in it is ours and the tests'.
static TABLE: LazyLock<Expressions> = LazyLock::new(|| {
    let mut rows = [[0.0; EXPRESSION_NUMBERS]; 7];
    for line in include_str!("emotions.csv").lines().skip(1) {
        let mut cells = line.split(',');
        let Some(emotion) = cells.next().and_then(|c| c.parse::<Emotion>().ok()) else { continue };
        for (number, cell) in rows[emotion.index()].iter_mut().zip(cells) {
            *number = cell.parse().unwrap_or(0.0);
        }
    }
    Expressions { spans: spans(&rows), rows }
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_a_number_in_every_cell_and_its_columns_are_the_fields() {
        let text = include_str!("emotions.csv");
        let heading: Vec<&str> = text.lines().next().unwrap().split(',').skip(1).collect();
        // Fields in order, as Debug prints them.
        let printed = format!("{:?}", Expression::of(&Ratios::NEUTRAL));
        let mut from = 0;
        for name in &heading {
            let at = printed[from..].find(&format!(" {name}: ")).unwrap_or_else(|| panic!("{name} out of order"));
            from += at + 1;
        }
        assert_eq!(heading.len(), EXPRESSION_NUMBERS);
        let rows: Vec<&str> = text.lines().skip(1).collect();
        assert_eq!(rows.len(), 7);
        for (row, emotion) in rows.iter().zip(Emotion::ALL) {
            assert!(row.starts_with(emotion.name()));
            assert_eq!(
                row.split(',').skip(1).filter(|c| c.parse::<f64>().is_ok()).count(),
                EXPRESSION_NUMBERS,
                "{row}"
            );
        }
    }

    #[test]
    fn a_mix_is_the_rows_blended_and_a_wild_one_stays_near_the_table() {
        let half = Expression::of(&Ratios::some(Emotion::Happy, 0.5));
        assert!((half.corner_down + 0.2).abs() < 1e-12 && (half.lid_upper - 0.95).abs() < 1e-12);
        let wild = Expression::of(&Ratios([0.0, 1e300, -1e300, 0.0, f64::MAX, 0.0, -5.0]));
        assert!(wild.corner_down >= -0.4 - 0.25 * 0.88 - 1e-12 && wild.lid_upper >= 0.5 && wild.frown == 0.0);
    }
}
