//! Random expressions, and what must hold for all of them.

use super::evaluate::{Point, agree, of_expr, of_polynomial};
use quickcheck::{Arbitrary, Gen, QuickCheck, TestResult};
use rug::Rational;
use volver::inside::symbolic::{Arena, translate};
use volver::symbolic::{Expr, Function, Kind, Reduction, reduce};

/// A small expression in x and y without branches.
#[derive(Clone, Debug)]
struct Small(Expr);

fn pick<T: Clone>(g: &mut Gen, choices: &[T]) -> T {
    g.choose(choices).cloned().unwrap()
}

fn number(g: &mut Gen) -> Expr {
    let n = pick(g, &[-3, -2, -1, 1, 2, 3, 4, 8, 12]);
    Expr::number((n, pick(g, &[1, 1, 1, 2, 3])))
}

fn expression(g: &mut Gen, depth: u32) -> Expr {
    if depth == 0 || u8::arbitrary(g) % 8 == 0 {
        return match u8::arbitrary(g) % 8 {
            0..=3 => Expr::symbol("x"),
            4..=5 => Expr::symbol("y"),
            6 => number(g),
            _ => Expr::pi() * number(g),
        };
    }
    let a = expression(g, depth - 1);
    match u8::arbitrary(g) % 10 {
        0..=1 => a + expression(g, depth - 1),
        2 => a - expression(g, depth - 1),
        3..=4 => a * expression(g, depth - 1),
        5 => a / expression(g, depth - 1),
        6 => a.pow(pick(g, &[-2, -1, 2, 3])),
        7 => a.pow(pick(g, &[(1, 2), (1, 3), (2, 3), (3, 2), (-1, 2), (-5, 3)])),
        _ => a.call(pick(g, &Function::ALL)),
    }
}

impl Arbitrary for Small {
    fn arbitrary(g: &mut Gen) -> Small {
        let depth = pick(g, &[1, 2, 3, 3]);
        Small(expression(g, depth))
    }

    fn shrink(&self) -> Box<dyn Iterator<Item = Small>> {
        let parts: Vec<Small> = self.0.parts().into_iter().cloned().map(Small).collect();
        Box::new(parts.into_iter())
    }
}

/// Must be 0, unless it is undefined or too large.
fn zero(expr: &Expr) -> TestResult {
    match reduce(expr) {
        Reduction::Zero => TestResult::passed(),
        Reduction::DivisionByZero | Reduction::TooLarge => TestResult::discard(),
        other => TestResult::error(format!("{expr}: {other:?}")),
    }
}

fn check(tests: u64) -> QuickCheck {
    QuickCheck::new().tests(tests).max_tests(10 * tests)
}

#[test]
fn products_distribute() {
    fn holds(Small(f): Small, Small(g): Small, Small(h): Small) -> TestResult {
        zero(&(&(&(&f + &g) * &h) - &(&(&f * &h) + &(&g * &h))))
    }
    check(300).quickcheck(holds as fn(_, _, _) -> _);
}

#[test]
fn quotients_are_undone() {
    fn holds(Small(f): Small, Small(g): Small, Small(h): Small) -> TestResult {
        zero(&(&(&(&(&f / &g) + &h) * &g) - &(&f + &(&h * &g))))
    }
    check(300).quickcheck(holds as fn(_, _, _) -> _);
}

#[test]
fn products_have_their_derivatives() {
    fn holds(Small(f): Small, Small(g): Small) -> TestResult {
        let whole = (&f * &g).differentiate("x");
        let parts = f.differentiate("x") * g.clone() + f * g.differentiate("x");
        zero(&(whole - parts))
    }
    check(300).quickcheck(holds as fn(_, _) -> _);
}

#[test]
fn a_perturbed_identity_is_no_identity() {
    fn holds(Small(f): Small, Small(g): Small, (n, d, j, k): (i8, u8, u8, u8)) -> TestResult {
        let power = |name, k: u8| Expr::symbol(name).pow(k % 4);
        let amount = Expr::number((i32::from(n), i32::from(d) + 1));
        let term = amount * power("x", j) * power("y", k);
        let square = (&f + &g).pow(2);
        let identity = square - (f.pow(2) + Expr::number(2) * f * g.clone() + g.pow(2));
        if n == 0 || reduce(&identity) != Reduction::Zero {
            return TestResult::discard();
        }
        TestResult::from_bool(reduce(&(identity + term)) != Reduction::Zero)
    }
    check(300).quickcheck(holds as fn(_, _, _) -> _);
}

fn point(x: i16, y: i16) -> Point {
    [(i32::from(x), 1 << 13), (i32::from(y), 1 << 13)].map(Rational::from)
}

/// Every rewriting at once: the polynomial is worth what the expression is.
#[test]
fn a_normal_form_has_the_value_of_its_expression() {
    fn holds(Small(f): Small, x: i16, y: i16) -> TestResult {
        let point = point(x, y);
        let Some(value) = of_expr(&f, &point) else {
            return TestResult::discard();
        };
        let mut arena = Arena::new().unwrap();
        let Ok(polynomial) = translate(&f, &f.nodes(), &mut arena) else {
            return TestResult::error(format!("{f} has a value but no normal form"));
        };
        let Some(same) = of_polynomial(&polynomial, &arena, &point) else {
            return TestResult::error(format!("{f} has a value, its normal form hasn't"));
        };
        TestResult::from_bool(agree(&value, &same.re) && agree(&rug::Float::new(1), &same.im))
    }
    check(3000).quickcheck(holds as fn(_, _, _) -> _);
}

/// Rewritings as one would like to have them, not all of them sound.
fn rewritten(expr: &Expr, choice: u8) -> Expr {
    let two = Expr::number(2);
    let half = Expr::number((1, 2));
    expr.rebuild(|node| match (node.kind(), choice % 8) {
        (Kind::Power(base, e), 0) => match base.kind() {
            Kind::Power(base, inner) => Some(base.pow(Rational::from(inner * e))),
            _ => None,
        },
        (Kind::Power(base, e), 1) => match base.kind() {
            Kind::Product(factors) => Some(Expr::product(factors.iter().map(|f| f.pow(e.clone())))),
            _ => None,
        },
        (Kind::Call(Function::Ln, a), 2) => match a.kind() {
            Kind::Product(factors) => Some(Expr::sum(factors.iter().map(|f| f.call(Function::Ln)))),
            Kind::Power(base, e) => Some(base.call(Function::Ln) * Expr::number(e.clone())),
            _ => None,
        },
        (Kind::Call(Function::Abs, a), 3) => Some(a.clone()),
        (Kind::Call(Function::Abs, a), 4) => Some(a.pow(2).sqrt()),
        (Kind::Call(Function::Sin, a), 5) => {
            let a = a * &half;
            Some(Expr::product([
                two.clone(),
                a.call(Function::Sin),
                a.call(Function::Cos),
            ]))
        }
        (Kind::Call(Function::Erf | Function::Atan | Function::Cos, a), 6) => match node.kind() {
            Kind::Call(function, _) => Some(-(-a).call(*function)),
            _ => None,
        },
        (Kind::Power(base, e), 7) if !e.is_integer() => {
            Some((base.call(Function::Ln) * Expr::number(e.clone())).exp())
        }
        _ => None,
    })
}

#[test]
fn what_is_judged_equal_is() {
    fn holds(Small(f): Small, choice: u8, points: Vec<(i16, i16)>) -> TestResult {
        let g = rewritten(&f, choice);
        if f == g || reduce(&(&f - &g)) != Reduction::Zero {
            return TestResult::discard();
        }
        for (x, y) in points {
            let point = point(x, y);
            if let (Some(a), Some(b)) = (of_expr(&f, &point), of_expr(&g, &point))
                && !agree(&a, &b)
            {
                return TestResult::error(format!("{f} = {g}: {a} = {b} at {x} {y}"));
            }
        }
        TestResult::passed()
    }
    QuickCheck::new()
        .tests(300)
        .max_tests(20_000)
        .quickcheck(holds as fn(_, _, _) -> _);
}
