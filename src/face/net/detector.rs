//! The face detector: BlazeFace for near faces, 128 × 128 pixels, with a box and six points a face.
//!
//! It owns the search over a photo: the whole picture, and where that has no face, overlapping tiles and quarter turns.

use std::sync::OnceLock;

use super::crop::{Beyond, Levels, Square};
use super::graph::{Net, Scratch};
use crate::geometry::{Point, Rect};

/// Side of the net's input, in pixels.
const SIDE: usize = 128;
/// Cells along a side of each grid of anchors, and anchors of a cell.
const GRIDS: [(usize, usize); 2] = [(16, 2), (8, 6)];
/// Numbers of an anchor: box and six points, in pixels of the input from the cell's centre.
const NUMBERS: usize = 16;
/// Faces with a lower score are not reported: in the whole picture, and in tiles, of which there are many.
const LEAST_SCORE: f32 = 0.5;
const LEAST_SCORE_IN_TILES: f32 = 0.6;
/// Boxes that share more than this part of their union are of one face.
const SAME_FACE: f64 = 0.3;
/// Sides of the tiles, in parts of the picture's longer side.
const TILES: [f64; 2] = [1.0 / 2.0, 1.0 / 3.5];
/// The smallest side of a tile, in pixels.
const SMALLEST_TILE: f64 = 96.0;

/// A face as the detector sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Detection {
    /// 0 to 1.
    pub score: f32,
    /// From the brows to the chin, in pixels of the photo; upright in the turned picture that it was found in.
    pub area: Rect,
    /// The eye at the image's left, the one at its right, the tip of the nose, the mouth, the left and the right ear, in
    /// pixels of the photo.
    pub points: [Point; 6],
}

impl Detection {
    /// The square that the mesh looks at: 1.5 times the box, the eyes level.
    #[must_use]
    pub fn square(&self) -> Square {
        let across = self.points[1] - self.points[0];
        let turn = libm::atan2(across.y, across.x);
        Square { centre: self.area.center(), side: 1.5 * self.area.width().max(self.area.height()), turn }
    }
}

/// The net of the detector, read once.
fn net() -> &'static Net {
    static NET: OnceLock<Net> = OnceLock::new();
    NET.get_or_init(|| {
        let file = include_bytes!("face_detection_short_range.tflite");
        Net::read(file).expect("a test reads the carried net")
    })
}

/// Faces in a photo, the highest score first: in the whole picture; if there are none, in tiles of a half and then two
/// sevenths of its longer side.
#[must_use]
pub fn detect(levels: &Levels<'_>, scratch: &mut Scratch) -> Vec<Detection> {
    let [width, height] = levels.size();
    let centre = Point::new((width - 1.0) / 2.0, (height - 1.0) / 2.0);
    let whole = Square { centre, side: width.max(height), turn: 0.0 };
    let mut found = merged(detect_in(levels, &whole, LEAST_SCORE, scratch));
    for part in TILES {
        if !found.is_empty() {
            break;
        }
        let side = (width.max(height) * part).min(width.min(height)).max(SMALLEST_TILE);
        let mut all = Vec::new();
        for y in tile_centres(height, side) {
            for x in tile_centres(width, side) {
                let tile = Square { centre: Point::new(x, y), side, turn: 0.0 };
                all.extend(detect_in(levels, &tile, LEAST_SCORE_IN_TILES, scratch));
            }
        }
        found = merged(all);
    }
    found
}

/// The highest score of a face in the whole picture turned by quarter turns clockwise, 0 to 3.
#[must_use]
pub fn scores_by_turn(levels: &Levels<'_>, scratch: &mut Scratch) -> [f32; 4] {
    let [width, height] = levels.size();
    let centre = Point::new((width - 1.0) / 2.0, (height - 1.0) / 2.0);
    [0.0, 1.0, 2.0, 3.0].map(|quarters| {
        let turn = quarters * std::f64::consts::FRAC_PI_2;
        let square = Square { centre, side: width.max(height), turn };
        let found = detect_in(levels, &square, LEAST_SCORE, scratch);
        found.iter().map(|d| d.score).fold(0.0, f32::max)
    })
}

/// Centres of tiles that overlap by half, along an axis.
fn tile_centres(length: f64, side: f64) -> Vec<f64> {
    let count = ((length - side) / (side / 2.0)).ceil().max(0.0) as usize + 1;
    let step = if count > 1 { (length - side) / (count - 1) as f64 } else { 0.0 };
    (0..count).map(|i| (side - 1.0) / 2.0 + step * i as f64).collect()
}

/// Anchors of a square with a score of at least `least`, before they are merged.
fn detect_in(levels: &Levels<'_>, square: &Square, least: f32, scratch: &mut Scratch) -> Vec<Detection> {
    let input = levels.crop(square, SIDE, [-1.0, 1.0], Beyond::Black);
    let outputs = net().run(&input, scratch);
    let [numbers, scores] = &outputs[..] else { return Vec::new() };
    let mut anchors = scores.iter().zip(numbers.as_chunks::<NUMBERS>().0);
    let mut found = Vec::new();
    for (cells, anchors_of_cell) in GRIDS {
        for cell in 0..cells * cells {
            let centre = |i: usize| (i as f64 + 0.5) / cells as f64 - 0.5;
            let (x, y) = (centre(cell % cells), centre(cell / cells));
            for (score, numbers) in anchors.by_ref().take(anchors_of_cell) {
                let score = 1.0 / (1.0 + libm::expf(-score.clamp(-100.0, 100.0)));
                if score >= least {
                    let of = |i: usize| f64::from(numbers[i]) / SIDE as f64;
                    let point = |i: usize| square.point(x + of(i), y + of(i + 1));
                    let size = (of(2) * square.side, of(3) * square.side);
                    let area = Rect::from_center_size(point(0), size);
                    let points = std::array::from_fn(|i| point(4 + 2 * i));
                    found.push(Detection { score, area, points });
                }
            }
        }
    }
    found
}

/// Detections of one face as one: their mean, weighted by score. The highest score first.
fn merged(mut all: Vec<Detection>) -> Vec<Detection> {
    all.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut out = Vec::new();
    while let Some(first) = all.first().copied() {
        let (same, others): (Vec<_>, Vec<_>) =
            all.into_iter().enumerate().partition(|(i, d)| *i == 0 || overlap(&first.area, &d.area) > SAME_FACE);
        all = others.into_iter().map(|(_, d)| d).collect();
        let total: f64 = same.iter().map(|(_, d)| f64::from(d.score)).sum();
        let mean = |value: &dyn Fn(&Detection) -> f64| {
            same.iter().map(|(_, d)| f64::from(d.score) / total * value(d)).sum::<f64>()
        };
        let area = Rect::new(mean(&|d| d.area.x0), mean(&|d| d.area.y0), mean(&|d| d.area.x1), mean(&|d| d.area.y1));
        let points = std::array::from_fn(|i| Point::new(mean(&|d| d.points[i].x), mean(&|d| d.points[i].y)));
        out.push(Detection { score: first.score, area, points });
    }
    out
}

/// The common part of two boxes, as a share of their union.
fn overlap(a: &Rect, b: &Rect) -> f64 {
    let common = a.intersect(*b);
    let common = if common.width() > 0.0 && common.height() > 0.0 { common.area() } else { 0.0 };
    common / (a.area() + b.area() - common).max(1e-9)
}
