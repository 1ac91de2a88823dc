//! A band of a picture in the codes of a table: what moves is told pixel by pixel, and what was told before is put
//! between as ready bits, row by row.

use super::adler::Sum;
use super::canvas::{Area, Canvas, Pixel, straight};
use super::huffman::Bits;
use super::tiles::TILE;
use super::tokens::{Coded, Sink, Table};

/// What a row of a band is filtered with (PNG 9.2): not at all in the first, so that bands stand by themselves, and by
/// the row above in the others.
pub(super) const FILTERS: [u8; 2] = [0, 2];

/// Tiles that lie side by side, in the codes of a table.
pub(super) struct Piece {
    /// Bytes of a row.
    length: u32,
    rows: Box<[Row]>,
    words: Box<[u64]>,
}

/// A row: zeros, bits, zeros. The zeros at the ends may run on into what lies beside it.
struct Row {
    before: u32,
    start: u32,
    bits: u32,
    after: u32,
    sum: [u16; 2],
}

/// A part of a band.
pub(super) enum Stretch<'a> {
    Ready(&'a Piece),
    /// Pixels of the canvas, whole tiles.
    New(Area),
}

/// What has been told of a row since its last byte that is not 0.
struct Told {
    /// Zeros that are still to be told.
    zeros: usize,
    /// How many of them there were before the first other byte.
    before: Option<usize>,
    sum: Sum,
}

impl Told {
    const NOTHING: Self = Self { zeros: 0, before: None, sum: Sum::NONE };

    /// Gets room for a byte that is not 0.
    #[inline]
    fn close(&mut self, sink: &mut impl Sink) {
        if self.before.is_none() {
            self.before = Some(self.zeros);
        } else if self.zeros > 0 {
            sink.gap(self.zeros);
        }
        self.zeros = 0;
    }
}

impl Piece {
    /// Whole tiles of a picture whose pixels have 3 channels or 4. `bits` is room to work in.
    pub(super) fn new(canvas: &Canvas, area: Area, channels: usize, table: &Table, bits: &mut Bits) -> Self {
        bits.clear();
        let mut told = Vec::with_capacity(area.height());
        let mut rows = Rows::new(canvas, area, channels);
        for y in area.y0..area.y1 {
            let (now, above) = rows.at(y);
            let start = bits.len();
            let mut sink = Coded { table, bits };
            let mut row = Told::NOTHING;
            tell(now, above, channels, &mut row, &mut sink);
            let count = bits.len() - start;
            bits.fill_word();
            let before = row.before.unwrap_or(row.zeros);
            let after = if row.before.is_some() { row.zeros } else { 0 };
            told.push(Row {
                before: before as u32,
                start: (start / 64) as u32,
                bits: count as u32,
                after: after as u32,
                sum: row.sum.packed(),
            });
        }
        Self { length: (area.width() * channels) as u32, rows: told.into(), words: bits.words().into() }
    }

    /// Bytes of memory that it takes.
    pub(super) fn size(&self) -> usize {
        size_of::<Self>() + self.rows.len() * size_of::<Row>() + 8 * self.words.len()
    }
}

/// Tells a band from left to right, and adds its bytes up.
pub(super) fn tell_band(
    canvas: &Canvas,
    stretches: &[Stretch],
    high: usize,
    channels: usize,
    table: &Table,
    bits: &mut Bits,
) -> Sum {
    let mut rows: Vec<Option<Rows>> = stretches
        .iter()
        .map(|s| match s {
            Stretch::New(area) => Some(Rows::new(canvas, *area, channels)),
            Stretch::Ready(_) => None,
        })
        .collect();
    let mut sum = Sum::NONE;
    bits.clear();
    table.open(bits);
    let mut sink = Coded { table, bits };
    for y in 0..high {
        let filter = FILTERS[usize::from(y > 0)];
        sink.byte(filter);
        let mut row = Told { before: Some(0), ..Told::NOTHING };
        row.sum.byte(filter);
        for (stretch, rows) in stretches.iter().zip(&mut rows) {
            match (stretch, rows) {
                (Stretch::Ready(piece), _) => {
                    let ready = &piece.rows[y];
                    row.sum.add(Sum::unpacked(piece.length, ready.sum));
                    row.zeros += ready.before as usize;
                    if ready.bits > 0 {
                        row.close(&mut sink);
                        sink.bits.append(&piece.words[ready.start as usize..], ready.bits as usize);
                        row.zeros = ready.after as usize;
                    }
                }
                (Stretch::New(area), Some(rows)) => {
                    let (now, above) = rows.at(area.y0 + y as i32);
                    tell(now, above, channels, &mut row, &mut sink);
                }
                (Stretch::New(_), None) => {}
            }
        }
        sink.gap(row.zeros);
        sum = sum.then(row.sum);
    }
    table.close(sink.bits);
    sum
}

/// Counts what a part of the picture would be told by.
pub(super) fn count(canvas: &Canvas, area: Area, channels: usize, sink: &mut impl Sink) {
    let mut rows = Rows::new(canvas, area, channels);
    for y in area.y0..area.y1 {
        let (now, above) = rows.at(y);
        let mut row = Told { before: Some(0), ..Told::NOTHING };
        tell(now, above, channels, &mut row, sink);
        sink.gap(row.zeros);
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

/// Tells pixels that come after what has been told of their row.
#[inline]
fn tell(now: &[Pixel], above: Option<&[Pixel]>, channels: usize, row: &mut Told, sink: &mut impl Sink) {
    match (above, channels) {
        (None, _) => {
            row.close(sink);
            // Tile by tile, so that the same is told however tiles are put together.
            now.chunks(TILE.0 as usize).for_each(|tile| tell_first(tile, channels, &mut row.sum, sink));
        }
        (Some(above), 3) => tell_differences::<3>(now, above, row, sink),
        (Some(above), _) => tell_differences::<4>(now, above, row, sink),
    }
}

/// Tells pixels as they are.
fn tell_first(row: &[Pixel], channels: usize, sum: &mut Sum, sink: &mut impl Sink) {
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
}

/// Tells how pixels differ from those above.
fn tell_differences<const CHANNELS: usize>(now: &[Pixel], above: &[Pixel], row: &mut Told, sink: &mut impl Sink) {
    let above = &above[..now.len()];
    let length = now.len() * CHANNELS;
    let mut sum = Sum::zeros(length as u32);
    let (mut x, mut from) = (0, 0);
    loop {
        // Mostly there is no difference.
        while let (Some(a), Some(b)) = (now[x..].first_chunk::<8>(), above[x..].first_chunk::<8>())
            && a.iter().zip(b).fold(0, |all, (p, q)| all | (p ^ q)) == 0
        {
            x += 8;
        }
        while x < now.len() && now[x] == above[x] {
            x += 1;
        }
        row.zeros += (x - from) * CHANNELS;
        while x < now.len() && now[x] != above[x] {
            let (p, q) = (now[x].to_le_bytes(), above[x].to_le_bytes());
            let bytes: [u8; CHANNELS] = std::array::from_fn(|k| p[k].wrapping_sub(q[k]));
            sum.put(&bytes, (length - x * CHANNELS) as u32);
            match bytes.first_chunk::<3>() {
                Some(three) if CHANNELS == 3 && !three.contains(&0) => {
                    row.close(sink);
                    sink.three(*three);
                }
                _ => bytes.into_iter().for_each(|byte| match byte {
                    0 => row.zeros += 1,
                    _ => {
                        row.close(sink);
                        sink.byte(byte);
                    }
                }),
            }
            x += 1;
        }
        if x >= now.len() {
            break;
        }
        from = x;
    }
    row.sum.add(sum);
}
