//! Whether a photo is fit for a face to be measured from it: its light, its background, glasses.

use super::colours::Cheeks;
use super::hair::Found;
use super::mask::{CELL, cells_in, per_cell};
use super::segment::Regions;
use super::shape::Shape;
use crate::photo::Mask;

/// What a check of a photo needs to know of it. Lightness is OKLab's, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fitness {
    /// How much lighter the cheek at the right of the photo is than the one at the left: −1 to 1. From about 0.1 on
    /// (either way) one half of the face lies in the shade.
    pub side_light: f64,
    /// The difference of hair and background beside it, as a distance in OKLab; below about 0.06 they are hard to tell
    /// apart. None on a bald head.
    pub hair_contrast: Option<f64>,
    /// The share of what lies around the head that is one smooth colour, 0 to 1. Below about 0.7 the background is
    /// busy.
    pub plain: f64,
    /// How likely the face wears glasses, 0 to 1.
    pub glasses: f64,
    /// The median lightness of the face.
    pub face_light: f64,
    /// The lightness of the lightest fiftieth of the face: whites of the eyes, lights on the skin. Below about 0.5 the
    /// photo is too dark, whatever the skin.
    pub highlights: f64,
    /// The share of the face in which a highlight has burnt out all colour, 0 to 1. Above about 0.03 the photo is too
    /// light.
    pub burnt: f64,
}

impl Fitness {
    pub(super) fn of(regions: &Regions, shape: &Shape, cheeks: &Cheeks, hair: &Found, glasses: f64) -> Self {
        let mut light: Vec<f32> = cells_in(&shape.face)
            .indices()
            .filter(|c| regions.inside[*c] && !hair.mask.pixels()[*c])
            .map(|c| regions.lab[c][0])
            .collect();
        light.sort_by(f32::total_cmp);
        let at = |share: f64| {
            let place = (light.len() as f64 * share) as usize;
            light.get(place.min(light.len().saturating_sub(1))).map_or(0.0, |v| f64::from(*v))
        };
        // White is 1; what a sensor could not hold lies within a step of it.
        let burnt = light.iter().filter(|v| **v > 0.985).count() as f64 / light.len().max(1) as f64;
        Self {
            side_light: f64::from(cheeks.light[1] - cheeks.light[0]),
            hair_contrast: hair_contrast(regions, &hair.mask),
            plain: regions.backdrop.plain,
            glasses,
            face_light: at(0.5),
            highlights: at(0.98),
            burnt,
        }
    }
}

/// How far the colours of hair are from the background's within 20 units of the hair's outer edge.
fn hair_contrast(regions: &Regions, hair: &Mask) -> Option<f64> {
    let behind = per_cell(|c| regions.inside[c] && regions.back()[c] > 0.5);
    let rim = behind.grown(20.0 / CELL).and(hair);
    let mut far: Vec<f64> = rim
        .indices()
        .map(|c| {
            let (is, wall) = (regions.lab[c], regions.backdrop.colour(c));
            f64::from((0..3).map(|k| (is[k] - wall[k]).powi(2)).sum::<f32>().sqrt())
        })
        .collect();
    far.sort_by(f64::total_cmp);
    (far.len() >= 30).then(|| far[far.len() / 2])
}
