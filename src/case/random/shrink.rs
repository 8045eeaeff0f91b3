//! Simpler cases. Each step takes a part away, lowers an exponent, or puts the simplest thing in place of
//! another: no sequence of them goes on forever.

use super::{Emit, Field, Grow, RandomCase};
use rug::Rational;

pub(super) fn simpler(case: &RandomCase) -> Vec<RandomCase> {
    let mut all = Vec::new();
    let with_depth = |depth| RandomCase {
        depth,
        ..case.clone()
    };
    let with_emission = |emission| RandomCase {
        emission,
        ..case.clone()
    };
    all.extend(without_one(&case.depth).map(with_depth));
    all.extend(without_one(&case.emission).map(with_emission));
    if case.field != Field::Position {
        all.push(RandomCase {
            field: Field::Position,
            ..case.clone()
        });
    }
    if case.length != 1 {
        all.push(RandomCase {
            length: Rational::from(1),
            ..case.clone()
        });
    }
    all.extend(with_one_simpler(&case.depth, simpler_depth).map(with_depth));
    all.extend(with_one_simpler(&case.emission, simpler_emission).map(with_emission));
    all
}

/// All but one, where there are two.
fn without_one<T: Clone>(parts: &[T]) -> impl Iterator<Item = Vec<T>> + use<'_, T> {
    let places = if parts.len() > 1 { parts.len() } else { 0 };
    (0..places).map(|place| {
        let mut rest = parts.to_vec();
        rest.remove(place);
        rest
    })
}

/// All, one of them simpler.
fn with_one_simpler<T: Clone>(
    parts: &[T],
    simpler: impl Fn(&T) -> Vec<T>,
) -> impl Iterator<Item = Vec<T>> {
    parts.iter().enumerate().flat_map(move |(place, part)| {
        let replaced = |new| {
            let mut all = parts.to_vec();
            if let Some(old) = all.get_mut(place) {
                *old = new;
            }
            all
        };
        simpler(part).into_iter().map(replaced).collect::<Vec<_>>()
    })
}

fn simpler_depth(part: &Grow) -> Vec<Grow> {
    let mut all = Vec::new();
    let mut plain = part.clone();
    let factor = std::mem::replace(plain.factor_mut(), Rational::from(1));
    match part {
        Grow::Power {
            exponent: 0 | 1, ..
        } => {}
        Grow::Power { exponent, .. } => all.push(Grow::Power {
            factor: factor.clone(),
            exponent: exponent - 1,
        }),
        _ => all.push(Grow::Power {
            factor: factor.clone(),
            exponent: 1,
        }),
    }
    if factor != 1 {
        all.push(plain);
    }
    all
}

fn simpler_emission(part: &Emit) -> Vec<Emit> {
    let power = |factor: &Rational, exponent| Emit::Power {
        factor: factor.clone(),
        exponent,
    };
    let one = Rational::from(1);
    match part {
        Emit::Square { factor, .. } => vec![power(factor, 2)],
        Emit::Power { factor, exponent } => {
            let mut all = Vec::new();
            if let Some(lower) = exponent.checked_sub(1) {
                all.push(power(factor, lower));
            }
            if *factor != 1 {
                all.push(power(&one, *exponent));
            }
            all
        }
    }
}
