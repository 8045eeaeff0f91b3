//! Places of a ray as fractions of machine integers.

use rug::Rational;

/// The places D·(j + p/q)/n for j = 0 … n + 1, all over one denominator.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    first: u64,
    stride: u64,
    denominator: u64,
}

impl Grid {
    /// `None` where a numerator or the denominator is no machine integer: an offset that stands for an
    /// irrational number, or a ray length of many digits.
    #[must_use]
    pub fn new(length: &Rational, n: u64, offset: &Rational) -> Option<Grid> {
        let (length, unit) = (length.numer().to_u64()?, length.denom().to_u64()?);
        let (p, q) = (offset.numer().to_u64()?, offset.denom().to_u64()?);
        let grid = Grid {
            first: length.checked_mul(p)?,
            stride: length.checked_mul(q)?,
            denominator: unit.checked_mul(q)?.checked_mul(n)?,
        };
        let last = grid.stride.checked_mul(n.checked_add(1)?)?;
        last.checked_add(grid.first)?;
        Some(grid)
    }

    /// Numerator and denominator of place j ≤ n + 1.
    #[inline]
    #[must_use]
    pub fn place(&self, j: u64) -> (u64, u64) {
        (j * self.stride + self.first, self.denominator)
    }
}
