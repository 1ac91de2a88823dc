//! Learned numbers in bytes: matrices of one byte a number, scaled row by row.

/// A matrix, row by row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Matrix {
    /// Its rows.
    pub rows: usize,
    /// Numbers in each.
    pub columns: usize,
    /// The numbers, row by row.
    pub values: Vec<f32>,
}

impl Matrix {
    /// A row.
    #[must_use]
    pub fn row(&self, n: usize) -> &[f32] {
        &self.values[n * self.columns..(n + 1) * self.columns]
    }

    /// The product with a column, added to `out`.
    ///
    /// # Panics
    /// When the column is not as long as a row.
    pub fn times(&self, column: &[f32], out: &mut [f32]) {
        assert_eq!(column.len(), self.columns, "a column as long as a row");
        for (o, row) in out.iter_mut().zip(self.values.chunks_exact(self.columns.max(1))) {
            *o += dot(row, column);
        }
    }
}

/// The inner product, by sixteen sums side by side, which the processor can do at once.
#[must_use]
pub(crate) fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0_f32; 16];
    let (whole, rest) = a.as_chunks::<16>();
    let (other, tail) = b.as_chunks::<16>();
    for (x, y) in whole.iter().zip(other) {
        for k in 0..16 {
            sums[k] += x[k] * y[k];
        }
    }
    sums.iter().sum::<f32>() + rest.iter().zip(tail).map(|(x, y)| x * y).sum::<f32>()
}

/// Numbers on their way into bytes.
#[derive(Debug, Default)]
pub(crate) struct Writer(pub Vec<u8>);

impl Writer {
    /// A count.
    pub(crate) fn count(&mut self, n: usize) {
        self.0.extend((n as u32).to_le_bytes());
    }

    /// Numbers as they are, their count first.
    pub(crate) fn numbers(&mut self, values: &[f32]) {
        self.count(values.len());
        values.iter().for_each(|v| self.0.extend(v.to_le_bytes()));
    }

    /// A matrix of one byte a number: each row's largest becomes 127.
    pub(crate) fn matrix(&mut self, matrix: &Matrix) {
        self.count(matrix.rows);
        self.count(matrix.columns);
        for n in 0..matrix.rows {
            let row = matrix.row(n);
            let scale = row.iter().fold(0.0_f32, |m, v| m.max(v.abs())).max(1e-12) / 127.0;
            self.0.extend(scale.to_le_bytes());
            self.0.extend(row.iter().map(|v| (v / scale).round() as i8 as u8));
        }
    }
}

/// Bytes on their way back into numbers; none where they end too early.
#[derive(Debug)]
pub(crate) struct Reader<'a>(pub &'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (head, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(*head)
    }

    /// A count.
    pub(crate) fn count(&mut self) -> Option<usize> {
        Some(u32::from_le_bytes(self.take()?) as usize)
    }

    /// Numbers with their count before them.
    pub(crate) fn numbers(&mut self) -> Option<Vec<f32>> {
        (0..self.count()?).map(|_| Some(f32::from_le_bytes(self.take()?))).collect()
    }

    /// A matrix of one byte a number.
    pub(crate) fn matrix(&mut self) -> Option<Matrix> {
        let (rows, columns) = (self.count()?, self.count()?);
        let mut values = Vec::new();
        for _ in 0..rows {
            let scale = f32::from_le_bytes(self.take()?);
            let (row, rest) = self.0.split_at_checked(columns)?;
            self.0 = rest;
            values.extend(row.iter().map(|v| f32::from(*v as i8) * scale));
        }
        Some(Matrix { rows, columns, values })
    }
}
