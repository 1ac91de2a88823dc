//! Writes plain WAV files: 16 bits, one channel.

use std::io::{Error, ErrorKind, Result, Seek, Write};

use hound::{SampleFormat, WavSpec, WavWriter};

/// Samples that are handed to the encoder at once.
const BLOCK: usize = 1 << 16;
/// The most samples: their bytes and the 36 of the header behind the length are counted in 32 bits.
const MOST: usize = (u32::MAX as usize - 36) / 2;

/// Writes a whole WAV file of the samples of all blocks, in their order, at `rate` samples a second.
///
/// # Errors
/// When it cannot be written, or the samples are more than a WAV file can hold.
pub(crate) fn write_wav<B: AsRef<[i16]>>(
    to: impl Write + Seek,
    rate: u32,
    blocks: impl IntoIterator<Item = B>,
) -> Result<()> {
    let spec = WavSpec { channels: 1, sample_rate: rate, bits_per_sample: 16, sample_format: SampleFormat::Int };
    let mut wav = WavWriter::new(to, spec).map_err(of_writing)?;
    let mut count = 0;
    for block in blocks {
        for samples in block.as_ref().chunks(BLOCK) {
            count += samples.len();
            if count > MOST {
                return Err(Error::new(ErrorKind::FileTooLarge, "there are more than 4 GB of samples"));
            }
            let mut writer = wav.get_i16_writer(samples.len() as u32);
            samples.iter().for_each(|sample| writer.write_sample(*sample));
            writer.flush().map_err(of_writing)?;
        }
    }
    wav.finalize().map_err(of_writing)
}

fn of_writing(error: hound::Error) -> Error {
    match error {
        hound::Error::IoError(error) => error,
        error => Error::other(error),
    }
}
