//! Orders fitted to the total error of runs in formats of few bits: floor-limited, or what MPFR shows too, and
//! never wrongly confirmed.

use volver::case::manufacture::manufacture;
use volver::case::{SymbolicCase, catalogue};
use volver::convergence::Verdict;
use volver::method::Method;
use volver::real::FormatName;
use volver::study::Silent;
use volver::study::sweep::{Errors, Header, Journal, Sweep, Theory, run, summarize};

const CASES: [&str; 14] = [
    "sine-squared",
    "reciprocal",
    "reciprocal-square",
    "homogeneous",
    "linear-transfer",
    "atmosphere",
    "tangent",
    "emission-cubic",
    "oscillating-field",
    "thick-front",
    "faint",
    "kink-off-node",
    "jump-on-node",
    "tent",
];
const METHODS: [&str; 7] = [
    "riemann-left/riemann-right",
    "trapezoid/trapezoid",
    "simpson/simpson",
    "midpoint/gauss-2",
    "trapezoid/trapezoid/linear",
    "front-to-back/front/subtraction",
    "front-to-back/middle/expm1/neumaier",
];

fn case(name: &str) -> SymbolicCase {
    let description = catalogue::find(name).unwrap().unwrap();
    manufacture(&description).unwrap().remove(0).case
}

#[test]
fn few_bits_never_confirm_a_wrong_order() {
    let sweep = Sweep {
        cases: CASES
            .iter()
            .map(|&name| (name.to_owned(), case(name)))
            .collect(),
        methods: METHODS
            .iter()
            .map(|name| name.parse::<Method>().unwrap())
            .collect(),
        formats: ["f16", "bf16"]
            .map(|name| name.parse::<FormatName>().unwrap())
            .into(),
        levels: (2..=9).map(|k| 1 << k).collect(),
        errors: Errors::Split,
    };
    let directory = tempfile::tempdir().unwrap();
    let header = Header::new(&sweep);
    let mut journal = Journal::begin(&directory.path().join("study.jsonl"), &header).unwrap();
    run(&sweep, &mut journal, 2, &Silent).unwrap();
    let (mut confirmed, mut limited, mut others) = (0, 0, 0);
    for unit in journal.ordered(&header) {
        for row in &unit.rows {
            let what = format!("{} on {} in {}", row.method, unit.case, unit.format);
            let summary = summarize(unit, row, 1.0, Errors::Split).unwrap();
            let split = summary.split.as_ref().unwrap();
            let (total, limit) = (&summary.total, &split.discretization);
            match total.verdict {
                Verdict::Confirmed | Verdict::TooLow | Verdict::TooHigh => {
                    // An interval that says something has to hold what the method does without roundoff: the
                    // order fitted there, or where that is still on its way the order of theory.
                    let (order, half_width) = (total.order.unwrap(), total.half_width.unwrap());
                    let within = |p: f64| (p - order).abs() <= half_width;
                    let theory = matches!(row.expected, Theory::Order(p) if within(p));
                    let measured = limit.order.is_some_and(|p| {
                        (p - order).abs() <= half_width + limit.half_width.unwrap_or(0.0)
                    });
                    assert!(theory || measured, "{what}: {total:?} but {limit:?}");
                    if total.verdict == Verdict::Confirmed {
                        assert!(theory, "{what}: {total:?}");
                        confirmed += 1;
                    } else {
                        others += 1;
                    }
                }
                Verdict::FloorLimited => limited += 1,
                _ => others += 1,
            }
        }
    }
    println!("{confirmed} confirmed, {limited} floor-limited, {others} others");
    // Neither is an accident.
    assert!(
        limited > 60 && confirmed + limited > 100,
        "{confirmed}, {limited}, {others}"
    );
}
