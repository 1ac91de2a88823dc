//! How the width of a line runs between its four control points: two readings of the same table.

use std::str::FromStr;

use crate::geometry::Ribbon;

/// How the width of a line runs between its control points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Widths {
    /// It is the third coordinate of the Bézier curve: it runs smoothly, and between the ends comes near the inner
    /// points' widths without reaching them, as the line comes near those points.
    #[default]
    Bezier,
    /// By "interpolation of the adjacent control points" (paper sec. 3.2): straight from one control point's width to the
    /// next one's, each in a third of the line.
    Paper,
}

impl Widths {
    /// The strokes to be drawn for a line whose control points have these widths.
    #[must_use]
    pub(crate) fn of(self, strokes: &[Ribbon]) -> Vec<Ribbon> {
        match self {
            Self::Bezier => strokes.to_vec(),
            Self::Paper => strokes.iter().flat_map(Ribbon::as_in_paper).collect(),
        }
    }

    /// `bezier` or `paper`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bezier => "bezier",
            Self::Paper => "paper",
        }
    }
}

impl FromStr for Widths {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "bezier" => Ok(Self::Bezier),
            "paper" => Ok(Self::Paper),
            _ => Err(format!("`{text}` is no way for widths to run: write bezier or paper")),
        }
    }
}
