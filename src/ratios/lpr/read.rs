//! Reading a compact record.

use std::io::{BufReader, ErrorKind, Read};

use super::coder::Decoder;
use super::frame::State;
use super::{HEAD, MAGIC, MAX_FPS, MAX_FRAMES, MAX_PAYLOAD, Moment, VERSION};
use crate::disk::{Fault, FileFault, Result, Setting, Task, message};

/// Reads a compact record as it arrives: a frame is there as soon as its packet is.
#[derive(Debug)]
pub struct LprReader<R: Read> {
    input: BufReader<R>,
    state: State,
    packet: Option<Decoder>,
    /// Frames of that packet that were read.
    of_packet: u32,
    check: u32,
    /// Bytes that were read and are whole.
    good: u64,
    frames: u64,
    is_over: bool,
}

/// What came of reading bytes.
enum Got {
    All,
    /// The input ended first.
    End,
}

impl<R: Read> LprReader<R> {
    /// Reads the head of a record.
    ///
    /// # Errors
    /// When it is none, or of a later version, or damaged or cut in its head.
    pub fn new(input: R) -> Result<Self> {
        let mut input = BufReader::new(input);
        let mut head = [0; HEAD];
        let got = fill(&mut input, &mut head)?;
        if !head.starts_with(&MAGIC) {
            let help = message![
                "it begins with the bytes 8C 4C 50 52; ",
                Task::Convert.with(Setting::Format, "lpr"),
                " makes one"
            ];
            return Err(Fault::of(FileFault::Unsupported, "this is no compact ratio record").help(help));
        }
        if matches!(got, Got::End) {
            return Err(
                Fault::of(FileFault::CutOff, "the record is cut off in its head").help("record or copy it again")
            );
        }
        if head[4] != VERSION {
            let what = format!("the record has version {}, this program reads {VERSION}", head[4]);
            return Err(Fault::new(what).help("read it with the version of lianpu that wrote it, or a later one"));
        }
        let (body, check) = head.split_at(HEAD - 4);
        let check = u32::from_le_bytes(check.try_into().unwrap_or_default());
        let fps = f64::from_le_bytes(body[6..].try_into().unwrap_or_default());
        let is_fit = fps.is_finite() && fps > 0.0 && fps <= MAX_FPS && body[5] <= 1;
        if crc32fast::hash(body) != check || !is_fit {
            return Err(Fault::new("the head of the record is damaged").help("record or copy it again"));
        }
        let state = State::new(fps, body[5] == 1);
        Ok(Self { input, state, packet: None, of_packet: 0, check, good: HEAD as u64, frames: 0, is_over: false })
    }

    /// Frames a second.
    #[must_use]
    pub(crate) fn fps(&self) -> f64 {
        self.state.fps()
    }

    /// The next frame; waits for it where it has not arrived. None at the end, and after a fault.
    ///
    /// # Errors
    /// When the record is cut or damaged from here on; it says after which frame and byte. What came before is whole.
    pub fn next_moment(&mut self) -> Result<Option<Moment>> {
        if self.is_over {
            return Ok(None);
        }
        let next = self.advance();
        self.is_over = !matches!(next, Ok(Some(_)));
        self.frames += u64::from(!self.is_over);
        next
    }

    fn advance(&mut self) -> Result<Option<Moment>> {
        // Between two frames of a packet stands whether there is another.
        if let Some(packet) = &mut self.packet
            && !self.state.more(packet, false)
        {
            self.packet = None;
        }
        let packet = match &mut self.packet {
            Some(packet) => packet,
            None => match self.arrive()? {
                Some(payload) => {
                    self.of_packet = 0;
                    self.packet.insert(Decoder::new(payload))
                }
                None => return Ok(None),
            },
        };
        self.of_packet += 1;
        match self.state.read(packet).filter(|_| self.of_packet <= MAX_FRAMES) {
            Some(moment) => Ok(Some(moment)),
            None => Err(self.damaged("is damaged")),
        }
    }

    /// The next payload; none at the end mark.
    fn arrive(&mut self) -> Result<Option<Vec<u8>>> {
        let mut bytes = Vec::new();
        let mut length = 0;
        loop {
            let mut byte = [0];
            if let Got::End = fill(&mut self.input, &mut byte)? {
                return Err(self.damaged("is cut off"));
            }
            length |= usize::from(byte[0] & 0x7F) << (7 * bytes.len());
            bytes.push(byte[0]);
            if byte[0] < 0x80 {
                break;
            }
            if bytes.len() == 3 {
                return Err(self.damaged("is damaged"));
            }
        }
        if length > MAX_PAYLOAD + 1 {
            return Err(self.damaged("is damaged"));
        }
        let (prefix, payload) = (bytes.len(), length.saturating_sub(1));
        // As much as there is, never as much as was announced.
        let mut rest = Read::by_ref(&mut self.input).take(payload as u64 + 4);
        rest.read_to_end(&mut bytes).map_err(cannot)?;
        if bytes.len() < prefix + payload + 4 {
            return Err(self.damaged("is cut off"));
        }
        let check = bytes.split_off(prefix + payload);
        let check = u32::from_le_bytes(check.try_into().unwrap_or_default());
        let mut hash = crc32fast::Hasher::new();
        hash.update(&self.check.to_le_bytes());
        hash.update(&bytes);
        if hash.finalize() != check {
            return Err(self.damaged("is damaged"));
        }
        self.check = check;
        self.good += bytes.len() as u64 + 4;
        Ok((length > 0).then(|| bytes.split_off(prefix)))
    }

    fn damaged(&self, how: &str) -> Fault {
        let after = match self.state.last().filter(|_| self.frames > 0) {
            Some(frame) => format!("after frame {frame} (byte {})", self.good),
            None => format!("before its first frame (byte {})", self.good),
        };
        let help = if self.frames > 0 { "what came before is whole" } else { "record or copy it again" };
        Fault::new(format!("the record {how} {after}")).help(help)
    }
}

/// Fills a buffer, unless the input ends.
fn fill(input: &mut impl Read, buffer: &mut [u8]) -> Result<Got> {
    let mut at = 0;
    while at < buffer.len() {
        match input.read(&mut buffer[at..]) {
            Ok(0) => return Ok(Got::End),
            Ok(count) => at += count,
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(cannot(error)),
        }
    }
    Ok(Got::All)
}

fn cannot(error: std::io::Error) -> Fault {
    Fault::io("cannot read the record", "the record", error)
}
