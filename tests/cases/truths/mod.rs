//! Identities and cases whose truth is known by construction: nothing false is proved, nothing true refuted.

mod draw;
mod identities;
mod media;

use draw::Draw;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt;
use volver::case::Description;
use volver::case::manufacture::{ManufactureError, Outcome, Statement, manufacture};

/// Whether what is claimed holds at every point of the ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Truth {
    True,
    False,
    /// It holds wherever there is a value, which is not everywhere.
    Partial,
}

/// What the program says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Verdict {
    Proved,
    Refuted,
    Undecided,
}

/// A case file and what is true of it.
struct Claim {
    truth: Truth,
    /// The program's word on the identity alone, or on all of the case.
    of_inverse: bool,
    text: String,
}

impl Claim {
    /// A(s) = 0 on [0, D], as λ(s(λ)) = λ of the field λ.
    fn of_identity(truth: Truth, length: &str, zero: &str) -> Claim {
        Claim {
            truth,
            of_inverse: true,
            text: format!(
                "name = \"identity\"\nlength = \"{length}\"\nfield = \"lambda\"\ndepth = \"lambda\"\nemission_of_depth = \"1\"\n\
                 inverse = \"s + {zero}\"\n"
            ),
        }
    }

    fn verdict(&self) -> Verdict {
        let description = Description::read(&self.text).unwrap_or_else(|e| panic!("{e}\n{self}"));
        match manufacture(&description) {
            Err(ManufactureError::Refuted { .. }) => Verdict::Refuted,
            Err(ManufactureError::Pieces(_)) => Verdict::Undecided,
            Err(error) => panic!("{error}\n{self}"),
            Ok(made) if self.of_inverse => {
                let of_inverse = [Statement::InverseDefined, Statement::Inverse];
                let mut checks = made[0].checks.iter();
                let is_proved = checks.all(|check| {
                    !of_inverse.contains(&check.statement) || check.outcome == Outcome::Proved
                });
                if is_proved {
                    Verdict::Proved
                } else {
                    Verdict::Undecided
                }
            }
            Ok(made) if made[0].is_proved() => Verdict::Proved,
            Ok(_) => Verdict::Undecided,
        }
    }
}

impl fmt::Display for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}\n{}", self.truth, self.text)
    }
}

fn verdicts(claims: &[Claim]) -> Vec<Verdict> {
    claims.par_iter().map(Claim::verdict).collect()
}

/// How many claims of each truth came out how; fails where one is proved that is not true, or refuted
/// that is.
fn judge(claims: &[Claim], verdicts: &[Verdict]) -> BTreeMap<(Truth, Verdict), usize> {
    let mut counts = BTreeMap::new();
    let mut wrong = Vec::new();
    for (claim, verdict) in claims.iter().zip(verdicts) {
        *counts.entry((claim.truth, *verdict)).or_default() += 1;
        match (claim.truth, *verdict) {
            (Truth::True, Verdict::Refuted) | (Truth::False | Truth::Partial, Verdict::Proved) => {
                wrong.push(format!("{verdict:?}: {claim}"));
            }
            (_, Verdict::Undecided) => println!("{verdict:?}: {claim}"),
            _ => {}
        }
    }
    println!("{counts:?}");
    assert!(
        wrong.is_empty(),
        "{} wrong:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
    counts
}

/// The table beside this file: truth, D, A; a line that is undecided says so.
fn table() -> Vec<(Claim, bool)> {
    let lines = include_str!("identities.tsv").lines();
    let lines = lines.filter(|line| !line.starts_with('#'));
    let claim = |line: &str| {
        let (truth, rest) = line.split_once('\t').unwrap();
        let (length, rest) = rest.split_once('\t').unwrap();
        let (zero, open) = match rest.split_once('\t') {
            Some((zero, "undecided")) => (zero, true),
            None => (rest, false),
            Some((_, other)) => panic!("{other}"),
        };
        let truth = match truth {
            "true" => Truth::True,
            "false" => Truth::False,
            "partial" => Truth::Partial,
            other => panic!("{other}"),
        };
        (Claim::of_identity(truth, length, zero), open)
    };
    lines.map(claim).collect()
}

#[test]
fn identities_of_the_table_are_decided() {
    let (claims, open): (Vec<Claim>, Vec<bool>) = table().into_iter().unzip();
    let verdicts = verdicts(&claims);
    judge(&claims, &verdicts);
    for ((claim, verdict), open) in claims.iter().zip(verdicts).zip(open) {
        assert_eq!(verdict == Verdict::Undecided, open, "{claim}");
    }
}

fn generated(seeds: std::ops::Range<u64>) -> Vec<Claim> {
    let claim = |seed| {
        let mut draw = Draw::new(seed);
        if seed % 2 == 0 {
            identities::draw(&mut draw)
        } else {
            media::draw(&mut draw)
        }
    };
    seeds.map(claim).collect()
}

/// At least four in five of those claims are decided.
fn are_mostly_decided(counts: &BTreeMap<(Truth, Verdict), usize>, truth: Truth) -> bool {
    let of = |verdict| counts.get(&(truth, verdict)).copied().unwrap_or_default();
    let decided = of(Verdict::Proved) + of(Verdict::Refuted);
    decided >= 4 * of(Verdict::Undecided)
}

#[test]
fn nothing_false_is_proved_and_nothing_true_refuted() {
    let claims = generated(0..300);
    let counts = judge(&claims, &verdicts(&claims));
    assert!(are_mostly_decided(&counts, Truth::True), "{counts:?}");
    assert!(are_mostly_decided(&counts, Truth::False), "{counts:?}");
}

#[test]
#[ignore = "10,000 of what runs always with 300"]
fn ten_thousand_claims_are_judged_right() {
    let claims = generated(1000..11_000);
    judge(&claims, &verdicts(&claims));
}
