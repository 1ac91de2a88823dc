//! The man before the camera: what stays from picture to picture is made once.

use crate::act::Act;
use crate::figure::{Exposure, Figure};
use crate::film::{Held, develop_held};
use crate::hair::{self, Strand};
use crate::head::Head;
use crate::marks::marks;
use crate::mass::Mass;
use crate::person::Person;
use crate::strand;
use crate::vector::V;
use crate::view::{Canvas, Rig, Stand};

/// The picture's margin, a share of its side: what comes into it when the head moves.
const MARGIN: f32 = 0.05;

/// Pupils 79 pixels apart in a frame of 320.
const STAND: Stand = Stand { x: 300.0, y: 272.0, scale: 1.40, yaw: 0.0, roll: 0.0 };

/// How the head is held: in the units of the figure, and degrees.
#[derive(Clone, Copy, Default)]
pub struct Pose {
    pub x: f32,
    pub y: f32,
    pub roll: f32,
}

pub struct Studio {
    side: usize,
    head: Head,
    mass: Mass,
    rig: Rig,
    brows: Vec<Strand>,
    wall: Canvas,
    hair: Canvas,
    rest: Exposure,
}

/// A picture and where the points of the face are in it, in pixels.
pub struct Taken {
    pub pixels: Vec<u8>,
    pub points: Vec<(&'static str, (f32, f32))>,
}

impl Studio {
    /// For pictures of `side` pixels.
    pub fn new(side: usize) -> Studio {
        let whole = (side as f32 * (1.0 + 2.0 * MARGIN)).round() as usize / 2 * 2;
        let rig = Rig::soft();
        let head = Head::new(Person::teacher());
        let scalp = hair::scalp(&head);
        let mass = Mass::of(&scalp, &head.skull);
        let wall = Canvas::wall(whole, &rig);
        let mut hair =
            Canvas { side: whole, colour: vec![V::ZERO; wall.colour.len()], near: vec![f32::MIN; wall.near.len()] };
        strand::expose(&scalp, &mass, &STAND, &rig, &mut hair);
        let rest = Figure::new(&head, &mass, STAND, rig).seen(&wall);
        let mut brows = Vec::new();
        hair::brows(&head, &mut brows);
        Studio { side, head, mass, rig, brows, wall, hair, rest }
    }

    /// Takes a picture of what the face does; `seed` is the grain's.
    pub fn take(&self, act: &Act, pose: Pose, seed: u64) -> Taken {
        let head = self.head.doing(*act);
        let mut canvas =
            Canvas { side: self.wall.side, colour: self.wall.colour.clone(), near: self.wall.near.clone() };
        Figure::new(&head, &self.mass, STAND, self.rig).seen_again(&canvas, &self.rest).put(&mut canvas);
        for (to, from) in
            canvas.colour.iter_mut().zip(&mut canvas.near).zip(self.hair.colour.iter().zip(&self.hair.near))
        {
            if *from.1 > *to.1 {
                (*to.0, *to.1) = (*from.0, *from.1);
            }
        }
        let strands = hair::moved(&head, &self.head, &self.brows);
        strand::expose(&strands, &self.mass, &STAND, &self.rig, &mut canvas);
        let per_unit = canvas.side as f32 / 600.0;
        let unit = per_unit * STAND.scale;
        let held = Held {
            pivot: (STAND.x * per_unit, STAND.y * per_unit + 190.0 * unit),
            fades: (STAND.y * per_unit + 212.0 * unit, STAND.y * per_unit + 300.0 * unit),
            roll: pose.roll.to_radians(),
            shift: (pose.x * unit, pose.y * unit),
        };
        let margin = (canvas.side - self.side) as f32 * 0.5;
        let on_picture = |p: V| {
            let at = STAND.project(p);
            let (x, y) = held.moved(at.0 * per_unit, at.1 * per_unit);
            // The middle of the first pixel is (0, 0).
            (x - margin - 0.5, y - margin - 0.5)
        };
        let points = marks(&head, &self.head).into_iter().map(|(name, p)| (name, on_picture(p))).collect();
        Taken { pixels: develop_held(&canvas, self.side, &held, seed), points }
    }
}
