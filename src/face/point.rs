//! The 72 feature points: MPEG-4's names, what each marks, and which mirrors which (thesis sec. 4.2.3).

use std::fmt;

/// One of the 72 feature points. Names are MPEG-4's; `a` marks a second point of the same number. Left and right are
/// the image's, as in the thesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FeaturePoint(u8);

/// Where a feature point belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// Eight points.
    Brows,
    /// Ten points.
    Eyes,
    /// Nine points.
    Nose,
    /// Eight points.
    Mouth,
    /// Chin, jaw, temples, forehead: six points.
    Face,
    /// Six points.
    Ears,
    /// 25 points round the hair, none on a bald head.
    Hair,
}

macro_rules! points {
    ($($constant:ident $name:literal $mirror:ident $part:ident $what:literal;)*) => {
        #[allow(missing_docs)]
        impl FeaturePoint {
            $(#[doc = concat!("`", $name, "`: ", $what, ".")] pub const $constant: Self = Self(Index::$constant as u8);)*
        }
        #[allow(non_camel_case_types)]
        enum Index { $($constant,)* }
        /// Name, mirror image, part and meaning of the points that every face has.
        const TABLE: [(&str, FeaturePoint, Part, &str); FeaturePoint::FIXED] =
            [$(($name, FeaturePoint::$mirror, Part::$part, $what),)*];
    };
}

points! {
    P4_6 "4.6" P4_5 Brows "outer end of the left brow";
    P4_4A "4.4a" P4_3A Brows "outer middle of the left brow";
    P4_4 "4.4" P4_3 Brows "inner middle of the left brow";
    P4_2 "4.2" P4_1 Brows "inner end of the left brow";
    P4_1 "4.1" P4_2 Brows "inner end of the right brow";
    P4_3 "4.3" P4_4 Brows "inner middle of the right brow";
    P4_3A "4.3a" P4_4A Brows "outer middle of the right brow";
    P4_5 "4.5" P4_6 Brows "outer end of the right brow";
    P3_12 "3.12" P3_7 Eyes "outer corner of the left eye";
    P3_8 "3.8" P3_11 Eyes "inner corner of the left eye";
    P3_2 "3.2" P3_1 Eyes "upper lid of the left eye";
    P3_4 "3.4" P3_3 Eyes "lower lid of the left eye";
    P3_6 "3.6" P3_5 Eyes "middle of the left eyeball";
    P3_11 "3.11" P3_8 Eyes "inner corner of the right eye";
    P3_7 "3.7" P3_12 Eyes "outer corner of the right eye";
    P3_1 "3.1" P3_2 Eyes "upper lid of the right eye";
    P3_3 "3.3" P3_4 Eyes "lower lid of the right eye";
    P3_5 "3.5" P3_6 Eyes "middle of the right eyeball";
    P9_6 "9.6" P9_7 Nose "left side of the bridge";
    P9_7 "9.7" P9_6 Nose "right side of the bridge";
    P9_14 "9.14" P9_13 Nose "top of the left wing of the nose";
    P9_13 "9.13" P9_14 Nose "top of the right wing of the nose";
    P9_2 "9.2" P9_1 Nose "left wing of the nose";
    P9_1 "9.1" P9_2 Nose "right wing of the nose";
    P9_4 "9.4" P9_5 Nose "left end of the nose's base";
    P9_5 "9.5" P9_4 Nose "right end of the nose's base";
    P9_15 "9.15" P9_15 Nose "middle of the nose's base";
    P8_4 "8.4" P8_3 Mouth "left corner of the mouth";
    P8_3 "8.3" P8_4 Mouth "right corner of the mouth";
    P8_9 "8.9" P8_10 Mouth "left peak of the upper lip";
    P8_10 "8.10" P8_9 Mouth "right peak of the upper lip";
    P8_1 "8.1" P8_1 Mouth "middle of the upper lip's edge";
    P2_2 "2.2" P2_2 Mouth "inner edge of the upper lip";
    P2_3 "2.3" P2_3 Mouth "inner edge of the lower lip";
    P8_2 "8.2" P8_2 Mouth "bottom of the lower lip";
    P2_1 "2.1" P2_1 Face "chin";
    P2_14 "2.14" P2_13 Face "left jaw at the height of the mouth";
    P2_13 "2.13" P2_14 Face "right jaw at the height of the mouth";
    P11_2 "11.2" P11_3 Face "left temple, at the corner of the hairline";
    P11_1 "11.1" P11_1 Face "top middle of the forehead";
    P11_3 "11.3" P11_2 Face "right temple, at the corner of the hairline";
    P10_2 "10.2" P10_1 Ears "top of the left ear";
    P10_4 "10.4" P10_3 Ears "outermost point of the left ear";
    P10_6 "10.6" P10_5 Ears "lobe of the left ear";
    P10_1 "10.1" P10_2 Ears "top of the right ear";
    P10_3 "10.3" P10_4 Ears "outermost point of the right ear";
    P10_5 "10.5" P10_6 Ears "lobe of the right ear";
}

impl FeaturePoint {
    /// Points of the model.
    pub(crate) const COUNT: usize = 72;
    /// Points that every face has: all but the hair's.
    pub const FIXED: usize = 47;
    /// Points round the hair.
    pub const HAIR: usize = Self::COUNT - Self::FIXED;

    /// All 72, in the order of the model.
    pub fn all() -> impl DoubleEndedIterator<Item = Self> + ExactSizeIterator {
        (0..Self::COUNT as u8).map(Self)
    }

    /// The points that every face has.
    pub fn fixed() -> impl DoubleEndedIterator<Item = Self> + ExactSizeIterator {
        (0..Self::FIXED as u8).map(Self)
    }

    /// `h.1` to `h.25`, counted from 0: clockwise from the lowest hair at the left over the top to the lowest at the
    /// right and back along the hairline.
    ///
    /// # Panics
    /// When `n` is 25 or more.
    #[must_use]
    pub(crate) const fn hair(n: usize) -> Self {
        assert!(n < Self::HAIR, "there are 25 points of hair");
        Self((Self::FIXED + n) as u8)
    }

    /// Its place in the model, 0 to 71.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// Its place among the points of hair; none where it is none of them.
    #[must_use]
    pub(crate) fn hair_index(self) -> Option<usize> {
        self.index().checked_sub(Self::FIXED)
    }

    /// Its name: `8.4`, `4.4a`, `h.17`.
    #[must_use]
    pub fn name(self) -> String {
        match self.hair_index() {
            Some(n) => format!("h.{}", n + 1),
            None => TABLE[self.index()].0.to_owned(),
        }
    }

    /// The point of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name.strip_prefix("h.") {
            Some(n) => n.parse().ok().filter(|n| (1..=Self::HAIR).contains(n)).map(|n: usize| Self::hair(n - 1)),
            None => TABLE.iter().position(|row| row.0 == name).map(|i| Self(i as u8)),
        }
    }

    /// The point at the other side of the face; itself in the middle, and for hair, whose two sides differ.
    #[must_use]
    pub fn mirror(self) -> Self {
        TABLE.get(self.index()).map_or(self, |row| row.1)
    }

    /// The part of the face that it belongs to.
    #[must_use]
    pub fn part(self) -> Part {
        TABLE.get(self.index()).map_or(Part::Hair, |row| row.2)
    }

    /// What it marks, in words.
    #[must_use]
    pub(crate) fn meaning(self) -> &'static str {
        TABLE.get(self.index()).map_or("edge of the hair", |row| row.3)
    }
}

impl fmt::Display for FeaturePoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_72_points_with_names_of_their_own_and_mirrors_that_mirror_back() {
        let names: std::collections::BTreeSet<String> = FeaturePoint::all().map(FeaturePoint::name).collect();
        assert_eq!(names.len(), 72);
        for point in FeaturePoint::all() {
            assert_eq!(FeaturePoint::named(&point.name()), Some(point));
            assert_eq!(point.mirror().mirror(), point);
            assert_eq!(point.mirror().part(), point.part());
        }
        let count = |part| FeaturePoint::all().filter(|p| p.part() == part).count();
        use Part::*;
        assert_eq!([Brows, Eyes, Nose, Mouth, Face, Ears, Hair].map(count), [8, 10, 9, 8, 6, 6, 25]);
    }
}
