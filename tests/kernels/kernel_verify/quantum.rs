//! Kernels that answer in steps, as images of 8 bits do.

use super::{SMOOTH, composite, declared, front, run, settings, shown, subjects};
use volver::kernel::{Closure, Declaration, Quantum};
use volver::study::verify::{Conclusion, Verification};

const QUANTUM: f64 = 1.0 / 255.0;

fn verified(quantum: Option<Quantum>) -> Verification {
    let declaration = Declaration {
        quantum,
        ..declared("front-to-back/front/expm1")
    };
    let mut kernel = Closure::new(declaration, |task, channel| {
        let segments = task.cut().expect("segments are asked for");
        let radiance = composite(front(segments, channel));
        (radiance / QUANTUM).round() * QUANTUM
    });
    run(&mut kernel, &subjects(&SMOOTH), &settings("8..512"))
}

/// What lies within a few quanta says nothing, neither for nor against.
#[test]
fn a_quantum_that_is_declared_contradicts_nothing() {
    let verification = verified(Some(Quantum::Absolute(QUANTUM)));
    let shown = shown(&verification);
    assert_eq!(verification.counts().contradicted, 0, "{shown}");
    assert!(!verification.contradicts_declaration(), "{shown}");
    assert!(!verification.deviates(), "{shown}");
}

#[test]
fn a_quantum_that_is_not_declared_is_flagged() {
    let verification = verified(None);
    assert_eq!(verification.conclusion(), Conclusion::NotConfirmed);
    assert!(verification.contradicts_declaration());
}
