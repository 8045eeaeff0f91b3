//! The lanes' format: functions against other libraries, and the same bits whatever the width.

// What takes lanes must be inlined into the function that has the instructions.
#![allow(clippy::inline_always)]

mod binary32;
mod binary64;
mod widths;

use rug::Float;
use volver::real::lanes::{LaneFloat, Lanes, Width, WithLanes};

#[derive(Clone, Copy, Debug, PartialEq)]
enum Function {
    Exp,
    ExpM1,
    Sin,
    Cos,
}

const FUNCTIONS: [Function; 4] = [Function::Exp, Function::ExpM1, Function::Sin, Function::Cos];

impl Function {
    /// What the format promises, in units in the last place.
    fn units(self) -> f64 {
        match self {
            Function::Exp | Function::ExpM1 => 1.0,
            Function::Sin | Function::Cos => 2.0,
        }
    }

    /// By glibc, far better than binary32 needs.
    fn of_f64(self, x: f64) -> f64 {
        match self {
            Function::Exp => x.exp(),
            Function::ExpM1 => x.exp_m1(),
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
        }
    }

    fn by_mpfr(self, x: Float) -> Float {
        match self {
            Function::Exp => x.exp(),
            Function::ExpM1 => x.exp_m1(),
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
        }
    }
}

/// A function of each of a row whose length is a multiple of every width.
struct OfEach<'r, T> {
    function: Function,
    row: &'r [T],
    results: &'r mut [T],
}

impl<T: LaneFloat> WithLanes<T> for OfEach<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes<Element = T>>(self, zero: L) {
        let rows = self.row.chunks_exact(L::WIDTH);
        for (x, result) in rows.zip(self.results.chunks_exact_mut(L::WIDTH)) {
            let x = zero.load(x);
            match self.function {
                Function::Exp => Lanes::exp(x),
                Function::ExpM1 => Lanes::exp_m1(x),
                Function::Sin => Lanes::sin_cos(x).0,
                Function::Cos => Lanes::sin_cos(x).1,
            }
            .store(result);
        }
    }
}

/// The results by one width.
fn results<T: LaneFloat>(width: Width, function: Function, row: &[T]) -> Vec<T> {
    let mut results = vec![T::ZERO; row.len()];
    width.with(OfEach {
        function,
        row,
        results: &mut results,
    });
    results
}
