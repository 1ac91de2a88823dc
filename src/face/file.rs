//! `face.toml`: a face as a person can read, diff and correct it.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde::Deserialize;

use super::point_row::{MAX_COORDINATE, PointRow};
use super::{Beard, Colours, Face, FeaturePoint, Hair, HairKind, Measures, PhotoRecord, Placed};
use crate::disk::{Fault, FileFault, Result, Task, from_toml, message, nearest};
use crate::drawing::Colour;
use crate::geometry::Point;

/// The only `format` there is.
const FORMAT: u32 = 1;
/// The most vertices of an outline of hair.
const MAX_VERTICES: usize = 2_000;
/// The most outlines of hair.
const MAX_OUTLINES: usize = 64;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileTable {
    format: u32,
    points: BTreeMap<String, PointRow>,
    colours: ColoursTable,
    measures: MeasuresTable,
    hair: HairTable,
    photo: PhotoTable,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ColoursTable {
    skin: Colour,
    hair: Colour,
    lips: Colour,
    iris: Colour,
    brows: Colour,
    beard: Colour,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MeasuresTable {
    jaw: [f64; 2],
    brow_height: f64,
    neck: f64,
    beard: BeardTable,
    ears: [f64; 2],
    head_top: f64,
    #[serde(default)]
    glasses: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BeardTable {
    chin: f64,
    jaw: f64,
    cheek: f64,
    lip: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HairTable {
    #[serde(default)]
    kind: HairKind,
    #[serde(default)]
    vertices: Vec<usize>,
    #[serde(default)]
    front: Vec<Vec<[f64; 2]>>,
    #[serde(default)]
    back: Vec<Vec<[f64; 2]>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PhotoTable {
    sha256: String,
    size: [u32; 2],
}

/// The text of a file, for the line of a key in it.
struct AtLine<'a>(&'a str);

impl AtLine<'_> {
    /// A fault with the line that begins with `key`, where there is one.
    fn line(&self, fault: Fault, key: &str) -> Fault {
        match self.0.lines().position(|l| l.trim_start().starts_with(key)) {
            Some(line) => fault.line(line + 1),
            None => fault,
        }
    }
}

impl FileTable {
    /// The points by their names: all that are not of the hair, and all of the hair or none.
    fn placed(&self, at: &AtLine<'_>) -> Result<BTreeMap<FeaturePoint, Placed>> {
        let names: Vec<String> = FeaturePoint::all().map(FeaturePoint::name).collect();
        let mut placed: BTreeMap<FeaturePoint, Placed> = BTreeMap::new();
        for (name, row) in &self.points {
            let key = format!("\"{name}\"");
            let Some(point) = FeaturePoint::named(name) else {
                let known: Vec<&str> = names.iter().map(String::as_str).collect();
                let near = nearest(name, &known).map(|n| format!("did you mean \"{n}\"? ")).unwrap_or_default();
                let what = format!("there is no feature point \"{name}\"");
                return Err(at
                    .line(Fault::of(FileFault::Unknown, what), &key)
                    .help(format!("{near}the 72 are 4.6, 4.4a … 10.5 and h.1 to h.25")));
            };
            placed.insert(point, row.placed(name).map_err(|fault| at.line(fault, &key))?);
        }
        let missing = |points: &mut dyn Iterator<Item = FeaturePoint>| {
            points.filter(|p| !placed.contains_key(p)).map(FeaturePoint::name).collect::<Vec<_>>()
        };
        let lost = missing(&mut FeaturePoint::fixed());
        if !lost.is_empty() {
            return Err(Fault::of(FileFault::Missing, format!("[points] lacks {}", lost.join(", "))).help(message![
                "put them back, or move face.toml aside: ",
                Task::FindFace,
                " writes it anew"
            ]));
        }
        let hairless = missing(&mut (0..FeaturePoint::HAIR).map(FeaturePoint::hair));
        if !hairless.is_empty() && hairless.len() != FeaturePoint::HAIR {
            return Err(Fault::of(FileFault::Missing, format!("[points] lacks {}", hairless.join(", ")))
                .help("hair has 25 points, or none where the head is bald"));
        }
        Ok(placed)
    }
}

impl HairTable {
    fn read(self, points: Option<[Placed; FeaturePoint::HAIR]>, at: &AtLine<'_>) -> Result<Hair> {
        let outlines = |lists: &[Vec<[f64; 2]>], key: &str| -> Result<Vec<Vec<Point>>> {
            let fits = lists.len() <= MAX_OUTLINES
                && lists.iter().all(|l| (3..=MAX_VERTICES).contains(&l.len()))
                && lists.iter().flatten().flatten().all(|v| v.abs() <= MAX_COORDINATE);
            if !fits {
                let what = format!("the outlines `{key}` of the hair cannot be");
                return Err(at.line(Fault::of(FileFault::OutOfRange, what), key).help(format!(
                    "at most {MAX_OUTLINES} outlines of 3 to {MAX_VERTICES} vertices, in pixels of the photo"
                )));
            }
            Ok(lists.iter().map(|l| l.iter().map(|[x, y]| Point::new(*x, *y)).collect()).collect())
        };
        let front = outlines(&self.front, "front")?;
        let back = outlines(&self.back, "back")?;
        let vertices = self.vertices;
        let along = front.first().map_or(0, Vec::len);
        if !vertices.is_empty()
            && (vertices.len() != FeaturePoint::HAIR || vertices.iter().any(|v| *v >= along) || points.is_none())
        {
            return Err(at
                .line(Fault::new("`vertices` of the hair does not fit its outline"), "vertices")
                .help("it has one place in the first outline of `front` for each of h.1 to h.25; or leave it out"));
        }
        Ok(Hair { kind: self.kind, points, front, vertices, back })
    }
}

impl Face {
    /// Reads the text of a `face.toml`.
    ///
    /// # Errors
    /// When it is damaged, a point is missing or unknown, or a number cannot be; names the line where it is known.
    pub fn parse(text: &str) -> Result<Self> {
        let table: FileTable = from_toml(text)?;
        if table.format != FORMAT {
            return Err(Fault::of(FileFault::Version, format!("format {} is not known to this version", table.format))
                .help(format!("this version reads format {FORMAT}")));
        }
        let at = AtLine(text);
        let placed = table.placed(&at)?;
        let points = std::array::from_fn(|i| placed[&FeaturePoint::all().nth(i).expect("below 72")]);
        let measures = measures(&table.measures).map_err(|wrong| {
            let (fault, what) = *wrong;
            at.line(fault, what)
        })?;
        let hair_points = placed
            .contains_key(&FeaturePoint::hair(0))
            .then(|| std::array::from_fn(|n| placed[&FeaturePoint::hair(n)]));
        let hair = table.hair.read(hair_points, &at)?;
        let (photo, c) = (table.photo, table.colours);
        if photo.sha256.len() != 64 || !photo.sha256.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Err(at.line(Fault::new("`sha256` is not 64 hexadecimal digits"), "sha256").help(message![
                "move face.toml aside: ",
                Task::FindFace,
                " writes it anew"
            ]));
        }
        Ok(Self {
            points,
            colours: Colours { skin: c.skin, hair: c.hair, lips: c.lips, iris: c.iris, brows: c.brows, beard: c.beard },
            measures,
            hair,
            photo: PhotoRecord { sha256: photo.sha256, size: photo.size },
        })
    }

    /// The text of the `face.toml`.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut out = format!("format = {FORMAT}\n\n[points]\n");
        for point in FeaturePoint::all() {
            let Some(placed) = self.placed(point) else { continue };
            out.push_str(&PointRow::line(&point.name(), placed, 1));
        }
        let c = &self.colours;
        let _ = write!(
            out,
            "\n[colours]\nskin = \"{}\"\nhair = \"{}\"\nlips = \"{}\"\niris = \"{}\"\nbrows = \"{}\"\nbeard = \"{}\"\n",
            c.skin, c.hair, c.lips, c.iris, c.brows, c.beard
        );
        let m = &self.measures;
        let _ = write!(
            out,
            "\n[measures]\njaw = [{:.3}, {:.3}]\nbrow_height = {:.4}\nneck = {:.3}\n\
             beard = {{ chin = {:.3}, jaw = {:.3}, cheek = {:.3}, lip = {:.3} }}\n\
             ears = [{:.2}, {:.2}]\nhead_top = {:.1}\nglasses = {:.2}\n",
            m.jaw[0],
            m.jaw[1],
            m.brow_height,
            m.neck,
            m.beard.chin,
            m.beard.jaw,
            m.beard.cheek,
            m.beard.lip,
            m.ears[0],
            m.ears[1],
            m.head_top,
            m.glasses
        );
        let kind = match self.hair.kind {
            HairKind::Straight => "straight",
            HairKind::Wavy => "wavy",
            HairKind::Curly => "curly",
            HairKind::Shaved => "shaved",
            HairKind::Bald => "bald",
        };
        let _ = writeln!(out, "\n[hair]\nkind = \"{kind}\"");
        if !self.hair.vertices.is_empty() {
            let _ = writeln!(out, "vertices = {:?}", self.hair.vertices);
        }
        for (name, outlines) in [("front", &self.hair.front), ("back", &self.hair.back)] {
            let lists: Vec<String> = outlines
                .iter()
                .map(|o| {
                    let pairs: Vec<String> = o.iter().map(|p| format!("[{:.1}, {:.1}]", p.x, p.y)).collect();
                    format!("[{}]", pairs.join(", "))
                })
                .collect();
            if !lists.is_empty() {
                let _ = writeln!(out, "{name} = [\n  {},\n]", lists.join(",\n  "));
            }
        }
        let _ = write!(
            out,
            "\n[photo]\nsha256 = \"{}\"\nsize = [{}, {}]\n",
            self.photo.sha256, self.photo.size[0], self.photo.size[1]
        );
        // Not "-0.0": two runs whose zeros differ in sign write the same bytes.
        out.replace("-0.0,", "0.0,").replace("-0.0]", "0.0]")
    }
}

/// Checks the measures; a fault comes with the key that it is about.
fn measures(table: &MeasuresTable) -> Result<Measures, Box<(Fault, &'static str)>> {
    let within = |value: f64, low: f64, high: f64, key: &'static str| {
        if (low..=high).contains(&value) {
            Ok(value)
        } else {
            let fault = Fault::new(format!("`{key}` of the face is {value}"));
            Err(Box::new((fault.help(format!("write a number from {low} to {high}")), key)))
        }
    };
    Ok(Measures {
        jaw: [within(table.jaw[0], 0.0, 2.0, "jaw")?, within(table.jaw[1], 0.0, 2.0, "jaw")?],
        brow_height: within(table.brow_height, 0.0, 1.0, "brow_height")?,
        neck: within(table.neck, 0.2, 2.0, "neck")?,
        beard: Beard {
            chin: within(table.beard.chin, -1.0, 1.0, "beard")?,
            jaw: within(table.beard.jaw, -1.0, 1.0, "beard")?,
            cheek: within(table.beard.cheek, -1.0, 1.0, "beard")?,
            lip: within(table.beard.lip, -1.0, 1.0, "beard")?,
        },
        ears: [within(table.ears[0], 0.0, 1.0, "ears")?, within(table.ears[1], 0.0, 1.0, "ears")?],
        head_top: within(table.head_top, -MAX_COORDINATE, MAX_COORDINATE, "head_top")?,
        glasses: within(table.glasses, 0.0, 1.0, "glasses")?,
    })
}
