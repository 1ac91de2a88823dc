//! The terminal: taken over, drawn on with one write a frame, and given back however the program ends.

use std::borrow::Cow;
use std::cell::RefCell;
use std::fs::File;
use std::io::{self, IsTerminal, Write};
use std::os::fd::AsFd;
use std::rc::Rc;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use crossterm::cursor::Show;
use crossterm::event::{DisableBracketedPaste, EnableBracketedPaste};
use crossterm::terminal::{
    BeginSynchronizedUpdate, Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen,
    disable_raw_mode, enable_raw_mode, size,
};
use crossterm::{QueueableCommand, queue};
use ratatui::backend::CrosstermBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::{Frame, Terminal, TerminalOptions, Viewport};

use crate::disk::{Fault, Result, clean, printable};

/// Whether the terminal is ours: whoever gives it back first does so, and only once.
static TAKEN: AtomicBool = AtomicBool::new(false);

/// The terminal while it is ours. Dropping it gives it back.
pub(in crate::studio) struct Screen {
    terminal: Terminal<CrosstermBackend<Gathered>>,
    gathered: Gathered,
    out: File,
}

/// What is to be written, gathered until a frame is complete.
#[derive(Clone, Default)]
struct Gathered(Rc<RefCell<Vec<u8>>>);

impl Write for Gathered {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    /// Nothing: the frame is written when it is whole.
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn fault(error: io::Error) -> Fault {
    Fault::io("cannot use the terminal", "the terminal", error)
}

impl Screen {
    /// Whether there is a terminal to take. Standard input may be a file or a pipe, such as the record that is played:
    /// keys come from the terminal itself then.
    pub(crate) fn is_there() -> bool {
        let opens = || File::options().read(true).write(true).open("/dev/tty").is_ok();
        io::stdout().is_terminal() && (io::stdin().is_terminal() || opens())
    }

    /// Takes the terminal over.
    pub(crate) fn take() -> Result<Self> {
        give_back_on_panic();
        let out = standard_output().map_err(fault)?;
        enable_raw_mode().map_err(fault)?;
        TAKEN.store(true, Ordering::SeqCst);
        let mut gathered = Gathered::default();
        queue!(gathered, EnterAlternateScreen, EnableBracketedPaste).map_err(fault)?;
        let (width, height) = size().map_err(fault)?;
        let terminal = Self::of_size(&gathered, width, height)?;
        Ok(Self { terminal, gathered, out })
    }

    /// Starts anew at a size: what was on the screen is forgotten. The terminal is never asked anything: an answer
    /// would come in among the keys.
    fn of_size(gathered: &Gathered, width: u16, height: u16) -> Result<Terminal<CrosstermBackend<Gathered>>> {
        gathered.clone().queue(Clear(ClearType::All)).map_err(fault)?;
        let viewport = Viewport::Fixed(Rect::new(0, 0, width, height));
        Terminal::with_options(CrosstermBackend::new(gathered.clone()), TerminalOptions { viewport }).map_err(fault)
    }

    /// Takes the terminal's size as it is now, and draws everything anew with the next frame.
    pub(crate) fn anew(&mut self) -> Result<()> {
        let (width, height) = size().map_err(fault)?;
        self.terminal = Self::of_size(&self.gathered, width, height)?;
        Ok(())
    }

    /// Draws a frame and writes what has changed, at once.
    pub(crate) fn draw(&mut self, render: impl FnOnce(&mut Frame<'_>)) -> Result<()> {
        // The beginning of the frame stands before a clear that waits to be written with it.
        let waiting = std::mem::take(&mut *self.gathered.0.borrow_mut());
        self.gathered.queue(BeginSynchronizedUpdate).map_err(fault)?;
        self.gathered.write_all(&waiting).map_err(fault)?;
        let drawn = self.terminal.draw(|frame| {
            render(frame);
            clean_cells(frame.buffer_mut());
        });
        drawn.map_err(fault)?;
        self.gathered.queue(EndSynchronizedUpdate).map_err(fault)?;
        let bytes = std::mem::take(&mut *self.gathered.0.borrow_mut());
        self.out.write_all(&bytes).map_err(fault)
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        give_back();
    }
}

/// Frees every cell from what the cleaner knows, for names of files and words of programs are shown as they come. What is
/// left of a cell keeps its place.
fn clean_cells(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        let symbol = cell.symbol();
        // Most are a letter of ASCII.
        let is_plain = symbol.len() == 1 && !symbol.contains(char::is_control);
        if !is_plain && matches!(printable(symbol), Cow::Owned(_)) {
            let left = clean(symbol);
            cell.set_symbol(if left.is_empty() { " " } else { &left });
        }
    }
}

/// Gives the terminal back: the screen it had, its cursor, its own way with keys. Safe to call from anywhere and
/// more than once.
pub(in crate::studio) fn give_back() {
    if !TAKEN.swap(false, Ordering::SeqCst) {
        return;
    }
    let mut bytes = Vec::new();
    let _ = queue!(bytes, EndSynchronizedUpdate, DisableBracketedPaste, LeaveAlternateScreen, Show);
    if let Ok(mut out) = standard_output() {
        let _ = out.write_all(&bytes);
    }
    let _ = disable_raw_mode();
}

/// Standard output without the lock and the buffer of the standard library: whoever called may hold that lock, and a
/// frame is to be one write.
fn standard_output() -> io::Result<File> {
    Ok(File::from(io::stdout().as_fd().try_clone_to_owned()?))
}

/// A panic's message belongs on the screen that stays.
fn give_back_on_panic() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let usual = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            // A worker's panic is caught and reported; only the thread that draws takes the program with it.
            if std::thread::current().name() == Some("main") {
                give_back();
                usual(panic);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_shows_no_control_character_and_few_marks() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 6, 1));
        let flood = format!("e{}", "\u{316}".repeat(3000));
        for (x, symbol) in ["a", "\u{1b}", "\u{9b}", "\u{202e}", &flood, "▀"].into_iter().enumerate() {
            buffer[(x as u16, 0)].set_symbol(symbol);
        }
        clean_cells(&mut buffer);
        let shown: Vec<&str> = buffer.content.iter().map(|cell| cell.symbol()).collect();
        assert_eq!(shown, ["a", " ", " ", " ", &format!("e{}", "\u{316}".repeat(8)), "▀"]);
    }
}
