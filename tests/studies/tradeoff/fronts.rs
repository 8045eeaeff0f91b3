//! Fronts, goals, and what takes no part in them.

use rug::Float;
use rug::float::Special;
use volver::case::catalogue::find;
use volver::case::manufacture::manufacture;
use volver::real::FormatName;
use volver::real::counted::{Counts, Kind};
use volver::study::Silent;
use volver::study::sweep::{Errors, Sweep};
use volver::study::tradeoff::{
    Cost, Outcome, Point, Settings, Timing, USUAL_METHOD, Unit, cheapest, front, run,
};

fn float(x: f64) -> Float {
    Float::with_val(64, x)
}

#[test]
fn the_front_holds_what_nothing_beats() {
    let points = [
        Some((1.0, float(0.5))),
        Some((2.0, float(0.5))),
        Some((2.0, float(0.1))),
        Some((3.0, float(0.2))),
        Some((4.0, float(0.0))),
        Some((9.0, float(0.0))),
        None,
        Some((f64::NAN, float(0.0))),
        Some((0.5, Float::with_val(64, Special::Nan))),
        Some((1.0, float(0.5))),
    ];
    assert_eq!(front(&points), [0, 2, 4]);
    assert!(front(&[]).is_empty());
    assert!(front(&[None]).is_empty());
}

#[test]
fn a_front_is_the_same_as_by_definition() {
    let property = |points: Vec<(u8, u8)>| {
        let places: Vec<_> = points
            .iter()
            .map(|(cost, error)| Some((f64::from(*cost), float(f64::from(*error)))))
            .collect();
        let found = front(&places);
        let beaten = |(cost, error): &(u8, u8)| {
            let better = |(c, e): &(u8, u8)| c <= cost && e <= error && (c, e) != (cost, error);
            points.iter().any(better)
        };
        let mut on: Vec<(u8, u8)> = points.iter().filter(|p| !beaten(p)).copied().collect();
        on.sort_unstable();
        on.dedup();
        found.iter().map(|i| points[*i]).eq(on)
    };
    quickcheck::quickcheck(property as fn(Vec<(u8, u8)>) -> bool);
}

fn point(method: &str, n: u64, outcome: Outcome) -> Point {
    Point {
        method: method.parse().unwrap(),
        n,
        outcome,
        counts: Counts::of(Kind::Transfer, n),
        modelled: None,
        measured: None,
        only_usual: false,
    }
}

/// A little below x, which binary64 may have rounded up.
fn error(x: f64) -> Outcome {
    let error = float(0.99 * x);
    Outcome::Error { error }
}

fn unit(format: FormatName, bits: u32, points: Vec<Point>) -> Unit {
    Unit {
        case: "case".into(),
        format,
        bits,
        radiance: float(1.0),
        unproved: Vec::new(),
        points,
        calibration: None,
    }
}

#[test]
fn the_cheapest_way_and_the_usual_one() {
    let unseen = Point {
        only_usual: true,
        ..point("trapezoid/trapezoid", 1, Outcome::Exact)
    };
    let single = unit(
        FormatName::F32,
        24,
        vec![
            point(USUAL_METHOD, 64, error(1e-2)),
            point(USUAL_METHOD, 512, error(1e-3)),
            point("trapezoid/trapezoid", 4, Outcome::NotFinite),
            point("trapezoid/trapezoid", 8, error(1e-4)),
            unseen,
        ],
    );
    let double = unit(
        FormatName::F64,
        53,
        vec![
            point("trapezoid/trapezoid", 8, error(1e-5)),
            point("simpson/simpson", 100, Outcome::Exact),
            // Binary64 is not what is usual.
            point(USUAL_METHOD, 2000, error(1e-8)),
        ],
    );
    let units = [&double, &single];
    let goals = cheapest(&units, Cost::Evaluations);
    assert_eq!(goals.len(), 29);
    let at = |digits: u32| {
        let goal = goals.iter().find(|goal| goal.digits == digits).unwrap();
        let name = |found: Option<(&Unit, &Point)>| found.map(|(u, p)| (u.bits, p.n));
        (name(goal.best), name(goal.usual))
    };
    // Of equal costs the one of fewer bits.
    assert_eq!(at(2), (Some((24, 8)), Some((24, 64))));
    assert_eq!(at(3), (Some((24, 8)), Some((24, 512))));
    assert_eq!(at(5), (Some((53, 8)), None));
    assert_eq!(at(6), (Some((53, 100)), None));
    assert_eq!(at(30), (Some((53, 100)), None));
    // Without times there is nothing to compare by time.
    assert!(
        cheapest(&units, Cost::Measured)
            .iter()
            .all(|g| g.best.is_none())
    );
}

#[test]
fn what_has_no_logarithm_is_named() {
    assert_eq!(Outcome::Exact.log10(), None);
    assert_eq!(Outcome::Exact.error().unwrap(), 0);
    assert_eq!(Outcome::NotFinite.error(), None);
    let tiny = Outcome::Error {
        error: Float::with_val(64, 1) >> 10_000_u32,
    };
    assert!((tiny.log10().unwrap() + 3010.3).abs() < 0.01);
}

#[test]
fn a_timing_is_a_median_with_its_spread() {
    let timing = Timing::of(vec![9.0, 1.0, 2.0, f64::NAN, 3.0, 100.0]).unwrap();
    assert_eq!(
        (timing.median, timing.spread, timing.repeats),
        (3.0, 3.5, 5)
    );
    assert_eq!(Timing::of(vec![]), None);
}

#[test]
fn errors_are_exact_and_the_usual_choice_runs_beside() {
    let case = |name: &str| {
        let made = manufacture(&find(name).unwrap().unwrap())
            .unwrap()
            .remove(0);
        (name.to_string(), made.case)
    };
    let settings = Settings {
        sweep: Sweep {
            cases: vec![case("homogeneous"), case("vacuum")],
            methods: vec![
                "front-to-back/middle/expm1".parse().unwrap(),
                "simpson/boole".parse().unwrap(),
            ],
            formats: vec![FormatName::F64, FormatName::Mpfr(160)],
            levels: vec![1, 4],
            errors: Errors::default(),
        },
        timed: false,
    };
    let mut heard = 0;
    let units = run(&settings, &Silent, |_| {
        heard += 1;
        Ok(())
    })
    .unwrap();
    assert_eq!((units.len(), heard), (6, 6));
    let [double, many, single, ..] = &units[..] else {
        panic!("{units:?}");
    };
    assert_eq!(single.format, FormatName::F32);
    assert!(
        single
            .points
            .iter()
            .all(|p| p.only_usual && p.method.name() == USUAL_METHOD)
    );
    // Boole's rule needs groups of four.
    assert_eq!(double.points[2].outcome.name(), "refused");
    // Opacities are exact on a homogeneous slab: rounding alone is left.
    let log = |point: &Point| point.outcome.log10().unwrap();
    assert!(
        (-17.0..-14.0).contains(&log(&double.points[1])),
        "{:?}",
        double.points[1]
    );
    assert!(
        (-50.0..-46.0).contains(&log(&many.points[1])),
        "{:?}",
        many.points[1]
    );
    assert_eq!(many.points[1].counts, double.points[1].counts);
    // Nothing shines in a vacuum.
    assert!(
        units[3].points[..2]
            .iter()
            .all(|p| p.outcome == Outcome::Exact)
    );
}
