//! YUV4MPEG2 (`yuv4mpeg(5)` of the mjpegtools): a line of text, then uncompressed frames. What ffmpeg and most other
//! programs write into a pipe.

use std::io::Read;

use super::{Coded, Frame, MOST_FPS};
use crate::disk::{Fault, FileFault, Result, clean_line};
use crate::photo::Grey;
use crate::photo::Photo;

/// The magic word that a stream begins with.
pub(super) const MAGIC: &[u8] = b"YUV4MPEG2 ";
/// The longest head, and the longest line before a frame.
const LONGEST_LINE: usize = 4096;
/// The widest and highest picture, and the most pixels: 8K.
const MOST_SIDE: usize = 8192;
const MOST_PIXELS: usize = 36 << 20;

/// In which order the lines of a frame were taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scan {
    /// All at once, or not said.
    #[default]
    Progressive,
    /// Every second line half a frame later: what moves has a comb at its edges.
    Interlaced,
}

/// How many pixels share a colour, across and down; none where there is no colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Chroma {
    Mono,
    Shared(usize, usize),
    /// 4:4:4 with a plane of transparency behind.
    WithAlpha,
}

/// What a stream says of itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Head {
    width: usize,
    height: usize,
    fps: f64,
    scan: Scan,
    chroma: Chroma,
    /// Whether luma runs from 0 to 255 instead of 16 to 235.
    full: bool,
}

/// A stream of YUV4MPEG2 that is read.
#[derive(Debug)]
pub struct Y4m<R: Read> {
    input: R,
    head: Head,
    next: u32,
}

impl<R: Read> Y4m<R> {
    /// Reads the head.
    ///
    /// # Errors
    /// When it is none, lacks the size or the frames a second, is larger than 8K, or has more than 8 bits a colour.
    pub fn new(mut input: R) -> Result<Self> {
        let mut magic = [0; MAGIC.len()];
        let got = fill(&mut input, &mut magic)?;
        if got == 0 {
            return Err(Fault::of(FileFault::Empty, "there is no video: the stream is empty")
                .help("does what writes it say why?"));
        }
        if magic[..got] != *MAGIC {
            return Err(Fault::new("this is no YUV4MPEG2 stream")
                .help("make it so: ffmpeg -i VIDEO -f yuv4mpegpipe -pix_fmt yuv420p -"));
        }
        let text = line(&mut input)?.ok_or_else(|| damaged("its head has no end"))?;
        Ok(Self { input, head: Head::parse(&text)?, next: 0 })
    }

    /// Pixels in a row and rows.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.head.width, self.head.height]
    }

    /// Frames a second.
    #[must_use]
    pub fn fps(&self) -> f64 {
        self.head.fps
    }

    /// How its lines were taken.
    #[must_use]
    pub fn scan(&self) -> Scan {
        self.head.scan
    }

    pub(super) fn head(&self) -> Head {
        self.head
    }

    /// A stream whose head is known and of which the rest is read.
    pub(super) fn behind(head: Head, input: R) -> Self {
        Self { input, head, next: 0 }
    }

    pub(super) fn into_input(self) -> R {
        self.input
    }

    /// The next frame; none at the end.
    ///
    /// # Errors
    /// When the stream is cut within a frame or is damaged, with the frame's number.
    pub fn next_frame(&mut self) -> Result<Option<Frame>> {
        let number = self.next;
        let of_frame =
            |fault: Fault| fault.in_part(format_args!("frame {number}")).help("what comes before it is whole");
        let Some(word) = line(&mut self.input).map_err(of_frame)? else { return Ok(None) };
        if word != "FRAME" && !word.starts_with("FRAME ") {
            return Err(of_frame(damaged("no frame begins where one should")));
        }
        let size = self.head.bytes();
        let mut planes = Vec::new();
        let read = (&mut self.input).take(size as u64).read_to_end(&mut planes);
        read.map_err(|e| of_frame(Fault::of(FileFault::OutOfRange, format!("it cannot be read: {e}"))))?;
        if planes.len() < size {
            let what = format!("it is cut: {} of {size} bytes are there", planes.len());
            return Err(of_frame(Fault::new(what)));
        }
        self.next = number.saturating_add(1);
        let time = f64::from(number) / self.head.fps;
        let grey = self.head.grey(&planes);
        Ok(Some(Frame { number, time, grey, colour: Coded::Planes(self.head, planes) }))
    }
}

impl Head {
    fn parse(text: &str) -> Result<Self> {
        let (mut width, mut height, mut fps) = (0, 0, 0.0);
        let (mut scan, mut chroma, mut full) = (Scan::Progressive, Chroma::Shared(2, 2), false);
        for word in text.split_ascii_whitespace() {
            let Some((kind, value)) = word.split_at_checked(1) else { continue };
            match kind {
                "W" => width = side(value, "wide")?,
                "H" => height = side(value, "high")?,
                "F" => fps = rate(value)?,
                "I" => scan = if matches!(value, "t" | "b" | "m") { Scan::Interlaced } else { Scan::Progressive },
                "C" => chroma = Chroma::named(value)?,
                "X" => full |= value.eq_ignore_ascii_case("COLORRANGE=FULL"),
                // The shape of pixels, and what is to come.
                _ => {}
            }
        }
        for (missing, what) in [(width == 0, "width"), (height == 0, "height"), (fps == 0.0, "frame rate")] {
            if missing {
                return Err(damaged(&format!("its head does not say the {what}")));
            }
        }
        if width * height > MOST_PIXELS {
            return Err(Fault::new(format!("a frame has {width} × {height} pixels"))
                .help("more than 8K are not read; scale it down"));
        }
        // The first JPEG-like streams had full range without saying so; ffmpeg says so where it is.
        Ok(Self { width, height, fps, scan, chroma, full })
    }

    /// Bytes of a frame.
    pub(super) fn bytes(&self) -> usize {
        let luma = self.width * self.height;
        match self.chroma {
            Chroma::Mono => luma,
            Chroma::WithAlpha => 4 * luma,
            Chroma::Shared(x, y) => luma + 2 * self.width.div_ceil(x) * self.height.div_ceil(y),
        }
    }

    /// Luma as 0 to 255.
    fn spread(&self, v: u8) -> u8 {
        if self.full { v } else { ((i32::from(v) - 16) * 255 + 109).div_euclid(219).clamp(0, 255) as u8 }
    }

    fn grey(&self, planes: &[u8]) -> Grey {
        let table: [u8; 256] = std::array::from_fn(|v| self.spread(v as u8));
        let luma = planes[..self.width * self.height].iter().map(|v| table[usize::from(*v)]).collect();
        Grey::new(self.width, self.height, luma)
    }

    /// Colours by ITU-R BT.601, which small videos and most pipes have.
    pub(super) fn photo(&self, planes: &[u8]) -> Photo {
        let (w, h) = (self.width, self.height);
        let (across, down) = match self.chroma {
            Chroma::Mono => return self.grey(planes).to_photo(),
            Chroma::WithAlpha => (1, 1),
            Chroma::Shared(x, y) => (x, y),
        };
        let (cw, ch) = (w.div_ceil(across), h.div_ceil(down));
        let (luma, rest) = planes.split_at(w * h);
        let (blue, red) = rest.split_at(cw * ch);
        // Chroma has 224 steps where luma has 219, unless both have all 256.
        let gain = if self.full { 1.0 } else { 255.0 / 224.0 };
        let mut pixels = Vec::with_capacity(w * h);
        for y in 0..h {
            for x in 0..w {
                let at = (y / down) * cw + x / across;
                let l = f32::from(self.spread(luma[y * w + x]));
                let [b, r] = [blue[at], red[at]].map(|c| gain * (f32::from(c) - 128.0));
                let rgb = [l + 1.402 * r, l - 0.344_136 * b - 0.714_136 * r, l + 1.772 * b];
                pixels.push(rgb.map(|v| v.round().clamp(0.0, 255.0) as u8));
            }
        }
        Photo::new(w, h, pixels)
    }
}

impl Chroma {
    fn named(name: &str) -> Result<Self> {
        Ok(match name {
            "420" | "420jpeg" | "420mpeg2" | "420paldv" => Self::Shared(2, 2),
            "411" => Self::Shared(4, 1),
            "422" => Self::Shared(2, 1),
            "444" => Self::Shared(1, 1),
            "444alpha" => Self::WithAlpha,
            "mono" => Self::Mono,
            other => {
                let name = clean_line(other, 20);
                return Err(Fault::new(format!("the stream's colours are `{name}`"))
                    .help("8 bits are read: give ffmpeg -pix_fmt yuv420p"));
            }
        })
    }
}

fn side(text: &str, what: &str) -> Result<usize> {
    let pixels = text.parse::<usize>().ok().filter(|n| (1..=MOST_SIDE).contains(n));
    pixels.ok_or_else(|| {
        let found = clean_line(text, 20);
        Fault::new(format!("a frame is `{found}` pixels {what}")).help(format!("1 to {MOST_SIDE} are read"))
    })
}

/// Frames a second as a fraction, `30000:1001`.
fn rate(text: &str) -> Result<f64> {
    let fraction = text.split_once(':').and_then(|(n, d)| Some((n.parse::<u32>().ok()?, d.parse::<u32>().ok()?)));
    let fps = fraction.map(|(n, d)| f64::from(n) / f64::from(d)).filter(|f| (0.1..=MOST_FPS).contains(f));
    fps.ok_or_else(|| {
        let found = clean_line(text, 20);
        Fault::new(format!("the stream's frame rate is `{found}`")).help("give it one, such as ffmpeg -r 25")
    })
}

fn damaged(what: &str) -> Fault {
    Fault::new(format!("the YUV4MPEG2 stream is damaged: {what}")).help("make it again")
}

/// A line without its end; none where the stream ends before its first byte.
fn line(input: &mut impl Read) -> Result<Option<String>> {
    let mut text = Vec::new();
    let mut byte = [0];
    loop {
        if fill(input, &mut byte)? == 0 {
            return if text.is_empty() { Ok(None) } else { Err(damaged("it is cut within a line")) };
        }
        if byte[0] == b'\n' {
            return Ok(Some(String::from_utf8_lossy(&text).into_owned()));
        }
        if text.len() == LONGEST_LINE {
            return Err(damaged("a line of text has no end"));
        }
        text.push(byte[0]);
    }
}

/// Reads until the buffer is full or the stream ends; how much came.
fn fill(input: &mut impl Read, buffer: &mut [u8]) -> Result<usize> {
    let mut got = 0;
    while got < buffer.len() {
        match input.read(&mut buffer[got..]) {
            Ok(0) => break,
            Ok(n) => got += n,
            Err(e) if e.kind() == std::io::ErrorKind::Interrupted => {}
            Err(e) => return Err(Fault::of(FileFault::OutOfRange, format!("the video cannot be read: {e}"))),
        }
    }
    Ok(got)
}
