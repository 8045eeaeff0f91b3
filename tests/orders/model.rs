//! The error model's predictions against what is observed: the best accuracy that a method reaches in a format,
//! and the number of segments where roundoff overtakes discretization.

mod observe;

use observe::Observed;
use rayon::prelude::*;
use std::fmt;
use volver::case::manufacture::manufacture;
use volver::case::{Shared, SymbolicCase, catalogue};
use volver::convergence::{ErrorModel, Oracle, Sample, Split, fit};
use volver::method::{Expected, Method, expected_on};
use volver::real::{Format, FormatName, WithFormat};
use volver::study::sweep::between;

/// Where the model is fitted.
const LADDER: [u64; 10] = [8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096];
/// Predictions beyond are not looked at: 2¹⁸.
const MOST_SEGMENTS: f64 = 262_144.0;

const METHODS: [&str; 6] = [
    "riemann-left/riemann-right",
    "trapezoid/trapezoid",
    "simpson/simpson",
    "gauss-3/boole",
    "front-to-back/middle/expm1",
    "front-to-back/front/subtraction/depths",
];
const FORMATS: [&str; 4] = ["bf16", "f16", "f32", "f64"];

/// One method on one case in one format.
struct Row {
    case: String,
    method: String,
    format: String,
    crossing: f64,
    best: f64,
    observed: Observed,
}

impl Row {
    /// Predicted over observed.
    fn of_best(&self) -> f64 {
        self.best / self.observed.best
    }

    fn of_crossing(&self) -> Option<f64> {
        Some(self.crossing / self.observed.crossing?)
    }

    fn is_good(&self) -> bool {
        let crossing = self.of_crossing();
        within(&[self.of_best()], 3.0) == 1 && crossing.is_none_or(|r| within(&[r], 2.0) == 1)
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:24} {:40} {:5} n* {:9.0} / {:9.0} best {:9.2e} / {:9.2e} = {:.2}",
            self.case,
            self.method,
            self.format,
            self.crossing,
            self.observed.crossing.unwrap_or(f64::NAN),
            self.best,
            self.observed.best,
            self.of_best()
        )
    }
}

struct InFormat<'a> {
    name: &'a str,
    oracle: &'a Oracle<'a, SymbolicCase>,
}

impl WithFormat for InFormat<'_> {
    type Output = Vec<Row>;

    fn run<F: Format>(self, format: F) -> Vec<Row> {
        let case = self.oracle.case();
        let nodes = Shared::new(case, format);
        let methods = self.oracle.methods();
        let mut splits: Vec<Vec<(u64, Split)>> = vec![Vec::new(); methods.len()];
        // As a study makes them.
        let mut levels = [&LADDER[..], &between(&LADDER)[..]].concat();
        levels.sort_unstable();
        for n in levels {
            let cells = self.oracle.split(&nodes, n).unwrap();
            for (splits, cell) in splits.iter_mut().zip(cells) {
                splits.extend(cell.unwrap().split().map(|split| (n, split.clone())));
            }
        }
        let rows = methods.iter().zip(splits).filter_map(|(method, splits)| {
            let model = model(case, method, &splits, format.bits());
            let crossing = model.crossing().filter(|n| *n <= MOST_SEGMENTS)?;
            let best = model.best()?;
            Some(Row {
                case: self.name.into(),
                method: method.name(),
                format: format.to_string(),
                crossing,
                best: best.log2_error.exp2(),
                observed: observe::observe(case, method, format, best.log2_n)?,
            })
        });
        rows.collect()
    }
}

fn model(case: &SymbolicCase, method: &Method, splits: &[(u64, Split)], bits: u32) -> ErrorModel {
    let expected = expected_on(method, case, &LADDER);
    let samples: Vec<Sample> = splits
        .iter()
        .filter(|(n, _)| LADDER.contains(n))
        .map(|(n, split)| Sample {
            n: Some(*n),
            step: 1.0 / *n as f64,
            error: split.discretization.clone(),
            floor: split.resolution.clone(),
        })
        .collect();
    let fitted = fit(&samples, Some(expected)).unwrap();
    let order = fitted.window.and(fitted.order).or(match expected {
        Expected::Order(p) | Expected::Blind { here: p, .. } if p > 0.0 => Some(p),
        _ => None,
    });
    let splits: Vec<(u64, &Split)> = splits.iter().map(|(n, split)| (*n, split)).collect();
    ErrorModel::new(&splits, bits, order)
}

fn rows(names: &[&str], formats: &[&str]) -> Vec<Row> {
    let cases: Vec<(String, SymbolicCase)> = names
        .iter()
        .flat_map(|name| {
            let description = catalogue::find(name).unwrap().unwrap();
            let made = manufacture(&description).unwrap();
            made.into_iter().map(|made| {
                use volver::case::Case;
                (made.case.name().to_owned(), made.case)
            })
        })
        .collect();
    let methods: Vec<Method> = METHODS.iter().map(|name| name.parse().unwrap()).collect();
    cases
        .par_iter()
        .with_max_len(1)
        .flat_map_iter(|(name, case)| {
            let oracle = Oracle::new(case, &methods);
            let in_format = |format: &&str| {
                let format: FormatName = format.parse().unwrap();
                format.with(InFormat {
                    name,
                    oracle: &oracle,
                })
            };
            let rows: Vec<Row> = formats.iter().flat_map(in_format).collect();
            // As they come: the whole catalogue takes long.
            for row in &rows {
                println!("{} {row}", if row.is_good() { "  " } else { "- " });
            }
            rows
        })
        .collect()
}

/// How many of these lie within a factor.
fn within(ratios: &[f64], factor: f64) -> usize {
    let inside = |ratio: &&f64| (1.0 / factor..=factor).contains(*ratio);
    ratios.iter().filter(inside).count()
}

fn check(rows: &[Row]) {
    let best: Vec<f64> = rows.iter().map(Row::of_best).collect();
    let crossings: Vec<f64> = rows.iter().filter_map(Row::of_crossing).collect();
    let (good, near) = (within(&best, 3.0), within(&crossings, 2.0));
    println!(
        "best accuracy within 3x: {good} of {}; n* within 2x: {near} of {}",
        best.len(),
        crossings.len()
    );
    assert!(10 * good >= 9 * best.len(), "{good} of {}", best.len());
    assert!(
        10 * near >= 9 * crossings.len(),
        "{near} of {}",
        crossings.len()
    );
}

#[test]
fn the_best_accuracy_and_its_n_are_foreseen() {
    let rows = rows(&["sine-squared", "jump-off-node"], &["f16", "tf32"]);
    assert!(rows.len() >= 15);
    check(&rows);
}

#[test]
#[ignore = "the whole catalogue, an hour"]
fn the_best_accuracy_and_its_n_are_foreseen_on_the_whole_catalogue() {
    let names: Vec<&str> = catalogue::names().collect();
    let rows = rows(&names, &FORMATS);
    assert!(rows.len() >= 600);
    check(&rows);
}
