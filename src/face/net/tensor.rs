//! The tensors of a net: shapes, and the constants among them.

use std::sync::Arc;

use super::error::{NetError, Result};
use super::flatbuffer::Table;

/// The most values of a tensor.
const MOST: usize = 1 << 24;

/// Types of values, as the format numbers them.
const FLOAT32: u8 = 0;
const FLOAT16: u8 = 1;
const INT32: u8 = 2;

/// A tensor: a shape, and values where the file has them.
#[derive(Debug, Clone, Default)]
pub(super) struct Tensor {
    /// Lengths along the axes, none of them 0; batch, height, width, channels for images.
    pub shape: Vec<usize>,
    /// Constant weights, 32 bits wide.
    pub floats: Option<Arc<[f32]>>,
    /// Constant whole numbers.
    pub ints: Vec<i32>,
}

impl Tensor {
    /// Reads a tensor of a model whose constants are in `buffers`.
    pub(super) fn read(tensor: Table<'_>, buffers: &[Table<'_>]) -> Result<Self> {
        let shape = tensor.ints(0)?.into_iter().map(|length| usize::try_from(length).ok().filter(|l| *l > 0));
        let shape: Vec<usize> = shape.collect::<Option<_>>().ok_or(NetError::Damaged)?;
        let length = shape.iter().try_fold(1_usize, |product, length| product.checked_mul(*length));
        let length = length.filter(|length| *length <= MOST).ok_or(NetError::TooLarge)?;
        let buffer = usize::try_from(tensor.int(2, 0)?).ok().and_then(|index| buffers.get(index));
        let data = buffer.ok_or(NetError::Damaged)?.bytes(0)?;
        let mut read = Self { shape, floats: None, ints: Vec::new() };
        if data.is_empty() {
            return Ok(read);
        }
        let is_sparse = tensor.table(6)?.is_some();
        let values = match tensor.byte(1)? {
            _ if is_sparse => return Err(NetError::UnknownOperation("sparse tensor".into())),
            FLOAT32 => {
                read.floats = Some(data.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b)).collect());
                data.len() / 4
            }
            FLOAT16 => {
                read.floats = Some(data.as_chunks().0.iter().map(|b| widen(u16::from_le_bytes(*b))).collect());
                data.len() / 2
            }
            INT32 => {
                read.ints = data.as_chunks().0.iter().map(|b| i32::from_le_bytes(*b)).collect();
                data.len() / 4
            }
            _ => return Err(NetError::UnknownOperation("tensor type".into())),
        };
        if values == length { Ok(read) } else { Err(NetError::Damaged) }
    }

    /// Number of values.
    pub(super) fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// True if the file has its values.
    pub(super) fn is_constant(&self) -> bool {
        self.floats.is_some() || !self.ints.is_empty()
    }

    /// Length along the last axis.
    pub(super) fn channels(&self) -> usize {
        self.shape.last().copied().unwrap_or(1)
    }
}

/// A 16-bit float (IEEE 754 binary16) as a 32-bit one, exactly.
fn widen(half: u16) -> f32 {
    let (sign, exponent, fraction) = (u32::from(half >> 15) << 31, u32::from(half >> 10 & 31), u32::from(half & 1023));
    match exponent {
        0 => f32::from_bits(sign) + f32::from_bits(sign | 1.0_f32.to_bits()) * fraction as f32 / 16_777_216.0,
        31 => f32::from_bits(sign | 0x7f80_0000 | fraction << 13),
        _ => f32::from_bits(sign | (exponent + 112) << 23 | fraction << 13),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_floats_widen_exactly() {
        let pairs: [(u16, f32); 8] = [
            (0x0000, 0.0),
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x7bff, 65504.0),
            (0x0400, 6.103_515_6e-5),
            (0x0001, 5.960_464_5e-8),
            (0x8001, -5.960_464_5e-8),
            (0x3555, 0.333_251_95),
        ];
        for (half, value) in pairs {
            assert_eq!(widen(half), value, "{half:#06x}");
        }
        assert!(widen(0x7c00).is_infinite() && widen(0x7c01).is_nan());
    }
}
