//! How much of every pixel an outline covers: exact areas, added up in whole numbers.
//!
//! What a pixel gets does not depend on which part of the picture is asked for, nor on the order of the edges: this is
//! why tiles that are painted one by one show what a whole picture does, on every processor.

use super::canvas::Area;
use super::edges::{BITS, Edge, Edges};

/// A pixel's side in the units of edges, and a covered pixel's sum: twice its area.
const ONE: i32 = 1 << BITS;
const FULL: i32 = 2 * ONE * ONE;

/// Room to add up in, kept from one outline to the next. Between two of them it is all zero.
#[derive(Default)]
pub(super) struct Cover {
    sums: Vec<i32>,
    /// Which sums have been touched, a bit each.
    marks: Vec<u64>,
}

/// The part that is looked at, and where its rows lie in the room.
#[derive(Clone, Copy)]
struct Frame {
    area: Area,
    stride: usize,
    words: usize,
}

impl Cover {
    /// Calls `span(y, x0, x1, cover)` for every run of pixels of `area` that the outline covers alike, 1 to 255, rows
    /// downward and runs to the right. Filled non-zero.
    pub(super) fn spans(&mut self, edges: &Edges, area: Area, mut span: impl FnMut(i32, i32, i32, u32)) {
        if area.is_empty() {
            return;
        }
        // One sum beyond the right edge takes what spills over it.
        let words = (area.width() + 1).div_ceil(64);
        let frame = Frame { area, stride: 64 * words, words };
        if self.sums.len() < frame.stride * area.height() {
            self.sums.resize(frame.stride * area.height(), 0);
            self.marks.resize(words.max(1) * area.height(), 0);
        }
        if self.marks.len() < words * area.height() {
            self.marks.resize(words * area.height(), 0);
        }
        let (mut top, mut bottom) = (area.y1, area.y0);
        for edge in &edges.all {
            if let Some((first, last)) = self.edge(edge, frame) {
                top = top.min(first);
                bottom = bottom.max(last + 1);
            }
        }
        let steps = (edges.steps, 255 / edges.steps.max(1));
        for y in top..bottom {
            self.row(y, frame, steps, &mut span);
        }
    }

    /// Adds one edge; returns the first and last row that it touched.
    #[inline]
    fn edge(&mut self, edge: &Edge, frame: Frame) -> Option<(i32, i32)> {
        let area = frame.area;
        let (top, bottom) = (edge.y0 >> BITS, (edge.y1 - 1) >> BITS);
        let (first, last) = (top.max(area.y0), bottom.min(area.y1 - 1));
        if edge.y0 == edge.y1 || first > last || edge.x0.min(edge.x1) >= area.x1 << BITS {
            return None;
        }
        if top == bottom {
            // Most are short, and lie in one row.
            self.piece(top, edge.x0, edge.x1, (edge.y1 - edge.y0) * edge.down, frame);
            return Some((top, top));
        }
        if edge.x0.max(edge.x1) <= area.x0 << BITS {
            // All to the left: whole pixels are covered from here on.
            for y in first..=last {
                let high = edge.y1.min((y + 1) << BITS) - edge.y0.max(y << BITS);
                self.add(y, area.x0, edge.down * high * 2 * ONE, frame);
            }
            return Some((first, last));
        }
        // The place on the edge at a height: always from the edge's own ends, so that it is the same in every tile.
        let slope = f64::from(edge.x1 - edge.x0) / f64::from(edge.y1 - edge.y0);
        let at = |y: i32| edge.x0 + whole(f64::from(y - edge.y0) * slope);
        let mut y_from = edge.y0.max(first << BITS);
        let mut from = if y_from == edge.y0 { edge.x0 } else { at(y_from) };
        for y in first..=last {
            let y_to = edge.y1.min((y + 1) << BITS);
            let to = if y_to == edge.y1 { edge.x1 } else { at(y_to) };
            self.piece(y, from, to, (y_to - y_from) * edge.down, frame);
            (y_from, from) = (y_to, to);
        }
        Some((first, last))
    }

    /// Adds the piece of an edge in one row, from `from` to `to`; `high` is its height with the edge's direction.
    #[inline]
    fn piece(&mut self, y: i32, from: i32, to: i32, high: i32, frame: Frame) {
        let (left, right) = (from.min(to), from.max(to));
        let (cell, end) = (left >> BITS, right >> BITS);
        if cell >= frame.area.x1 {
            return;
        }
        if cell == end && cell >= frame.area.x0 {
            self.cell(y, cell, left + right - 2 * (cell << BITS), high, frame);
            return;
        }
        let side = frame.area.x0 << BITS;
        if right <= side {
            self.add(y, frame.area.x0, high * 2 * ONE, frame);
            return;
        }
        // The height reached at a pixel's side.
        let rate = f64::from(high) / f64::from(right - left);
        let reached = |x: i32| whole(f64::from(x - left) * rate);
        let (mut x, mut done, mut cell) = (left, 0, cell);
        if left < side {
            done = reached(side);
            self.add(y, frame.area.x0, done * 2 * ONE, frame);
            (x, cell) = (side, frame.area.x0);
        }
        for cell in cell..=end.min(frame.area.x1 - 1) {
            let next = right.min((cell + 1) << BITS);
            let now = if next == right { high } else { reached(next) };
            self.cell(y, cell, x + next - 2 * (cell << BITS), now - done, frame);
            (x, done) = (next, now);
        }
    }

    /// Adds what lies in one pixel of the part: `beside` is the sum of the two distances from the pixel's left side.
    #[inline]
    fn cell(&mut self, y: i32, x: i32, beside: i32, high: i32, frame: Frame) {
        let place = (y - frame.area.y0) as usize * frame.stride + (x - frame.area.x0) as usize;
        let part = high * beside;
        let sums = &mut self.sums[place..place + 2];
        sums[0] += high * 2 * ONE - part;
        sums[1] += part;
        // The next pixel may be the next word's first.
        let (word, bit) = (place / 64, place % 64);
        self.marks[word] |= 3 << bit;
        if bit == 63 {
            self.marks[word + 1] |= 1;
        }
    }

    #[inline]
    fn add(&mut self, y: i32, x: i32, sum: i32, frame: Frame) {
        let place = (y - frame.area.y0) as usize * frame.stride + (x - frame.area.x0) as usize;
        self.sums[place] += sum;
        self.marks[place / 64] |= 1 << (place % 64);
    }

    /// Tells the runs of one row and leaves it zero.
    #[inline]
    fn row(&mut self, y: i32, frame: Frame, steps: (u32, u32), span: &mut impl FnMut(i32, i32, i32, u32)) {
        let row = (y - frame.area.y0) as usize;
        let start = row * frame.stride;
        let wide = frame.area.width();
        let (mut sum, mut from, mut cover) = (0_i32, 0_usize, 0_u32);
        for word in 0..frame.words {
            let mut bits = std::mem::take(&mut self.marks[row * frame.words + word]);
            while bits != 0 {
                let x = 64 * word + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                sum += std::mem::take(&mut self.sums[start + x]);
                let now = share(sum, steps);
                if now != cover && x < wide {
                    if cover > 0 {
                        span(y, frame.area.x0 + from as i32, frame.area.x0 + x as i32, cover);
                    }
                    (from, cover) = (x, now);
                }
            }
        }
        if cover > 0 {
            span(y, frame.area.x0 + from as i32, frame.area.x1, cover);
        }
    }
}

/// The nearest whole number, below 2^31 either way: the sum's last bits are it.
#[inline]
fn whole(v: f64) -> i32 {
    (v + 6_755_399_441_055_744.0).to_bits() as i32
}

/// A sum as 0 to 255, in so many steps of so much. Where an outline lies over itself it covers once.
#[inline]
fn share(sum: i32, (steps, step): (u32, u32)) -> u32 {
    (sum.unsigned_abs().min(FULL as u32) * steps + FULL as u32 / 2) / FULL as u32 * step
}
