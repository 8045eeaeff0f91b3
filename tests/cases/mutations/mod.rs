//! A thousand wrong closed forms, each one token away from a right one of the catalogue: none is proved, and
//! nearly all are refuted with a witness.
//!
//! A mutant is a claim that it is the radiance (or the depth) of the case it comes from. It is refuted where
//! at some rational λ of the ray an enclosure shows that its derivative is another, that it is not 0 at
//! λ = 0, that its pieces do not meet, or that it has no value: what has no value there is not the
//! radiance. Mutants that are the same function after all are set aside.

mod mutate;

use mutate::{Random, mutant};
use rayon::prelude::*;
use rug::Rational;
use std::collections::BTreeMap;
use volver::case::manufacture::{ManufactureError, Statement, manufacture};
use volver::case::{Description, Formulas, catalogue};
use volver::symbolic::{
    Claim, Decision, Expr, Interval, Witness, ZeroTest, decide, refute_zero, zero_test,
};

const MUTANTS: usize = 1000;
const SEED: u64 = 2013;
/// Enough to see that erf 30 is not 1.
const WITNESS_BITS: u32 = 4096;

/// A case of the catalogue, with everything claimed.
struct Original {
    /// With one channel, of all formulas.
    description: Description,
    formulas: Formulas,
    /// τ(s(λ)).
    extinction: Expr,
    /// C τ e^(−t).
    source: Expr,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Of {
    Depth,
    Radiance,
}

struct Mutant<'o> {
    original: &'o Original,
    of: Of,
    text: String,
    expr: Expr,
}

/// What became of a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Fate {
    /// The same function, proved.
    Same,
    /// Not 0 at λ = 0, or without a value there.
    RefutedAtZero,
    /// Another derivative at a witness.
    RefutedByDerivative,
    /// A jump at a witness.
    RefutedByJump,
    /// No value at a witness.
    RefutedAsUndefined,
    Undecided,
    /// The worst that can be.
    Proved,
}

fn originals() -> Vec<Original> {
    let names: Vec<&str> = catalogue::names().collect();
    let of_name = |name: &str| -> Vec<Original> {
        let description = catalogue::find(name).unwrap().unwrap();
        let made = manufacture(&description).unwrap();
        made.into_iter()
            .zip(&description.channels)
            .map(|(made, channel)| {
                let formulas = made.case.formulas().clone();
                let mut description = description.clone();
                let mut channel = channel.clone();
                channel.emission = Some(formulas.emission.clone());
                channel.radiance.clone_from(&formulas.radiance);
                channel.emission_of_depth = None;
                description.channels = vec![channel];
                description.extinction = Some(formulas.extinction.clone());
                description.inverse = None;
                let attenuation = (-formulas.optical_depth.as_ref().unwrap()).exp();
                Original {
                    source: &(&made.emission * &made.extinction) * &attenuation,
                    extinction: made.extinction,
                    description,
                    formulas,
                }
            })
            .collect()
    };
    names.par_iter().flat_map(|&name| of_name(name)).collect()
}

impl Original {
    fn formula(&self, of: Of) -> &Expr {
        match of {
            Of::Depth => self.formulas.optical_depth.as_ref().unwrap(),
            Of::Radiance => self.formulas.radiance.as_ref().unwrap(),
        }
    }
}

impl Mutant<'_> {
    fn fate(&self) -> Fate {
        let original = self.original;
        let length = &original.description.length;
        let ranges = [("lambda".to_string(), Rational::new(), length.clone())];
        let is_zero = |expr: &Expr| zero_test(expr, &ranges);
        if is_zero(&(&self.expr - original.formula(self.of))) == ZeroTest::Proved {
            return Fate::Same;
        }
        let derivative = match self.of {
            Of::Depth => &original.extinction,
            Of::Radiance => &original.source,
        };
        let change = &self.expr.differentiate("lambda") - derivative;
        if let ZeroTest::Refuted(witness) = is_zero(&change) {
            self.confirm(&change, &witness);
            return Fate::RefutedByDerivative;
        }
        self.claimed()
    }

    /// Looks again at a witness, at more bits than it was found with.
    fn confirm(&self, change: &Expr, witness: &Witness) {
        // A constant has no symbol to be anywhere.
        let nowhere = (String::new(), Rational::new());
        let (_, place) = witness.at.first().unwrap_or(&nowhere);
        let length = &self.original.description.length;
        assert!(*place >= 0 && place <= length, "{}", self.text);
        let value = change
            .enclose(WITNESS_BITS, &|_| {
                Some(Interval::point(WITNESS_BITS, place))
            })
            .unwrap();
        assert!(!value.contains_zero(), "{} at {place}", self.text);
    }

    /// What the program itself says of a case with the mutant for its formula.
    fn claimed(&self) -> Fate {
        let mut description = self.original.description.clone();
        match self.of {
            Of::Depth => description.depth = Some(self.expr.clone()),
            Of::Radiance => description.channels[0].radiance = Some(self.expr.clone()),
        }
        match manufacture(&description) {
            Ok(made) if made[0].is_proved() => return Fate::Proved,
            Err(ManufactureError::Refuted { statement, .. }) => match statement {
                Statement::DepthAtZero | Statement::RadianceAtZero => return Fate::RefutedAtZero,
                Statement::DepthContinuous | Statement::RadianceContinuous => {
                    return Fate::RefutedByJump;
                }
                _ => return Fate::RefutedByDerivative,
            },
            _ => {}
        }
        let length = &description.length;
        let defined = decide(
            &self.expr,
            "lambda",
            &Rational::new(),
            length,
            Claim::Defined,
        );
        match defined {
            Decision::Refuted { .. } => Fate::RefutedAsUndefined,
            _ => Fate::Undecided,
        }
    }

    fn describe(&self) -> String {
        let name = &self.original.description.name;
        let original = self.original.formula(self.of);
        format!("{name}, {:?}\n  {original}\n  {}", self.of, self.text)
    }
}

/// Each of a formula drawn at random.
fn mutants(originals: &[Original]) -> Vec<Mutant<'_>> {
    let mut random = Random::new(SEED);
    let mut all = Vec::new();
    while all.len() < MUTANTS {
        let original = random.of(originals);
        let of = random.of(&[Of::Depth, Of::Radiance]);
        let formula = original.formula(*of);
        if let Some((text, expr)) = mutant(&formula.to_string(), &mut random) {
            all.push(Mutant {
                original,
                of: *of,
                text,
                expr,
            });
        }
    }
    all
}

#[test]
fn no_mutant_is_proved_and_nearly_all_are_refuted() {
    let originals = originals();
    let mutants = mutants(&originals);
    let fates: Vec<Fate> = mutants.par_iter().map(Mutant::fate).collect();
    let mut counts: BTreeMap<Fate, usize> = BTreeMap::new();
    for (mutant, fate) in mutants.iter().zip(&fates) {
        *counts.entry(*fate).or_default() += 1;
        if matches!(fate, Fate::Undecided | Fate::Proved) {
            println!("{fate:?}: {}", mutant.describe());
        }
    }
    println!("{MUTANTS} mutants: {counts:?}");
    let count = |fate| counts.get(&fate).copied().unwrap_or_default();
    assert_eq!(count(Fate::Proved), 0);
    let different = MUTANTS - count(Fate::Same);
    assert!(
        different * 10 >= MUTANTS * 9,
        "too many are the same: {counts:?}"
    );
    assert!(count(Fate::Undecided) * 100 <= different, "{counts:?}");
}

/// What is true has no witness against it.
#[test]
fn originals_are_not_refuted() {
    for original in &originals() {
        let length = &original.description.length;
        let ranges = [("lambda".to_string(), Rational::new(), length.clone())];
        for (of, derivative) in [
            (Of::Depth, &original.extinction),
            (Of::Radiance, &original.source),
        ] {
            let change = &original.formula(of).differentiate("lambda") - derivative;
            let name = &original.description.name;
            assert_eq!(refute_zero(&change, &ranges), None, "{name}, {of:?}");
        }
    }
}

/// The constant that a derivative does not see is seen at λ = 0.
#[test]
fn added_constants_are_refuted_at_zero() {
    for original in &originals() {
        for of in [Of::Depth, Of::Radiance] {
            let expr = original.formula(of) + &Expr::number((1, 100_000));
            let text = expr.to_string();
            let mutant = Mutant {
                original,
                of,
                text,
                expr,
            };
            assert_eq!(mutant.fate(), Fate::RefutedAtZero, "{}", mutant.describe());
        }
    }
}
