//! Random media as columns of numbers: what a property is quantified over.

use quickcheck::{Arbitrary, Gen};
use rug::Rational;
use std::sync::Arc;
use volver::case::{Column, Nodes, PolynomialTransfer, Transfer};
use volver::real::Format;

/// C and τ of one segment as m·2^(−16 − shift) with m ≤ 2¹⁶: numbers in [0, 1] that most formats round, and
/// that reach down to subnormal numbers of binary16, of binary32 and of binary64.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    emission: (u32, u32),
    extinction: (u32, u32),
}

const SHIFTS: [u32; 12] = [0, 0, 0, 0, 0, 1, 4, 10, 15, 30, 135, 1060];

fn number(g: &mut Gen) -> (u32, u32) {
    let mantissa = match u8::arbitrary(g) % 8 {
        0 => 0,
        1 => 1 << 16,
        _ => u32::from(u16::arbitrary(g)),
    };
    (mantissa, *g.choose(&SHIFTS).unwrap_or(&0))
}

impl Arbitrary for Sample {
    fn arbitrary(g: &mut Gen) -> Self {
        Sample {
            emission: number(g),
            extinction: number(g),
        }
    }
}

fn value((mantissa, shift): (u32, u32)) -> Rational {
    Rational::from(mantissa) >> (16 + shift)
}

/// Exact C and τ, segment by segment, front to back.
pub(crate) type Medium = Vec<(Rational, Rational)>;

/// The samples as they are.
pub(crate) fn extreme(samples: &[Sample]) -> Medium {
    let exact = |sample: &Sample| (value(sample.emission), value(sample.extinction));
    samples.iter().map(exact).collect()
}

/// At most six of them, with C in eighths between 1/4 and 1/2 and τ between 1/4 and 1/2: no product is small.
pub(crate) fn tame(samples: &[Sample]) -> Medium {
    let between = |(mantissa, _): (u32, u32)| Rational::from(mantissa) / (1_u32 << 18);
    let one = |sample: &Sample| {
        let emission = Rational::from((2 + sample.emission.0 % 3, 8));
        (
            emission,
            between(sample.extinction) + Rational::from((1, 4)),
        )
    };
    samples.iter().take(6).map(one).collect()
}

/// Nodes whose values are given, not computed: sample j is that of segment j wherever it is looked at, the last
/// one also at the far end.
#[derive(Debug)]
pub(crate) struct Columns<F: Format> {
    format: F,
    length: Rational,
    column: Arc<Column<F::Real>>,
}

impl<F: Format> Columns<F> {
    /// Segments of length `step`, each with its C and τ rounded to the format.
    pub(crate) fn new(format: F, medium: &[(Rational, Rational)], step: &Rational) -> Self {
        let round = |q: &Rational| format.ratio(q);
        let with_end = || medium.iter().chain(medium.last());
        Columns {
            format,
            length: Rational::from(step * medium.len() as u64),
            column: Arc::new(Column {
                field: with_end().map(|_| format.int(0)).collect(),
                emission: with_end().map(|(c, _)| round(c)).collect(),
                extinction: with_end().map(|(_, tau)| round(tau)).collect(),
            }),
        }
    }

    pub(crate) fn segments(&self) -> u64 {
        self.column.field.len() as u64 - 1
    }
}

impl<F: Format> Nodes for Columns<F> {
    type Format = F;

    fn format(&self) -> F {
        self.format
    }
    fn length(&self) -> &Rational {
        &self.length
    }
    fn boundaries(&self, _: u64) -> Arc<Column<F::Real>> {
        self.column.clone()
    }
    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<F::Real>> {
        let column = self.column.clone();
        (0..=usize::try_from(n).unwrap()).map(move |j| Transfer {
            emission: column.emission[j].clone(),
            extinction: column.extinction[j].clone(),
        })
    }
    fn interior(&self, _: u64, _: &Rational) -> Arc<Column<F::Real>> {
        let Column {
            mut field,
            mut emission,
            mut extinction,
        } = (*self.column).clone();
        field.pop();
        emission.pop();
        extinction.pop();
        Arc::new(Column {
            field,
            emission,
            extinction,
        })
    }
    fn beyond(&self, _: u64) -> F::Real {
        self.format.int(0)
    }
    fn extinction_at(&self, _: &F::Real) -> F::Real {
        self.format.int(0)
    }
    fn transfer(&self, _: &F::Real) -> Transfer<F::Real> {
        Transfer {
            emission: self.format.int(0),
            extinction: self.format.int(0),
        }
    }
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        None
    }
}
