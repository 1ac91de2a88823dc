//! The marks of a drawing on a grid of eighths of a pixel: what poses are compared and written by.
//!
//! Strokes are outlines here, groups are taken apart, and every number is whole, so that two poses that look alike are
//! alike, and a path is written with few digits.

use std::hash::{Hash, Hasher};

use crate::drawing::{Anchor, Colour, Item, Raster};
use crate::geometry::{Affine, BezPath, PathEl, Point, outline};

/// Steps of the grid in a pixel.
pub(crate) const STEPS: f64 = 8.0;

/// How far an outline may be from the true one, in units of the figure: as the renderer has it.
const TOLERANCE: f64 = 0.05;

/// A closed outline, or several: absolute places on the grid.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct Path {
    /// `M`, `L`, `Q`, `C` with 1, 1, 2 and 3 points, and `Z` with none.
    pub verbs: Box<[u8]>,
    /// The points of the verbs, in order.
    pub points: Box<[[i32; 2]]>,
}

/// One thing that is drawn, back to front in a list of them.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) enum Mark {
    /// A filled outline, non-zero winding.
    Path {
        /// Its outline.
        path: Path,
        /// Its colour.
        colour: Colour,
    },
    /// An ellipse whose colour fades evenly from its middle to nothing at its rim.
    Glow {
        /// Its middle.
        at: [i32; 2],
        /// To the side and down.
        radii: [i32; 2],
        /// In its middle.
        colour: Colour,
    },
    /// A line of text.
    Text {
        /// Where its baseline starts, is centred, or ends.
        at: [i32; 2],
        /// Height of the em.
        size: i32,
        /// 0 start, 1 middle, 2 end.
        anchor: u8,
        /// Its colour.
        colour: Colour,
        /// What it says.
        text: String,
    },
    /// A picture of pixels.
    Picture {
        /// The pixels.
        pixels: Pixels,
        /// The move from pixels to the grid, in hundred-thousandths.
        place: [i64; 6],
    },
    /// Marks that are seen only inside an outline.
    Clip {
        /// The outline.
        path: Path,
        /// Back to front.
        inside: Vec<Self>,
    },
}

/// Pixels that can be told apart.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pixels(pub Raster);

impl Eq for Pixels {}

impl Hash for Pixels {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.0.picture().width(), self.0.picture().height()).hash(state);
    }
}

impl Mark {
    /// The marks of an item; `place` leads from the item to the grid.
    pub(super) fn of(item: &Item, place: Affine, out: &mut Vec<Self>) {
        match item {
            Item::Area(area) => out.extend(filled(&area.path, area.colour, place)),
            Item::Ink(ink) => out.extend(filled(&outline(&ink.strokes, TOLERANCE), ink.colour, place)),
            Item::Text(text) => out.push(Self::Text {
                at: on_grid(place * text.at),
                size: (text.size * scale_of(place)).round() as i32,
                anchor: match text.anchor {
                    Anchor::Start => 0,
                    Anchor::Middle => 1,
                    Anchor::End => 2,
                },
                colour: text.colour,
                text: text.text.clone(),
            }),
            Item::Glow(glow) => {
                let [a, b, c, d, _, _] = place.as_coeffs();
                let radii = [glow.radii.x * a.hypot(b), glow.radii.y * c.hypot(d)].map(|r| r.round() as i32);
                if radii[0] > 0 && radii[1] > 0 && glow.colour.a > 0 {
                    out.push(Self::Glow { at: on_grid(place * glow.at), radii, colour: glow.colour });
                }
            }
            Item::Shared(shared) => shared.items().iter().for_each(|item| Self::of(item, place, out)),
            Item::Group(group) => {
                let place = place * group.transform;
                let mut inside = Vec::new();
                group.items.iter().for_each(|item| Self::of(item, place, &mut inside));
                match &group.clip {
                    None => out.extend(inside),
                    Some(clip) => {
                        if let Some(path) = Path::of(clip, place).filter(|_| !inside.is_empty()) {
                            out.push(Self::Clip { path, inside });
                        }
                    }
                }
            }
            Item::Picture(raster) => {
                let place = (place * raster.place()).as_coeffs().map(|v| (v * 1e5).round() as i64);
                out.push(Self::Picture { pixels: Pixels(raster.clone()), place });
            }
        }
    }

    /// The points that its outline is made of; of what is clipped the clip's.
    pub(super) fn outer_points(&self) -> &[[i32; 2]] {
        match self {
            Self::Path { path, .. } | Self::Clip { path, .. } => &path.points,
            _ => &[],
        }
    }

    /// What it is made of, and the numbers that say where: marks whose kinds differ are never near each other.
    pub(super) fn taken_apart(&self, kind: &mut Vec<u8>, places: &mut Vec<i32>) {
        let mut path_of = |path: &Path, kind: &mut Vec<u8>| {
            kind.extend_from_slice(&path.verbs);
            places.extend(path.points.iter().flatten());
        };
        match self {
            Self::Path { path, .. } => {
                kind.push(b'0');
                path_of(path, kind);
            }
            Self::Glow { at, radii, .. } => {
                kind.push(b'1');
                places.extend([at[0], at[1], radii[0], radii[1]]);
            }
            Self::Text { .. } => kind.push(b'2'),
            Self::Picture { .. } => kind.push(b'3'),
            Self::Clip { path, inside } => {
                kind.push(b'4');
                path_of(path, kind);
                inside.iter().for_each(|mark| mark.taken_apart(kind, places));
                kind.push(b'5');
            }
        }
    }

    /// Whether it looks like another to the eye: made alike, no point further than `steps` of the grid from the other's,
    /// no colour more than a hundredth off.
    pub(super) fn is_near(&self, other: &Self, steps: i32) -> bool {
        match (self, other) {
            (Self::Path { path: a, colour: c }, Self::Path { path: b, colour: d }) => {
                near_colours(*c, *d) && a.is_near(b, steps)
            }
            (Self::Glow { at: a, radii: r, colour: c }, Self::Glow { at: b, radii: s, colour: d }) => {
                near_colours(*c, *d) && near_points(&[*a, *r], &[*b, *s], steps)
            }
            (Self::Clip { path: a, inside: i }, Self::Clip { path: b, inside: j }) => {
                a.is_near(b, steps) && are_near(i, j, steps)
            }
            _ => self == other,
        }
    }

    /// About how many bytes it takes to write it: what parts are weighed by.
    pub(super) fn weight(&self) -> u64 {
        match self {
            Self::Path { path, .. } => 28 + path.weight(),
            Self::Glow { .. } => 70,
            Self::Text { text, .. } => 90 + text.len() as u64,
            Self::Picture { pixels, .. } => 120 + 2 * pixels.0.picture().pixels().len() as u64,
            Self::Clip { path, inside } => 70 + path.weight() + inside.iter().map(Self::weight).sum::<u64>(),
        }
    }
}

impl Path {
    /// A path on the grid; nothing where it is empty.
    pub(crate) fn of(path: &BezPath, place: Affine) -> Option<Self> {
        let mut verbs = Vec::with_capacity(path.elements().len());
        let mut points: Vec<[i32; 2]> = Vec::with_capacity(3 * path.elements().len());
        for element in path.elements() {
            match *element {
                PathEl::MoveTo(p) => {
                    verbs.push(b'M');
                    points.push(on_grid(place * p));
                }
                PathEl::LineTo(p) => {
                    let to = on_grid(place * p);
                    // A line to where it is already draws nothing.
                    if points.last() != Some(&to) {
                        verbs.push(b'L');
                        points.push(to);
                    }
                }
                PathEl::QuadTo(a, p) => {
                    verbs.push(b'Q');
                    points.extend([a, p].map(|p| on_grid(place * p)));
                }
                PathEl::CurveTo(a, b, p) => {
                    let three = [a, b, p].map(|p| on_grid(place * p));
                    if three.iter().any(|p| points.last() != Some(p)) {
                        verbs.push(b'C');
                        points.extend(three);
                    }
                }
                PathEl::ClosePath => verbs.push(b'Z'),
            }
        }
        (verbs.len() > 1).then(|| Self { verbs: verbs.into(), points: points.into() })
    }

    fn is_near(&self, other: &Self, steps: i32) -> bool {
        self.verbs == other.verbs && near_points(&self.points, &other.points, steps)
    }

    fn weight(&self) -> u64 {
        (self.verbs.len() + 5 * self.points.len()) as u64
    }

    /// The path as curves of the grid.
    pub(crate) fn to_bez(&self) -> BezPath {
        let p = |p: &[i32; 2]| Point::new(f64::from(p[0]), f64::from(p[1]));
        let piece = |(verb, points): (u8, &[[i32; 2]])| match (verb, points) {
            (b'M', [a]) => PathEl::MoveTo(p(a)),
            (b'L', [a]) => PathEl::LineTo(p(a)),
            (b'Q', [a, b]) => PathEl::QuadTo(p(a), p(b)),
            (b'C', [a, b, c]) => PathEl::CurveTo(p(a), p(b), p(c)),
            _ => PathEl::ClosePath,
        };
        self.pieces().map(piece).collect()
    }

    /// The verbs with their points.
    pub(crate) fn pieces(&self) -> impl Iterator<Item = (u8, &[[i32; 2]])> {
        let mut rest: &[[i32; 2]] = &self.points;
        self.verbs.iter().map(move |verb| {
            let count = match verb {
                b'C' => 3,
                b'Q' => 2,
                b'Z' => 0,
                _ => 1,
            };
            let (here, after) = rest.split_at(count.min(rest.len()));
            rest = after;
            (*verb, here)
        })
    }
}

/// Whether two lists of marks look alike.
pub(super) fn are_near(a: &[Mark], b: &[Mark], steps: i32) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.is_near(b, steps))
}

fn near_points(a: &[[i32; 2]], b: &[[i32; 2]], steps: i32) -> bool {
    a.len() == b.len()
        && a.iter().zip(b).all(|(p, q)| p[0].abs_diff(q[0]).max(p[1].abs_diff(q[1])) <= steps.unsigned_abs())
}

fn near_colours(a: Colour, b: Colour) -> bool {
    let parts = |c: Colour| [c.r, c.g, c.b, c.a];
    parts(a).iter().zip(parts(b)).all(|(a, b)| a.abs_diff(b) <= 2)
}

fn filled(path: &BezPath, colour: Colour, place: Affine) -> Option<Mark> {
    (colour.a > 0).then(|| Path::of(path, place)).flatten().map(|path| Mark::Path { path, colour })
}

fn on_grid(p: Point) -> [i32; 2] {
    [p.x, p.y].map(|v| v.round().clamp(-1e8, 1e8) as i32)
}

fn scale_of(place: Affine) -> f64 {
    place.determinant().abs().sqrt()
}
