//! What a fit's residual says about its error.

/// How much of the contrast under a fit the looks leave unexplained, as known from training: of fits that are right,
/// and of fits that are not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Trust {
    /// At this residual a fit is as likely right as wrong.
    pub even: f32,
    /// How fast confidence falls there.
    pub steep: f32,
}

impl Trust {
    /// 0 to 1; at 0.5 and above a fit can be used.
    pub(crate) fn confidence(&self, residual: f32) -> f64 {
        if !residual.is_finite() {
            return 0.0;
        }
        let ratio = f64::from(residual.max(1e-6) / self.even);
        1.0 / (1.0 + ratio.powf(f64::from(self.steep)))
    }
}
