//! Where in a picture a face may be: linear templates over cells of edge directions, slid over the picture at many
//! sizes (Dalal and Triggs 2005), one for each of a few tilts of the head.

use super::Pyramid;
use super::channels::{BINS, Channels};
use super::weights::{Matrix, Reader, Writer, dot};
use crate::geometry::{Point, Similarity};
use crate::photo::Plane;

/// Pixels in a pupil distance at the size that a template is for.
pub const SCALE: f64 = 16.0;
/// Pixels along a side of a cell: a quarter of a pupil distance.
pub const CELL: usize = 4;
/// Cells along a side of a template: two and a half pupil distances.
pub const SIDE: usize = 10;
/// Numbers in a window.
#[cfg(feature = "tools")]
pub const WINDOW: usize = SIDE * SIDE * BINS;
/// The middle of a window, in pupil distances below the pupils: it reaches from above the brows to the chin.
pub const BELOW: f64 = 0.40;
/// Each size is so much larger than the one before.
const STEP: f64 = 1.2;

/// Templates and what they say of a window.
#[derive(Debug, Clone, PartialEq)]
pub struct Detector {
    /// The tilt that each template is for, in radians.
    pub rolls: Vec<f32>,
    /// One template a row.
    pub templates: Matrix,
    /// What each template's sum starts from.
    pub bias: Vec<f32>,
}

/// A window that looks like a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The face's frame in the photo, to within a cell.
    pub frame: Similarity,
    /// The template's sum: 0 is undecided.
    pub score: f32,
    /// Which template.
    pub template: usize,
}

/// The cells of a plane, each held against the strength of those round it, which light does not change.
#[must_use]
pub fn cells(plane: &Plane) -> Channels {
    let raw = Channels::cells(plane, CELL);
    let (w, h) = (raw.width(), raw.height());
    let square: Plane = raw.map(|c| c.iter().map(|v| v * v).sum());
    let mut values = Vec::with_capacity(w * h);
    for y in 0..h {
        let rows = [y.saturating_sub(1), y, (y + 1).min(h - 1)].map(|y| square.row(y));
        let column = |x: usize| rows[0][x] + 2.0 * rows[1][x] + rows[2][x];
        for x in 0..w {
            let near = column(x.saturating_sub(1)) + 2.0 * column(x) + column((x + 1).min(w - 1));
            // A 3 × 3 binomial mean has weights of sixteen in all. Light without edges must not be blown up: 24 is
            // what a cell holds of the noise of a good camera.
            let inverse = 1.0 / (near / 16.0 + 24.0 * 24.0).sqrt();
            values.push(raw[(x, y)].map(|v| (v * inverse).min(0.6)));
        }
    }
    Channels::new(w, h, values)
}

/// The numbers of the window whose first cell is at `x`, `y`.
#[cfg(feature = "tools")]
pub fn window(cells: &Channels, x: usize, y: usize, out: &mut Vec<f32>) {
    out.clear();
    for row in y..y + SIDE {
        out.extend(cells.row(row)[x..x + SIDE].iter().flatten());
    }
}

impl Detector {
    /// The windows of a picture whose sum is above `least`, best first, without those that overlap a better one.
    /// `smallest` is the smallest pupil distance, in pixels of the photo.
    #[must_use]
    pub fn scan(&self, picture: &Pyramid, smallest: f64, least: f32) -> Vec<Hit> {
        let (width, height) = picture.size();
        let mut hits = Vec::new();
        let mut scale = smallest;
        // A window may reach out of the picture by a fifth of its side.
        let margin = 2 * CELL;
        while scale / SCALE * 0.6 * (SIDE * CELL) as f64 <= width.min(height) {
            let step = scale / SCALE;
            let size = |v: f64| (v / step) as usize / CELL * CELL + 2 * margin;
            // Pixel (0, 0) of the level shows what lies `margin` of its pixels before the photo's corner.
            let corner = (0.5 - margin as f64) * step - 0.5;
            let place = Similarity { a: step, b: 0.0, origin: Point::new(corner, corner) };
            let level = cells(&picture.crop(&place, size(width), size(height)));
            self.scan_level(&level, &place, least, &mut hits);
            scale *= STEP;
        }
        hits.sort_by(|a, b| b.score.total_cmp(&a.score));
        apart(hits)
    }

    fn scan_level(&self, level: &Channels, place: &Similarity, least: f32, hits: &mut Vec<Hit>) {
        let (w, h) = (level.width(), level.height());
        if w < SIDE || h < SIDE {
            return;
        }
        let flat = level.pixels().as_flattened();
        for y in 0..=h - SIDE {
            for x in 0..=w - SIDE {
                for (template, roll) in self.rolls.iter().enumerate() {
                    let weights = self.templates.row(template);
                    let score = self.bias[template]
                        + (0..SIDE)
                            .map(|r| {
                                let from = ((y + r) * w + x) * BINS;
                                let part = &weights[r * SIDE * BINS..(r + 1) * SIDE * BINS];
                                dot(part, &flat[from..from + SIDE * BINS])
                            })
                            .sum::<f32>();
                    if score > least {
                        hits.push(Hit { frame: frame_of(x, y, f64::from(*roll), place), score, template });
                    }
                }
            }
        }
    }

    /// Into bytes.
    pub(crate) fn write(&self, out: &mut Writer) {
        out.numbers(&self.rolls);
        out.matrix(&self.templates);
        out.numbers(&self.bias);
    }

    /// From bytes.
    pub(crate) fn read(bytes: &mut Reader) -> Option<Self> {
        Some(Self { rolls: bytes.numbers()?, templates: bytes.matrix()?, bias: bytes.numbers()? })
    }
}

/// The face's frame, of a window whose first cell is at `x`, `y` of a level that lies at `place`.
fn frame_of(x: usize, y: usize, roll: f64, place: &Similarity) -> Similarity {
    let half = (SIDE * CELL) as f64 / 2.0 - 0.5;
    let middle = Point::new((x * CELL) as f64 + half, (y * CELL) as f64 + half);
    let turned = Similarity::new(middle, SCALE, roll);
    place.after(&Similarity { origin: turned.apply(Point::new(0.0, -BELOW)), ..turned })
}

/// Best first: those whose middle is farther than 0.7 pupil distances from that of any better one, or which are of
/// quite another size.
fn apart(hits: Vec<Hit>) -> Vec<Hit> {
    let mut kept: Vec<Hit> = Vec::new();
    for hit in hits {
        let middle = |f: &Similarity| f.apply(Point::new(0.0, BELOW));
        let near = |other: &Hit| {
            let (a, b) = (hit.frame.scale(), other.frame.scale());
            middle(&hit.frame).distance(middle(&other.frame)) < 0.7 * a.max(b) && a.max(b) < 1.8 * a.min(b)
        };
        if !kept.iter().any(near) {
            kept.push(hit);
            if kept.len() >= 12 {
                break;
            }
        }
    }
    kept
}
