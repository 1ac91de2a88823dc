//! A moving picture, painted drawing after drawing: one picture that is kept in step, where only what changes is touched.

use std::ops::Range;

use super::Painter;
use super::canvas::Area;
use crate::disk::Result;
use crate::drawing::{Drawing, Picture};

/// Paints drawings of one size into one picture.
pub struct Reel {
    painter: Painter,
    picture: Picture,
    /// Whether the last drawing let nothing through; none before the first.
    opaque: Option<bool>,
}

impl Reel {
    /// For pictures of so many pixels.
    ///
    /// # Errors
    /// When the picture would be too large, or has no pixels.
    pub(crate) fn new(width: u32, height: u32) -> Result<Self> {
        let painter = Painter::new(width, height)?;
        let picture = painter.empty();
        Ok(Self { painter, picture, opaque: None })
    }

    /// Shows the next drawing. Returns the columns and rows outside which it is the same as the one before; empty ones where
    /// it is the same everywhere.
    pub(crate) fn show(&mut self, drawing: &Drawing) -> (Range<u32>, Range<u32>) {
        let plan = self.painter.plan(drawing);
        let painted = self.painter.refresh(&plan, |_| true);
        let opaque = plan.is_opaque();
        let all = self.painter.canvas().area();
        let changed = if self.opaque == Some(opaque) { painted } else { vec![all] };
        self.opaque = Some(opaque);
        changed.iter().for_each(|part| self.painter.hand_out(&mut self.picture, *part, opaque));
        let Some(joined) = changed.into_iter().reduce(Area::join) else { return (0..0, 0..0) };
        (joined.x0 as u32..joined.x1 as u32, joined.y0 as u32..joined.y1 as u32)
    }

    /// What is shown now.
    #[must_use]
    pub(crate) fn picture(&self) -> &Picture {
        &self.picture
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Colour, Item, Layer};
    use crate::geometry::{Circle, Rect, Shape as _};
    use proptest::prelude::*;

    fn disc((x, y, size, seen): (i32, i32, i32, bool)) -> Drawing {
        let outline = Circle::new((f64::from(x), f64::from(y)), f64::from(size)).to_path(0.01);
        Drawing {
            view: Rect::new(0.0, 0.0, 200.0, 136.0),
            title: String::new(),
            description: String::new(),
            background: seen.then_some(Colour::WHITE),
            layers: vec![Layer {
                name: "dynamic".into(),
                items: vec![Item::area("", outline, Colour::rgb(200, 30, 30).faded(0.5))],
            }],
        }
    }

    proptest! {
        #[test]
        fn it_shows_what_a_painter_paints_and_nothing_changes_outside_what_it_says(
            discs in prop::collection::vec((0..200_i32, 0..136_i32, 1..40_i32, prop::bool::weighted(0.8)), 2..8),
        ) {
            let mut reel = Reel::new(200, 136).unwrap();
            let mut before: Option<Picture> = None;
            for drawing in discs.into_iter().map(disc) {
                let (columns, rows) = reel.show(&drawing);
                prop_assert!(reel.picture() == &Painter::new(200, 136).unwrap().paint(&drawing));
                if let Some(before) = &before {
                    for (x, y) in (0..136).flat_map(|y| (0..200).map(move |x| (x, y))) {
                        let inside = columns.contains(&(x as u32)) && rows.contains(&(y as u32));
                        prop_assert!(inside || before[(x, y)] == reel.picture()[(x, y)]);
                    }
                }
                before = Some(reel.picture().clone());
            }
        }
    }
}
