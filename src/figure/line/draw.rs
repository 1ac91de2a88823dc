//! A pose becomes the drawing of a line figure.

use super::{Backdrop, LineFigure, eye};
use crate::drawing::{Colour, Drawing, Item, Layer};
use crate::figure::describe;
use crate::geometry::{BezPath, Knot, PathEl, Ribbon};
use crate::pose::{Head, Pose};

impl LineFigure {
    /// The drawing of a pose: what stays the same on the layer `static`, what moves on `dynamic` (thesis 7.3.1).
    #[must_use]
    pub fn draw(&self, pose: &Pose) -> Drawing {
        let knots = self.points(pose);
        let mut moving = Vec::new();
        for fill in &self.fills {
            let strokes: Vec<Ribbon> = fill.lines.iter().map(|l| self.ribbon(*l, &knots)).collect();
            moving.push(Item::area(&fill.name, closed(&strokes), fill.colour));
        }
        for eye in &self.eyes {
            moving.extend(eye.draw(self, &knots, pose));
        }
        moving.extend(self.mouth.draw(self, &knots, &pose.mouth));
        for (i, line) in self.lines.iter().enumerate() {
            if !self.is_of_eye_or_mouth(i) {
                moving.push(self.ink(&line.name, &[self.ribbon(i, &knots)], self.colours.ink));
            }
        }
        let (mut still, mut head): (Vec<Item>, Vec<Item>) = (Vec::new(), Vec::new());
        let turned = pose.head != Head::default();
        for part in &self.behind {
            let list = if turned && part.head { &mut head } else { &mut still };
            list.extend(part.items(self));
        }
        for part in &self.before {
            moving.extend(part.items(self));
        }
        if turned {
            head.append(&mut moving);
            moving = vec![Item::moved("head", eye::head_transform(self, pose), head)];
        }
        Drawing {
            view: self.view,
            title: self.title.clone(),
            description: describe(pose),
            background: Some(Colour::WHITE),
            layers: vec![
                Layer { name: "static".into(), items: still },
                Layer { name: "dynamic".into(), items: moving },
            ],
        }
    }

    /// The figure's points in a pose: the emotions blended, the lids closed as far as they are, the mouth speaking.
    #[must_use]
    pub fn points(&self, pose: &Pose) -> Vec<Knot> {
        let mut knots = self.blend(&pose.ratios);
        for eye in &self.eyes {
            eye.close(&mut knots, pose);
        }
        self.mouth.speak(&mut knots, &self.drawings[0], &pose.mouth, &self.lines);
        knots
    }
}

impl Backdrop {
    fn items(&self, figure: &LineFigure) -> Vec<Item> {
        let mut items = Vec::new();
        if let Some(fill) = self.fill {
            items.push(Item::area(format!("{}-fill", self.name), closed(&self.strokes), fill));
        }
        if let Some(colour) = self.ink {
            items.push(figure.ink(&self.name, &self.strokes, colour));
        }
        items
    }
}

/// The area that a chain of strokes goes round, closed by a straight line.
fn closed(strokes: &[Ribbon]) -> BezPath {
    let mut path = BezPath::new();
    for stroke in strokes {
        let c = stroke.centre();
        if path.elements().is_empty() {
            path.push(PathEl::MoveTo(c.p0));
        }
        path.push(PathEl::CurveTo(c.p1, c.p2, c.p3));
    }
    path.close_path();
    path
}
