//! Radiance is linear in C and does not know units of length: bit for bit where these are powers of two.
//!
//! Media here are tame (see [`tame`]): nothing underflows in any floating-point format, so that powers of two pass
//! through every operation. Fixed point has no such powers and is left out.

use super::columns::{Columns, Medium, Sample, tame};
use super::{FORMATS, Rounding, exact, size};
use quickcheck::quickcheck;
use rug::Rational;
use volver::method::Method;
use volver::real::{Format, FormatName, WithFormat};

const METHODS: [&str; 8] = [
    "front-to-back/middle/expm1",
    "front-to-back/middle/subtraction",
    "front-to-back/middle/linear",
    "front-to-back/middle/expm1/depths/neumaier",
    "back-to-front/middle/relative",
    "tree/middle/expm1",
    "trapezoid/trapezoid",
    "trapezoid/trapezoid/linear",
];

/// The radiances of all methods, exactly.
struct Radiances<'a>(&'a Medium, Rational);

impl WithFormat for Radiances<'_> {
    type Output = Vec<Rational>;
    fn run<F: Format>(self, format: F) -> Vec<Rational> {
        let nodes = Columns::new(format, self.0, &self.1);
        let by = |name: &str| {
            let method: Method = name.parse().unwrap();
            exact(&method.radiance(&nodes, nodes.segments()).unwrap())
        };
        METHODS.iter().map(|name| by(name)).collect()
    }
}

fn floating() -> impl Iterator<Item = FormatName> {
    let all = FORMATS.iter().map(|name| name.parse().unwrap());
    all.filter(|format| !matches!(format, FormatName::Fixed(_)))
}

fn scaled(medium: &Medium, emission: &Rational, extinction: &Rational) -> Medium {
    let scale = |(c, tau): &(Rational, Rational)| {
        (
            Rational::from(c * emission),
            Rational::from(tau * extinction),
        )
    };
    medium.iter().map(scale).collect()
}

fn one() -> Rational {
    Rational::from(1)
}

fn power(exponent: i8) -> Rational {
    let size = u32::from(exponent.unsigned_abs() % 3);
    if exponent < 0 {
        one() >> size
    } else {
        one() << size
    }
}

quickcheck! {
    fn radiance_scales_with_emission_bit_for_bit(samples: Vec<Sample>, exponent: i8) -> bool {
        let medium = tame(&samples);
        let factor = power(exponent);
        medium.is_empty() || floating().all(|format| {
            let before = format.with(Radiances(&medium, one()));
            let after = format.with(Radiances(&scaled(&medium, &factor, &one()), one()));
            before.into_iter().map(|i| i * &factor).eq(after)
        })
    }

    /// C₁, C₂ and their sums are eighths, numbers of every format, so that α and T are the same three times. Each
    /// radiance is within B(N) of a composite that is linear in C.
    fn radiances_add(samples: Vec<Sample>, others: Vec<Sample>) -> bool {
        let (medium, other) = (tame(&samples), tame(&others));
        let pairs = || medium.iter().zip(&other);
        let second: Medium = pairs().map(|((_, tau), (c, _))| (c.clone(), tau.clone())).collect();
        let first: Medium = pairs().map(|(own, _)| own.clone()).collect();
        let both: Medium = pairs()
            .map(|((c, tau), (more, _))| (Rational::from(c + more), tau.clone()))
            .collect();
        first.is_empty() || floating().all(|format| {
            let [a, b, sum] = [&first, &second, &both]
                .map(|medium| format.with(Radiances(medium, one())));
            let bound = 3.0 * Rounding::of(format).bound(first.len() as u64);
            // The first three have T from opacities.
            (0..3).all(|method| size(Rational::from(&sum[method] - &a[method]) - &b[method]) <= bound)
        })
    }

    fn units_of_length_do_not_matter_bit_for_bit(samples: Vec<Sample>, exponent: i8) -> bool {
        let medium = tame(&samples);
        let factor = power(exponent);
        let thinner = scaled(&medium, &one(), &factor.clone().recip());
        medium.is_empty() || floating().all(|format| {
            let before = format.with(Radiances(&medium, one()));
            before == format.with(Radiances(&thinner, factor.clone()))
        })
    }

    /// τ/a, d a and their product are rounded once more each, so that two x differ by 6 u at most, with d = 1 by less, and
    /// two α by that and twice the 2 u of a good opacity, in all 10 u α; α by subtraction is off by 3 u twice besides,
    /// whatever its size. What α is off by moves I by no more than T times it, Σ T α ≤ 1, and both composites are within
    /// B(N) of exact ones. Twice 6 u and 10 u N leave room for the second order.
    fn units_of_length_hardly_matter(samples: Vec<Sample>, a: u8) -> bool {
        let medium = tame(&samples);
        let factor = Rational::from(3 + u32::from(a % 5));
        let thinner = scaled(&medium, &one(), &factor.clone().recip());
        medium.is_empty() || floating().all(|format| {
            let rounding = Rounding::of(format);
            let n = medium.len() as u64;
            let bound = 2.0 * rounding.bound(n) + rounding.unit * (12.0 + 10.0 * n as f64);
            let before = format.with(Radiances(&medium, one()));
            let after = format.with(Radiances(&thinner, factor.clone()));
            (0..3).all(|method| size(Rational::from(&before[method] - &after[method])) <= bound)
        })
    }
}
