//! What the README says of the program is what the program does.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

use std::path::Path;

/// Each command that the README names in a block or in backticks is one of the program's.
#[test]
fn the_readme_names_commands_that_there_are() {
    let readme = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap();
    let help = assert_cmd::Command::new(env!("CARGO_BIN_EXE_lianpu")).arg("--help").output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let commands: Vec<&str> = help
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .map_while(|line| line.strip_prefix("  ").filter(|rest| !rest.is_empty()))
        .filter_map(|line| line.split(' ').next().filter(|name| !name.is_empty()))
        .collect();
    assert!(commands.contains(&"keys") && commands.len() > 15, "{commands:?}");
    for after in readme.split("lianpu ").skip(1) {
        let word: String = after.chars().take_while(|c| c.is_ascii_lowercase() || *c == '-').collect();
        let is_command =
            !word.starts_with('-') && after[word.len()..].starts_with([' ', '`', '\n']) && !word.is_empty();
        // `lianpu my-lesson` opens the studio on a project.
        if is_command && word != "my-lesson" {
            assert!(commands.contains(&word.as_str()), "`lianpu {word}` is in the README and no command: {commands:?}");
        }
    }
}
