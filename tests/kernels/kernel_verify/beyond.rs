//! Where a high order ends; and rules that look at the layers beside, which nothing names.

use super::{SMOOTH, rule, run, settings, shown, subjects};
use rug::Float;
use volver::convergence::{FLOOR_MARGIN, Sample, fit};
use volver::kernel::{BuiltIn, Declaration, Kernel, KernelError, Rendering, Task};
use volver::method::{Expected, Layers, Method};
use volver::real::FormatName;
use volver::study::verify::{Beyond, Line, Measured, Settings, TakesOver};

fn built_in(method: &str, format: &str) -> BuiltIn {
    BuiltIn::new(method.parse().unwrap(), format.parse().unwrap())
}

/// Some channel of some kernel.
fn line() -> Line {
    let mut kernel = built_in("simpson/simpson", "f64");
    let verification = run(&mut kernel, &subjects(&["cloud"]), &settings("8..256"));
    verification.lines[0].clone()
}

/// The same with errors of n = 8 … 1024 above a floor of 2⁻⁵².
fn with_errors(order: f64, error: impl Fn(f64) -> f64) -> Option<Beyond> {
    let level = |k: i32| {
        let n = 2_f64.powi(k);
        Sample {
            n: Some(1 << k),
            step: 1.0 / n,
            error: Float::with_val(53, error(1.0 / n)),
            floor: Float::with_val(53, f64::EPSILON),
        }
    };
    let samples: Vec<Sample> = (3..=10).map(level).collect();
    let expected = Some(Expected::Order(order));
    let fit = Box::new(fit(&samples, expected).unwrap());
    let measured = Measured::Fitted { fit, samples };
    let line = Line {
        expected,
        measured,
        ..line()
    };
    line.beyond()
}

#[test]
fn rounding_or_something_else_takes_over_at_a_level() {
    let at = |n, by| Some(Beyond { n, by });
    // 2⁻⁴⁴ at n = 512 and 2⁻⁴⁸ at 1024, where 30 floors are 2⁻⁴⁷·⁰⁹.
    let small = |d: f64| d.powi(4) / 256.0;
    assert_eq!(with_errors(4.0, small), at(512, TakesOver::Rounding));
    assert_eq!(with_errors(4.0, |d| d.powi(4)), None);
    // Of a series of six digits: d³ is as much at n = 100, and from 128 to 256 errors fall by 1.39, less than √2.
    let series = |d: f64| d.powi(3) + 1e-6;
    assert_eq!(with_errors(3.0, series), at(128, TakesOver::Other));
    // A low order has other troubles, and its own remarks.
    assert_eq!(with_errors(2.0, |d| d * d + 1e-3), None);
    assert_eq!(with_errors(2.0, |d| 1e-9 * d * d), None);
}

#[test]
fn a_method_in_binary32_ends_where_its_errors_meet_their_floors() {
    let mut kernel = built_in("simpson/simpson", "f32");
    let found = run(&mut kernel, &subjects(&SMOOTH), &settings("8..1024"));
    let mut told = 0;
    for line in &found.lines {
        let (Some(beyond), Measured::Fitted { samples, .. }) = (line.beyond(), &line.measured)
        else {
            continue;
        };
        told += 1;
        assert_eq!(beyond.by, TakesOver::Rounding, "{}", line.name);
        // Floors do not fall from level to level.
        let mut floor = Float::new(64);
        let stands = |sample: &&Sample| {
            floor.max_mut(&sample.floor);
            sample.error.clone().abs() > Float::with_val(64, &floor * FLOOR_MARGIN)
        };
        let last = samples.iter().take_while(stands).last().unwrap();
        assert_eq!(Some(beyond.n), last.n, "{}", line.name);
    }
    assert!(told >= 8, "{told}");
    let mut wide = built_in("front-to-back/middle/expm1", "f64");
    let found = run(&mut wide, &subjects(&SMOOTH), &settings("8..1024"));
    assert!(found.lines.iter().all(|line| line.beyond().is_none()));
}

/// A method that does not say which it is.
#[derive(Debug)]
struct Undeclared {
    method: BuiltIn,
    declaration: Declaration,
}

impl Kernel for Undeclared {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        self.method.render(task)
    }
}

/// Three and four places in a row are no rule of one segment: it is not named, and no other in its place.
#[test]
fn curves_through_the_layers_beside_have_no_wrong_name() {
    let settings = Settings {
        expect: Some(3.into()),
        ..settings("8..256")
    };
    for layers in Layers::ALL {
        let Layers::Bezier(_) = layers else {
            continue;
        };
        let method = BuiltIn::new(Method::Layered(layers), FormatName::F64);
        let declaration = Declaration::new("under test");
        let mut kernel = Undeclared {
            method,
            declaration,
        };
        let found = run(
            &mut kernel,
            &subjects(&["cloud", "rgb-transfer"]),
            &settings,
        );
        assert_eq!(
            rule(&found),
            "not identified",
            "{layers}: {}",
            shown(&found)
        );
    }
}
