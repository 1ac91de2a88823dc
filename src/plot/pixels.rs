//! Photos, masks and planes as pixels in a chart.

use crate::drawing::{Colour, Item, Picture, Raster};
use crate::geometry::Affine;
use crate::photo::{Bounds, Hsi, Mask, Photo, Plane, hue_distance};

/// Paper where a mask is not set.
pub(super) const LIGHT: Colour = Colour::rgb(0xF4, 0xF3, 0xEF);

fn raster(picture: Picture) -> Item {
    Item::Picture(Raster::new("", picture))
}

fn rgba(c: Colour) -> [u8; 4] {
    [c.r, c.g, c.b, c.a]
}

/// A photo in a drawing, a unit a pixel.
pub(super) fn image(photo: &Photo) -> Item {
    raster(photo.map(|p| [p[0], p[1], p[2], 255]))
}

/// A photo as a pale ground for what is drawn over it.
pub(super) fn faded(photo: &Photo) -> Item {
    let pale = |v: u8| (110 + u16::from(v) * 145 / 255) as u8;
    raster(photo.map(|p| [pale(p[0]), pale(p[1]), pale(p[2]), 255]))
}

/// A mask in two colours.
pub(super) fn mask_image(mask: &Mask, set: Colour, unset: Colour) -> Item {
    raster(mask.map(|b| rgba(if *b { set } else { unset })))
}

/// A photo where a mask is set, paper elsewhere.
pub(super) fn cut_out(photo: &Photo, mask: &Mask) -> Item {
    raster(photo.with(mask, |p, set| if *set { [p[0], p[1], p[2], 255] } else { rgba(LIGHT) }))
}

/// A plane in greys, 0 to 255 by `grey`.
pub(super) fn plane_image(plane: &Plane, grey: impl Fn(f32) -> f32) -> Item {
    let level = |v: f32| grey(v).clamp(0.0, 255.0) as u8;
    raster(plane.map(|v| [level(*v), level(*v), level(*v), 255]))
}

/// Hue as its nearness to the face's: orange on the hue itself, blue opposite, pale between.
pub(super) fn hue_image(hsi: &Hsi, mean: f32) -> Item {
    const WARM: [f32; 3] = [213.0, 94.0, 0.0];
    const PALE: [f32; 3] = [244.0, 243.0, 239.0];
    const COLD: [f32; 3] = [0.0, 114.0, 178.0];
    let pixel = |v: &f32| {
        let far = hue_distance(*v, mean) / 128.0;
        let (a, b, t) = if far < 0.25 { (WARM, PALE, far / 0.25) } else { (PALE, COLD, (far - 0.25) / 0.75) };
        let channel = |k: usize| (a[k] + (b[k] - a[k]) * t) as u8;
        [channel(0), channel(1), channel(2), 255]
    };
    raster(hsi.hue.map(pixel))
}

/// Single pixels within a box, in one colour.
pub(super) fn pixels_image(pixels: &[(usize, usize)], within: &Bounds, colour: Colour) -> Item {
    let mut picture = Picture::filled(within.width(), within.height(), [0; 4]);
    for (x, y) in pixels.iter().filter(|(x, y)| within.holds(*x, *y)) {
        picture[(x - within.x0, y - within.y0)] = rgba(colour);
    }
    let place = Affine::translate((within.x0 as f64, within.y0 as f64));
    Item::Picture(Raster::new("", picture).placed(place))
}
