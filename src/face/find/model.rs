//! All that was learned of faces.

use std::sync::OnceLock;

use super::cascade::Stage;
use super::detector::Detector;
use super::looks::Looks;
use super::shape::ShapeModel;
use super::weights::{Reader, Writer};

/// Learned numbers: where a face is, what shapes it has, how its points are found.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Finds faces.
    pub detector: Detector,
    /// The shapes of faces.
    pub shapes: ShapeModel,
    /// Lays a shape roughly on a face.
    pub coarse: Vec<Stage>,
    /// Lay it closely: chains of stages, of which the middle is taken. All have at least one stage.
    pub fine: Vec<Vec<Stage>>,
    /// Say whether what a shape lies on is a face, after the coarse and after the fine stages: above 0 it is.
    pub judges: [Stage; 2],
    /// Says how far each point can be trusted.
    pub looks: Looks,
}

/// The first bytes of learned numbers.
const MAGIC: usize = 0x3150_4c46;

impl Model {
    /// What was learned from the London set; see `NOTES.md` beside the numbers.
    ///
    /// # Panics
    /// Never: the numbers are part of the program, and a test reads them.
    #[must_use]
    pub fn learned() -> &'static Self {
        static LEARNED: OnceLock<Model> = OnceLock::new();
        LEARNED.get_or_init(|| Self::from_bytes(include_bytes!("learned.bin")).expect("the learned numbers are whole"))
    }

    /// Into bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = Writer::default();
        out.count(MAGIC);
        self.detector.write(&mut out);
        self.shapes.write(&mut out);
        let mut stages = |stages: &[Stage]| {
            out.count(stages.len());
            stages.iter().for_each(|s| s.write(&mut out));
        };
        stages(&self.coarse);
        stages(&self.judges);
        out.count(self.fine.len());
        for chain in &self.fine {
            out.count(chain.len());
            chain.iter().for_each(|s| s.write(&mut out));
        }
        self.looks.write(&mut out);
        out.0
    }

    /// From bytes; none where they are not such numbers.
    #[must_use]
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let mut bytes = Reader(bytes);
        if bytes.count()? != MAGIC {
            return None;
        }
        let detector = Detector::read(&mut bytes)?;
        let shapes = ShapeModel::read(&mut bytes)?;
        let stages = |bytes: &mut Reader| (0..bytes.count()?).map(|_| Stage::read(bytes)).collect::<Option<Vec<_>>>();
        let (coarse, judges) = (stages(&mut bytes)?, stages(&mut bytes)?.try_into().ok()?);
        let fine: Vec<_> = (0..bytes.count()?).map(|_| stages(&mut bytes)).collect::<Option<_>>()?;
        if fine.is_empty() || fine.iter().any(Vec::is_empty) {
            return None;
        }
        Some(Self { detector, shapes, coarse, fine, judges, looks: Looks::read(&mut bytes)? })
    }
}
