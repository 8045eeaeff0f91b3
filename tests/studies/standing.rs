//! What a channel says, of errors made up for it.

use rug::Float;
use volver::convergence::{Sample, Verdict, fit};
use volver::inside::study::verify::{Judged, methods, of};
use volver::method::Expected;
use volver::study::verify::{Measured, Standing};

/// Errors of that order on seven levels, with a part that does not converge.
fn measured(order: f64, rest: f64, expected: Expected) -> Measured {
    let sample = |level: i32| {
        let step = 0.5_f64.powi(level);
        Sample {
            n: None,
            step,
            error: Float::with_val(53, step.powf(order) + rest),
            floor: Float::with_val(53, 1e-16),
        }
    };
    let samples: Vec<Sample> = (3..10).map(sample).collect();
    let fit = Box::new(fit(&samples, Some(expected)).unwrap());
    Measured::Fitted { fit, samples }
}

fn standing(measured: &Measured, expected: Expected, of_method: Option<Verdict>) -> Standing {
    of(&Judged {
        resolved: true,
        reported: None,
        measured,
        expected: Some(expected),
        failures: &[],
        of_method,
        of_order: &[],
        resolvable: of_method.map(|of_method| of_method.passes(Some(expected))),
        in_range: true,
        sound: true,
    })
}

#[test]
fn a_blind_case_still_tells_what_does_not_converge() {
    let blind = Expected::Blind {
        general: 1.0,
        here: 2.0,
    };
    let fine = measured(2.0, 0.0, blind);
    assert_eq!(
        standing(&fine, blind, Some(Verdict::Blind)),
        Standing::Blind
    );
    let too_bright = measured(2.0, 0.1, blind);
    assert_eq!(too_bright.verdict(), Verdict::Stalled);
    let contradicted = standing(&too_bright, blind, Some(Verdict::Blind));
    assert_eq!(contradicted, Standing::Contradicted);
    // Where the method itself stalls there, nobody does better.
    let as_the_method = standing(&too_bright, blind, Some(Verdict::Stalled));
    assert_eq!(as_the_method, Standing::Blind);
}

#[test]
fn what_the_method_cannot_show_is_not_asked_of_a_kernel() {
    let second = Expected::Order(2.0);
    let first = measured(1.0, 0.0, second);
    assert_eq!(first.verdict(), Verdict::TooLow);
    for (of_method, says) in [
        (Some(Verdict::Confirmed), Standing::Contradicted),
        (Some(Verdict::PreAsymptotic), Standing::Unresolved),
        (None, Standing::Contradicted),
    ] {
        assert_eq!(standing(&first, second, of_method), says);
    }
    // Of a claim alone an order may be higher here or there.
    let third = measured(3.0, 0.0, second);
    assert_eq!(third.verdict(), Verdict::TooHigh);
    assert_eq!(standing(&third, second, None), Standing::Inconclusive);
    let confirmed = Some(Verdict::Confirmed);
    assert_eq!(standing(&third, second, confirmed), Standing::Contradicted);
}

/// In binary16 what is far below its smallest number is 0, whoever computes it.
#[test]
fn what_all_methods_of_an_order_show_in_a_format_contradicts_nobody() {
    let second = Expected::Order(2.0);
    let stalled = measured(2.0, 0.1, second);
    assert_eq!(stalled.verdict(), Verdict::Stalled);
    let beside = |of_order: &[Verdict]| {
        of(&Judged {
            of_order,
            resolvable: Some(of_order.contains(&Verdict::Confirmed)),
            resolved: true,
            reported: None,
            measured: &stalled,
            expected: Some(second),
            failures: &[],
            of_method: None,
            in_range: true,
            sound: true,
        })
    };
    let all = [Verdict::Stalled; 3];
    assert_eq!(beside(&all), Standing::Unresolved);
    let one_converges = [Verdict::Stalled, Verdict::PreAsymptotic, Verdict::Stalled];
    assert_eq!(beside(&one_converges), Standing::Contradicted);
    assert_eq!(beside(&[]), Standing::Contradicted);
}

/// A name that no method has would leave an order without one that is asked.
#[test]
fn methods_that_kernels_are_measured_by_have_the_order_that_they_stand_for() {
    for (order, count) in [(1.0, 3), (2.0, 3), (4.0, 2), (6.0, 2)] {
        let methods = methods(order);
        assert_eq!(methods.len(), count, "{order}");
        for method in methods {
            assert_eq!(method.order(), Expected::Order(order), "{method}");
        }
    }
    assert!(methods(3.0).is_empty());
}
