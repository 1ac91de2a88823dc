//! Outside programs: found on the PATH, started without a terminal, fed or read, ended together with their handle.
//!
//! A program has one pipe at most, in or out, and a thread of its own drains its standard error: neither side can wait
//! for the other. On Unix it is in a process group of its own: Ctrl-C on the terminal reaches Lianpu alone, which ends
//! the program or lets it finish.
//!
//! The meaning of arguments and messages is the caller's.

use std::ffi::OsStr;
use std::io::{self, BufReader, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use super::clean_line;

/// Bytes of standard error that are retained: the first half and the last half of them.
const RETAINED: usize = 64 << 10;
/// Bytes read from a program at once.
const OUTPUT_BUFFER: usize = 1 << 20;
/// Pause between two checks for a program's end.
const POLL: Duration = Duration::from_millis(5);
/// A program that takes no more input has this long to end by itself and to write why.
const GRACE: Duration = Duration::from_millis(500);
/// A program that has ended closes its standard error at once, unless it left a process behind that holds it open.
const LAST_WORDS: Duration = Duration::from_secs(5);
/// The longest line of a message, in characters.
const LONGEST_LINE: usize = 200;

/// An executable file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    path: PathBuf,
}

/// The pipe to a running program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pipe {
    /// To its standard input.
    Input,
    /// From its standard output.
    Output,
    /// None: its input is empty, its output is discarded.
    None,
}

impl Program {
    /// Searches the absolute folders of the PATH for an executable file.
    #[must_use]
    pub(crate) fn find(name: &str) -> Option<Self> {
        let name = format!("{name}{}", std::env::consts::EXE_SUFFIX);
        let path = std::env::var_os("PATH")?;
        let folders = std::env::split_paths(&path).filter(|folder| folder.is_absolute());
        folders.map(|folder| folder.join(&name)).find(|file| is_executable(file)).map(|path| Self { path })
    }

    /// A program at a known path; not checked.
    #[must_use]
    pub(crate) fn at(path: &Path) -> Self {
        Self { path: path.to_owned() }
    }

    /// The executable file.
    #[must_use]
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Starts it. Of the environment, what makes ffmpeg colour its messages or write a report is taken out.
    ///
    /// # Errors
    /// When the file is not there or the system cannot run it.
    pub(crate) fn start<A: AsRef<OsStr>>(
        &self,
        arguments: impl IntoIterator<Item = A>,
        pipe: Pipe,
    ) -> io::Result<Running> {
        let only = |wanted: Pipe| if pipe == wanted { Stdio::piped() } else { Stdio::null() };
        let mut command = Command::new(&self.path);
        command.args(arguments).env("AV_LOG_FORCE_NOCOLOR", "1").env_remove("FFREPORT");
        command.stdin(only(Pipe::Input)).stdout(only(Pipe::Output)).stderr(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut child = command.spawn()?;
        let (input, output) = (child.stdin.take(), child.stdout.take());
        let messages = child.stderr.take().map(|stderr| {
            let (sender, messages) = channel();
            thread::spawn(move || sender.send(ends_of(stderr)));
            messages
        });
        Ok(Running { child, input, output, messages })
    }
}

#[cfg(unix)]
fn is_executable(path: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    path.metadata().is_ok_and(|m| m.is_file() && m.permissions().mode() & 0o111 != 0)
}

#[cfg(not(unix))]
fn is_executable(path: &Path) -> bool {
    path.is_file()
}

/// Reads to the end, and returns the first and the last bytes.
fn ends_of(mut pipe: impl Read) -> Vec<u8> {
    let mut ends = Vec::new();
    let mut part = [0; 4096];
    loop {
        match pipe.read(&mut part) {
            Ok(count @ 1..) => ends.extend_from_slice(&part[..count]),
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Ok(0) | Err(_) => return ends,
        }
        if ends.len() > RETAINED {
            ends.drain(RETAINED / 2..ends.len() - RETAINED / 2);
        }
    }
}

/// A started program; killed when dropped.
#[derive(Debug)]
pub struct Running {
    child: Child,
    input: Option<ChildStdin>,
    output: Option<ChildStdout>,
    messages: Option<Receiver<Vec<u8>>>,
}

/// The end of a program.
#[derive(Debug)]
pub struct Ended {
    /// Its exit status.
    pub status: ExitStatus,
    /// Its standard error.
    pub messages: Messages,
}

impl Running {
    /// Writes all bytes to its standard input; waits while the program is behind.
    ///
    /// # Errors
    /// When it has closed its input or ended ([`give_up`](Self::give_up) has its messages), or was started without
    /// [`Pipe::Input`].
    pub(crate) fn feed(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.input.as_mut().ok_or(ErrorKind::BrokenPipe)?.write_all(bytes)
    }

    /// Its standard output, once; none without [`Pipe::Output`].
    pub(crate) fn output(&mut self) -> Option<BufReader<ChildStdout>> {
        self.output.take().map(|output| BufReader::with_capacity(OUTPUT_BUFFER, output))
    }

    /// Closes its pipes and waits for its end.
    ///
    /// # Errors
    /// When the system cannot wait for it.
    pub(crate) fn ended(&mut self) -> io::Result<Ended> {
        self.close();
        let status = self.child.wait()?;
        Ok(Ended { status, messages: self.messages() })
    }

    /// Like [`ended`](Self::ended); none where `stop` becomes true before, and then it goes on running.
    ///
    /// # Errors
    /// Those of [`ended`](Self::ended).
    pub(crate) fn ended_unless(&mut self, stop: &AtomicBool) -> io::Result<Option<Ended>> {
        self.close();
        loop {
            if let Some(status) = self.child.try_wait()? {
                return Ok(Some(Ended { status, messages: self.messages() }));
            }
            if stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            thread::sleep(POLL);
        }
    }

    /// Closes its pipes, and kills it where it does not end by itself within half a second.
    pub(crate) fn give_up(&mut self) -> Messages {
        self.close();
        let start = Instant::now();
        while matches!(self.child.try_wait(), Ok(None)) && start.elapsed() < GRACE {
            thread::sleep(POLL);
        }
        self.stop();
        self.messages()
    }

    /// Kills it.
    pub(crate) fn stop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }

    fn close(&mut self) {
        (self.input, self.output) = (None, None);
    }

    fn messages(&mut self) -> Messages {
        let bytes = self.messages.take().and_then(|messages| messages.recv_timeout(LAST_WORDS).ok());
        Messages(String::from_utf8_lossy(&bytes.unwrap_or_default()).into_owned())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.stop();
    }
}

/// The standard error of a program; of more than 64 KiB the beginning and the end.
#[derive(Debug)]
pub struct Messages(String);

impl Messages {
    /// The text as it came; not safe to print.
    #[must_use]
    pub(crate) fn text(&self) -> &str {
        &self.0
    }

    /// Its lines, clean and each once, without the memory addresses that ffmpeg gives for its parts (`[mov @ 0x55d0]`).
    #[must_use]
    pub(crate) fn lines(&self) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for line in self.0.lines() {
            let mut line = clean_line(line, LONGEST_LINE);
            if let (Some(at), Some(end)) = (line.find(" @ 0x"), line.find(']'))
                && line.starts_with('[')
                && at < end
            {
                line.replace_range(at..end, "");
            }
            if !line.is_empty() && !lines.contains(&line) {
                lines.push(line);
            }
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_come_once_and_without_addresses() {
        let text = "[libx264 @ 0x55d0c7] broken\u{1b}[0m header\n[libx264 @ 0x55d0c8] broken\u{1b}[0m header\n\nend\n";
        assert_eq!(Messages(text.into()).lines(), ["[libx264] broken[0m header", "end"]);
    }

    #[test]
    fn many_messages_keep_their_beginning_and_their_end() {
        let text: String = (0..20_000).map(|n| format!("line {n}\n")).collect();
        let ends = String::from_utf8(ends_of(text.as_bytes())).unwrap();
        assert!(ends.len() <= RETAINED && ends.starts_with("line 0\n") && ends.ends_with("line 19999\n"));
    }

    #[test]
    fn a_missing_program_is_not_found_and_does_not_start() {
        assert_eq!(Program::find("lianpu-has-no-such-program"), None);
        let missing = Program::at(Path::new("/nowhere/program"));
        assert_eq!(missing.start([""; 0], Pipe::None).unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[cfg(unix)]
    mod with_a_shell {
        use super::*;

        fn shell(script: &str, pipe: Pipe) -> Running {
            Program::find("sh").unwrap().start(["-c", script], pipe).unwrap()
        }

        /// True while a process is there; one that was killed and waited for is not.
        fn is_alive(process: &str) -> bool {
            shell(&format!("kill -0 {process}"), Pipe::None).ended().unwrap().status.success()
        }

        #[test]
        fn an_early_death_fails_the_feeding_and_leaves_its_messages() {
            let mut program = shell("exec <&-; sleep 0.1; echo 'no such encoder' >&2; exit 3", Pipe::Input);
            let fed = (0..1000).try_for_each(|_| program.feed(&[0; 4096]));
            assert_eq!(fed.unwrap_err().kind(), ErrorKind::BrokenPipe);
            assert_eq!(program.give_up().lines(), ["no such encoder"]);
        }

        #[test]
        fn one_that_closes_its_input_and_goes_on_is_killed() {
            let mut program = shell("exec <&-; echo enough >&2; exec sleep 600", Pipe::Input);
            let start = Instant::now();
            while program.feed(&[0; 4096]).is_ok() {}
            assert_eq!(program.give_up().lines(), ["enough"]);
            assert!(start.elapsed() < Duration::from_secs(60));
        }

        #[test]
        fn feeding_a_program_that_complains_more_than_a_pipe_holds_ends() {
            // It writes 1 MB before it reads anything, and again for every line that it reads.
            let much = "head -c 1000000 /dev/zero | tr '\\0' x >&2; echo >&2";
            let script = format!("{much}; while read -r line; do {much}; done; echo \"done\" >&2; exit 7");
            let mut program = shell(&script, Pipe::Input);
            (0..3).for_each(|_| program.feed(&[b"y".repeat(100_000), b"\n".to_vec()].concat()).unwrap());
            let ended = program.ended_unless(&AtomicBool::new(false)).unwrap().unwrap();
            assert_eq!(ended.status.code(), Some(7));
            assert!(ended.messages.text().len() <= RETAINED && ended.messages.text().ends_with("x\ndone\n"));
        }

        #[test]
        fn unread_output_does_not_delay_the_end() {
            let mut program = shell("exec yes", Pipe::Output);
            assert!(!program.ended().unwrap().status.success());
        }

        #[test]
        fn dropping_kills_and_a_stop_lets_it_run_until_then() {
            let mut program = shell("echo $$; exec sleep 600", Pipe::Output);
            let mut line = String::new();
            io::BufRead::read_line(&mut program.output().unwrap(), &mut line).unwrap();
            assert!(program.ended_unless(&AtomicBool::new(true)).unwrap().is_none());
            assert!(is_alive(line.trim()));
            drop(program);
            assert!(!is_alive(line.trim()));
        }
    }
}
