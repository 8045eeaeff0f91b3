//! Bounds of a medium on a Bernstein ellipse around a panel, which bound what its Chebyshev series leave out.
//!
//! A function with |f| ≤ M on the ellipse with foci ±1 and half-axes of sum ρ is off by at most 4M ρ^(−n)/(ρ − 1)
//! from the polynomial that has its values at cos(πk/n). Source: Trefethen, *Approximation Theory and Approximation
//! Practice* (2013), theorem 8.2.

use super::number::Number;
use super::rectangle::Rectangle;
use super::run::{Branches, constants};
use super::stretch::Stretch;
use super::substitution::plain;
use crate::symbolic::{Interval, Program};
use rug::Float;
use rug::float::Round;

/// Bits that bounds are computed in, beyond those that tell the panel's places apart.
const BITS: u32 = 64;
/// Rectangles that cover the upper half of an ellipse.
const STRIPS: u32 = 8;

/// What is at most on an ellipse.
#[derive(Clone, Debug)]
pub(super) struct Bound {
    /// ρ.
    pub(super) rho: f64,
    /// The greatest |τ|.
    pub(super) extinction: Float,
    /// The greatest |C τ e^(−t)|, t from the left end of the panel on.
    pub(super) light: Float,
}

/// A program, its constants enclosed for bounds.
pub(super) struct Bounds<'p> {
    program: &'p Program,
    constants: Vec<Rectangle>,
    bits: u32,
}

impl<'p> Bounds<'p> {
    /// For panels as short as 2^(−bits + 64) of where they are.
    pub(super) fn new(program: &'p Program, bits: u32) -> Self {
        Bounds {
            program,
            constants: constants(program, bits),
            bits,
        }
    }

    /// Bits that are enough to tell the places of a panel apart.
    pub(super) fn bits_for(panel: &Stretch) -> u32 {
        let exponent = |x: &Float| x.get_exp().unwrap_or(i32::MIN / 4);
        let (from, to) = (&panel.from, &panel.to);
        let width = exponent(&Float::with_val(32, to - from));
        let farthest = exponent(from).max(exponent(to));
        let apart = farthest.saturating_sub(width).max(0).unsigned_abs();
        // Near the end that is substituted λ changes as the power of u.
        let power = panel.substitution.as_ref().map_or(0, |s| s.power);
        let apart = apart.saturating_add(power.saturating_mul(farthest.min(0).unsigned_abs()));
        BITS.saturating_add(apart)
    }

    /// The bounds on the ellipse of ρ, `None` where the medium may not be analytic within.
    pub(super) fn on(&self, panel: &Stretch, rho: f64, branches: &Branches) -> Option<Bound> {
        let bits = self.bits;
        let number = |x: f64| Interval::exactly(&Float::with_val(bits, x));
        let (from, to) = (Interval::exactly(&panel.from), Interval::exactly(&panel.to));
        let half = number(0.5);
        let middle = &(&from + &to).to_bits(bits) * &half;
        let reach = &(&to - &from).to_bits(bits) * &half;
        let left = from.to_bits(bits);
        let rho_exact = number(rho);
        let inverse = number(1.0).over(&rho_exact)?;
        let wide = &(&rho_exact + &inverse) * &half;
        let high = &(&rho_exact - &inverse) * &half;
        let place = |part: &Interval| &middle + &(&(&wide * part) * &reach);

        let mut extinction = Float::new(bits);
        // −log of the transmittance from the left end of the ellipse to a strip, at least; and to the panel, at most.
        let mut depth = number(0.0);
        let mut before = number(0.0);
        let mut strips = Vec::new();
        let strip_count = f64::from(STRIPS);
        for strip in 0..STRIPS {
            // Parts of −1 … 1 with few bits are exact.
            let part = |k: u32| number(2.0 * f64::from(k) / strip_count - 1.0);
            let (near, far) = (part(strip), part(strip + 1));
            let nearest = if strip < STRIPS / 2 { &far } else { &near };
            let height = (&number(1.0) - &nearest.squared()).sqrt().ok()?;
            let height = &(&high * &height) * &reach;
            let (from, to) = (place(&near), place(&far));
            let box_of = Rectangle {
                re: from.union(&to),
                im: number(0.0).union(&height),
            };
            let (program, constants) = (self.program, &self.constants);
            let values = match &panel.substitution {
                Some(substitution) => substitution.values(program, constants, branches, &box_of),
                None => plain(program, constants, branches, &box_of),
            };
            let values = values?;
            let tau = values.extinction;
            let magnitude = tau.magnitude();
            if magnitude > extinction {
                extinction.clone_from(&magnitude);
            }
            let width = (&to - &from).abs();
            // Upwards from the real line.
            let rise = tau.im.max(&number(0.0));
            let up = &height * &rise;
            let along = &width * &tau.re.min(&number(0.0));
            let least = &(&depth + &along) - &up;
            strips.push((least, values.source.magnitude()));
            depth = &depth + &(&width * &tau.re);
            if from.lower() < left.upper() {
                let beyond = (&left.min(&to) - &from).max(&number(0.0));
                before = &before + &(&beyond * &tau.re);
            }
        }
        let mut light = Float::new(bits);
        for (least, source) in strips {
            let transmittance = (&before - &least).exp();
            let product = Float::with_val_round(bits, source * transmittance.upper(), Round::Up).0;
            if product.is_nan() {
                return None;
            }
            if product > light {
                light = product;
            }
        }
        let is_bound = extinction.is_finite() && light.is_finite();
        is_bound.then_some(Bound {
            rho,
            extinction,
            light,
        })
    }
}
