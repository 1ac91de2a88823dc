//! All stages of the thesis's chapter 3, one after the other.

use super::{
    Bounds, Cheeks, Cut, Edges, EyePairs, Eyeballs, FaceGround, Features, Hsi, LightDark, Photo, Plane, Refined,
};
use crate::geometry::Point;

/// The longest side that is worked on. Faces of passport photos are some 200 pixels wide in it, as the thesis's were.
pub(crate) const STAGES_SIDE: usize = 600;

/// Eyes nearer to each other, in pixels of the stages, leave no square to look in.
const LEAST_DISTANCE: f64 = 4.0;

/// What the thesis's pipeline makes of a photo, stage by stage. Coordinates are pixels of [`Stages::photo`], whose
/// pixel centres are whole numbers; [`Stages::to_photo`] brings them back.
#[derive(Debug, Clone, PartialEq)]
pub struct Stages {
    /// The photo as it was worked on, at most `STAGES_SIDE` wide and high.
    pub photo: Photo,
    /// How many pixels of the given photo make one of that.
    pub factor: f64,
    /// Rect: the central rectangle whose colours are taken for the face's.
    pub central: Bounds,
    /// Its colours as hue, saturation and intensity (sec. 3.3).
    pub hsi: Hsi,
    /// Light and dark (sec. 3.3.2).
    pub first: LightDark,
    /// Pairs of dark regions (sec. 3.3.3).
    pub pairs: EyePairs,
    /// Face and background (sec. 3.3.4).
    pub second: FaceGround,
    /// The face's region and the hair's (sec. 3.3.5).
    pub refined: Refined,
    /// What follows from the eyes; none where none were found.
    pub located: Option<Located>,
}

/// The stages that need the eyes.
#[derive(Debug, Clone, PartialEq)]
pub struct Located {
    /// The eyeballs (sec. 3.4.1).
    pub eyes: Eyeballs,
    /// Edges by local thresholds (sec. 3.4.2).
    pub edges: Edges,
    /// Brow, eye, nose and mouth (sec. 3.4.3).
    pub features: Features,
    /// L_Nose, in the middle of the nose.
    pub nose_cut: Cut,
    /// L_Mouth, in the middle of the mouth.
    pub mouth_cut: Cut,
    /// Cheeks and ears (sec. 3.5).
    pub cheeks: Cheeks,
}

impl Stages {
    /// All stages as the thesis has them.
    #[must_use]
    pub fn of(photo: &Photo) -> Self {
        let stages = Self::without_eyes(photo);
        let eyes = stages.pairs.best().map(|pair| Eyeballs::of(&stages.pairs.dark, pair));
        stages.located_at(eyes)
    }

    /// All stages, with the middles of the eyeballs known otherwise, in pixels of the photo, the image's left one first.
    /// Nothing follows from eyes that are one place, or farther apart than the photo is long.
    #[must_use]
    pub fn with_eyes(photo: &Photo, left: Point, right: Point) -> Self {
        Self::without_eyes(photo).seen_from(left, right)
    }

    /// The same stages with other eyes; see [`Stages::with_eyes`].
    #[must_use]
    pub fn seen_from(self, left: Point, right: Point) -> Self {
        let eyes = Eyeballs::at(self.to_working(left), self.to_working(right));
        self.located_at(Some(eyes))
    }

    fn located_at(mut self, eyes: Option<Eyeballs>) -> Self {
        let most = (self.photo.width() + self.photo.height()) as f64;
        self.located = eyes
            .filter(|eyes| (LEAST_DISTANCE..=most).contains(&eyes.distance()))
            .map(|eyes| Located::of(&self.hsi.intensity, &self.refined, eyes));
        self
    }

    fn without_eyes(photo: &Photo) -> Self {
        let (small, factor) = photo.at_most(STAGES_SIDE);
        let photo = small.into_owned();
        let central = central(photo.width(), photo.height());
        let hsi = Hsi::of(&photo);
        let first = LightDark::of(&hsi.intensity, &central);
        let pairs = EyePairs::of(&first.light);
        let second = FaceGround::of(&hsi.hue, &first.light, &central);
        let refined = Refined::of(&first.light, &second.ground);
        Self { photo, factor, central, hsi, first, pairs, second, refined, located: None }
    }

    /// A place of the stages in pixels of the photo that was given.
    #[must_use]
    pub fn to_photo(&self, p: Point) -> Point {
        Point::new((p.x + 0.5) * self.factor - 0.5, (p.y + 0.5) * self.factor - 0.5)
    }

    /// A place of the photo that was given in pixels of the stages.
    #[must_use]
    pub(crate) fn to_working(&self, p: Point) -> Point {
        Point::new((p.x + 0.5) / self.factor - 0.5, (p.y + 0.5) / self.factor - 0.5)
    }
}

impl Located {
    fn of(intensity: &Plane, refined: &Refined, eyes: Eyeballs) -> Self {
        let edges = Edges::of(intensity, &eyes);
        let features = Features::of(&edges, &eyes);
        let nose_cut = Cut::of(intensity, &features.nose.bounds);
        let mouth_cut = Cut::of(intensity, &features.mouth.bounds);
        let cheeks = Cheeks::of(&refined.face, &eyes, &edges.square);
        Self { eyes, edges, features, nose_cut, mouth_cut, cheeks }
    }
}

/// The central rectangle, half of the image's width and height. The thesis gives no size: smaller ones hold too little
/// hair, so that t1 lies low and eyes fall apart; larger ones take in the wall.
fn central(width: usize, height: usize) -> Bounds {
    let span = |side: usize| (side / 4, (3 * side).div_ceil(4).clamp(side / 4 + 1, side));
    let ((x0, x1), (y0, y1)) = (span(width), span(height));
    Bounds { x0, y0, x1, y1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A photo of random blocks, of a generator of ours.
    fn random(width: usize, height: usize, seed: u64) -> Photo {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        let blocks: Vec<[u8; 3]> = (0..1024)
            .map(|_| {
                state ^= state << 13;
                state ^= state >> 7;
                state ^= state << 17;
                [state as u8, (state >> 8) as u8, (state >> 16) as u8]
            })
            .collect();
        Photo::new(
            width,
            height,
            (0..width * height).map(|i| blocks[(i % width / 5 + i / width / 3 * 31) % 1024]).collect(),
        )
    }

    #[test]
    fn no_photo_and_no_eyes_break_it() {
        let sizes = [(1, 1), (2, 1), (1, 2), (3, 3), (5, 90), (90, 5), (64, 64), (160, 120)];
        let far = [-1e9, -50.0, 0.0, 20.0, 47.5, 200.0, 1e9, f64::NAN, f64::INFINITY];
        for (n, (width, height)) in sizes.into_iter().enumerate() {
            for photo in [random(width, height, n as u64 + 1), Photo::new(width, height, vec![[90; 3]; width * height])]
            {
                let stages = Stages::of(&photo);
                for a in far {
                    for b in far {
                        let seen = stages.clone().seen_from(Point::new(a, b), Point::new(b + 13.0, a));
                        let distance = (b + 13.0 - a).hypot(a - b);
                        assert!(seen.located.is_none() || distance >= 4.0);
                    }
                }
            }
        }
    }

    #[test]
    fn places_come_back_from_the_size_that_is_worked_on() {
        let stages = Stages::of(&random(1500, 1200, 3));
        assert_eq!((stages.photo.width(), stages.photo.height(), stages.factor), (600, 480, 2.5));
        // The photo's corner is the corner of both: half a pixel off the middle of the first.
        let corner = stages.to_photo(Point::new(-0.5, -0.5));
        assert!(corner.distance(Point::new(-0.5, -0.5)) < 1e-12);
        let p = Point::new(700.25, 31.5);
        assert!(stages.to_photo(stages.to_working(p)).distance(p) < 1e-9);
    }
}
