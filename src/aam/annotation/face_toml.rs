//! Our own `face.toml`, read as points: the 47 that every face has, then the 25 of its hair where it has some.

use super::Annotation;
use crate::disk::Result;
use crate::face::{Face, FeaturePoint};

pub(super) fn parse(text: &str) -> Result<Annotation> {
    let face = Face::parse(text)?;
    let points = FeaturePoint::all().filter_map(|p| face.placed(p)).map(|p| p.at).collect();
    Ok(Annotation::of_points(points))
}
