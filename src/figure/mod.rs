//! Figures: what turns a pose into a drawing. The line figures blend seven drawings made of Bézier strokes (paper
//! sec. 2); two come with the program and an author can write more as files. The cartoon draws a person's own face
//! (thesis ch. 4).
//!
//! A figure owns no time: it draws the pose it is given and remembers nothing.

mod author_layer;
mod layer_bounds;
pub mod cartoon;
pub(crate) mod line;

pub use author_layer::LayerPlace;
pub(crate) use author_layer::{AuthorLayer, MAX_LAYER_BYTES};
pub use cartoon::Cartoon;
pub use line::{LineFigure, Widths};

use crate::drawing::Drawing;
use crate::geometry::Rect;
use crate::pose::Pose;

/// A figure of either kind.
#[derive(Debug, Clone)]
pub enum Figure {
    /// Seven drawings, blended.
    Line(Box<LineFigure>),
    /// A person's face.
    Cartoon(Box<Cartoon>),
}

impl Figure {
    /// The drawing of a pose: what stays the same on the layer `static`, what moves on `dynamic` (thesis 7.3.1).
    #[must_use]
    pub fn draw(&self, pose: &Pose) -> Drawing {
        match self {
            Self::Line(figure) => figure.draw(pose),
            Self::Cartoon(figure) => figure.draw(pose),
        }
    }

    /// The figure with widths of strokes that run so between control points. A cartoon's lines are drawn by a brush of
    /// their own, which has no such points: it stays as it is.
    #[must_use]
    pub fn with_widths(self, widths: Widths) -> Self {
        match self {
            Self::Line(figure) => Self::Line(Box::new(figure.with_widths(widths))),
            Self::Cartoon(_) => self,
        }
    }

    /// What the figure is called.
    #[must_use]
    pub(crate) fn title(&self) -> &str {
        match self {
            Self::Line(figure) => figure.title(),
            Self::Cartoon(figure) => figure.title(),
        }
    }

    /// The part of its plane with the face.
    #[must_use]
    pub fn face_view(&self) -> Rect {
        match self {
            Self::Line(figure) => figure.face_view(),
            Self::Cartoon(figure) => figure.face_view(),
        }
    }

    /// The figure as small pictures need it: the face without what is round it, its lines `bolder` times as wide.
    #[must_use]
    pub(crate) fn close_up(&self, bolder: f64) -> Self {
        match self {
            Self::Line(figure) => Self::Line(Box::new(figure.close_up(bolder))),
            Self::Cartoon(figure) => Self::Cartoon(Box::new(figure.close_up(bolder))),
        }
    }

    /// A number that tells figures apart: line figures by their names, cartoons by how they look.
    #[must_use]
    pub fn key(&self) -> u64 {
        match self {
            // FNV-1a.
            Self::Line(figure) => figure
                .title()
                .bytes()
                .fold(0xCBF2_9CE4_8422_2325, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)),
            Self::Cartoon(figure) => figure.fingerprint(),
        }
    }
}

impl From<LineFigure> for Figure {
    fn from(figure: LineFigure) -> Self {
        Self::Line(Box::new(figure))
    }
}

impl From<Cartoon> for Figure {
    fn from(figure: Cartoon) -> Self {
        Self::Cartoon(Box::new(figure))
    }
}

/// What a pose shows, in a sentence.
fn describe(pose: &Pose) -> String {
    let (emotion, ratio) = pose.ratios.strongest();
    let mood = if ratio >= 0.2 { format!("{emotion} {ratio:.2}") } else { "neutral".to_owned() };
    match pose.shape {
        Some(shape) => format!("A face: {mood}, mouth {shape}."),
        None => format!("A face: {mood}."),
    }
}
