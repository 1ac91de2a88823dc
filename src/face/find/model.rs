//! All that was learned of faces.

use super::cascade::Stage;
use super::detector::Detector;
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
    /// Lays it closely.
    pub fine: Vec<Stage>,
    /// Say whether what a shape lies on is a face, after the coarse and after the fine stages: above 0 it is.
    pub judges: [Stage; 2],
}

/// The first bytes of learned numbers.
const MAGIC: usize = 0x3150_4c46;

impl Model {
    /// Into bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = Writer::default();
        out.count(MAGIC);
        self.detector.write(&mut out);
        self.shapes.write(&mut out);
        for stages in [&self.coarse[..], &self.fine, &self.judges] {
            out.count(stages.len());
            stages.iter().for_each(|s| s.write(&mut out));
        }
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
        let mut stages = || (0..bytes.count()?).map(|_| Stage::read(&mut bytes)).collect::<Option<Vec<_>>>();
        let (coarse, fine, judges) = (stages()?, stages()?, stages()?);
        Some(Self { detector, shapes, coarse, fine, judges: judges.try_into().ok()? })
    }
}
