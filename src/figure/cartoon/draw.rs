//! A pose becomes the drawing of a cartoon: sheets back to front, still ones first (thesis 7.3.1, 7.3.2).

use super::{BrowStyle, Cartoon, Sheet, brow, eye, mouth, skin, wrinkles};
use crate::drawing::{Drawing, Item, Layer};
use crate::face::rig::{Deformed, Proportions};
use crate::figure::describe;
use crate::geometry::{Affine, BezPath, PathEl, Point, Vec2, brush, flattened};
use crate::pose::Pose;

impl Cartoon {
    /// The drawing of a pose: what stays the same on the layer `static`, what moves on `dynamic`. While the head rests,
    /// hair behind it, neck, shirt and ears are still; when it moves, the body stays and the neck follows at its upper
    /// end.
    #[must_use]
    pub fn draw(&self, pose: &Pose) -> Drawing {
        let face = self.neutral.pose(pose);
        let turned = face.head != Affine::IDENTITY;
        let outline = self.head.outline(&face.points);
        let (mut still, mut moving) = (Vec::new(), Vec::new());
        let on_head = |items: Vec<Item>| {
            if turned { vec![Item::moved("head", face.head, items)] } else { items }
        };
        still.extend(self.sheet(Sheet::Ground, vec![self.still.ground.clone()]));

        let body = if turned { &mut moving } else { &mut still };
        body.extend(on_head(self.sheet(Sheet::HairBehind, vec![self.still.behind.clone()])));
        let neck = if turned { Item::shared(self.body.neck(&self.pen, face.head)) } else { self.still.neck.clone() };
        body.extend(self.sheet(Sheet::Neck, vec![neck]));
        // The shirt starts below the chin's shadow, which moves and lies over it nowhere.
        body.extend(self.sheet(Sheet::Shirt, vec![self.still.shirt.clone()]));
        if !turned {
            body.push(self.still.ears.clone());
        }

        moving.extend(self.body.shadow(&self.pen, &outline.lower(), face.head));
        let mut head = Vec::with_capacity(64);
        if turned {
            head.push(self.still.ears.clone());
        }
        let mut on_face = skin::skin(&self.pen, &outline);
        on_face.extend(skin::blush(&self.pen, &face.points, &outline, face.expression.cheek.clamp(0.0, 1.0)));
        on_face.push(self.still.sockets.clone());
        on_face.extend(self.still.scalp.clone());
        if let Some(beard) = &self.beard {
            on_face.extend(beard.draw(&self.pen, &face.points, self.neutral.units(), &outline));
        }
        on_face.extend(skin::contour(&self.pen, &outline, &face.points));
        on_face.extend(skin::folds(&self.pen, &face.points, self.neutral.units(), self.style.folds));
        on_face.push(self.still.nose.clone());
        on_face.extend(wrinkles::wrinkles(&face, &self.pen.palette, self.pen.ink));
        on_face.extend(mouth::mouth(&face.mouth, &self.pen.palette, self.pen.ink, self.pen.ink_only));
        for one in &face.eyes {
            on_face.extend(eye::eye(one, &self.pen.palette, self.pen.ink, self.pen.ink_only));
        }
        head.extend(self.sheet(Sheet::Face, on_face));
        let mut over = vec![self.still.hair.clone()];
        over.extend(self.brows(&face));
        over.extend(self.still.glasses.clone());
        head.extend(self.sheet(Sheet::Hair, over));
        moving.extend(on_head(head));

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

    /// A sheet with what an author has put under and over it.
    fn sheet(&self, sheet: Sheet, items: Vec<Item>) -> Vec<Item> {
        if self.extras.is_empty() {
            return items;
        }
        let own = |over: bool| {
            self.extras.iter().filter(move |e| e.sheet == sheet && e.over == over).flat_map(|e| e.items.iter().cloned())
        };
        own(false).chain(items).chain(own(true)).collect()
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

    /// The proportions that its style draws with.
    #[must_use]
    pub fn proportions(&self) -> &Proportions {
        &self.style.proportions
    }
}
