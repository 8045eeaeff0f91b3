//! `proofs/README.md` says every theorem in words, and what the code names exists.

use crate::proofs;
use std::collections::BTreeSet;
use std::fs;
use volver::method::Theorem;

/// "Theorem NAME" and "Corollary NAME" of a file, behind the modules that they stand in.
fn stated(text: &str) -> Vec<String> {
    let mut modules: Vec<&str> = Vec::new();
    let mut stated = Vec::new();
    for line in text.lines() {
        let mut words = line
            .split([' ', '.', ':', '('])
            .filter(|word| !word.is_empty());
        match (words.next(), words.next()) {
            (Some("Module"), Some(name)) => modules.push(name),
            (Some("End"), Some(name)) if modules.last() == Some(&name) => {
                modules.pop();
            }
            (Some("Theorem" | "Corollary"), Some(name)) => {
                let mut path = modules.clone();
                path.push(name);
                stated.push(path.join("."));
            }
            _ => {}
        }
    }
    stated
}

#[test]
fn every_theorem_is_said_in_words() {
    let readme = fs::read_to_string(proofs().join("README.md")).unwrap();
    let mut count = 0;
    for file in fs::read_dir(proofs().join("theory")).unwrap() {
        let path = file.unwrap().path();
        for theorem in stated(&fs::read_to_string(&path).unwrap()) {
            assert!(
                readme.contains(&format!("`{theorem}`")),
                "{theorem} of {}",
                path.display()
            );
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}

#[test]
fn theorems_behind_orders_stand_in_their_files() {
    for theorem in Theorem::ALL {
        let path = proofs().join("..").join(theorem.file);
        let text = fs::read_to_string(&path).unwrap();
        assert!(
            stated(&text).iter().any(|name| name == theorem.name),
            "{theorem}"
        );
    }
}

/// The tests that the tables name are there.
#[test]
fn tests_that_tie_proofs_to_code_exist() {
    let readme = fs::read_to_string(proofs().join("README.md")).unwrap();
    let folder = proofs().join("../tests/proofs");
    let mut tests = BTreeSet::new();
    for file in fs::read_dir(folder).unwrap() {
        let text = fs::read_to_string(file.unwrap().path()).unwrap();
        for line in text.lines() {
            if let Some(rest) = line.trim().strip_prefix("fn ") {
                let name: String = rest.chars().take_while(|c| *c != '(').collect();
                tests.insert(name);
            }
        }
    }
    for name in [
        "errors_stay_below_the_proved_bounds",
        "the_loop_is_the_formula_of_the_theorem_bit_for_bit",
        "rounding_stays_below_the_proved_bound",
        "neglected_attenuation_costs_half_a_step",
        "opacities_round_as_proved",
    ] {
        assert!(tests.contains(name), "{name}");
        assert!(readme.contains(name), "{name}");
    }
}
