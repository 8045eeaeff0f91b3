//! The parts of an error beside the same parts with very many bits, every exponential MPFR's own and every sum in the method's
//! order: no bound, no series, nothing shared between rules.

use rug::Float;
use std::borrow::Cow;
use volver::case::manufacture::manufacture;
use volver::case::{AnyNodes, Recorded, Shared, SymbolicCase, catalogue};
use volver::convergence::{Cell, Oracle, Split};
use volver::method::{Level, Method};
use volver::real::{Format, FormatName, Mpfr, MpfrReal, Real, WithFormat};
use volver::reference;

const BITS: u32 = 1000;

const METHODS: [&str; 16] = [
    "riemann-left/riemann-left",
    "riemann-right/simpson",
    "midpoint/boole",
    "trapezoid/riemann-left",
    "trapezoid/trapezoid",
    "simpson/simpson",
    "simpson/midpoint",
    "simpson-pairs-parabola/trapezoid",
    "boole/boole",
    "boole/riemann-right",
    "gauss-3/gauss-2",
    "trapezoid/trapezoid/exact-per-segment",
    "simpson/simpson/quadratic",
    "front-to-back/middle/expm1",
    "preintegrated/linear/linear",
    "layers/linear",
];

/// The total, discretization, input, arithmetic, and what of that comes of depths.
type Parts = [Option<Float>; 5];

struct Both<'a> {
    case: &'a SymbolicCase,
    methods: &'a [Method],
    n: u64,
}

impl WithFormat for Both<'_> {
    /// Of each method that knows the case.
    type Output = Vec<(Method, Cell, Parts)>;

    fn run<F: Format>(self, format: F) -> Self::Output {
        let Both { case, methods, n } = self;
        let nodes = Shared::new(case, format);
        let oracle = Oracle::new(case, methods);
        let cells = oracle.split(&nodes, n).unwrap();
        let radiance = reference::radiance(case, BITS).unwrap().value;
        let wide = Shared::new(case, Mpfr { bits: BITS });
        let of = |(method, cell): (&Method, Result<Cell, _>)| {
            let cell = cell.ok()?;
            let recorded = Recorded::new(AnyNodes::new(&nodes));
            let mut ran = Level::new(&recorded, n);
            let here = ran.radiance(method).unwrap().to_float();
            let recording = recorded.recording();
            let rows: Vec<Vec<Float>> = ran
                .transmittances(method)
                .unwrap()
                .iter()
                .map(|row| row.iter().map(Real::to_float).collect())
                .collect();
            let replayed = recording.replay(BITS);
            let mut again = Level::new(&replayed, n);
            let number = |x: &Float| MpfrReal::from(Float::with_val(BITS, x));
            let on_inputs = again.radiance(method).unwrap().to_float();
            let under: Vec<Cow<'_, [MpfrReal]>> = rows
                .iter()
                .map(|row| row.iter().map(number).collect())
                .collect();
            let under = (!rows.is_empty())
                .then(|| again.radiance_under(method, &under).unwrap().to_float());
            let limit = Level::new(&wide, n).radiance(method).unwrap().to_float();
            let less = |a: &Float, b: &Float| Float::with_val(BITS, a - b);
            let parts = [
                Some(less(&here, &radiance)),
                Some(less(&limit, &radiance)),
                Some(less(&on_inputs, &limit)),
                Some(less(&here, &on_inputs)),
                under.map(|under| less(&under, &on_inputs)),
            ];
            Some((*method, cell, parts))
        };
        methods.iter().zip(cells).filter_map(of).collect()
    }
}

/// Twenty bits of it are right, or both lie below what the oracle says that it cannot see.
fn agrees(part: &Float, exact: &Float, resolution: &Float) -> bool {
    let difference = Float::with_val(BITS, part - exact).abs();
    difference <= Float::with_val(BITS, exact.abs_ref()) >> 20_u32
        || (*part.as_abs() <= *resolution && *exact.as_abs() <= *resolution)
}

/// Of every case of the catalogue without jumps: shallow, faint, of narrow layers, deeper than 100, with emission of both signs.
#[test]
fn the_parts_are_those_of_many_bits() {
    let methods: Vec<Method> = METHODS.iter().map(|name| name.parse().unwrap()).collect();
    let formats: [FormatName; 4] =
        ["f16", "f64", "ieee:17,-126,127", "mpfr:200"].map(|name| name.parse().unwrap());
    let (mut compared, mut hidden, mut other) = (0, 0, 0);
    for (index, case_name) in catalogue::names().enumerate() {
        let description = catalogue::find(case_name).unwrap().unwrap();
        let case = manufacture(&description).unwrap().remove(0).case;
        // One format and one n for each case: all of them meet over the catalogue.
        let (format, n) = (formats[index % formats.len()], [8, 52, 24][index % 3]);
        let both = Both {
            case: &case,
            methods: &methods,
            n,
        };
        for (method, cell, exact) in format.with(both) {
            let Cell::Split(split) = cell else {
                other += 1;
                continue;
            };
            let Split {
                total,
                discretization,
                input,
                arithmetic,
                of_depth,
                resolution,
                bits,
                ..
            } = &split;
            // The run is that of the format, to the last bit.
            let exactly = exact[0].as_ref().unwrap();
            let off = Float::with_val(BITS, total - exactly).abs();
            assert!(
                off <= *resolution,
                "{method} on {case_name} in {format}: {off:e}"
            );
            let found = [
                Some(total),
                Some(discretization),
                Some(input),
                Some(arithmetic),
                of_depth.as_ref(),
            ];
            for (part, exact) in found.into_iter().zip(&exact) {
                let (Some(part), Some(exact)) = (part, exact) else {
                    assert_eq!(part.is_some(), exact.is_some());
                    continue;
                };
                assert!(
                    agrees(part, exact, resolution),
                    "{method} on {case_name} in {format}, {bits} bits: {part:e} instead of {:e}, resolution {resolution:e}",
                    Float::with_val(64, exact),
                );
                hidden += u32::from(*exact.as_abs() <= *resolution);
                compared += 1;
            }
        }
    }
    println!("{compared} parts, {hidden} of them hidden, {other} cells not split");
    assert!(
        compared > 2000 && hidden < compared / 4,
        "{compared}, {hidden}"
    );
}
