//! A tile as ready bits, row by row, so that rows of a picture are put together from tiles that were told before.

use super::adler::Sum;
use super::canvas::{Area, Canvas, Pixel, straight};
use super::huffman::Bits;
use super::tokens::{Coded, Sink, Table, tell_zeros};

/// What a row of a band is filtered with (PNG 9.2): not at all in the first, so that bands stand by themselves, and by
/// the row above in the others.
pub(super) const FILTERS: [u8; 2] = [0, 2];

/// A tile in the codes of a table.
pub(super) struct Piece {
    rows: Box<[Row]>,
    words: Box<[u32]>,
}

/// A row: zeros, bits, zeros. The zeros at the ends may run on into the neighbouring tiles.
struct Row {
    before: u32,
    start: u32,
    bits: u32,
    after: u32,
    sum: Sum,
}

impl Piece {
    /// The tile `area` of a picture whose pixels have 3 channels or 4. `bits` is room to work in.
    pub(super) fn new(canvas: &Canvas, area: Area, channels: usize, table: &Table, bits: &mut Bits) -> Self {
        bits.clear();
        let mut told = Vec::with_capacity(area.height());
        let mut rows = Rows::new(canvas, area, channels);
        for y in area.y0..area.y1 {
            let (now, above) = rows.at(y);
            let start = bits.len();
            let mut sink = Coded { table, bits };
            let (before, after, sum) = match above {
                None => (0, 0, tell_first(now, channels, &mut sink)),
                Some(above) => tell_differences(now, above, channels, &mut sink),
            };
            let count = bits.len() - start;
            bits.fill_word();
            told.push(Row {
                before: before as u32,
                start: (start / 32) as u32,
                bits: count as u32,
                after: after as u32,
                sum,
            });
        }
        Self { rows: told.into(), words: bits.words().into() }
    }

    /// Bytes of memory that it takes.
    pub(super) fn size(&self) -> usize {
        size_of::<Self>() + self.rows.len() * size_of::<Row>() + 4 * self.words.len()
    }
}

/// Puts tiles that lie side by side together to a band's bits, and adds its bytes up.
pub(super) fn splice(pieces: &[&Piece], high: usize, table: &Table, bits: &mut Bits) -> Sum {
    let mut sum = Sum::default();
    bits.clear();
    table.open(bits);
    let mut sink = Coded { table, bits };
    for y in 0..high {
        let filter = FILTERS[usize::from(y > 0)];
        sink.byte(filter);
        let mut row_sum = Sum::default();
        row_sum.byte(filter);
        let mut zeros = 0;
        for piece in pieces {
            let row = &piece.rows[y];
            row_sum.add(row.sum);
            zeros += row.before as usize;
            if row.bits > 0 {
                tell_zeros(&mut sink, zeros);
                sink.bits.append(&piece.words[row.start as usize..], row.bits as usize);
                zeros = row.after as usize;
            }
        }
        tell_zeros(&mut sink, zeros);
        sum = sum.then(row_sum);
    }
    table.close(sink.bits);
    sum
}

/// Counts what a part of the picture would be told by.
pub(super) fn count(canvas: &Canvas, area: Area, channels: usize, sink: &mut impl Sink) {
    let mut rows = Rows::new(canvas, area, channels);
    for y in area.y0..area.y1 {
        let (now, above) = rows.at(y);
        let (before, after) = match above {
            None => {
                tell_first(now, channels, sink);
                (0, 0)
            }
            Some(above) => {
                let (before, after, _) = tell_differences(now, above, channels, sink);
                (before, after)
            }
        };
        tell_zeros(sink, before);
        tell_zeros(sink, after);
    }
}

/// The bytes of a part of the picture as filters leave them: as they are, or below the first row by their differences.
pub(super) fn filtered(canvas: &Canvas, area: Area, channels: usize, differences: bool) -> Vec<u8> {
    let mut bytes = Vec::with_capacity((area.width() * channels + 1) * area.height());
    let mut rows = Rows::new(canvas, area, channels);
    for y in area.y0..area.y1 {
        let (now, above) = rows.at(y);
        let above = above.filter(|_| differences);
        bytes.push(FILTERS[usize::from(above.is_some())]);
        match above {
            None => now.iter().for_each(|p| bytes.extend_from_slice(&p.to_le_bytes()[..channels])),
            Some(above) => now.iter().zip(above).for_each(|(p, q)| {
                let (p, q) = (p.to_le_bytes(), q.to_le_bytes());
                bytes.extend((0..channels).map(|k| p[k].wrapping_sub(q[k])));
            }),
        }
    }
    bytes
}

/// Rows of a part of a canvas with the row above, as they are in a file: straight where pixels have an alpha.
struct Rows<'a> {
    canvas: &'a Canvas,
    area: Area,
    straight: Option<[Vec<Pixel>; 2]>,
}

impl<'a> Rows<'a> {
    fn new(canvas: &'a Canvas, area: Area, channels: usize) -> Self {
        Self { canvas, area, straight: (channels == 4).then(Default::default) }
    }

    /// Row `y`, which comes after the row above, and that one, if there is one.
    fn at(&mut self, y: i32) -> (&[Pixel], Option<&[Pixel]>) {
        let Area { x0, x1, y0, .. } = self.area;
        match &mut self.straight {
            None => (self.canvas.row(y, x0, x1), (y > y0).then(|| self.canvas.row(y - 1, x0, x1))),
            Some([now, above]) => {
                std::mem::swap(now, above);
                now.clear();
                now.extend(self.canvas.row(y, x0, x1).iter().map(|p| straight(*p)));
                (now, (y > y0).then_some(above))
            }
        }
    }
}

/// Tells pixels as they are.
fn tell_first(row: &[Pixel], channels: usize, sink: &mut impl Sink) -> Sum {
    let mut sum = Sum::default();
    let mut x = 0;
    while x < row.len() {
        for byte in &row[x].to_le_bytes()[..channels] {
            sink.byte(*byte);
        }
        let alike = row[x..].iter().take_while(|p| **p == row[x]).count();
        if alike > 1 {
            sink.again((alike - 1) * channels);
        }
        (0..alike).for_each(|_| row[x].to_le_bytes()[..channels].iter().for_each(|b| sum.byte(*b)));
        x += alike;
    }
    sum
}

/// Tells how a row differs from the one above, but for the zeros at both ends, whose numbers are returned.
fn tell_differences(now: &[Pixel], above: &[Pixel], channels: usize, sink: &mut impl Sink) -> (usize, usize, Sum) {
    let length = now.len() * channels;
    let mut sum = Sum::zeros(length as u32);
    let (mut before, mut zeros, mut x) = (None, 0, 0);
    while x < now.len() {
        // Mostly there is no difference.
        if let (Some(a), Some(b)) = (now[x..].first_chunk::<8>(), above[x..].first_chunk::<8>())
            && a.iter().zip(b).fold(0, |all, (p, q)| all | (p ^ q)) == 0
        {
            (x, zeros) = (x + 8, zeros + 8 * channels);
            continue;
        }
        if now[x] == above[x] {
            (x, zeros) = (x + 1, zeros + channels);
            continue;
        }
        let (p, q) = (now[x].to_le_bytes(), above[x].to_le_bytes());
        for k in 0..channels {
            let byte = p[k].wrapping_sub(q[k]);
            if byte == 0 {
                zeros += 1;
                continue;
            }
            match before {
                None => before = Some(zeros),
                Some(_) => tell_zeros(sink, zeros),
            }
            zeros = 0;
            sink.byte(byte);
            sum.put(byte, (length - x * channels - k) as u32);
        }
        x += 1;
    }
    match before {
        None => (length, 0, sum),
        Some(before) => (before, zeros, sum),
    }
}
