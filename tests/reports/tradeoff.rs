//! A comparison of costs in every form: what has no place on a logarithmic axis is named, and names are safe.

use crate::fixture::{figures, tables};
use rug::Float;
use volver::document::{About, Document, Plot};
use volver::real::FormatName;
use volver::real::counted::{Counts, Kind};
use volver::render::{csv, html, latex, markdown, terminal};
use volver::report::tradeoff;
use volver::study::sweep::{Errors, Header};
use volver::study::tradeoff::{Cost, Outcome, Point, Results, Timing, Unit};

const LEFT: &str = "front-to-back/front/subtraction";

fn point(method: &str, n: u64, outcome: Outcome) -> Point {
    let timing = Timing {
        median: 100.0 * n as f64,
        spread: 3.0,
        repeats: 5,
    };
    Point {
        method: method.parse().unwrap(),
        n,
        outcome,
        counts: Counts::of(Kind::Transfer, n),
        modelled: Some(130.0 * n as f64),
        measured: Some(timing),
        only_usual: false,
    }
}

fn unit(case: &str, points: Vec<Point>) -> Unit {
    Unit {
        case: case.into(),
        format: FormatName::F32,
        bits: 24,
        radiance: Float::with_val(64, 2),
        unproved: Vec::new(),
        points,
        calibration: None,
    }
}

fn results(units: Vec<Unit>) -> Results {
    let cases = units.iter().map(|unit| unit.case.as_str());
    let header = Header {
        volver: "0".into(),
        cases: cases
            .map(|case| [case, "1", "lambda", "s", "s"].map(String::from))
            .collect(),
        methods: vec![LEFT.into()],
        formats: vec!["f32".into()],
        levels: (1..=units[0].points.len() as u64).collect(),
        errors: Errors::default(),
    };
    Results::new(header, Cost::Modelled, Some(false), units)
}

/// The usual choice alone, at n = 1, 2, …
fn usual(case: &str, outcomes: &[Outcome]) -> Results {
    let points = (1..).zip(outcomes);
    let points = points.map(|(n, outcome)| point(LEFT, n, outcome.clone()));
    results(vec![unit(case, points.collect())])
}

/// 2^(−bits).
fn error(bits: u32) -> Outcome {
    Outcome::Error {
        error: Float::with_val(64, 1) >> bits,
    }
}

fn all_states() -> Vec<Outcome> {
    let reason = "n = 4 is odd".into();
    vec![
        error(4),
        Outcome::NotFinite,
        Outcome::Exact,
        Outcome::Refused { reason },
        error(4000),
    ]
}

fn document(results: &Results) -> Document {
    tradeoff::document(results, &About::new(["volver"]))
}

fn plots(document: &Document) -> Vec<Plot> {
    let figures = figures(document).into_iter();
    figures.flat_map(|figure| figure.plots).collect()
}

#[test]
fn what_has_no_logarithm_is_named() {
    let document = document(&usual("a_b & <c>", &all_states()));
    let text = terminal(&document, 80, false);
    assert!(
        text.contains("5 runs: 2 with an error, 1 exact, 1 not finite, 1 refused."),
        "{text}"
    );
    let plot = &plots(&document)[0];
    assert_eq!(
        plot.guides[0].label,
        "not drawn: 1 exact, 1 not finite, 1 refused"
    );
    assert_eq!(plot.title, "a_b & <c>: error against modelled time, ns");
    assert_eq!(
        (&plot.x.title[..], &plot.y.title[..]),
        ("modelled time, ns", "|error| / |I|")
    );
    let points: Vec<(f64, f64)> = plot
        .series
        .iter()
        .flat_map(|series| series.points.iter().map(|point| (point.x, point.y)))
        .collect();
    // 2⁻⁴ at 130 ns and 2⁻⁴⁰⁰⁰ at 650 ns; the first is on the front too.
    let log = |x: f64, bits: f64| (x.log10(), -bits * 2_f64.log10());
    let wanted = [log(130.0, 4.0), log(650.0, 4000.0), log(130.0, 4.0)];
    assert_eq!(points.len(), wanted.len());
    for ((x, y), (wanted_x, wanted_y)) in points.into_iter().zip(wanted) {
        assert!(
            (x - wanted_x).abs() < 1e-9 && (y - wanted_y).abs() < 1e-9,
            "{x} {y}"
        );
    }
    let page = html::render(&document).unwrap();
    assert!(page.contains("a_b &amp; &lt;c&gt;: error against") && !page.contains("NaN"));
    let [_, front, _] = &tables(&document)[..] else {
        panic!("goals, front, standings");
    };
    let errors: Vec<&str> = front.rows.iter().map(|row| &row[5].text[..]).collect();
    assert_eq!(errors, ["6.2e-2", "exact"]);
    assert_eq!(figures(&document)[0].file, "tradeoff-a-b-c");
}

#[test]
fn a_case_with_nothing_to_draw_says_so() {
    let document = document(&usual("still", &[Outcome::Exact, Outcome::NotFinite]));
    let page = html::render(&document).unwrap();
    let (_, drawn) = page.split_once("Nothing to draw").unwrap();
    assert!(drawn.starts_with(&format!(
        ": 1  {LEFT}, f32, n 1, exact; not drawn: 1 exact, 1 not finite<"
    )));
}

#[test]
fn a_plot_has_formats_families_the_front_numbered_and_what_is_usual() {
    let points = vec![
        point(LEFT, 1, error(2)),
        point(LEFT, 4, error(4)),
        point("gauss-4/gauss-4", 2, error(20)),
        point("gauss-4/gauss-4", 3, error(30)),
        point("simpson/boole", 4, error(25)),
        point("preintegrated/linear/linear", 5, error(3)),
        point("monte-carlo@1/boole", 6, error(3)),
    ];
    let mut wide = unit("c", vec![point("gauss-4/gauss-4", 8, error(60))]);
    wide.format = FormatName::F64;
    wide.bits = 53;
    let plot = plots(&document(&results(vec![unit("c", points), wide]))).remove(0);
    let names: Vec<&str> = plot.series.iter().map(|s| &s.name[..]).collect();
    let left = format!("1  {LEFT}, f32, n 1");
    assert_eq!(
        names,
        [
            "f32, compositing",
            "f32, Gauss",
            "f32, Newton–Cotes",
            "f32, pre-integration",
            "f32, random depths",
            "f64, Gauss",
            "usual: left Riemann sums in f32",
            "Pareto front",
            &left,
            "2  gauss-4/gauss-4, f32, n 2 … 3",
            "3  gauss-4/gauss-4, f64, n 8",
        ]
    );
    // A format has a colour, a family a shape.
    let look = |index: usize| (plot.series[index].color, plot.series[index].shape);
    assert_eq!(look(1).1, look(5).1);
    assert_eq!(look(1), look(9));
    assert_eq!(look(5), look(10));
    assert_ne!(look(1).0, look(5).0);
    let mut shapes: Vec<_> = (0..5).map(|index| look(index).1).collect();
    shapes.sort_unstable();
    shapes.dedup();
    assert_eq!(shapes.len(), 5);
    // Lines through the usual runs and through the front, which is filled and numbered where a stretch begins.
    let traces: Vec<usize> = plot
        .series
        .iter()
        .flat_map(|s| &s.traces)
        .map(|t| t.points.len())
        .collect();
    assert_eq!(traces, [2, 4]);
    let filled = plot
        .series
        .iter()
        .flat_map(|s| &s.points)
        .filter(|p| p.filled);
    let tags: Vec<&str> = filled.map(|point| &point.tag[..]).collect();
    assert_eq!(tags, ["1", "2", "", "3"]);
    let label = &plot.series[9].points[1].label;
    assert_eq!(label, "gauss-4/gauss-4 in f32, n = 3: error 9.3e-10");
    let page = html::render(&document(&usual("c", &[error(4)]))).unwrap();
    assert!(page.contains("class=\"tag\""));
}

#[test]
fn every_form_has_the_cheapest_way_and_the_model() {
    let results = usual("a_b", &all_states());
    let document = document(&results);
    let text = terminal(&document, 80, false);
    let row = format!("\n1e-2 … 1e-30 {LEFT} f32    3     3 390 ns n 3, 390 ns\n");
    assert!(text.contains(&row), "{text}");
    // Modelled 1.3 times as long as measured, everywhere it ran.
    assert!(
        text.contains("within 1.5 times of measured: f32 100 % of 5, all 100 % of 5."),
        "{text}"
    );
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let latex = latex(&document);
    assert!(
        latex.contains(&format!(
            "\na\\_b & 1e-2 & {LEFT} & f32 & 3 & 3 & 390 ns & "
        )),
        "{latex}"
    );
    assert_eq!(latex.matches(LEFT).count(), 29, "{latex}");
    let markdown = markdown(&document);
    assert!(
        markdown.contains("](tradeoff-a-b.svg)") && markdown.contains("within 1.5 times"),
        "{markdown}"
    );
    let csv = &csv(&document).unwrap()[..];
    let [(name, csv)] = csv else {
        panic!("{} tables", csv.len());
    };
    assert_eq!((&name[..], csv.lines().count()), ("tradeoff", 6));
    assert!(csv.contains(",n = 4 is odd\n"), "{csv}");
}

#[test]
fn times_are_told_in_fitting_units() {
    for (nanoseconds, told) in [
        (0.42, "0.4 ns"),
        (99.6, "100 ns"),
        (999.6, "1.0 µs"),
        (12_345.0, "12 µs"),
        (2.5e10, "25 s"),
    ] {
        let mut results = usual("c", &[Outcome::Exact]);
        results.cases[0].units[0].points[0].modelled = Some(nanoseconds);
        let goals = &tables(&document(&results))[0];
        assert_eq!(goals.columns[6].title, "time");
        assert_eq!(goals.rows[0][6].text, told);
    }
}
