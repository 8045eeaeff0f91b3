//! `INNER/OUTER[/EXPONENTIAL]`.

use super::MethodNameError;
use super::parts::{Parts, find, names, number};
use crate::method::{Exponential, Filling, Inner, Nested, Outer, Scope};
use crate::quadrature::{MAX_GAUSS_POINTS, Rule, Sampling};

const FILLINGS: [Filling; 2] = [Filling::Parabola, Filling::Trapezoid];
const SAMPLINGS: [Sampling; 3] = [
    Sampling::Shared,
    Sampling::Independent,
    Sampling::Stratified,
];
const EXPONENTIALS: [(&str, Exponential, Scope); 8] = [
    ("exact", Exponential::Exact, Scope::Whole),
    ("exact-per-segment", Exponential::Exact, Scope::PerSegment),
    ("linear", Exponential::Linear, Scope::PerSegment),
    ("quadratic", Exponential::Quadratic, Scope::PerSegment),
    ("cubic", Exponential::Cubic, Scope::PerSegment),
    ("linear-whole", Exponential::Linear, Scope::Whole),
    ("quadratic-whole", Exponential::Quadratic, Scope::Whole),
    ("cubic-whole", Exponential::Cubic, Scope::Whole),
];

pub(super) fn name(nested: &Nested) -> String {
    let inner = match nested.inner {
        Inner::MonteCarlo { sampling, seed } => format!("{sampling}@{seed}"),
        inner => inner.to_string(),
    };
    let named = EXPONENTIALS.iter().skip(1).find(|(_, exponential, scope)| {
        (*exponential, *scope) == (nested.exponential, nested.scope)
    });
    let exponential = named.map_or(String::new(), |(name, ..)| format!("/{name}"));
    format!("{inner}/{}{exponential}", nested.outer)
}

pub(super) fn parse(inner: &str, parts: &mut Parts<'_>) -> Result<Nested, MethodNameError> {
    let inner = parse_inner(inner).ok_or_else(|| {
        let allowed = format!("{}, {}", inner_names(), super::KINDS);
        parts.unknown("inner rule or kind of method", inner, allowed)
    })?;
    let outer = parts.next("outer rule", rule_names)?;
    let outer = outer
        .parse()
        .map_err(|_| parts.unknown("outer rule", outer, rule_names()))?;
    let (exponential, scope) = match parts.option() {
        None => (Exponential::Exact, Scope::Whole),
        Some(part) => {
            let found = EXPONENTIALS.iter().find(|(name, ..)| *name == part);
            let (_, exponential, scope) = found.ok_or_else(|| {
                let all = EXPONENTIALS.map(|(name, ..)| name);
                parts.unknown("exponential", part, names(&all))
            })?;
            (*exponential, *scope)
        }
    };
    Ok(Nested {
        inner,
        outer: Outer(outer),
        exponential,
        scope,
    })
}

fn parse_inner(text: &str) -> Option<Inner> {
    if let Some((sampling, seed)) = text.split_once('@') {
        let sampling = find(&SAMPLINGS, sampling)?;
        let seed = number(seed)?;
        return Some(Inner::MonteCarlo { sampling, seed });
    }
    let filling = find(&FILLINGS, text).map(Inner::SimpsonPairs);
    let grouped = filling.or_else(|| find(&[Inner::BooleFours], text));
    grouped.or_else(|| text.parse().ok().map(Inner::PerSegment))
}

/// What may stand for a rule.
pub(super) fn rule_names() -> String {
    let plain = [
        Rule::RiemannLeft,
        Rule::RiemannRight,
        Rule::Midpoint,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::Boole,
    ];
    let gauss = [1, MAX_GAUSS_POINTS].map(Rule::GaussLegendre);
    format!("{}, {} … {}", names(&plain), gauss[0], gauss[1])
}

/// What may stand for an inner rule.
pub(super) fn inner_names() -> String {
    let random = SAMPLINGS.map(|sampling| format!("{sampling}@SEED"));
    let fours = Inner::BooleFours;
    format!(
        "{}, {}, {fours}, {}",
        rule_names(),
        names(&FILLINGS),
        names(&random)
    )
}
