//! What proof costs: an enclosure beside the estimate, and beside nested enclosures by python-flint, where that is
//! installed (`pip install python-flint==0.9.0`). Rounds take turns, so that a busy machine slows all alike.

#![allow(clippy::expect_used)]

use std::hint::black_box;
use std::process::Command;
use std::time::Instant;
use volver::case::{Formulas, Structure, SymbolicCase};
use volver::reference::{enclosed_radiance, estimated_radiance};

const ROUNDS: usize = 15;

fn case() -> SymbolicCase {
    let text = |formula: &str| formula.parse().expect("a formula");
    let formulas = Formulas {
        field: text("lambda"),
        extinction: text("2 + sin(10*s^2)"),
        emission: text("exp(-s^2)"),
        optical_depth: None,
        radiance: None,
    };
    SymbolicCase::new("smooth", 1.into(), formulas, Structure::default()).expect("a case")
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// What python-flint takes by its own clock, where it is installed.
fn peer(digits: u32) -> Option<f64> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/reference/nested.py");
    let output = Command::new("python3")
        .args([script, &digits.to_string()])
        .output()
        .ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    text.split_whitespace().next()?.parse().ok()
}

/// The quartiles, by rank.
fn quartiles(mut times: Vec<f64>) -> [f64; 3] {
    times.sort_by(f64::total_cmp);
    [1, 2, 3].map(|quarter| times[quarter * (times.len() - 1) / 4] * 1e3)
}

fn main() {
    let case = case();
    for digits in [30_u32, 100, 300] {
        let bits = digits * 3322 / 1000 + 2;
        let mut times: [Vec<f64>; 3] = Default::default();
        for _ in 0..ROUNDS {
            times[0].push(seconds(|| {
                black_box(enclosed_radiance(&case, bits).expect("an enclosure"));
            }));
            times[1].push(seconds(|| {
                black_box(estimated_radiance(&case, bits).expect("an estimate"));
            }));
            times[2].extend(peer(digits));
        }
        println!("{digits} digits, {ROUNDS} rounds in turn: quartiles in ms");
        for (name, times) in ["enclosure", "estimate", "python-flint, nested"]
            .iter()
            .zip(times)
        {
            if times.is_empty() {
                println!("  {name:<20} not installed");
                continue;
            }
            let [low, median, high] = quartiles(times);
            println!("  {name:<20} {low:>9.2} {median:>9.2} {high:>9.2}");
        }
    }
}
