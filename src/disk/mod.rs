//! Files, safely: through one door that leads out of no project and waits for nothing, whole or not at all, text made
//! clean as it is read and as it is printed, outside programs that end with their handle, and one kind of error that says
//! what is wrong, where, and what to do.
//!
//! It knows nothing of what the files mean. No other room opens, lists or writes files by itself.

mod calls;
mod clean;
mod commit;
mod csv;
mod door;
mod fault;
mod kind;
mod lock;
mod message;
mod nearest;
mod next_step;
mod paths;
mod program;
mod read;
mod record;
mod recover;
mod rights;
mod sum;
mod temporary;
mod toml;
mod write;

pub(crate) use calls::SystemCalls;
pub use calls::{Calls, Handle};
pub use clean::{clean, clean_line, printable, printable_json, shown};
pub use commit::{Commit, Committed, Sums};
pub use csv::{CsvRow, CsvTable};
pub use door::{append, append_or_make, confine, copy, link, list, make_folder, open, open_folder, remove, rename};
pub use fault::{Fault, Result};
pub use kind::{FaultKind, FileFault};
pub(crate) use lock::HeldFolder;
pub use lock::Lock;
pub(crate) use message::message;
pub use message::{Message, Part};
pub use nearest::{nearest, suggestion};
pub use next_step::{NextStep, Setting, Task};
pub use paths::{free_name, inside, is_file_there, plain_name};
pub use program::{Ended, Messages, Pipe, Program, Running};
pub use read::{MAX_TEXT_BYTES, read_bytes, read_old, read_text};
pub use record::commit_stamp;
pub use recover::{CHANGED_MEANWHILE, Pending, end_commit, is_commit_open};
pub use rights::Rights;
pub use sum::Sum;
pub use temporary::{clear_temporaries, has_temporaries, is_temporary, settle, temporary_in, temporary_prefix};
pub use toml::from_toml;
pub use write::{put_whole, replace, write_output, write_whole};
