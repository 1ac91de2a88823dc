//! A stream of frames in, a record out, as they come.

use std::io::{Read, Write};

use super::{Live, Options};
use crate::aam::Model;
use crate::calibration::Calibration;
use crate::disk::{Fault, FileFault, Result};
use crate::media::Y4m;
use crate::ratios::LprWriter;

/// Reads YUV4MPEG2 and writes the compact record of it with eyes, mouth and head, each frame as soon as it was seen and
/// flushed: who reads it is one frame behind. No frame is left out: where frames come faster than they are followed, who
/// writes them waits. Returns how many there were and in how many of them the face was lost.
///
/// # Errors
/// When the stream is none, or is cut or damaged: what came before is then written whole. When the record cannot be
/// written; a closed pipe is the system's error in the fault.
pub fn relay<W: Write>(
    input: impl Read,
    out: W,
    model: &Model,
    calibration: &Calibration,
    options: &Options,
) -> Result<(usize, usize)> {
    let mut live = Live::new(model, calibration, options)?;
    let mut stream = Y4m::new(input)?;
    let mut record = LprWriter::new(out, stream.fps(), true)?;
    let (mut count, mut lost) = (0, 0);
    let end = loop {
        match stream.next_frame() {
            Ok(Some(frame)) => {
                let moment = live.next(&frame.grey, frame.number, frame.time);
                record.push(&moment)?;
                count += 1;
                lost += usize::from(moment.row.confidence == 0.0);
            }
            Ok(None) => break Ok(()),
            Err(fault) => break Err(fault),
        }
    };
    record.finish()?;
    end?;
    if count == 0 {
        return Err(Fault::of(FileFault::Empty, "the stream has no frames").help("does what writes it say why?"));
    }
    Ok((count, lost))
}
