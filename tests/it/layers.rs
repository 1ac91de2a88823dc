//! A room uses only the rooms before it in `src/lib.rs`.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The rooms in their order.
fn rooms() -> Vec<String> {
    let map = fs::read_to_string(root().join("lib.rs")).unwrap();
    map.lines().filter_map(|l| l.strip_prefix("pub mod ")?.strip_suffix(';').map(str::to_owned)).collect()
}

fn files_of(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            files_of(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
}

/// The rooms named after `crate::` in a file's own code; its tests may look ahead.
fn used(text: &str) -> Vec<(usize, String)> {
    let own = text.split("#[cfg(test)]").next().unwrap_or_default();
    let mut found = Vec::new();
    for (number, line) in own.lines().enumerate() {
        if line.trim_start().starts_with("//") {
            continue;
        }
        for part in line.split("crate::").skip(1) {
            let name: String = part.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
            found.push((number + 1, name));
        }
    }
    found
}

#[test]
fn a_room_uses_only_the_rooms_before_it() {
    let rooms = rooms();
    assert!(rooms.len() >= 16, "the map in lib.rs is not read: {rooms:?}");
    let mut wrong = Vec::new();
    for (place, room) in rooms.iter().enumerate() {
        let mut files = Vec::new();
        files_of(&root().join(room), &mut files);
        for file in files {
            for (line, name) in used(&fs::read_to_string(&file).unwrap()) {
                let at = rooms.iter().position(|r| *r == name);
                if at.is_none_or(|at| at > place) {
                    wrong.push(format!("{}:{line} in `{room}` uses `{name}`", file.display()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn every_room_opens_by_saying_what_it_owns() {
    for room in rooms() {
        let text = fs::read_to_string(root().join(&room).join("mod.rs")).unwrap();
        assert!(text.starts_with("//! "), "{room}");
    }
}

/// Whether a line of code has a flag or a command of this program in a text.
fn speaks_of_the_command_line(line: &str) -> bool {
    let texts = line.split('"').skip(1).step_by(2);
    texts.into_iter().any(|text| {
        let flag =
            |word: &str| word.strip_prefix("--").is_some_and(|w| w.starts_with(|c: char| c.is_ascii_lowercase()));
        text.contains("`lianpu ") || text.split([' ', '(', '`']).any(flag)
    })
}

#[test]
fn only_the_two_faces_speak_of_flags_commands_and_keys() {
    let mut wrong = Vec::new();
    // A job for an engine is made of commands; ffmpeg and dlib have flags of their own.
    let others = ["farm.rs", "ffmpeg", "dlib.rs", "sound.rs"];
    for room in rooms().iter().filter(|room| !matches!(room.as_str(), "studio" | "cli")) {
        let mut files = Vec::new();
        files_of(&root().join(room), &mut files);
        for file in files.iter().filter(|f| others.iter().all(|o| !f.to_string_lossy().contains(o))) {
            let text = fs::read_to_string(file).unwrap();
            let own = text.split("#[cfg(test)]").next().unwrap_or_default();
            for (number, line) in own.lines().enumerate().filter(|(_, l)| !l.trim_start().starts_with("//")) {
                if speaks_of_the_command_line(line) || line.contains("clap") {
                    wrong.push(format!("{}:{}: {}", file.display(), number + 1, line.trim()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn only_the_disk_room_opens_files() {
    let own = [
        "File::open",
        "File::create",
        "OpenOptions",
        "fs::read",
        "fs::write",
        "fs::copy",
        "fs::create_dir",
        "hard_link",
    ];
    // A link's target is read, and no file.
    let is_fine = |line: &str| line.trim_start().starts_with("//") || line.contains("fs::read_link");
    let mut files = Vec::new();
    files_of(&root(), &mut files);
    let mut wrong = Vec::new();
    for file in files.iter().filter(|f| !f.starts_with(root().join("disk"))) {
        let text = fs::read_to_string(file).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        for (number, line) in code.lines().enumerate().filter(|(_, line)| !is_fine(line)) {
            if own.iter().any(|call| line.contains(call)) {
                wrong.push(format!("{}:{}: {}", file.display(), number + 1, line.trim()));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// The modules of a room: each file's path without `.rs` and `mod`, with `/` between its parts, and its own code.
fn modules(room: &str) -> BTreeMap<String, String> {
    let mut files = Vec::new();
    files_of(&root().join(room), &mut files);
    let name = |file: &Path| {
        let path = file.with_extension("").strip_prefix(root()).unwrap().to_str().unwrap().to_owned();
        path.strip_suffix("/mod").map(str::to_owned).unwrap_or(path)
    };
    let own = |file: &Path| {
        let text = fs::read_to_string(file).unwrap();
        let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
        code.lines().filter(|l| !l.trim_start().starts_with("//")).collect::<Vec<_>>().join(" ")
    };
    files.iter().map(|file| (name(file), own(file))).collect()
}

/// The modules of a room that one of them names by `super::` or `crate::`. What a folder's own file names again is not
/// followed.
fn named(module: &str, code: &str, all: &BTreeMap<String, String>) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (start, _) in code.match_indices("super::").chain(code.match_indices("crate::")) {
        if code[..start].ends_with("super::") {
            continue;
        }
        let mut path = &code[start..];
        let mut at = if path.starts_with("crate::") { "" } else { module };
        while let Some(rest) = path.strip_prefix("super::") {
            (path, at) = (rest, at.rsplit_once('/').map_or("", |parts| parts.0));
        }
        path = path.strip_prefix("crate::").unwrap_or(path);
        // In braces several paths follow.
        let group = path.strip_prefix('{').and_then(|p| p.split_once('}')).map(|p| p.0);
        for item in group.map_or(vec![path], |g| g.split(',').collect()) {
            let mut to = at.to_owned();
            for part in item.trim().split("::") {
                let word: String = part.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
                let next = if to.is_empty() { word } else { format!("{to}/{word}") };
                if !all.contains_key(&next) {
                    break;
                }
                to = next;
            }
            // A folder's own file stands above all its files.
            let is_above = module == to || module.starts_with(&format!("{to}/")) || to.is_empty();
            if !is_above && all.contains_key(&to) {
                found.insert(to);
            }
        }
    }
    found
}

#[test]
fn no_files_of_a_room_import_each_other_in_a_circle() {
    for room in rooms() {
        let all = modules(&room);
        let mut uses: BTreeMap<&String, BTreeSet<String>> =
            all.iter().map(|(name, code)| (name, named(name, code, &all))).collect();
        // Files that use none of those that are left stand in no circle.
        while let Some(free) = uses.iter().find(|(_, to)| to.is_empty()).map(|(name, _)| (*name).clone()) {
            uses.remove(&free);
            for to in uses.values_mut() {
                to.remove(&free);
            }
        }
        assert!(uses.is_empty(), "`{room}`: files that stand in a circle or use those that do: {uses:#?}");
    }
}
