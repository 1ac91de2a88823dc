//! Where a figure stands before the camera, what lights it, and the picture that is being exposed.

use crate::vector::{V, smooth};

/// From the camera to the pupils of a figure at scale 1: about a metre and a half.
const AWAY: f32 = 2300.0;

/// The depth of the pupils, which are what the scale speaks of.
const FOCUS: f32 = 122.0;

/// A figure's place in the frame, in units of the 600 frame.
#[derive(Clone, Copy)]
pub struct Stand {
    pub x: f32,
    pub y: f32,
    pub scale: f32,
    /// Turned about the vertical, and in the plane of the picture, in radians.
    pub yaw: f32,
    pub roll: f32,
}

impl Stand {
    /// The ray through a place of the frame, in the figure's own space: where it starts and where it goes.
    pub fn ray(&self, x: f32, y: f32) -> (V, V) {
        let on = V((x - self.x) / self.scale, (y - self.y) / self.scale, 0.0).rolled(-self.roll);
        let eye = V(0.0, 0.0, FOCUS + AWAY);
        let to = (V(on.0, on.1, FOCUS) - eye).unit();
        (eye.yawed(-self.yaw), to.yawed(-self.yaw))
    }

    /// Where a point of the figure's space falls in the frame; z is its nearness to the camera.
    pub fn project(&self, p: V) -> V {
        let c = p.yawed(self.yaw);
        let k = AWAY / (AWAY + FOCUS - c.2);
        let on = V(c.0 * k, c.1 * k, 0.0).rolled(self.roll);
        V(self.x + on.0 * self.scale, self.y + on.1 * self.scale, c.2 * self.scale)
    }

    /// A direction of the room in the figure's own space.
    pub fn turned(&self, direction: V) -> V {
        direction.rolled(-self.roll).yawed(-self.yaw)
    }

    pub fn nearness(&self, p: V) -> f32 {
        p.yawed(self.yaw).2 * self.scale
    }
}

/// The lamps of the room. Directions point towards the lamp, in the room's space.
#[derive(Clone, Copy)]
pub struct Rig {
    pub key: V,
    pub key_power: f32,
    /// How sharp the key's shadows are: about the inverse of its angular radius.
    pub sharp: f32,
    pub fill: V,
    pub fill_power: f32,
    pub sky: f32,
}

impl Rig {
    /// Passport light: a large lamp in front, above and a little to the left, a weaker one from the right.
    pub fn soft() -> Rig {
        Rig {
            key: V(-0.34, -0.50, 0.80).unit(),
            key_power: 1.12,
            sharp: 4.5,
            fill: V(0.52, -0.12, 0.85).unit(),
            fill_power: 0.27,
            sky: 0.30,
        }
    }

    /// One small lamp from the side.
    pub fn side() -> Rig {
        Rig {
            key: V(-0.93, -0.22, 0.28).unit(),
            key_power: 1.75,
            sharp: 26.0,
            fill: V(0.5, 0.0, 0.85).unit(),
            fill_power: 0.015,
            sky: 0.045,
        }
    }
}

/// Linear RGB samples, [`Canvas::FINE`] to a pixel each way, row by row from the top, with their nearness.
pub struct Canvas {
    pub side: usize,
    pub colour: Vec<V>,
    pub near: Vec<f32>,
}

impl Canvas {
    pub const FINE: usize = 4;

    /// A plain grey wall, lit a little unevenly.
    pub fn wall(side: usize, rig: &Rig) -> Canvas {
        let wide = side * Canvas::FINE;
        let light = if rig.sky < 0.1 { 0.45 } else { 1.0 };
        let colour = (0..wide * wide)
            .map(|i| {
                let (x, y) = ((i % wide) as f32 / wide as f32, (i / wide) as f32 / wide as f32);
                let glow = smooth(0.95, 0.0, (x - 0.47).hypot((y - 0.36) * 0.9));
                let fall = 1.0 - 0.05 * smooth(0.3, 0.0, y) - 0.10 * smooth(0.5, 1.0, y) - 0.06 * smooth(0.4, 1.0, x);
                V(0.66, 0.675, 0.672) * ((0.74 + 0.31 * glow) * fall * light)
            })
            .collect();
        Canvas { side, colour, near: vec![f32::MIN; wide * wide] }
    }

    pub fn wide(&self) -> usize {
        self.side * Canvas::FINE
    }

    /// Samples per unit of the 600 frame.
    pub fn per_unit(&self) -> f32 {
        self.wide() as f32 / 600.0
    }
}
