//! Where frames are missing in an MP3 file. It has no times in it: a decoder that skips what is damaged makes all that
//! follows come early, so that the places are found here and filled with silence afterwards.
//!
//! ISO/IEC 11172-3, 2.4.2.3, and 13818-3 for the lower rates.

use std::fs::File;
use std::io::{Read, Seek};

/// A file with more holes than these is not mended.
const MOST: usize = 100;

/// Frames are at most this long, in bytes.
const LONGEST: usize = 1441 + 4;

/// A place where frames are missing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hole {
    /// Samples that frames before it hold, from the first frame of sound.
    pub at: usize,
    /// Samples that should have been in it, by its length and that of other frames.
    pub lost: usize,
}

/// A frame's length in bytes, its samples, and what is the same in all frames of a file.
fn header(bytes: &[u8]) -> Option<(usize, usize, [u8; 2])> {
    let [0xFF, second, third, _, ..] = *bytes else { return None };
    let (version, layer) = (second >> 3 & 3, second >> 1 & 3);
    let (bits, rate, padded) = (usize::from(third >> 4), usize::from(third >> 2 & 3), usize::from(third >> 1 & 1));
    if second & 0xE0 != 0xE0 || version == 1 || layer != 1 || bits == 0 || bits == 15 || rate == 3 {
        return None;
    }
    let first = version == 3;
    let kilobits: [usize; 14] = if first {
        [32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320]
    } else {
        [8, 16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128, 144, 160]
    };
    let hertz = [44_100, 48_000, 32_000][rate] >> [2, 0, 1, 0][usize::from(version)];
    let (slots, samples) = if first { (144, 1152) } else { (72, 576) };
    Some((slots * kilobits[bits - 1] * 1000 / hertz + padded, samples, [second & 0xFE, third & 0x0C]))
}

/// The holes of a file, by their places; none where there are more than can be mended, or it is of another kind.
pub(super) fn holes(file: &mut File) -> std::io::Result<Vec<Hole>> {
    file.rewind()?;
    let mut window = Window { file, bytes: Vec::new(), at: 0 };
    // Frames, their bytes, bytes since the last, and what all frames have in common.
    let (mut frames, mut whole, mut junk, mut kind) = (0_usize, 0_usize, 0_usize, None);
    // The length of a frame whose beginning is left: it is decoded, well or badly, and not missing.
    let mut torn = 0;
    let mut samples = 0;
    let mut found: Vec<(usize, usize)> = Vec::new();
    loop {
        let ahead = window.ahead()?;
        if ahead.len() < 4 {
            break;
        }
        let frame = header(ahead).filter(|(length, _, this)| {
            let next = ahead.get(*length..).filter(|next| next.len() >= 4);
            let goes_on = next.is_none_or(|next| header(next).is_some_and(|(.., next)| next == *this));
            goes_on && kind.is_none_or(|kind| kind == *this)
        });
        let Some((length, in_frame, this)) = frame else {
            if junk == 0 {
                torn = header(ahead).filter(|(.., this)| kind == Some(*this)).map_or(0, |(length, ..)| length);
            }
            junk += 1;
            window.at += 1;
            continue;
        };
        // The first frame may hold nothing but the numbers of the others.
        let tag = frames == 0
            && ahead[..length.min(ahead.len()).min(64)].windows(4).any(|w| matches!(w, b"Xing" | b"Info" | b"VBRI"));
        if junk > 0 && frames > 0 {
            found.push((frames + usize::from(torn > 0), junk.saturating_sub(torn)));
        }
        junk = 0;
        window.at += length;
        if !tag {
            (kind, samples) = (Some(this), in_frame);
            frames += 1;
            whole += length;
        }
    }
    if found.len() > MOST || frames == 0 {
        return Ok(Vec::new());
    }
    let mean = whole as f64 / frames as f64;
    let hole = |(before, bytes): (usize, usize)| Hole {
        at: before * samples,
        lost: (bytes as f64 / mean).round() as usize * samples,
    };
    Ok(found.into_iter().map(hole).filter(|hole| hole.lost > 0).collect())
}

/// What lies ahead in a file, a part of it at a time.
struct Window<'a> {
    file: &'a mut File,
    bytes: Vec<u8>,
    at: usize,
}

impl Window<'_> {
    /// At least the longest frame and the header behind it, less only at the end.
    fn ahead(&mut self) -> std::io::Result<&[u8]> {
        if self.bytes.len() < self.at + LONGEST {
            // A frame may reach beyond the end.
            self.bytes.drain(..self.at.min(self.bytes.len()));
            self.at = 0;
            let more = (1 << 16) - self.bytes.len() as u64;
            self.file.by_ref().take(more).read_to_end(&mut self.bytes)?;
        }
        Ok(&self.bytes[self.at..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_those_of_the_standard() {
        assert_eq!(header(&[0xFF, 0xFB, 0x90, 0x64]), Some((417, 1152, [0xFA, 0x00])));
        assert_eq!(header(&[0xFF, 0xFB, 0x92, 0x64]), Some((418, 1152, [0xFA, 0x00])));
        assert_eq!(header(&[0xFF, 0xF3, 0x88, 0xC4]), Some((288, 576, [0xF2, 0x08])));
        for none in [[0xFF, 0xFB, 0x00, 0], [0xFF, 0xFB, 0xF0, 0], [0xFF, 0xFB, 0x9C, 0], [0xFF, 0xFD, 0x90, 0], [0; 4]]
        {
            assert_eq!(header(&none), None);
        }
    }

    #[test]
    fn what_is_missing_between_frames_is_found_and_what_lies_around_them_is_not() {
        let mut frame = vec![0; 417];
        frame[..4].copy_from_slice(&[0xFF, 0xFB, 0x90, 0x64]);
        let mut tag = frame.clone();
        tag[36..40].copy_from_slice(b"Info");
        let whole = [b"ID3\x04".to_vec(), vec![0; 500], tag, frame.repeat(40)].concat();
        let holes_of = |bytes: &[u8]| {
            let mut file = tempfile::tempfile().unwrap();
            std::io::Write::write_all(&mut file, bytes).unwrap();
            holes(&mut file).unwrap()
        };
        assert!(holes_of(&[&whole[..], b"TAG", &[7; 125]].concat()).is_empty());
        let mut hurt = whole.clone();
        let at = 504 + 417 + 10 * 417;
        hurt[at + 100..at + 900].fill(0x55);
        assert_eq!(holes_of(&hurt), [Hole { at: 11 * 1152, lost: 2 * 1152 }]);
        for cut in [0, 3, 500, 600, 921, 5_000] {
            assert!(holes_of(&whole[..cut]).is_empty());
        }
        assert!(holes_of(&[0xFF; 100_000]).is_empty());
    }
}
