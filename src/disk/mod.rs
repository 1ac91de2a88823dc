//! Files, safely: through one door that leads out of no project and waits for nothing, whole or not at all, text made
//! clean as it is read and as it is printed, and one kind of error that says what is wrong, where, and what to do.
//!
//! It knows nothing of what the files mean. No other room opens, lists or writes files by itself.

mod clean;
mod door;
mod fault;
mod paths;
mod read;
mod temporary;
mod toml;
mod write;

pub use clean::{clean, clean_line, printable, printable_json, shown};
pub use door::{append, confine, copy, link, list, make_folder, open, open_folder, remove, rename};
pub use fault::{Fault, Result};
pub use paths::{inside, plain_name};
pub use read::{MAX_TEXT_BYTES, read_bytes, read_old, read_text};
pub use temporary::{clear_temporaries, settle, temporary_in, temporary_prefix};
pub use toml::{from_toml, nearest};
pub use write::{Lock, put_whole, replace, write_output, write_whole};
