//! Error against cost of every run, and the front.

use super::area::Area;
use super::canvas::{Canvas, Letters, Point as Pixel, Stroke, draw, text_width};
use super::scale::{Scale, power_of_ten, range, whole_ticks};
use super::style::{AXIS, FLOOR_DOTS, GRID, MUTED, TEXT, TICK_SIZE, WHITE, color, letters};
use crate::report::ReportError;
use crate::study::tradeoff::{CaseResults, Cost, Outcome, Point, USUAL_FORMAT, USUAL_METHOD, Unit};
use family::Family;
use plotters::prelude::RGBColor;
use plotters::style::text_anchor::HPos;

mod family;

const WIDTH: f64 = 980.0;
const PLOT: Area = Area {
    left: 72.0,
    top: 44.0,
    right: 640.0,
    bottom: 500.0,
};
const LIST_LEFT: f64 = 660.0;
const LINE: f64 = 14.0;
const SIZE: f64 = 9.5;
/// A number goes so far down to find a place of its own.
const MOST_STEPS: u32 = 14;
/// Of a colour, for what is not on the front.
const TINT: f64 = 0.33;

/// A run that can be drawn: log₁₀ of cost and error.
struct Dot<'r> {
    unit: &'r Unit,
    point: &'r Point,
    x: f64,
    y: f64,
}

/// Neighbours on the front of one method in one format.
struct Stretch<'r> {
    unit: &'r Unit,
    first: &'r Point,
    last: &'r Point,
    /// Where its number stands; nowhere if its points have no logarithm.
    at: Option<(f64, f64)>,
}

pub(super) fn figure(case: &CaseResults, cost: Cost) -> Result<String, ReportError> {
    let dots: Vec<Dot<'_>> = case.points().filter_map(|place| dot(place, cost)).collect();
    let front = case.front(cost);
    let stretches = stretches(&front, cost);
    let listed = (stretches.len() as f64 + 3.0) * LINE + PLOT.top;
    let height = (PLOT.bottom + 100.0).max(listed + 10.0);
    let title = format!("{}: error against {}", case.name, cost.label());
    draw(&title, (WIDTH, height), |canvas| {
        let frame = [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, height), (0.0, height)];
        canvas.polygon(&frame, WHITE);
        canvas.text(&title, (14.0, 18.0), letters(14.0, true, HPos::Left));
        let Some(axes) = Axes::new(&dots) else {
            let nothing = "no finite error above 0 to draw";
            canvas.text(nothing, (PLOT.left, 60.0), letters(11.0, false, HPos::Left));
            list(canvas, &stretches);
            return;
        };
        axes.draw(canvas, case, cost);
        for dot in &dots {
            let color = tint(color_of(case, dot.unit));
            Family::of(&dot.point.method).draw(canvas, axes.at(dot.x, dot.y), 2.4, color);
        }
        usual(canvas, case, cost, &axes);
        let on_front: Vec<Dot<'_>> = front.iter().filter_map(|place| dot(*place, cost)).collect();
        let path: Vec<Pixel> = on_front.iter().map(|dot| axes.at(dot.x, dot.y)).collect();
        canvas.path(
            &path,
            Stroke {
                color: TEXT,
                width: 1.1,
            },
        );
        numbers(canvas, &stretches, &axes);
        for dot in &on_front {
            let at = axes.at(dot.x, dot.y);
            let family = Family::of(&dot.point.method);
            family.draw(canvas, at, 5.4, TEXT);
            family.draw(canvas, at, 4.4, color_of(case, dot.unit));
        }
        list(canvas, &stretches);
        key(canvas, case, &dots);
    })
}

fn dot<'r>((unit, point): (&'r Unit, &'r Point), cost: Cost) -> Option<Dot<'r>> {
    Some(Dot {
        unit,
        point,
        x: cost.of(point)?.log10(),
        y: point.outcome.log10()?,
    })
}

fn stretches<'r>(front: &[(&'r Unit, &'r Point)], cost: Cost) -> Vec<Stretch<'r>> {
    let mut stretches: Vec<Stretch<'r>> = Vec::new();
    for (unit, point) in front {
        match stretches.last_mut() {
            Some(last) if last.first.method == point.method && last.unit.format == unit.format => {
                last.last = point;
            }
            _ => stretches.push(Stretch {
                unit,
                first: point,
                last: point,
                at: dot((unit, point), cost).map(|dot| (dot.x, dot.y)),
            }),
        }
    }
    stretches
}

/// The colour of a unit's format.
fn color_of(case: &CaseResults, unit: &Unit) -> RGBColor {
    let place = case
        .units
        .iter()
        .position(|other| other.format == unit.format);
    color(place.unwrap_or(0))
}

fn tint(RGBColor(r, g, b): RGBColor) -> RGBColor {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 0 … 255.
    let pale = |c: u8| (255.0 - (255.0 - f64::from(c)) * TINT) as u8;
    RGBColor(pale(r), pale(g), pale(b))
}

struct Axes {
    x: Scale,
    y: Scale,
    x_range: (f64, f64),
    y_range: (f64, f64),
}

impl Axes {
    fn new(dots: &[Dot<'_>]) -> Option<Axes> {
        let x_range = range(dots.iter().map(|dot| dot.x), 0.15, 1.0)?;
        let (low, high) = range(dots.iter().map(|dot| dot.y), 0.0, 0.0)?;
        // Numbers stand below their points.
        let margin = (0.06 * (high - low)).max(0.6);
        let y_range = range([low, high], margin, 2.0)?;
        Some(Axes {
            x: Scale::new(x_range, (PLOT.left, PLOT.right)),
            y: Scale::new(y_range, (PLOT.bottom, PLOT.top)),
            x_range,
            y_range,
        })
    }

    fn at(&self, x: f64, y: f64) -> Pixel {
        (self.x.pixel(x), self.y.pixel(y))
    }

    fn draw(&self, canvas: &mut Canvas<'_>, case: &CaseResults, cost: Cost) {
        for k in whole_ticks(self.x_range, 9) {
            let x = self.x.pixel(k);
            canvas.path(&[(x, PLOT.top), (x, PLOT.bottom)], GRID);
            let at = (x, PLOT.bottom + 11.0);
            canvas.text(
                &power_of_ten(k),
                at,
                letters(TICK_SIZE, false, HPos::Center),
            );
        }
        for k in whole_ticks(self.y_range, 10) {
            let y = self.y.pixel(k);
            canvas.path(&[(PLOT.left, y), (PLOT.right, y)], GRID);
            let at = (PLOT.left - 5.0, y);
            canvas.text(&power_of_ten(k), at, letters(TICK_SIZE, false, HPos::Right));
        }
        let corners = [
            (PLOT.left, PLOT.top),
            (PLOT.left, PLOT.bottom),
            (PLOT.right, PLOT.bottom),
        ];
        canvas.path(&corners, AXIS);
        let middle = f64::midpoint(PLOT.left, PLOT.right);
        let below = (middle, PLOT.bottom + 28.0);
        canvas.text(cost.label(), below, letters(11.5, false, HPos::Center));
        let upwards = Letters {
            upwards: true,
            ..letters(11.5, false, HPos::Center)
        };
        let y_label = if case.is_relative() {
            "|error| / |I|"
        } else {
            "|error|"
        };
        let beside = (PLOT.left - 56.0, f64::midpoint(PLOT.top, PLOT.bottom));
        canvas.text(y_label, beside, upwards);
    }
}

/// What is usual, dashed.
fn usual(canvas: &mut Canvas<'_>, case: &CaseResults, cost: Cost, axes: &Axes) {
    let units = case.units.iter().filter(|unit| unit.format == USUAL_FORMAT);
    let points = units.flat_map(|unit| unit.points.iter().map(move |point| (unit, point)));
    let path: Vec<Pixel> = points
        .filter(|(_, point)| point.method.name() == USUAL_METHOD)
        .filter_map(|place| dot(place, cost))
        .map(|dot| axes.at(dot.x, dot.y))
        .collect();
    canvas.dashes(&path, USUAL, FLOOR_DOTS);
}

const USUAL: Stroke = Stroke {
    color: MUTED,
    width: 1.6,
};

/// A number at the first point of each stretch, below it on the left, where no other number stands; with a line
/// to its point where that is not beside it.
fn numbers(canvas: &mut Canvas<'_>, stretches: &[Stretch<'_>], axes: &Axes) {
    let mut taken: Vec<Area> = Vec::new();
    for (index, stretch) in stretches.iter().enumerate() {
        let Some((x, y)) = stretch.at else { continue };
        let point = axes.at(x, y);
        let number = (index + 1).to_string();
        let width = text_width(&number, SIZE);
        let area = |step: u32| {
            let away = 9.0 + 11.0 * f64::from(step);
            let (right, middle) = (point.0 - 0.35 * away, point.1 + away);
            Area {
                left: right - width,
                right,
                top: middle - SIZE / 2.0,
                bottom: middle + SIZE / 2.0,
            }
        };
        let is_free = |area: &Area| !taken.iter().any(|other| other.meets(area));
        let steps = (0..MOST_STEPS).find(|step| is_free(&area(*step)));
        let step = steps.unwrap_or(0);
        let area = area(step);
        let middle = f64::midpoint(area.top, area.bottom);
        if step > 0 {
            let stroke = Stroke {
                color: MUTED,
                width: 0.5,
            };
            canvas.path(&[point, (area.right, area.top)], stroke);
        }
        let at = (area.right, middle);
        canvas.text(&number, at, letters(SIZE, true, HPos::Right));
        taken.push(area);
    }
}

/// What the numbers stand for.
fn list(canvas: &mut Canvas<'_>, stretches: &[Stretch<'_>]) {
    let mut at = (LIST_LEFT, PLOT.top);
    canvas.text(
        "on the Pareto front",
        at,
        letters(SIZE + 1.5, true, HPos::Left),
    );
    for (index, stretch) in stretches.iter().enumerate() {
        at.1 += LINE;
        let (first, last) = (stretch.first.n, stretch.last.n);
        let n = if first == last {
            format!("n {first}")
        } else {
            format!("n {first} … {last}")
        };
        let exact = match stretch.last.outcome {
            Outcome::Exact => ", exact",
            _ => "",
        };
        let words = format!(
            "{}  {}, {}, {n}{exact}",
            index + 1,
            stretch.first.method.name(),
            stretch.unit.format
        );
        canvas.text(&words, at, letters(SIZE, false, HPos::Left));
    }
}

/// Shapes, colours, the usual choice, and what is not drawn.
fn key(canvas: &mut Canvas<'_>, case: &CaseResults, dots: &[Dot<'_>]) {
    let mut y = PLOT.bottom + 50.0;
    let mut x = PLOT.left;
    for family in Family::ALL {
        if dots
            .iter()
            .any(|dot| Family::of(&dot.point.method) == family)
        {
            family.draw(canvas, (x + 4.0, y), 4.0, MUTED);
            canvas.text(
                family.name(),
                (x + 13.0, y),
                letters(SIZE + 0.5, false, HPos::Left),
            );
            x += 122.0;
        }
    }
    y += LINE + 3.0;
    x = PLOT.left;
    for unit in &case.units {
        if unit.points.iter().any(|point| !point.only_usual) {
            canvas.circle((x + 4.0, y), 4.0, color_of(case, unit));
            let name = unit.format.to_string();
            canvas.text(&name, (x + 13.0, y), letters(SIZE + 0.5, false, HPos::Left));
            x += 80.0;
        }
    }
    canvas.dashes(&[(x, y), (x + 22.0, y)], USUAL, FLOOR_DOTS);
    let usual = "usual: left Riemann sums in f32";
    canvas.text(usual, (x + 28.0, y), letters(SIZE + 0.5, false, HPos::Left));
    let count = |wanted: &str| {
        let points = case.points();
        points
            .filter(|(_, point)| point.outcome.name() == wanted)
            .count()
    };
    let left_out: Vec<String> = [
        ("exact", "exact"),
        ("not-finite", "not finite"),
        ("refused", "refused"),
    ]
    .into_iter()
    .map(|(state, words)| (count(state), words))
    .filter(|(count, _)| *count > 0)
    .map(|(count, words)| format!("{count} {words}"))
    .collect();
    if !left_out.is_empty() {
        let words = format!("not drawn: {}", left_out.join(", "));
        let at = (PLOT.left, y + LINE + 3.0);
        canvas.text(&words, at, letters(SIZE + 0.5, false, HPos::Left));
    }
}
