//! Functions of MPFR's formats are MPFR's own to the last bit, whoever computes them.

use super::elementary::functions;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rug::Float;
use rug::float::Special;
use volver::real::MpfrReal;

/// The same number, or NaN both; zeros by their signs.
fn is_same(a: &Float, b: &Float) -> bool {
    let is_nan = a.is_nan() && b.is_nan();
    is_nan || (a == b && a.is_sign_negative() == b.is_sign_negative())
}

fn agree_at(x: &Float) {
    for (name, function, in_mpfr) in functions::<MpfrReal>() {
        let found: Float = function(x.clone().into()).into();
        let wanted = in_mpfr(x.clone());
        assert!(
            is_same(&found, &wanted),
            // Numbers near the end of MPFR's exponents have no text.
            "{name} of {:?} in {} bits",
            x.to_f64(),
            x.prec()
        );
    }
}

#[test]
fn functions_are_rounded_as_in_mpfr() {
    let mut random = Pcg64::seed_from_u64(7);
    for bits in [2, 3, 24, 53, 64, 113, 200, 341, 1000] {
        // Down to where e^x lies beside the middle of two numbers, which no few bits more settle.
        let lowest = 2 * i64::from(bits) + 60;
        for _ in 0..120 {
            let mut digits = Float::with_val(bits, random.next_u64() | (1 << 63));
            while digits.prec() > 64 && random.next_u64() % 4 > 0 {
                digits = digits / 3 + Float::with_val(bits, random.next_u64());
            }
            let span = u64::try_from(lowest + 12).unwrap();
            let exponent = 12 - i64::try_from(random.next_u64() % span).unwrap();
            let top = i64::from(digits.get_exp().unwrap());
            let x = digits << i32::try_from(exponent - top).unwrap();
            agree_at(&x);
            agree_at(&-x);
        }
    }
}

#[test]
fn functions_of_special_numbers_are_those_of_mpfr() {
    for bits in [24, 341] {
        let specials = [
            Special::Zero,
            Special::NegZero,
            Special::Infinity,
            Special::NegInfinity,
            Special::Nan,
        ];
        for special in specials {
            agree_at(&Float::with_val(bits, special));
        }
        let one = Float::with_val(bits, 1);
        for shift in (0..40).chain([-1, -40, 70_000, -65_535, -65_536, -65_537]) {
            let x = Float::with_val(bits, &one << shift);
            agree_at(&x);
            agree_at(&-x);
        }
    }
}
