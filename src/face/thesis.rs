//! Feature points from the thesis's regions (thesis algs. 4.2 to 4.5, sec. 4.3.2): what its chapter 3 finds in a photo
//! becomes the 47 points that every face has, and the 25 of hair.
//!
//! Where nothing is found, points lie where they do in the middle of the faces of the Face Research Lab London Set
//! (DeBruine and Jones 2017, CC BY 4.0), but for the chin, whose rule the thesis gives.

use super::{FeaturePoint as P, How, Placed};
use crate::geometry::{Point, Vec2};
use crate::photo::{Ear, Feature, Located, Mask, Stages};

/// How far a point can be trusted that was found as the thesis finds it: half of them are off by more than a seventh
/// of the pupil distance.
const FOUND: f64 = 0.5;
/// The same for a point that a rule makes of found ones.
const RULE: f64 = 0.4;
/// The same where nothing was found and a rule speaks alone.
const GUESS: f64 = 0.1;

/// The 47 points of a photo's stages, in pixels of the photo that was given. None where the eyes were not found.
///
/// Left points are found; right ones mirror them (brows and eyes about the line between the eyeballs, the mouth about
/// its own cut). What cannot be found is placed where it lies in most faces, and says so by its confidence.
#[must_use]
pub fn points(stages: &Stages) -> Option<[Placed; P::FIXED]> {
    let located = stages.located.as_ref()?;
    let mut set = Set { points: [None; P::FIXED], stages };
    brows(&mut set, located);
    eyes(&mut set, located);
    nose(&mut set, located);
    mouth(&mut set, located);
    face(&mut set, located);
    ears(&mut set, located);
    let points = set.points;
    // Every point has been set above; were one forgotten, there would be no face rather than a wrong one.
    points.iter().all(Option::is_some).then(|| points.map(|p| p.unwrap_or(UNSET)))
}

const UNSET: Placed = Placed { at: Point::ORIGIN, confidence: 0.0, how: How::Rule };

/// Points as they are found, in pixels of the photo that was given.
struct Set<'a> {
    points: [Option<Placed>; P::FIXED],
    stages: &'a Stages,
}

impl Set<'_> {
    fn put(&mut self, point: P, at: Point, how: How, confidence: f64) {
        self.points[point.index()] = Some(Placed { at: self.stages.to_photo(at), confidence, how });
    }

    fn found(&mut self, point: P, at: Point) {
        self.put(point, at, How::Found, FOUND);
    }

    fn ruled(&mut self, point: P, at: Point) {
        self.put(point, at, How::Rule, RULE);
    }

    /// Found where it was, else by rule.
    fn found_or(&mut self, point: P, found: Option<Point>, rule: Point) {
        match found {
            Some(at) => self.found(point, at),
            None => self.put(point, rule, How::Rule, GUESS),
        }
    }

    /// A point as it was set, in pixels of the stages.
    fn at(&self, point: P) -> Point {
        self.points[point.index()].map_or(Point::ORIGIN, |p| self.stages.to_working(p.at))
    }

    /// Mirrors points that are set to the other side of the line between the eyeballs.
    fn mirrored(&mut self, located: &Located, left: &[P]) {
        for point in left {
            self.ruled(point.mirror(), located.eyes.mirror(self.at(*point)));
        }
    }
}

/// The value *w* of algs. 4.2 to 4.5: how many columns or rows at a region's end are averaged. The thesis gives none;
/// a hundredth of the face's width smooths single pixels and no more.
fn ends(located: &Located) -> usize {
    ((0.02 * located.eyes.distance()).round() as usize).max(1)
}

/// The mean place of pixels.
fn mean(pixels: impl Iterator<Item = (usize, usize)>) -> Option<Point> {
    let (mut sum, mut count) = (Vec2::ZERO, 0.0);
    for (x, y) in pixels {
        sum += Vec2::new(x as f64, y as f64);
        count += 1.0;
    }
    (count > 0.0).then(|| (sum / count).to_point())
}

/// The mean place of a feature's pixels in the columns from `from` up to, not including, `to`.
fn columns(feature: &Feature, from: usize, to: usize) -> Option<Point> {
    mean(feature.pixels.iter().copied().filter(|(x, _)| (from..to).contains(x)))
}

/// Alg. 4.2.
fn brows(set: &mut Set<'_>, located: &Located) {
    let (brow, w) = (&located.features.brow, ends(located));
    let b = brow.bounds;
    let (inner_from, outer_to) = (b.x1.saturating_sub(w), b.x0 + w);
    let middle = (outer_to + inner_from) / 2;
    // Step 4: the middles of all columns, averaged.
    let part = |from: usize, to: usize| {
        let centres = (from..to).filter_map(|x| {
            let ys = || brow.pixels.iter().filter(move |p| p.0 == x).map(|p| p.1);
            Some(Vec2::new(x as f64, (ys().min()? + ys().max()?) as f64 / 2.0))
        });
        let (sum, count) = centres.fold((Vec2::ZERO, 0.0), |(sum, n), c| (sum + c, n + 1.0));
        (count > 0.0).then(|| (sum / count).to_point())
    };
    let along = |share: f64| Point::new(b.x0 as f64 + share * b.width() as f64, b.centre().y);
    set.found_or(P::P4_6, columns(brow, b.x0, outer_to), along(0.0));
    set.found_or(P::P4_2, columns(brow, inner_from, b.x1), along(1.0));
    set.found_or(P::P4_4, part(middle, inner_from), along(0.7));
    set.found_or(P::P4_4A, part(outer_to, middle), along(0.3));
    set.mirrored(located, &[P::P4_6, P::P4_4A, P::P4_4, P::P4_2]);
}

/// Alg. 4.3.
fn eyes(set: &mut Set<'_>, located: &Located) {
    let (eye, ball, w) = (&located.features.eye, located.eyes.left, ends(located));
    let b = eye.bounds;
    let side = |share: f64| Point::new(b.x0 as f64 + share * b.width() as f64, ball.centre.y);
    set.found_or(P::P3_12, columns(eye, b.x0, b.x0 + w), side(0.0));
    set.found_or(P::P3_8, columns(eye, b.x1.saturating_sub(w), b.x1), side(1.0));
    set.ruled(P::P3_2, ball.centre - Vec2::new(0.0, ball.height() / 2.0));
    set.ruled(P::P3_4, ball.centre + Vec2::new(0.0, ball.height() / 2.0));
    set.mirrored(located, &[P::P3_12, P::P3_8, P::P3_2, P::P3_4]);
    set.found(P::P3_6, ball.centre);
    set.found(P::P3_5, located.eyes.right.centre);
}

/// Alg. 4.4.
fn nose(set: &mut Set<'_>, located: &Located) {
    let b = located.features.nose.bounds;
    let (x1, y1, x2, y2) = (b.x0 as f64, b.y0 as f64, (b.x1 - 1) as f64, (b.y1 - 1) as f64);
    let (left, right, middle) = (set.at(P::P3_8).x, set.at(P::P3_11).x, located.eyes.middle().y);
    set.ruled(P::P9_6, Point::new(left + (right - left) / 3.0, middle));
    set.ruled(P::P9_7, Point::new(right - (right - left) / 3.0, middle));
    let eighth = (x2 - x1) / 8.0;
    let wings = (y1 + 3.0 * y2) / 4.0;
    set.found(P::P9_14, Point::new(x1 + eighth, y1));
    set.found(P::P9_13, Point::new(x2 - eighth, y1));
    set.found(P::P9_2, Point::new(x1, wings));
    set.found(P::P9_1, Point::new(x2, wings));
    set.found(P::P9_4, Point::new(x1 + eighth, y2));
    set.found(P::P9_5, Point::new(x2 - eighth, y2));
    set.found(P::P9_15, Point::new(located.nose_cut.x as f64, y2));
}

/// Alg. 4.5.
fn mouth(set: &mut Set<'_>, located: &Located) {
    let (mouth, w, cut) = (&located.features.mouth, ends(located), located.mouth_cut.x);
    let (b, x) = (mouth.bounds, cut as f64);
    set.found_or(P::P8_4, columns(mouth, b.x0, b.x0 + w), Point::new(b.x0 as f64, b.centre().y));
    let corner = set.at(P::P8_4);
    let left_top = mouth.pixels.iter().filter(|p| p.0 < cut).map(|p| p.1).min();
    let peak = left_top.and_then(|top| mean(mouth.pixels.iter().copied().filter(|p| p.0 < cut && p.1 < top + w)));
    set.found_or(P::P8_9, peak, Point::new(x - b.width() as f64 / 8.0, b.y0 as f64));
    // Step 5 averages along the cut from the region's top to the height of the corner.
    let upper = mouth.pixels.iter().copied().filter(|p| p.0 == cut && (p.1 as f64) < corner.y);
    set.found_or(P::P8_1, mean(upper), Point::new(x, set.at(P::P8_9).y));
    set.ruled(P::P2_2, Point::new(x, corner.y));
    set.ruled(P::P2_3, Point::new(x, corner.y));
    set.found(P::P8_2, Point::new(x, (b.y1 - 1) as f64));
    let across = |p: Point| Point::new(2.0 * x - p.x, p.y);
    set.ruled(P::P8_10, across(set.at(P::P8_9)));
    set.ruled(P::P8_3, across(corner));
}

/// Sec. 4.3.2 A, 1 to 5.
fn face(set: &mut Set<'_>, located: &Located) {
    let (face, d, middle) = (&set.stages.refined.face, located.eyes.distance(), located.eyes.middle());
    let cheeks = &located.cheeks;
    let inside = |x: f64, y: f64| face.is_set(x.round() as isize, y.round() as isize);

    // A chin farther than a pupil distance below the lip is no chin: the walk has gone down the neck.
    let lip = set.at(P::P8_2);
    let chin = (1..=d as usize).map(|k| lip.y + k as f64).find(|y| !inside(lip.x, *y));
    set.found_or(P::P2_1, chin.map(|y| Point::new(lip.x, y)), lip + Vec2::new(0.0, 0.7 * d));

    let start = set.at(P::P8_9);
    let jaw = (0..d as usize).map(|k| start.y + k as f64).find_map(|y| {
        let side = |step: f64, end: f64| {
            let mut x = start.x;
            while inside(x, y) && (end - x) * step > 0.0 {
                x += step;
            }
            // Reaching the cheek's boundary means that this row is still cheek.
            ((end - x) * step > 0.0 && (x - start.x).abs() > 0.3 * d).then_some(Point::new(x, y))
        };
        Some((side(-1.0, cheeks.left as f64)?, side(1.0, cheeks.right as f64)?))
    });
    // A jaw is a sixth narrower at the mouth than the cheeks.
    let narrow = |x: usize| Point::new(middle.x + 0.83 * (x as f64 - middle.x), start.y);
    set.found_or(P::P2_14, jaw.map(|j| j.0), narrow(cheeks.left));
    set.found_or(P::P2_13, jaw.map(|j| j.1), narrow(cheeks.right));

    for (temple, jaw, out) in [(P::P11_2, P::P2_14, -1.0), (P::P11_3, P::P2_13, 1.0)] {
        let (x, y) = (set.at(jaw).x, middle.y + d / 2.0);
        let walk = (0..(2.0 * d) as usize).map(|k| y - k as f64);
        // The walk starts in the face and ends where the sideburn or the wall begins.
        let end = walk.skip_while(|y| !inside(x, *y)).find(|y| !inside(x, *y));
        let corner = end.and_then(|y| hairline_corner(face, located, y, out));
        set.found_or(temple, corner, Point::new(middle.x + 0.87 * out * d, middle.y - 0.9 * d));
    }

    let top = top_of(face, located);
    set.found_or(P::P11_1, top, middle - Vec2::new(0.0, 1.19 * d));
}

/// The corner of the hairline, where forehead meets temple: of the face's outline above the end of the walk from the
/// jaw, and above the brows, the place farthest up and out at once. `out` is the side, −1 at the image's left.
fn hairline_corner(face: &Mask, located: &Located, walk: f64, out: f64) -> Option<Point> {
    let middle = located.eyes.middle();
    let from = walk.min(located.edges.divisions.brow_eye);
    let rows = (0..located.eyes.distance() as usize).map(|k| from - k as f64);
    let outline = rows.filter_map(|y| {
        let columns = (0..(1.3 * located.eyes.distance()) as usize).map(|k| middle.x + out * k as f64);
        let last = columns.take_while(|x| face.is_set(x.round() as isize, y.round() as isize)).last()?;
        Some(Point::new(last, y))
    });
    outline.max_by(|a, b| {
        let reach = |p: &Point| out * (p.x - middle.x) - p.y;
        reach(a).total_cmp(&reach(b))
    })
}

/// The mean place of the topmost rows of the face's region, of what hangs together upward from the brows between the
/// eyeballs: strands of hair have the face's hue too.
fn top_of(face: &Mask, located: &Located) -> Option<Point> {
    let (from, to) = (located.eyes.left.centre.x as isize, located.eyes.right.centre.x as isize);
    let start = located.edges.divisions.brow_eye as isize;
    let tops: Vec<(isize, isize)> = (from..=to)
        .filter(|x| face.is_set(*x, start))
        .map(|x| (x, (0..=start).rev().take_while(|y| face.is_set(x, *y)).last().unwrap_or(start)))
        .collect();
    let top = tops.iter().map(|(_, y)| *y).min()?;
    let rows = top..top + ends(located) as isize;
    mean(tops.iter().flat_map(|(x, y)| (*y..rows.end).map(move |row| (*x as usize, row as usize))))
}

/// Sec. 4.3.2 A, 6: the outermost, the topmost and the lowest of the ears' pixels.
fn ears(set: &mut Set<'_>, located: &Located) {
    let (w, d, eye_line) = (ends(located), located.eyes.distance(), located.eyes.middle().y);
    let sides = [
        (&located.cheeks.ears[0], located.cheeks.left as f64, -1.0, [P::P10_2, P::P10_4, P::P10_6]),
        (&located.cheeks.ears[1], located.cheeks.right as f64, 1.0, [P::P10_1, P::P10_3, P::P10_5]),
    ];
    for (ear, cheek, out, [top, outermost, lobe]) in sides {
        let of = |pick: &dyn Fn(&Ear, (usize, usize)) -> bool| {
            let ear = ear.as_ref()?;
            mean(ear.pixels.iter().copied().filter(|p| pick(ear, *p)))
        };
        let at = |x: f64, y: f64| Point::new(cheek + out * x * d, eye_line + y * d);
        set.found_or(top, of(&|e, p| p.1 < e.bounds.y0 + w), at(0.14, 0.01));
        let outer = |e: &Ear, p: (usize, usize)| {
            if out < 0.0 { p.0 < e.bounds.x0 + w } else { p.0 + w >= e.bounds.x1 }
        };
        set.found_or(outermost, of(&outer), at(0.18, 0.23));
        set.found_or(lobe, of(&|e, p| p.1 + w >= e.bounds.y1), at(0.0, 0.77));
    }
}
