//! The rays, and how kernels are given them.

use crate::case::{Case, Formulas, SymbolicCase};
use crate::kernel::{Subject, SubjectError};
use crate::study::stress::{Knot, Medium, Scenario, power, scenario, slab};
use crate::symbolic::{Branch, CompileError, Condition, Expr, Relation};
use rug::Rational;

/// Segments of all scenarios but those of one segment: places are numbers of few bits in every format.
const SEGMENTS: u64 = 8;
/// Optical depths, as powers of ten.
const DEPTHS: [i32; 9] = [-12, -9, -6, -4, -2, 0, 1, 2, 3];
/// C, as powers of ten, at an optical depth of 8.
const EMISSIONS: [i32; 2] = [-30, 30];
/// τ at the ends of eight segments: a medium, vacuum, a medium.
const GAP: [i32; 9] = [1, 1, 0, 0, 0, 0, 1, 1, 1];
/// As a network without a rectifier has it; τ is 0 where it changes its sign.
const NEGATIVE: [i32; 9] = [1, 1, 1, 0, -4, -4, 0, 1, 1];
/// The scenario that says whether a kernel's rule is exact in an even medium.
pub(super) const EVEN: &str = "depth/1e0";

/// All scenarios, for a kernel that takes multiples of so many segments.
pub(super) fn scenarios(multiple: u64) -> Vec<Scenario> {
    // The ends of eight segments must be ends of segments.
    let odd = multiple >> multiple.trailing_zeros().min(SEGMENTS.trailing_zeros());
    let n = odd.saturating_mul(SEGMENTS);
    let one = || Rational::from(1);
    let mut all = Vec::new();
    for exponent in DEPTHS {
        let medium = slab(one(), power(exponent), one());
        all.push(scenario("depth", format!("1e{exponent}"), medium, n));
    }
    all.push(scenario(
        "vacuum",
        "all",
        slab(one(), Rational::new(), one()),
        n,
    ));
    all.push(scenario("vacuum", "between", polyline(&GAP), n));
    all.push(scenario("fault", "negative-tau", polyline(&NEGATIVE), n));
    for exponent in EMISSIONS {
        let medium = slab(one(), Rational::from(8), power(exponent));
        all.push(scenario("emission", format!("1e{exponent}"), medium, n));
    }
    let thin = slab(one(), Rational::from((3, 8)), one());
    all.push(scenario("segments", "1", thin, multiple));
    let thick = slab(one(), power(2), one());
    all.push(scenario("segments", "1-thick", thick, multiple));
    all
}

/// τ at evenly spaced places from λ = 0 to 1, linear between them.
fn polyline(extinctions: &[i32]) -> Medium {
    let pieces = extinctions.len().saturating_sub(1).max(1) as u64;
    let knot = |(i, extinction): (u64, &i32)| Knot {
        place: Rational::from((i, pieces)),
        extinction: Rational::from(*extinction),
    };
    Medium::Polyline((0_u64..).zip(extinctions).map(knot).collect())
}

/// τ above 0 alone, as a rectifier leaves it; `None` where it is so already.
pub(super) fn rectified(medium: &Medium) -> Option<Medium> {
    let Medium::Polyline(knots) = medium else {
        return None;
    };
    let rectified: Vec<Knot> = knots
        .iter()
        .map(|knot| Knot {
            extinction: knot.extinction.clone().max(Rational::new()),
            ..knot.clone()
        })
        .collect();
    (rectified != *knots).then_some(Medium::Polyline(rectified))
}

/// The largest |τ|.
pub(super) fn largest_extinction(medium: &Medium) -> Rational {
    match medium {
        Medium::Polyline(knots) => {
            let sizes = knots.iter().map(|knot| knot.extinction.clone().abs());
            sizes.max().unwrap_or_default()
        }
        _ => last_extinction(medium),
    }
}

/// τ at the end of the ray.
pub(super) fn last_extinction(medium: &Medium) -> Rational {
    match medium {
        Medium::Slab(slab) => slab.extinction.clone(),
        Medium::Polyline(knots) => knots
            .last()
            .map(|knot| knot.extinction.clone())
            .unwrap_or_default(),
        Medium::Layers(_) | Medium::Ramp { .. } | Medium::Faulty(_) => Rational::new(),
    }
}

/// Whether the kinks of a medium are ends of n even segments.
pub(super) fn ends_at_kinks(medium: &Medium, n: u64) -> bool {
    match medium {
        Medium::Polyline(_) => n.is_multiple_of(SEGMENTS),
        _ => true,
    }
}

/// C, which is the same everywhere.
pub(super) fn emission(medium: &Medium) -> Rational {
    match medium {
        Medium::Slab(slab) => slab.emission.clone(),
        _ => Rational::from(1),
    }
}

/// No ray for a kernel.
#[derive(Debug, thiserror::Error)]
pub(super) enum NoSubject {
    #[error(transparent)]
    Formula(#[from] CompileError),
    #[error(transparent)]
    Subject(#[from] SubjectError),
}

/// The ray of a scenario; a kernel that takes a background has a black one.
pub(super) fn subject(scenario: &Scenario, background: bool) -> Result<Subject, NoSubject> {
    let medium = &scenario.medium;
    let formulas = Formulas {
        field: Expr::symbol("lambda"),
        extinction: extinction(medium),
        emission: Expr::number(emission(medium)),
        optical_depth: None,
        radiance: None,
    };
    let case = SymbolicCase::new(
        &scenario.name,
        medium.length(),
        formulas,
        medium.structure(),
    )?;
    let subject = Subject::new(&scenario.name, vec![(None, case)])?;
    Ok(if background {
        subject.before(vec![0.0])?
    } else {
        subject
    })
}

/// τ(s), s being λ.
fn extinction(medium: &Medium) -> Expr {
    let Medium::Polyline(knots) = medium else {
        return Expr::number(largest_extinction(medium));
    };
    let s = Expr::symbol("s");
    let piece = |ends: &[Knot]| {
        let [near, far] = ends else { return None };
        let rise = Rational::from(&far.extinction - &near.extinction);
        let slope = rise / Rational::from(&far.place - &near.place);
        let along = s.clone() - Expr::number(near.place.clone());
        let value = Expr::number(slope) * along + Expr::number(near.extinction.clone());
        let condition = Condition {
            left: s.clone(),
            relation: Relation::LessEqual,
            right: Expr::number(far.place.clone()),
        };
        Some(Branch { condition, value })
    };
    let pieces = knots.windows(2).filter_map(piece).collect();
    Expr::piecewise(pieces, Expr::number(last_extinction(medium)))
}
