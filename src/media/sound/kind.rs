//! What kind of file a recording lies in, told by its first bytes: endings lie.

/// How many first bytes are looked at.
pub(super) const HEAD: usize = 4096;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// RIFF, RF64 or BW64 with WAVE in it.
    Wave,
    /// MPEG audio, layer 3.
    Mp3,
    /// ISO base media: M4A, MP4, MOV, 3GP.
    Iso,
    /// What the decoder finds its way in by itself: AIFF, FLAC, OGG, AAC, MKV, WebM.
    Other,
    /// Known, and not read: its name.
    Foreign(&'static str),
    /// Nothing that is known.
    Unknown,
}

/// What the beginning of a file says it is.
pub(super) fn kind(head: &[u8]) -> Kind {
    let at = |place: usize, mark: &[u8]| head.get(place..place + mark.len()) == Some(mark);
    let form = |name: &[u8]| at(8, name);
    match head {
        [b'R', b'I', b'F', b'F' | b'X', ..] | [b'R', b'F', b'6', b'4', ..] | [b'B', b'W', b'6', b'4', ..]
            if form(b"WAVE") =>
        {
            if head[3] == b'X' {
                Kind::Foreign("a WAV file of the kind RIFX")
            } else {
                Kind::Wave
            }
        }
        [b'F', b'O', b'R', b'M', ..] if form(b"AIFF") || form(b"AIFC") => Kind::Other,
        [b'f', b'L', b'a', b'C', ..] | [0x1A, 0x45, 0xDF, 0xA3, ..] => Kind::Other,
        [b'O', b'g', b'g', b'S', ..] => ogg(head),
        _ if at(4, b"ftyp") || at(4, b"moov") || at(4, b"mdat") || at(4, b"wide") => Kind::Iso,
        // A tag of ID3 may stand before anything; beyond it lies most often MP3.
        [b'I', b'D', b'3', ..] => tagged(head),
        [0xFF, second, ..] if second & 0xF6 == 0xF0 => Kind::Other,
        [0xFF, second, third, ..] if second & 0xE0 == 0xE0 => mpeg(*second, *third),
        [0x30, 0x26, 0xB2, 0x75, ..] => Kind::Foreign("a WMA file"),
        _ if at(0, b"#!AMR") => Kind::Foreign("an AMR file"),
        _ if at(0, b"caff") => Kind::Foreign("a CAF file"),
        _ if at(0, b"riff\x2E\x91\xCF\x11") => Kind::Foreign("a W64 file"),
        _ if at(0, b".snd") => Kind::Foreign("an AU file"),
        _ if at(0, b"wvpk") => Kind::Foreign("a WavPack file"),
        _ if at(0, b"MAC ") => Kind::Foreign("a file of Monkey's Audio"),
        _ if at(0, b"RIFF") && form(b"AVI ") => Kind::Foreign("an AVI file"),
        _ if at(0, b"FLV\x01") => Kind::Foreign("a Flash video"),
        _ if at(0, b"MThd") => Kind::Foreign("a MIDI file, which holds notes and no sound"),
        _ => Kind::Unknown,
    }
}

/// What the first page of an OGG file begins with.
fn ogg(head: &[u8]) -> Kind {
    let packet = head.get(26).and_then(|lacing| head.get(27 + usize::from(*lacing)..)).unwrap_or_default();
    match packet {
        [b'O', b'p', b'u', b's', ..] => Kind::Foreign("an Opus file"),
        [b'S', b'p', b'e', b'e', b'x', ..] => Kind::Foreign("a Speex file"),
        [0x80, b't', b'h', b'e', b'o', ..] => Kind::Foreign("an OGG video"),
        _ => Kind::Other,
    }
}

fn tagged(head: &[u8]) -> Kind {
    // The length of the tag in four times seven bits.
    let length = head.get(6..10).map_or(0, |bytes| bytes.iter().fold(0, |n, b| n << 7 | usize::from(b & 0x7F)));
    match head.get(10 + length..) {
        Some([b'f', b'L', b'a', b'C', ..]) => Kind::Other,
        Some([0xFF, second, ..]) if second & 0xF6 == 0xF0 => Kind::Other,
        _ => Kind::Mp3,
    }
}

/// By the second and third byte of a header of MPEG audio: its layer must be 3, its rates none of those forbidden.
fn mpeg(second: u8, third: u8) -> Kind {
    let (version, layer, bits, rate) = (second >> 3 & 3, second >> 1 & 3, third >> 4, third >> 2 & 3);
    match layer {
        _ if version == 1 || bits == 15 || rate == 3 => Kind::Unknown,
        1 => Kind::Mp3,
        2 => Kind::Foreign("MPEG audio of layer 2"),
        // Layer 1 is seen nowhere any more, and its mark is that of text in UTF-16.
        _ => Kind::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_is_its_first_bytes_tell() {
        let opus = [b"OggS\0\x02".as_slice(), &[0; 20], &[1, 19], b"OpusHead"].concat();
        for (head, expected) in [
            (b"RIFF\0\0\0\0WAVEfmt ".as_slice(), Kind::Wave),
            (b"RF64\xFF\xFF\xFF\xFFWAVEds64", Kind::Wave),
            (b"\0\0\0\x20ftypM4A ", Kind::Iso),
            (b"ID3\x04\0\0\0\0\0\0\xFF\xFB\x90", Kind::Mp3),
            (b"ID3\x04\0\0\0\0\0\0fLaC", Kind::Other),
            (b"\xFF\xFB\x90\x00", Kind::Mp3),
            (b"\xFF\xF1\x50\x80", Kind::Other),
            (b"\xFF\xFD\x90\x00", Kind::Foreign("MPEG audio of layer 2")),
            (&opus, Kind::Foreign("an Opus file")),
            (b"\xFF\xFE1\0", Kind::Unknown),
            (b"RIFF", Kind::Unknown),
            (b"hello", Kind::Unknown),
            (b"", Kind::Unknown),
        ] {
            assert_eq!(kind(head), expected, "{head:?}");
        }
    }
}
