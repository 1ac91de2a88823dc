//! From a rough place to all points: each stage looks round where the points now are and says how far to move them
//! (supervised descent, Xiong and De la Torre 2013).

use super::Pyramid;
use super::channels::{Channels, DESCRIPTOR};
use super::shape::ShapeModel;
use super::weights::{Matrix, Reader, Writer};
use crate::geometry::{Point, Similarity, Vec2};

/// What a chip shows of the face frame: left, top, right, bottom, in pupil distances.
const VIEW: [f64; 4] = [-1.55, -1.5, 1.55, 1.9];

/// A crop of the face, upright, of a known size.
#[derive(Debug, Clone)]
pub struct Chip {
    /// Edge directions, not yet spread.
    pub edges: Channels,
    /// Their mean strength.
    pub strength: f32,
    /// Pixels in a pupil distance.
    pub scale: f64,
}

impl Chip {
    /// The crop of a face that lies at `face` in the photo.
    #[must_use]
    pub fn of(picture: &Pyramid, face: &Similarity, scale: f64) -> Self {
        let edges = Channels::of(&Self::plane(picture, face, scale));
        Self { strength: edges.strength(), edges, scale }
    }

    /// The same crop in grey.
    #[must_use]
    pub(crate) fn plane(picture: &Pyramid, face: &Similarity, scale: f64) -> crate::photo::Plane {
        let place = face.after(&Similarity { a: 1.0 / scale, b: 0.0, origin: Point::new(VIEW[0], VIEW[1]) });
        let size = |from: f64, to: f64| ((to - from) * scale).round() as usize;
        picture.crop(&place, size(VIEW[0], VIEW[2]), size(VIEW[1], VIEW[3]))
    }

    /// Spread for cells of `cell` pupil distances.
    #[must_use]
    pub fn spread(&self, cell: f64) -> Spread {
        let cell = (cell * self.scale) as f32;
        Spread { channels: self.edges.spread(cell), cell, strength: self.strength, scale: self.scale }
    }
}

/// A chip made ready for descriptors of one size.
#[derive(Debug, Clone)]
pub struct Spread {
    channels: Channels,
    cell: f32,
    strength: f32,
    scale: f64,
}

impl Spread {
    /// The descriptor at a place in the face frame.
    pub fn describe(&self, at: Point, out: &mut [f32]) {
        let x = ((at.x - VIEW[0]) * self.scale) as f32;
        let y = ((at.y - VIEW[1]) * self.scale) as f32;
        self.channels.describe(x, y, self.cell, self.strength, out);
    }
}

/// What a block of a stage moves.
#[derive(Debug, Clone, PartialEq)]
pub enum Moves {
    /// The whole shape, along its modes.
    Modes,
    /// These points, each by itself.
    Points(Vec<usize>),
}

/// A linear map from descriptors to a move.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// The points where descriptors are taken.
    pub sites: Vec<usize>,
    /// What it moves.
    pub moves: Moves,
    /// A row for each number of the move, over the short descriptors of the sites in turn.
    pub weights: Matrix,
    /// What each number starts from.
    pub bias: Vec<f32>,
}

/// One step of the cascade.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Pixels in a pupil distance of its chip.
    pub scale: f64,
    /// Side of a descriptor's cell, in pupil distances.
    pub cell: f64,
    /// What shortens a descriptor: a row for each number that is kept.
    pub basis: Matrix,
    /// What a descriptor is on average.
    pub usual: Vec<f32>,
    /// Its linear maps.
    pub blocks: Vec<Block>,
}

impl Stage {
    /// The short descriptors at some points of a shape, one after another.
    pub fn describe(&self, chip: &Spread, shape: &[Point], sites: &[usize], out: &mut Vec<f32>) {
        out.clear();
        let kept = self.basis.rows;
        let mut long = [0.0; DESCRIPTOR];
        for (n, site) in sites.iter().enumerate() {
            chip.describe(shape[*site], &mut long);
            long.iter_mut().zip(&self.usual).for_each(|(v, m)| *v -= m);
            out.resize((n + 1) * kept, 0.0);
            self.basis.times(&long, &mut out[n * kept..]);
        }
    }

    /// Moves a shape in the face frame of the chip.
    pub(crate) fn step(&self, model: &ShapeModel, chip: &Spread, shape: &mut [Point]) {
        let mut short = Vec::new();
        let start = shape.to_vec();
        for block in &self.blocks {
            self.describe(chip, &start, &block.sites, &mut short);
            let mut moves = block.bias.clone();
            block.weights.times(&short, &mut moves);
            match &block.moves {
                Moves::Modes => model.moved(shape, &moves),
                Moves::Points(points) => {
                    for (point, by) in points.iter().zip(moves.chunks_exact(2)) {
                        shape[*point] += Vec2::new(f64::from(by[0]), f64::from(by[1]));
                    }
                }
            }
        }
    }

    /// What the first row of the first block says of a shape: how stages judge instead of move.
    #[must_use]
    pub(crate) fn judge(&self, chip: &Spread, shape: &[Point]) -> f32 {
        let Some(block) = self.blocks.first() else { return 0.0 };
        let mut short = Vec::new();
        self.describe(chip, shape, &block.sites, &mut short);
        let mut said = [block.bias[0]];
        block.weights.times(&short, &mut said);
        said[0]
    }

    /// Into bytes.
    pub(crate) fn write(&self, out: &mut Writer) {
        out.numbers(&[self.scale as f32, self.cell as f32]);
        out.matrix(&self.basis);
        out.numbers(&self.usual);
        out.count(self.blocks.len());
        for block in &self.blocks {
            let indices = |list: &[usize]| list.iter().map(|i| *i as f32).collect::<Vec<_>>();
            out.numbers(&indices(&block.sites));
            match &block.moves {
                Moves::Modes => out.numbers(&[]),
                Moves::Points(points) => out.numbers(&indices(points)),
            }
            out.matrix(&block.weights);
            out.numbers(&block.bias);
        }
    }

    /// From bytes.
    pub(crate) fn read(bytes: &mut Reader) -> Option<Self> {
        let head = bytes.numbers()?;
        let [scale, cell] = head[..] else { return None };
        let (basis, usual) = (bytes.matrix()?, bytes.numbers()?);
        let indices = |bytes: &mut Reader| Some(bytes.numbers()?.iter().map(|i| *i as usize).collect::<Vec<_>>());
        let blocks = (0..bytes.count()?)
            .map(|_| {
                let sites = indices(bytes)?;
                let points = indices(bytes)?;
                let moves = if points.is_empty() { Moves::Modes } else { Moves::Points(points) };
                Some(Block { sites, moves, weights: bytes.matrix()?, bias: bytes.numbers()? })
            })
            .collect::<Option<Vec<_>>>()?;
        // Sizes are written with few digits so that they come back as they were.
        let exact = |v: f32| (f64::from(v) * 1e4).round() / 1e4;
        Some(Self { scale: exact(scale), cell: exact(cell), basis, usual, blocks })
    }
}
