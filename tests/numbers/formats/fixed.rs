//! Fixed point against exact rational arithmetic, rounded by its definition.

use super::elementary::functions;
use quickcheck::QuickCheck;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rug::{Float, Integer, Rational};
use volver::real::{Fixed, FixedReal, Format, FormatError, Real};

const PLACES: [(u32, u32); 7] = [
    (16, 15),
    (16, 30),
    (8, 24),
    (0, 1),
    (0, 30),
    (3, 2),
    (16, 1),
];

fn largest(format: Fixed) -> i64 {
    (1 << (format.integer_bits() + format.fraction_bits())) - 1
}

/// The multiple of the quantum nearest to `exact`, ties to even, or the nearer end.
fn by_definition(format: Fixed, exact: &Rational) -> i64 {
    let quanta = Rational::from(exact << format.fraction_bits());
    let (rest, below) = quanta.fract_floor(Integer::new());
    let half = Rational::from((1, 2));
    let up = rest > half || (rest == half && below.is_odd());
    let largest = largest(format);
    (below + i32::from(up))
        .clamp(&-largest, &largest)
        .to_i64()
        .unwrap()
}

fn quanta(format: Fixed, quanta: i64) -> FixedReal {
    let x = format.ratio(&(Rational::from(quanta) >> format.fraction_bits()));
    assert_eq!(x.quanta(), Some(quanta));
    x
}

/// Of any size that the format has.
fn draw(format: Fixed, random: &mut Pcg64) -> FixedReal {
    let bits = u64::from(format.integer_bits() + format.fraction_bits());
    let drop = 64 - bits + random.next_u64() % (bits + 1);
    let size = random.next_u64().checked_shr(u32::try_from(drop).unwrap());
    let size = i64::try_from(size.unwrap_or(0)).unwrap();
    let negative = random.next_u64().is_multiple_of(2);
    quanta(format, if negative { -size } else { size })
}

/// Two numbers whose product, unless it is beyond an end, is an odd multiple of half a quantum.
fn tie(x: FixedReal, random: &mut Pcg64) -> (FixedReal, FixedReal) {
    let format = x.format();
    let shift = random.next_u64() % u64::from(format.fraction_bits());
    let odd = (x.quanta().unwrap() >> shift | 1) << shift;
    let power = u64::from(format.fraction_bits()) - 1 - shift;
    (quanta(format, odd), quanta(format, 1 << power))
}

#[test]
fn arithmetic_is_exact_arithmetic_rounded_once() {
    let mut random = Pcg64::seed_from_u64(3);
    for (integer, fraction) in PLACES {
        let format = Fixed::new(integer, fraction).unwrap();
        let (mut ends, mut ties) = (0, 0);
        for i in 0..15_000 {
            let (mut x, mut y) = (draw(format, &mut random), draw(format, &mut random));
            if i % 4 == 0 {
                (x, y) = tie(x, &mut random);
            }
            let (a, b) = (x.to_rational().unwrap(), y.to_rational().unwrap());
            let mut checks = vec![
                ("+", x + &y, Rational::from(&a + &b)),
                ("−", x - &y, Rational::from(&a - &b)),
                ("×", x * &y, Rational::from(&a * &b)),
            ];
            if b != 0 {
                checks.push(("÷", x / &y, a / b));
            }
            for (operation, ours, exact) in checks {
                let expected = by_definition(format, &exact);
                assert_eq!(
                    ours.quanta(),
                    Some(expected),
                    "{x} {operation} {y} in {format}"
                );
                ends += u32::from(expected.abs() == largest(format));
                let twice = Rational::from(&exact << (format.fraction_bits() + 1));
                ties += u32::from(twice.is_integer() && twice.numer().is_odd());
            }
        }
        println!("{format}: {ends} at an end, {ties} ties");
        assert!(ends > 300 && ties > 3000, "{format}: {ends}, {ties}");
    }
}

#[test]
fn elementary_functions_are_correctly_rounded() {
    let mut random = Pcg64::seed_from_u64(4);
    let mut invalid = 0;
    for (integer, fraction) in PLACES {
        let format = Fixed::new(integer, fraction).unwrap();
        for _ in 0..1500 {
            let x = draw(format, &mut random);
            for (name, ours, by_mpfr) in functions() {
                let y = by_mpfr(Float::with_val(256, x.to_rational().unwrap()));
                let expected = if y.is_nan() {
                    invalid += 1;
                    None
                } else if y.get_exp().is_none_or(|exp| exp > 20) && !y.is_zero() {
                    Some(largest(format) * if y.is_sign_negative() { -1 } else { 1 })
                } else {
                    Some(by_definition(format, &y.to_rational().unwrap()))
                };
                assert_eq!(ours(x).quanta(), expected, "{name}({x}) in {format}");
            }
        }
    }
    assert!(invalid > 1000);
}

#[test]
fn constants_are_rounded_once() {
    let pi = Float::with_val(256, rug::float::Constant::Pi).to_rational();
    let mut random = Pcg64::seed_from_u64(5);
    for (integer, fraction) in PLACES {
        let format = Fixed::new(integer, fraction).unwrap();
        let expect = |exact: &Rational| Some(by_definition(format, exact));
        assert_eq!(format.pi().quanta(), expect(pi.as_ref().unwrap()));
        for n in [0, 1, -1, 7, 65535, 65536, i64::MAX, i64::MIN] {
            assert_eq!(format.int(n).quanta(), expect(&n.into()), "{n}");
        }
        for _ in 0..2000 {
            let shift = random.next_u64() % 64;
            let a = random.next_u64() >> shift;
            let b = (random.next_u64() >> (random.next_u64() % 64)).max(1);
            let q = Rational::from((a, b));
            assert_eq!(format.fraction(a, b).quanta(), expect(&q), "{q}");
            assert_eq!(format.ratio(&-q.clone()).quanta(), expect(&-q));
            // A tie, and a hair beside it.
            let tie = Rational::from(2 * (a >> 20) + 1) >> (format.fraction_bits() + 1);
            let hair = Rational::from(1) >> 300_u32;
            for q in [tie.clone(), tie.clone() + &hair, tie - &hair] {
                assert_eq!(format.ratio(&q).quanta(), expect(&q), "{q}");
            }
        }
    }
}

#[test]
fn ends_and_invalid_operations() {
    let format = Fixed::new(16, 15).unwrap();
    let (zero, one, end) = (format.int(0), format.int(1), format.int(1 << 20));
    assert_eq!(end.quanta(), Some((1 << 31) - 1));
    assert_eq!(end + &one, end);
    assert_eq!(-end - &one, -end);
    assert_eq!(end * &-end, -end);
    assert_eq!(one / &zero, end);
    assert_eq!(-one / &zero, -end);
    assert_eq!(format.int(12).exp(), end);
    assert_eq!(format.int(-12).exp(), zero);
    assert_eq!(zero.ln(), -end);
    assert_eq!((-one).ln_1p(), -end);
    let nan = zero / &zero;
    for x in [nan, (-one).sqrt(), (-one).ln(), format.int(-2).ln_1p()] {
        assert!(!x.is_finite() && x.quanta().is_none() && x.to_rational().is_none());
        assert_ne!(x, x);
        assert_eq!(x.partial_cmp(&one), None);
        assert!(x.log2_abs().is_nan());
        assert_eq!(x.to_string(), "NaN");
    }
    for x in [
        nan + &one,
        one + &nan,
        nan - &one,
        one * &nan,
        nan / &one,
        one / &nan,
        nan.exp(),
    ] {
        assert!(!x.is_finite());
    }
    assert_eq!((format.fraction(1, 3)).to_string(), "0.333343505859375");
    assert_eq!(format.fraction(3, 8).log2_abs(), 0.375_f64.log2());
    assert_eq!(zero.log2_abs(), f64::NEG_INFINITY);
    assert_eq!(one.format(), format);
}

/// Between two formats the result is of the left one's, rounded once.
#[test]
fn the_left_operand_has_the_format() {
    let (coarse, fine) = (Fixed::new(4, 3).unwrap(), Fixed::new(8, 20).unwrap());
    let (x, y) = (coarse.fraction(11, 8), fine.fraction(1_000_001, 1_000_000));
    let b = y.to_rational().unwrap();
    let a = Rational::from((11, 8));
    let expect = |q: Rational| Some(by_definition(coarse, &q));
    assert_eq!((x + &y).quanta(), expect(Rational::from(&a + &b)));
    assert_eq!((x - &y).quanta(), expect(Rational::from(&a - &b)));
    assert_eq!((x * &y).quanta(), expect(Rational::from(&a * &b)));
    assert_eq!((x / &y).quanta(), expect(a / b));
    let mut target = x;
    target.set(&fine.fraction(3, 16));
    assert_eq!(target, coarse.fraction(1, 4));
    assert_eq!(target.format(), coarse);
    assert!(y > coarse.int(1) && fine.int(1) == coarse.int(1));
}

#[test]
fn laws() {
    fn check(a: i32, b: i32, c: i32, places: u8) -> bool {
        let (integer, fraction) = PLACES[usize::from(places) % PLACES.len()];
        let format = Fixed::new(integer, fraction).unwrap();
        let of = |x: i32| {
            quanta(
                format,
                i64::from(x).clamp(-largest(format), largest(format)),
            )
        };
        let (a, b, c) = (of(a), of(b), of(c));
        let (low, high) = if a <= b { (a, b) } else { (b, a) };
        let sum = a + &b;
        let inside = sum.quanta().unwrap().abs() < largest(format);
        sum == b + &a
            && a * &b == b * &a
            && -(a * &b) == (-a) * &b
            && a - &a == format.int(0)
            && (!inside || sum - &b == a)
            && low + &c <= high + &c
            && low * &c.abs() <= high * &c.abs()
            && low.exp() <= high.exp()
            && low.atan() <= high.atan()
            && (a == format.int(0) || a / &a == format.int(1))
            && a.abs() >= format.int(0)
    }
    let mut quickcheck = QuickCheck::new().tests(5000).max_tests(5000);
    quickcheck.quickcheck(check as fn(i32, i32, i32, u8) -> bool);
}

/// Worked by hand, by division and as a rational.
#[test]
fn quotients_round_to_nearest_and_ties_to_even() {
    let format = Fixed::new(8, 4).unwrap();
    let nearest = |numerator: i64, denominator: i64| {
        let quotient = quanta(format, numerator) / &format.int(denominator);
        let exact = Rational::from((numerator, denominator)) >> format.fraction_bits();
        assert_eq!(format.ratio(&exact), quotient);
        quotient.quanta().unwrap()
    };
    // −2.5, −1.5, −0.5, 0.5, 1.5, 2.5 and beside them.
    let halves = [(-5, -2), (-3, -2), (-1, 0), (1, 0), (3, 2), (5, 2)];
    for (numerator, expected) in halves {
        assert_eq!(nearest(numerator, 2), expected, "{numerator}/2");
    }
    for (numerator, expected) in [(-8, -3), (-7, -2), (-4, -1), (4, 1), (7, 2), (8, 3), (9, 3)] {
        assert_eq!(nearest(numerator, 3), expected, "{numerator}/3");
    }
}

#[test]
fn what_is_out_of_range_is_refused_with_what_is_allowed() {
    for (integer, fraction) in [(17, 15), (16, 0), (16, 31), (u32::MAX, u32::MAX)] {
        let error = Fixed::new(integer, fraction).unwrap_err();
        assert_eq!(error, FormatError::FixedRange { integer, fraction });
        assert_eq!(
            error.to_string(),
            format!(
                "format 'fixed:{integer}.{fraction}' is out of range (allowed: fixed:INTEGER.FRACTION with 0 ≤ INTEGER ≤ 16, 1 ≤ FRACTION ≤ 30)"
            )
        );
    }
}

#[test]
fn the_bits_are_those_after_the_point() {
    let format = Fixed::new(8, 24).unwrap();
    assert_eq!(
        (format.bits(), format.integer_bits(), format.fraction_bits()),
        (24, 8, 24)
    );
}
