//! Values of expressions and of their normal forms at a point, to compare.

use rug::float::Constant;
use rug::ops::Pow;
use rug::{Float, Rational};
use volver::inside::symbolic::{
    Arena, Atom, Coefficient, MonomialId, Polynomial, PolynomialId, Ratio,
};
use volver::symbolic::{Expr, Function, Kind};

const BITS: u32 = 400;

/// Smaller numbers may be 0 but for rounding, larger ones have lost their digits.
fn is_reliable(x: &Float) -> bool {
    x.is_finite() && x.clone().abs() < Float::i_exp(1, 60)
}

fn is_nonzero(x: &Float) -> bool {
    x.clone().abs() > Float::i_exp(1, -60)
}

fn float(q: &Rational) -> Float {
    Float::with_val(BITS, q)
}

fn pi() -> Float {
    Float::with_val(BITS, Constant::Pi)
}

/// xᵉ where it is defined.
fn power(x: &Float, e: &Rational) -> Option<Float> {
    let allowed = if e.is_integer() {
        *e >= 0 || *x != 0
    } else {
        *x > 0
    };
    allowed.then(|| match e.numer().to_i32() {
        Some(k) if e.is_integer() => x.clone().pow(k),
        _ => x.clone().pow(float(e)),
    })
}

/// The values of the symbols x and y.
pub(super) type Point = [Rational; 2];

fn symbol(name: &str, point: &Point) -> Float {
    float(if name == "x" { &point[0] } else { &point[1] })
}

/// The value of an expression, unless it is undefined or hard to tell.
pub(super) fn of_expr(expr: &Expr, point: &Point) -> Option<Float> {
    let value = match expr.kind() {
        Kind::Number(q) => float(q),
        Kind::Pi => pi(),
        Kind::Symbol(name) => symbol(name, point),
        Kind::Sum(terms) => terms.iter().try_fold(Float::new(BITS), |sum, term| {
            Some(sum + of_expr(term, point)?)
        })?,
        Kind::Product(factors) => factors
            .iter()
            .try_fold(float(&Rational::from(1)), |product, factor| {
                Some(product * of_expr(factor, point)?)
            })?,
        Kind::Power(base, e) => {
            let base = of_expr(base, point)?;
            let regular = *e > 0 && e.is_integer() || is_nonzero(&base);
            regular.then(|| power(&base, e))??
        }
        Kind::Call(function, argument) => call(*function, of_expr(argument, point)?)?,
        Kind::Min(..) | Kind::Max(..) | Kind::Piecewise(..) => return None,
    };
    is_reliable(&value).then_some(value)
}

fn call(function: Function, x: Float) -> Option<Float> {
    Some(match function {
        Function::Exp => x.exp(),
        Function::Ln if !(is_nonzero(&x) && x > 0) => return None,
        Function::Ln => x.ln(),
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan if !is_nonzero(&x.clone().cos()) => return None,
        Function::Tan => x.tan(),
        Function::Sinh => x.sinh(),
        Function::Cosh => x.cosh(),
        // Made of exponentials that cancel.
        Function::Tanh if x.clone().abs() > 32 => return None,
        Function::Tanh => x.tanh(),
        Function::Atan => x.atan(),
        Function::Erf => x.erf(),
        Function::Abs => x.abs(),
    })
}

/// A complex number.
#[derive(Clone)]
pub(super) struct Complex {
    pub(super) re: Float,
    pub(super) im: Float,
}

impl Complex {
    fn real(re: Float) -> Complex {
        let im = Float::new(BITS);
        Complex { re, im }
    }

    fn add(&self, other: &Complex) -> Complex {
        Complex {
            re: Float::with_val(BITS, &self.re + &other.re),
            im: Float::with_val(BITS, &self.im + &other.im),
        }
    }

    fn mul(&self, other: &Complex) -> Complex {
        let product = |a: &Float, b: &Float| Float::with_val(BITS, a * b);
        Complex {
            re: product(&self.re, &other.re) - product(&self.im, &other.im),
            im: product(&self.re, &other.im) + product(&self.im, &other.re),
        }
    }

    fn recip(&self) -> Complex {
        let norm = self.re.clone().square() + self.im.clone().square();
        Complex {
            re: self.re.clone() / &norm,
            im: -self.im.clone() / &norm,
        }
    }

    fn exp(&self) -> Complex {
        let radius = self.re.clone().exp();
        let (sin, cos) = self.im.clone().sin_cos(Float::new(BITS));
        Complex {
            re: cos * &radius,
            im: sin * &radius,
        }
    }
}

/// The value of a normal form; `None` where an atom has none, which must not happen where its expression
/// has one.
pub(super) fn of_polynomial(p: &Polynomial, arena: &Arena, point: &Point) -> Option<Complex> {
    p.terms()
        .iter()
        .try_fold(Complex::real(Float::new(BITS)), |sum, (monomial, c)| {
            let Coefficient { re, im } = c;
            let part = |q: &Ratio| float(&q.to_rational());
            let c = Complex {
                re: part(re),
                im: part(im),
            };
            Some(sum.add(&c.mul(&of_monomial(*monomial, arena, point)?)))
        })
}

fn of_id(id: PolynomialId, arena: &Arena, point: &Point) -> Option<Complex> {
    of_polynomial(&arena.polynomial(id), arena, point)
}

fn of_monomial(monomial: MonomialId, arena: &Arena, point: &Point) -> Option<Complex> {
    let monomial = arena.monomial(monomial);
    let mut product = of_id(monomial.exponent, arena, point)?.exp();
    for (atom, k) in &monomial.factors {
        let k = k.to_rational();
        let real = |id: PolynomialId| Some(of_id(id, arena, point)?.re);
        let base = match &*arena.atom(*atom) {
            Atom::Symbol(name) => symbol(name, point),
            Atom::Pi => pi(),
            Atom::Ln(id) => real(*id).filter(|x| *x > 0)?.ln(),
            Atom::Erf(id) => real(*id)?.erf(),
            Atom::Atan(id) => real(*id)?.atan(),
            Atom::Abs(id) => real(*id)?.abs(),
            Atom::Radical(id) => real(*id)?,
            Atom::Inverse(id) => {
                let inverse = of_id(*id, arena, point)?.recip();
                for _ in 0..k.numer().to_u32()? {
                    product = product.mul(&inverse);
                }
                continue;
            }
        };
        product = product.mul(&Complex::real(power(&base, &k)?));
    }
    Some(product)
}

/// Whether the two are the same but for rounding.
pub(super) fn agree(a: &Float, b: &Float) -> bool {
    let scale = Float::with_val(BITS, 1) + a.clone().abs();
    (a.clone() - b).abs() < scale >> 100_u32
}
