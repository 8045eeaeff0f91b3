//! Thin rays: what 1 − e^(−x) loses, and who is promised more.

use super::{cell, digits, faults, march, method, of, order, subtraction};
use volver::kernel::{Declaration, Segments};
use volver::real::FormatName;
use volver::study::extremes::Answer;

/// 1 − e^(−x) in binary32, all of it.
fn single(segments: &Segments) -> f64 {
    #[allow(clippy::cast_possible_truncation)]
    let narrow = |x: f64| x as f32;
    let (mut radiance, mut transmittance) = (0.0_f32, 1.0_f32);
    let middles = &segments.middles;
    let both = middles.extinction.iter().zip(&middles.emission[0]);
    for ((extinction, emission), length) in both.zip(segments.lengths()) {
        let alpha = 1.0 - (-narrow(*extinction) * narrow(length)).exp();
        radiance += transmittance * alpha * narrow(*emission);
        transmittance *= 1.0 - alpha;
    }
    f64::from(radiance)
}

fn in_single(declaration: Declaration) -> Declaration {
    Declaration {
        format: FormatName::F32,
        ..declaration
    }
}

#[test]
fn who_means_a_subtraction_is_promised_what_it_keeps() {
    let found = of(
        in_single(method("front-to-back/middle/subtraction")),
        single,
    );
    assert_eq!(faults(&found), [""; 0]);
    let thin = cell(&found, "depth/1e-12");
    assert_eq!(thin.answer, Some(Answer::Zero));
    assert_eq!(thin.promised, Some(0.0));
}

#[test]
fn who_does_not_say_so_is_told() {
    for declaration in [order(), method("front-to-back/middle/expm1")] {
        let found = of(in_single(declaration), single);
        let faults = faults(&found);
        assert_eq!(
            faults[..4],
            ["depth/1e-12", "depth/1e-9", "depth/1e-6", "depth/1e-4"]
        );
        // 0.01/8 leaves 2⁻²⁴ of 2⁻¹⁰: about four digits.
        assert!(faults.len() <= 5, "{faults:?}");
        let thin = cell(&found, "depth/1e-12");
        assert_eq!(thin.answer, Some(Answer::Zero));
        let reason = thin.reason.as_deref().unwrap_or_default();
        assert!(reason.contains("expm1 keeps them"), "{reason}");
    }
}

/// In binary64 it is digits that are lost, not all of them.
#[test]
fn digits_fall_with_the_depth() {
    let found = of(order(), |s| march(s, |tau| tau, subtraction));
    let at = |name: &str| digits(cell(&found, name).digits);
    let all = ["depth/1e-12", "depth/1e-9", "depth/1e-6", "depth/1e0"].map(at);
    assert!(all.is_sorted_by(|a, b| a + 1.0 < *b), "{all:?}");
    // u/x: 1.1e-16 of 1.25e-13.
    assert!((2.5..5.5).contains(&all[0]), "{all:?}");
}

/// An answer of which no digit is promised is still no other number.
#[test]
fn what_may_be_lost_may_not_be_made_up() {
    let declaration = in_single(method("front-to-back/middle/subtraction"));
    let found = of(declaration, |s| single(s) + 1e-3);
    let faults = faults(&found);
    assert!(faults.contains(&"depth/1e-12".to_string()), "{faults:?}");
    assert!(faults.contains(&"vacuum/all".to_string()), "{faults:?}");
}
