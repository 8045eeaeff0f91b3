//! ∫₀¹ σ(x) exp(−θ(x)) dx for polynomials σ and θ, to the format's precision.
//!
//! For linear θ′ this is the closed form with error functions (θ″ > 0) or Dawson's function (θ″ < 0).
//! Those are differences of nearly equal numbers on a short segment, so the integral is evaluated by
//! the power series of exp(−θ), which has no such cancellation and serves every degree: with
//! E = exp(−θ) = Σ hₘxᵐ, E′ = −θ′E gives (m + 1) hₘ₊₁ = −Σ gₖ hₘ₋ₖ. A thick segment is cut into pieces
//! of depth at most 1 first, where the terms fall from the start.

use super::polynomial::{evaluate, shift};
use crate::method::MethodError;
use crate::real::{Format, Real, row};

/// More pieces than this mean a segment too thick to be worth integrating.
const MAX_PIECES: f64 = 65536.0;

/// The integral; `depth` holds θ without its constant term 0 (coefficient k belongs to x^(k+1)).
///
/// # Errors
/// [`MethodError::ThickSegment`] where Σ|θₖ| exceeds 65536.
pub fn attenuated_integral<R: Real>(source: &[R], depth: &[R]) -> Result<R, MethodError> {
    let Some(first) = source.first() else {
        return Err(MethodError::NoClosedForm);
    };
    let format = first.format();
    let size: f64 = depth.iter().map(|c| c.log2_abs().exp2()).sum();
    if size.is_nan() || size > MAX_PIECES {
        return Err(MethodError::ThickSegment {
            depth: size.round().to_string(),
        });
    }
    if size <= 1.0 {
        return Ok(series(source, depth, size, format));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "1 … MAX_PIECES"
    )]
    let pieces = size.ceil() as u64;
    // Fractions, as in binary16 the number of pieces itself may be ∞.
    let scale = format.fraction(1, pieces);
    // θ with its constant term, so that it can be shifted, and scaled once already: shifted coefficients
    // of θ itself may exceed the range of a small format.
    let scaled = depth.iter().map(|c| c.clone() * &scale);
    let whole = row(std::iter::once(format.int(0)).chain(scaled));
    let mut sum = format.int(0);
    let mut transmittance = format.int(1);
    for piece in 0..pieces {
        let origin = format.fraction(piece, pieces);
        let mut inside = shift(&whole, &origin, &format.int(1)).split_off(1);
        let mut power = scale.clone();
        for coefficient in inside.iter_mut().skip(1) {
            *coefficient *= &power;
            power *= &scale;
        }
        let size = inside.iter().map(|c| c.log2_abs().exp2()).sum();
        let source = shift(source, &origin, &scale);
        let part = series(&source, &inside, size, format) * &scale;
        sum += &(part * &transmittance);
        let full = evaluate(&inside, &format.int(1));
        transmittance *= &(-full).exp();
    }
    Ok(sum)
}

/// The series itself, where `size` ≥ Σ|θₖ| is at most about 1.
fn series<R: Real>(source: &[R], depth: &[R], size: f64, format: R::Format) -> R {
    let slopes = row((1..).zip(depth).map(|(k, c)| c.clone() * &format.int(k)));
    let mut coefficients = vec![format.int(1)];
    let mut sum = format.int(0);
    for m in 0..=terms(size, depth.len(), format.bits()) {
        for (j, s) in (1..).zip(source) {
            sum += &(coefficients[m].clone() * s / &format.int(index(m) + j));
        }
        let mut next = format.int(0);
        for (slope, h) in slopes.iter().zip(coefficients.iter().rev()) {
            next -= &(slope.clone() * h);
        }
        coefficients.push(next / &format.int(index(m) + 1));
    }
    sum
}

/// How many terms it takes: what is left of exp(−θ) after m·degree terms is at most
/// Σ_{i>m} sizeⁱ/i!, here below 2^−(bits + 8).
fn terms(size: f64, degree: usize, bits: u32) -> usize {
    let mut log2_term = 0.0;
    let mut m = 0_u32;
    while log2_term > -f64::from(bits + 8) {
        m += 1;
        log2_term += (size / f64::from(m)).log2();
    }
    degree * m as usize
}

fn index(m: usize) -> i64 {
    i64::try_from(m).unwrap_or(i64::MAX)
}
