//! The real program in a real pseudo-terminal, its output read by a terminal's own rules.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop and speak")]

use std::io::{Read, Write};
use std::num::NonZero;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};

/// A terminal with the program in it.
struct Terminal {
    child: Box<dyn Child + Send + Sync>,
    master: Option<Box<dyn MasterPty + Send>>,
    input: Option<Box<dyn Write + Send>>,
    seen: Arc<Mutex<(vt100::Parser, Vec<u8>)>>,
    reader: Option<std::thread::JoinHandle<()>>,
    deaf: Arc<AtomicBool>,
}

impl Terminal {
    fn start(folder: &Path, width: u16, height: u16, more: &[(&str, &str)]) -> Self {
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_lianpu"));
        command.arg(folder);
        Self::of(command, width, height, more)
    }

    fn of(mut command: CommandBuilder, width: u16, height: u16, more: &[(&str, &str)]) -> Self {
        let pair = native_pty_system()
            .openpty(PtySize { rows: height, cols: width, pixel_width: 0, pixel_height: 0 })
            .unwrap();
        command.env("TERM", "xterm-256color");
        command.env("COLORTERM", "truecolor");
        command.env_remove("NO_COLOR");
        for (name, value) in more {
            command.env(name, value);
        }
        let child = pair.slave.spawn_command(command).unwrap();
        drop(pair.slave);
        let mut output = pair.master.try_clone_reader().unwrap();
        let input = pair.master.take_writer().unwrap();
        let side = |n| NonZero::new(n).unwrap();
        let seen = Arc::new(Mutex::new((vt100::Parser::new(side(height), side(width), 0), Vec::new())));
        let to = Arc::clone(&seen);
        let deaf = Arc::new(AtomicBool::new(false));
        let is_deaf = Arc::clone(&deaf);
        let reader = std::thread::spawn(move || {
            let mut buffer = [0; 65_536];
            while let Ok(count @ 1..) = output.read(&mut buffer) {
                let mut to = to.lock().unwrap();
                to.0.process(&buffer[..count]);
                to.1.extend_from_slice(&buffer[..count]);
                if is_deaf.load(Ordering::SeqCst) {
                    return;
                }
            }
        });
        Self { child, master: Some(pair.master), input: Some(input), seen, reader: Some(reader), deaf }
    }

    fn send(&mut self, bytes: &str) {
        let input = self.input.as_mut().unwrap();
        input.write_all(bytes.as_bytes()).unwrap();
        input.flush().unwrap();
    }

    fn screen(&self) -> String {
        self.seen.lock().unwrap().0.screen().contents()
    }

    fn bytes(&self) -> usize {
        self.seen.lock().unwrap().1.len()
    }

    /// Waits until the screen is as it should be, and says what it was if it never is.
    fn until(&self, what: &str, holds: impl Fn(&str) -> bool) {
        let start = Instant::now();
        while !holds(&self.screen()) {
            assert!(start.elapsed() < Duration::from_secs(20), "never saw {what}:\n{}", self.screen());
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// Waits until nothing is written any more; how many bytes there are.
    fn still(&self) -> usize {
        let mut before = self.bytes();
        loop {
            std::thread::sleep(Duration::from_millis(150));
            let now = self.bytes();
            if now == before {
                return now;
            }
            before = now;
        }
    }

    /// The terminal goes away, as when a connection is lost. Its reader lets go with the next thing that it reads.
    fn hang_up(&mut self) {
        self.deaf.store(true, Ordering::SeqCst);
        self.send("?");
        self.reader.take().unwrap().join().unwrap();
        self.input = None;
        self.master = None;
    }

    fn ends(&mut self) -> bool {
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(10) {
            if self.child.try_wait().unwrap().is_some() {
                std::thread::sleep(Duration::from_millis(50));
                return true;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        let _ = self.child.kill();
        false
    }

    fn is_given_back(&self) -> bool {
        let seen = self.seen.lock().unwrap();
        !seen.0.screen().alternate_screen() && !seen.0.screen().hide_cursor() && !seen.0.screen().bracketed_paste()
    }
}

/// When the two syllables are said.
const TIMES: &str = "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\n0\n1.6\n<exists>\n1\n\"IntervalTier\"\n\
                     \"syllables\"\n0\n1.6\n2\n0.3\n0.75\n\"nin2\"\n0.77\n1.28\n\"hao3\"\n";

fn lessons() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    let clip = dir.path().join("nihao/clips/nihao");
    std::fs::create_dir_all(&clip).unwrap();
    let manifest = "format = 1\ntitle = \"您好\"\n\n[[clip]]\nname = \"nihao\"\nscript_system = \"han\"\n";
    std::fs::write(dir.path().join("nihao/lianpu.toml"), manifest).unwrap();
    std::fs::write(clip.join("script.txt"), "您好。\n").unwrap();
    std::fs::write(clip.join("timing.TextGrid"), TIMES).unwrap();
    let score = "[[key]]\ntrack = \"emotion\"\ntime = 0.0\nvalue = { neutral = 1.0 }\n\n[[key]]\ntrack = \"emotion\"\ntime = 1.1\nvalue = { surprised = 0.9 }\n";
    std::fs::write(clip.join("score.toml"), score).unwrap();
    let spec =
        hound::WavSpec { channels: 1, sample_rate: 8000, bits_per_sample: 16, sample_format: hound::SampleFormat::Int };
    let mut wav = hound::WavWriter::create(clip.join("speech.wav"), spec).unwrap();
    for i in 0..12_800 {
        let t = f64::from(i) / 8000.0;
        let loud = if (0.3..1.3).contains(&t) { (t * 9.0).sin().abs() } else { 0.0 };
        wav.write_sample((loud * (t * 200.0 * std::f64::consts::TAU).sin() * 30_000.0) as i16).unwrap();
    }
    wav.finalize().unwrap();
    dir
}

#[test]
fn the_program_opens_lessons_shows_and_edits_a_timeline_and_gives_the_terminal_back() {
    let dir = lessons();
    let mut terminal = Terminal::start(dir.path(), 80, 24, &[]);
    terminal.until("the lessons", |s| s.contains("nihao") && s.contains("您好"));
    assert!(!terminal.is_given_back());
    terminal.send("\r");
    terminal.until("the lesson", |s| s.contains("What is there"));
    terminal.send("\r");
    terminal.until("the timeline", |s| s.contains("seconds") && s.contains("hao3"));
    terminal.until("the sound", |s| !s.contains("reading the sound"));
    terminal.send("?");
    terminal.until("the help", |s| s.contains("Esc closes"));
    terminal.send("?");
    terminal.until("no help", |s| !s.contains("Esc closes"));
    terminal.send("\t]");
    terminal.until("an edit", |s| s.contains("unsaved") && s.contains("starts at"));
    terminal.send("u");
    terminal.until("it undone", |s| s.contains("undone") && !s.contains("unsaved"));
    terminal.send(" ");
    terminal.until("playing", |s| s.contains("without sound"));
    terminal.until("its end", |s| s.contains("frame 39"));
    terminal.send("qqq");
    assert!(terminal.ends() && terminal.is_given_back());
}

#[test]
fn a_step_of_the_cursor_is_a_few_hundred_bytes_and_rest_is_none() {
    let dir = lessons();
    let mut terminal = Terminal::start(dir.path(), 80, 24, &[]);
    terminal.send("\r");
    terminal.until("the lesson", |s| s.contains("What is there"));
    terminal.send("\r");
    terminal.until("the timeline", |s| s.contains("hao3") && !s.contains("reading the sound"));
    let mut sizes = Vec::new();
    let mut before = terminal.still();
    let whole = before;
    for _ in 0..30 {
        terminal.send("l");
        let now = terminal.still();
        sizes.push(now - before);
        before = now;
    }
    let mean = sizes.iter().sum::<usize>() / sizes.len();
    println!("first screens {whole} bytes; steps {sizes:?}, {mean} on average");
    assert!(mean <= 800, "{sizes:?}");
    std::thread::sleep(Duration::from_millis(600));
    assert_eq!(terminal.bytes(), before, "nothing is drawn when nothing moves");
    terminal.send("~");
    std::thread::sleep(Duration::from_millis(200));
    assert_eq!(terminal.bytes(), before, "a key that means nothing draws nothing");
    terminal.send("qqq");
    assert!(terminal.ends());
}

#[test]
fn a_step_over_frequencies_and_pitch_is_no_more_and_a_page_of_them_some_thousand_bytes() {
    let dir = lessons();
    let mut terminal = Terminal::start(dir.path(), 80, 24, &[]);
    terminal.send("\r");
    terminal.until("the lesson", |s| s.contains("What is there"));
    terminal.send("\r");
    terminal.until("the timeline", |s| s.contains("hao3") && !s.contains("reading the sound"));
    let before = terminal.still();
    terminal.send("SP");
    terminal.until("the lanes", |s| s.contains("spectrum") && s.contains("Hz") && !s.contains("listening"));
    let whole = terminal.still() - before;
    let (mut sizes, mut before) = (Vec::new(), terminal.still());
    for _ in 0..20 {
        terminal.send("l");
        let now = terminal.still();
        sizes.push(now - before);
        before = now;
    }
    let mean = sizes.iter().sum::<usize>() / sizes.len();
    println!("the lanes {whole} bytes; steps {sizes:?}, {mean} on average");
    assert!(mean <= 900 && whole < 16_000, "{whole} {sizes:?}");
    std::thread::sleep(Duration::from_millis(400));
    assert_eq!(terminal.bytes(), before, "nothing is drawn when nothing moves");
    terminal.send("qqq");
    assert!(terminal.ends());
}

#[test]
fn with_no_color_there_is_no_colour_code_at_all() {
    let dir = lessons();
    let mut terminal = Terminal::start(dir.path(), 80, 24, &[("NO_COLOR", "1")]);
    terminal.send("\r");
    terminal.until("the lesson", |s| s.contains("What is there"));
    terminal.send("\r");
    terminal.until("the timeline", |s| s.contains("hao3"));
    terminal.send("\t]r");
    terminal.until("the prompt", |s| s.contains("How is"));
    terminal.send("\x1b");
    terminal.until("no prompt", |s| !s.contains("How is"));
    terminal.send("\x03d");
    assert!(terminal.ends() && terminal.is_given_back());
    let bytes = terminal.seen.lock().unwrap().1.clone();
    let text = String::from_utf8_lossy(&bytes).into_owned();
    for sequence in text.split("\x1b[").skip(1) {
        let Some(end) = sequence.find(|c: char| c.is_ascii_alphabetic()) else { continue };
        if sequence[end..].starts_with('m') {
            let of_colour =
                |p: &str| p.parse::<u32>().is_ok_and(|n| (30..=38).contains(&n) || (40..=48).contains(&n) || n >= 90);
            assert!(!sequence[..end].split([';', ':']).any(of_colour), "{:?}", &sequence[..end]);
        }
    }
}

#[test]
fn a_signal_gives_the_terminal_back_and_the_changes_wait_in_the_journal() {
    let dir = lessons();
    for signal in ["TERM", "HUP"] {
        let mut terminal = Terminal::start(dir.path(), 80, 24, &[]);
        terminal.send("\r");
        terminal.until("the lesson", |s| s.contains("What is there"));
        terminal.send("\r");
        terminal.until("the timeline", |s| s.contains("seconds"));
        terminal.send("\t]");
        terminal.until("an edit", |s| s.contains("starts at"));
        let id = terminal.child.process_id().unwrap().to_string();
        assert!(std::process::Command::new("kill").args([&format!("-{signal}"), &id]).status().unwrap().success());
        assert!(terminal.ends() && terminal.is_given_back(), "{signal}");
    }
    let mut terminal = Terminal::start(dir.path(), 80, 24, &[]);
    terminal.send("\r");
    terminal.until("the changes", |s| s.contains("2 unsaved changes"));
    terminal.hang_up();
    assert!(terminal.ends(), "a program without its terminal ends instead of spinning");
}

#[test]
fn a_record_from_a_pipe_is_played_and_keys_still_come_from_the_terminal() {
    let dir = lessons();
    let rows: String = (0..40).map(|i| format!("{i},{:.2},1,0,0,0,0,0,0,1\n", f64::from(i) * 0.04)).collect();
    let record = format!("frame,time,neutral,happy,anger,disgust,sadness,fear,surprised,confidence\n{rows}");
    std::fs::write(dir.path().join("ratios.csv"), record).unwrap();
    let mut command = CommandBuilder::new("sh");
    command.cwd(dir.path());
    command.args(["-c", &format!("cat ratios.csv | '{}' play --ratios -", env!("CARGO_BIN_EXE_lianpu"))]);
    let mut terminal = Terminal::of(command, 80, 24, &[]);
    terminal.until("the player", |s| s.contains("of 1.60 s") || s.contains("of 1.56 s"));
    terminal.send(" ");
    terminal.until("it stopped", |s| s.contains("stopped"));
    terminal.send("q");
    assert!(terminal.ends() && terminal.is_given_back());
}

#[test]
fn without_a_terminal_the_program_prints_its_help() {
    let output =
        std::process::Command::new(env!("CARGO_BIN_EXE_lianpu")).stdin(std::process::Stdio::null()).output().unwrap();
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stdout).contains("Usage"));
}

/// The program in a terminal with standard input from a shell's pipe.
fn piped(folder: &Path, producer: &str, more: &str) -> Terminal {
    let mut command = CommandBuilder::new("sh");
    command.cwd(folder);
    command.args([
        "-c",
        &format!("{producer} | '{}' play --ratios - {more}; echo \"exit $?\"", env!("CARGO_BIN_EXE_lianpu")),
    ]);
    Terminal::of(command, 80, 24, &[])
}

#[test]
fn a_record_is_drawn_as_it_arrives_ends_with_its_pipe_and_says_when_it_was_cut() {
    use lianpu::pose::{Emotion, Ratios};
    use lianpu::ratios::{LprWriter, Moment, Row};
    let dir = tempfile::tempdir().unwrap();
    let moment = |n: u32| Moment {
        row: Row {
            frame: n,
            time: f64::from(n) * 0.04,
            ratios: Ratios::some(Emotion::Happy, f64::from(n) / 40.0),
            confidence: 1.0,
        },
        track: None,
    };
    let mut writer = LprWriter::new(Vec::new(), 25.0, false).unwrap();
    for n in 0..40 {
        writer.push(&moment(n)).unwrap();
    }
    let bytes = writer.finish().unwrap();
    std::fs::write(dir.path().join("first.lpr"), &bytes[..bytes.len() / 2]).unwrap();
    std::fs::write(dir.path().join("rest.lpr"), &bytes[bytes.len() / 2..]).unwrap();
    std::fs::write(dir.path().join("cut.lpr"), &bytes[..bytes.len() - 5]).unwrap();
    // Whoever records pauses for good: what came is drawn, and keys come from the terminal.
    let mut terminal = piped(dir.path(), "(cat first.lpr; sleep 30; cat rest.lpr)", "--figure cat");
    terminal.until("the first half", |s| s.contains("s, arriving") && !s.contains("0.00 s"));
    terminal.send(" ");
    terminal.until("it stopped", |s| s.contains("stopped"));
    terminal.send("q");
    let start = Instant::now();
    while !terminal.is_given_back() {
        assert!(start.elapsed() < Duration::from_secs(5), "q leaves although the pipe is open");
        std::thread::sleep(Duration::from_millis(10));
    }
    drop(terminal.child.kill());
    // A whole record ends by itself, and a cut one says so.
    let mut terminal = piped(dir.path(), "cat first.lpr rest.lpr", "");
    terminal.until("the end", |s| s.contains("exit 0"));
    assert!(terminal.ends() && terminal.is_given_back());
    let mut terminal = piped(dir.path(), "cat cut.lpr", "");
    terminal.until("the damage", |s| s.contains("exit 1"));
    let screen = terminal.screen().replace('\n', " ");
    assert!(screen.contains("cut off after frame 39") && screen.contains("40 frames were played"), "{screen}");
    assert!(terminal.ends());
}

/// All files below a folder but manifests' own state, by path.
fn files_in(folder: &Path) -> std::collections::BTreeMap<String, Vec<u8>> {
    let mut all = std::collections::BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            all.extend(files_in(&entry.path()).into_iter().map(|(path, bytes)| (format!("{name}/{path}"), bytes)));
        } else {
            all.insert(name, std::fs::read(entry.path()).unwrap());
        }
    }
    all
}

/// The sample lesson without times and score, exported before, and a subtitle of that export changed by hand.
fn changed_lesson_without_times(parent: &Path) -> std::path::PathBuf {
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join("projects/nihao");
    let root = parent.join("nihao");
    for (path, bytes) in files_in(&sample) {
        if path.starts_with("export")
            || path.starts_with('.')
            || path.ends_with("score.toml")
            || path.ends_with("TextGrid")
        {
            continue;
        }
        std::fs::create_dir_all(root.join(&path).parent().unwrap()).unwrap();
        std::fs::write(root.join(&path), bytes).unwrap();
    }
    exported(&root);
    std::fs::write(root.join("export/nihao.srt"), "1\n00:00:00,000 --> 00:00:01,000\nmine\n").unwrap();
    root
}

/// Exports a project by the command line, without ffmpeg. Its notes.
fn exported(root: &Path) -> Vec<String> {
    let done = std::process::Command::new(env!("CARGO_BIN_EXE_lianpu"))
        .args(["export", root.to_str().unwrap(), "--to", "srt,epub,html,vtt"])
        .env("PATH", "/nonexistent")
        .output()
        .unwrap();
    let errors = String::from_utf8(done.stderr).unwrap();
    assert!(done.status.success(), "{errors}");
    errors.lines().filter_map(|line| line.strip_prefix("note: ")).map(str::to_owned).collect()
}

#[test]
fn studio_and_command_line_export_the_same_bytes_and_notes() {
    let (one, two) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (by_command, by_studio) = (changed_lesson_without_times(one.path()), changed_lesson_without_times(two.path()));
    let notes = exported(&by_command);
    assert_eq!(notes.len(), 4, "times, the changed file, FLAC, no sound in the book: {notes:#?}");
    let mut terminal = Terminal::start(&by_studio, 200, 50, &[("PATH", "/nonexistent")]);
    terminal.until("the lesson", |screen| screen.contains("nihao") && screen.contains("export"));
    terminal.send("e");
    terminal.until("the prompt", |screen| screen.contains("Export"));
    terminal.send("\u{15}srt epub html vtt\r");
    terminal.until("its end", |screen| screen.contains(" written, "));
    let squeeze = |text: &str| text.chars().filter(|c| !c.is_whitespace() && !"│·".contains(*c)).collect::<String>();
    let screen = squeeze(&terminal.screen());
    for note in notes {
        let note = note.replace("`lianpu align`", "`A`");
        assert!(screen.contains(&squeeze(&note)), "{note} is not in\n{}", terminal.screen());
    }
    assert_eq!(files_in(&by_studio.join("export")), files_in(&by_command.join("export")));
    assert!(by_studio.join("export/nihao.srt~").is_file());
    terminal.send("\u{1b}q");
}
