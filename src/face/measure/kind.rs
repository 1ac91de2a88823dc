//! Bald, shaved, or hair: told from the cap of the head above the hairline.

use super::colours::median;
use super::frame::Lab;
use super::mask::{area_of, centre, per_cell};
use super::segment::Regions;
use super::shape::Shape;
use crate::face::HairKind;
use crate::photo::Mask;

/// Hair that covers more than this many square units is not shaved (recipe part 6).
const SHAVED_AREA: f64 = 15_000.0;

/// What kind of hair the mask is, as far as a photo tells; `head` is the silhouette, `skin` the cheeks' colour.
///
/// Skin shows through hair that is small on the head and nearly as light as the cheeks. It is stubble where much of
/// the cap is darker than the forehead or greyer than light or shade make the forehead's skin; else the head is bald.
/// A bare scalp shines: lights on it are lighter than the forehead and as much greyer as white is mixed in.
pub(super) fn kind(regions: &Regions, shape: &Shape, head: &Mask, mask: &Mask, skin: Lab) -> HairKind {
    let colours = |mask: &Mask| -> Vec<Lab> { mask.indices().map(|c| regions.lab[c]).collect() };
    let cap = per_cell(|c| head.pixels()[c] && regions.from_face[c] > 4.0 && centre(c).y < shape.ear_top - 4.0);
    let scalp = colours(&cap);
    let Some(tone) = median(&scalp) else { return HairKind::Bald };
    let through = tone[0] / skin[0].max(0.05) > 0.79;
    // Fair hair is as light as skin too, but yellower.
    let yellow = tone[2] / tone[0].max(0.05) > skin[2] / skin[0].max(0.05) + 0.004;
    if area_of(mask) < 0.1 * area_of(&cap) {
        return HairKind::Bald;
    }
    if area_of(mask) > SHAVED_AREA || !through || yellow {
        return HairKind::Straight;
    }
    let forehead = per_cell(|c| {
        (-25.0..-4.0).contains(&regions.from_face[c]) && centre(c).y < shape.brows - 8.0 && regions.skin()[c] > 0.5
    });
    let forehead = median(&colours(&forehead)).unwrap_or(skin);
    let chroma = |c: Lab| c[1].hypot(c[2]);
    let lit = |light: f32| {
        let share =
            if light > forehead[0] { (1.0 - light).max(0.0) / (1.0 - forehead[0]) } else { light / forehead[0] };
        chroma(forehead) * share
    };
    // Of a photo without colour only lightness tells.
    let coloured = chroma(forehead) > 0.015;
    let share = |test: &dyn Fn(Lab) -> bool| scalp.iter().filter(|c| test(**c)).count() as f64 / scalp.len() as f64;
    let grey = share(&|c| coloured && chroma(c) < 0.6 * lit(c[0]));
    let dark = share(&|c| c[0] < 0.9 * forehead[0]);
    // Bare heads show 0.3 together, stubble 0.58 and more.
    if grey + dark < 0.42 { HairKind::Bald } else { HairKind::Shaved }
}
