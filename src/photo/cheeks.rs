//! Where the cheeks end, and the ears beyond them (thesis sec. 3.5).

use super::{Bounds, Eyeballs, Mask, Neighbours, Regions};

/// Cheeks and ears of a face's region.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cheeks {
    /// Pixels of the face's region by their distance from the middle between the eyeballs, in whole pixels from 0:
    /// both sides' columns added.
    pub projection: Vec<u32>,
    /// The rows that were counted.
    pub rows: (usize, usize),
    /// The last column of the left cheek, at the image's left.
    pub left: usize,
    /// The last column of the right cheek.
    pub right: usize,
    /// The face's region beyond the left and the right cheek: the ears, where they can be seen.
    pub ears: [Option<Ear>; 2],
}

/// An ear's region.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ear {
    /// The smallest box round it.
    pub bounds: Bounds,
    /// Its pixels, row by row.
    pub pixels: Vec<(usize, usize)>,
}

/// Where the boundary of a cheek may lie, in d from the middle. On the faces of the Face Research Lab London Set (DeBruine
/// and Jones 2017, CC BY 4.0) the lobes of the ears, where cheeks end, lie from 0.99 to 1.41 d.
const NEAR: (f64, f64) = (0.90, 1.40);
/// Smaller specks than this, in d × d, are no ear; one seen from the front has some 0.1.
const LEAST_EAR: f64 = 0.008;
/// Where ears are looked for: above and below the eye line, and outward from the cheek, in d. On the same faces tops lie
/// at 0.01 ± 0.3 d and lobes at 0.77 ± 0.35 d; farther down there is more hair and neck of the face's hue than ear.
const EARS: (f64, f64, f64) = (0.30, 0.82, 0.36);
/// What fills more of that place than this share is a wall or hair, not an ear.
const FULLEST_EAR: f64 = 0.75;

impl Cheeks {
    /// From F_final. The rows of the 2d × 2d square are counted, so that neck and shoulders are not; both sides are
    /// added, since faces are symmetric; the boundary is the local minimum nearest d from the middle. Where there is
    /// none, it is where the projection falls fastest.
    #[must_use]
    pub(crate) fn of(face: &Mask, eyes: &Eyeballs, square: &Bounds) -> Self {
        let (d, middle) = (eyes.distance(), eyes.middle());
        let reach = (1.6 * d) as usize + 1;
        let mut projection = vec![0_u32; reach];
        let column = |offset: isize| middle.x.round() as isize + offset;
        for (offset, sum) in projection.iter_mut().enumerate() {
            let offset = offset as isize;
            for y in square.y0..square.y1 {
                *sum += u32::from(face.is_set(column(-offset), y as isize));
                *sum += u32::from(face.is_set(column(offset), y as isize));
            }
        }
        let offset = boundary(&projection, d);
        let left = column(-(offset as isize)).clamp(0, face.width() as isize - 1) as usize;
        let right = column(offset as isize).clamp(0, face.width() as isize - 1) as usize;
        let row = |y: f64| (y.max(0.0) as usize).min(face.height() - 1);
        let (y0, y1) = (row(middle.y - EARS.0 * d), row(middle.y + EARS.1 * d) + 1);
        let reach = (EARS.2 * d) as usize;
        let sides = [(left.saturating_sub(reach), left), (right + 1, (right + 1 + reach).min(face.width()))];
        let ears = sides.map(|(x0, x1)| (x0 < x1).then(|| ear(face, Bounds { x0, y0, x1, y1 }, d))?);
        Self { projection, rows: (square.y0, square.y1), left, right, ears }
    }
}

/// The offset of the cheek's boundary; see [`Cheeks::of`].
fn boundary(projection: &[u32], d: f64) -> usize {
    // A twentieth of d smooths what single hairs do.
    let half = (0.025 * d).round() as usize;
    let smooth: Vec<f64> = (0..projection.len())
        .map(|i| {
            let window = &projection[i.saturating_sub(half)..(i + half + 1).min(projection.len())];
            f64::from(window.iter().sum::<u32>()) / window.len() as f64
        })
        .collect();
    let from = ((NEAR.0 * d) as usize).max(1);
    let to = ((NEAR.1 * d) as usize).min(projection.len().saturating_sub(2));
    let places = from..=to.max(from);
    // A minimum counts where the projection rises again by an ear's worth.
    let rises = |i: usize| smooth[i..].iter().take((0.35 * d) as usize + 1).fold(0.0, |m, v| f64::max(m, *v));
    let minimum = places
        .clone()
        .filter(|i| *i + 1 < smooth.len())
        .filter(|i| smooth[*i] <= smooth[*i - 1] && smooth[*i] <= smooth[*i + 1] && rises(*i) > smooth[*i] + 0.05 * d)
        .min_by(|a, b| (*a as f64 - d).abs().total_cmp(&(*b as f64 - d).abs()));
    let fall = |i: usize| {
        let step = half + 1;
        let at = |k: usize| smooth.get(k).copied().unwrap_or(0.0);
        at(i.saturating_sub(step)) - at(i + step)
    };
    minimum.or_else(|| places.max_by(|a, b| fall(*a).total_cmp(&fall(*b)))).unwrap_or(from)
}

/// The largest region of the face within a box, where it is as large as an ear.
fn ear(face: &Mask, within: Bounds, d: f64) -> Option<Ear> {
    let regions = Regions::of(&face.crop(within.x0..within.x1, within.y0..within.y1), Neighbours::Four);
    let region = regions.list.iter().max_by_key(|r| r.area)?;
    let area = region.area as f64;
    if area < LEAST_EAR * d * d || area > FULLEST_EAR * within.area() as f64 {
        return None;
    }
    let pixels = regions.pixels_of(region).map(|(x, y)| (within.x0 + x, within.y0 + y)).collect();
    let b = region.bounds;
    let (x, y) = (within.x0, within.y0);
    Some(Ear { bounds: Bounds { x0: x + b.x0, y0: y + b.y0, x1: x + b.x1, y1: y + b.y1 }, pixels })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    /// A head of half width 95 with ears that hang on by a narrow bridge.
    fn head(ears: bool) -> (Mask, Eyeballs) {
        let mut face = Mask::filled(400, 400, false);
        for y in 0..400_usize {
            for x in 0..400_usize {
                let (dx, dy) = ((x as f64 - 200.0).abs(), y as f64 - 200.0);
                let skull = (dx / 95.0).powi(2) + (dy / 130.0).powi(2) < 1.0;
                let ear = ears && ((dx - 106.0) / 14.0).powi(2) + ((dy - 20.0) / 30.0).powi(2) < 1.0;
                face[(x, y)] = skull || ear;
            }
        }
        (face, Eyeballs::at(Point::new(155.0, 190.0), Point::new(245.0, 190.0)))
    }

    #[test]
    fn the_boundary_is_the_dent_before_the_ear() {
        let (face, eyes) = head(true);
        let cheeks = Cheeks::of(&face, &eyes, &eyes.square(400, 400));
        assert!((103..=112).contains(&cheeks.left) && (288..=297).contains(&cheeks.right), "{cheeks:?}");
        let [Some(left), Some(right)] = &cheeks.ears else { panic!("no ears") };
        assert!(left.bounds.x0.abs_diff(80) <= 1 && right.bounds.x1.abs_diff(321) <= 1);
        assert!(left.bounds.centre().y > 205.0 && left.bounds.centre().y < 235.0);
    }

    #[test]
    fn without_ears_it_is_where_the_face_ends() {
        let (face, eyes) = head(false);
        let cheeks = Cheeks::of(&face, &eyes, &eyes.square(400, 400));
        assert!((100..=112).contains(&cheeks.left), "{}", cheeks.left);
        assert_eq!(cheeks.ears, [None, None]);
    }
}
