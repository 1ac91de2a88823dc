//! Pixels as video has them: one brightness a pixel and one colour for four, ITU-R BT.709, brightness 16 to 235.
//!
//! We convert, and not the encoder's program: what arrives is then the same whatever its version, only what has changed
//! needs converting, and two fifths of the bytes have to pass through the pipe.

use crate::forms::cels::Area;

/// Parts of one in the whole-number arithmetic below.
const ONE: i32 = 1 << 16;

/// A picture in planes: brightness, the two of colour at half the size, and where wanted alpha.
pub(super) struct Planes {
    /// Pixels across and down, of the brightness.
    size: [u32; 2],
    /// Of the pixels that come in; where video needs even sides, the last row or column is shown twice.
    inner: [u32; 2],
    /// All planes, one after another, as a video frame has them.
    pub(super) bytes: Vec<u8>,
}

impl Planes {
    /// For pictures of a size; `even` makes odd sides longer by one, `alpha` adds a plane.
    pub(super) fn new(inner: [u32; 2], even: bool, alpha: bool) -> Self {
        let size = inner.map(|side| if even { side.next_multiple_of(2) } else { side });
        let [width, height] = size.map(|v| v as usize);
        let colour = width.div_ceil(2) * height.div_ceil(2);
        let bytes = vec![0; width * height * (1 + usize::from(alpha)) + 2 * colour];
        Self { size, inner, bytes }
    }

    /// Pixels across and down.
    pub(super) const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Takes over what has changed of a picture, straight RGBA. Without a plane for alpha it is laid on black.
    pub(super) fn take(&mut self, rgba: &[u8], area: Area) {
        let [width, height] = self.size.map(|v| v as usize);
        let [inner_width, inner_height] = self.inner.map(|v| v as usize);
        let (y_plane, rest) = self.bytes.split_at_mut(width * height);
        let colour = width.div_ceil(2);
        let (u_plane, rest) = rest.split_at_mut(colour * height.div_ceil(2));
        let (v_plane, alpha) = rest.split_at_mut(colour * height.div_ceil(2));
        // Whole groups of four; at the border the last pixel stands in for those outside.
        let (left, top) = (area.x as usize / 2, area.y as usize / 2);
        let right = ((area.x + area.width) as usize).div_ceil(2);
        let bottom = ((area.y + area.height) as usize).div_ceil(2);
        for cy in top..bottom {
            let rows =
                [2 * cy, 2 * cy + 1].map(|y| &rgba[y.min(inner_height - 1) * inner_width * 4..][..inner_width * 4]);
            for cx in left..right {
                let mut sums = [0_i32; 4];
                for (dy, row) in rows.iter().enumerate() {
                    for dx in 0..2 {
                        let (x, y) = (2 * cx + dx, 2 * cy + dy);
                        let at = x.min(inner_width - 1) * 4;
                        let straight = [row[at], row[at + 1], row[at + 2], row[at + 3]].map(i32::from);
                        let [r, g, b, a] = if alpha.is_empty() { on_black(straight) } else { straight };
                        sums[0] += r * a;
                        sums[1] += g * a;
                        sums[2] += b * a;
                        sums[3] += a;
                        if x < width && y < height {
                            y_plane[y * width + x] = brightness(r, g, b);
                            if !alpha.is_empty() {
                                alpha[y * width + x] = a as u8;
                            }
                        }
                    }
                }
                // What cannot be seen does not colour its neighbours.
                let all = sums[3].max(1);
                let [r, g, b] = [sums[0], sums[1], sums[2]].map(|s| (s + all / 2) / all);
                let (u, v) = if sums[3] == 0 { (128, 128) } else { colours(r, g, b) };
                u_plane[cy * colour + cx] = u;
                v_plane[cy * colour + cx] = v;
            }
        }
    }
}

/// What a colour with alpha looks like on black, opaque.
fn on_black([r, g, b, a]: [i32; 4]) -> [i32; 4] {
    if a == 255 {
        return [r, g, b, a];
    }
    let [r, g, b] = [r, g, b].map(|v| (v * a + 127) / 255);
    [r, g, b, 255]
}

/// `16 + 219 (0.2126 R + 0.7152 G + 0.0722 B)`, R, G, B of 0 to 1 as encoded (ITU-R BT.709, table 3).
fn brightness(r: i32, g: i32, b: i32) -> u8 {
    ((16 * ONE + 11_966 * r + 40_254 * g + 4_064 * b + ONE / 2) >> 16) as u8
}

/// `128 + 224 (B − Y) / 1.8556` and `128 + 224 (R − Y) / 1.5748` (the same).
fn colours(r: i32, g: i32, b: i32) -> (u8, u8) {
    let u = (128 * ONE - 6_596 * r - 22_188 * g + 28_784 * b + ONE / 2) >> 16;
    let v = (128 * ONE + 28_784 * r - 26_145 * g - 2_639 * b + ONE / 2) >> 16;
    (u as u8, v as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(rgba: [u8; 4], size: [u32; 2]) -> Planes {
        let mut planes = Planes::new(size, true, true);
        planes.take(&rgba.repeat((size[0] * size[1]) as usize), Area::whole(size));
        planes
    }

    #[test]
    fn the_corners_of_the_colours_are_those_of_the_standard() {
        for (rgb, expected) in [
            ([0, 0, 0], [16, 128, 128]),
            ([255; 3], [235, 128, 128]),
            ([255, 0, 0], [63, 102, 240]),
            ([0, 255, 0], [173, 42, 26]),
            ([0, 0, 255], [32, 240, 118]),
            ([128; 3], [126, 128, 128]),
        ] {
            let planes = of([rgb[0], rgb[1], rgb[2], 255], [2, 2]);
            let found = [planes.bytes[0], planes.bytes[4], planes.bytes[5]];
            assert_eq!(found, expected, "{rgb:?}");
        }
    }

    #[test]
    fn without_a_plane_for_alpha_a_picture_lies_on_black() {
        let of = |rgba: &[u8]| {
            let mut planes = Planes::new([2, 2], true, false);
            planes.take(rgba, Area::whole([2, 2]));
            planes.bytes
        };
        // What cannot be seen has a colour nevertheless.
        for unseen in [[255, 255, 255, 0], [255, 0, 0, 0], [0, 0, 255, 1], [255, 255, 255, 1]] {
            let found = of(&unseen.repeat(4));
            assert!(found[..4].iter().all(|y| (16..=17).contains(y)), "{unseen:?}: {found:?}");
            assert!(found[4..].iter().all(|c| c.abs_diff(128) <= 1), "{unseen:?}: {found:?}");
        }
        assert_eq!(of(&[255, 255, 255, 128].repeat(4)), of(&[128, 128, 128, 255].repeat(4)));
        // Half of the group is there: its colour counts half.
        let half = [[255, 0, 0, 255], [0, 0, 255, 0]].concat().repeat(2);
        let opaque = [[255, 0, 0, 255], [0, 0, 0, 255]].concat().repeat(2);
        assert_eq!(of(&half), of(&opaque));
    }

    #[test]
    fn odd_sides_show_their_last_pixels_twice() {
        let planes = of([255, 255, 255, 7], [3, 5]);
        assert_eq!(planes.size(), [4, 6]);
        assert!(planes.bytes[..24].iter().all(|y| *y == 235));
        assert!(planes.bytes[24..36].iter().all(|c| *c == 128));
        assert!(planes.bytes[36..].iter().all(|a| *a == 7));
    }

    #[test]
    fn a_part_taken_over_gives_what_the_whole_gives() {
        let size = [13, 11];
        let noise = |seed: u32| -> Vec<u8> {
            (0..size[0] * size[1] * 4).map(|i| ((i + seed).wrapping_mul(2_654_435_761) >> 13) as u8).collect()
        };
        let old = noise(1);
        let area = Area { x: 3, y: 5, width: 6, height: 4 };
        let (mut new, other) = (old.clone(), noise(77));
        for row in area.rows(size[0], 4) {
            new[row.clone()].copy_from_slice(&other[row]);
        }
        for even in [false, true] {
            let mut whole = Planes::new(size, even, true);
            whole.take(&new, Area::whole(size));
            let mut part = Planes::new(size, even, true);
            part.take(&old, Area::whole(size));
            part.take(&new, area);
            assert!(whole.bytes == part.bytes, "even {even}");
        }
    }
}
