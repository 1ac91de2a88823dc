//! A style as a file: what an author copies and edits to have faces drawn another way.
//!
//! Every key but `format` may be left out; what is left out is as in the style `normal`.

use serde::de::{Deserialize, Deserializer, Error, Visitor};

use super::Chosen;
use crate::disk::{Fault, FileFault, Result, clean_line, from_toml, suggestion};
use crate::drawing::Colour;
use crate::face::HairKind;
use crate::face::rig::Proportions;

/// The version of the format that is read.
pub(crate) const STYLE_FORMAT: u32 = 1;

/// How a cartoon is drawn. Made of a file by [`Style::parse`], so its numbers are within their limits.
#[derive(Debug, Clone, PartialEq)]
pub struct Style {
    pub(super) title: String,
    pub(super) ink_only: bool,
    pub(super) ink: f64,
    pub(super) ground: bool,
    pub(super) disc: bool,
    pub(super) hair: Option<HairKind>,
    pub(super) hair_curve: HairCurve,
    pub(super) strands: f64,
    pub(super) beard: Choice,
    pub(super) glasses: Choice,
    pub(super) brows: BrowStyle,
    pub(super) nose: NoseStyle,
    pub(super) folds: f64,
    pub(super) jaw_round: f64,
    pub(super) proportions: Proportions,
    pub(super) colours: Chosen,
}

/// What an author may leave to the measured face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Choice {
    /// As the face was found.
    #[default]
    Auto,
    Yes,
    No,
}

/// How the outline of hair runs through its vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum HairCurve {
    /// Cubics, with sharp tips where hair has them.
    #[default]
    Tufts,
    /// Thesis alg. 4.1, depth 2: every corner cut.
    CornerCutting,
}

/// How brows are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum BrowStyle {
    /// A brush as full as they are.
    #[default]
    Brush,
    /// One cubic Bézier line (thesis fig. 7.8 b).
    Bezier,
}

/// How the nose is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum NoseStyle {
    /// By wings, nostrils and base.
    #[default]
    Modelled,
    /// In one stroke (thesis fig. 7.8 b).
    Line,
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: u32,
    #[serde(default)]
    title: Option<String>,
    #[serde(default)]
    ink_only: bool,
    #[serde(default = "one")]
    ink: f64,
    #[serde(default = "yes")]
    background: bool,
    #[serde(default = "yes")]
    disc: bool,
    #[serde(default)]
    hair: HairChoice,
    #[serde(default)]
    hair_curve: HairCurve,
    #[serde(default = "one")]
    strands: f64,
    #[serde(default)]
    beard: Choice,
    #[serde(default)]
    glasses: Choice,
    #[serde(default)]
    brows: BrowStyle,
    #[serde(default)]
    nose: NoseStyle,
    #[serde(default)]
    folds: f64,
    #[serde(default)]
    jaw_round: f64,
    #[serde(default)]
    shirt: Option<Colour>,
    #[serde(default)]
    proportions: Proportions,
    #[serde(default)]
    colours: Chosen,
}

fn one() -> f64 {
    1.0
}

fn yes() -> bool {
    true
}

/// `hair` in a file: `auto`, or a kind.
#[derive(Default, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
enum HairChoice {
    #[default]
    Auto,
    Straight,
    Wavy,
    Curly,
    Shaved,
    Bald,
}

impl Style {
    /// The styles that come with the program.
    pub const BUILT_IN: [&'static str; 4] = ["normal", "brows", "cute", "ink"];

    /// A style that comes with the program.
    ///
    /// # Errors
    /// When there is none of that name; says which there are.
    pub fn built_in(name: &str) -> Result<Self> {
        Self::parse(Self::built_in_text(name)?)
    }

    /// The file of a style that comes with the program, to copy and edit.
    ///
    /// # Errors
    /// When there is none of that name; says which there are.
    pub fn built_in_text(name: &str) -> Result<&'static str> {
        match name {
            "normal" => Ok(include_str!("styles/normal.toml")),
            "brows" => Ok(include_str!("styles/brows.toml")),
            "cute" => Ok(include_str!("styles/cute.toml")),
            "ink" => Ok(include_str!("styles/ink.toml")),
            _ => {
                let near = suggestion(name, "styles", &Self::BUILT_IN);
                Err(Fault::of(FileFault::Unknown, format!("there is no style `{name}`"))
                    .help(format!("{near}, or a file styles/NAME.toml")))
            }
        }
    }

    /// Reads the text of a style.
    ///
    /// # Errors
    /// When a key or word is unknown, or a number beyond its limits; names the line.
    pub fn parse(text: &str) -> Result<Self> {
        let file: File = from_toml(text)?;
        let line_of = |key: &str| {
            let starts = |l: &str| l.trim_start().strip_prefix(key).is_some_and(|r| r.trim_start().starts_with('='));
            text.lines().position(starts).map(|l| l + 1)
        };
        let at_line = |fault: Fault, key: &str| match line_of(key) {
            Some(line) => fault.line(line),
            None => fault,
        };
        if file.format != STYLE_FORMAT {
            let fault = Fault::of(
                FileFault::Version,
                format!("format {} of a style is not known to this version", file.format),
            );
            return Err(at_line(fault, "format").help(format!("this version reads format {STYLE_FORMAT}")));
        }
        let p = &file.proportions;
        for (key, value, low, high) in [
            ("ink", file.ink, 0.0, 4.0),
            ("strands", file.strands, 0.0, 1.0),
            ("folds", file.folds, 0.0, 1.0),
            ("jaw_round", file.jaw_round, 0.0, 1.0),
            ("symmetry", p.symmetry, 0.0, 1.0),
            ("ear_symmetry", p.ear_symmetry, 0.0, 1.0),
            ("eye_width", p.eye_width, 0.5, 2.0),
            ("eye_height", p.eye_height, 0.5, 2.5),
            ("iris", p.iris, 0.4, 2.0),
            ("crease", p.crease, 0.0, 1.0),
            ("nose", p.nose, 0.3, 2.0),
            ("nose_up", p.nose_up, -0.5, 0.5),
            ("mouth_wide", p.mouth_wide, 0.4, 1.6),
            ("mouth_high", p.mouth_high, 0.4, 1.6),
            ("mouth_up", p.mouth_up, -0.3, 0.3),
            ("brow_up", p.brow_up, -0.2, 0.4),
            ("chin_up", p.chin_up, -0.3, 0.3),
            ("jaw_up", p.jaw_up, -0.3, 0.3),
        ] {
            if !(low..=high).contains(&value) {
                let fault = Fault::new(format!("`{key}` of a style is {value}"));
                return Err(at_line(fault, key).help(format!("write a number from {low} to {high}")));
            }
        }
        let colours = Chosen { shirt: file.colours.shirt.or(file.shirt), ..file.colours };
        Ok(Self {
            title: file.title.map_or_else(|| "a style".to_owned(), |t| clean_line(&t, 200)),
            ink_only: file.ink_only,
            ink: file.ink,
            ground: file.background,
            disc: file.disc,
            hair: match file.hair {
                HairChoice::Auto => None,
                HairChoice::Straight => Some(HairKind::Straight),
                HairChoice::Wavy => Some(HairKind::Wavy),
                HairChoice::Curly => Some(HairKind::Curly),
                HairChoice::Shaved => Some(HairKind::Shaved),
                HairChoice::Bald => Some(HairKind::Bald),
            },
            hair_curve: file.hair_curve,
            strands: file.strands,
            beard: file.beard,
            glasses: file.glasses,
            brows: file.brows,
            nose: file.nose,
            folds: file.folds,
            jaw_round: file.jaw_round,
            proportions: file.proportions,
            colours,
        })
    }

    /// What it is called.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }
}

impl<'de> Deserialize<'de> for Choice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Words;
        impl Visitor<'_> for Words {
            type Value = Choice;
            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("true, false or \"auto\"")
            }
            fn visit_bool<E: Error>(self, yes: bool) -> std::result::Result<Choice, E> {
                Ok(if yes { Choice::Yes } else { Choice::No })
            }
            fn visit_str<E: Error>(self, word: &str) -> std::result::Result<Choice, E> {
                if word == "auto" {
                    Ok(Choice::Auto)
                } else {
                    Err(E::custom(format!("`{word}` is none of true, false and \"auto\"")))
                }
            }
        }
        deserializer.deserialize_any(Words)
    }
}

impl Choice {
    /// What is drawn where `found` says what the face has.
    pub(super) fn or(self, found: bool) -> bool {
        match self {
            Self::Auto => found,
            Self::Yes => true,
            Self::No => false,
        }
    }
}
