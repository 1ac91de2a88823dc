//! The pictures of a book: its cover, and what stands where no face can be shown.

use crate::disk::Result;
use crate::drawing::{Anchor, Colour, Drawing, Group, Item, Layer, fit};
use crate::figure::Figure;
use crate::geometry::{Point, Rect};
use crate::pose::Pose;
use crate::render::{text_width, to_png, uncovered};
use crate::script;

/// Pixels of a cover.
const COVER: [u32; 2] = [750, 1000];

/// Widest title, in pixels.
const ROOM: f64 = 650.0;

/// A PNG of the figure at rest with the title over it. Our own font has no Chinese: it stands there in Pinyin.
///
/// # Errors
/// When it cannot be painted.
pub(super) fn cover(figure: &Figure, title: &str) -> Result<Vec<u8>> {
    let face = figure.draw(&Pose::default());
    let [width, height] = COVER.map(f64::from);
    let said = if uncovered(title).is_none() { title.to_owned() } else { script::in_latin(title) };
    // What our font still lacks cannot be shown.
    let said: String = said.chars().filter(|c| uncovered(&c.to_string()).is_none()).collect();
    let size = (64.0 * (ROOM / text_width(&said, 64.0, None).max(1.0)).min(1.0)).max(14.0);
    let ground = face.background.unwrap_or(Colour::WHITE);
    let light = u32::from(ground.r) * 3 + u32::from(ground.g) * 6 + u32::from(ground.b);
    let ink = if light > 1400 { Colour::rgb(0x24, 0x21, 0x1d) } else { Colour::WHITE };
    let items = vec![
        below(&face, 210.0, [width, height]),
        Item::text(Point::new(width / 2.0, 130.0), size, Anchor::Middle, ink, said),
    ];
    paint(
        &Drawing {
            view: Rect::new(0.0, 0.0, width, height),
            title: title.to_owned(),
            description: String::new(),
            background: Some(ground),
            layers: vec![Layer { name: "static".into(), items }],
        },
        COVER,
    )
}

/// A figure that fills a page from some height down, and ends with it at its sides.
fn below(face: &Drawing, top: f64, [width, height]: [f64; 2]) -> Item {
    let room = height - top;
    let wide = room * face.view.width() / face.view.height();
    let frame = Rect::new((width - wide) / 2.0, top, f64::midpoint(width, wide), height);
    let items = face.layers.iter().flat_map(|layer| layer.items.iter().cloned()).collect();
    Item::Group(Group { name: String::new(), transform: fit(face.view, frame), clip: None, items })
}

/// A PNG of a drawing, half as large as the picture and no wider than 800 pixels.
///
/// # Errors
/// When it cannot be painted.
pub(crate) fn poster(drawing: &Drawing, size: [u32; 2]) -> Result<Vec<u8>> {
    let by = (800.0 / f64::from(size[0])).min(1.0);
    paint(drawing, size.map(|side| (f64::from(side) * by).round().max(1.0) as u32))
}

fn paint(drawing: &Drawing, size: [u32; 2]) -> Result<Vec<u8>> {
    to_png(drawing, size[0], size[1])
}
