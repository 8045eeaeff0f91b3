//! The statements of a case, one after the other.

use super::derive::{Derived, shortest};
use super::{Check, ManufactureError, Outcome, Statement};
use crate::case::file::Description;
use crate::symbolic::{
    Claim, Decision, Expr, Interval, ZeroTest, decide, expand, pieces, zero_test,
};
use rug::{Float, Rational};

/// All statements that apply.
pub(super) fn all(description: &Description, derived: &Derived) -> Vec<Check> {
    let length = &description.length;
    let lambda = Expr::symbol("lambda");
    let is_zero = |expr: &Expr| vanishes(expr, length);
    let mut checks = Vec::new();
    let mut add = |statement, outcome| checks.push(Check { statement, outcome });

    if let Some(inverse) = &derived.inverse {
        let back = inverse.substitute("s", &derived.field);
        add(Statement::Inverse, is_zero(&(back - lambda)));
    }
    add(Statement::FieldDefined, defined(&derived.field, length));
    if let Some(depth) = &derived.depth {
        add(Statement::DepthDefined, defined(depth, length));
        add(Statement::DepthAtZero, at_zero(depth, length));
        add(Statement::DepthContinuous, continuous(depth, length));
        let change = depth.differentiate("lambda") - derived.extinction.clone();
        add(Statement::DepthDerivative, is_zero(&change));
    }
    add(
        Statement::ExtinctionDefined,
        defined(&derived.along(&derived.extinction_of_field), length),
    );
    add(
        Statement::ExtinctionNonNegative,
        nonnegative(&derived.extinction, length),
    );
    if let (Some(radiance), Some(depth)) = (&derived.radiance, &derived.depth) {
        add(Statement::RadianceDefined, defined(radiance, length));
        add(Statement::RadianceAtZero, at_zero(radiance, length));
        add(Statement::RadianceContinuous, continuous(radiance, length));
        let change = radiance.differentiate("lambda") - derived.source(depth);
        add(Statement::RadianceDerivative, is_zero(&change));
    }
    add(
        Statement::EmissionDefined,
        emission_defined(derived, length),
    );
    add(
        Statement::EmissionNonNegative,
        emission_nonnegative(derived, length),
    );
    checks
}

/// The first statement that is refuted and that no case can do without.
pub(super) fn refuse(checks: &[Check]) -> Result<(), ManufactureError> {
    for check in checks {
        if let Outcome::Refuted { witness, value } = &check.outcome
            && !check.statement.is_optional()
        {
            return Err(ManufactureError::Refuted {
                statement: check.statement,
                witness: witness.clone(),
                value: value.clone(),
            });
        }
    }
    Ok(())
}

impl Derived {
    /// A function of s along the ray, as it is evaluated: simplified it might have a value at more places.
    fn along(&self, of_field: &Expr) -> Expr {
        of_field.substitute("s", &self.field)
    }

    /// C τ e^(−t).
    fn source(&self, depth: &Expr) -> Expr {
        Expr::product([
            self.emission.clone(),
            self.extinction.clone(),
            (-depth).exp(),
        ])
    }
}

/// Whether an expression of λ is 0 on the ray.
fn vanishes(expr: &Expr, length: &Rational) -> Outcome {
    let ranges = [("lambda".to_string(), Rational::new(), length.clone())];
    match zero_test(expr, &ranges) {
        ZeroTest::Proved => Outcome::Proved,
        ZeroTest::Refuted(witness) => Outcome::Refuted {
            witness: witness
                .at
                .into_iter()
                .next()
                .map(|(_, at)| at)
                .unwrap_or_default(),
            value: Some(witness.value),
        },
        ZeroTest::Unknown => Outcome::Undecided { near: None },
    }
}

/// Whether a constant is 0; `at` is where it is the value of something.
pub(super) fn constant_vanishes(constant: &Expr, at: &Rational) -> Outcome {
    if constant.enclose(64, &|_| None).is_err() {
        // The zero test speaks of what has a value.
        return Outcome::Undecided {
            near: Some(at.clone()),
        };
    }
    match zero_test(constant, &[]) {
        ZeroTest::Proved => Outcome::Proved,
        ZeroTest::Refuted(witness) => Outcome::Refuted {
            witness: at.clone(),
            value: Some(witness.value),
        },
        ZeroTest::Unknown => Outcome::Undecided {
            near: Some(at.clone()),
        },
    }
}

/// Whether an expression of λ is 0 at the near end.
fn at_zero(expr: &Expr, length: &Rational) -> Outcome {
    let zero = Rational::new();
    let cut = pieces(std::slice::from_ref(expr), "lambda", &zero, length);
    let Some(first) = cut.ok().and_then(|cut| cut.into_iter().next()) else {
        return Outcome::Undecided { near: Some(zero) };
    };
    let constant = Expr::sum(first.exprs).substitute("lambda", &Expr::number(0));
    if constant.enclose(64, &|_| None).is_err() {
        return Outcome::Refuted {
            witness: zero,
            value: None,
        };
    }
    constant_vanishes(&constant.simplify(), &zero)
}

/// Whether the pieces of an expression of λ meet.
fn continuous(expr: &Expr, length: &Rational) -> Outcome {
    let cut = pieces(
        std::slice::from_ref(expr),
        "lambda",
        &Rational::new(),
        length,
    );
    let Ok(cut) = cut else {
        return Outcome::Undecided { near: None };
    };
    let mut undecided = None;
    for pair in cut.windows(2) {
        let [before, after] = pair else { continue };
        let place = &after.from;
        let near = place.bracket.0.clone();
        let Some(exact) = &place.exact else {
            undecided = Some(near);
            continue;
        };
        let at = |exprs: &[Expr]| exprs.first().map(|e| e.substitute("lambda", exact));
        let (Some(left), Some(right)) = (at(&before.exprs), at(&after.exprs)) else {
            continue;
        };
        match constant_vanishes(&(left - right), &near) {
            Outcome::Proved => {}
            refuted @ Outcome::Refuted { .. } => return refuted,
            Outcome::Undecided { .. } => undecided = Some(near),
        }
    }
    match undecided {
        None => Outcome::Proved,
        near => Outcome::Undecided { near },
    }
}

/// Whether an expression of λ has a value everywhere. Only forms that have one at the same places will do.
fn defined(expr: &Expr, length: &Rational) -> Outcome {
    in_any_form([expr.clone(), expr.simplify()], length, Claim::Defined)
}

/// Whether an expression of λ is ≥ 0, in whichever of its forms that can be decided; where it has a value
/// is another statement.
fn nonnegative(expr: &Expr, length: &Rational) -> Outcome {
    let forms = [expr.clone(), shortest(expr)]
        .into_iter()
        .chain(expand(expr));
    in_any_form(forms, length, Claim::NonNegative)
}

fn in_any_form(forms: impl IntoIterator<Item = Expr>, length: &Rational, claim: Claim) -> Outcome {
    let mut near = None;
    for form in forms {
        match decide(&form, "lambda", &Rational::new(), length, claim) {
            Decision::Proved => return Outcome::Proved,
            Decision::Refuted { witness, value } => return Outcome::Refuted { witness, value },
            Decision::Undecided { near: at } => near = Some(at),
        }
    }
    Outcome::Undecided { near }
}

/// C finite. Where it is 0/0 nothing is known of it: the quotient may have a limit that no formula shows.
fn emission_defined(derived: &Derived, length: &Rational) -> Outcome {
    match defined(&derived.along(&derived.emission_of_field), length) {
        Outcome::Refuted { witness, .. } if is_zero_by_zero(derived, &witness) => {
            Outcome::Undecided {
                near: Some(witness),
            }
        }
        outcome => outcome,
    }
}

/// Whether both I′ and τ may be 0 at a place.
fn is_zero_by_zero(derived: &Derived, place: &Rational) -> bool {
    let at = |name: &str| (name == "lambda").then(|| Interval::point(128, place));
    let vanishes = |expr: &Expr| expr.enclose(128, &at).is_ok_and(|v| v.contains_zero());
    // Of a medium alone there is no quotient.
    let change = derived
        .radiance
        .as_ref()
        .map(|radiance| radiance.differentiate("lambda"));
    vanishes(&derived.extinction) && change.is_some_and(|change| vanishes(&change))
}

/// C ≥ 0, where it is a function of the depth by that function too.
fn emission_nonnegative(derived: &Derived, length: &Rational) -> Outcome {
    let outcome = match nonnegative(&derived.emission, length) {
        Outcome::Refuted {
            witness,
            value: None,
        } if is_zero_by_zero(derived, &witness) => Outcome::Undecided {
            near: Some(witness),
        },
        outcome => outcome,
    };
    if let (Outcome::Undecided { .. }, Some(emission)) = (&outcome, &derived.emission_of_depth) {
        let over = |name: &str| (name == "lambda").then(|| Interval::point(64, length));
        // The depth never falls: it is greatest at the far end.
        let greatest = derived
            .depth
            .as_ref()
            .and_then(|depth| depth.enclose(64, &over).ok());
        let greatest = greatest.and_then(|depth| Float::to_rational(depth.upper()));
        if let Some(greatest) = greatest
            && decide(
                emission,
                "t",
                &Rational::new(),
                &greatest,
                Claim::NonNegative,
            ) == Decision::Proved
        {
            return Outcome::Proved;
        }
    }
    outcome
}
