//! A picture in grey at halved sizes, and crops of it that are turned and scaled to order.

use crate::geometry::{Point, Similarity, Vec2};
use crate::photo::{Photo, Plane};

/// Luma at full size, half, a quarter …, of a photo or of a part of one.
#[derive(Debug, Clone)]
pub struct Pyramid {
    levels: Vec<Plane>,
    /// Photo pixels to a pixel of the first level.
    step: f64,
    /// The photo pixel whose corner is the corner of the first level.
    corner: Point,
}

impl Pyramid {
    /// Of a whole photo, or of a reduced copy of which each pixel is `step` pixels wide.
    #[must_use]
    pub fn of(photo: &Photo, step: f64) -> Self {
        Self::over(Plane::luma(photo), step, Point::ORIGIN)
    }

    /// Of the square round a face that reaches 2.2 pupil distances from between the mouth and the eyes: reduced by
    /// whole pixels, but so that at least `fine` of them make a pupil distance where the photo has them.
    #[must_use]
    pub(crate) fn round_face(photo: &Photo, face: &Similarity, fine: f64) -> Self {
        let middle = face.apply(Point::new(0.0, 0.3));
        let reach = 2.2 * face.scale();
        let step = ((face.scale() / fine) as usize).max(1);
        let start = |v: f64, size: usize| (v.max(0.0) as usize).min(size - 1) / step * step;
        let (x0, y0) = (start(middle.x - reach, photo.width()), start(middle.y - reach, photo.height()));
        let count = |from: usize, to: f64, size: usize| ((to.clamp(0.0, size as f64) as usize).max(from) - from) / step;
        let width = count(x0, middle.x + reach, photo.width()).max(1);
        let height = count(y0, middle.y + reach, photo.height()).max(1);
        let mut first = Plane::filled(width, height, 0.0);
        // Luma by Rec. 601, as `Plane::luma`, here in 1/1000 and summed over whole blocks.
        let part = 1.0 / (1000 * step * step) as f32;
        let mut sums = vec![0_u32; width];
        for row in 0..height {
            sums.fill(0);
            for y in (y0 + row * step..y0 + (row + 1) * step).map(|y| y.min(photo.height() - 1)) {
                for (sum, block) in sums.iter_mut().zip(photo.row(y)[x0..].chunks(step)) {
                    *sum += block
                        .iter()
                        .map(|p| 299 * u32::from(p[0]) + 587 * u32::from(p[1]) + 114 * u32::from(p[2]))
                        .sum::<u32>();
                }
            }
            first.row_mut(row).iter_mut().zip(&sums).for_each(|(o, s)| *o = *s as f32 * part);
        }
        Self::over(first, step as f64, Point::new(x0 as f64, y0 as f64))
    }

    /// Of a grey plane of which each pixel is `step` photo pixels wide; `corner` is where its corner lies.
    #[must_use]
    pub fn over(first: Plane, step: f64, corner: Point) -> Self {
        let mut levels = vec![first];
        while let Some(last) = levels.last().filter(|l| l.width() >= 32 && l.height() >= 32) {
            let half = halved(last);
            levels.push(half);
        }
        Self { levels, step, corner }
    }

    /// A crop of `width` × `height` pixels. Its pixel (u, v) shows the photo at `place.apply((u, v))`; that is, the
    /// frame's unit is a pixel of the crop. Beyond the border the border's values go on.
    #[must_use]
    pub fn crop(&self, place: &Similarity, width: usize, height: usize) -> Plane {
        let reduction = place.scale() / self.step;
        let level = (reduction.max(1.0).log2().round() as usize).min(self.levels.len() - 1);
        let (plane, size) = (&self.levels[level], self.step * f64::from(1_u32 << level));
        // A pixel's middle is a whole number in the photo and here, its corner half a pixel before.
        let on = |p: Point| (p - self.corner + Vec2::new(0.5, 0.5)) / size;
        let start = on(place.origin) - Vec2::new(0.5, 0.5);
        let (dx, dy) = ((place.a / size) as f32, (place.b / size) as f32);
        let mut values = Vec::with_capacity(width * height);
        for v in 0..height {
            let (x0, y0) = (start.x as f32 - dy * v as f32, start.y as f32 + dx * v as f32);
            values.extend((0..width).map(|u| {
                let (x, y) = (x0 + dx * u as f32, y0 + dy * u as f32);
                plane.sample(f64::from(x), f64::from(y))
            }));
        }
        Plane::new(width, height, values)
    }

    /// Width and height of what it shows, in photo pixels.
    #[must_use]
    pub fn size(&self) -> (f64, f64) {
        (self.levels[0].width() as f64 * self.step, self.levels[0].height() as f64 * self.step)
    }

    /// Photo pixels to a pixel of its first level.
    #[must_use]
    pub(crate) fn step(&self) -> f64 {
        self.step
    }
}

/// Means of two by two; an odd last row or column is left out.
fn halved(plane: &Plane) -> Plane {
    let (width, height) = (plane.width() / 2, plane.height() / 2);
    let mut values = Vec::with_capacity(width * height);
    for rows in plane.pixels().chunks_exact(2 * plane.width()).take(height) {
        let (top, low) = rows.split_at(plane.width());
        values.extend(top.chunks_exact(2).zip(low.chunks_exact(2)).map(|(t, l)| (t[0] + t[1] + l[0] + l[1]) * 0.25));
    }
    Plane::new(width, height, values)
}
