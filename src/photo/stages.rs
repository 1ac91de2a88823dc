//! All stages of the thesis's chapter 3, one after the other.

use super::{
    Bounds, Cheeks, Cut, Edges, EyePairs, Eyeballs, FaceGround, Features, Hsi, LightDark, Photo, Plane, Refined,
};
use crate::geometry::Point;

/// The longest side that is worked on. Faces of passport photos are some 200 pixels wide in it, as the thesis's were.
pub const STAGES_SIDE: usize = 600;

/// What the thesis's pipeline makes of a photo, stage by stage. Coordinates are pixels of [`Stages::photo`], whose
/// pixel centres are whole numbers; [`Stages::to_photo`] brings them back.
#[derive(Debug, Clone, PartialEq)]
pub struct Stages {
    /// The photo as it was worked on, at most [`STAGES_SIDE`] wide and high.
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
        let mut stages = Self::without_eyes(photo);
        stages.located = stages
            .pairs
            .best()
            .map(|pair| Eyeballs::of(&stages.pairs.dark, pair))
            // Two circles in one place would leave no square to look in.
            .filter(|eyes| eyes.distance() >= 4.0)
            .map(|eyes| Located::of(&stages.hsi.intensity, &stages.refined, eyes));
        stages
    }

    /// All stages, with the middles of the eyeballs known otherwise, in pixels of the photo. Without a distance
    /// between them nothing follows from them.
    #[must_use]
    pub fn with_eyes(photo: &Photo, left: Point, right: Point) -> Self {
        let mut stages = Self::without_eyes(photo);
        let eyes = Eyeballs::at(stages.from_photo(left), stages.from_photo(right));
        if eyes.distance() >= 4.0 {
            stages.located = Some(Located::of(&stages.hsi.intensity, &stages.refined, eyes));
        }
        stages
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
    pub fn from_photo(&self, p: Point) -> Point {
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
