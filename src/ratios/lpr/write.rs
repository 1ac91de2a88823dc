//! Writing a compact record.

use std::io::Write;

use super::coder::Encoder;
use super::frame::State;
use super::{MAGIC, MAX_FPS, MAX_FRAMES, MAX_PAYLOAD, Moment, VERSION};
use crate::disk::{Fault, FileFault, Result};

/// A frame never takes more bytes than this, so that a payload is closed in time.
const FRAME_ROOM: usize = 1024;

/// Writes a compact record as its frames come. Each frame goes out at once, as live use needs it, unless larger packets
/// are [asked for](Self::in_packets_of).
#[derive(Debug)]
pub struct LprWriter<W: Write> {
    out: W,
    state: State,
    /// Frames to a packet.
    size: u32,
    packet: Encoder,
    /// Frames in the packet that is open.
    open: u32,
    /// The last check sum.
    check: u32,
}

impl<W: Write> LprWriter<W> {
    /// Begins a record of so many frames a second; with or without tracks.
    ///
    /// # Errors
    /// When it cannot be written, or `fps` is not above 0 and at most 10,000.
    pub fn new(mut out: W, fps: f64, with_tracks: bool) -> Result<Self> {
        if !fps.is_finite() || fps <= 0.0 || fps > MAX_FPS {
            return Err(Fault::of(FileFault::OutOfRange, format!("a record cannot have {fps} frames a second"))
                .help("give a number from 1 to 240"));
        }
        let mut head = MAGIC.to_vec();
        head.extend([VERSION, u8::from(with_tracks)]);
        head.extend(fps.to_le_bytes());
        let check = crc32fast::hash(&head);
        head.extend(check.to_le_bytes());
        out.write_all(&head).and_then(|()| out.flush()).map_err(cannot)?;
        let state = State::new(fps, with_tracks);
        Ok(Self { out, state, size: 1, packet: Encoder::new(), open: 0, check })
    }

    /// Gathers so many frames to a packet, 1 to 1024: what is smaller as a file but comes later in a pipe. 64 cost a
    /// tenth of a byte a frame.
    #[must_use]
    pub fn in_packets_of(mut self, frames: u32) -> Self {
        self.size = frames.clamp(1, MAX_FRAMES);
        self
    }

    /// Writes a frame. Its ratios come back within 0.01 each. Tracks are passed over in a record without; their number and
    /// time are the row's.
    ///
    /// # Errors
    /// When it cannot be written, its number or time is not after the last one's, or a value cannot be.
    pub fn push(&mut self, moment: &Moment) -> Result<()> {
        self.state.check(moment)?;
        if self.open > 0 {
            self.state.more(&mut self.packet, true);
        }
        self.state.write(&mut self.packet, moment);
        self.open += 1;
        if self.open >= self.size || self.packet.len() + FRAME_ROOM > MAX_PAYLOAD { self.flush() } else { Ok(()) }
    }

    /// Sends off what is gathered.
    ///
    /// # Errors
    /// When it cannot be written.
    pub(crate) fn flush(&mut self) -> Result<()> {
        if self.open == 0 {
            return Ok(());
        }
        self.state.more(&mut self.packet, false);
        let payload = std::mem::replace(&mut self.packet, Encoder::new()).finish();
        self.open = 0;
        let mut bytes = Vec::with_capacity(payload.len() + 7);
        let mut left = payload.len() + 1;
        while left >= 0x80 {
            bytes.push(0x80 | (left & 0x7F) as u8);
            left >>= 7;
        }
        bytes.push(left as u8);
        bytes.extend(payload);
        self.send(bytes)
    }

    /// Writes what is gathered and the end mark, without which a record counts as cut; gives back what it was written to.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn finish(mut self) -> Result<W> {
        self.flush()?;
        self.send(vec![0])?;
        Ok(self.out)
    }

    /// A packet with its check sum.
    fn send(&mut self, mut bytes: Vec<u8>) -> Result<()> {
        let mut hash = crc32fast::Hasher::new();
        hash.update(&self.check.to_le_bytes());
        hash.update(&bytes);
        self.check = hash.finalize();
        bytes.extend(self.check.to_le_bytes());
        self.out.write_all(&bytes).and_then(|()| self.out.flush()).map_err(cannot)
    }
}

fn cannot(error: std::io::Error) -> Fault {
    Fault::io("cannot write the record", "the record", error)
}
