//! Methods of the library and kernels that take volumes, in several formats: all are right where they say what they are.

use super::{ask, cell, expm1, faults, march, method};
use volver::kernel::{BuiltIn, Closure, Cut, Data, Declaration, FormKind, Table};
use volver::real::FormatName;
use volver::study::extremes::Answer;
use volver::study::stress::METHODS;

#[test]
fn the_methods_whose_roundoff_is_bounded_keep_their_word() {
    for name in METHODS {
        for format in ["f16", "f32", "f64", "ieee:24,-300,300", "mpfr:100"] {
            let format: FormatName = format.parse().unwrap();
            let found = ask(&mut BuiltIn::new(name.parse().unwrap(), format));
            assert_eq!(faults(&found), [""; 0], "{name} in {format}");
            let is_there = |name: &str| cell(&found, name).answer != Some(Answer::Missing);
            assert!(is_there("depth/1e0") && is_there("segments/1"), "{name}");
        }
    }
}

/// Methods of which no bound is known have a value all the same.
#[test]
fn other_methods_are_measured_by_their_own_values() {
    for name in ["boole/gauss-2", "layers/linear", "layers/whole-own"] {
        let found = ask(&mut BuiltIn::new(name.parse().unwrap(), FormatName::F64));
        assert_eq!(faults(&found), [""; 0], "{name}");
    }
}

/// A loop over a grid and its tables.
#[test]
fn volumes_have_the_same_rays() {
    let declaration = Declaration {
        form: FormKind::Volume,
        ..method("front-to-back/middle/expm1")
    };
    let mut kernel = Closure::new(declaration, |task, _| {
        let Data::Volume(volume) = task.data else {
            return f64::NAN;
        };
        let cut = Cut::Segments(task.segments);
        let segments = volume.segments(task.subject.length(), cut, Table::at);
        march(&segments.unwrap(), |tau| tau, expm1)
    });
    let found = ask(&mut kernel);
    assert_eq!(faults(&found), [""; 0]);
    assert_eq!(found.cells.len(), 16);
}

#[test]
fn numbers_of_segments_suit_the_kernel() {
    for (multiple, many) in [(3, 24), (6, 24), (12, 24), (16, 16), (5, 40)] {
        let declaration = Declaration {
            multiple_of: multiple.try_into().unwrap(),
            ..method("front-to-back/middle/expm1")
        };
        let mut kernel = Closure::new(declaration, move |task, _| {
            assert!(task.segments.is_multiple_of(multiple), "{}", task.segments);
            march(task.cut().unwrap(), |tau| tau, expm1)
        });
        let found = ask(&mut kernel);
        assert_eq!(faults(&found), [""; 0]);
        assert_eq!(cell(&found, "depth/1e0").n, many);
        assert_eq!(cell(&found, "segments/1").n, multiple);
    }
}

#[test]
fn multiples_that_no_ray_has_are_refused() {
    for multiple in [(1 << 20) + 1, u64::MAX] {
        let declaration = Declaration {
            multiple_of: multiple.try_into().unwrap(),
            ..Declaration::new("under test")
        };
        let mut kernel = Closure::new(declaration, |_, _| 0.0);
        let refused = volver::study::extremes::extremes(&mut kernel, &volver::study::Silent);
        let error = refused.unwrap_err().to_string();
        assert!(error.contains("(allowed: 1 to 1048576)"), "{error}");
    }
}
