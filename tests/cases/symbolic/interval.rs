//! Each operation contains what MPFR gives at 400 bits for points of its arguments, and little more.

use quickcheck::QuickCheck;
use rug::float::Constant;
use rug::ops::Pow;
use rug::{Float, Rational};
use volver::symbolic::{Interval, Undefined};

const EXACT_BITS: u32 = 400;
const BITS: [u32; 2] = [24, 53];

fn q(n: i64, d: i64) -> Rational {
    Rational::from((n, d))
}

fn box_of(bits: u32, from: (i64, i64), to: (i64, i64)) -> Interval {
    Interval::hull(bits, &Rational::from(from), &Rational::from(to))
}

/// Numbers inside and on the bounds of a box, from whatever quickcheck gives.
#[derive(Clone, Debug)]
struct Sample {
    from: Rational,
    to: Rational,
    at: Rational,
}

impl Sample {
    fn new((start, width, place): (i32, u32, u8)) -> Sample {
        // Small, ordinary and large numbers, none of them dyadic; some widths are 0.
        let scale = [q(1, 9973), q(1, 97), q(11, 13), q(1_000_003, 7)];
        let of = |n: u32, count: u32| &scale[(n % count) as usize];
        let from = Rational::from(start % 1000) * of(start.unsigned_abs(), 4);
        let size = i64::from(width % 1000) * i64::from(width % 5 != 0);
        let to = &from + Rational::from(size) * of(width, 3);
        let place = match place % 4 {
            0 => q(0, 1),
            1 => q(1, 1),
            _ => q(i64::from(place), 255),
        };
        let at = &from + Rational::from(&to - &from) * place;
        Sample { from, to, at }
    }

    fn hull(&self, bits: u32) -> Interval {
        Interval::hull(bits, &self.from, &self.to)
    }

    fn exact(&self) -> Float {
        Float::with_val(EXACT_BITS, &self.at)
    }
}

type Unary = (
    &'static str,
    fn(&Interval) -> Result<Interval, Undefined>,
    fn(Float) -> Float,
);

const UNARY: [Unary; 25] = [
    ("-", |x| Ok(-x), |x| -x),
    ("abs", |x| Ok(x.abs()), Float::abs),
    ("exp", |x| Ok(x.exp()), Float::exp),
    ("ln", Interval::ln, Float::ln),
    ("sin", |x| Ok(x.sin()), Float::sin),
    ("cos", |x| Ok(x.cos()), Float::cos),
    ("tan", Interval::tan, Float::tan),
    ("sinh", |x| Ok(x.sinh()), Float::sinh),
    ("cosh", |x| Ok(x.cosh()), Float::cosh),
    ("tanh", |x| Ok(x.tanh()), Float::tanh),
    ("atan", |x| Ok(x.atan()), Float::atan),
    ("erf", |x| Ok(x.erf()), Float::erf),
    ("sqrt", Interval::sqrt, Float::sqrt),
    ("x^0", |x| x.pow(&q(0, 1)), |x| x.pow(0)),
    ("x^1", |x| x.pow(&q(1, 1)), |x| x.pow(1)),
    ("x^2", |x| x.pow(&q(2, 1)), |x| x.pow(2)),
    ("x^3", |x| x.pow(&q(3, 1)), |x| x.pow(3)),
    ("x^-1", |x| x.pow(&q(-1, 1)), Float::recip),
    ("x^-2", |x| x.pow(&q(-2, 1)), |x| x.pow(-2)),
    ("x^-3", |x| x.pow(&q(-3, 1)), |x| x.pow(-3)),
    ("x^(1/3)", |x| x.pow(&q(1, 3)), |x| x.root(3)),
    ("x^(5/2)", |x| x.pow(&q(5, 2)), |x| x.sqrt().pow(5)),
    ("x^(-2/3)", |x| x.pow(&q(-2, 3)), |x| x.root(3).pow(-2)),
    (
        "x^(2/(2^33+1))",
        |x| x.pow(&q(2, (1 << 33) + 1)),
        |x| (x.ln() * 2_u32 / ((1_u64 << 33) + 1)).exp(),
    ),
    (
        "x^(-2/(2^33+1))",
        |x| x.pow(&q(-2, (1 << 33) + 1)),
        |x| (x.ln() * -2_i32 / ((1_u64 << 33) + 1)).exp(),
    ),
];

#[test]
fn unary_operations_contain_their_values() {
    fn check(seed: (i32, u32, u8)) -> bool {
        let sample = Sample::new(seed);
        for (name, interval, exact) in UNARY {
            for bits in BITS {
                let Ok(result) = interval(&sample.hull(bits)) else {
                    continue;
                };
                let value = exact(sample.exact());
                assert!(result.contains(&value), "{name} {sample:?}: {result:.30}");
                assert_eq!(result.bits(), bits, "{name}");
            }
        }
        true
    }
    QuickCheck::new()
        .tests(1500)
        .quickcheck(check as fn((i32, u32, u8)) -> bool);
}

type Binary = (
    &'static str,
    fn(&Interval, &Interval) -> Result<Interval, Undefined>,
    fn(Float, Float) -> Float,
);

const BINARY: [Binary; 7] = [
    ("+", |x, y| Ok(x + y), |x, y| x + y),
    ("-", |x, y| Ok(x - y), |x, y| x - y),
    ("*", |x, y| Ok(x * y), |x, y| x * y),
    ("/", Interval::divide, |x, y| x / y),
    ("min", |x, y| Ok(x.min(y)), |x, y| x.min(&y)),
    ("max", |x, y| Ok(x.max(y)), |x, y| x.max(&y)),
    ("union", |x, y| Ok(x.union(y)), |x, _| x),
];

#[test]
fn binary_operations_contain_their_values() {
    fn check(a: (i32, u32, u8), b: (i32, u32, u8)) -> bool {
        let (a, b) = (Sample::new(a), Sample::new(b));
        for (name, interval, exact) in BINARY {
            for bits in BITS {
                let Ok(result) = interval(&a.hull(bits), &b.hull(bits)) else {
                    continue;
                };
                let value = exact(a.exact(), b.exact());
                assert!(result.contains(&value), "{name} {a:?} {b:?}: {result:.30}");
            }
        }
        true
    }
    QuickCheck::new()
        .tests(5_000)
        .quickcheck(check as fn((i32, u32, u8), (i32, u32, u8)) -> bool);
}

/// The bounds are at most `ulps` units in the last place of 53 bits from what is given.
fn assert_tight(result: &Interval, lower: &Float, upper: &Float, ulps: u32) {
    for (bound, exact) in [(result.lower(), lower), (result.upper(), upper)] {
        let ulp = Float::with_val(53, exact.abs_ref()) >> 52_u32;
        let distance = Float::with_val(EXACT_BITS, bound - exact).abs();
        assert!(
            distance <= ulp * ulps,
            "{result:.30}: {lower:.30}, {upper:.30}"
        );
    }
    assert!(result.lower() <= lower && upper <= result.upper());
}

#[test]
fn results_are_tight() {
    let exact = |n: i64| Float::with_val(EXACT_BITS, n);
    let e = exact(1).exp();
    assert_tight(&Interval::point(53, &q(1, 1)).exp(), &e, &e, 1);
    let waves = box_of(53, (0, 1), (4, 1)).sin();
    assert_tight(&waves, &exact(4).sin(), &exact(1), 2);
    assert_eq!(*waves.upper(), 1);
    let square = box_of(53, (-1, 1), (2, 1)).pow(&q(2, 1)).unwrap();
    assert_eq!(square, box_of(53, (0, 1), (4, 1)));
    let falls = box_of(53, (-4, 1), (-2, 1)).pow(&q(-3, 1)).unwrap();
    assert_eq!(falls, box_of(53, (-1, 8), (-1, 64)));
    let root = box_of(53, (4, 1), (9, 1)).pow(&q(3, 2)).unwrap();
    assert_eq!(root, box_of(53, (8, 1), (27, 1)));
    let even = box_of(53, (-1, 1), (3, 1));
    assert_tight(&even.cosh(), &exact(1), &exact(3).cosh(), 1);
    assert_eq!(even.abs(), box_of(53, (0, 1), (3, 1)));
    // The signs of two factors decide which bounds are multiplied.
    for (a, b, c, d, from, to) in [
        (1, 2, 3, 4, 3, 8),
        (1, 2, -3, 4, -6, 8),
        (1, 2, -4, -3, -8, -3),
        (-1, 2, 3, 4, -4, 8),
        (-1, 2, -3, 4, -6, 8),
        (-5, 2, -3, 4, -20, 15),
        (-1, 2, -4, -3, -8, 4),
        (-2, -1, 3, 4, -8, -3),
        (-2, -1, -3, 4, -8, 6),
        (-2, -1, -4, -3, 3, 8),
    ] {
        let product = &box_of(53, (a, 1), (b, 1)) * &box_of(53, (c, 1), (d, 1));
        assert_eq!(product, box_of(53, (from, 1), (to, 1)));
    }
    let quotient = box_of(53, (-3, 1), (6, 1)).divide(&box_of(53, (-4, 1), (-2, 1)));
    assert_eq!(quotient.unwrap(), box_of(53, (-3, 1), (3, 2)));
    // Two ends of a third are one apart in the last place.
    assert_tight(
        &Interval::point(53, &q(1, 3)),
        &(exact(1) / 3),
        &(exact(1) / 3),
        1,
    );
    let pi = Float::with_val(EXACT_BITS, Constant::Pi);
    assert_tight(&Interval::pi(53), &pi, &pi, 1);
}

#[test]
fn sines_of_large_and_huge_arguments() {
    // sin 10²² = −0.85… is rising: the next maximum is at 10²² + 2.6, the next minimum farther on.
    let large = Rational::from(rug::Integer::from(10).pow(22));
    let exact = Float::with_val(EXACT_BITS, &large).sin();
    assert_tight(&Interval::point(100, &large).sin(), &exact, &exact, 1);
    let more = Rational::from(&large + 3);
    let wave = Interval::hull(100, &large, &more).sin();
    assert_tight(&wave, &exact, &Float::with_val(EXACT_BITS, 1), 1);
    let less = Interval::hull(100, &large, &Rational::from(&large + 2)).sin();
    assert!(*less.upper() < 1);
    assert_eq!(Interval::entire(53).cos(), box_of(53, (-1, 1), (1, 1)));
    let huge = Interval::point(53, &q(1 << 50, 1)).exp();
    assert_eq!(huge.sin(), box_of(53, (-1, 1), (1, 1)));
    assert_eq!(huge.tan(), Err(Undefined::Possibly));
    let tower = huge.exp().exp();
    assert!(tower.is_positive() && !tower.is_finite());
    assert!(tower.pow(&q(-1, 1)).unwrap().is_nonnegative());
}

#[test]
fn multiples_of_a_quarter_turn_are_found() {
    for n in -9_i64..=9 {
        // From just below to just above n·π/2.
        let near = box_of(53, (n * 157_079 - 10, 100_000), (n * 157_080 + 10, 100_000));
        let one = [near.sin(), near.cos()].map(|w| (*w.lower() == -1, *w.upper() == 1));
        let expected = match n.rem_euclid(4) {
            0 => [(false, false), (false, true)],
            1 => [(false, true), (false, false)],
            2 => [(false, false), (true, false)],
            _ => [(true, false), (false, false)],
        };
        assert_eq!(one, expected, "{n}");
        assert_eq!(near.tan().is_err(), n % 2 != 0, "{n}");
    }
}

#[test]
fn unbounded_intervals() {
    let entire = Interval::entire(53);
    let zero = Interval::point(53, &q(0, 1));
    let above = zero.union(&entire.exp());
    assert_eq!(&entire * &zero, zero);
    assert_eq!(&entire - &entire, entire);
    assert_eq!(above.lower(), zero.lower());
    assert!(!above.is_finite());
    assert_eq!(entire.pow(&q(2, 1)).unwrap(), above);
    assert_eq!(above.sqrt().unwrap(), above);
    assert_eq!(entire.tanh(), box_of(53, (-1, 1), (1, 1)));
    assert_eq!(entire.abs(), above);
    let least = box_of(53, (2, 1), (3, 1)).divide(&(&above + &box_of(53, (1, 1), (1, 1))));
    assert_eq!(least.unwrap(), box_of(53, (0, 1), (3, 1)));
    assert_eq!(entire.midpoint(), 0);
}

#[test]
fn domains() {
    use Undefined::{Certainly, Possibly};
    let zero = box_of(53, (0, 1), (0, 1));
    let mixed = box_of(53, (-1, 1), (2, 1));
    let minus = box_of(53, (-2, 1), (-1, 1));
    let touching = box_of(53, (0, 1), (2, 1));
    let one = box_of(53, (1, 1), (1, 1));
    for (result, expected) in [
        (one.divide(&zero), Certainly),
        (one.divide(&mixed), Possibly),
        (one.divide(&touching), Possibly),
        (zero.pow(&q(-2, 1)), Certainly),
        (mixed.pow(&q(-2, 1)), Possibly),
        (zero.pow(&q(0, 1)), Certainly),
        (mixed.pow(&q(0, 1)), Possibly),
        (minus.ln(), Certainly),
        (zero.ln(), Certainly),
        (mixed.ln(), Possibly),
        (touching.ln(), Possibly),
        (minus.sqrt(), Certainly),
        (mixed.sqrt(), Possibly),
        (minus.pow(&q(1, 3)), Certainly),
        (mixed.pow(&q(2, 3)), Possibly),
        (zero.pow(&q(-1, 2)), Certainly),
        (touching.pow(&q(-1, 2)), Possibly),
        (touching.tan(), Possibly),
    ] {
        assert_eq!(result, Err(expected));
    }
    assert_eq!(zero.sqrt(), Ok(zero.clone()));
    assert_eq!(zero.pow(&q(5, 3)), Ok(zero));
}

#[test]
fn hulls_and_intersections() {
    let (a, b) = (box_of(53, (0, 1), (2, 1)), box_of(53, (1, 1), (3, 1)));
    assert_eq!(a.intersection(&b), Some(box_of(53, (1, 1), (2, 1))));
    assert_eq!(a.union(&b), box_of(53, (0, 1), (3, 1)));
    assert_eq!(a.intersection(&(&b + &b)), Some(box_of(53, (2, 1), (2, 1))));
    assert_eq!(a.intersection(&box_of(53, (4, 1), (5, 1))), None);
    assert_eq!(Interval::hull(53, &q(2, 1), &q(0, 1)), a);
    assert_eq!(a.midpoint(), 1);
    assert_eq!(a.width(), 2);
    assert_eq!(
        Interval::point(53, &q(1, 3)).to_string(),
        "[3.33333e-1, 3.33334e-1]"
    );
}
