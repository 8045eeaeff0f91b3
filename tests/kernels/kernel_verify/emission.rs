//! Kernels whose source is per length: rays that emit and do not absorb are asked of them, too.

use super::{declared, run, settings, shown, subjects};
use volver::kernel::{
    Closure, Declaration, DeclarationError, FormKind, GradientAt, Quantity, Source,
};
use volver::study::verify::{Conclusion, Line, Standing, Verification};

const CASES: [&str; 4] = ["sine-squared", "rgb-transfer", "cloud", "thick"];

/// What a segment of source j, attenuation μ and length d shows: j d (1 − e^(−μd))/(μd).
fn seen(j: f64, mu: f64, d: f64) -> f64 {
    let depth = mu * d;
    if depth == 0.0 {
        j * d
    } else {
        j * d * -(-depth).exp_m1() / depth
    }
}

/// A projector with attenuation, of what its segments show.
fn verified(source: Source, of: impl Fn(f64, f64, f64) -> f64 + Send) -> Verification {
    let declaration = Declaration {
        source,
        ..declared("front-to-back/middle/expm1")
    };
    let mut kernel = Closure::new(declaration, move |task, channel| {
        let segments = task.cut().expect("segments are asked for");
        let middles = &segments.middles;
        let (mut radiance, mut depth) = (0.0, 0.0_f64);
        let values = middles.extinction.iter().zip(&middles.emission[channel]);
        for ((mu, j), d) in values.zip(segments.lengths()) {
            radiance += (-depth).exp() * of(*j, *mu, d);
            depth += mu * d;
        }
        radiance
    });
    run(&mut kernel, &subjects(&CASES), &settings("8..256"))
}

fn emission<'a>(verification: &'a Verification, case: &str) -> &'a Line {
    let name = format!("{case}:emission");
    let line = verification.lines.iter().find(|line| line.name == name);
    line.expect("is asked")
}

#[test]
fn a_projector_is_right_with_absorption_and_without() {
    let verification = verified(Source::Length, seen);
    let shown = shown(&verification);
    assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{shown}");
    assert_eq!(
        verification.quantities(),
        [Quantity::Radiance, Quantity::Emission]
    );
    // One a case, whatever its channels are.
    assert_eq!(verification.lines.len(), 6 + 4, "{shown}");
    let line = emission(&verification, "sine-squared");
    assert_eq!(line.standing, Standing::Confirmed, "{shown}");
    assert_eq!(line.as_declared, Some(true));
    // t(λ) = sin(λ²)/2 of the paper's first case.
    let exact = 1_f64.sin() / 2.0;
    assert!((line.exact.to_f64() - exact).abs() < 1e-15);
}

/// Radiances alone do not show who has no value where nothing absorbs.
#[test]
fn what_fails_where_nothing_absorbs_is_seen() {
    let radiances = |verification: &Verification| {
        let lines = verification.of(Quantity::Radiance);
        lines
            .filter(|line| line.standing == Standing::Contradicted)
            .count()
    };
    // 0/0; nothing; a thousandth too much: all where there is no depth alone.
    let wrong: [fn(f64, f64, f64) -> f64; 3] = [
        |j, mu, d| j / mu * -(-mu * d).exp_m1(),
        |j, mu, d| if mu == 0.0 { 0.0 } else { seen(j, mu, d) },
        |j, mu, d| {
            if mu == 0.0 {
                1.001 * j * d
            } else {
                seen(j, mu, d)
            }
        },
    ];
    for of in wrong {
        let verification = verified(Source::Length, of);
        let shown = shown(&verification);
        assert_eq!(
            verification.conclusion(),
            Conclusion::NotConfirmed,
            "{shown}"
        );
        assert_eq!(
            emission(&verification, "cloud").standing,
            Standing::Contradicted,
            "{shown}"
        );
        assert_eq!(radiances(&verification), 0, "{shown}");
    }
    // Who takes C for j is wrong everywhere.
    let verification = verified(Source::Depth, seen);
    assert_eq!(verification.conclusion(), Conclusion::NotConfirmed);
    assert_eq!(verification.quantities(), [Quantity::Radiance]);
    assert!(radiances(&verification) > 0);
}

#[test]
fn a_source_per_length_is_one_of_segments() {
    let with = |form, gradient, far_wall| Declaration {
        source: Source::Length,
        form,
        gradient,
        far_wall,
        ..Declaration::new("a")
    };
    for (declaration, error) in [
        (
            with(FormKind::Volume, None, false),
            DeclarationError::SourceOfForm {
                form: FormKind::Volume,
            },
        ),
        (
            with(FormKind::Segments, Some(GradientAt::Middles), false),
            DeclarationError::GradientOfSource,
        ),
        (
            with(FormKind::Segments, None, true),
            DeclarationError::SourceOfWall,
        ),
    ] {
        assert_eq!(declaration.check(), Err(error));
    }
}
