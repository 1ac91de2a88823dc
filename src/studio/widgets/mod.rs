//! What several screens draw with: text, boxes, pictures, a line to type.

pub(in crate::studio) mod boxed;
pub(in crate::studio) mod foot;
pub(in crate::studio) mod line;
pub(in crate::studio) mod photo_picture;
pub(in crate::studio) mod picture;
pub(in crate::studio) mod prompt;
pub(in crate::studio) mod text;
