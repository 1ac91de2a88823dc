//! The cartoon: a personal face drawn from its 72 points, measured colours and hair (thesis ch. 4), in a style.
//!
//! What is drawn is decided once, when a [`Cartoon`] is made; a pose then moves only what moves. How a face deforms is
//! `face::rig`'s business, not this room's.

mod beard;
mod body;
mod brow;
mod dice;
mod draw;
mod ear;
mod eye;
mod glasses;
mod hair;
mod head;
mod mouth;
mod nose;
mod palette;
mod skin;
mod style;
mod wrinkles;

use std::sync::Arc;

pub(crate) use palette::{Chosen, Palette};
pub use style::Style;
pub(crate) use style::{BrowStyle, NoseStyle};

use crate::drawing::{Item, Oklch};
use crate::face::rig::{Expressions, Neutral};
use crate::face::{Face, FeaturePoint as P, HairKind, Points, to_face_frame};
use crate::geometry::{Affine, Point, Rect, brush};

/// Ink is so wide, in half widths of the jaw.
const INK: f64 = 0.025;
/// What is shown of the face frame, unless the hair needs more: a head with room round it, down to the chest.
const VIEW: Rect = Rect::new(-205.0, -240.0, 205.0, 310.0);
/// Room between the hair and the edge of the view.
const ROOM: f64 = 14.0;
/// Hues of shirts, of which the photo's sum draws one: none of them a skin's.
const SHIRTS: [f64; 8] = [200.0, 150.0, 255.0, 25.0, 85.0, 300.0, 225.0, 175.0];

/// A person's cartoon face, ready to be drawn in any pose.
///
/// ```no_run
/// use lianpu::face::Face;
/// use lianpu::figure::cartoon::{Cartoon, Style};
/// use lianpu::pose::Pose;
///
/// let face = Face::parse(&std::fs::read_to_string("faces/wang/face.toml")?)?;
/// let cartoon = Cartoon::new(&face, &Style::built_in("normal")?);
/// let drawing = cartoon.draw(&Pose::default());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Cartoon {
    face: Arc<Face>,
    style: Arc<Style>,
    title: String,
    view: Rect,
    face_view: Rect,
    /// How much wider than usual the ink is.
    bolder: f64,
    neutral: Neutral,
    pen: Pen,
    head: head::HeadShape,
    body: body::Body,
    /// Height of the brows in the face frame.
    brow_height: f64,
    beard: Option<beard::Growth>,
    still: Still,
    extras: Vec<Extra>,
    fingerprint: u64,
}

/// What no pose changes, but for the move of the whole head.
#[derive(Debug, Clone)]
struct Still {
    ground: Item,
    behind: Item,
    neck: Item,
    shirt: Item,
    ears: Item,
    /// The face at rest without what moves on it.
    face: Item,
    hair: Item,
    /// Whether the hair stays clear of what moves, and so can lie under it.
    hair_is_clear: bool,
    glasses: Option<Item>,
}

/// What everything is drawn with.
#[derive(Debug, Clone)]
struct Pen {
    palette: Palette,
    /// Width of ink in the face frame.
    ink: f64,
    ink_only: bool,
}

/// A sheet of the cartoon that an author's own things can lie over or under.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sheet {
    /// Ground and disc. Stays when the head moves.
    Ground,
    /// The hair behind the head.
    HairBehind,
    /// Neck and shoulders. Stays when the head moves.
    Neck,
    /// The shirt. Stays when the head moves.
    Shirt,
    /// The face with ears, nose, mouth and eyes.
    Face,
    /// The hair over the face, and the brows.
    Hair,
}

/// Things of an author's own, on a layer over or under a sheet (thesis 7.3.1: one or more layers to draw something
/// else). They move with the head if the sheet does.
#[derive(Debug, Clone, PartialEq)]
pub struct Extra {
    /// Where.
    pub sheet: Sheet,
    /// Over it, else under it.
    pub over: bool,
    /// In the face frame: pupil distance 100, origin midway between the pupils, y down. Back to front.
    pub items: Vec<Item>,
}

impl std::fmt::Debug for Cartoon {
    /// Its title and key: the parts fill pages.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Cartoon").field("title", &self.title).field("fingerprint", &self.fingerprint).finish()
    }
}

impl Cartoon {
    /// Makes a cartoon of a face. Everything that no pose changes is made here.
    #[must_use]
    pub fn new(face: &Face, style: &Style) -> Self {
        Self::with_ink(Arc::new(face.clone()), Arc::new(style.clone()), Expressions::general().clone(), 1.0)
    }

    /// The same, showing the emotions as a person of these expressions does.
    #[must_use]
    pub(crate) fn with_expressions(self, expressions: Expressions) -> Self {
        let mut own = Self::with_ink(self.face, self.style, expressions, self.bolder);
        own.extras = self.extras;
        own.fingerprint = own.draw(&crate::pose::Pose::default()).fingerprint();
        own
    }

    /// The same with things of an author's own on it.
    #[must_use]
    pub fn with(mut self, extras: Vec<Extra>) -> Self {
        self.extras.extend(extras.into_iter().map(|e| Extra { items: vec![Item::shared(e.items)], ..e }));
        self.fingerprint = self.draw(&crate::pose::Pose::default()).fingerprint();
        self
    }

    /// What the figure is called.
    #[must_use]
    pub(crate) fn title(&self) -> &str {
        &self.title
    }

    /// 64 bits of how it looks at rest: two that differ are two figures.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// The part of its plane that it fills: more than usual where the hair needs it.
    #[must_use]
    pub fn view(&self) -> Rect {
        self.view
    }

    /// The part of its plane with the face.
    #[must_use]
    pub fn face_view(&self) -> Rect {
        self.face_view
    }

    /// The figure as small pictures need it: the face without what is round it, its lines `bolder` times as wide.
    #[must_use]
    pub fn close_up(&self, bolder: f64) -> Self {
        let mut close = Self::with_ink(
            Arc::clone(&self.face),
            Arc::clone(&self.style),
            self.neutral.expressions().clone(),
            self.bolder * bolder,
        );
        close.extras.clone_from(&self.extras);
        close.view = self.face_view;
        close
    }

    fn with_ink(face: Arc<Face>, style: Arc<Style>, expressions: Expressions, bolder: f64) -> Self {
        let places = face.places();
        let place = to_face_frame(places[P::P3_6], places[P::P3_5]);
        let measured = Points(places.0.map(|p| place * p));
        let neutral = Neutral::of(&measured, &style.proportions).with_expressions(expressions);
        let points = neutral.points();
        let kind = hair_kind(&face, &style);

        let jaw = ((points[P::P2_14].x.abs() + points[P::P2_13].x.abs()) / 2.0).max(20.0);
        let palette = if style.ink_only {
            Palette::of_ink(&style.colours)
        } else {
            Palette::of(&face.colours, shirt_hue(&face.photo.sha256), &style.colours)
        };
        let pen = Pen { palette, ink: INK * jaw * style.ink * bolder, ink_only: style.ink_only };

        let hair = hair::Hair::new(&face, kind, style.hair_curve, place, points);
        let head_top = (place * Point::new(places[P::P3_6].midpoint(places[P::P3_5]).x, face.measures.head_top)).y;
        let top = skull_top(head_top, points, hair.is_some());
        let head = head::HeadShape::new(points, face.measures.jaw, style.jaw_round, top);
        let (view, face_view) = views(points, jaw, top, hair.bounds());
        let body = body::Body::new(points, face.measures.neck, jaw, view);

        let growth = beard::Growth::of(
            &face.measures.beard,
            Oklch::from(pen.palette.skin).l > 0.6,
            style.beard == style::Choice::Yes,
        );
        let beard = growth.filter(|_| style.beard != style::Choice::No);
        let outline = head.outline(points);
        let glasses = style.glasses.or(face.measures.glasses > 0.5);
        let mut skin = skin::skin(&pen, &outline);
        skin.extend(skin::blush(&pen, points, &outline));
        skin.extend(skin::lights(&pen, points, points[P::P11_1].y.max(top)));
        skin.extend(skin::sockets(&pen, points));
        if !hair.is_some() {
            skin.extend(hair::scalp(&pen, points, &head, &outline, kind != HairKind::Bald));
        }
        skin.extend(skin::cheek_lines(&pen, &outline));
        skin.extend(nose::nose(&pen, points, neutral.units(), style.nose));
        if glasses {
            skin.extend(glasses::arms(&pen, &neutral, &head));
        }
        let mut neck = body.neck(&pen, Affine::IDENTITY);
        neck.extend(body.shadow(&pen, &outline.lower(), Affine::IDENTITY));
        let still = Still {
            ground: Item::shared(if style.disc { vec![body::Body::disc(&pen)] } else { Vec::new() }),
            behind: Item::shared(hair.behind(&pen)),
            neck: Item::shared(neck),
            shirt: Item::shared(body.shirt(&pen)),
            ears: Item::shared(ear::ears(&pen, points, &head)),
            face: Item::shared(skin),
            hair_is_clear: hair.clear_of(points),
            hair: Item::shared(hair.before(&pen, points, style.strands)),
            glasses: glasses.then(|| Item::shared(glasses::glasses(&pen, &neutral))),
        };
        let mut cartoon = Self {
            title: format!("cartoon, {}", style.title),
            view,
            face_view,
            bolder,
            neutral,
            pen,
            head,
            body,
            brow_height: 100.0 * face.measures.brow_height,
            beard,
            still,
            extras: Vec::new(),
            fingerprint: 0,
            face,
            style,
        };
        cartoon.fingerprint = cartoon.draw(&crate::pose::Pose::default()).fingerprint();
        cartoon
    }
}

/// What the drawing shows, and what a close-up of the face shows: around the jaw, the ears and the hair.
fn views(points: &Points, jaw: f64, top: f64, hair: Option<Rect>) -> (Rect, Rect) {
    let mut view = VIEW;
    let mut around = Rect::new(-jaw * 1.35, top, jaw * 1.35, points[P::P2_1].y);
    for ear in [P::P10_4, P::P10_3] {
        around = around.union_pt(points[ear]);
    }
    if let Some(hair) = hair {
        view = view.union(hair.inflate(ROOM, ROOM)).intersect(Rect::new(-400.0, -500.0, 400.0, 310.0));
        around = around.union(hair);
    }
    view.y1 = view.y1.max(points[P::P2_1].y + 130.0);
    around = around.intersect(view);
    (view, Rect::new(around.x0 - 6.0, around.y0 - 6.0, around.x1 + 6.0, points[P::P2_1].y + 45.0))
}

impl Pen {
    /// Thin ink along a line, `width` times as wide as usual.
    fn line(&self, name: &str, line: &[Point], width: f64, profile: &[f64]) -> Item {
        Item::area(name, brush(line, width * self.ink, profile), self.palette.line)
    }
}

/// A point.
const fn at(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

/// How the hair falls: as the author says, else as it was found. A face that has no outline of hair has none to draw.
fn hair_kind(face: &Face, style: &Style) -> HairKind {
    let kind = style.hair.unwrap_or(face.hair.kind);
    let none = face.hair.front.iter().all(|o| o.len() < 3);
    if none && !matches!(kind, HairKind::Bald | HairKind::Shaved) { HairKind::Bald } else { kind }
}

/// The skull under the hair, or the top of a head without any. Never lower than a forehead's end.
fn skull_top(head_top: f64, points: &Points, hair: bool) -> f64 {
    let hairline = points[P::P11_1].y;
    let brows = points[P::P4_4].y.min(points[P::P4_3].y);
    let top = if hair { head_top + 0.45 * (hairline - head_top) } else { head_top + 3.0 };
    top.clamp(-260.0, brows - 40.0)
}

/// A hue for the shirt, the same for the same photo.
fn shirt_hue(sha256: &str) -> f64 {
    let digit = sha256.chars().last().and_then(|c| c.to_digit(16)).unwrap_or(0);
    SHIRTS[digit as usize % SHIRTS.len()]
}
