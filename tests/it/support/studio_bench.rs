//! A studio on a bench: a lesson to open, keys that go in as text, screens that come out as text.

use std::path::Path;

use lianpu::disk::Fault;
use lianpu::project::{AlignJob, Clip};
use lianpu::speech::{Alignment, Note, SpokenPhone, SpokenSyllable};
use lianpu::studio::{Aligner, Colours, Exporter, FaceDesk, FaceScreen, SharedEditor, Studio, Tapping, TappingScreen};
use lianpu::timeline::{KeyValue, Track};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use unicode_width::UnicodeWidthStr;

/// A lesson of two syllables, 1.6 s long. `times` are those of its syllables; without them they are guessed.
pub fn lesson(root: &Path, times: Option<[(f64, f64); 2]>, more: &[(&str, &str)]) {
    let clip = root.join("clips/nihao");
    std::fs::create_dir_all(&clip).unwrap();
    let manifest = "format = 1\ntitle = \"您好\"\n\n[[clip]]\nname = \"nihao\"\nscript_system = \"han\"\n";
    std::fs::write(root.join("lianpu.toml"), manifest).unwrap();
    std::fs::write(clip.join("script.txt"), "您好。\n").unwrap();
    let spec =
        hound::WavSpec { channels: 1, sample_rate: 8000, bits_per_sample: 16, sample_format: hound::SampleFormat::Int };
    let mut wav = hound::WavWriter::create(clip.join("speech.wav"), spec).unwrap();
    for i in 0..12_800 {
        let t = f64::from(i) / 8000.0;
        let loud = if (0.3..0.75).contains(&t) {
            0.3
        } else if (0.77..1.28).contains(&t) {
            0.6
        } else {
            0.0
        };
        wav.write_sample((loud * (t * 200.0 * std::f64::consts::TAU).sin() * 32_000.0) as i16).unwrap();
    }
    wav.finalize().unwrap();
    if let Some([a, b]) = times {
        let grid = format!(
            "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0\nxmax = 1.6\ntiers? <exists>\nsize = 1\n\
             item []:\n    item [1]:\n        class = \"IntervalTier\"\n        name = \"syllables\"\n        xmin = 0\n        xmax = 1.6\n        \
             intervals: size = 2\n        intervals [1]:\n            xmin = {}\n            xmax = {}\n            text = \"nin2\"\n        \
             intervals [2]:\n            xmin = {}\n            xmax = {}\n            text = \"hao3\"\n",
            a.0, a.1, b.0, b.1
        );
        std::fs::write(clip.join("timing.TextGrid"), grid).unwrap();
    }
    for (name, text) in more {
        std::fs::write(clip.join(name), text).unwrap();
    }
}

pub const TIMES: [(f64, f64); 2] = [(0.3, 0.75), (0.77, 1.28)];
pub const TOUCHING: [(f64, f64); 2] = [(0.3, 0.75), (0.75, 1.28)];

/// What an aligner might find of the lesson: 好 is not sure, and something follows that the script does not have.
pub fn found() -> Alignment {
    let phone = |phone, start, end| SpokenPhone { phone, start, end };
    Alignment {
        syllables: vec![
            SpokenSyllable {
                start: 0.31,
                end: 0.74,
                confidence: 0.97,
                heard: true,
                phones: vec![phone("n", 0.31, 0.4), phone("i", 0.4, 0.6), phone("n", 0.6, 0.74)],
            },
            SpokenSyllable {
                start: 0.78,
                end: 1.12,
                confidence: 0.41,
                heard: true,
                phones: vec![phone("h", 0.78, 0.86), phone("a", 0.86, 1.0), phone("o", 1.0, 1.12)],
            },
        ],
        notes: vec![Note::NotInScript { before: 2, start: 1.2, end: 1.5 }],
    }
}

pub const SCORE: (&str, &str) = (
    "score.toml",
    "seed = 5\n\n[[key]]\ntrack = \"emotion\"\ntime = 0.0\nvalue = { neutral = 1.0 }\n\n[[key]]\ntrack = \"emotion\"\n\
     time = 0.6\nvalue = { surprised = 0.35 }\n\n[[key]]\ntrack = \"emotion\"\ntime = 1.12\nvalue = { surprised = 0.9 }\n\n\
     [[key]]\ntrack = \"blink\"\ntime = 0.28\nvalue = 0.22\n",
);

/// A studio that is being used.
pub struct Bench {
    pub studio: Studio,
    pub dir: tempfile::TempDir,
}

impl Bench {
    /// The timeline of the only clip of a lesson.
    pub fn new(times: Option<[(f64, f64); 2]>, more: &[(&str, &str)]) -> Self {
        Self::with(times, more, Box::new(|_, _, _| Ok(lianpu::export::CourseReport::default())))
    }

    pub fn with(times: Option<[(f64, f64); 2]>, more: &[(&str, &str)], exporter: Exporter) -> Self {
        let dir = tempfile::tempdir().unwrap();
        lesson(&dir.path().join("nihao"), times, more);
        let studio = Studio::new(dir.path(), Colours::None, exporter).unwrap();
        // The tones of this lesson are no voice.
        let deaf = Aligner::new(|_| vec![(0, Err(Fault::new("no voice is heard").help("record it again")))]);
        let mut bench = Self { studio: studio.with_aligner(deaf), dir };
        bench.keys("Enter Enter");
        bench
    }

    /// The same with an aligner that finds this.
    pub fn aligning(times: Option<[(f64, f64); 2]>, found: Alignment) -> Self {
        let dir = tempfile::tempdir().unwrap();
        lesson(&dir.path().join("nihao"), times, &[]);
        let studio =
            Studio::new(dir.path(), Colours::None, Box::new(|_, _, _| Ok(lianpu::export::CourseReport::default())))
                .unwrap();
        let aligner = Aligner::new(move |_: &AlignJob| vec![(0, Ok(found.clone()))]);
        let mut bench = Self { studio: studio.with_aligner(aligner), dir };
        bench.keys("Enter Enter");
        bench
    }

    /// Presses keys, as the table calls them, with spaces between; `'…'` is typed letter by letter.
    pub fn keys(&mut self, keys: &str) -> &mut Self {
        for (index, part) in keys.split('\'').enumerate() {
            let names: Vec<String> = match index % 2 {
                0 => part.split_whitespace().map(str::to_owned).collect(),
                _ => part.chars().map(|c| if c == ' ' { "Space".into() } else { c.to_string() }).collect(),
            };
            for name in names {
                self.studio.key(&name);
                self.studio.settle();
            }
        }
        self
    }

    /// The clip on the timeline.
    pub fn clip(&self) -> Clip {
        let number = self.editor().borrow().clip;
        self.studio.project().unwrap().borrow().lesson.clips[number].clone()
    }

    /// The editor of the clip on the timeline.
    pub fn editor(&self) -> SharedEditor {
        self.studio.editor().unwrap()
    }

    /// The page of a face.
    pub fn face(&self) -> &FaceDesk {
        &self.studio.stack.find::<FaceScreen>().unwrap().desk
    }

    /// What is being tapped.
    pub fn tapping(&self) -> Option<&Tapping> {
        self.studio.stack.find::<TappingScreen>().map(|screen| &screen.tapping)
    }

    /// Whether a box lies on top of the page.
    pub fn has_box(&self) -> bool {
        !self.studio.stack.screens.last().unwrap().is_page()
    }

    pub fn times(&self) -> Vec<(f64, f64)> {
        self.clip().intervals().iter().map(|i| (i.start, i.end)).collect()
    }

    pub fn cursor(&self) -> f64 {
        self.editor().borrow().cursor
    }

    pub fn message(&self) -> String {
        self.studio.shell().message.as_ref().map_or(String::new(), |m| m.text.clone())
    }

    pub fn keys_of(&self, track: Track) -> Vec<(f64, KeyValue)> {
        let clip = self.clip();
        clip.score.sorted_keys().filter(|k| k.value.track() == track).map(|k| (k.time, k.value)).collect()
    }

    pub fn screen(&mut self, width: u16, height: u16) -> String {
        let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
        terminal.draw(|frame| self.studio.draw(frame)).unwrap();
        let folder = self.dir.path().display().to_string();
        text_of(terminal.backend().buffer()).replace(&folder, "FOLDER")
    }

    pub fn file(&self, name: &str) -> String {
        std::fs::read_to_string(self.dir.path().join("nihao/clips/nihao").join(name)).unwrap_or_default()
    }
}

/// A screen as text: wide letters take two cells, ends of lines are cut.
pub fn text_of(buffer: &Buffer) -> String {
    let mut text = String::new();
    for y in 0..buffer.area.height {
        let (mut line, mut x) = (String::new(), 0);
        while x < buffer.area.width {
            let symbol = buffer[(x, y)].symbol();
            line.push_str(symbol);
            x += (symbol.width() as u16).max(1);
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
