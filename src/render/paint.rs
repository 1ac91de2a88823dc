//! Lays things on a canvas. Every pixel's colour is worked out from its place in the picture alone.

use super::canvas::{Area, Canvas, lay, mixed, over, pixel_of, scaled};
use super::cover::Cover;
use super::leaf::{Leaf, Shape};
use crate::drawing::Colour;
use crate::geometry::Affine;

/// Room to work in, kept from one thing to the next.
#[derive(Default)]
pub(super) struct Room {
    cover: Cover,
    /// Sheets that nothing is on.
    sheets: Vec<Canvas>,
}

/// Paints the part of a thing that lies in `within`.
pub(super) fn paint(canvas: &mut Canvas, leaf: &Leaf, within: Area, room: &mut Room) {
    let area = leaf.bounds.meet(within).meet(canvas.area());
    if area.is_empty() {
        return;
    }
    match &leaf.shape {
        Shape::Nothing => {}
        Shape::Fill { edges, pixel } if pixel >> 24 == 255 => {
            room.cover.spans(edges, area, |y, x0, x1, share| match canvas.row_mut(y, x0, x1) {
                [one] => *one = mixed(*pixel, *one, share),
                row if share == 255 => row.fill(*pixel),
                row => row.iter_mut().for_each(|p| *p = mixed(*pixel, *p, share)),
            });
        }
        Shape::Fill { edges, pixel } => room.cover.spans(edges, area, |y, x0, x1, share| {
            let source = if share == 255 { *pixel } else { scaled(*pixel, share) };
            match canvas.row_mut(y, x0, x1) {
                [one] => *one = over(source, *one),
                row => lay(row, source),
            }
        }),
        Shape::Glow { to_disc, colour } => glow(canvas, *to_disc, *colour, area),
        Shape::Clipped { edges, leaves } => {
            // On a sheet of its own, which is cut by the clip and then laid down: so the edges of what lies over each
            // other inside do not show through at the clip's.
            let mut sheet = room.sheets.pop().unwrap_or_default();
            sheet.renew(area);
            leaves.iter().for_each(|leaf| paint(&mut sheet, leaf, area, room));
            room.cover.spans(edges, area, |y, x0, x1, share| {
                let below = canvas.row_mut(y, x0, x1).iter_mut();
                for (pixel, source) in below.zip(sheet.row(y, x0, x1)) {
                    *pixel = match source >> 24 {
                        0 => continue,
                        255 if share == 255 => *source,
                        255 => mixed(*source, *pixel, share),
                        _ if share == 255 => over(*source, *pixel),
                        _ => over(scaled(*source, share), *pixel),
                    };
                }
            });
            room.sheets.push(sheet);
        }
        Shape::Picture { edges, sampler } => room.cover.spans(edges, area, |y, x0, x1, share| {
            for (x, pixel) in (x0..x1).zip(canvas.row_mut(y, x0, x1)) {
                *pixel = over(scaled(sampler.at(x, y), share), *pixel);
            }
        }),
    }
}

/// A colour that fades from the middle of an ellipse to nothing at its rim.
fn glow(canvas: &mut Canvas, to_disc: Affine, colour: Colour, area: Area) {
    let [a, b, c, d, e, f] = to_disc.as_coeffs();
    // The few colours that it has.
    let shades: Vec<u32> = (0..=colour.a).map(|alpha| pixel_of([colour.r, colour.g, colour.b, alpha])).collect();
    let most = f64::from(colour.a);
    for y in area.y0..area.y1 {
        let v = f64::from(y) + 0.5;
        let (row_x, row_y) = (c * v + e, d * v + f);
        for (x, pixel) in (area.x0..area.x1).zip(canvas.row_mut(y, area.x0, area.x1)) {
            let u = f64::from(x) + 0.5;
            let (x, y) = (a * u + row_x, b * u + row_y);
            let from_middle = (x * x + y * y).sqrt();
            if from_middle < 1.0 {
                *pixel = over(shades[(most * (1.0 - from_middle) + 0.5) as usize], *pixel);
            }
        }
    }
}
