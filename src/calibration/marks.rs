//! `happy.toml` and its like: the points of a calibration shot, as a person can read and correct them.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::calibration::Binding;
use crate::disk::{Fault, FileFault, Result, Task, from_toml, message};
use crate::face::{FeaturePoint, Placed, PointRow};

/// The only `format` there is.
const FORMAT: u32 = 1;

/// The points of a shot: our own 41, in the order of [`Binding::own_points`].
#[derive(Debug, Clone, PartialEq)]
pub struct Marks {
    /// The points.
    pub points: Vec<Placed>,
    /// The SHA-256 of the photo they are of.
    pub photo: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    format: u32,
    photo: String,
    points: BTreeMap<String, PointRow>,
}

impl Marks {
    /// The text of the file.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut out = format!("format = {FORMAT}\nphoto = \"{}\"\n\n[points]\n", self.photo);
        for (name, p) in Binding::own_points().zip(&self.points) {
            out.push_str(&PointRow::line(&name.name(), p, 2));
        }
        out
    }

    /// Reads the text of the file.
    ///
    /// # Errors
    /// When it is damaged, a point is missing or unknown, or a number cannot be, with the line.
    pub fn parse(text: &str) -> Result<Self> {
        let table: Table = from_toml(text)?;
        let line = |what: &str| text.lines().position(|l| l.trim_start().starts_with(what)).map_or(1, |l| l + 1);
        if table.format != FORMAT {
            return Err(Fault::of(FileFault::Version, format!("format {} is not known to this version", table.format))
                .line(line("format"))
                .help(format!("this version reads format {FORMAT}")));
        }
        if table.photo.len() != 64 || !table.photo.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Err(Fault::new("`photo` is not 64 hexadecimal digits").line(line("photo")).help(message![
                "move the file aside: ",
                Task::Calibrate,
                " writes it anew"
            ]));
        }
        let known: Vec<FeaturePoint> = Binding::own_points().collect();
        for (name, row) in &table.points {
            let key = format!("\"{name}\"");
            if !FeaturePoint::named(name).is_some_and(|p| known.contains(&p)) {
                return Err(Fault::of(FileFault::Unknown, format!("a shot has no point \"{name}\""))
                    .line(line(&key))
                    .help("a shot has the points of the face without ears and hair"));
            }
            row.placed(name).map_err(|fault| fault.line(line(&key)))?;
        }
        let mut points = Vec::with_capacity(known.len());
        for p in known {
            let row =
                table.points.get(&p.name()).ok_or_else(|| {
                    Fault::of(FileFault::Missing, format!("[points] lacks \"{p}\""))
                        .line(line("[points]"))
                        .help(message!["put it back, or move the file aside: ", Task::Calibrate, " writes it anew"])
                })?;
            points.push(row.placed(&p.name())?);
        }
        Ok(Self { points, photo: table.photo })
    }
}
