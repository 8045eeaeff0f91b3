//! `proofs/README.md` says every theorem in words, and what the code names exists.

use super::proofs;
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

/// The tests that the tables name are there, in the files that they name.
#[test]
fn tests_that_tie_proofs_to_code_exist() {
    let readme = fs::read_to_string(proofs().join("README.md")).unwrap();
    let mut tied = BTreeSet::new();
    for paragraph in readme
        .split("\n\n")
        .filter(|p| p.contains("tied to the code by"))
    {
        let mut file = None;
        // What stands between backticks.
        for word in paragraph.split('`').skip(1).step_by(2) {
            if word.starts_with("tests/cases/proofs/") {
                let path = proofs().join("..").join(word);
                file = Some(fs::read_to_string(path).unwrap());
            } else if let Some(file) = &file {
                assert!(file.contains(&format!("fn {word}(")), "{word}");
                tied.insert(word.to_string());
            }
        }
    }
    assert!(tied.len() >= 15, "{tied:?}");
}
