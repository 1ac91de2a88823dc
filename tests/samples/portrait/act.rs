//! What a face does: its muscles as numbers, the seven emotions in them, and the mouth of speech.
//!
//! A mix of emotions is the mix of their numbers. Points of the face move in proportion to them (see `flesh`), so that
//! the ratios of a mix are known exactly.

/// Moves of the right half, the left alike, in units of the figure (pupils 95 apart), y down. All 0 is the face at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Act {
    /// Inner end, middle and outer end of the brows down.
    pub brow_inner: f32,
    pub brow_middle: f32,
    pub brow_outer: f32,
    /// Inner ends of the brows toward the middle.
    pub brow_in: f32,
    /// Upper lid down, lower lid up.
    pub lid_upper: f32,
    pub lid_lower: f32,
    /// How far the eyes are closed by a blink, 0 to 1.
    pub closed: f32,
    /// Where the eyes look: to the right in the picture, and down.
    pub gaze_x: f32,
    pub gaze_y: f32,
    /// Cheeks up.
    pub cheek: f32,
    /// Wings of the nose up.
    pub sneer: f32,
    /// Corners of the mouth outward and down.
    pub corner_out: f32,
    pub corner_down: f32,
    /// The upper lip down in its middle, and up beside it.
    pub upper: f32,
    pub bare: f32,
    /// The lower lip down.
    pub lower: f32,
    /// The jaw down.
    pub jaw: f32,
    /// How thin the lips are pressed, 0 to 1.
    pub press: f32,
    /// The lips forward.
    pub pout: f32,
    /// Folds, 0 to 1: from nose to mouth, between the brows, across the forehead, on the nose.
    pub crease: f32,
    pub frown: f32,
    pub forehead: f32,
    pub wrinkle: f32,
}

const COUNT: usize = 23;

impl Act {
    /// The seven in canonical order: neutral, happy, anger, disgust, sadness, fear, surprised.
    #[rustfmt::skip]
    pub const SEVEN: [Act; 7] = [
        Act::from([0.0; COUNT]),
        // Brows: inner, middle, outer, in; lids: upper, lower, closed; gaze; cheek, sneer; mouth: corners out, down, upper, bare,
        // lower, jaw, press, pout; folds: crease, frown, forehead, wrinkle. Large enough, and different enough, that points that
        // are off by 2 % of the pupils' distance tell the mix within 0.06.
        Act::from([-1.0, -0.5, 0.0, 0.5, 1.6, 3.4, 0.0, 0.0, 0.0, 8.0, 1.8, 9.0, -13.0, -6.0, 0.0, 5.5, 5.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        Act::from([6.0, 5.5, -2.5, 8.0, -0.9, 2.8, 0.0, 0.0, 0.0, 0.5, 1.8, -5.5, 0.5, 1.0, 0.0, 1.2, 0.0, 0.6, 0.0, 0.3, 1.0, 0.0, 0.2]),
        Act::from([5.0, 6.2, 4.6, 1.8, 1.8, 3.6, 0.0, 0.0, 0.0, 5.0, 10.5, 4.0, 7.5, -9.0, 5.0, 1.8, 0.5, 0.0, 0.0, 1.0, 0.4, 0.0, 1.0]),
        Act::from([-12.0, -0.5, 6.0, 3.5, 4.3, 0.4, 0.0, 0.0, 2.4, 0.5, 0.3, -6.2, 7.0, -3.0, 0.0, -1.8, 0.3, 0.0, 1.0, 0.4, 0.4, 0.5, 0.0]),
        Act::from([-11.0, -7.5, -2.2, 6.0, -4.7, 1.6, 0.0, 0.0, 0.0, 0.4, 0.3, 12.5, 6.6, -0.4, 0.0, 9.0, 6.5, 0.0, 0.0, 0.2, 0.4, 0.8, 0.0]),
        Act::from([-6.0, -12.5, -12.0, -1.5, -3.9, -1.1, 0.0, 0.0, 0.0, 0.4, 0.3, -10.5, 6.0, -2.5, 0.0, 3.5, 22.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0]),
    ];

    const fn from(a: [f32; COUNT]) -> Act {
        let [
            brow_inner,
            brow_middle,
            brow_outer,
            brow_in,
            lid_upper,
            lid_lower,
            closed,
            gaze_x,
            gaze_y,
            cheek,
            sneer,
            ..,
        ] = a;
        let [.., corner_out, corner_down, upper, bare, lower, jaw, press, pout, crease, frown, forehead, wrinkle] = a;
        Act {
            brow_inner,
            brow_middle,
            brow_outer,
            brow_in,
            lid_upper,
            lid_lower,
            closed,
            gaze_x,
            gaze_y,
            cheek,
            sneer,
            corner_out,
            corner_down,
            upper,
            bare,
            lower,
            jaw,
            press,
            pout,
            crease,
            frown,
            forehead,
            wrinkle,
        }
    }

    fn numbers(&self) -> [f32; COUNT] {
        [
            self.brow_inner,
            self.brow_middle,
            self.brow_outer,
            self.brow_in,
            self.lid_upper,
            self.lid_lower,
            self.closed,
            self.gaze_x,
            self.gaze_y,
            self.cheek,
            self.sneer,
            self.corner_out,
            self.corner_down,
            self.upper,
            self.bare,
            self.lower,
            self.jaw,
            self.press,
            self.pout,
            self.crease,
            self.frown,
            self.forehead,
            self.wrinkle,
        ]
    }

    /// The mix of the seven by their ratios.
    pub fn mixed(ratios: &[f64; 7]) -> Act {
        let mut sum = [0.0f32; COUNT];
        for (ratio, act) in ratios.iter().zip(&Act::SEVEN) {
            for (s, n) in sum.iter_mut().zip(act.numbers()) {
                *s += *ratio as f32 * n;
            }
        }
        Act::from(sum)
    }
}
