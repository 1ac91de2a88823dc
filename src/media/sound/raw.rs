//! A decoded file before it is a [`Sound`](super::Sound), and the limits and faults that all readers share.

use super::mix::Mixed;
use crate::disk::{Fault, FileFault, Result};

/// The longest recording that is read, in seconds: 4 hours.
const MAX_SECONDS: u64 = 4 * 3600;

/// Samples a second that are read: from the poorest telephone to the finest studio. Others are damaged headers.
pub(super) const RATES: std::ops::RangeInclusive<u32> = 1_000..=768_000;

pub(super) const SAVE_AS_WAV: &str = "save it as WAV, 16 bits, and try again";

/// What comes out of a file.
pub(super) struct Raw {
    pub rate: u32,
    pub mixed: Mixed,
    pub warnings: Vec<String>,
}

/// Makes sure that it is no longer than what is read.
pub(super) fn short_enough(frames: u64, rate: u32) -> Result<()> {
    if frames > MAX_SECONDS * u64::from(rate) {
        return Err(Fault::of(FileFault::TooLarge, "the recording is longer than 4 hours").help("cut it into clips"));
    }
    Ok(())
}

/// A file that can be opened and not read.
#[allow(clippy::needless_pass_by_value)] // as `map_err` gives it
pub(super) fn broken(error: std::io::Error) -> Fault {
    Fault::new(format!("cannot read it: {error}")).help("try again from a copy on another disk")
}
