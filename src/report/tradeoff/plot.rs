//! Error against cost of every run, the front, and what is usual.

use super::words::{error, no_errors};
use crate::document::{Axis, Guide, Plot, Point, Series, Stroke, Trace};
use crate::method::{Inner, Method};
use crate::quadrature::Rule;
use crate::study::tradeoff::{
    CaseResults, Cost, Outcome, Point as Run, USUAL_FORMAT, USUAL_METHOD, Unit,
};

/// Colours of the palette that are no format's: black, and the last.
const FRONT: usize = 6;
const USUAL: usize = 7;

/// A run with its case's unit.
type Place<'r> = (&'r Unit, &'r Run);

/// All runs as hollow marks, coloured by format and shaped by family; what is usual, dotted; the front as a line, filled and
/// numbered marks, and a name of the legend for each stretch of one method in one format. What has no logarithm is counted.
pub(super) fn plot(case: &CaseResults, cost: Cost) -> Plot {
    let of = if case.is_relative() { " / |I|" } else { "" };
    let mut plot = Plot::new(
        format!("{}: error against {}", case.name, cost.label()),
        Axis::log(cost.label()),
        Axis::log(format!("|error|{of}")),
    );
    plot.series = all(case, cost);
    let units = case.units.iter().filter(|unit| unit.format == USUAL_FORMAT);
    let usual = units.flat_map(|unit| unit.points.iter().map(move |run| (unit, run)));
    let usual = usual.filter(|(_, run)| run.method.name() == USUAL_METHOD);
    let name = "usual: left Riemann sums in f32";
    let usual: Vec<Place<'_>> = usual.collect();
    plot.series
        .extend(line(name, USUAL, Stroke::Dotted, &usual, cost));
    let front = case.front(cost);
    plot.series
        .extend(line("Pareto front", FRONT, Stroke::Thin, &front, cost));
    let same =
        |a: &Place<'_>, b: &Place<'_>| (a.1.method == b.1.method) && a.0.format == b.0.format;
    let stretches = (1..).zip(front.chunk_by(same));
    plot.series
        .extend(stretches.filter_map(|(number, runs)| stretch(case, cost, number, runs)));
    let left_out = no_errors(case);
    if !left_out.is_empty() {
        plot.guides.push(Guide {
            upright: false,
            at: f64::NAN,
            label: format!("not drawn: {}", left_out.join(", ")),
        });
    }
    plot
}

/// A series for each family of methods in each format.
fn all(case: &CaseResults, cost: Cost) -> Vec<Series> {
    let mut series: Vec<Series> = Vec::new();
    for (unit, run) in case.points() {
        let Some(point) = point((unit, run), cost) else {
            continue;
        };
        let (_, family) = family(&run.method);
        let name = format!("{}, {family}", unit.format);
        match series.iter_mut().find(|series| series.name == name) {
            Some(series) => series.points.push(point),
            None => series.push(look(Series::marks(name, [point]), case, (unit, run))),
        }
    }
    series
}

/// Neighbours on the front of one method in one format. What is exact has a name and no place.
fn stretch(case: &CaseResults, cost: Cost, number: usize, runs: &[Place<'_>]) -> Option<Series> {
    let ((unit, first), (_, last)) = (*runs.first()?, *runs.last()?);
    let n = match (first.n, last.n) {
        (first, last) if first == last => format!("n {first}"),
        (first, last) => format!("n {first} … {last}"),
    };
    let exact = match last.outcome {
        Outcome::Exact => ", exact",
        _ => "",
    };
    let name = first.method.name();
    let name = format!("{number}  {name}, {}, {n}{exact}", unit.format);
    let mut points: Vec<Point> = runs.iter().filter_map(|run| point(*run, cost)).collect();
    for (index, point) in points.iter_mut().enumerate() {
        point.filled = true;
        if index == 0 {
            point.tag = number.to_string();
        }
    }
    Some(look(Series::marks(name, points), case, (unit, first)))
}

/// The colour of its format and the shape of its family.
fn look(series: Series, case: &CaseResults, (unit, run): Place<'_>) -> Series {
    let mut units = case.units.iter();
    let format = units.position(|other| other.format == unit.format);
    let (shape, _) = family(&run.method);
    series.colored(format.unwrap_or(0)).shaped(shape)
}

/// A line through runs whose marks are others'.
fn line(
    name: &str,
    color: usize,
    stroke: Stroke,
    runs: &[Place<'_>],
    cost: Cost,
) -> Option<Series> {
    let points: Vec<(f64, f64)> = runs.iter().filter_map(|run| at(*run, cost)).collect();
    let mut series = Series::marks(name, []).colored(color);
    let is_drawn = !points.is_empty();
    series.traces.push(Trace { stroke, points });
    is_drawn.then_some(series)
}

/// Decimal logarithms of cost and error, where there are such.
fn at((_, run): Place<'_>, cost: Cost) -> Option<(f64, f64)> {
    Some((cost.of(run)?.log10(), run.outcome.log10()?))
}

fn point(place: Place<'_>, cost: Cost) -> Option<Point> {
    let (unit, run) = place;
    let (x, y) = at(place, cost)?;
    let label = format!(
        "{} in {}, n = {}: error {}",
        run.method.name(),
        unit.format,
        run.n,
        error(run)
    );
    Some(Point::new(x, y, label))
}

/// The shape and the name of methods that work alike.
fn family(method: &Method) -> (usize, &'static str) {
    let is_gauss = |rule| matches!(rule, Rule::GaussLegendre(_));
    match method {
        Method::Preintegrated(_) => (1, "pre-integration"),
        Method::Composited(_) | Method::Layered(_) => (3, "compositing"),
        Method::Nested(nested) => match nested.inner {
            Inner::MonteCarlo { .. } => (4, "random depths"),
            Inner::PerSegment(rule) if is_gauss(rule) => (2, "Gauss"),
            _ if is_gauss(nested.outer.0) => (2, "Gauss"),
            _ => (0, "Newton–Cotes"),
        },
    }
}
