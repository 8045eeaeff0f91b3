//! A canvas in pixels over plotters' SVG backend.

use crate::report::ReportError;
use plotters::prelude::{Color, DrawingBackend, RGBColor, SVGBackend, ShapeStyle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, FontTransform, IntoFont, TextStyle};
use std::fmt::Display;

/// The backend draws at whole units: tenths of a pixel keep straight lines straight.
const UNITS: f64 = 10.0;
/// The backend divides font sizes by this.
const FONT_SCALE: f64 = 1.24;
/// Of a sans-serif letter, in em; a little wide, so that estimated boxes are safe.
const LETTER_WIDTH: f64 = 0.56;

type BackendCoord = (i32, i32);

/// A place in pixels, from the upper left corner.
pub(in crate::report) type Point = (f64, f64);

/// How a line is drawn.
#[derive(Clone, Copy)]
pub(in crate::report) struct Stroke {
    pub(in crate::report) color: RGBColor,
    pub(in crate::report) width: f64,
}

/// How a text is drawn, and which point of it is given.
#[derive(Clone, Copy)]
pub(in crate::report) struct Letters {
    pub(in crate::report) color: RGBColor,
    pub(in crate::report) size: f64,
    pub(in crate::report) bold: bool,
    pub(in crate::report) at: HPos,
    pub(in crate::report) upwards: bool,
}

/// The width a text takes, roughly: fonts are the reader's.
pub(in crate::report) fn text_width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * size * LETTER_WIDTH
}

/// A drawing under way. Remembers the first failure, so that drawing code needs no error paths.
pub(in crate::report) struct Canvas<'a> {
    backend: SVGBackend<'a>,
    failure: Option<String>,
}

/// The SVG of what `figure` draws on `size` pixels.
pub(in crate::report) fn draw(
    title: &str,
    (width, height): (f64, f64),
    figure: impl FnOnce(&mut Canvas<'_>),
) -> Result<String, ReportError> {
    let (w, h) = units((width, height));
    let mut svg = String::new();
    let mut canvas = Canvas {
        backend: SVGBackend::with_string(&mut svg, (w.unsigned_abs(), h.unsigned_abs())),
        failure: None,
    };
    figure(&mut canvas);
    let done = canvas.backend.present();
    canvas.note(done);
    let failure = canvas.failure.take();
    drop(canvas);
    let body = svg.split_once('\n').map(|(_opening, body)| body);
    match (failure, body) {
        (None, Some(body)) => Ok(format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {w} {h}\" \
             xmlns=\"http://www.w3.org/2000/svg\" role=\"img\">\n<title>{}</title>\n{body}",
            escape(title)
        )),
        (failure, _) => Err(ReportError::Draw {
            title: title.into(),
            reason: failure.unwrap_or_else(|| "an SVG without an opening line".into()),
        }),
    }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[expect(clippy::cast_possible_truncation, reason = "pixels, and saturating")]
fn units((x, y): Point) -> BackendCoord {
    ((x * UNITS).round() as i32, (y * UNITS).round() as i32)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "pixels, and saturating"
)]
fn width_units(width: f64) -> u32 {
    (width * UNITS).round() as u32
}

impl Stroke {
    fn style(self) -> ShapeStyle {
        self.color.stroke_width(width_units(self.width))
    }
}

impl Canvas<'_> {
    fn note<E: Display>(&mut self, result: Result<(), E>) {
        if let Err(failure) = result {
            self.failure.get_or_insert_with(|| failure.to_string());
        }
    }

    pub(in crate::report) fn path(&mut self, points: &[Point], stroke: Stroke) {
        let points: Vec<BackendCoord> = points.iter().copied().map(units).collect();
        let drawn = self.backend.draw_path(points, &stroke.style());
        self.note(drawn);
    }

    /// A path of dashes: `pattern` is the length of a dash and of the gap after it.
    pub(in crate::report) fn dashes(
        &mut self,
        points: &[Point],
        stroke: Stroke,
        pattern: (f64, f64),
    ) {
        for (from, to) in dashes(points, pattern) {
            self.path(&[from, to], stroke);
        }
    }

    pub(in crate::report) fn polygon(&mut self, points: &[Point], color: RGBColor) {
        let points: Vec<BackendCoord> = points.iter().copied().map(units).collect();
        let drawn = self.backend.fill_polygon(points, &color.filled());
        self.note(drawn);
    }

    pub(in crate::report) fn circle(&mut self, center: Point, radius: f64, color: RGBColor) {
        let radius = width_units(radius);
        let drawn = self
            .backend
            .draw_circle(units(center), radius, &color.filled(), true);
        self.note(drawn);
    }

    pub(in crate::report) fn text(&mut self, text: &str, at: Point, letters: Letters) {
        let style = if letters.bold {
            FontStyle::Bold
        } else {
            FontStyle::Normal
        };
        let size = letters.size * UNITS * FONT_SCALE;
        let mut font = ("sans-serif", size, style).into_font();
        if letters.upwards {
            font = font.transform(FontTransform::Rotate270);
        }
        let style = TextStyle::from(font)
            .color(&letters.color)
            .pos(Pos::new(letters.at, VPos::Center));
        let drawn = self.backend.draw_text(text, &style, units(at));
        self.note(drawn);
    }
}

/// The pieces of a path that a dash pattern leaves.
fn dashes(points: &[Point], (dash, gap): (f64, f64)) -> Vec<(Point, Point)> {
    let period = dash + gap;
    if !(period > 0.0 && dash > 0.0) {
        return Vec::new();
    }
    let mut pieces = Vec::new();
    let mut phase = 0.0;
    for ends in points.windows(2) {
        let (from, to) = (ends[0], ends[1]);
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        let on = |s: f64| {
            let share = s / length;
            (
                from.0 + (to.0 - from.0) * share,
                from.1 + (to.1 - from.1) * share,
            )
        };
        let mut start = -phase;
        while start < length {
            let (a, b) = (start.max(0.0), (start + dash).min(length));
            if b > a {
                pieces.push((on(a), on(b)));
            }
            start += period;
        }
        phase = (phase + length) % period;
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use plotters::prelude::BLACK;

    #[test]
    fn lengths_are_pixels_and_text_is_escaped() {
        let svg = draw("a<b & c", (90.0, 60.0), |canvas| {
            canvas.circle((12.34, 5.0), 3.0, BLACK);
        })
        .unwrap();
        assert!(svg.starts_with("<svg width=\"90\" height=\"60\" viewBox=\"0 0 900 600\""));
        assert!(svg.contains("<title>a&lt;b &amp; c</title>"));
        assert!(svg.contains("cx=\"123\" cy=\"50\" r=\"30\""), "{svg}");
        assert!(svg.ends_with("</svg>\n"));
        assert_eq!(svg.matches("<svg").count(), 1);
    }

    #[test]
    fn dashes_go_on_round_corners() {
        let path = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)];
        let pieces = dashes(&path, (4.0, 4.0));
        assert_eq!(
            pieces,
            [
                ((0.0, 0.0), (4.0, 0.0)),
                ((8.0, 0.0), (10.0, 0.0)),
                ((10.0, 0.0), (10.0, 2.0)),
                ((10.0, 6.0), (10.0, 10.0)),
            ]
        );
        assert!(dashes(&path, (0.0, 0.0)).is_empty());
    }
}
