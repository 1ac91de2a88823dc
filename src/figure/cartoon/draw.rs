//! A pose becomes the drawing of a cartoon: sheets back to front, still ones first (thesis 7.3.1, 7.3.2).

use super::head::Outline;
use super::{BrowStyle, Cartoon, Sheet, brow, eye, mouth, skin, wrinkles};
use crate::drawing::{Drawing, Item, Layer};
use crate::face::FeaturePoint as P;
use crate::face::rig::Deformed;
use crate::figure::describe;
use crate::geometry::{Affine, BezPath, PathEl, Point, Vec2, brush, flattened};
use crate::pose::Pose;

/// A chin that has come down by less than this, in face units, rests.
const RESTS: f64 = 0.05;
/// Chin and jaw come down in steps of so many face units, a sixth of a pixel in a picture 720 high: nobody sees them,
/// and frames whose mouths differ have the outline below in common.
const STEP: f64 = 0.125;

/// The nearest move in whole steps.
fn stepped(by: Vec2) -> Vec2 {
    let whole = |v: f64| (v / STEP).round() * STEP;
    Vec2::new(whole(by.x), whole(by.y))
}

impl Cartoon {
    /// The drawing of a pose: what stays the same on the layer `static`, what moves on `dynamic`. While the head rests,
    /// all but mouth, jaw, eyes and brows is still; when it moves, the body stays and the neck follows at its upper
    /// end.
    #[must_use]
    pub fn draw(&self, pose: &Pose) -> Drawing {
        let mut face = self.neutral.pose(pose);
        // The chin comes down from where it rests and never rises above it: under it is the still face's.
        let (chin, rest) = (P::P2_1, self.neutral.points()[P::P2_1]);
        face.points[chin].y = face.points[chin].y.max(rest.y);
        for moved in [chin, P::P2_14, P::P2_13] {
            let rest = self.neutral.points()[moved];
            face.points[moved] = rest + stepped(face.points[moved] - rest);
        }
        let dropped = face.points[chin].y > rest.y + RESTS;
        let turned = face.head != Affine::IDENTITY;
        let outline = self.head.outline(&face.points);
        let shadow = || self.body.shadow(&self.pen, &outline.lower(), face.head);

        let mut ground = self.sheet(Sheet::Ground, vec![self.still.ground.clone()]);
        let behind = self.sheet(Sheet::HairBehind, vec![self.still.behind.clone()]);
        let shirt = self.sheet(Sheet::Shirt, vec![self.still.shirt.clone()]);
        let neck = if turned {
            let mut neck = self.body.neck(&self.pen, face.head);
            neck.extend(shadow());
            neck
        } else {
            vec![self.still.neck.clone()]
        };
        let neck = self.sheet(Sheet::Neck, neck);

        // What of the head is still while it rests.
        let mut head = vec![self.still.ears.clone()];
        head.extend(self.own(Sheet::Face, false));
        head.push(self.still.face.clone());
        if self.still.hair_is_clear {
            head.extend(self.own(Sheet::Hair, false));
            head.push(self.still.hair.clone());
        }
        let mut moving = self.moving_face(&face, &outline, dropped);
        let (still, moving) = if turned {
            let mut items = vec![Item::moved("hair-behind", face.head, behind)];
            items.extend(neck.into_iter().chain(shirt));
            head.append(&mut moving);
            items.push(Item::moved("head", face.head, head));
            (ground, items)
        } else {
            ground.extend(behind.into_iter().chain(neck).chain(shirt).chain(head));
            if dropped {
                moving.splice(0..0, shadow());
            }
            (ground, moving)
        };
        Drawing {
            view: self.view,
            title: self.title.clone(),
            description: describe(pose),
            background: self.style.ground.then_some(self.pen.palette.ground),
            layers: vec![
                Layer { name: "static".into(), items: still },
                Layer { name: "dynamic".into(), items: moving },
            ],
        }
    }

    /// Jaw, beard, mouth, eyes and brows, and the hair where it lies over one of them.
    fn moving_face(&self, face: &Deformed, outline: &Outline, dropped: bool) -> Vec<Item> {
        let (pen, points) = (&self.pen, &face.points);
        let mut items = Vec::with_capacity(56);
        if dropped {
            let nose = points[P::P9_15].y;
            items.extend(skin::lower(pen, outline, nose + 0.35 * self.neutral.units().mouth_nose));
        }
        items.extend(skin::raised_cheeks(pen, points, outline, face.expression.cheek.clamp(0.0, 1.0)));
        if let Some(beard) = &self.beard {
            items.extend(beard.draw(pen, points, self.neutral.units(), outline));
        }
        items.extend(skin::contour(pen, outline, points));
        items.extend(skin::folds(pen, points, self.neutral.units(), self.style.folds));
        items.extend(wrinkles::wrinkles(face, &pen.palette, pen.ink));
        items.extend(mouth::mouth(&face.mouth, &pen.palette, pen.ink, pen.ink_only));
        for one in &face.eyes {
            items.extend(eye::eye(one, &pen.palette, pen.ink, pen.ink_only));
        }
        items.extend(self.own(Sheet::Face, true));
        if !self.still.hair_is_clear {
            items.extend(self.own(Sheet::Hair, false));
            items.push(self.still.hair.clone());
        }
        items.extend(self.brows(face));
        items.extend(self.still.glasses.clone());
        items.extend(self.own(Sheet::Hair, true));
        items
    }

    /// A sheet with what an author has put under and over it.
    fn sheet(&self, sheet: Sheet, items: Vec<Item>) -> Vec<Item> {
        if self.extras.is_empty() {
            return items;
        }
        self.own(sheet, false).chain(items).chain(self.own(sheet, true)).collect()
    }

    /// What an author has put under or over a sheet.
    fn own(&self, sheet: Sheet, over: bool) -> impl Iterator<Item = Item> {
        self.extras.iter().filter(move |e| e.sheet == sheet && e.over == over).flat_map(|e| e.items.iter().cloned())
    }

    fn brows(&self, face: &Deformed) -> Vec<Item> {
        let pen = &self.pen;
        let mut items = brow::brows(face, self.brow_height, &pen.palette, pen.ink, pen.ink_only);
        if self.style.brows == BrowStyle::Bezier {
            // The four points of a brow are the four of a cubic (thesis sec. 4.2.3); what is left is the frown.
            let frown = items.split_off(2);
            items = Vec::with_capacity(4);
            for (line, name) in face.brows.iter().zip(["left-brow", "right-brow"]) {
                let [a, b, c, d] = *line;
                // A cubic hangs below its inner control points: raised by a third it meets them.
                let lift = |p: Point, chord: f64| p + Vec2::new(0.0, (p.y - chord) / 3.0);
                let (b, c) = (lift(b, a.y + (d.y - a.y) / 3.0), lift(c, a.y + (d.y - a.y) * 2.0 / 3.0));
                let cubic = BezPath::from_vec(vec![PathEl::MoveTo(a), PathEl::CurveTo(b, c, d)]);
                let width = (0.42 * self.brow_height).clamp(3.4, 7.0);
                let ink = brush(&flattened(&cubic), width, &[0.75, 1.0, 0.95, 0.5]);
                items.push(Item::area(name, ink, pen.palette.brow));
            }
            items.extend(frown);
        }
        items
    }
}
