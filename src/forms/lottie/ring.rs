//! Outlines as Lottie has them: closed rings of points, each with the way in and the way out.

use std::fmt::Write;

use crate::forms::parts::Path;

/// A closed outline.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Ring {
    points: Vec<[i32; 2]>,
    /// From a point to its handles.
    ins: Vec<[i32; 2]>,
    outs: Vec<[i32; 2]>,
}

const NONE: [i32; 2] = [0, 0];

fn less(a: [i32; 2], b: [i32; 2]) -> [i32; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

impl Ring {
    /// The outlines of a path.
    pub(crate) fn of_path(path: &Path) -> Vec<Self> {
        let mut rings: Vec<Self> = Vec::new();
        for (verb, points) in path.pieces() {
            let (Some(ring), Some(last)) = (rings.last_mut(), points.last()) else {
                if let (b'M', [start]) = (verb, points) {
                    rings.push(Self { points: vec![*start], ins: vec![NONE], outs: vec![NONE] });
                }
                continue;
            };
            let from = ring.points.last().copied().unwrap_or(NONE);
            let (out, into) = match (verb, points) {
                (b'M', [start]) => {
                    rings.push(Self { points: vec![*start], ins: vec![NONE], outs: vec![NONE] });
                    continue;
                }
                (b'C', [a, b, to]) => (less(*a, from), less(*b, *to)),
                (b'Q', [a, to]) => {
                    let third = |v: [i32; 2]| v.map(|v| (f64::from(v) * 2.0 / 3.0).round() as i32);
                    (third(less(*a, from)), third(less(*a, *to)))
                }
                _ => (NONE, NONE),
            };
            if let Some(o) = ring.outs.last_mut() {
                *o = out;
            }
            ring.points.push(*last);
            ring.ins.push(into);
            ring.outs.push(NONE);
        }
        rings.iter_mut().for_each(Self::close);
        rings
    }

    /// An end that lies on the beginning is one point with it.
    fn close(&mut self) {
        if self.points.len() > 1 && self.points.first() == self.points.last() {
            self.points.pop();
            self.outs.pop();
            if let (Some(into), Some(first)) = (self.ins.pop(), self.ins.first_mut()) {
                *first = into;
            }
        }
    }

    /// How many points it has.
    pub(crate) fn len(&self) -> usize {
        self.points.len()
    }

    /// As JSON, with as many points as `count`: the last is repeated, and the last of them leads back.
    pub(crate) fn json(&self, count: usize) -> String {
        let more = count.saturating_sub(self.points.len());
        let last = self.points.last().copied().unwrap_or(NONE);
        let mut points = self.points.clone();
        let (mut ins, mut outs) = (self.ins.clone(), self.outs.clone());
        if more > 0 {
            let back = outs.last().copied().unwrap_or(NONE);
            if let Some(o) = outs.last_mut() {
                *o = NONE;
            }
            points.resize(count, last);
            ins.resize(count, NONE);
            outs.resize(count, NONE);
            if let Some(o) = outs.last_mut() {
                *o = back;
            }
        }
        let mut text = String::from("{\"c\":true");
        for (name, list) in [("v", &points), ("i", &ins), ("o", &outs)] {
            let _ = write!(text, ",\"{name}\":[");
            for (n, [x, y]) in list.iter().enumerate() {
                let _ = write!(text, "{}[{x},{y}]", if n > 0 { "," } else { "" });
            }
            text.push(']');
        }
        text.push('}');
        text
    }
}
