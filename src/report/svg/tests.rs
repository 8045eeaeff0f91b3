use super::*;
use crate::convergence::{Verdict, fit};
use crate::report::fixture::{entry, replicated};
use crate::report::groups;
use rug::Float;
use rug::float::Special;

/// |e| = 4⁻ᵏ at n = 2ᵏ, k = 3 … 8: order 2.
fn second_order(tiny: u32) -> Vec<Sample> {
    (3..=8)
        .map(|k| Sample {
            n: Some(1 << k),
            step: 1.0 / f64::from(1 << k),
            error: Float::with_val(64, 1) >> (2 * k + tiny),
            floor: Float::new(53),
        })
        .collect()
}

fn plot(samples: &[Sample]) -> String {
    convergence_plot(samples, &fit(samples, None).unwrap(), "a title").unwrap()
}

/// The number that an attribute of a line of SVG holds.
fn number(line: &str, attribute: &str) -> f64 {
    let from = line.split(&format!(" {attribute}=\"")).nth(1).unwrap();
    from.split('"').next().unwrap().parse().unwrap()
}

/// Centers of the marks inside the axes, in pixels.
fn marks(svg: &str) -> Vec<(f64, f64)> {
    svg.lines()
        .filter(|l| l.starts_with("<circle") && number(l, "r") == 46.0)
        .map(|l| (number(l, "cx") / 10.0, number(l, "cy") / 10.0))
        .filter(|(_, y)| (58.0..416.0).contains(y))
        .collect()
}

/// Closed paths of three corners: slope triangles.
fn triangles(svg: &str) -> Vec<Vec<(f64, f64)>> {
    svg.lines()
        .filter(|l| l.starts_with("<polyline"))
        .map(|l| {
            let points = l.split("points=\"").nth(1).unwrap();
            let points = points.split('"').next().unwrap();
            let point = |p: &str| {
                let (x, y) = p.split_once(',').unwrap();
                (x.parse::<f64>().unwrap(), y.parse::<f64>().unwrap())
            };
            points.split_whitespace().map(point).collect::<Vec<_>>()
        })
        .filter(|path| path.len() == 4 && path[0] == path[3])
        .collect()
}

#[test]
fn marks_stand_where_the_errors_are() {
    // Axes from x = 66 to 626 and y = 58 to 416, margins of 0.35 octaves and 0.3 decades.
    let found = marks(&plot(&second_order(0)));
    assert_eq!(found.len(), 6);
    let decades = 10.0 * 2_f64.log10();
    for (k, (x, y)) in found.into_iter().enumerate() {
        let k = k as f64;
        let at = (
            66.0 + 560.0 * (k + 0.35) / 5.7,
            58.0 + 358.0 * (k / 5.0 * decades + 0.3) / (decades + 0.6),
        );
        assert!((x - at.0).abs() <= 0.06, "{x} {at:?}");
        assert!((y - at.1).abs() <= 0.06, "{y} {at:?}");
    }
}

#[test]
fn errors_below_binary64_are_drawn_alike() {
    let (plain, tiny) = (plot(&second_order(0)), plot(&second_order(5000)));
    assert_eq!(marks(&plain).len(), 6);
    for (a, b) in marks(&plain).into_iter().zip(marks(&tiny)) {
        assert!((a.0 - b.0).abs() < 0.11 && (a.1 - b.1).abs() < 0.11);
    }
    assert!(tiny.contains("10⁻¹⁵⁰⁸"));
}

#[test]
fn the_triangle_is_as_steep_as_the_curve() {
    let svg = plot(&second_order(0));
    let marks = marks(&svg);
    let curve = (marks[5].1 - marks[0].1) / (marks[5].0 - marks[0].0);
    let found = triangles(&svg);
    assert_eq!(found.len(), 1);
    let [a, b, c] = found[0][..3] else {
        unreachable!()
    };
    assert!(((b.1 - a.1) / (b.0 - a.0) - curve).abs() < 0.01);
    assert!((c.0 - a.0) * (c.0 - b.0) == 0.0 && (c.1 - a.1) * (c.1 - b.1) == 0.0);
    assert!(svg.contains(">\n2.00\n</text>"));
}

#[test]
fn plots_are_the_same_bytes_again() {
    let entries = [
        entry("simpson", "boole"),
        replicated("monte-carlo", "boole"),
    ];
    let group = &groups(&entries)[0];
    let svg = table_plot(group).unwrap();
    assert_eq!(svg, table_plot(group).unwrap());
    assert!(svg.contains("inner: monte-carlo (64 replicas, f64)"));
    assert!(svg.contains("|bias|") && svg.contains("level in the fit"));
    assert!(!svg.contains("error below 0"));
}

#[test]
fn one_triangle_a_distinct_order() {
    let mut entries = [
        entry("simpson", "simpson"),
        entry("simpson", "boole"),
        entry("simpson", "trapezoid"),
    ];
    entries[1].asymptotic_order = Some(4.01);
    entries[2].asymptotic_order = Some(1.0);
    for (level, k) in entries[2].levels.iter_mut().zip(3_i32..) {
        level.error = Float::with_val(53, -k).exp2();
    }
    let svg = table_plot(&groups(&entries)[0]).unwrap();
    assert_eq!(triangles(&svg).len(), 2);
}

#[test]
fn rows_without_a_finite_error_have_no_panel() {
    let mut entries = [
        entry("simpson", "boole"),
        entry("gauss-3", "boole"),
        entry("riemann", "boole"),
    ];
    for level in &mut entries[1].levels {
        level.error = Float::new(53);
    }
    entries[1].verdict = Verdict::Exact;
    for (level, special) in entries[2]
        .levels
        .iter_mut()
        .zip([Special::Nan, Special::Infinity])
    {
        level.error = Float::with_val(53, special);
        level.floor = Float::with_val(53, special);
    }
    entries[2].verdict = Verdict::NotFinite;
    let svg = table_plot(&groups(&entries)[0]).unwrap();
    assert!(svg.contains("inner: gauss-3: no finite, nonzero error to draw (boole Exact)"));
    assert!(svg.contains("boole not finite"));
    assert_eq!(svg.matches("segments n").count(), 2);
}

#[test]
fn nothing_to_draw_is_said() {
    let mut samples = second_order(0);
    for sample in &mut samples {
        sample.error = Float::new(53);
    }
    assert!(plot(&samples).contains("no finite, nonzero error to draw (order Exact)"));
    assert!(plot(&[]).contains("TooFewLevels"));
}

#[test]
fn odd_steps_and_single_levels_are_drawn() {
    let mut samples = second_order(0);
    samples[1].n = None;
    let svg = plot(&samples);
    assert!(svg.contains("step d, finer to the right") && svg.contains("10⁻²"));
    assert_eq!(marks(&svg).len(), 6);
    assert!(plot(&samples[..1]).matches("<circle").count() > 1);
}
