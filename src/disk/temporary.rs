//! Files on their way: written beside their place under a name that says whose they are, and cleared away when that
//! program has died.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;

use tempfile::{Builder, NamedTempFile, TempPath};

use super::door;

/// What their names begin with.
const MARK: &str = ".lianpu-";

/// After this long nobody works on a file that cannot be told to be somebody's.
const FORGOTTEN: Duration = Duration::from_secs(3600);

/// What the names of this process's files begin with: `.lianpu-MACHINE-PROCESS-`.
#[must_use]
pub fn temporary_prefix() -> String {
    format!("{MARK}{}-{}-", machine(), std::process::id())
}

/// A temporary file whose name ends so, with the rights that an ordinary program's file would get: the private ones that
/// temporary files have by default would make a lesson unreadable to the next teacher.
///
/// # Errors
/// When the folder is not there or cannot be written to.
pub fn temporary_in(folder: &Path, ending: &str) -> std::io::Result<NamedTempFile> {
    Builder::new().prefix(&temporary_prefix()).suffix(ending).make_in(folder, door::make)
}

/// Gives a temporary file its name, in place of a file that has it.
///
/// # Errors
/// When the name cannot be given; then the temporary file is removed.
pub fn settle(temporary: TempPath, path: &Path) -> std::io::Result<()> {
    door::rename(&temporary, path)?;
    // Where it was there is nothing now.
    let _ = temporary.keep();
    Ok(())
}

/// Removes the files and folders that killed programs have left in a folder. Files of those that still run are not
/// touched, here or on another machine that shares the folder.
pub fn clear_temporaries(folder: &Path) {
    for path in left_in(folder) {
        // Whoever else clears the same folder may have been faster.
        let _ = match path.symlink_metadata() {
            Ok(about) if about.is_dir() => fs::remove_dir_all(&path),
            _ => door::remove(&path),
        };
    }
}

/// Whether a name is that of a temporary file or folder.
#[must_use]
pub fn is_temporary(name: &str) -> bool {
    name.starts_with(MARK)
}

/// Whether killed programs have left something in a folder.
#[must_use]
pub fn has_temporaries(folder: &Path) -> bool {
    left_in(folder).next().is_some()
}

fn left_in(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let is_left = |path: &PathBuf| {
        let Some(rest) = path.file_name().and_then(|n| n.to_str()?.strip_prefix(MARK)) else { return false };
        match path.symlink_metadata() {
            Ok(about) if about.is_file() => is_dead(rest) || is_forgotten(&about),
            // A folder is filled for hours without a change of its own.
            Ok(about) if about.is_dir() => is_dead(rest),
            _ => false,
        }
    };
    door::list(folder).unwrap_or_default().into_iter().filter(is_left)
}

/// Whether a name's process was on this machine and is no more.
fn is_dead(rest: &str) -> bool {
    let mut parts = rest.split('-');
    let (Some(machine_of), Some(process)) = (parts.next(), parts.next()) else { return false };
    let Ok(process) = process.parse::<u32>() else { return false };
    machine_of == machine() && machine_of != UNKNOWN && !Path::new("/proc").join(process.to_string()).exists()
}

fn is_forgotten(about: &fs::Metadata) -> bool {
    about.modified().is_ok_and(|at| at.elapsed().is_ok_and(|age| age > FORGOTTEN))
}

/// Where processes cannot be told.
const UNKNOWN: &str = "0";

/// The boot of this machine and the space its process numbers count in, as eight digits: containers on one machine count
/// their processes apart.
fn machine() -> &'static str {
    static MACHINE: OnceLock<String> = OnceLock::new();
    MACHINE.get_or_init(|| {
        let boot = fs::read("/proc/sys/kernel/random/boot_id");
        let space = fs::read_link("/proc/self/ns/pid");
        let (Ok(boot), Ok(space)) = (boot, space) else { return UNKNOWN.to_owned() };
        let all = boot.iter().chain(space.as_os_str().as_encoded_bytes());
        // FNV-1a.
        let sum = all
            .fold(0xCBF2_9CE4_8422_2325_u64, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3));
        format!("{:08x}", sum >> 32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_the_dead_have_left_is_cleared_away() {
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str| fs::write(folder.path().join(name), "x").unwrap();
        let own = temporary_in(folder.path(), ".mp4").unwrap();
        // No process has the highest number.
        put(&format!("{MARK}{}-4294967295-abc.png", machine()));
        put(&format!("{MARK}ffffffff-4294967295-abc.png"));
        put(&format!("{MARK}old"));
        put("lesson.html");
        let draft = |process: u64| folder.path().join(format!("{MARK}{}-{process}-new", machine()));
        fs::create_dir_all(draft(4_294_967_295).join("clips")).unwrap();
        fs::create_dir(draft(u64::from(std::process::id()))).unwrap();
        clear_temporaries(folder.path());
        fs::remove_dir(draft(u64::from(std::process::id()))).unwrap();
        let mut left: Vec<String> =
            fs::read_dir(folder.path()).unwrap().flatten().map(|e| e.file_name().into_string().unwrap()).collect();
        left.sort();
        let own = own.path().file_name().unwrap().to_str().unwrap().to_owned();
        let mut expected =
            vec![own, format!("{MARK}ffffffff-4294967295-abc.png"), format!("{MARK}old"), "lesson.html".to_owned()];
        expected.sort();
        // Where processes cannot be told, time alone decides.
        if machine() != UNKNOWN {
            assert_eq!(left, expected);
        }
    }
}
