//! What changes from frame to frame: a moving picture as a first picture and the rectangles that are laid over it.

use std::ops::Range;

use super::FormFault;
use super::stream::{Frames, Outcome, Watch};
use crate::disk::{Fault, Result};

/// A rectangle of whole pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Area {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl Area {
    pub(crate) const fn whole(size: [u32; 2]) -> Self {
        Self { x: 0, y: 0, width: size[0], height: size[1] }
    }

    /// Of columns and rows, as far as the picture goes.
    pub(crate) fn of((columns, rows): (Range<u32>, Range<u32>), size: [u32; 2]) -> Self {
        let (x, y) = (columns.start.min(size[0]), rows.start.min(size[1]));
        let (right, bottom) = (columns.end.clamp(x, size[0]), rows.end.clamp(y, size[1]));
        Self { x, y, width: right - x, height: bottom - y }
    }

    /// The smallest area that holds both.
    pub(crate) fn union(self, other: Self) -> Self {
        let (x, y) = (self.x.min(other.x), self.y.min(other.y));
        let right = (self.x + self.width).max(other.x + other.width);
        let bottom = (self.y + self.height).max(other.y + other.height);
        Self { x, y, width: right - x, height: bottom - y }
    }

    /// Where its rows lie in a picture of this width with `depth` bytes a pixel.
    pub(crate) fn rows(self, width: u32, depth: usize) -> impl Iterator<Item = Range<usize>> {
        let (width, length) = (width as usize * depth, self.width as usize * depth);
        (self.y..self.y + self.height).map(move |y| {
            let start = y as usize * width + self.x as usize * depth;
            start..start + length
        })
    }
}

/// The smallest area outside which two pictures of `depth` bytes a pixel are equal, where they are known to be equal outside
/// `within`; none where they are equal.
pub(crate) fn changed(old: &[u8], new: &[u8], width: u32, depth: usize, within: Area) -> Option<Area> {
    let mut box_of: Option<(u32, u32, usize, usize)> = None;
    for (y, row) in (within.y..).zip(within.rows(width, depth)) {
        let (a, b) = (&old[row.clone()], &new[row]);
        if a == b {
            continue;
        }
        let (top, _, left, right) = box_of.unwrap_or((y, y, a.len(), 0));
        // Only what lies outside the columns that are known can still move them.
        let first = a[..left].iter().zip(&b[..left]).position(|(a, b)| a != b).unwrap_or(left);
        let last = a[right..].iter().zip(&b[right..]).rposition(|(a, b)| a != b).map_or(right, |at| right + at + 1);
        box_of = Some((top, y, first, last));
    }
    let (top, bottom, left, right) = box_of?;
    let (left, right) = ((left / depth) as u32, right.div_ceil(depth) as u32);
    Some(Area { x: within.x + left, y: top, width: right - left, height: bottom + 1 - top })
}

/// One rectangle and how long it is the newest one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cel {
    /// The first frame that shows it.
    pub(crate) from: u32,
    /// The first that does not.
    pub(crate) until: u32,
    /// What has changed.
    pub(crate) area: Area,
}

/// Goes through the frames and hands each cel on with the whole picture it belongs to (straight RGBA). `soonest` says
/// when the next cel may begin after one that began at a frame: formats have times too short for them.
pub(crate) fn each(
    frames: &mut dyn Frames,
    watch: &Watch<'_>,
    soonest: impl Fn(u32) -> u32,
    mut write: impl FnMut(Cel, &[u8]) -> Result<()>,
) -> Result<Outcome> {
    let (size, count) = (frames.size(), frames.count());
    if count == 0 || size[0] == 0 || size[1] == 0 {
        return Err(Fault::of(FormFault::NoFrames, "there are no frames to be shown")
            .help("give the clip a recording, times or keys"));
    }
    frames.show(0)?;
    let mut shown = pixels(frames, size)?.to_vec();
    let mut cel = Cel { from: 0, until: count, area: Area::whole(size) };
    (watch.progress)(1);
    for n in 1..count {
        if watch.is_stopped() {
            return Ok(Outcome::Stopped);
        }
        let within = Area::of(frames.show(n)?, size);
        let next = pixels(frames, size)?;
        if let Some(area) = changed(&shown, next, size[0], 4, within) {
            if n < soonest(cel.from) {
                // Too short to be shown: the newer picture takes its place.
                cel.area = cel.area.union(area);
            } else {
                write(Cel { until: n, ..cel }, &shown)?;
                cel = Cel { from: n, until: count, area };
            }
            for row in area.rows(size[0], 4) {
                shown[row.clone()].copy_from_slice(&next[row]);
            }
        }
        (watch.progress)(n + 1);
    }
    write(cel, &shown)?;
    Ok(Outcome::Written(0))
}

/// The pixels of the frame that is shown, which must have the size that was said.
pub(crate) fn pixels(frames: &dyn Frames, size: [u32; 2]) -> Result<&[u8]> {
    let picture = frames.picture();
    let length = size[0] as usize * size[1] as usize * 4;
    let bytes = picture.pixels().as_flattened();
    if bytes.len() == length { Ok(bytes) } else { Err(Fault::new("a frame has another size than the others")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_changed_area_is_the_smallest(points in prop::collection::vec((0_u32..9, 0_u32..7), 0..5)) {
            let size = [9, 7];
            let old = vec![5_u8; 9 * 7 * 4];
            let mut new = old.clone();
            for (x, y) in &points {
                new[(y * 9 + x) as usize * 4 + (x + y) as usize % 4] = 6;
            }
            let expected = points.iter().map(|(x, y)| Area { x: *x, y: *y, width: 1, height: 1 }).reduce(Area::union);
            prop_assert_eq!(changed(&old, &new, 9, 4, Area::whole(size)), expected);
            if let Some(area) = expected {
                prop_assert_eq!(changed(&old, &new, 9, 4, area), expected);
                let wider = Area { x: 0, width: area.x + area.width, ..area };
                prop_assert_eq!(changed(&old, &new, 9, 4, wider), expected);
            }
        }
    }
}
