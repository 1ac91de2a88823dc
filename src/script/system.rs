//! What a script is written in.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// What a script is written in: declared in a lesson's manifest or a call, or told from the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum System {
    /// Told from the text; where the text does not tell, it is asked for.
    #[default]
    Auto,
    /// Chinese characters; words in Latin letters are English unless they show tones.
    Han,
    /// Hanyu Pinyin.
    Hanyu,
    /// Zhuyin (Bopomofo).
    Zhuyin,
    /// Tongyong Pinyin.
    Tongyong,
    /// English.
    English,
}

impl System {
    /// Every system.
    pub const ALL: [Self; 6] = [Self::Auto, Self::Han, Self::Hanyu, Self::Zhuyin, Self::Tongyong, Self::English];

    /// The word used in files and calls.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Han => "han",
            Self::Hanyu => "hanyu",
            Self::Zhuyin => "zhuyin",
            Self::Tongyong => "tongyong",
            Self::English => "english",
        }
    }
}

impl fmt::Display for System {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for System {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|s| s.name() == text)
            .ok_or_else(|| format!("`{text}` is none of auto, han, hanyu, zhuyin, tongyong, english"))
    }
}
