//! The trapezoid rule in the trapezoid rule with linear exponentials, which is + − × alone: replayed in rationals.
//!
//! With C, τ ≤ 1 and d ≤ 1, N segments: q = (τ/2 + τ'/2) d has two roundings and 3 η, so that T (1 − q), with two more, is off
//! by 4 u + 5 η a segment more than before; a term W C τ T by T's error, 3 u and 3 η; a sum of at most N + 1 terms ≤ 1 rounds
//! off (N + 1)² u, and d multiplies it with a rounding of its own, and another of the product. To first order,
//!
//! ```text
//! |ΔI| ≤ d (N + 1)((4 u + 5 η) N + 3 u + 3 η + (N + 1) u) + 2 u d (N + 1) + (N + 2) η
//! ```
//!
//! (η (N + 1) is what d itself is off by in fixed point), and a tenth more stands for all orders where that is below 1/10.

use super::columns::{Columns, Medium, Sample, extreme};
use super::{FORMATS, Rounding, exact, size};
use quickcheck::quickcheck;
use rug::Rational;
use volver::method::Method;
use volver::real::{Format, FormatName, WithFormat};

const METHOD: &str = "trapezoid/trapezoid/linear";

struct Off<'a>(&'a Medium, &'a Rational);

impl WithFormat for Off<'_> {
    type Output = f64;
    fn run<F: Format>(self, format: F) -> f64 {
        let Off(medium, step) = self;
        let nodes = Columns::new(format, medium, step);
        let method: Method = METHOD.parse().unwrap();
        let found = method.radiance(&nodes, nodes.segments()).unwrap();
        size(exact(&found) - replay(format, medium, step))
    }
}

fn replay<F: Format>(format: F, medium: &Medium, step: &Rational) -> Rational {
    let round = |q: &Rational| exact(&format.ratio(q));
    let values: Vec<(Rational, Rational)> = medium
        .iter()
        .chain(medium.last())
        .map(|(c, tau)| (round(c), round(tau)))
        .collect();
    let last = values.len() - 1;
    let mut transmittance = Rational::from(1);
    let mut sum = Rational::new();
    for (j, (emission, extinction)) in values.iter().enumerate() {
        if j > 0 {
            let both = Rational::from(extinction + &values[j - 1].1);
            transmittance *= 1 - both / 2 * step;
        }
        let weight = Rational::from((1, if j == 0 || j == last { 2 } else { 1 }));
        sum += weight * emission * extinction * &transmittance;
    }
    sum * step
}

fn bound(rounding: Rounding, n: f64, step: f64) -> f64 {
    let Rounding {
        unit: u,
        quantum: eta,
    } = rounding;
    let term = (4.0 * u + 5.0 * eta) * n + 3.0 * u + 3.0 * eta + (n + 1.0) * u;
    step * (n + 1.0) * term + 2.0 * u * step * (n + 1.0) + (n + 2.0) * eta
}

quickcheck! {
    fn a_nested_rule_is_within_its_bound(samples: Vec<Sample>, divisor: u8) -> bool {
        let medium = extreme(&samples);
        if medium.is_empty() {
            return true;
        }
        let step = Rational::from((1, 1 + u32::from(divisor) % 64));
        FORMATS.iter().all(|name| {
            let format: FormatName = name.parse().unwrap();
            let rounding = Rounding::of(format);
            let bound = bound(rounding, medium.len() as f64, step.to_f64());
            // Beyond first order nothing is claimed.
            if rounding.unit.max(rounding.quantum) * 10.0 * (medium.len() as f64 + 2.0) > 1.0 {
                return true;
            }
            let off = format.with(Off(&medium, &step));
            let kept = off <= 1.1 * bound;
            if !kept {
                eprintln!("{name}: {off:e} off, more than {bound:e}");
            }
            kept
        })
    }
}
