//! Plots as a page draws them.

use super::document;
use volver::document::{Axis, Block, Figure, Plot, Point, Scale, Series};
use volver::render::html::render;

/// The drawing of a page with one plot.
pub(crate) fn drawing(plot: Plot) -> String {
    let figure = Figure::new("f", "F", [plot]);
    let html = render(&document([Block::Figure(figure)])).unwrap();
    // What the page says of itself in numbers comes behind the drawing.
    let (main, _) = html.split_once("</main>").unwrap();
    main.split_once("<main>").unwrap().1.into()
}

/// A plot of one series.
pub(crate) fn plot(x: Scale, y: Scale, series: Series) -> Plot {
    let axis = |title: &str, scale| match scale {
        Scale::Log => Axis::log(title),
        Scale::Linear => Axis::linear(title),
    };
    let mut plot = Plot::new("p", axis("x", x), axis("y", y));
    plot.series.push(series);
    plot
}

fn through(points: &[(f64, f64)]) -> Series {
    Series::line("s", points.iter().map(|&(x, y)| Point::new(x, y, "p")))
}

/// An attribute of every element that begins so.
fn attributes(drawing: &str, element: &str, name: &str) -> Vec<f64> {
    let elements = drawing.split(element).skip(1);
    let value = |rest: &str| {
        let (element, _) = rest.split_once('>').unwrap();
        let (_, value) = element.split_once(&format!(" {name}=\"")).unwrap();
        value.split('"').next().unwrap().parse().unwrap()
    };
    elements.map(value).collect()
}

/// What stands at the ticks of the x axis from one place to another.
fn labels(low: f64, high: f64, scale: Scale) -> Vec<String> {
    let plot = plot(scale, Scale::Linear, through(&[(low, 0.0), (high, 1.0)]));
    let drawing = drawing(plot);
    let labels = drawing.split("<text class=\"x\"").skip(1);
    let label = |rest: &str| {
        let (_, label) = rest.split_once('>').unwrap();
        label.split('<').next().unwrap().to_string()
    };
    labels.map(label).collect()
}

#[test]
fn logarithms_have_decades() {
    let log = |low, high| labels(low, high, Scale::Log);
    assert_eq!(log(-12.0, -2.0)[..2], ["10⁻¹²", "10⁻¹⁰"]);
    assert_eq!(log(0.9, 3.6), ["10", "100", "1000"]);
    assert_eq!(log(0.9, 1.8), ["10", "20", "50"]);
    assert_eq!(log(-400.0, -1.0)[0], "10⁻⁴⁰⁰");
    assert_eq!(
        log(-7.9, -6.2),
        ["2·10⁻⁸", "5·10⁻⁸", "10⁻⁷", "2·10⁻⁷", "5·10⁻⁷"]
    );
    // Between 3.1 and 3.8 times a power of ten nothing is round: an eighth of the axis, which is a tenth longer than the
    // data, and so on.
    assert_eq!(
        log(-6.507, -6.427),
        ["3.16·10⁻⁷", "3.33·10⁻⁷", "3.50·10⁻⁷", "3.68·10⁻⁷"]
    );
    assert_eq!(log(2.493, 2.573), ["316", "333", "350", "368"]);
}

#[test]
fn values_have_round_numbers() {
    let linear = |low, high| labels(low, high, Scale::Linear);
    assert_eq!(linear(0.0, 1.0), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
    assert_eq!(
        linear(-20.0, 100.0),
        ["-20", "0", "20", "40", "60", "80", "100"]
    );
    assert_eq!(linear(0.0, 3e-8)[1], "5.0e-9");
}

#[test]
fn errors_below_all_numbers_have_a_place_on_logarithmic_axes() {
    let points = [
        Point::new(1.0, -10.0, "n = 10"),
        Point::new(2.0, -400.0, "n = 100").filled(),
    ];
    let drawing = drawing(plot(Scale::Log, Scale::Log, Series::line("total", points)));
    assert!(drawing.contains(">10⁻⁴⁰⁰</text>"), "{drawing}");
    assert_eq!(drawing.matches("data-label=").count(), 2);
    assert!(drawing.contains("class=\"mark filled\""));
    assert!(
        !drawing.contains("NaN") && !drawing.contains("inf"),
        "{drawing}"
    );
}

#[test]
fn what_has_no_logarithm_breaks_the_line_and_has_no_mark() {
    let places = [
        (1.0, -1.0),
        (2.0, f64::NEG_INFINITY),
        (3.0, f64::NAN),
        (4.0, -4.0),
        (5.0, -5.0),
    ];
    let drawing = drawing(plot(Scale::Log, Scale::Log, through(&places)));
    assert_eq!(drawing.matches("data-label=").count(), 3);
    let (_, curve) = drawing.split_once("<g class=\"series").unwrap();
    let (_, line) = curve.split_once("class=\"line\" d=\"").unwrap();
    let line = line.split('"').next().unwrap();
    assert_eq!(
        (line.matches('M').count(), line.matches('L').count()),
        (2, 1),
        "{line}"
    );
}

#[test]
fn places_between_stand_between_and_upwards_is_up() {
    let places = [(0.0, 1.0), (1.0, 2.0), (2.0, 3.0), (3.0, f64::NAN)];
    let drawing = drawing(plot(Scale::Linear, Scale::Linear, through(&places)));
    let [x, y] = ["data-x", "data-y"].map(|name| attributes(&drawing, "<path class=\"mark", name));
    let is_middle = |at: &[f64]| (at[1] - f64::midpoint(at[0], at[2])).abs() < 0.011;
    assert!(is_middle(&x) && is_middle(&y), "{x:?} {y:?}");
    assert!(x[0] < x[2] && y[0] > y[2]);
    // The frame reaches a little beyond the last mark and no further.
    let frame = |name| attributes(&drawing, "<rect class=\"frame\"", name)[0];
    let room = frame("x") + frame("width") - x[2];
    assert!(room > 0.0 && room < 0.1 * frame("width"), "{room}");
    assert!(y[2] > frame("y") && y[0] < frame("y") + frame("height"));
}

#[test]
fn one_place_alone_stands_in_the_middle() {
    for place in [0.0, -400.0, 1e300] {
        let drawing = drawing(plot(
            Scale::Linear,
            Scale::Linear,
            through(&[(place, place)]),
        ));
        let frame = |name| attributes(&drawing, "<rect class=\"frame\"", name)[0];
        let mark = |name| attributes(&drawing, "<path class=\"mark", name)[0];
        let middle = [
            frame("x") + frame("width") / 2.0,
            frame("y") + frame("height") / 2.0,
        ];
        for (at, middle) in [mark("data-x"), mark("data-y")].into_iter().zip(middle) {
            assert!((at - middle).abs() < 0.006, "{place}: {at} {middle}");
        }
    }
}

#[test]
fn a_plot_without_anything_says_so() {
    for series in [
        Series::line("nothing", [Point::new(f64::NAN, 1.0, "p")]),
        Series::line("nothing", [Point::new(f64::INFINITY, 1.0, "p")]),
    ] {
        let empty = drawing(plot(Scale::Log, Scale::Linear, series));
        assert!(empty.contains("Nothing to draw: nothing"), "{empty}");
        assert!(!empty.contains("<svg"), "{empty}");
    }
}
