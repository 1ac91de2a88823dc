//! What the README says of the program is what the program says of itself.

#![allow(clippy::unwrap_used, reason = "a test may stop")]

#[test]
fn the_readme_lists_the_studio_s_keys_as_they_are() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let readme = std::fs::read_to_string(&path).unwrap();
    let table = lianpu::studio::key_table_markdown();
    if std::env::var_os("LIANPU_GOLDEN").is_some_and(|v| v == "write") {
        let (start, end) = ("## The studio's keys\n", "\n## A lesson on disk");
        let (before, rest) = readme.split_once(start).unwrap();
        let (_, after) = rest.split_once(end).unwrap();
        std::fs::write(path, format!("{before}{start}\n{}\n{end}{after}", table.trim())).unwrap();
        return;
    }
    assert!(readme.contains(table.trim()), "make it again: LIANPU_GOLDEN=write cargo test --test readme");
}
