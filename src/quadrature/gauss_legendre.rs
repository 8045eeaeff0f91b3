//! Gauss–Legendre nodes and weights of any number of points at any precision.
//!
//! Roots of the Legendre polynomial Pₘ by Newton's method from Tricomi's starting values, and
//! wₖ = 2 / ((1 − xₖ²) Pₘ′(xₖ)²), moved from [−1, 1] to [0, 1].
//!
//! Source: Davis and Rabinowitz, *Methods of Numerical Integration*, 2nd ed. (1984), sections 2.7 and 6.1.

use super::UnitRule;
use rug::{Float, Rational};
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

/// Bits beyond the asked precision: the recurrence loses about log₂ m, and the rest keeps the node
/// within 2^−(bits + 64) so that everything computed from it is as if the node were exact.
const GUARD_BITS: u32 = 96;

/// A table depends on both, so that no precision ever sees another's constants.
type Key = (u32, u32);

static TABLES: LazyLock<Mutex<HashMap<Key, Arc<UnitRule>>>> = LazyLock::new(Mutex::default);

/// The rule of `points` ≥ 1 points for a format of `bits` significant bits; computed once.
pub(super) fn table(points: u32, bits: u32) -> Arc<UnitRule> {
    let key = (points, bits);
    if let Some(table) = tables().get(&key) {
        return Arc::clone(table);
    }
    // Computed outside the lock: two threads may do the same work, none waits for another's.
    let table = Arc::new(compute(points, bits.saturating_add(GUARD_BITS)));
    Arc::clone(tables().entry(key).or_insert(table))
}

fn tables() -> std::sync::MutexGuard<'static, HashMap<Key, Arc<UnitRule>>> {
    // An entry is inserted whole or not at all, so a poisoned map is still sound.
    TABLES.lock().unwrap_or_else(PoisonError::into_inner)
}

fn compute(points: u32, precision: u32) -> UnitRule {
    let mut nodes = Vec::new();
    let mut weights = Vec::new();
    // Roots come in pairs ±x: compute x ≥ 0, in descending order, and mirror.
    for k in 1..=points.div_ceil(2) {
        let (x, derivative) = root(points, k, precision);
        let sine_squared = Float::with_val(precision, 1 - x.clone().square());
        // On [0, 1] the weight is half that on [−1, 1].
        let weight = (sine_squared * derivative.square()).recip();
        let (Some(x), Some(weight)) = (x.to_rational(), weight.to_rational()) else {
            continue;
        };
        nodes.push((Rational::from(1) - x) / 2_u32);
        weights.push(weight);
    }
    let paired = (points / 2) as usize;
    for i in (0..paired).rev() {
        nodes.push(Rational::from(1 - &nodes[i]));
        weights.push(weights[i].clone());
    }
    UnitRule { nodes, weights }
}

/// The `k`-th largest root of Pₘ and Pₘ′ there.
fn root(points: u32, k: u32, precision: u32) -> (Float, Float) {
    if 2 * k == points + 1 {
        // The middle root of an odd rule is 0 exactly; Newton would only come close.
        let zero = Float::new(precision);
        let (_, derivative) = legendre(points, &zero);
        return (zero, derivative);
    }
    let m = f64::from(points);
    let angle = std::f64::consts::PI * (f64::from(k) - 0.25) / (m + 0.5);
    let start = (1.0 - (m - 1.0) / (8.0 * m.powi(3))) * angle.cos();
    let mut x = Float::with_val(precision, start);
    // The starting value has at least 7 good bits and Newton doubles them each time.
    for _ in 0..=precision.ilog2() {
        let (value, derivative) = legendre(points, &x);
        x -= value / derivative;
    }
    let (_, derivative) = legendre(points, &x);
    (x, derivative)
}

/// Pₘ(x) and Pₘ′(x) for |x| < 1 by the three-term recurrence.
fn legendre(m: u32, x: &Float) -> (Float, Float) {
    let precision = x.prec();
    let mut previous = Float::with_val(precision, 1);
    let mut current = x.clone();
    for k in 2..=m {
        let mut next = Float::with_val(precision, &current * x) * (2 * k - 1);
        next -= previous * (k - 1);
        next /= k;
        previous = current;
        current = next;
    }
    // (1 − x²) Pₘ′ = m (Pₘ₋₁ − x Pₘ)
    let mut derivative = Float::with_val(precision, &current * x);
    derivative = (previous - derivative) * m;
    derivative /= Float::with_val(precision, 1 - x.clone().square());
    (current, derivative)
}
