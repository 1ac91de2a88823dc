//! Points and directions in space, and the few scalar functions that every other file of the portrait uses.
//!
//! Axes: x to the right in the picture, y down, z towards the viewer.

use std::ops::{Add, Mul, Neg, Sub};

/// A point, a direction, or linear red, green and blue.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct V(pub f32, pub f32, pub f32);

impl V {
    pub const ZERO: V = V(0.0, 0.0, 0.0);

    pub fn all(s: f32) -> V {
        V(s, s, s)
    }

    pub fn dot(self, o: V) -> f32 {
        self.0 * o.0 + self.1 * o.1 + self.2 * o.2
    }

    pub fn len(self) -> f32 {
        self.dot(self).sqrt()
    }

    /// The direction alone; a vector of no length stays as it is.
    pub fn unit(self) -> V {
        let l = self.len();
        if l > 1e-12 { self * (1.0 / l) } else { self }
    }

    /// Component by component: what a colour filter does to light.
    pub fn by(self, o: V) -> V {
        V(self.0 * o.0, self.1 * o.1, self.2 * o.2)
    }

    pub fn lerp(self, o: V, t: f32) -> V {
        self + (o - self) * t
    }

    /// Right and left made one: the figure is modelled on its right side.
    pub fn folded(self) -> V {
        V(self.0.abs(), self.1, self.2)
    }

    /// Turned by `angle` about the vertical axis.
    pub fn yawed(self, angle: f32) -> V {
        let (s, c) = angle.sin_cos();
        V(c * self.0 + s * self.2, self.1, c * self.2 - s * self.0)
    }

    /// Turned by `angle` in the plane of the picture.
    pub fn rolled(self, angle: f32) -> V {
        let (s, c) = angle.sin_cos();
        V(c * self.0 - s * self.1, s * self.0 + c * self.1, self.2)
    }
}

impl Add for V {
    type Output = V;
    fn add(self, o: V) -> V {
        V(self.0 + o.0, self.1 + o.1, self.2 + o.2)
    }
}

impl Sub for V {
    type Output = V;
    fn sub(self, o: V) -> V {
        V(self.0 - o.0, self.1 - o.1, self.2 - o.2)
    }
}

impl Mul<f32> for V {
    type Output = V;
    fn mul(self, s: f32) -> V {
        V(self.0 * s, self.1 * s, self.2 * s)
    }
}

impl Neg for V {
    type Output = V;
    fn neg(self) -> V {
        self * -1.0
    }
}

/// 0 at `a`, 1 at `b`, without a corner at either; `a` may be greater than `b`.
pub fn smooth(a: f32, b: f32, x: f32) -> f32 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// exp(−x²): a soft spot of width one.
pub fn spot(x: f32) -> f32 {
    if x * x > 12.0 { 0.0 } else { (-x * x).exp() }
}

pub fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// The union of two distances with a fillet of about `k` (the polynomial smooth minimum, quadratic form).
pub fn join(a: f32, b: f32, k: f32) -> f32 {
    let h = (k - (a - b).abs()).max(0.0);
    a.min(b) - h * h * 0.25 / k
}

/// `a` with `b` cut out of it, the edge rounded by about `k`.
pub fn carve(a: f32, b: f32, k: f32) -> f32 {
    -join(-a, b, k)
}

/// Distance to a segment whose radius goes from `ra` to `rb`.
pub fn limb(p: V, a: V, b: V, ra: f32, rb: f32) -> f32 {
    let (pa, ba) = (p - a, b - a);
    let t = (pa.dot(ba) / ba.dot(ba)).clamp(0.0, 1.0);
    (pa - ba * t).len() - mix(ra, rb, t)
}

/// Distance to an ellipsoid, exact on it and near enough around it: |p/r| (|p/r| − 1) / |p/r²|.
pub fn ball(p: V, centre: V, r: V) -> f32 {
    let q = p - centre;
    let a = V(q.0 / r.0, q.1 / r.1, q.2 / r.2);
    let b = V(a.0 / r.0, a.1 / r.1, a.2 / r.2);
    let (k, g) = (a.len(), b.len());
    if g < 1e-9 { -r.0.min(r.1).min(r.2) } else { k * (k - 1.0) / g }
}
