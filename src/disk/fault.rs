//! The error of everything that reads what a person wrote: what, where, what to do.

use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};

use super::{printable, shown};

/// What every reading room returns.
pub type Result<T, E = Fault> = std::result::Result<T, E>;

/// Something in the input is wrong. Prints as up to three lines: what, where, what to do.
///
/// ```
/// use lianpu::disk::Fault;
/// let fault = Fault::new("`fps` is 0").at("lianpu.toml").line(7).help("give a number from 1 to 240");
/// assert_eq!(fault.to_string(), "`fps` is 0\n  at lianpu.toml:7\n  give a number from 1 to 240");
/// ```
#[derive(Debug)]
pub struct Fault {
    what: String,
    path: Option<PathBuf>,
    line: Option<usize>,
    help: String,
    /// The call itself was wrong (exit code 2), not the input (exit code 1).
    call: bool,
    source: Option<Box<dyn Error + Send + Sync>>,
}

impl Fault {
    /// What was found, in one line, with the offending text in backticks.
    #[must_use]
    pub fn new(what: impl Into<String>) -> Self {
        Self { what: what.into(), path: None, line: None, help: String::new(), call: false, source: None }
    }

    /// A failed operation on a file, with the system's own word as the source.
    #[must_use]
    pub fn io(doing: &str, path: impl AsRef<Path>, source: std::io::Error) -> Self {
        let mut fault = Self::new(format!("{doing}: {source}")).at(path);
        fault.source = Some(Box::new(source));
        fault
    }

    /// The file it is in. A file given further in wins over one given further out.
    #[must_use]
    pub fn at(mut self, path: impl AsRef<Path>) -> Self {
        self.path.get_or_insert_with(|| path.as_ref().to_owned());
        self
    }

    /// The line it is on, counted from 1.
    #[must_use]
    pub fn line(mut self, line: usize) -> Self {
        self.line.get_or_insert(line);
        self
    }

    /// What is allowed, or what to do next.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }

    /// Marks the call, not the input, as what was wrong.
    #[must_use]
    pub fn of_the_call(mut self) -> Self {
        self.call = true;
        self
    }

    /// Whether the call itself was wrong.
    #[must_use]
    pub fn is_of_the_call(&self) -> bool {
        self.call
    }

    /// What was found, without place and help.
    #[must_use]
    pub fn what(&self) -> &str {
        &self.what
    }

    /// The file it is in, where one is known.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The line it is on, where one is known.
    #[must_use]
    pub fn line_number(&self) -> Option<usize> {
        self.line
    }

    /// What to do next; empty where nothing better than the message can be said.
    #[must_use]
    pub fn next_step(&self) -> &str {
        &self.help
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&printable(&self.what))?;
        match (&self.path, self.line) {
            (Some(path), Some(line)) => write!(f, "\n  at {}:{line}", shown(path))?,
            (Some(path), None) => write!(f, "\n  at {}", shown(path))?,
            (None, Some(line)) => write!(f, "\n  at line {line}")?,
            (None, None) => {}
        }
        if self.help.is_empty() { Ok(()) } else { write!(f, "\n  {}", printable(&self.help)) }
    }
}

impl Error for Fault {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.source.as_deref().map(|s| s as &(dyn Error + 'static))
    }
}
