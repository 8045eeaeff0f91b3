//! What every random case is.

use rug::Rational;
use volver::case::random::{Emit, Field, Grow, RandomCase};

#[test]
fn seeds_make_different_cases_that_can_be_read() {
    for seed in 0..300 {
        let case = RandomCase::from_seed(seed);
        assert_eq!(case, RandomCase::from_seed(seed));
        assert_ne!(case, RandomCase::from_seed(seed + 1));
        case.description().unwrap_or_else(|e| panic!("{case}: {e}"));
        let length = case.length.to_f64();
        let depth: f64 = case.depth.iter().map(|part| part.at_far_end(length)).sum();
        assert!((0.2..=6.0).contains(&depth), "{case}");
    }
}

#[test]
fn every_simpler_case_is_another_and_they_end() {
    for seed in 0..30 {
        let mut case = RandomCase::from_seed(seed);
        let mut steps = 0;
        // Every second choice: not always the quickest way down.
        while let Some(next) = case.simpler().nth(steps % 2).or(case.simpler().next()) {
            assert_ne!(next, case);
            next.description().unwrap();
            case = next;
            steps += 1;
            assert!(steps < 100, "{case}");
        }
        let simplest = RandomCase {
            length: Rational::from(1),
            field: Field::Position,
            depth: vec![Grow::Power {
                factor: Rational::from(1),
                exponent: 1,
            }],
            emission: vec![Emit::Power {
                factor: Rational::from(1),
                exponent: 0,
            }],
        };
        assert_eq!(case, simplest);
    }
}

#[test]
fn what_no_case_has_is_an_error() {
    let mut case = RandomCase::from_seed(1);
    case.length = Rational::new();
    assert!(case.description().is_err());
}
