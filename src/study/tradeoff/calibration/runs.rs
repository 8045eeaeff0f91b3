//! Runs of whole methods to calibrate by.

use super::Piece;
use crate::case::{CountedCase, Formulas, Fresh, PolynomialTransfer, Structure, SymbolicCase};
use crate::method::Method;
use crate::real::counted::{Counted, count};
use crate::real::{Format, Mpfr};
use rug::Rational;
use std::hint::black_box;

/// Some of each family.
const METHODS: [&str; 18] = [
    "riemann-left/riemann-left",
    "trapezoid/trapezoid",
    "simpson/simpson",
    "boole/boole",
    "midpoint/midpoint",
    "gauss-2/gauss-2",
    "gauss-4/gauss-4",
    "riemann-left/boole",
    "trapezoid/trapezoid/cubic",
    "monte-carlo-stratified@1/trapezoid",
    "front-to-back/front/subtraction",
    "front-to-back/middle/expm1",
    "front-to-back/middle/relative",
    "back-to-front/middle/expm1",
    "tree/middle/expm1",
    "front-to-back/middle/expm1/depths/neumaier",
    "preintegrated/linear/linear",
    "preintegrated/linear-by-4-trapezoid/linear-by-4-trapezoid",
];

/// s, τ and C: polynomials, which have closed forms; and media of one function each. None is of the catalogue.
const MEDIA: [[&str; 3]; 5] = [
    ["lambda", "1/2 + s", "1/3 + s^2"],
    ["lambda^2 + 1/4", "exp(-s)", "1/(1 + s^2)"],
    ["sin(3*lambda)", "2 + cos(2*s)", "sin(s)^2/2"],
    ["1/(2 + lambda)", "1 + tanh(s)", "sqrt(1 + s)*ln(2 + s)"],
    ["lambda", "cos(s)*s", "sin(s + 1/7)"],
];

/// From where a run's own time is most of it to where nothing but segments counts.
const SEGMENTS: [u64; 4] = [1, 4, 16, 64];

/// The runs; a method that does not suit a medium is left out.
pub(super) fn pieces<F: Format>(format: F) -> Vec<Piece> {
    all_pieces(format.bits(), &|medium, method, n| {
        Box::new(move || {
            let nodes = Fresh::new(&medium, format);
            let _ = black_box(black_box(&method).radiance(&nodes, n));
        })
    })
}

/// The work of a method on n segments of a medium.
type Work<'w> = &'w dyn Fn(SymbolicCase, Method, u64) -> Box<dyn FnMut()>;

fn all_pieces(bits: u32, work: Work<'_>) -> Vec<Piece> {
    let methods: Vec<Method> = METHODS
        .iter()
        .filter_map(|name| name.parse().ok())
        .collect();
    let mut pieces = Vec::new();
    for (m, formulas) in MEDIA.iter().enumerate() {
        let Some(medium) = medium(*formulas, m == 0) else {
            continue;
        };
        for (index, method) in methods.iter().enumerate() {
            // Each method at all of them, on different media.
            let n = SEGMENTS[(index + m) % SEGMENTS.len()];
            pieces.extend(piece(bits, &medium, *method, n, work));
        }
    }
    pieces
}

fn piece(
    bits: u32,
    medium: &SymbolicCase,
    method: Method,
    n: u64,
    work: Work<'_>,
) -> Option<Piece> {
    let case = CountedCase(medium);
    // What a method does depends on the number of bits alone, and is compiled once for all formats so.
    let nodes = Fresh::new(&case, Counted(Mpfr { bits }));
    let (radiance, counts) = count(|| method.radiance(&nodes, n));
    radiance.ok()?;
    Some(Piece {
        counts,
        work: work(medium.clone(), method, n),
    })
}

/// A medium on a ray of length 1; `polynomial`: the first of [`MEDIA`].
fn medium([field, extinction, emission]: [&str; 3], polynomial: bool) -> Option<SymbolicCase> {
    let formulas = Formulas {
        field: field.parse().ok()?,
        extinction: extinction.parse().ok()?,
        emission: emission.parse().ok()?,
        optical_depth: None,
        radiance: None,
    };
    // (1/3 + s²)(1/2 + s)
    let transfer = || PolynomialTransfer {
        extinction: vec![Rational::from((1, 2)), Rational::from(1)],
        source: [(1, 6), (1, 3), (1, 2), (1, 1)]
            .map(Rational::from)
            .to_vec(),
    };
    let structure = Structure {
        field_degree: polynomial.then_some(1),
        transfer: polynomial.then(transfer),
        ..Structure::default()
    };
    SymbolicCase::new("calibration", Rational::from(1), formulas, structure).ok()
}
