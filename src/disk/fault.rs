//! The error of everything that reads what a person wrote: its kind, what, where, what to do.

use std::any::Any;
use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};

use super::{FaultKind, FileFault, Message, NextStep, printable, shown};

/// What every reading room returns.
pub type Result<T, E = Fault> = std::result::Result<T, E>;

/// Something in the input is wrong. Prints as up to three lines: what, where, what to do. The next step is a [`Message`]:
/// a face words it with its own commands or keys by `Fault::worded`.
///
/// ```ignore
/// use lianpu::disk::Fault;
/// let fault = Fault::new("`fps` is 0").at("lianpu.toml").line(7).help("give a number from 1 to 240");
/// assert_eq!(fault.to_string(), "`fps` is 0\n  at lianpu.toml:7\n  give a number from 1 to 240");
/// ```
#[derive(Debug)]
pub struct Fault(Box<Inner>);

/// The parts of a fault, in a box: results are small where nothing is wrong.
#[derive(Debug)]
struct Inner {
    kind: Box<dyn FaultKind>,
    what: String,
    path: Option<PathBuf>,
    line: Option<usize>,
    help: Message,
    /// The request itself was wrong, not the input.
    call: bool,
    source: Option<Box<dyn Error + Send + Sync>>,
}

impl Fault {
    /// What was found, in one line, with the offending text in backticks; of the kind [`FileFault::Malformed`].
    #[must_use]
    pub fn new(what: impl Into<String>) -> Self {
        Self::of(FileFault::default(), what)
    }

    /// A fault of a kind, found in one line, with the offending text in backticks.
    #[must_use]
    pub(crate) fn of(kind: impl FaultKind, what: impl Into<String>) -> Self {
        Self(Box::new(Inner {
            kind: Box::new(kind),
            what: what.into(),
            path: None,
            line: None,
            help: Message::default(),
            call: false,
            source: None,
        }))
    }

    /// A failed operation on a file, with the system's own word as the source.
    #[must_use]
    pub fn io(doing: &str, path: impl AsRef<Path>, source: std::io::Error) -> Self {
        let mut fault = Self::of(FileFault::from(source.kind()), format!("{doing}: {source}")).at(path);
        fault.0.source = Some(Box::new(source));
        fault
    }

    /// The same of a file or folder that could not be written, with what helps against the reason.
    #[must_use]
    pub(crate) fn writing(doing: &str, path: impl AsRef<Path>, source: std::io::Error) -> Self {
        use std::io::ErrorKind as Kind;
        let help = match source.kind() {
            Kind::StorageFull | Kind::QuotaExceeded => "make room there",
            Kind::PermissionDenied | Kind::ReadOnlyFilesystem => "choose a place where you may write",
            Kind::InvalidFilename => "give a shorter name",
            Kind::AlreadyExists | Kind::NotADirectory => "a file has the name that its folder would need: give another",
            _ => "is there room, and may you write there?",
        };
        Self::io(doing, path, source).help(help)
    }

    /// The file it is in. A file given further in wins over one given further out.
    #[must_use]
    pub(crate) fn at(mut self, path: impl AsRef<Path>) -> Self {
        self.0.path.get_or_insert_with(|| path.as_ref().to_owned());
        self
    }

    /// The line it is on, counted from 1.
    #[must_use]
    pub(crate) fn line(mut self, line: usize) -> Self {
        self.0.line.get_or_insert(line);
        self
    }

    /// What is allowed, or what to do next.
    #[must_use]
    pub fn help(mut self, help: impl Into<Message>) -> Self {
        self.0.help = help.into();
        self
    }

    /// The same fault with another first line.
    #[must_use]
    pub fn rephrased(mut self, what: impl Into<String>) -> Self {
        self.0.what = what.into();
        self
    }

    /// The same fault, of a part that was read by itself, with the part's place in the whole and no other.
    #[must_use]
    pub(crate) fn in_part(mut self, part: impl fmt::Display) -> Self {
        self.0.what = format!("{part}: {}", self.0.what);
        self.without_place()
    }

    /// The same fault without its file and line.
    #[must_use]
    pub(crate) fn without_place(mut self) -> Self {
        (self.0.path, self.0.line) = (None, None);
        self
    }

    /// The same fault of a file below `from` as one of the same file below `to`.
    #[must_use]
    pub(crate) fn moved(mut self, from: &Path, to: &Path) -> Self {
        if let Some(path) = &mut self.0.path
            && let Ok(below) = path.strip_prefix(from)
        {
            *path = to.join(below);
        }
        self
    }

    /// Marks the request, not the input, as what was wrong.
    #[must_use]
    pub(crate) fn of_the_call(mut self) -> Self {
        self.0.call = true;
        self
    }

    /// Whether the request itself was wrong.
    #[must_use]
    pub fn is_of_the_call(&self) -> bool {
        self.0.call
    }

    /// Its kind, where it is of the room whose enum is `K`.
    #[must_use]
    pub fn kind<K: FaultKind>(&self) -> Option<&K> {
        let kind: &dyn Any = &*self.0.kind;
        kind.downcast_ref()
    }

    /// What was found, without place and help.
    #[must_use]
    pub fn what(&self) -> &str {
        &self.0.what
    }

    /// The file it is in, where one is known.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.0.path.as_deref()
    }

    /// The line it is on, where one is known.
    #[must_use]
    pub fn line_number(&self) -> Option<usize> {
        self.0.line
    }

    /// What to do next, as text that names no program and no key; empty where nothing better than the message can be said.
    #[must_use]
    pub fn next_step(&self) -> String {
        self.0.help.to_string()
    }

    /// What to do next, with its steps as data.
    #[must_use]
    pub fn advice(&self) -> &Message {
        &self.0.help
    }

    /// The fault as a message: what, where and the advice after each other.
    #[must_use]
    pub(crate) fn to_message(&self) -> Message {
        let mut head = self.0.what.clone();
        head.push_str(&self.place());
        if self.0.help.is_empty() { head.into() } else { self.0.help.clone().after(head + "\n  ") }
    }

    /// What is wrong, the name of the file it is in, and what to do, in one line.
    #[must_use]
    pub(crate) fn in_a_line(&self) -> Message {
        let mut head = self.0.what.clone();
        let name = self.0.path.as_deref().and_then(Path::file_name).map(|name| name.to_string_lossy());
        if let Some(name) = name.filter(|name| !head.contains(&**name)) {
            head.push_str(&format!(" ({name})"));
        }
        if self.0.help.is_empty() { head.into() } else { self.0.help.clone().after(format!("{head}: ")) }
    }

    /// The printed form, with every step of the advice as `word` puts it.
    #[must_use]
    pub(crate) fn worded(&self, word: &dyn Fn(&NextStep) -> String) -> String {
        printable(&self.to_message().worded(word)).into_owned()
    }

    /// The lines of the place: empty where none is known.
    fn place(&self) -> String {
        match (&self.0.path, self.0.line) {
            (Some(path), Some(line)) => format!("\n  at {}:{line}", shown(path)),
            (Some(path), None) => format!("\n  at {}", shown(path)),
            (None, Some(line)) => format!("\n  at line {line}"),
            (None, None) => String::new(),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.worded(&NextStep::to_string))
    }
}

impl Error for Fault {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.0.source.as_deref().map(|s| s as &(dyn Error + 'static))
    }
}
