//! Files, safely: whole or not at all, never outside their folder, text made clean as it is read, and one kind of
//! error that says what is wrong, where, and what to do.
//!
//! It knows nothing of what the files mean.

mod csv;
mod fault;
mod nearest;
mod paths;
mod read;
mod temporary;
mod toml;
mod write;

pub(crate) use csv::{CsvRow, CsvTable};
pub use fault::{Fault, Result};
pub use nearest::{nearest, suggestion};
pub use paths::{inside, plain_name};
pub use read::{MAX_TEXT_BYTES, clean, clean_line, read_bytes, read_old, read_text};
pub use temporary::{clear_temporaries, temporary_in, temporary_prefix};
pub use toml::from_toml;
pub use write::{Lock, put_whole, replace, write_whole};
