//! What an ISO base media file (M4A, MP4, MOV) says about where its sound begins and ends: the decoder does not know
//! edit lists, and without them sound comes late by what its encoder put before it, 1024 to 2112 samples with AAC.
//!
//! ISO/IEC 14496-12: `moov/trak/edts/elst` (8.6.6), `mdia/mdhd` (8.4.2), `tkhd` (8.3.2), `mvhd` (8.2.2). iTunes wrote
//! the same into a tag, `iTunSMPB`: five numbers in hexadecimal, of which the second to fourth are the samples before,
//! those behind, and those of the sound.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};

/// The largest index that is read. That of 4 hours is below 4 MB.
const MAX_INDEX: u64 = 64 << 20;

/// What is to be played of a track.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edit {
    /// What is to be left out at its beginning, in seconds.
    pub skip: f64,
    /// How much is to be played behind that, in seconds, where it is said.
    pub length: Option<f64>,
}

/// The index of a file.
pub(super) struct Index {
    moov: Vec<u8>,
}

impl Index {
    /// Finds it; nothing where there is none, as in a recording that was never finished.
    pub(crate) fn find(file: &mut File) -> std::io::Result<Option<Self>> {
        let end = file.metadata()?.len();
        let mut at = 0;
        while at + 8 <= end {
            file.seek(SeekFrom::Start(at))?;
            let mut head = [0; 16];
            let got = file.by_ref().take(16).read(&mut head)?;
            let Some((name, start, length)) = header(&head[..got], end - at) else { break };
            if &name == b"moov" {
                file.seek(SeekFrom::Start(at + start))?;
                let mut moov = Vec::new();
                file.by_ref().take((length - start).min(MAX_INDEX)).read_to_end(&mut moov)?;
                return Ok(Some(Self { moov }));
            }
            at += length;
        }
        Ok(None)
    }

    /// What is to be played of the track of that number; nothing where the file does not say.
    pub(crate) fn edit(&self, track: u32, rate: u32) -> Option<Edit> {
        let movie_scale = inside(&self.moov, b"mvhd").and_then(|mvhd| scale(mvhd, 12));
        let listed = boxes(&self.moov).filter(|(name, _)| name == b"trak").map(|(_, trak)| trak).find(|trak| {
            let number =
                inside(trak, b"tkhd").and_then(|tkhd| word(tkhd, if tkhd.first() == Some(&1) { 20 } else { 12 }));
            number == Some(track)
        });
        let listed = listed.and_then(|trak| {
            let own_scale = inside(inside(trak, b"mdia")?, b"mdhd").and_then(|mdhd| scale(mdhd, 12))?;
            edit_list(inside(inside(trak, b"edts")?, b"elst")?, own_scale, movie_scale)
        });
        // A list that leaves nothing out is what programs write who do not know the delay; the tag may.
        listed.filter(|edit| edit.skip > 0.0).or_else(|| self.tagged(rate)).or(listed)
    }

    fn tagged(&self, rate: u32) -> Option<Edit> {
        let found = self.moov.windows(8).position(|window| window == b"iTunSMPB")?;
        let after = &self.moov[found..self.moov.len().min(found + 200)];
        let text = after.windows(4).position(|window| window == b"data").and_then(|at| after.get(at + 12..))?;
        let numbers: Vec<u64> = text
            .split(|byte| !byte.is_ascii_hexdigit())
            .filter(|digits| digits.len() >= 8)
            .map_while(|digits| u64::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok())
            .collect();
        let seconds = |samples: u64| samples as f64 / f64::from(rate.max(1));
        match numbers.as_slice() {
            [_, before, _, length, ..] if *before < 100_000 => {
                Some(Edit { skip: seconds(*before), length: (*length > 0).then(|| seconds(*length)) })
            }
            _ => None,
        }
    }
}

/// The first edit that plays something.
fn edit_list(list: &[u8], own_scale: f64, movie_scale: Option<f64>) -> Option<Edit> {
    let long = list.first() == Some(&1);
    let (entry, wide) = if long { (20, 8) } else { (12, 4) };
    let number = |bytes: &[u8]| bytes.iter().fold(0_u64, |n, b| n << 8 | u64::from(*b));
    let mut plays = list.get(8..)?.chunks_exact(entry).filter_map(|edit| {
        let start = number(&edit[wide..2 * wide]);
        // -1: nothing is played for a while. What comes before the sound is not part of it.
        let nothing = start >> (8 * wide - 1) == 1;
        (!nothing).then(|| (number(&edit[..wide]) as f64, start as f64 / own_scale))
    });
    let (length, skip) = plays.next()?;
    // Of several edits only the first place is sure.
    let length = movie_scale.map(|scale| length / scale).filter(|length| *length > 0.0 && plays.next().is_none());
    Some(Edit { skip, length })
}

/// Units a second, of `mvhd` and `mdhd`, which stand behind two times of 4 or 8 bytes each.
fn scale(content: &[u8], at: usize) -> Option<f64> {
    let units = word(content, if content.first() == Some(&1) { at + 8 } else { at })?;
    (units > 0).then_some(f64::from(units))
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..at + 4).map(|b| u32::from_be_bytes([b[0], b[1], b[2], b[3]]))
}

/// The content of the first box of a name.
fn inside<'a>(bytes: &'a [u8], wanted: &[u8; 4]) -> Option<&'a [u8]> {
    boxes(bytes).find(|(name, _)| name == wanted).map(|(_, content)| content)
}

/// Names and contents of the boxes that follow each other.
fn boxes(bytes: &[u8]) -> impl Iterator<Item = ([u8; 4], &[u8])> {
    let mut rest = bytes;
    std::iter::from_fn(move || {
        let (name, start, length) = header(rest, rest.len() as u64)?;
        let content = rest.get(start as usize..length as usize)?;
        rest = &rest[length as usize..];
        Some((name, content))
    })
}

/// The name of a box, where its content begins, and where it ends, at most at `left`.
fn header(bytes: &[u8], left: u64) -> Option<([u8; 4], u64, u64)> {
    let name = bytes.get(4..8)?.try_into().ok()?;
    let (start, length) = match word(bytes, 0)? {
        0 => (8, left),
        1 => (16, u64::from(word(bytes, 8)?) << 32 | u64::from(word(bytes, 12)?)),
        length => (8, u64::from(length)),
    };
    (length >= start && start <= left).then_some((name, start, length.min(left)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxed(name: &[u8; 4], content: &[u8]) -> Vec<u8> {
        [&(content.len() as u32 + 8).to_be_bytes()[..], name, content].concat()
    }

    fn words(numbers: &[u32]) -> Vec<u8> {
        numbers.iter().flat_map(|n| n.to_be_bytes()).collect()
    }

    /// The index of a file with a video track 1 and a sound track 2 of 44100 units a second, and this edit list.
    fn index(list: &[u32], tag: &[u8]) -> Index {
        let trak = |number: u32, units: u32, list: &[u32]| {
            let media = boxed(b"mdia", &boxed(b"mdhd", &words(&[0, 0, 0, units, 0])));
            let edits = boxed(b"edts", &boxed(b"elst", &words(list)));
            boxed(b"trak", &[boxed(b"tkhd", &words(&[0, 0, 0, number])), edits, media].concat())
        };
        let mvhd = boxed(b"mvhd", &words(&[0, 0, 0, 1000, 0]));
        let parts = [mvhd, trak(1, 600, &[0, 1, 77, 0, 1]), trak(2, 44_100, list), tag.to_vec()];
        Index { moov: parts.concat() }
    }

    #[test]
    fn the_edit_list_of_the_right_track_says_what_is_played() {
        let edit = index(&[0, 1, 2000, 2112, 0x1_0000], &[]).edit(2, 44_100).unwrap();
        assert_eq!(edit, Edit { skip: 2112.0 / 44_100.0, length: Some(2.0) });
        // Nothing for 20 ms, then the sound.
        let edit = index(&[0, 2, 20, u32::MAX, 0x1_0000, 1000, 1024, 0x1_0000], &[]).edit(2, 44_100).unwrap();
        assert_eq!(edit, Edit { skip: 1024.0 / 44_100.0, length: Some(1.0) });
        assert_eq!(index(&[0, 0], &[]).edit(2, 44_100), None);
        assert_eq!(index(&[], &[]).edit(3, 44_100), None);
    }

    #[test]
    fn the_tag_of_itunes_does_where_no_list_says_it() {
        let data = [&words(&[1, 0])[..], b" 00000000 00000840 000001CA 0000000000003EC0 00000000"].concat();
        let tag = boxed(b"----", &[boxed(b"name", b"\0\0\0\0iTunSMPB"), boxed(b"data", &data)].concat());
        let tag = boxed(b"udta", &tag);
        let edit = index(&[0, 0], &tag).edit(2, 44_100).unwrap();
        assert_eq!(edit, Edit { skip: 2112.0 / 44_100.0, length: Some(16_064.0 / 44_100.0) });
    }

    #[test]
    fn damaged_boxes_end_the_search() {
        for bytes in [&b""[..], b"\0\0\0\x04moov", b"\0\0\0\x01moov", b"\xFF\xFF\xFF\xFFtrak\0\0", &[0; 64]] {
            assert_eq!(Index { moov: bytes.to_vec() }.edit(1, 8_000), None);
        }
    }
}
