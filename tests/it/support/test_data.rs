//! Where test data is: `LIANPU_DATA`, else beside the project.

use std::path::PathBuf;

/// A file or folder of the test data; where it is missing, says so in a line.
pub fn find(path: &str) -> Option<PathBuf> {
    let beside = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let full = std::env::var_os("LIANPU_DATA").map_or_else(beside, PathBuf::from).join(path);
    let there = full.exists();
    if !there {
        println!("no test data at {}: nothing checked", full.display());
    }
    there.then_some(full)
}
