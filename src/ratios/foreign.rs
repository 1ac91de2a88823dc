//! Where the feature points are among the points of well-known trackers.

use crate::calibration::Binding;
use crate::face::FeaturePoint as P;

/// A named point and the points it is the mean of, the later ones with their shares in hundredths.
type Rows = &'static [(P, &'static [(usize, f64)])];

/// The 68 points of iBUG's 300-W, counted from 0 (Sagonas et al. 2013): dlib and OpenFace write them too. They have no pupils: an eye's
/// middle is that of its lids. The bridge, the tops of the wings, the temples and the forehead are not among them.
const IBUG: Rows = &[
    (P::P4_6, &[(17, 1.0)]),
    (P::P4_4A, &[(18, 0.67), (19, 0.33)]),
    (P::P4_4, &[(19, 0.33), (20, 0.67)]),
    (P::P4_2, &[(21, 1.0)]),
    (P::P4_1, &[(22, 1.0)]),
    (P::P4_3, &[(23, 0.67), (24, 0.33)]),
    (P::P4_3A, &[(24, 0.33), (25, 0.67)]),
    (P::P4_5, &[(26, 1.0)]),
    (P::P3_12, &[(36, 1.0)]),
    (P::P3_8, &[(39, 1.0)]),
    (P::P3_2, &[(37, 0.5), (38, 0.5)]),
    (P::P3_4, &[(40, 0.5), (41, 0.5)]),
    (P::P3_6, &[(37, 0.25), (38, 0.25), (40, 0.25), (41, 0.25)]),
    (P::P3_11, &[(42, 1.0)]),
    (P::P3_7, &[(45, 1.0)]),
    (P::P3_1, &[(43, 0.5), (44, 0.5)]),
    (P::P3_3, &[(46, 0.5), (47, 0.5)]),
    (P::P3_5, &[(43, 0.25), (44, 0.25), (46, 0.25), (47, 0.25)]),
    (P::P9_4, &[(31, 1.0)]),
    (P::P9_15, &[(33, 1.0)]),
    (P::P9_5, &[(35, 1.0)]),
    (P::P8_4, &[(48, 1.0)]),
    (P::P8_3, &[(54, 1.0)]),
    (P::P8_9, &[(50, 1.0)]),
    (P::P8_1, &[(51, 1.0)]),
    (P::P8_10, &[(52, 1.0)]),
    (P::P2_2, &[(62, 1.0)]),
    (P::P2_3, &[(66, 1.0)]),
    (P::P8_2, &[(57, 1.0)]),
    (P::P2_1, &[(8, 1.0)]),
    (P::P2_14, &[(4, 1.0)]),
    (P::P2_13, &[(12, 1.0)]),
];

/// Points of mediapipe's face mesh that move as the feature points do; the irises are among 478 only.
const MEDIAPIPE: Rows = &[
    (P::P4_6, &[(70, 1.0)]),
    (P::P4_4A, &[(63, 1.0)]),
    (P::P4_4, &[(105, 1.0)]),
    (P::P4_2, &[(107, 1.0)]),
    (P::P4_1, &[(336, 1.0)]),
    (P::P4_3, &[(334, 1.0)]),
    (P::P4_3A, &[(293, 1.0)]),
    (P::P4_5, &[(300, 1.0)]),
    (P::P3_12, &[(33, 1.0)]),
    (P::P3_8, &[(133, 1.0)]),
    (P::P3_2, &[(159, 1.0)]),
    (P::P3_4, &[(145, 1.0)]),
    (P::P3_11, &[(362, 1.0)]),
    (P::P3_7, &[(263, 1.0)]),
    (P::P3_1, &[(386, 1.0)]),
    (P::P3_3, &[(374, 1.0)]),
    (P::P9_2, &[(129, 1.0)]),
    (P::P9_1, &[(358, 1.0)]),
    (P::P9_4, &[(98, 1.0)]),
    (P::P9_5, &[(327, 1.0)]),
    (P::P9_15, &[(2, 1.0)]),
    (P::P8_4, &[(61, 1.0)]),
    (P::P8_3, &[(291, 1.0)]),
    (P::P8_9, &[(37, 1.0)]),
    (P::P8_1, &[(0, 1.0)]),
    (P::P8_10, &[(267, 1.0)]),
    (P::P2_2, &[(13, 1.0)]),
    (P::P2_3, &[(14, 1.0)]),
    (P::P8_2, &[(17, 1.0)]),
    (P::P2_1, &[(152, 1.0)]),
    (P::P11_1, &[(10, 1.0)]),
];

/// The irises, and what stands for them where there are none: the middle between the lids.
const IRISES: Rows = &[(P::P3_6, &[(468, 1.0)]), (P::P3_5, &[(473, 1.0)])];
const LIDS: Rows = &[(P::P3_6, &[(159, 0.5), (145, 0.5)]), (P::P3_5, &[(386, 0.5), (374, 0.5)])];

impl Binding {
    /// The binding of a model of iBUG's 68 points.
    #[must_use]
    pub(crate) fn ibug68() -> Self {
        Self::of_rows(68, IBUG.iter().map(|(p, sum)| (*p, sum.to_vec())).collect())
    }

    /// The binding of mediapipe's face mesh, of 468 points, or of 478 with the irises.
    #[must_use]
    pub(crate) fn mediapipe(count: usize) -> Self {
        let pupils = if count >= 478 { IRISES } else { LIDS };
        Self::of_rows(count, MEDIAPIPE.iter().chain(pupils).map(|(p, sum)| (*p, sum.to_vec())).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_point_is_a_mean_of_points_that_there_are() {
        for binding in [Binding::ibug68(), Binding::mediapipe(468), Binding::mediapipe(478)] {
            for (name, sum) in binding.rows() {
                let shares: f64 = sum.iter().map(|(_, share)| share).sum();
                assert!((shares - 1.0).abs() < 1e-12 && sum.iter().all(|(i, _)| *i < binding.count()), "{name:?}");
                assert_eq!(binding.rows().iter().filter(|(other, _)| other == name).count(), 1, "{name:?}");
            }
        }
    }
}
