//! The spectral oracle against closed forms.

#![allow(clippy::unwrap_used, clippy::panic)] // A test may stop.

use rug::Float;
use std::time::Instant;
use volver::case::manufacture::{Manufactured, manufacture};
use volver::case::{Case, Formulas, Structure, SymbolicCase, catalogue};
use volver::reference::{radiance, spectral_radiance};

fn of_catalogue() -> Vec<Manufactured> {
    let names = catalogue::names();
    names
        .flat_map(|name| manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap())
        .collect()
}

#[test]
fn probe() {
    let digits: u32 = std::env::var("DIGITS").map_or(50, |d| d.parse().unwrap());
    let bits = (f64::from(digits) * 3.33) as u32 + 1;
    let s = |t: &str| t.parse().unwrap();
    let formulas = Formulas {
        field: s("lambda"),
        extinction: s("2+sin(10*s^2)"),
        emission: s("exp(-s^2)"),
        optical_depth: None,
        radiance: None,
    };
    let goal = SymbolicCase::new("goal", 1.into(), formulas, Structure::default()).unwrap();
    for d in [50, 100, 500, 1000] {
        let start = Instant::now();
        let found = spectral_radiance(&goal, d * 333 / 100 + 1).unwrap();
        println!(
            "goal {d}: {:?} {:?} {:?}",
            start.elapsed(),
            found.digits(),
            found.work
        );
    }
    for made in of_catalogue() {
        let case = &made.case;
        let exact = radiance(case, bits + 64).unwrap();
        let start = Instant::now();
        match spectral_radiance(case, bits) {
            Ok(found) => {
                let error = Float::with_val(64, &found.value - &exact.value).abs();
                let honest = error <= found.error;
                println!(
                    "{} {}: {:?} {:?} error/est {:.2e} {:?}",
                    if honest { "ok " } else { "BAD" },
                    case.name(),
                    start.elapsed(),
                    found.digits(),
                    Float::with_val(64, &error / &found.error).to_f64(),
                    found.work
                );
            }
            Err(error) => println!("ERR {}: {:?} {error}", case.name(), start.elapsed()),
        }
    }
}
