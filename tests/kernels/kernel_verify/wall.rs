//! The far wall: a last segment that lets nothing through.

use super::{composite, declared, deviations, front, part, run, settings, shown, subjects};
use volver::kernel::{Closure, Declaration, Kernel, Segments};
use volver::study::verify::{Conclusion, Standing, Verification};

/// Something of the wall is seen in each.
const SEEN: [&str; 6] = [
    "cloud",
    "decaying-field",
    "hyperbolic-tangent",
    "linear-transfer",
    "rational-radiance",
    "sine-squared",
];
const METHOD: &str = "front-to-back/front/expm1";

fn free(segments: &Segments, channel: usize) -> f64 {
    composite(front(segments, channel))
}

/// A last length of 1e10, as many renderers have it.
fn walled(segments: &Segments, channel: usize) -> f64 {
    let mut samples = front(segments, channel);
    if let Some(last) = samples.last_mut() {
        last.2 = 1e10;
    }
    composite(samples)
}

fn verified(radiance: fn(&Segments, usize) -> f64, far_wall: bool) -> Verification {
    let declaration = Declaration {
        far_wall,
        ..declared(METHOD)
    };
    let mut kernel: Box<dyn Kernel> = Box::new(Closure::new(declaration, move |task, channel| {
        task.cut().map_or(f64::NAN, |s| radiance(s, channel))
    }));
    run(kernel.as_mut(), &subjects(&SEEN), &settings("8..512"))
}

#[test]
fn a_wall_that_is_declared_is_confirmed() {
    let verification = verified(walled, true);
    let shown = shown(&verification);
    assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{shown}");
    assert!(part(&verification, Standing::Confirmed) > 0.8, "{shown}");
    assert_eq!(deviations(&verification), [""; 0], "{shown}");
    let all = verification.lines.len();
    assert_eq!(verification.as_declared(), Some((all, all)), "{shown}");
    // What stands behind is seen: the radiance is another.
    let without = verified(free, false);
    for (with, without) in verification.lines.iter().zip(&without.lines) {
        assert!(with.exact > without.exact, "{}", with.name);
    }
}

#[test]
fn a_wall_that_is_not_declared_is_named() {
    let verification = verified(walled, false);
    let shown = shown(&verification);
    assert_eq!(
        verification.conclusion(),
        Conclusion::NotConfirmed,
        "{shown}"
    );
    assert_eq!(deviations(&verification), ["wall"], "{shown}");
    assert_eq!(part(&verification, Standing::Confirmed), 0.0, "{shown}");
    assert!(part(&verification, Standing::Contradicted) > 0.6, "{shown}");
}

#[test]
fn a_wall_that_is_not_there_is_contradicted() {
    let verification = verified(free, true);
    let shown = shown(&verification);
    assert_eq!(
        verification.conclusion(),
        Conclusion::NotConfirmed,
        "{shown}"
    );
    assert!(part(&verification, Standing::Contradicted) > 0.8, "{shown}");
    assert_eq!(
        verification.as_declared(),
        Some((0, verification.lines.len()))
    );
}
