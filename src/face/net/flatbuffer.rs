//! Reads FlatBuffers: tables with optional fields behind offsets, all of them checked against the length of the file.

use super::error::{NetError, Result};

/// A table of a FlatBuffers file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Table<'a> {
    file: &'a [u8],
    /// Offset of the table in the file.
    start: usize,
    /// Offsets of the fields from `start`, as 16-bit numbers; 0 where a field is absent.
    fields: &'a [u8],
}

/// The bytes of a number at an offset of the file.
fn number<const N: usize>(file: &[u8], at: usize) -> Result<[u8; N]> {
    file.get(at..).and_then(|rest| rest.first_chunk()).copied().ok_or(NetError::Damaged)
}

/// The offset that the offset stored at `at` leads to.
fn target(file: &[u8], at: usize) -> Result<usize> {
    Ok(at + u32::from_le_bytes(number(file, at)?) as usize)
}

impl<'a> Table<'a> {
    /// The root table of a file.
    pub(super) fn root(file: &'a [u8]) -> Result<Self> {
        Self::at(file, target(file, 0)?)
    }

    fn at(file: &'a [u8], start: usize) -> Result<Self> {
        let back = i32::from_le_bytes(number(file, start)?);
        let vtable = i64::try_from(start).unwrap_or(i64::MAX) - i64::from(back);
        let vtable = usize::try_from(vtable).map_err(|_| NetError::Damaged)?;
        let length = usize::from(u16::from_le_bytes(number(file, vtable)?));
        // Its first two numbers are its own length and the table's.
        let fields = file.get(vtable + 4..vtable + length.max(4)).ok_or(NetError::Damaged)?;
        Ok(Self { file, start, fields })
    }

    /// Offset of a field in the file; none where it has its default.
    fn field(&self, index: usize) -> Option<usize> {
        let offset = self.fields.get(2 * index..)?.first_chunk()?;
        let offset = usize::from(u16::from_le_bytes(*offset));
        (offset != 0).then_some(self.start + offset)
    }

    /// An 8-bit field; 0 where absent.
    pub(super) fn byte(&self, index: usize) -> Result<u8> {
        self.field(index).map_or(Ok(0), |at| Ok(number::<1>(self.file, at)?[0]))
    }

    /// A 32-bit field.
    pub(super) fn int(&self, index: usize, default: i32) -> Result<i32> {
        self.field(index).map_or(Ok(default), |at| Ok(i32::from_le_bytes(number(self.file, at)?)))
    }

    /// A field that is a table.
    pub(super) fn table(&self, index: usize) -> Result<Option<Self>> {
        self.field(index).map(|at| Self::at(self.file, target(self.file, at)?)).transpose()
    }

    /// The length of a vector field, and the bytes behind it; none where absent.
    fn vector(&self, index: usize, size: usize) -> Result<(usize, &'a [u8])> {
        let Some(at) = self.field(index) else { return Ok((0, &[])) };
        let start = target(self.file, at)?;
        let count = u32::from_le_bytes(number(self.file, start)?) as usize;
        let bytes = count.checked_mul(size).and_then(|length| self.file.get(start + 4..)?.get(..length));
        Ok((start + 4, bytes.ok_or(NetError::Damaged)?))
    }

    /// A field of bytes or text; empty where absent.
    pub(super) fn bytes(&self, index: usize) -> Result<&'a [u8]> {
        Ok(self.vector(index, 1)?.1)
    }

    /// A field of 32-bit numbers; empty where absent.
    pub(super) fn ints(&self, index: usize) -> Result<Vec<i32>> {
        let (_, bytes) = self.vector(index, 4)?;
        Ok(bytes.as_chunks().0.iter().map(|b| i32::from_le_bytes(*b)).collect())
    }

    /// A field of tables; empty where absent.
    pub(super) fn tables(&self, index: usize) -> Result<Vec<Self>> {
        let (start, bytes) = self.vector(index, 4)?;
        (0..bytes.len() / 4).map(|i| Self::at(self.file, target(self.file, start + 4 * i)?)).collect()
    }
}
