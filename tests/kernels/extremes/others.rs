//! Other answers than radiances, walls, backgrounds, quanta and random numbers; and none at all.

use super::{ask, cell, digits, expm1, faults, march, method, of, order};
use rug::Float;
use volver::kernel::{
    Declaration, DepthWeights, Kernel, KernelError, Quantity, Quantum, Rendering, Segments, Task,
};
use volver::real::FormatName;
use volver::study::extremes::Answer;

/// Answers what a function makes of segments.
#[derive(Debug)]
struct Answering {
    declaration: Declaration,
    answer: fn(&Segments) -> Result<Rendering, KernelError>,
}

impl Kernel for Answering {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }
    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let wanted: usize = usize::from(self.declaration.background);
        assert_eq!(task.subject.background().len(), wanted);
        (self.answer)(task.cut().unwrap())
    }
}

fn number(x: f64) -> Float {
    Float::with_val(53, x)
}

fn depth(segments: &Segments) -> f64 {
    let middles = segments.middles.extinction.iter();
    middles.zip(segments.lengths()).map(|(t, d)| t * d).sum()
}

fn all(segments: &Segments) -> Rendering {
    let radiance = march(segments, |tau| tau, expm1);
    let (mut moment, mut transmittance) = (0.0, 1.0);
    for (i, length) in segments.lengths().enumerate() {
        let alpha = expm1(segments.middles.extinction[i] * length);
        moment += transmittance * alpha * segments.middles.lambda[i];
        transmittance *= 1.0 - alpha;
    }
    Rendering {
        radiance: vec![number(radiance)],
        // Not known better than to a unit of 1.
        opacity: Some(number(1.0 - transmittance)),
        optical_depth: Some(number(depth(segments))),
        expected_depth: Some(number(moment)),
        ..Rendering::default()
    }
}

fn answering(answer: fn(&Segments) -> Result<Rendering, KernelError>) -> Answering {
    Answering {
        declaration: Declaration {
            answers: Quantity::ALL.to_vec(),
            ..order()
        },
        answer,
    }
}

#[test]
fn every_answer_has_its_cells() {
    let found = ask(&mut answering(|s| Ok(all(s))));
    assert_eq!(faults(&found), [""; 0]);
    // Emission is the radiance's alone.
    assert_eq!(found.cells.len(), 16 + 3 * 14);
    let thick = cell(&found, "depth/1e3:optical_depth");
    assert!(digits(thick.digits) > 14.0, "{thick:?}");
    assert_eq!(cell(&found, "depth/1e0:expected_depth").digits, None);
    // A plain sum of opacities is none.
    let summed = ask(&mut answering(|s| {
        let of = |(t, d): (&f64, f64)| expm1(t * d);
        let middles = s.middles.extinction.iter();
        let sum: f64 = middles.zip(s.lengths()).map(of).sum();
        Ok(Rendering {
            opacity: Some(number(sum.min(1.0))),
            ..all(s)
        })
    }));
    let faults = faults(&summed);
    assert!(
        faults.contains(&"depth/1e0:opacity".to_string()),
        "{faults:?}"
    );
    assert!(
        faults.iter().all(|name| name.ends_with(":opacity")),
        "{faults:?}"
    );
}

/// The mean depth of nothing is none, and the plain one is 0.
#[test]
fn a_mean_depth_may_be_missing_in_vacuum() {
    let answer = |s: &Segments| {
        let mut all = all(s);
        let opacity = all.opacity.clone().unwrap();
        all.expected_depth = all.expected_depth.map(|moment| moment / opacity);
        Ok(all)
    };
    let mut kernel = answering(answer);
    let name = "vacuum/all:expected_depth";
    let plain = ask(&mut kernel);
    assert_eq!(cell(&plain, name).answer, Some(Answer::NotANumber));
    assert!(faults(&plain).contains(&name.to_string()));
    kernel.declaration.expected_depth = DepthWeights::ByOpacity;
    let divided = ask(&mut kernel);
    assert_eq!(cell(&divided, name).answer, Some(Answer::NotANumber));
    assert!(!faults(&divided).contains(&name.to_string()));
}

#[test]
fn a_projector_has_no_radiance() {
    let mut kernel = answering(|s| {
        Ok(Rendering {
            optical_depth: Some(number(depth(s))),
            ..Rendering::default()
        })
    });
    kernel.declaration.answers = vec![Quantity::OpticalDepth];
    let found = ask(&mut kernel);
    assert_eq!(faults(&found), [""; 0]);
    assert_eq!(found.cells.len(), 16);
    assert_eq!(
        cell(&found, "fault/negative-tau:optical_depth").answer,
        Some(Answer::Amplified)
    );
}

#[test]
fn who_takes_a_background_has_a_black_one() {
    let mut kernel = answering(|s| Ok(all(s)));
    kernel.declaration.background = true;
    assert_eq!(faults(&ask(&mut kernel)), [""; 0]);
}

/// A last segment of 1e10 is a wall, but for rays that are too thin even for that.
#[test]
fn walls_are_what_they_are_declared() {
    let walled = |segments: &Segments| {
        let mut segments = segments.clone();
        if let Some(end) = segments.edges.lambda.last_mut() {
            *end += 1e10;
        }
        march(&segments, |tau| tau, expm1)
    };
    let declaration = Declaration {
        far_wall: true,
        ..method("front-to-back/middle/expm1")
    };
    let found = of(declaration.clone(), walled);
    assert_eq!(faults(&found), [""; 0]);
    assert!(digits(cell(&found, "depth/1e0").digits) > 14.0);
    // One that is declared and not there.
    let missing = of(declaration, |s| march(s, |tau| tau, expm1));
    assert!(faults(&missing).contains(&"depth/1e0".to_string()));
    let undeclared = of(method("front-to-back/middle/expm1"), walled);
    assert!(faults(&undeclared).contains(&"depth/1e-12".to_string()));
}

#[test]
fn quanta_are_allowed_where_they_are_declared() {
    let rounded = |s: &Segments| (march(s, |tau| tau, expm1) * 255.0).round() / 255.0;
    let declaration = Declaration {
        quantum: Some(Quantum::Absolute(1.0 / 255.0)),
        ..order()
    };
    assert_eq!(faults(&of(declaration, rounded)), [""; 0]);
    let undeclared = faults(&of(order(), rounded));
    assert!(
        undeclared.contains(&"depth/1e-12".to_string()),
        "{undeclared:?}"
    );
}

/// Eleven bits of what is computed in 53, and a little by chance.
#[test]
fn what_is_stored_and_what_scatters_is_allowed_where_it_is_declared() {
    let composite = || method("front-to-back/middle/expm1");
    let half = |s: &Segments| Float::with_val(11, march(s, |tau| tau, expm1)).to_f64();
    let declaration = Declaration {
        output: Some(FormatName::F16),
        ..composite()
    };
    assert_eq!(faults(&of(declaration, half)), [""; 0]);
    assert!(faults(&of(composite(), half)).contains(&"depth/1e0".to_string()));
    let off = |s: &Segments| march(s, |tau| tau, expm1) + 9e-4;
    let declaration = |noise| Declaration {
        noise: Some(noise),
        ..composite()
    };
    assert_eq!(faults(&of(declaration(1e-3), off)), [""; 0]);
    assert!(faults(&of(declaration(1e-5), off)).contains(&"depth/1e0".to_string()));
}

/// Chance is no promise, but it has to be a number.
#[test]
fn random_numbers_are_promised_nothing_but_numbers() {
    let declaration = Declaration {
        stochastic: true,
        ..order()
    };
    let scattered = |s: &Segments| 1.1 * march(s, |tau| tau, expm1);
    assert_eq!(faults(&of(declaration.clone(), scattered)), [""; 0]);
    let not = of(declaration, |s| march(s, |tau| tau * (tau / tau), expm1));
    assert_eq!(faults(&not), ["vacuum/all", "vacuum/between"]);
}

#[test]
fn no_answer_is_said_with_its_reason() {
    let found = ask(&mut answering(|s| {
        if s.middles.extinction.iter().all(|t| *t == 0.0) {
            let reason = "no vacuum here".into();
            return Err(KernelError::Refused { reason });
        }
        Ok(all(s))
    }));
    let vacuum = cell(&found, "vacuum/all");
    assert_eq!(vacuum.answer, Some(Answer::Missing));
    assert!(vacuum.is_fault && vacuum.reason.as_deref().unwrap().contains("no vacuum here"));
    assert_eq!(found.without_answer(), None);
    let silent = ask(&mut answering(|_| Ok(Rendering::default())));
    let why = silent.without_answer().unwrap();
    assert!(why.starts_with("0 radiances (allowed: 1"), "{why}");
}
