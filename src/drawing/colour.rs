//! Colours as they are written in files: straight sRGB, 8 bits a channel.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Straight (not premultiplied) sRGB with alpha.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Colour {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
    /// 255 opaque, 0 invisible.
    pub a: u8,
}

impl Colour {
    /// White.
    pub const WHITE: Self = Self::rgb(255, 255, 255);
    /// Black.
    pub const BLACK: Self = Self::rgb(0, 0, 0);

    /// An opaque colour.
    #[must_use]
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b, a: 255 }
    }

    /// The same colour, less opaque: `share` from 0 to 1.
    #[must_use]
    pub fn faded(mut self, share: f64) -> Self {
        self.a = (f64::from(self.a) * share.clamp(0.0, 1.0)).round() as u8;
        self
    }

    /// What is seen where this opaque colour lies on another one with `share` of it covering: as opaque as `below`.
    #[must_use]
    pub(crate) fn over(self, below: Self, share: f64) -> Self {
        let share = share.clamp(0.0, 1.0);
        let mixed = |a: u8, b: u8| (f64::from(b) + (f64::from(a) - f64::from(b)) * share).round() as u8;
        Self { r: mixed(self.r, below.r), g: mixed(self.g, below.g), b: mixed(self.b, below.b), a: below.a }
    }

    /// `#rrggbb` without the alpha.
    #[must_use]
    pub(crate) fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.r, self.g, self.b)
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.hex())?;
        if self.a == 255 { Ok(()) } else { write!(f, "{:02x}", self.a) }
    }
}

impl FromStr for Colour {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let named = match text {
            "white" => Some(Self::WHITE),
            "black" => Some(Self::BLACK),
            "transparent" => Some(Self { a: 0, ..Self::WHITE }),
            _ => None,
        };
        let digits = text.strip_prefix('#').filter(|d| d.is_ascii()).map(str::as_bytes);
        let byte = |d: &[u8], i: usize| {
            std::str::from_utf8(&d[2 * i..2 * i + 2]).ok().and_then(|s| u8::from_str_radix(s, 16).ok())
        };
        let parsed = named.or_else(|| match digits {
            Some(d) if d.len() == 6 => Some(Self::rgb(byte(d, 0)?, byte(d, 1)?, byte(d, 2)?)),
            Some(d) if d.len() == 8 => Some(Self { r: byte(d, 0)?, g: byte(d, 1)?, b: byte(d, 2)?, a: byte(d, 3)? }),
            _ => None,
        });
        parsed.ok_or_else(|| format!("`{text}` is no colour: write #rrggbb, white, black or transparent"))
    }
}

impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_is_read_as_it_is_written_and_anything_else_is_refused() {
        for text in ["#1b1a1c", "#00000080"] {
            assert_eq!(text.parse::<Colour>().unwrap().to_string(), text);
        }
        for text in ["", "#12345", "#ÿÿÿ", "red", "#12345g"] {
            assert!(text.parse::<Colour>().is_err(), "{text}");
        }
    }
}
