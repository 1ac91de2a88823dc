//! From a photo to a face: points found or placed, everything else measured at them, and what may be wrong said in
//! plain words.

use std::fmt;

use super::find::{Anchors, Doubt, Found, Refusal, find, find_from};
use super::lips::parted;
use super::{Face, FeaturePoint, How, Measured, Part, PhotoRecord, Placed, measure};
use crate::disk::{Fault, FileFault, Result};
use crate::geometry::Point;
use crate::photo::Photo;

/// A face and what there is to say of it.
#[derive(Debug, Clone)]
pub struct Created {
    /// The face.
    pub face: Face,
    /// What breaks the method's assumptions (thesis sec. 1.3.2), and what to do.
    pub warnings: Vec<Warning>,
}

/// Something about a photo that makes its face less sure.
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// What is seen.
    pub what: String,
    /// What to do.
    pub help: &'static str,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.what, self.help)
    }
}

/// Makes the face of a photo whose file has the SHA-256 `sha256`. What a hand has set in `kept` stays, its kind of hair
/// too, if the photo has the size it had. Four `anchors` given by hand take the place of looking for a face.
///
/// # Errors
/// When no face can be drawn from it; says why, and what to do.
pub fn create(photo: &Photo, sha256: &str, kept: Option<&Face>, anchors: Option<&Anchors>) -> Result<Created> {
    // On a photo of another size the old places mean nothing.
    let size = [photo.width() as u32, photo.height() as u32];
    let (kept, strange) = match kept {
        Some(kept) if kept.photo.size != size => (None, true),
        kept => (kept, false),
    };
    if let Some(anchors) = anchors {
        check(anchors, photo)?;
    }
    let hands: Vec<_> = kept.map(by_hand).unwrap_or_default();
    let found = match anchors {
        Some(anchors) => with_hands(find_from(photo, anchors), &hands),
        None => find(photo, &hands)?,
    };
    let cut = cut_off(photo, &found.points);
    if anchors.is_none() && cut == Cut::Face {
        return Err(Fault::of(FileFault::CutOff, "the face is cut off at the edge of the photo")
            .help("take a photo with the whole head in it"));
    }
    let points = super::Points(found.points.map(|p| p.at));
    let measured = measure(photo, &points);
    let mut warnings = warnings(&found, &measured);
    // No closed mouth of the 72 neutral people looks so, a quarter of the smiling ones do; the rest are not told.
    let [teeth, dark] = parted(photo, &points, &measured.colours);
    if (teeth > 0.30 || dark > 0.20) && !found.doubts.iter().any(|d| matches!(d, Doubt::MouthOpen(_))) {
        warnings.push(Warning { what: "the mouth seems to be open".into(), help: help(&Doubt::MouthOpen(0.0)) });
    }
    if cut != Cut::None {
        warnings.push(Warning {
            what: "the head is cut off at the edge of the photo".into(),
            help: "take a photo with the whole head in it",
        });
    }
    if strange {
        warnings.push(Warning {
            what: "the photo has another size than the one before, so points set by hand were not kept".into(),
            help: "set them again",
        });
    }
    let mut face = Face {
        points: found.points,
        colours: measured.colours,
        measures: measured.measures,
        hair: measured.hair,
        photo: PhotoRecord { sha256: sha256.to_owned(), size },
    };
    trust_ears_as_far_as_seen(&mut face);
    if let Some(kept) = kept {
        face.hair.kind = kept.hair.kind;
        if let (Some(points), Some(old)) = (&mut face.hair.points, &kept.hair.points) {
            for (point, old) in points.iter_mut().zip(old).filter(|(_, old)| old.how == How::Hand) {
                *point = *old;
            }
        }
    }
    Ok(Created { face, warnings })
}

/// The points that every face has and a hand has set.
fn by_hand(face: &Face) -> Vec<(FeaturePoint, Point)> {
    FeaturePoint::fixed()
        .filter_map(|p| face.placed(p).filter(|placed| placed.how == How::Hand).map(|placed| (p, placed.at)))
        .collect()
}

/// An ear under hair is where ears usually are: placed by rule.
fn trust_ears_as_far_as_seen(face: &mut Face) {
    use FeaturePoint as P;
    for (points, seen) in
        [[P::P10_2, P::P10_4, P::P10_6], [P::P10_1, P::P10_3, P::P10_5]].into_iter().zip(face.measures.ears)
    {
        for point in points {
            let placed = &mut face.points[point.index()];
            if placed.how == How::Found {
                placed.confidence *= seen.clamp(0.0, 1.0);
                if seen < 0.45 {
                    placed.how = How::Rule;
                }
            }
        }
    }
}

/// What of a face lies at the edge of its photo or beyond.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cut {
    /// Nothing.
    None,
    /// Ears, forehead or jaw.
    Head,
    /// Brows, eyes, nose, mouth or chin.
    Face,
}

fn cut_off(photo: &Photo, points: &[Placed; FeaturePoint::FIXED]) -> Cut {
    // A point this near to the edge has too little round it to be found by.
    let edge = 0.012 * photo.width().min(photo.height()) as f64;
    let (width, height) = (photo.width() as f64 - 1.0 - edge, photo.height() as f64 - 1.0 - edge);
    let out = |p: FeaturePoint| {
        let at = points[p.index()].at;
        at.x < edge || at.y < edge || at.x > width || at.y > height
    };
    let is_face = |p: FeaturePoint| p == FeaturePoint::P2_1 || !matches!(p.part(), Part::Face | Part::Ears);
    if FeaturePoint::fixed().any(|p| is_face(p) && out(p)) {
        Cut::Face
    } else if FeaturePoint::fixed().any(out) {
        Cut::Head
    } else {
        Cut::None
    }
}

/// Four places that can be those of a face.
fn check(anchors: &Anchors, photo: &Photo) -> Result<()> {
    let (width, height) = (photo.width() as f64, photo.height() as f64);
    let Anchors { left_eye, right_eye, mouth, chin } = *anchors;
    let inside = |p: Point| (0.0..=width).contains(&p.x) && (0.0..=height).contains(&p.y);
    if ![left_eye, right_eye, mouth, chin].into_iter().all(inside) {
        return Err(Fault::new(format!("a place lies outside the photo, which has {width} × {height} pixels"))
            .help("give pixels of the photo, counted from its upper left corner"));
    }
    let across = right_eye - left_eye;
    let below = |p: Point| across.cross(p - left_eye) / across.hypot().max(1e-9);
    if across.x < 8.0 || across.y.abs() > across.x || below(mouth) < 4.0 || below(chin) <= below(mouth) {
        return Err(Fault::new("the four places do not lie as eyes, mouth and chin do").help(
            "give the eye at the image's left, the one at its right, the mouth below them, the chin below that",
        ));
    }
    Ok(())
}

/// What was found from four places, with what a hand has set before.
fn with_hands(mut found: Found, hands: &[(FeaturePoint, Point)]) -> Found {
    for (point, at) in hands {
        found.points[point.index()] = Placed { at: *at, confidence: 1.0, how: How::Hand };
    }
    found
}

/// What to do about a doubt.
fn help(doubt: &Doubt) -> &'static str {
    match doubt {
        Doubt::Tilted(_) => "hold the head upright",
        Doubt::Turned(_) => "look straight into the camera",
        Doubt::MouthOpen(_) => "close it: the cartoon's mouth opens from a closed one",
        Doubt::Small(_) => "take the photo nearer, or do not scale it down",
        Doubt::Unusual | Doubt::Guessed(_) => "look at the points and correct them",
    }
}

/// The photo check: what breaks the assumptions of the method (thesis sec. 1.3.2).
fn warnings(found: &Found, measured: &Measured) -> Vec<Warning> {
    let mut out = Vec::new();
    let mut warn = |when: bool, what: String, help: &'static str| {
        if when {
            out.push(Warning { what, help });
        }
    };
    let fit = &measured.fitness;
    for doubt in &found.doubts {
        warn(true, doubt.to_string(), help(doubt));
    }
    let side = if fit.side_light > 0.0 { "left" } else { "right" };
    warn(
        fit.side_light.abs() > 0.10,
        format!("the light comes from the side: the {side} half of the face lies in the shade"),
        "stand facing a window",
    );
    warn(
        fit.hair_contrast.is_some_and(|c| c < 0.06),
        "hair and background have nearly one colour".into(),
        "stand before a wall of another colour, or correct the points of the hair",
    );
    warn(
        fit.plain < 0.7,
        "the background is busy".into(),
        "stand before a plain wall, or look at the hair's points with care",
    );
    warn(
        fit.glasses > 0.5,
        "the face seems to wear glasses".into(),
        "take them off for the photo; the style can put them on again",
    );
    warn(fit.highlights < 0.5, "the photo is dark".into(), "take it in better light");
    warn(fit.burnt > 0.03, "the photo is too light: parts of the skin are white".into(), "take it in softer light");
    out
}

impl From<Refusal> for Fault {
    fn from(refusal: Refusal) -> Self {
        Self::of(refusal, refusal.to_string()).help(refusal.help())
    }
}
