//! The statements of a case, one after the other.

use super::derive::{Derived, shortest};
use super::{Check, ManufactureError, Outcome, Statement};
use crate::case::file::Description;
use crate::symbolic::{
    Claim, ConstantTest, Decision, Expr, Interval, Joint, Place, ZeroTest, decide, expand, joints,
    zero_test, zero_test_inside,
};
use rug::{Float, Rational};

/// All statements that apply.
pub(super) fn all(description: &Description, derived: &Derived) -> Vec<Check> {
    let length = &description.length;
    let lambda = Expr::symbol("lambda");
    let mut checks = Vec::new();
    let mut add = |statement, outcome| checks.push(Check { statement, outcome });

    if let Some(inverse) = &derived.inverse {
        let back = inverse.substitute("s", &derived.field);
        let has_value = defined(&back, length);
        add(Statement::InverseDefined, has_value.clone());
        add(
            Statement::Inverse,
            inverts(&(back - lambda), has_value, length),
        );
    }
    add(Statement::FieldDefined, defined(&derived.field, length));
    if let Some(depth) = &derived.depth {
        add(Statement::DepthDefined, defined(depth, length));
        add(Statement::DepthAtZero, at_zero(depth));
        add(Statement::DepthContinuous, continuous(depth, length));
        let slope = derivative(depth, &derived.extinction, length);
        add(Statement::DepthDerivative, slope);
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
        add(Statement::RadianceAtZero, at_zero(radiance));
        add(Statement::RadianceContinuous, continuous(radiance, length));
        let slope = derivative(radiance, &derived.source(depth), length);
        add(Statement::RadianceDerivative, slope);
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

/// λ as the range that expressions are tested on.
fn ray(length: &Rational) -> [(String, Rational, Rational); 1] {
    [("lambda".to_string(), Rational::new(), length.clone())]
}

fn outcome(test: ZeroTest) -> Outcome {
    match test {
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

/// Whether λ(s(λ)) − λ is 0 at every point of the ray: where it has no value it is not.
fn inverts(difference: &Expr, has_value: Outcome, length: &Rational) -> Outcome {
    match (outcome(zero_test(difference, &ray(length))), has_value) {
        (Outcome::Proved, has_value) => has_value,
        (outcome, _) => outcome,
    }
}

/// Whether a constant is 0; `at` is where it is the value of something.
pub(super) fn constant_vanishes(constant: &Expr, at: &Rational) -> Outcome {
    Outcome::of_zero(ConstantTest::of(constant), at)
}

/// Whether an expression of λ is 0 at the near end.
fn at_zero(expr: &Expr) -> Outcome {
    let zero = Rational::new();
    match Place::rational(zero.clone()).value(expr, "lambda") {
        ConstantTest::NotDefined => Outcome::Refuted {
            witness: zero,
            value: None,
        },
        value => Outcome::of_zero(value, &zero),
    }
}

/// The first outcome that refutes, else the last that does not prove.
fn worst(outcomes: impl IntoIterator<Item = Outcome>) -> Outcome {
    let mut worst = Outcome::Proved;
    for outcome in outcomes {
        match outcome {
            Outcome::Proved => {}
            Outcome::Refuted { .. } => return outcome,
            Outcome::Undecided { .. } => worst = outcome,
        }
    }
    worst
}

/// Whether an expression of λ is at both ends, and where its pieces meet, what it is beside.
fn continuous(expr: &Expr, length: &Rational) -> Outcome {
    let Ok(joints) = joints(expr, "lambda", &Rational::new(), length) else {
        return Outcome::Undecided { near: None };
    };
    worst(joints.iter().flat_map(|joint| {
        let sides: Vec<&Expr> = joint.sides().collect();
        sides.into_iter().map(|side| match &joint.at {
            Some(at) => vanishes_at(joint, side, at),
            None => undecided_at(joint),
        })
    }))
}

/// Whether two functions are the same at the end of a piece.
fn vanishes_at(joint: &Joint, a: &Expr, b: &Expr) -> Outcome {
    Outcome::of_zero(joint.difference(a, b, "lambda"), &joint.place.bracket.0)
}

fn undecided_at(joint: &Joint) -> Outcome {
    Outcome::Undecided {
        near: Some(joint.place.bracket.0.clone()),
    }
}

/// Whether the derivative of an expression of λ is `slope`: on its pieces, and at their ends where it has a
/// derivative, which is what `slope` comes to from either side.
fn derivative(expr: &Expr, slope: &Expr, length: &Rational) -> Outcome {
    let difference = expr.differentiate("lambda") - slope.clone();
    let inside = outcome(zero_test_inside(&difference, &ray(length)));
    if inside != Outcome::Proved {
        return inside;
    }
    match joints(slope, "lambda", &Rational::new(), length) {
        Ok(joints) => worst(joints.iter().map(is_derivative_at)),
        Err(_) => Outcome::Undecided { near: None },
    }
}

fn is_derivative_at(joint: &Joint) -> Outcome {
    let Some(at) = &joint.at else {
        return undecided_at(joint);
    };
    if joint.sides().any(|side| side == at) {
        return Outcome::Proved;
    }
    if let (Some(before), Some(after)) = (&joint.before, &joint.after) {
        match vanishes_at(joint, before, after) {
            Outcome::Proved => {}
            // A kink has no derivative.
            Outcome::Refuted { .. } => return Outcome::Proved,
            undecided @ Outcome::Undecided { .. } => return undecided,
        }
    }
    worst(joint.sides().map(|side| vanishes_at(joint, side, at)))
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
        Outcome::Refuted { witness, .. }
            if is_zero_by_zero(derived, &witness) || is_beside_a_pole(derived, &witness) =>
        {
            Outcome::Undecided {
                near: Some(witness),
            }
        }
        outcome => outcome,
    }
}

/// Whether a derived C has a value at a place, which then is beside an irrational one where it has none:
/// nothing tells whether it is 0/0 there.
fn is_beside_a_pole(derived: &Derived, place: &Rational) -> bool {
    let at = |name: &str| (name == "lambda").then(|| Interval::point(128, place));
    let emission = derived.along(&derived.emission_of_field);
    derived.radiance.is_some() && emission.enclose(128, &at).is_ok()
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
