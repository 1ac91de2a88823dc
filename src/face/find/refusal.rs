//! Why no face is given, and what gives cause for doubt about one that is.

use std::fmt;

use crate::disk::{FaultKind, Message, Setting, message};

/// Why no face is given for a photo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Refusal {
    /// Nothing in the photo looks like a face from the front.
    NoFace,
    /// Two faces that could both be meant.
    TwoFaces,
    /// The face looks to a side: by about so many degrees, where that can be told.
    TurnedAway(Option<f64>),
    /// The head is tilted by so many degrees, clockwise as seen.
    Tilted(f64),
    /// The pupils are so many pixels apart in the copy of the photo that is looked at, which has at most
    /// [`WORKING_SIDE`](super::WORKING_SIDE) pixels a side.
    TooSmall(f64),
    /// Something lies there, but the points do not sit on it as they do on a face.
    Unclear,
}

impl FaultKind for Refusal {}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoFace => f.write_str("no face was found in the photo"),
            Self::TwoFaces => f.write_str("there are two faces in the photo"),
            Self::TurnedAway(Some(degrees)) => write!(f, "the head is turned away by about {degrees:.0}°"),
            Self::TurnedAway(None) => f.write_str("the head is turned away"),
            Self::Tilted(degrees) => write!(f, "the head is tilted by {:.0}°", degrees.abs()),
            Self::TooSmall(pixels) => {
                write!(f, "the face is too small: its pupils are {pixels:.0} pixels apart, and 24 are needed")
            }
            Self::Unclear => f.write_str("the face cannot be made out clearly"),
        }
    }
}

impl std::error::Error for Refusal {}

impl Refusal {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Message {
        match self {
            Self::NoFace => {
                let photo = "take a photo from the front, upright, the whole head in it; or say where eyes, mouth and chin are: ";
                message![photo, Setting::Anchors]
            }
            Self::TwoFaces => "cut the photo so that only one of them is in it".into(),
            Self::TurnedAway(_) => "take a photo in which the person looks straight into the camera".into(),
            Self::Tilted(_) => "turn the photo so that the eyes are level".into(),
            Self::TooSmall(_) => "cut the photo closer round the head, or take it from nearer".into(),
            Self::Unclear => {
                let photo =
                    "take a photo with even light and nothing before the face; or say where eyes, mouth and chin are: ";
                message![photo, Setting::Anchors]
            }
        }
    }
}

/// What gives cause for doubt about a face that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Doubt {
    /// The head is tilted by so many degrees, clockwise as seen.
    Tilted(f64),
    /// The head is turned by about so many degrees; above 0 the nose points to the image's right.
    Turned(f64),
    /// The mouth is open, by so much of its width.
    MouthOpen(f64),
    /// The pupils are so few pixels apart in the photo.
    Small(f64),
    /// It looks less like the faces that are known than they do.
    Unusual,
    /// So many of the points are placed by guess: the picture does not show them.
    Guessed(usize),
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tilted(degrees) => write!(f, "the head is tilted by {:.0}°", degrees.abs()),
            Self::Turned(degrees) => write!(f, "the head is turned by about {:.0}°", degrees.abs()),
            Self::MouthOpen(share) => {
                write!(f, "the mouth is open by {:.0} % of its width; a neutral face has it closed", 100.0 * share)
            }
            Self::Small(pixels) => write!(f, "the face is small: its pupils are {pixels:.0} pixels apart"),
            Self::Unusual => f.write_str("the face looks unusual, so points may be wrong"),
            Self::Guessed(points) => write!(f, "{points} points are placed by guess"),
        }
    }
}
