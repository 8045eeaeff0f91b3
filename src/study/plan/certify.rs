//! How well collocation on a panel is certain to do.
//!
//! With Bₖ ≥ |f⁽ᵏ⁾| rᵏ/k! on a panel of half-width r, some polynomial of degree k − 1 is within 2^(1−k) Bₖ of f
//! (Chebyshev's nodes), for every k. Points that integrate polynomials of that degree exactly, with weights that
//! are positive and add up to 2r, err by at most twice that times 2r; likewise what is interpolated at them and
//! integrated. The derivatives of C τ e^(−t) are bounded by those of C and τ: Leibniz's rule for majorants.

use crate::symbolic::Taylor;

/// Sums of positive numbers, each rounded to nearest, are below this times what was computed.
const ROUNDED: f64 = 1.0 + 1e-12;

/// Bounds of what m points, m the order of the Taylor series, err by on a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// |Ẽ − E|.
    pub radiance: f64,
    /// |t̃ − t|.
    pub depth: f64,
}

/// The bounds of one channel. `reach` is that of the collocation.
#[must_use]
pub fn bounds(
    emission: &Taylor,
    extinction: &Taylor,
    half_width: f64,
    order: usize,
    reach: f64,
) -> Bounds {
    let width = 2.0 * half_width;
    let extinction_bounds = majorant(extinction, order);
    let source = product(&majorant(emission, order), &extinction_bounds);
    let negative = (-extinction.coefficient(0).low).max(0.0);
    let light = product(
        &source,
        &transmittance(&extinction_bounds, half_width, (negative * width).exp()),
    );
    let of_extinction = nearest_polynomial(&extinction_bounds);
    let of_light = nearest_polynomial(&light);
    // At the points the depth is off by up to this, and the light there by as much of itself.
    let inside = width * (1.0 + reach) * of_extinction;
    let brightest = light.first().copied().unwrap_or(0.0);
    let thick = width * reach * extinction_bounds.first().copied().unwrap_or(0.0);
    let trivial = times(width * brightest, 1.0 + thick.exp());
    let radiance = 2.0 * width * of_light + times(width * brightest, inside.exp_m1());
    Bounds {
        radiance: (radiance * ROUNDED).min(trivial * ROUNDED),
        depth: 2.0 * width * of_extinction * ROUNDED,
    }
}

/// |f⁽ᵏ⁾| rᵏ/k! at most.
fn majorant(series: &Taylor, order: usize) -> Vec<f64> {
    (0..=order)
        .map(|k| series.coefficient(k).magnitude())
        .collect()
}

fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    (0..a.len())
        .map(|k| {
            let terms = (0..=k).map(|j| times(a[j], b[k - j]));
            terms.sum::<f64>() * ROUNDED
        })
        .collect()
}

/// 0 and an unbounded derivative make 0.
fn times(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

/// Of e^(−t), t being measured from where it is `largest`.
fn transmittance(extinction: &[f64], half_width: f64, largest: f64) -> Vec<f64> {
    let mut series = vec![largest];
    for k in 1..extinction.len() {
        // k hₖ = ∑ j tⱼ hₖ₋ⱼ with j tⱼ = r τⱼ₋₁.
        let terms = (1..=k).map(|j| times(half_width * extinction[j - 1], series[k - j]));
        series.push(terms.sum::<f64>() / k as f64 * ROUNDED);
    }
    series
}

/// How far a polynomial is at most that the points still integrate: of the best degree below the order.
#[must_use]
pub fn nearest_polynomial(majorant: &[f64]) -> f64 {
    let mut best = f64::INFINITY;
    let mut factor = 2.0;
    for (k, bound) in majorant.iter().enumerate() {
        // Of degree −1 it is 0; of degree k − 1 it is 2^(1−k) Bₖ away.
        let away = if k == 0 { *bound } else { bound * factor };
        best = best.min(away);
        factor = if k == 0 { 1.0 } else { factor / 2.0 };
    }
    best * ROUNDED
}
