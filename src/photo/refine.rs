//! The face's region and the hair's, from the two thresholds (thesis sec. 3.3.5).

use super::{Mask, Neighbours, Regions};

/// What is left of both levels once holes and the wall are sorted out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refined {
    /// F_final: the face regions and what they enclose (eq. 3.10).
    pub face: Mask,
    /// B₃: light and not face (eq. 3.11).
    pub light_ground: Mask,
    /// H_final: all but the light ground that reaches the image's border (eq. 3.12). Face and clothes lie in it: hair
    /// is what of it is not face.
    pub hair: Mask,
}

impl Refined {
    /// From B₁ (set where light) and B₂ (set where not face).
    #[must_use]
    pub(crate) fn of(light: &Mask, ground: &Mask) -> Self {
        let backgrounds = Regions::of(ground, Neighbours::Four);
        let enclosed = backgrounds.mask_of(|r| !backgrounds.at_border(r));
        let face = enclosed.with(ground, |enclosed, ground| *enclosed || !ground);
        let light_ground = light.with(ground, |light, ground| *light && *ground);
        let grounds = Regions::of(&light_ground, Neighbours::Four);
        let hair = grounds.mask_of(|r| grounds.at_border(r)).not();
        Self { face, light_ground, hair }
    }
}

#[cfg(test)]
mod tests {
    use super::super::regions::drawn;
    use super::*;

    #[test]
    fn holes_of_the_face_are_face_and_the_wall_is_not_hair() {
        // Hair (dark) over a face with two eyes (dark) before a light wall.
        let light = drawn(&["########", "##....##", "##.##.##", "##...###", "##.##.##", "########"]);
        let ground = drawn(&["########", "########", "##....##", "##.##.##", "##....##", "########"]);
        let refined = Refined::of(&light, &ground);
        assert_eq!(refined.face, drawn(&["........", "........", "..####..", "..####..", "..####..", "........"]));
        assert!(
            refined.hair.is_set(2, 1)
                && refined.hair.is_set(3, 3)
                && !refined.hair.is_set(0, 1)
                && !refined.hair.is_set(7, 5)
        );
        assert!(!refined.light_ground.is_set(3, 3 + 1) && refined.light_ground.is_set(0, 0));
    }
}
