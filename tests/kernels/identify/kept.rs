//! Rules that are kept as JSON, and kernels that compute by them.

use super::composed::plain;
use super::random::Random;
use volver::identify::rule::{Place, RuleKernel};
use volver::identify::{Budget, Rule, differences, identify, stated};
use volver::kernel::Declaration;
use volver::real::FormatName;

#[test]
fn a_rule_is_read_as_it_was_written() {
    let mut random = Random::new(21);
    let methods = [
        "trapezoid/trapezoid",
        "front-to-back/middle/expm1",
        "preintegrated/linear/linear",
    ];
    let stated: Vec<Rule> = methods
        .iter()
        .filter_map(|name| stated(&name.parse().unwrap()))
        .collect();
    assert!(stated.len() >= 2);
    for rule in (0..2000).map(|_| random.rule()).chain(stated) {
        let text = serde_json::to_string(&rule).unwrap();
        let read: Rule = serde_json::from_str(&text).unwrap();
        assert_eq!(read, rule, "{text}");
    }
    for (from, to) in [
        ("\"1/2\"", "\"1/0\""),
        ("\"1/2\"", "\"half\""),
        ("\"scheme\"", "\"plan\""),
    ] {
        let text = serde_json::to_string(&stated_rule()).unwrap();
        let broken = text.replacen(from, to, 1);
        assert_ne!(broken, text);
        assert!(serde_json::from_str::<Rule>(&broken).is_err(), "{broken}");
    }
}

fn stated_rule() -> Rule {
    stated(&"trapezoid/trapezoid".parse().unwrap()).unwrap()
}

#[test]
fn what_computes_by_a_rule_is_found_to_compute_by_it() {
    for format in [FormatName::F32, FormatName::F64] {
        for rule in [plain(Place::Middle), plain(Place::Front), stated_rule()] {
            let declaration = Declaration {
                format,
                ..Declaration::new("kept")
            };
            let mut kernel = RuleKernel::new(rule.clone(), declaration);
            let found = identify(&mut kernel, Budget::default(), &mut |_| ());
            let named = found.named().unwrap();
            assert_eq!(differences(named, &rule), [], "{format}: {rule}");
        }
    }
}
