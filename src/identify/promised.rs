//! The rule that a kernel is to compute: the one that it declares, else that of the same places without faults.

use super::deviation::{Deviation, right_of};
use super::rule::{Lattice, Law, Place, Rule, Scheme, Stop, Wall};
use super::stated::stated;
use super::{Identification, part};
use crate::kernel::{Declaration, Sampling};

/// Thresholds are told to this part of them.
const SAME: f64 = 1e-6;
/// And places to this part of a segment.
const SAME_PLACE: f64 = 1e-9;

/// What a kernel is to compute: the declared method, else the rule of the same places without faults, at the declared
/// places and but for what else it declares; where neither a rule is named nor a method declared, one sample a segment in
/// the place that was found, or in each of the three.
pub(super) fn promised(found: &Identification, declaration: &Declaration) -> Vec<Rule> {
    let declared = declaration.method.as_ref().and_then(stated);
    if let Some(rule) = found.named() {
        let right = match declared {
            Some(declared) => at_place_of(declared, found, rule),
            None => sampled_as_declared(right_of(rule), found, declaration),
        };
        return vec![but_for(right, rule, declaration)];
    }
    let wall = declaration.far_wall.then_some(Wall::Opaque);
    if let Some(declared) = declared {
        return vec![Rule { wall, ..declared }];
    }
    let places = match found.parts.place {
        Some(place) => vec![place],
        None => vec![Place::Front, Place::Middle, Place::Back],
    };
    let rules = places.into_iter().map(|place| Rule {
        scheme: Scheme::Sample {
            place,
            law: Law::default(),
        },
        wall,
        ..Rule::default()
    });
    rules.collect()
}

/// Where the samples of a kernel lie that does not look at the ends and middles of segments.
fn lattice(found: &Identification, rule: &Rule) -> Option<Lattice> {
    found.optics.map(|optics| optics.lattice).or(rule.lattice)
}

/// A declared rule as it is written where samples lie on a lattice: as if in the middle.
fn at_place_of(declared: Rule, found: &Identification, rule: &Rule) -> Rule {
    match (&declared.scheme, &rule.scheme) {
        (Scheme::Sample { law, .. }, Scheme::Sample { place, .. })
            if lattice(found, rule).is_some() =>
        {
            let scheme = Scheme::Sample {
                place: *place,
                law: law.clone(),
            };
            Rule { scheme, ..declared }
        }
        _ => declared,
    }
}

/// The same rule at the end or in the middle that is declared, where it takes one sample a segment there.
fn sampled_as_declared(right: Rule, found: &Identification, declaration: &Declaration) -> Rule {
    let place = match declaration.sampling {
        Some(Sampling::Front) => Place::Front,
        Some(Sampling::Middle) => Place::Middle,
        Some(Sampling::Back) => Place::Back,
        Some(Sampling::Ends | Sampling::Jittered) | None => return right,
    };
    match &right.scheme {
        Scheme::Sample { law, .. } if lattice(found, &right).is_none() => Rule {
            scheme: Scheme::Sample {
                place,
                law: law.clone(),
            },
            ..right
        },
        _ => right,
    }
}

/// Samples elsewhere than declared, where two rules do not show it: on a lattice, or at both ends.
pub(super) fn misplaced(
    found: &Identification,
    rule: &Rule,
    declaration: &Declaration,
) -> Option<Deviation> {
    let claimed = declaration.claimed_sampling()?;
    let wanted = match claimed {
        Sampling::Front => 0.0,
        Sampling::Middle => 0.5,
        Sampling::Back => 1.0,
        Sampling::Ends => {
            let Scheme::Sample { place, .. } = &rule.scheme else {
                return None;
            };
            return Some(deviation(part::of_place(*place).into(), claimed));
        }
        Sampling::Jittered => return None,
    };
    let lattice = lattice(found, rule)?;
    let (Lattice::Steps { place, .. } | Lattice::Even { place, .. }) = lattice;
    ((place - wanted).abs() > SAME_PLACE).then(|| deviation(lattice.to_string(), claimed))
}

fn deviation(does: String, claimed: Sampling) -> Deviation {
    Deviation {
        name: part::Part::Place.name(),
        value: None,
        bracket: None,
        does,
        instead_of: Some(format!("the sampling that is declared: {claimed}")),
    }
}

/// What is declared is no deviation.
fn but_for(right: Rule, rule: &Rule, declaration: &Declaration) -> Rule {
    let mut right = right;
    if declaration.far_wall && rule.wall.is_some() {
        right.wall = rule.wall;
    }
    if let (Some(declared), Some(own)) = (declaration.quantum, rule.output.quantum)
        && (declared - own).abs() <= 1e-9 * declared
    {
        right.output.quantum = Some(own);
    }
    // A threshold that was bisected is the declared one, but for its last digits.
    if let (Some(declared), Some(own)) = (right.stop, rule.stop)
        && declared.by == own.by
        && (declared.under - own.under).abs() <= SAME * declared.under
    {
        right.stop = Some(Stop {
            under: own.under,
            ..declared
        });
    }
    right
}
