//! The time of each kind of operation by itself.

use super::{Piece, measured};
use crate::real::counted::{Counted, Kind, count};
use crate::real::{Format, Mpfr, Real, row};
use rug::Rational;
use std::hint::black_box;

/// How many independent operations stand in a row, as in the loops of methods.
const NUMBERS: u64 = 64;
/// What an operation takes at least: a share of a processor's cycle.
const LEAST: f64 = 0.05;
/// Before anything is known of a run: some rational arithmetic for its weights, and some of the allocator's work.
const RUN: f64 = 300.0;
/// And of an evaluation beyond its operations: constants to find, and room for values.
const EVALUATION: f64 = 60.0;

/// Nanoseconds of each kind, in the order of [`Kind::ALL`], and of a run by itself at the end.
pub(super) fn costs<F: Format>(format: F) -> Vec<f64> {
    let pieces = row(Kind::ALL.iter().map(|kind| piece(format, *kind)));
    by_kind(pieces)
}

fn by_kind(mut pieces: Vec<Piece>) -> Vec<f64> {
    let times = measured(&mut pieces);
    let of = |kind: Kind| times.get(kind as usize).copied().unwrap_or(0.0);
    let copy = (of(Kind::Copy) / NUMBERS as f64).max(LEAST);
    let costs = Kind::ALL
        .iter()
        .zip(&pieces)
        .map(|(kind, piece)| match kind {
            Kind::Field | Kind::Transfer | Kind::Extinction => EVALUATION,
            Kind::Copy => copy,
            kind => {
                let copies = copy * piece.counts[Kind::Copy] as f64;
                ((of(*kind) - copies) / piece.counts[*kind].max(1) as f64).max(LEAST)
            }
        });
    costs.chain(std::iter::once(RUN)).collect()
}

fn piece<F: Format>(format: F, kind: Kind) -> Piece {
    // What is counted is the same in every format.
    let counted = numbers(Counted(Mpfr {
        bits: format.bits(),
    }));
    let ((), counts) = count(|| exercise(kind, &counted));
    let numbers = numbers(format);
    Piece {
        counts,
        work: Box::new(move || exercise(kind, &numbers)),
    }
}

/// Numbers between 0 and 1 with no short binary fraction.
fn numbers<F: Format>(format: F) -> Vec<F::Real> {
    row((1..=NUMBERS).map(|i| format.fraction(i, NUMBERS + 3)))
}

/// The operation on all numbers.
fn exercise<R: Real>(kind: Kind, numbers: &[R]) {
    let Some(first) = numbers.first() else { return };
    let format = first.format();
    let all = |operation: fn(R, &R) -> R| {
        for (x, y) in numbers.iter().zip(numbers.iter().rev()) {
            black_box(operation(black_box(x).clone(), y));
        }
    };
    match kind {
        Kind::Addition => all(|x, y| x + y),
        Kind::Multiplication => all(|x, y| x * y),
        Kind::Division => all(|x, y| x / y),
        Kind::Negation => all(|x, _| -x),
        Kind::Comparison => {
            for (x, y) in numbers.iter().zip(numbers.iter().rev()) {
                black_box(black_box(x) < y);
            }
        }
        Kind::SquareRoot => all(|x, _| x.sqrt()),
        Kind::Exponential => all(|x, _| x.exp()),
        Kind::ExponentialMinusOne => all(|x, _| x.exp_m1()),
        Kind::Logarithm => all(|x, _| x.ln()),
        Kind::SineCosine => all(|x, _| x.sin_cos().0),
        Kind::Tangent => all(|x, _| x.tan()),
        Kind::Hyperbolic => all(|x, _| x.tanh()),
        Kind::Arctangent => all(|x, _| x.atan()),
        Kind::ErrorFunction => all(|x, _| x.erf()),
        Kind::Integer => repeat(|i| format.int(i.cast_signed())),
        Kind::Fraction => repeat(|i| format.fraction(i, NUMBERS + 3)),
        Kind::Constant => {
            let third = Rational::from((1, 3));
            repeat(|_| format.ratio(&third));
        }
        Kind::Copy => all(|x, _| x),
        Kind::Field | Kind::Transfer | Kind::Extinction => {}
    }
}

fn repeat<R>(make: impl Fn(u64) -> R) {
    for i in 0..NUMBERS {
        black_box(make(black_box(i)));
    }
}
