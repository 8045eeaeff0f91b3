//! What is behind a ray: a surface, a sky.

use super::{declared, run, shown, subjects};
use rug::Float;
use std::fmt;
use volver::kernel::{Declaration, Kernel, KernelError, Rendering, SubjectError, Task};
use volver::method::Expected;
use volver::study::verify::{Axis, Conclusion, Identify, Settings, Standing, Verification};

/// Rays that let much through and little, one of them nothing and one all; with one channel and three.
const CASES: [&str; 7] = [
    "sine-squared",
    "atmosphere",
    "homogeneous",
    "rgb-transfer",
    "thick",
    "thick-back",
    "vacuum",
];

/// Of T and the depth of the last sample, what of the background is seen.
type Seen = fn(f64, f64) -> f64;

/// One sample a segment and what is behind.
struct Before {
    declaration: Declaration,
    seen: Seen,
}

impl fmt::Debug for Before {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Before")
    }
}

impl Kernel for Before {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let segments = task.cut().expect("segments");
        let samples = &segments.middles;
        let radiance = samples
            .emission
            .iter()
            .enumerate()
            .map(|(channel, emission)| {
                let (mut radiance, mut through, mut last) = (0.0, 1.0, 0.0);
                for (i, length) in segments.lengths().enumerate() {
                    last = samples.extinction[i] * length;
                    let alpha = -(-last).exp_m1();
                    radiance += through * alpha * emission[i];
                    through *= (-last).exp();
                }
                let behind = task.subject.background().get(channel);
                radiance += behind.map_or(0.0, |behind| (self.seen)(through, last) * behind);
                Float::with_val(53, radiance)
            });
        Ok(Rendering {
            radiance: radiance.collect(),
            ..Rendering::default()
        })
    }
}

fn verified(declaration: Declaration, seen: Seen, identify: Identify) -> Verification {
    let mut kernel = Before { declaration, seen };
    let settings = Settings {
        identify,
        ..Settings::standard(Axis::Step).unwrap()
    };
    run(&mut kernel, &subjects(&CASES), &settings)
}

fn middle() -> Declaration {
    Declaration {
        background: true,
        ..declared("front-to-back/middle/expm1")
    }
}

#[test]
fn what_is_let_through_has_the_order_of_the_rest() {
    let by_order = Declaration {
        method: None,
        order: Some(2.0),
        ..middle()
    };
    for declaration in [middle(), by_order] {
        let verification = verified(declaration, |through, _| through, Identify::Off);
        let said = shown(&verification);
        assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{said}");
        let of_order = |standing| {
            let lines = verification.lines.iter();
            let lines = lines.filter(|line| line.expected == Some(Expected::Order(2.0)));
            lines.filter(|line| line.standing == standing).count()
        };
        assert!(of_order(Standing::Confirmed) >= 4, "{said}");
    }
}

#[test]
fn the_radiance_is_that_in_front_and_what_is_left_of_that_behind() {
    let seen = |through: f64, _: f64| through;
    let verification = verified(middle(), seen, Identify::Off);
    let exact = |name: &str| {
        let line = verification.lines.iter().find(|line| line.name == name);
        line.expect(name).exact.to_f64()
    };
    // Nothing is in front of it.
    assert_eq!(exact("vacuum"), 0.5);
    // The paper's case: t = sin(1)/2, I = 2 − (sin 1 + 2) e^(−t).
    let depth = 1_f64.sin() / 2.0;
    let want = 2.0 - (1_f64.sin() + 2.0) * (-depth).exp() + 0.5 * (-depth).exp();
    assert!(
        (exact("sine-squared") - want).abs() < 1e-15,
        "{}",
        exact("sine-squared")
    );
    // Every channel has its own.
    let closed =
        |constant: f64, behind: f64| constant - (constant - behind) * (-5.0_f64 / 3.0).exp();
    assert!((exact("rgb-transfer/red") - closed(1.0, 0.5)).abs() < 1e-14);
    // The values are the method's, and the rule is the one that it has without a background.
    let (agree, of) = verification.as_declared().expect("compared");
    assert_eq!(agree, of);
    let identified = verified(middle(), seen, Identify::Auto);
    let said = shown(&identified);
    assert_eq!(identified.conclusion(), Conclusion::Confirmed, "{said}");
    assert!(said.contains("samples in the middle of segments"), "{said}");
}

#[test]
fn backgrounds_that_are_wrong_are_contradicted() {
    let faults: [(&str, Seen); 4] = [
        ("left out", |_, _| 0.0),
        ("in front of all", |_, _| 1.0),
        ("before the last sample", |through, last| {
            through * last.exp()
        }),
        ("squared", |through, _| through * through),
    ];
    for (name, seen) in faults {
        let verification = verified(middle(), seen, Identify::Off);
        let said = format!("{name}\n{}", shown(&verification));
        assert_eq!(
            verification.conclusion(),
            Conclusion::NotConfirmed,
            "{said}"
        );
        let lines = verification.lines.iter();
        let contradicted = lines.filter(|line| line.standing == Standing::Contradicted);
        assert!(contradicted.count() >= 3, "{said}");
    }
    // One that says nothing of a background is given none.
    let silent = Declaration {
        background: false,
        ..middle()
    };
    let verification = verified(silent, |_, _| 1.0, Identify::Off);
    assert_eq!(verification.conclusion(), Conclusion::Confirmed);
}

#[test]
fn a_background_has_the_channels_of_its_case() {
    let subject = subjects(&["rgb-transfer"]).remove(0);
    assert_eq!(
        subject.clone().before(vec![1.0]).unwrap_err(),
        SubjectError::Background { got: 1, wanted: 3 }
    );
    let before = subject.before(vec![1.0, 2.0, 3.0]).unwrap();
    assert_eq!(before.background(), [1.0, 2.0, 3.0]);
}
