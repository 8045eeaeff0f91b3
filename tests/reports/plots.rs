//! Plots of what was measured: tables of orders, samples with their fit, cases along their ray.

use crate::entries::{entry, replicated};
use rug::Float;
use rug::float::Special;
use std::f64::consts::{LN_10, LOG10_2};
use volver::case::manufacture::manufacture;
use volver::case::{Description, catalogue};
use volver::convergence::{Sample, Verdict, fit};
use volver::document::{Plot, Scale, Series, Stroke, Trace};
use volver::report::groups;
use volver::report::plots::{of_case, of_convergence};
use volver::report::reproduce::of_table;
use volver::study::reproduce::Entry;

fn traces(series: &Series, stroke: Stroke) -> Vec<&Trace> {
    series
        .traces
        .iter()
        .filter(|trace| trace.stroke == stroke)
        .collect()
}

/// How many decades a thin line falls in a decade.
fn slope(series: &Series) -> f64 {
    let [line] = traces(series, Stroke::Thin)[..] else {
        panic!("one thin line: {series:?}");
    };
    let (from, to) = (line.points[0], line.points[1]);
    (from.1 - to.1) / (to.0 - from.0)
}

fn series(entry: &Entry) -> Series {
    let entries = [entry.clone()];
    of_table(&groups(&entries)[0])[0].series[0].clone()
}

#[test]
fn a_plot_a_row_and_a_color_a_column() {
    let entries = [
        entry("simpson", "trapezoid"),
        entry("simpson", "boole"),
        entry("gauss-3", "boole"),
        replicated("monte-carlo", "boole"),
    ];
    let plots = of_table(&groups(&entries)[0]);
    let titles: Vec<&str> = plots.iter().map(|plot| &plot.title[..]).collect();
    let replicas = "inner: monte-carlo (64 replicas, f64)";
    assert_eq!(titles, ["inner: simpson", "inner: gauss-3", replicas]);
    assert_eq!(plots[1].series[0].color, Some(1));
    assert_eq!(plots[2].y.title, "standard deviation of error");
}

#[test]
fn marks_are_logarithms_with_sign_and_window() {
    let mut measured = entry("simpson", "boole");
    measured.levels[1].error = -measured.levels[1].error.clone();
    measured.levels[2].error = Float::new(53);
    measured.levels[3].error = Float::with_val(53, Special::Nan);
    measured.levels[4].error = Float::with_val(53, 1) >> 10_000_u32;
    let series = series(&measured);
    let first = &series.points[0];
    assert!((first.x - 8_f64.log10()).abs() < 1e-12);
    assert!((first.y - -12.0 * LOG10_2).abs() < 1e-12);
    assert!(!first.negative && !first.filled);
    assert_eq!(first.label, "n = 8\n|error| = 2.44e-4");
    let second = &series.points[1];
    assert!(second.negative && second.filled);
    assert!(
        second.label.ends_with(", below 0\nin the fit"),
        "{}",
        second.label
    );
    assert!(series.points[2].y.is_nan() && series.points[3].y.is_nan());
    assert!((series.points[4].y + 3010.3).abs() < 0.01);
}

#[test]
fn numbers_of_any_magnitude_have_three_digits() {
    let mut measured = entry("simpson", "boole");
    for (level, text) in measured
        .levels
        .iter_mut()
        .zip(["1e-400", "5.012e-5001", "99.99999"])
    {
        level.error = Float::with_val(64, Float::parse(text).unwrap());
    }
    let series = series(&measured);
    for (point, digits) in series
        .points
        .iter()
        .zip(["1.00e-400", "5.01e-5001", "1.00e2"])
    {
        assert!(
            point.label.contains(&format!(" = {digits}")),
            "{}",
            point.label
        );
    }
}

#[test]
fn each_order_has_a_line_and_stands_in_the_legend() {
    let mut entries = [entry("simpson", "simpson"), entry("simpson", "trapezoid")];
    entries[1].asymptotic_order = Some(1.0);
    for (level, k) in entries[1].levels.iter_mut().zip(3_i32..) {
        level.error = Float::with_val(53, -k).exp2();
    }
    let plot = &of_table(&groups(&entries)[0])[0];
    for (series, (name, order)) in plot
        .series
        .iter()
        .zip([("simpson 4.00", 4.0), ("trapezoid 1.00", 1.0)])
    {
        assert_eq!(series.name, name);
        assert!((slope(series) - order).abs() < 1e-12);
        // Through the errors, which are of that order from end to end.
        let line = &traces(series, Stroke::Thin)[0].points;
        for (at, end) in line.iter().zip([&series.points[0], &series.points[5]]) {
            assert!(
                (at.0 - end.x).abs() < 1e-12 && (at.1 - end.y).abs() < 1e-9,
                "{line:?}"
            );
        }
    }
}

#[test]
fn a_stalled_bias_is_not_the_slope_of_the_deviation() {
    let mut stalled = replicated("monte-carlo", "boole");
    let before = series(&stalled);
    assert!((slope(&before) - 0.5).abs() < 1e-12);
    assert_eq!(traces(&before, Stroke::Dashed)[0].points.len(), 6);
    stalled.verdict = Verdict::Stalled;
    stalled.asymptotic_order = Some(-0.2);
    let series = series(&stalled);
    assert!(traces(&series, Stroke::Thin).is_empty());
    assert_eq!(series.name, "boole Stalled");
}

#[test]
fn legends_say_what_cannot_be_drawn() {
    for (order, verdict, name) in [
        (Some(4.0), Verdict::Confirmed, "boole 4.00"),
        (None, Verdict::Exact, "boole Exact"),
        (None, Verdict::NotFinite, "boole not finite"),
        (Some(2.5), Verdict::TooLow, "boole 2.50 TooLow"),
    ] {
        let measured = Entry {
            asymptotic_order: order,
            verdict,
            ..entry("simpson", "boole")
        };
        assert_eq!(series(&measured).name, name);
    }
}

#[test]
fn steps_that_do_not_divide_the_ray_stand_by_themselves() {
    let samples: Vec<Sample> = (0..5)
        .map(|i| Sample {
            n: None,
            step: 0.5 / f64::from(1 << i),
            error: Float::with_val(53, 0.25) >> (2 * i),
            floor: Float::new(53),
        })
        .collect();
    let plot = of_convergence(&samples, &fit(&samples, None).unwrap(), "steps");
    assert_eq!(plot.x.title, "1/d, finer to the right");
    let points = &plot.series[0].points;
    for (point, octave) in points.iter().zip(1..) {
        assert!((point.x - f64::from(octave) * LOG10_2).abs() < 1e-12);
        assert!(point.filled);
    }
    assert!(
        points[0].label.starts_with("d = 5.00e-1\n"),
        "{}",
        points[0].label
    );
}

fn case(text: &str) -> Vec<Plot> {
    of_case(&manufacture(&Description::read(text).unwrap()).unwrap())
}

/// Runs of the only line of a series.
fn runs(series: &Series) -> Vec<Vec<(f64, f64)>> {
    let runs = series.traces[0].points.split(|point| point.1.is_nan());
    runs.filter(|run| !run.is_empty())
        .map(<[_]>::to_vec)
        .collect()
}

#[test]
fn both_sides_of_a_jump_are_right() {
    let plots = case(catalogue::text("jump-off-node").unwrap());
    // A constant needs two points.
    let [before, after] = &runs(&plots[2].series[0])[..] else {
        panic!("two pieces");
    };
    assert_eq!([before[0], after[1]], [(0.0, 1.0), (1.0, 3.0)]);
    assert_eq!([before[1].1, after[0].1], [1.0, 3.0]);
    assert_eq!(before[1].0, after[0].0);
    let guides = &plots[2].guides;
    assert!(guides.len() == 1 && guides[0].upright && (guides[0].at - 1.0 / 3.0).abs() < 1e-12);
}

#[test]
fn what_channels_share_is_drawn_once() {
    let plots = case(catalogue::text("rgb-transfer").unwrap());
    let counts: Vec<usize> = plots.iter().map(|plot| plot.series.len()).collect();
    assert_eq!(counts, [1, 3, 1, 1, 3]);
    let names: Vec<&str> = plots[4]
        .series
        .iter()
        .map(|series| &series.name[..])
        .collect();
    assert_eq!(names, ["red", "green", "blue"]);
    assert_eq!(plots[4].title, "radiance I of the ray up to λ");
}

#[test]
fn thick_rays_have_logarithms() {
    let plot = &case(catalogue::text("thick").unwrap())[3];
    assert_eq!(plot.y.scale, Scale::Log);
    // e⁻⁵⁰ = 1.92874…e-22.
    assert_eq!(
        plot.title,
        "transmittance T = exp(−t), logarithmic; T(D) = 1.9287e-22"
    );
    let last = *runs(&plot.series[0])[0].last().unwrap();
    assert!((last.1 + 50.0 / LN_10).abs() < 1e-12);
}

#[test]
fn values_at_the_far_end_are_written_short() {
    let plots = case(catalogue::text("sine-squared").unwrap());
    assert!(
        plots[4].title.ends_with("; I(D) = 0.13439"),
        "{}",
        plots[4].title
    );
    let plots = case(catalogue::text("vacuum").unwrap());
    assert!(
        plots[3].title.ends_with("; T(D) = 1.0000"),
        "{}",
        plots[3].title
    );
    assert!(plots[4].title.ends_with("; I(D) = 0"), "{}", plots[4].title);
}

#[test]
fn a_function_without_a_value_at_an_end_is_drawn_up_to_it() {
    // C = 2 lambda/sin lambda is 0/0 at 0.
    let plots =
        case("name = \"a\"\nlength = 1\ndepth = \"1 - cos(lambda)\"\nradiance = \"lambda^2\"");
    let start = runs(&plots[1].series[0])[0][0];
    assert!(start.0 > 0.0 && start.0 < 1e-6 && (start.1 - 2.0).abs() < 1e-6);
}

#[test]
fn lines_keep_their_shape_in_few_points() {
    // s = lambda is straight; C and T are not.
    let plots = case("name = \"a\"\nlength = 2\ndepth = \"lambda^2\"\nradiance = \"lambda^3\"");
    for plot in &plots {
        for run in runs(&plot.series[0]) {
            assert!(run.len() < 120, "{}: {}", plot.title, run.len());
            assert!(run.windows(2).all(|pair| pair[0].0 < pair[1].0));
        }
    }
    // Chords of T = exp(−λ²) stay within a thousandth of it.
    let line = &runs(&plots[3].series[0])[0];
    for pair in line.windows(2) {
        let middle = f64::midpoint(pair[0].0, pair[1].0);
        let chord = f64::midpoint(pair[0].1, pair[1].1);
        assert!((chord - (-middle * middle).exp()).abs() < 1e-3);
    }
}
