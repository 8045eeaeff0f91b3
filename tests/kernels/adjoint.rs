//! `volver adjoint`: projectors beside their backprojectors.

use crate::verify::run::{Run, in_repository, volver};
use rug::Float;
use volver::kernel::{
    Declaration, Gradient, GradientAt, InnerProduct, Kernel, KernelError, Quantity, Rendering, Task,
};
use volver::study::adjoint::{Adjoint, AdjointError, Broken, adjoint};

fn run(options: &[&str], kernel: &[&str]) -> Run {
    let program = in_repository("examples/kernels/projector.py");
    volver(&[&["adjoint"], options, &["python3", &program], kernel].concat())
}

#[test]
fn matched_pairs_are_equal_to_rounding_in_the_inner_product_declared() {
    for sampling in ["middle", "ends"] {
        for weights in ["plain", "lengths"] {
            let kernel = ["--sampling", sampling, "--weights", weights];
            let document = run(&["--json", "-"], &kernel).with_code(0).json();
            assert_eq!(document["matched"], true);
            assert_eq!(document["inner_product"], weights);
            // 35 segments on five rays, with one end more each.
            let entries = if sampling == "middle" { 35 } else { 40 };
            assert_eq!(document["entries"], entries);
            assert_eq!(document["differ"], 0);
            for product in document["products"].as_array().unwrap() {
                assert!(product["mismatch"].as_f64().unwrap() < 1e-13, "{product}");
            }
            // A of the first ray are its lengths.
            let first = document["rays"][0]["forward"].as_array().unwrap();
            let inner = usize::from(sampling == "ends");
            assert_eq!(first[inner], 0.5);
        }
    }
}

#[test]
fn unmatched_pairs_are_named_or_shown_entry_by_entry() {
    for (fault, sampling, name, differ) in [
        ("factor", "middle", Some("adjoint-factor"), 35),
        ("sign", "ends", Some("adjoint-sign"), 40),
        ("weights", "middle", Some("adjoint-weights"), 35),
        ("weights", "ends", Some("adjoint-weights"), 40),
        // The last segments of three rays are shorter; of ends it is two values each.
        ("even", "middle", Some("adjoint-even-lengths"), 3),
        ("even", "ends", Some("adjoint-even-lengths"), 6),
        // Of ends: the first and the last of each ray, and where a shorter last segment begins.
        ("nearest", "ends", None, 13),
        ("nearest", "middle", None, 5),
    ] {
        let kernel = ["--sampling", sampling, "--fault", fault];
        let document = run(&["--json", "-"], &kernel).with_code(1).json();
        assert_eq!(document["matched"], false);
        assert_eq!(document["differ"], differ, "{fault} {sampling}");
        match name {
            Some(name) => assert_eq!(document["fault"]["name"], name, "{fault} {sampling}"),
            None => assert!(document["fault"].is_null(), "{fault} {sampling}"),
        }
        if fault == "factor" {
            assert_eq!(document["fault"]["value"], 1.07);
            for product in document["products"].as_array().unwrap() {
                // 1 − 1/1.07, whatever the vectors are.
                let mismatch = product["mismatch"].as_f64().unwrap();
                assert!((mismatch - 0.07 / 1.07).abs() < 1e-12, "{product}");
            }
        }
    }
}

#[test]
fn values_below_0_are_projected_too() {
    let document = run(&["--json", "-"], &["--fault", "clamp"])
        .with_code(1)
        .json();
    assert_eq!(
        document["broken"],
        serde_json::json!(["not-linear-below-0"])
    );
    assert_eq!(document["differ"], 0);
}

#[test]
fn the_report_is_printed_and_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let run = run(&["--out", out.to_str().unwrap()], &["--fault", "factor"]).with_code(1);
    assert!(run.out.contains("unmatched"), "{}", run.out);
    assert!(run.out.contains("Aᵀ is multiplied by 1.07"), "{}", run.out);
    for file in ["adjoint.json", "adjoint.md", "index.html"] {
        assert!(out.join(file).is_file(), "{file}");
    }
}

#[test]
fn a_kernel_without_an_adjoint_is_refused_in_one_line() {
    let program = in_repository("examples/kernels/gradient.py");
    let run = volver(&["adjoint", "python3", &program]).with_code(2);
    assert_eq!(run.err.lines().count(), 1, "{}", run.err);
    assert!(
        run.err.contains("no adjoint is declared (allowed: "),
        "{}",
        run.err
    );
    let program = in_repository("examples/kernels/projector.py");
    let run = volver(&["gradient", "python3", &program]).with_code(2);
    assert_eq!(run.err.lines().count(), 1, "{}", run.err);
    assert!(run.err.contains("no radiance"), "{}", run.err);
}

/// What is wrong with a projector inside the process.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    Nothing,
    Square,
    Remembers,
    Squared,
    Nan,
    Other,
}

#[derive(Debug)]
struct Inside {
    declaration: Declaration,
    fault: Fault,
}

impl Kernel for Inside {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let segments = task.cut().expect("segments");
        let values = &segments.middles.extinction;
        let terms = segments.lengths().zip(values).map(|(d, x)| d * x);
        let sum: f64 = match self.fault {
            Fault::Square => terms.map(|term| term * term).sum(),
            _ => terms.sum(),
        };
        Ok(Rendering {
            optical_depth: Some(Float::with_val(53, sum)),
            ..Rendering::default()
        })
    }

    fn gradient(
        &mut self,
        task: &Task<'_>,
        cotangents: &[f64],
    ) -> Result<(Rendering, Gradient), KernelError> {
        let segments = task.cut().expect("segments");
        let y = cotangents[0];
        let both = segments.lengths().zip(&segments.middles.extinction);
        let of = |(at, (d, x)): (usize, (f64, &f64))| match self.fault {
            Fault::Remembers => y * d * (1.0 + x),
            Fault::Squared => y * y * d,
            Fault::Nan if at == 2 => f64::NAN,
            // No factor, no length: another operator.
            Fault::Other => y * d * (1.0 + 0.01 * at as f64),
            _ => y * d,
        };
        let row = both.enumerate().map(of);
        let gradient = Gradient {
            extinction: row.map(|x| Float::with_val(53, x)).collect(),
            emission: Vec::new(),
        };
        Ok((self.render(task)?, gradient))
    }
}

fn found(fault: Fault) -> Adjoint {
    let declaration = Declaration {
        gradient: Some(GradientAt::Middles),
        answers: vec![Quantity::OpticalDepth],
        adjoint: Some(InnerProduct::Plain),
        ..Declaration::new("inside")
    };
    adjoint(&mut Inside { declaration, fault }).unwrap()
}

#[test]
fn what_is_not_linear_has_its_name() {
    assert!(found(Fault::Nothing).is_matched());
    for (fault, broken) in [
        (Fault::Square, Broken::Forward),
        (Fault::Remembers, Broken::Back),
        (Fault::Squared, Broken::Back),
        (Fault::Nan, Broken::NotFinite),
    ] {
        let found = found(fault);
        assert!(
            found.broken.contains(&broken),
            "{fault:?} {:?}",
            found.broken
        );
        assert!(!found.is_matched(), "{fault:?}");
    }
    let other = found(Fault::Other);
    assert!(other.broken.is_empty() && other.fault.is_none());
    // All but the first value of each ray.
    let differ: Vec<usize> = other.rays.iter().map(|ray| ray.differ.len()).collect();
    assert_eq!(differ, [5, 8, 4, 7, 6]);
}

#[test]
fn random_numbers_are_refused() {
    let declaration = Declaration {
        gradient: Some(GradientAt::Middles),
        answers: vec![Quantity::OpticalDepth],
        adjoint: Some(InnerProduct::Plain),
        stochastic: true,
        ..Declaration::new("inside")
    };
    let fault = Fault::Nothing;
    let error = adjoint(&mut Inside { declaration, fault }).unwrap_err();
    assert_eq!(error, AdjointError::Stochastic);
}
