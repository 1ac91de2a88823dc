//! The compact record (`.lpr`): ratios, and where wanted eyes, mouth and head, as a stream of small packets.
//!
//! # The format, version 1
//!
//! Numbers of several bytes are little endian. A record is a head, packets, and an end mark.
//!
//! | head, 18 bytes | |
//! | --- | --- |
//! | 0 to 3 | `8C 4C 50 52` (`LPR` after a byte that is no text) |
//! | 4 | version, 1 |
//! | 5 | bit 0: frames may have tracks; the others are 0 |
//! | 6 to 13 | frames a second, an IEEE 754 double, above 0 and at most 10,000 |
//! | 14 to 17 | CRC-32 (IEEE, as in PNG) of bytes 0 to 13 |
//!
//! A packet is *length + 1* of its payload as LEB128 (seven bits a byte, the lowest first, the top bit on all but the
//! last; at most three bytes, a payload has at most 65,535), the payload, and a CRC-32 of: the check sum before it (the
//! head's or the last packet's, 4 bytes), the length as written, the payload. The end mark is a packet whose *length + 1*
//! is 0. So a lost, doubled or swapped packet is noticed, and a record without an end mark was cut.
//!
//! A payload is one run of a binary range coder (below) and has 1 to 1024 frames. Probabilities go on from packet to
//! packet; the coder starts anew. A frame is complete when its packet has arrived: live records have a packet a frame.
//!
//! ## The coder
//!
//! As in LZMA, with 16-bit probabilities. *Reading*: `code` is the first four bytes of the payload, the highest first,
//! `range` is 2³² − 1; bytes beyond the payload's end are 0. For a decision with probability *p* / 65536 of a 0,
//! `bound = (range >> 16) · p`; if `code < bound` it is 0 and `range = bound`, else it is 1, `code −= bound`,
//! `range −= bound`. While `range < 2²⁴`: `range <<= 8`, `code = code << 8 | next byte`. An even decision is one of p = 32768.
//!
//! A decision's model has a fast and a slow estimate *a*, *b* of p, both 32768 at first, and a count *n* from 0:
//! `p = max(32, min(65504, (a + b) >> 1))`. After each decision, with `t` = 65535 for a 0 and 0 for a 1:
//! `a += (t − a) · R[min(n, 20)] >> 16`, `b += (t − b) · R[min(n, 250)] >> 16`, `n += 1` up to 250, where `R[n] = 655360 / (10 n + 16)` rounded
//! down, and `>>` of a negative number rounds down.
//!
//! *A whole number* ≥ 0 in a set of models `m`: decisions `m[0]`, `m[1]` … `m[14]`, each 1 for "larger", until a 0 says
//! which; after fifteen 1s `v − 15` follows as an even Exp-Golomb number: with `w = v − 15 + 1` of *k* + 1 bits, *k* even
//! 1s, an even 0, and the lower *k* bits of `w`, the highest first, all even; *k* is at most 62.
//!
//! ## A frame
//!
//! 1. After each frame stands a decision `more`: 1 if another frame follows
//!    in this packet.
//! 2. `gap`: a whole number, the frame's number less the last one's less 1 (the first frame's last one is −1).
//! 3. `late`: a decision, 1 if the time's distance from the beat has changed; then a sign (1 is negative), and the change's size less 1 as a
//!    whole number. The beat of frame f is f / fps; the distance is in microseconds, between time and beat each rounded to
//!    whole ones, 0 at first. At distance 0 the time is f / fps itself, else (beat + distance) / 10⁶ s.
//! 4. Six channels, happy to surprised, in hundredths, then the confidence in 32nds. Neutral is 100 less the six.
//!    A confidence of 0 is a lost frame; one above 0 is written as 1/32 at least.
//! 5. With tracks: `has`, a decision, 1 if this frame has any. Then twelve channels: gaze x, y (50ths), lids left, right (50ths), mouth
//!    up, down (50ths), mouth left, right (100ths), head x, y (200ths), head roll (10ths of a degree), confidence (32nds).
//!
//! *A channel* is written as its change against its last value (0 at first; 32 for confidences, 50 for lids). Its models
//! are chosen by the group (ratios, their confidence alone, gaze, lids, mouth, head, the tracks' confidence alone), by what the channel did,
//! and by what its group did: with r1, r2 the sizes of the channel's last two changes, `own = 2 r1 + r2`, brought to `min(8, own < 4 ? own : 4 + (own − 4) / 3)`;
//! with s the sum of the sizes of the last changes of the others of its group, `all = min(5, s < 3 ? s : 3 + (s − 3) / 4)`.
//! A decision `still` of `[channel][own][all]`, 1 if it changes; then `down` of `[channel][the last change's sign: 0 none, 1
//! up, 2 down]`, 1 if it falls; then the size less 1 as a whole number with the models `[group][own]`.
//!
//! What is written of a value may differ from it by less than a step: the writer chooses what costs least. Of ratios each of the seven is
//! within 0.01; the others are within a step of theirs.

mod channel;
mod coder;
mod frame;
mod model;
mod near;
mod read;
mod whole;
mod write;

use super::{Row, TrackRow};

pub use read::LprReader;
pub use whole::{Whole, to_lpr};
pub use write::LprWriter;

/// A frame of a compact record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Its ratios.
    pub row: Row,
    /// Eyes, mouth and head, where the record has them.
    pub track: Option<TrackRow>,
}

/// The first byte of a record, which no text begins with.
pub(super) const LPR_FIRST: u8 = 0x8C;
/// What a record begins with.
const MAGIC: [u8; 4] = [LPR_FIRST, b'L', b'P', b'R'];
/// The version that is written, and the last one that is read.
const VERSION: u8 = 1;
/// Bytes of the head.
const HEAD: usize = 18;
/// A payload has at most so many bytes.
const MAX_PAYLOAD: usize = 0xFFFF;
/// A packet has at most so many frames.
const MAX_FRAMES: u32 = 1024;
/// The highest number of frames a second.
const MAX_FPS: f64 = 10_000.0;
/// The latest time in seconds and the largest value of anything else, as in `ratios.csv`.
const MAX_SECONDS: f64 = 360_000.0;
const MAX_VALUE: f64 = 1_000.0;

/// Whether bytes begin like a compact record: how a file is told by its content.
#[must_use]
pub fn is_lpr(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}
