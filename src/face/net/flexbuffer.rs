//! Reads the options of a custom operation: one FlexBuffers map of numbers and number lists, all offsets checked.

use super::error::{NetError, Result};

/// Kinds of value, as FlexBuffers numbers them.
const INT: u8 = 1;
const UINT: u8 = 2;
const FLOAT: u8 = 3;
const MAP: u8 = 9;
const INTS: u8 = 11;

/// A FlexBuffers map.
#[derive(Debug, Clone, Copy)]
pub(super) struct Options<'a> {
    bytes: &'a [u8],
    /// Offset of the first value.
    start: usize,
    /// Bytes of a value: 1, 2, 4 or 8.
    width: usize,
    count: usize,
}

/// A number of 1, 2, 4 or 8 bytes, little endian.
fn uint(bytes: &[u8], at: usize, width: usize) -> Result<usize> {
    if width > 8 {
        return Err(NetError::Damaged);
    }
    let digits = bytes.get(at..).and_then(|rest| rest.get(..width)).ok_or(NetError::Damaged)?;
    let value = digits.iter().rev().fold(0_u64, |value, digit| value << 8 | u64::from(*digit));
    usize::try_from(value).map_err(|_| NetError::Damaged)
}

/// The offset that the backward offset at `at` leads to.
fn target(bytes: &[u8], at: usize, width: usize) -> Result<usize> {
    at.checked_sub(uint(bytes, at, width)?).ok_or(NetError::Damaged)
}

/// Bytes of a value, from the low bits of its type.
fn width_of(kind: u8) -> usize {
    1 << (kind & 3)
}

impl<'a> Options<'a> {
    pub(super) fn read(bytes: &'a [u8]) -> Result<Self> {
        let [.., kind, width] = bytes else { return Err(NetError::Damaged) };
        if kind >> 2 != MAP {
            return Err(NetError::Damaged);
        }
        let at = (bytes.len() - 2).checked_sub(usize::from(*width)).ok_or(NetError::Damaged)?;
        let start = target(bytes, at, usize::from(*width))?;
        let width = width_of(*kind);
        let count = uint(bytes, start.checked_sub(width).ok_or(NetError::Damaged)?, width)?;
        if count > bytes.len() {
            return Err(NetError::Damaged);
        }
        Ok(Self { bytes, start, width, count })
    }

    /// The type and the offset of a value.
    fn value(&self, key: &str) -> Result<(u8, usize)> {
        let back = |widths: usize| self.start.checked_sub(widths * self.width).ok_or(NetError::Damaged);
        let keys = target(self.bytes, back(3)?, self.width)?;
        let key_width = uint(self.bytes, back(2)?, self.width)?;
        if ![1, 2, 4, 8].contains(&key_width) {
            return Err(NetError::Damaged);
        }
        for index in 0..self.count {
            let name = target(self.bytes, keys + index * key_width, key_width)?;
            let is_it = self.bytes[name..].strip_prefix(key.as_bytes()).is_some_and(|rest| rest.first() == Some(&0));
            if is_it {
                let kinds = self.start + self.count * self.width;
                let kind = self.bytes.get(kinds + index).ok_or(NetError::Damaged)?;
                return Ok((*kind, self.start + index * self.width));
            }
        }
        Err(NetError::Damaged)
    }

    /// A whole number that is not negative.
    pub(super) fn index(&self, key: &str) -> Result<usize> {
        match self.value(key)? {
            (kind, at) if [INT, UINT].contains(&(kind >> 2)) => uint(self.bytes, at, self.width),
            _ => Err(NetError::Damaged),
        }
    }

    /// A number of 32 bits.
    pub(super) fn float(&self, key: &str) -> Result<f32> {
        match self.value(key)? {
            (kind, at) if kind >> 2 == FLOAT && self.width == 4 => Ok(f32::from_bits(uint(self.bytes, at, 4)? as u32)),
            _ => Err(NetError::Damaged),
        }
    }

    /// A list of whole numbers that are not negative.
    pub(super) fn indices(&self, key: &str) -> Result<Vec<usize>> {
        let (kind, at) = self.value(key)?;
        if kind >> 2 != INTS {
            return Err(NetError::Damaged);
        }
        let (start, width) = (target(self.bytes, at, self.width)?, width_of(kind));
        let count = uint(self.bytes, start.checked_sub(width).ok_or(NetError::Damaged)?, width)?;
        if count > self.bytes.len() {
            return Err(NetError::Damaged);
        }
        (0..count).map(|i| uint(self.bytes, start + i * width, width)).collect()
    }
}
