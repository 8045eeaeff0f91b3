//! Places of a ray that is divided evenly, each rounded once.

use super::grid::Grid;
use super::twice::Twice;
use crate::real::Format;
use rug::Rational;

/// The places D·(j + offset)/n.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    way: Way,
    /// D·offset/n and D/n.
    first: Rational,
    step: Rational,
}

/// What they are worked out from.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// Fractions of machine integers.
    Fractions(Grid),
    /// Twice the digits of binary64, where these decide.
    Twice(Twice),
    /// Rational numbers.
    Exact,
}

impl Places {
    pub(crate) fn new(length: &Rational, n: u64, offset: &Rational) -> Places {
        let fractions = Grid::new(length, n, offset).map(Way::Fractions);
        let twice = || Twice::new(length, n, offset).map(Way::Twice);
        let step = Rational::from(length) / n;
        Places {
            way: fractions.or_else(twice).unwrap_or(Way::Exact),
            first: Rational::from(offset * &step),
            step,
        }
    }

    /// Place j ≤ n + 1, rounded once to nearest.
    // A call a place is a twentieth of a ray's time.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    pub(crate) fn at<F: Format>(&self, format: F, j: u64) -> F::Real {
        match &self.way {
            Way::Fractions(grid) => {
                let (numerator, denominator) = grid.place(j);
                format.fraction(numerator, denominator)
            }
            Way::Twice(twice) => {
                let place = twice.place(format, j);
                place.unwrap_or_else(|| self.exactly(format, j))
            }
            Way::Exact => self.exactly(format, j),
        }
    }

    #[cold]
    #[inline(never)]
    fn exactly<F: Format>(&self, format: F, j: u64) -> F::Real {
        format.ratio(&(Rational::from(&self.step * j) + &self.first))
    }
}
