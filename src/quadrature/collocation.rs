//! Gauss–Legendre points with the integrals of what is interpolated at them.

use super::Rule;
use super::rule::RuleError;
use crate::real::Format;
use rug::{Float, Rational};
use std::any::Any;
use std::sync::{Arc, LazyLock, PoisonError, RwLock};

/// Bits beyond the format's with which the matrix is computed: its recurrence loses about log₂ of the points.
const GUARD_BITS: u32 = 64;

/// m points on [0, 1]: ∫₀¹ f ≈ ∑ wⱼ f(xⱼ), exact to degree 2m − 1, and ∫₀^{xⱼ} f ≈ ∑ₖ aⱼₖ f(xₖ), exact to
/// degree m − 1.
///
/// With ℓₖ the polynomial that is 1 at xₖ and 0 at the other points, aⱼₖ = ∫₀^{xⱼ} ℓₖ = wₖ ∑ᵢ Pᵢ(yₖ) (Pᵢ₊₁(yⱼ) −
/// Pᵢ₋₁(yⱼ))/2 with y = 2x − 1: it is the Butcher matrix of Gauss's implicit Runge–Kutta method (Hairer, Nørsett and
/// Wanner, *Solving Ordinary Differential Equations I*, II.7).
#[derive(Debug, PartialEq)]
pub struct Collocation<R> {
    /// xⱼ, increasing.
    pub nodes: Vec<R>,
    /// wⱼ.
    pub weights: Vec<R>,
    /// aⱼₖ, by j.
    pub integrals: Vec<Vec<R>>,
    /// maxⱼ ∑ₖ |aⱼₖ|: how much an error at the points can add up to in an integral; a little more than that.
    pub reach: f64,
}

/// A table in the numbers of a format.
type Kept<F> = (F, u32, Arc<Collocation<<F as Format>::Real>>);

static TABLES: LazyLock<RwLock<Vec<Box<dyn Any + Send + Sync>>>> = LazyLock::new(RwLock::default);

/// The table of `points` points in `format`; computed once.
///
/// # Errors
/// [`RuleError::Points`] outside 1…[`MAX_GAUSS_POINTS`](super::MAX_GAUSS_POINTS).
pub fn collocation<F: Format>(
    points: u32,
    format: F,
) -> Result<Arc<Collocation<F::Real>>, RuleError> {
    let kept = TABLES.read().unwrap_or_else(PoisonError::into_inner);
    let find = |kept: &Box<dyn Any + Send + Sync>| {
        let (of, count, table) = kept.downcast_ref::<Kept<F>>()?;
        (*of == format && *count == points).then(|| Arc::clone(table))
    };
    if let Some(table) = kept.iter().find_map(find) {
        return Ok(table);
    }
    drop(kept);
    // Computed outside the lock: two threads may do the same work, none waits for another's.
    let table = Arc::new(compute(points, format)?);
    let entry: Kept<F> = (format, points, Arc::clone(&table));
    let mut kept = TABLES.write().unwrap_or_else(PoisonError::into_inner);
    kept.push(Box::new(entry));
    Ok(table)
}

fn compute<F: Format>(points: u32, format: F) -> Result<Collocation<F::Real>, RuleError> {
    let rule = Rule::GaussLegendre(points).table(format.bits())?;
    let bits = format.bits().saturating_add(GUARD_BITS);
    let y = |x: &Rational| Float::with_val(bits, Rational::from(x * 2_u32) - 1);
    // Pᵢ at every point, i = 0 … m.
    let polynomials: Vec<Vec<Float>> = rule.nodes.iter().map(|x| legendre(points, &y(x))).collect();
    let count = rule.nodes.len();
    let mut reach = 0.0_f64;
    let mut integrals = Vec::with_capacity(count);
    for at in &polynomials {
        let mut row = Vec::with_capacity(count);
        let mut sum = Float::with_val(bits, 0);
        for (of_node, weight) in polynomials.iter().zip(&rule.weights) {
            // i = 0: P₁ + 1 stands for P₁ − P₋₁.
            let mut entry = Float::with_val(bits, &at[1] + 1_u32);
            for i in 1..count {
                let step = Float::with_val(bits, &at[i + 1] - &at[i - 1]);
                entry += step * &of_node[i];
            }
            entry *= weight;
            entry /= 2_u32;
            sum += Float::with_val(bits, entry.abs_ref());
            row.push(format.ratio(&entry.to_rational().unwrap_or_default()));
        }
        reach = reach.max(sum.to_f64() * (1.0 + 1e-9));
        integrals.push(row);
    }
    Ok(Collocation {
        nodes: rule.nodes.iter().map(|x| format.ratio(x)).collect(),
        weights: rule.weights.iter().map(|w| format.ratio(w)).collect(),
        integrals,
        reach,
    })
}

/// P₀(y) … Pₘ(y).
fn legendre(m: u32, y: &Float) -> Vec<Float> {
    let bits = y.prec();
    let mut values = vec![Float::with_val(bits, 1), y.clone()];
    for k in 1..m {
        let last = &values[values.len() - 1];
        let before = &values[values.len() - 2];
        let mut next = Float::with_val(bits, last * y) * (2 * k + 1);
        next -= Float::with_val(bits, before * k);
        values.push(next / (k + 1));
    }
    values
}
