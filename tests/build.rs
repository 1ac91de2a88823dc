//! What the tests need and cargo cannot know: whether the test data, ffmpeg and the like are here. A test whose need is
//! not met is ignored, and counted so. The program itself is the same with and without.

use std::env;
use std::path::PathBuf;
use std::process::{Command, Stdio};

fn main() {
    // Not PATH: it differs from shell to shell, and everything would be built anew. After a program was installed,
    // `touch tests/build.rs` has it seen.
    for variable in ["LIANPU_DATA", "LIANPU_CHROMIUM"] {
        println!("cargo::rerun-if-env-changed={variable}");
    }
    println!("cargo::rerun-if-changed=tests/build.rs");

    let data = env::var_os("LIANPU_DATA").map_or_else(|| PathBuf::from("../shared/data"), PathBuf::from);
    // A path that is not there would have everything built anew each time.
    if data.is_dir() {
        println!("cargo::rerun-if-changed={}", data.display());
    }
    tell("has_data", data.is_dir());
    tell("has_ffmpeg", runs("ffmpeg", &["-version"]));
    let chromium = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
    tell("has_chromium", env::var_os("LIANPU_CHROMIUM").is_some() || chromium.into_iter().any(is_in_path));
}

/// Declares a condition of the tests, and whether it holds.
fn tell(condition: &str, holds: bool) {
    println!("cargo::rustc-check-cfg=cfg({condition})");
    if holds {
        println!("cargo::rustc-cfg={condition}");
    }
}

fn runs(program: &str, arguments: &[&str]) -> bool {
    let mut command = Command::new(program);
    command.args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

fn is_in_path(program: &str) -> bool {
    let path = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&path).any(|folder| folder.join(program).is_file())
}
