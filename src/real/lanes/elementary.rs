//! Exponential, sine and cosine in lanes, written once for both precisions.
//!
//! x = n ln 2 + r (Cody and Waite 1980), and eʳ − 1 by a minimax polynomial; sine and cosine likewise of r = x − n π/2.
//! Nothing branches but the reduction of sines' large arguments, which is the same for every width.

use super::constants::Constants;
use super::{LaneFloat, Lanes, circle};

/// Horner's scheme.
#[inline(always)]
fn polynomial<L: Lanes>(x: L, coefficients: &[L::Element]) -> L {
    let Some((&last, others)) = coefficients.split_last() else {
        return x.all(L::Element::ZERO);
    };
    let mut value = x.all(last);
    for &coefficient in others.iter().rev() {
        value = value * x + x.all(coefficient);
    }
    value
}

/// The integer nearest to x, which is small.
#[inline(always)]
fn nearest_integer<L: Lanes>(x: L) -> L {
    let integer = x.all(L::Element::INTEGER);
    x + integer - integer
}

/// n, r and what must be added to r to have eʳ − 1, the rounding of r with it.
#[inline(always)]
fn part<L: Lanes>(x: L) -> (L, L, L) {
    let n = nearest_integer(x * x.all(L::Element::INVERSE_LN_2));
    let high = x - n * x.all(L::Element::LN_2_HIGH);
    let low = n * x.all(L::Element::LN_2_LOW);
    let r = high - low;
    let lost = (high - r) - low;
    let square = r * r;
    let cubic = square * r * polynomial(r, L::Element::EXPONENTIAL);
    (n, r, square * x.all(L::Element::HALF) + cubic + lost)
}

/// 2ⁿ of normal numbers, 0 one below the least and infinite one above the largest.
#[inline(always)]
fn power_of_two<L: Lanes>(n: L) -> L {
    (n + n.all(L::Element::EXPONENT)).shifted(L::Element::FRACTION_BITS)
}

/// x where it is not outside these bounds, NaN too; the bound it is beyond elsewhere.
#[inline(always)]
fn clamped<L: Lanes>(x: L, low: L::Element, high: L::Element) -> L {
    let (low, high) = (x.all(low), x.all(high));
    let x = L::select(x.below(low), low, x);
    L::select(high.below(x), high, x)
}

#[inline(always)]
pub(super) fn exp<L: Lanes>(x: L) -> L {
    let x = clamped(x, L::Element::EXP_IS_ZERO, L::Element::EXP_IS_INFINITE);
    let (n, r, more) = part(x);
    // In two factors, so that results below the smallest normal number live.
    let half = nearest_integer(n * x.all(L::Element::HALF));
    let (first, second) = (power_of_two(half), power_of_two(n - half));
    (first + first * (r + more)) * second
}

#[inline(always)]
pub(super) fn exp_m1<L: Lanes>(x: L) -> L {
    let bounded = clamped(
        x,
        L::Element::EXP_M1_IS_MINUS_ONE,
        L::Element::EXP_IS_INFINITE,
    );
    let (n, r, more) = part(bounded);
    let sum = r + more;
    let lost = (r - sum) + more;
    // Half of all, whose exponent has room for the largest n.
    let half = power_of_two(n - x.all(L::Element::ONE));
    let half_unit = x.all(L::Element::HALF);
    let (whole, fraction) = (half - half_unit, half * sum);
    let total = whole + fraction;
    // What these two have rounded off; of the first where 2ⁿ is large.
    let first = (half - whole) - half_unit;
    let second = (whole - total) + fraction;
    let value = total + (first + second + half * lost);
    // Where x² is nothing beside x, whose half may have lost a bit.
    L::select(x.within(x.all(L::Element::EXP_M1_IS_X)), x, value + value)
}

/// sin and cos of r + `low` for |r| ≤ π/4.
#[inline(always)]
fn quarter<L: Lanes>(r: L, low: L) -> (L, L) {
    let z = r * r;
    let sin = r + (r * z * polynomial(z, L::Element::SINE) + low);
    let half = z * z.all(L::Element::HALF);
    let one = z.all(L::Element::ONE);
    let most = one - half;
    let lost = (one - most) - half;
    let cos = most + (lost + (z * z * polynomial(z, L::Element::COSINE) - r * low));
    (sin, cos)
}

#[inline(always)]
pub(super) fn sin_cos<L: Lanes>(x: L) -> (L, L) {
    let turns = x * x.all(L::Element::TWO_OVER_PI) + x.all(L::Element::INTEGER);
    let n = turns - x.all(L::Element::INTEGER);
    // No closure is passed a vector: what is not inlined is not done in lanes.
    let (parts, last) = (L::Element::QUARTER_TURN, L::Element::QUARTER_TURN_LAST);
    let first = x - n * x.all(parts[0]);
    let (second, third) = (n * x.all(parts[1]), n * x.all(parts[2]));
    let behind_second = first - second;
    let lost_second = (first - behind_second) - second;
    let behind_third = behind_second - third;
    let mut low = lost_second + ((behind_second - behind_third) - third);
    for &part in last {
        low = low - n * x.all(part);
    }
    let r = behind_third + low;
    let (sin, cos) = quarter(r, (behind_third - r) + low);
    let one = x.all(L::Element::ONE);
    let is_odd = one.turned(turns.bit(0)).below(x.all(L::Element::ZERO));
    let near_sin = L::select(is_odd, cos, sin).turned(turns.bit(1));
    let near_cos = L::select(is_odd, sin, cos).turned((turns + one).bit(1));
    // −0 keeps its sign.
    let near_sin = L::select(x.within(x.all(L::Element::SIN_IS_X)), x, near_sin);
    let is_near = x.within(x.all(L::Element::NEAR));
    if L::is_all(is_near) {
        return (near_sin, near_cos);
    }
    let (far_sin, far_cos) = far(x);
    (
        L::select(is_near, near_sin, far_sin),
        L::select(is_near, near_cos, far_cos),
    )
}

/// What few arguments need, one by one.
#[cold]
#[inline(never)]
fn far<L: Lanes>(x: L) -> (L, L) {
    let zero = L::Element::ZERO;
    let (mut sines, mut cosines) = ([zero; super::MOST], [zero; super::MOST]);
    x.store(&mut sines);
    for (sin, cos) in sines.iter_mut().zip(&mut cosines).take(L::WIDTH) {
        // Others were near; what is no number goes on.
        if L::Element::is_all(sin.within(L::Element::NEAR)) {
            continue;
        }
        let (quarters, high, low) = sin.angle();
        let (of_sin, of_cos) = quarter(high, low);
        (*sin, *cos) = circle::turned(quarters, of_sin, of_cos);
    }
    (x.load(&sines), x.load(&cosines))
}
