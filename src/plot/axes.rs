//! The frame of a chart: a box, its axes in seconds and in values, and where a value lies in it.

use super::{GREY, RULE};
use crate::drawing::{Anchor, Colour, Drawing, Item, Layer};
use crate::geometry::{BezPath, Point, Rect, Shape, stroke_outline};

/// Size of letters in charts.
pub(super) const TEXT: f64 = 13.0;

/// A box with a time axis and a value axis.
pub(super) struct Axes {
    pub(super) area: Rect,
    pub(super) times: (f64, f64),
    pub(super) values: (f64, f64),
}

impl Axes {
    pub(super) fn x(&self, time: f64) -> f64 {
        let (from, to) = self.times;
        self.area.x0 + (time - from) / (to - from) * self.area.width()
    }

    pub(super) fn y(&self, value: f64) -> f64 {
        let (low, high) = self.values;
        self.area.y1 - (value - low) / (high - low) * self.area.height()
    }

    /// Rules and numbers of both axes. `name` stands over the value axis.
    pub(super) fn items(&self, name: &str, with_times: bool) -> Vec<Item> {
        let mut items = Vec::new();
        for value in ticks(self.values.0, self.values.1, (self.area.height() / 38.0).max(2.0)) {
            let y = self.y(value);
            items.push(rule(Point::new(self.area.x0, y), Point::new(self.area.x1, y), 1.0, RULE));
            let at = Point::new(self.area.x0 - 8.0, y + 0.35 * TEXT);
            items.push(Item::text(at, TEXT, Anchor::End, GREY, number(value)));
        }
        for time in ticks(self.times.0, self.times.1, (self.area.width() / 90.0).max(2.0)) {
            let x = self.x(time);
            items.push(rule(Point::new(x, self.area.y0), Point::new(x, self.area.y1), 1.0, RULE));
            if with_times {
                let at = Point::new(x, self.area.y1 + 1.5 * TEXT);
                items.push(Item::text(at, TEXT, Anchor::Middle, GREY, format!("{} s", number(time))));
            }
        }
        if self.values.0 < 0.0 && self.values.1 > 0.0 {
            let y = self.y(0.0);
            items.push(rule(Point::new(self.area.x0, y), Point::new(self.area.x1, y), 1.0, GREY));
        }
        if !name.is_empty() {
            let at = Point::new(self.area.x0, self.area.y0 - 0.7 * TEXT);
            items.push(Item::text(at, TEXT, Anchor::Start, GREY, name));
        }
        items
    }

    /// A curve through samples.
    pub(super) fn curve(
        &self,
        name: &str,
        points: impl Iterator<Item = (f64, f64)>,
        width: f64,
        colour: Colour,
    ) -> Item {
        let mut path = BezPath::new();
        for (time, value) in points {
            let p = Point::new(self.x(time), self.y(value));
            if path.elements().is_empty() { path.move_to(p) } else { path.line_to(p) }
        }
        Item::area(name, stroke_outline(&path, width), colour)
    }
}

/// A straight line.
pub(super) fn rule(a: Point, b: Point, width: f64, colour: Colour) -> Item {
    let mut path = BezPath::new();
    path.move_to(a);
    path.line_to(b);
    Item::area("", stroke_outline(&path, width), colour)
}

/// A filled box.
pub(super) fn block(area: Rect, colour: Colour) -> Item {
    Item::area("", area.to_path(0.1), colour)
}

/// Round values between `low` and `high`, about `count` of them.
pub(super) fn ticks(low: f64, high: f64, count: f64) -> Vec<f64> {
    let raw = (high - low) / count;
    if !(raw > 0.0 && raw.is_finite()) {
        return Vec::new();
    }
    let scale = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * scale).find(|s| *s >= raw * 0.999).unwrap_or(raw);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|i| i as f64 * step).collect()
}

/// A number without needless digits.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "\u{2212}") }
}

/// A chart of `items`, `width` × `height`, on white.
pub(super) fn chart(title: &str, description: &str, width: f64, height: f64, items: Vec<Item>) -> Drawing {
    Drawing {
        view: Rect::new(0.0, 0.0, width, height),
        title: title.into(),
        description: description.into(),
        background: Some(Colour::WHITE),
        layers: vec![Layer { name: "chart".into(), items }],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(ticks(0.0, 1.0, 5.0), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(ticks(-0.4, 0.9, 3.0), [0.0, 0.5]);
        assert!(ticks(1.0, 1.0, 5.0).is_empty());
        assert_eq!(number(-0.25), "\u{2212}0.25");
        assert_eq!(number(12.0), "12");
    }
}
