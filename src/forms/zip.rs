//! A ZIP archive, as EPUB wants it: no times but the format's first day, entries in the order given, the same bytes for
//! the same files.

/// The first day that the format knows, 1 January 1980: a clock's would make every archive another.
const DAY: u16 = 1 << 5 | 1;

/// An archive in the making.
#[derive(Default)]
pub(crate) struct Archive {
    bytes: Vec<u8>,
    directory: Vec<u8>,
    count: u16,
}

impl Archive {
    /// Adds a file as it is, or deflated where that is shorter.
    pub(crate) fn add(&mut self, name: &str, file: &[u8], deflated: bool) {
        let packed = deflated.then(|| miniz_oxide::deflate::compress_to_vec(file, 9)).filter(|p| p.len() < file.len());
        let (method, data): (u16, &[u8]) = packed.as_deref().map_or((0, file), |p| (8, p));
        let place = self.bytes.len() as u32;
        let mut head = Vec::with_capacity(26);
        // Version 2.0, names in UTF-8, the method, no time, the day.
        for word in [20, 1 << 11, method, 0, DAY] {
            head.extend(u16::to_le_bytes(word));
        }
        for word in [crc32fast::hash(file), data.len() as u32, file.len() as u32] {
            head.extend(word.to_le_bytes());
        }
        head.extend((name.len() as u16).to_le_bytes());
        head.extend([0, 0]);
        self.bytes.extend(b"PK\x03\x04");
        self.bytes.extend(&head);
        self.bytes.extend(name.as_bytes());
        self.bytes.extend(data);
        self.directory.extend(b"PK\x01\x02\x14\x00");
        self.directory.extend(&head);
        // No remark, one disk, no attributes, the place.
        self.directory.extend([0; 10]);
        self.directory.extend(place.to_le_bytes());
        self.directory.extend(name.as_bytes());
        self.count += 1;
    }

    /// The archive.
    pub(crate) fn done(mut self) -> Vec<u8> {
        let (place, length) = (self.bytes.len() as u32, self.directory.len() as u32);
        self.bytes.append(&mut self.directory);
        self.bytes.extend(b"PK\x05\x06\0\0\0\0");
        self.bytes.extend(self.count.to_le_bytes());
        self.bytes.extend(self.count.to_le_bytes());
        self.bytes.extend(length.to_le_bytes());
        self.bytes.extend(place.to_le_bytes());
        self.bytes.extend([0, 0]);
        self.bytes
    }
}
