//! Expressions without symbols: whether they are 0, and their signs.

mod algebraic;
mod combination;
mod rewrite;

pub(super) use rewrite::without_inverse_angles;

use super::choice::{Which, resolve};
use super::normal_form::{Reduction, reduce};
use super::{EncloseError, Expr, Interval};
use std::cmp::Ordering;

/// The precisions at which a constant is looked at before it is asked whether it is 0.
const BITS: [u32; 5] = [64, 128, 256, 1024, 4096];
/// How deep the sums of logarithms and angles may stand within one another.
const DEPTH: u32 = 3;

/// What is known of a constant.
#[derive(Clone, Debug, PartialEq)]
pub enum ConstantTest {
    /// It is 0.
    Zero,
    /// It is in the interval, which does not contain 0.
    Nonzero(Interval),
    /// It has no value.
    NotDefined,
    /// None of these is known.
    Unknown,
}

impl ConstantTest {
    /// Decides an expression without symbols.
    ///
    /// That it is 0 is proved by its normal form, by the distance that algebraic numbers keep from 0, or
    /// by the product that a sum of logarithms or of angles stands for.
    #[must_use]
    pub fn of(expr: &Expr) -> ConstantTest {
        let Some(expr) = resolve(expr, Which::All, &sign) else {
            return ConstantTest::Unknown;
        };
        let expr = expr.simplify();
        let mut has_value = false;
        for bits in BITS {
            match expr.enclose(bits, &|_| None) {
                Ok(value) if value.is_zero() => return ConstantTest::Zero,
                Ok(value) if !value.contains_zero() => return ConstantTest::Nonzero(value),
                Ok(_) => has_value = true,
                Err(EncloseError::NotDefined { certain: true, .. }) => {
                    return ConstantTest::NotDefined;
                }
                Err(EncloseError::NotDefined { certain: false, .. }) => {}
                Err(EncloseError::UnknownSymbol { .. }) => return ConstantTest::Unknown,
            }
        }
        if has_value && is_zero(&expr, DEPTH) {
            ConstantTest::Zero
        } else {
            ConstantTest::Unknown
        }
    }
}

/// The sign of an expression without symbols.
pub(super) fn sign(expr: &Expr) -> Option<Ordering> {
    match ConstantTest::of(expr) {
        ConstantTest::Zero => Some(Ordering::Equal),
        ConstantTest::Nonzero(value) if value.is_positive() => Some(Ordering::Greater),
        ConstantTest::Nonzero(_) => Some(Ordering::Less),
        ConstantTest::NotDefined | ConstantTest::Unknown => None,
    }
}

/// Whether a constant that has a value and no branches is certainly 0.
fn is_zero(expr: &Expr, depth: u32) -> bool {
    let by_normal_form = |expr: &Expr| reduce(expr) == Reduction::Zero;
    if by_normal_form(expr) || algebraic::is_zero(expr) {
        return true;
    }
    let rewritten = without_inverse_angles(expr);
    (rewritten != *expr && (by_normal_form(&rewritten) || algebraic::is_zero(&rewritten)))
        || depth > 0 && combination::is_zero(expr, &|part| is_zero(part, depth - 1))
}
