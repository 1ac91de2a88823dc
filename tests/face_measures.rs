//! What is measured of a face besides its points, on the 72 people of the London set: colours, hair, jaw, glasses.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

mod test_data;

use std::path::{Path, PathBuf};

use lianpu::drawing::Colour;
use lianpu::face::measure::{Measured, measure};
use lianpu::face::{FeaturePoint as P, HairKind, Part, Points, to_face_frame};
use lianpu::geometry::{Affine, CubicBez, ParamCurve, ParamCurveNearest, Point, Vec2};
use lianpu::photo::Photo;
use rayon::prelude::*;

/// One person: the photo, the set's own 189 points, and our 47.
struct Person {
    id: String,
    photo: Photo,
    raw: Vec<Point>,
    points: Points,
}

/// The people of the London set; none where the data is missing.
fn people() -> Vec<Person> {
    let Some(folder) = test_data::find("faces/london") else { return Vec::new() };
    let mut ids: Vec<String> = std::fs::read_dir(&folder)
        .unwrap()
        .flatten()
        .filter_map(|e| e.file_name().to_str()?.strip_suffix("_neutral.pts").map(str::to_owned))
        .collect();
    ids.sort();
    assert_eq!(ids.len(), 72);
    ids.into_par_iter().map(|id| person(&folder, id)).collect()
}

fn person(folder: &Path, id: String) -> Person {
    let file = |end: &str| -> PathBuf { folder.join(format!("{id}_neutral.{end}")) };
    let text = std::fs::read_to_string(file("pts")).unwrap();
    let inner = text.split('{').nth(1).unwrap().split('}').next().unwrap();
    let raw: Vec<Point> = inner
        .trim()
        .lines()
        .map(|line| {
            let v: Vec<f64> = line.split_whitespace().map(|v| v.parse().unwrap()).collect();
            Point::new(v[0], v[1])
        })
        .collect();
    let table = std::fs::read_to_string(folder.join("points72.csv")).unwrap();
    let mut points = Points([Point::ZERO; P::FIXED]);
    for row in table.lines().skip(1) {
        let mut cells = row.split(',');
        let point = P::named(cells.next().unwrap()).unwrap();
        let of: Vec<usize> = cells.next().unwrap().split_whitespace().map(|v| v.parse().unwrap()).collect();
        let sum = of.iter().fold(Vec2::ZERO, |s, i| s + raw[*i].to_vec2());
        points[point] = (sum / of.len() as f64).to_point();
    }
    // The set has neither the bridge nor the tops of the wings: by rule, in the face frame.
    let frame = to_face_frame(points[P::P3_6], points[P::P3_5]);
    let at = |p: P| frame * points[p];
    let bridge = (at(P::P3_11).x - at(P::P3_8).x) / 3.0;
    let up = -0.2 * at(P::P9_15).y;
    let ruled = [
        (P::P9_6, Point::new(at(P::P3_8).x + bridge, 0.0)),
        (P::P9_7, Point::new(at(P::P3_11).x - bridge, 0.0)),
        (P::P9_14, at(P::P9_2) + Vec2::new(3.0, up)),
        (P::P9_13, at(P::P9_1) + Vec2::new(-3.0, up)),
    ];
    for (point, place) in ruled {
        points[point] = frame.inverse() * place;
    }
    Person { photo: Photo::read(&file("jpg")).unwrap(), id, raw, points }
}

/// The points with errors as a machine makes them: 2.5 % of the pupil distance inside, 5 % at contour and ears.
fn jittered(points: &Points, id: &str) -> Points {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64 ^ id.bytes().fold(7, |s, b| s * 131 + u64::from(b));
    let mut uniform = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let distance = points[P::P3_6].distance(points[P::P3_5]);
    let mut moved = *points;
    for point in P::fixed() {
        let share = if matches!(point.part(), Part::Face | Part::Ears) { 0.05 } else { 0.025 };
        let radius = (-2.0 * uniform().max(1e-12).ln()).sqrt() * share * distance / 2.0_f64.sqrt();
        moved[point] += Vec2::from_angle(uniform() * std::f64::consts::TAU) * radius;
    }
    moved
}

/// CIELAB of a colour under D65.
fn cielab(colour: Colour) -> [f64; 3] {
    let [r, g, b] = [colour.r, colour.g, colour.b].map(|v| {
        let v = f64::from(v) / 255.0;
        if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    });
    let x = (0.412_456_4 * r + 0.357_576_1 * g + 0.180_437_5 * b) / 0.950_47;
    let y = 0.212_672_9 * r + 0.715_152_2 * g + 0.072_175 * b;
    let z = (0.019_333_9 * r + 0.119_192 * g + 0.950_304_1 * b) / 1.088_83;
    let [x, y, z] = [x, y, z].map(|t| if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The colour difference CIEDE2000 (Sharma, Wu, Dalal 2005).
fn delta_e(one: [f64; 3], two: [f64; 3]) -> f64 {
    let [l1, a1, b1] = one;
    let [l2, a2, b2] = two;
    let mean_c = (a1.hypot(b1) + a2.hypot(b2)) / 2.0;
    let seventh = |c: f64| (c.powi(7) / (c.powi(7) + 25.0_f64.powi(7))).sqrt();
    let g = 0.5 * (1.0 - seventh(mean_c));
    let (a1, a2) = (a1 * (1.0 + g), a2 * (1.0 + g));
    let (c1, c2) = (a1.hypot(b1), a2.hypot(b2));
    let hue = |a: f64, b: f64| if a == 0.0 && b == 0.0 { 0.0 } else { b.atan2(a).to_degrees().rem_euclid(360.0) };
    let (h1, h2) = (hue(a1, b1), hue(a2, b2));
    let mut dh = h2 - h1;
    if c1 * c2 == 0.0 {
        dh = 0.0;
    } else if dh > 180.0 {
        dh -= 360.0;
    } else if dh < -180.0 {
        dh += 360.0;
    }
    let (dl, dc) = (l2 - l1, c2 - c1);
    let big_h = 2.0 * (c1 * c2).sqrt() * (dh / 2.0).to_radians().sin();
    let (ml, mc) = ((l1 + l2) / 2.0, (c1 + c2) / 2.0);
    let mh = if c1 * c2 == 0.0 {
        h1 + h2
    } else if (h1 - h2).abs() <= 180.0 {
        (h1 + h2) / 2.0
    } else if h1 + h2 < 360.0 {
        (h1 + h2 + 360.0) / 2.0
    } else {
        (h1 + h2 - 360.0) / 2.0
    };
    let cos = |d: f64| d.to_radians().cos();
    let t =
        1.0 - 0.17 * cos(mh - 30.0) + 0.24 * cos(2.0 * mh) + 0.32 * cos(3.0 * mh + 6.0) - 0.20 * cos(4.0 * mh - 63.0);
    let turn = 60.0 * (-((mh - 275.0) / 25.0).powi(2)).exp();
    let sl = 1.0 + 0.015 * (ml - 50.0).powi(2) / (20.0 + (ml - 50.0).powi(2)).sqrt();
    let (sc, sh) = (1.0 + 0.045 * mc, 1.0 + 0.015 * mc * t);
    let rt = -2.0 * seventh(mc) * turn.to_radians().sin();
    let (l, c, h) = (dl / sl, dc / sc, big_h / sh);
    (l * l + c * c + h * h + rt * c * h).sqrt()
}

#[test]
fn the_colour_difference_is_that_of_the_published_pairs() {
    // Sharma, Wu, Dalal 2005, table 1, pairs 1, 7, 17, 25.
    for (one, two, is) in [
        ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
        ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
        ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
        ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
    ] {
        assert!((delta_e(one, two) - is).abs() < 1e-4, "{one:?} {two:?}: {}", delta_e(one, two));
    }
}

/// The median of each channel inside polygons of pixels.
fn median_inside(photo: &Photo, polygons: &[Vec<Point>], mut keep: impl FnMut(Colour) -> bool) -> Option<Colour> {
    let mut channels: [Vec<u8>; 3] = Default::default();
    for polygon in polygons {
        for y in 0..photo.height() as isize {
            for x in 0..photo.width() as isize {
                let p = Point::new(x as f64, y as f64);
                let next = polygon.iter().cycle().skip(1);
                let crossings = polygon.iter().zip(next).filter(|(a, b)| {
                    (a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
                });
                if crossings.count() % 2 == 1 && keep(photo.colour(x, y)) {
                    photo.at(x, y).into_iter().zip(&mut channels).for_each(|(v, c)| c.push(v));
                }
            }
        }
    }
    if channels[0].len() < 30 {
        return None;
    }
    let [r, g, b] = channels.map(|mut c| {
        c.sort_unstable();
        c[c.len() / 2]
    });
    Some(Colour::rgb(r, g, b))
}

/// What the set's own points say of the colours of skin, lower lip and hair.
fn reference(person: &Person) -> [Option<Colour>; 3] {
    let raw = &person.raw;
    let frame = to_face_frame(raw[0], raw[1]);
    let back = frame.inverse();
    let u = |i: usize| frame * raw[i];
    let place = |list: &[Point]| -> Vec<Point> { list.iter().map(|p| back * *p).collect() };
    // Cheeks: between the lower lid, the wing of the nose, the corner of the mouth and the face's edge.
    let cheek = |lid: usize, wing: usize, corner: usize, edge: usize| {
        let (lid, wing, corner, edge) = (u(lid), u(wing), u(corner), u(edge));
        place(&[
            lid + Vec2::new(0.0, 14.0),
            wing.lerp(edge, 0.25),
            corner.lerp(edge, 0.4) - Vec2::new(0.0, 8.0),
            edge.lerp(lid, 0.45),
        ])
    };
    // Forehead: the middle third between brows and hairline.
    let forehead =
        place(&[u(76).lerp(u(137), 0.35), u(77).lerp(u(141), 0.35), u(77).lerp(u(141), 0.7), u(76).lerp(u(137), 0.7)]);
    let cheeks = [cheek(29, 62, 87, 125), cheek(32, 68, 93, 133)];
    let median = |polygons: &[Vec<Point>]| median_inside(&person.photo, polygons, |_| true).unwrap();
    // A fringe over the forehead is no skin.
    let bare = delta_e(cielab(median(&cheeks)), cielab(median(std::slice::from_ref(&forehead)))) < 20.0;
    let skin = if bare { median(&[&cheeks[..], &[forehead]].concat()) } else { median(&cheeks) };
    let skin = Some(skin);
    // The lower lip: its own outline.
    let lip: Vec<Point> = [87, 99, 100, 101, 102, 103, 93, 108, 107, 106, 105, 104].iter().map(|i| raw[*i]).collect();
    let lips = median_inside(&person.photo, &[lip], |_| true);
    // Hair: a band 12 to 34 units over the hairline, without what is like the wall above it.
    let line: Vec<Point> = (136..=142).map(u).collect();
    let mut band: Vec<Point> = line.iter().map(|p| *p - Vec2::new(0.0, 12.0)).collect();
    band.extend(line.iter().rev().map(|p| Point::new(p.x * 1.05, p.y - 34.0)));
    let wall = cielab(
        median_inside(
            &person.photo,
            &[vec![Point::new(0.0, 0.0), Point::new(600.0, 0.0), Point::new(600.0, 20.0), Point::new(0.0, 20.0)]],
            |_| true,
        )
        .unwrap(),
    );
    let hair = median_inside(&person.photo, &[place(&band)], |c| delta_e(cielab(c), wall) > 12.0);
    [skin, lips, hair]
}

#[test]
fn colours() {
    let people = people();
    for jitter in [false, true] {
        let rows: Vec<(String, [Option<f64>; 3], HairKind)> = people
            .par_iter()
            .map(|person| {
                let points = if jitter { jittered(&person.points, &person.id) } else { person.points };
                let m = measure(&person.photo, &points);
                let [skin, lips, hair] = reference(person);
                let off = |c: Option<Colour>, is: Colour| c.map(|c| delta_e(cielab(c), cielab(is)));
                (
                    person.id.clone(),
                    [off(skin, m.colours.skin), off(lips, m.colours.lips), off(hair, m.colours.hair)],
                    m.hair.kind,
                )
            })
            .collect();
        for (k, name) in ["skin", "lips", "hair"].iter().enumerate() {
            let mut all: Vec<(f64, &str, HairKind)> =
                rows.iter().filter_map(|r| Some((r.1[k]?, r.0.as_str(), r.2))).collect();
            all.sort_by(|a, b| b.0.total_cmp(&a.0));
            let mean = all.iter().map(|a| a.0).sum::<f64>() / all.len() as f64;
            println!("jitter {jitter} {name}: mean {mean:.2} worst {:?}", &all[..10.min(all.len())]);
        }
    }
}
