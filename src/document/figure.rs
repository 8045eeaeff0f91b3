//! Curves on axes.

use super::absent::nullable;
use serde::{Deserialize, Serialize};

/// Plots that belong together: one file, one caption.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// What its file is called, without an ending: lower-case letters, digits and dashes. Without a name it has no file.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub file: String,
    /// What it shows.
    pub caption: String,
    /// Its plots; stands empty where there is nothing to draw.
    pub plots: Vec<Plot>,
}

impl Figure {
    /// A figure with its plots.
    #[must_use]
    pub fn new(
        file: impl Into<String>,
        caption: impl Into<String>,
        plots: impl IntoIterator<Item = Plot>,
    ) -> Self {
        Figure {
            file: file.into(),
            caption: caption.into(),
            plots: plots.into_iter().collect(),
        }
    }
}

/// One pair of axes with its curves.
///
/// On a logarithmic axis every coordinate is a decimal logarithm: errors below binary64's smallest number have their
/// place too. Points that are not finite are left out, and the line breaks there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// To the right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// The curves, in the order of the legend.
    pub series: Vec<Series>,
    /// Straight lines across.
    pub guides: Vec<Guide>,
    /// What kinds of marks and lines mean here; a reader is told of those that occur.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub key: Vec<(Sign, String)>,
}

impl Plot {
    /// A plot without curves.
    #[must_use]
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Plot {
            title: title.into(),
            x,
            y,
            series: Vec::new(),
            guides: Vec::new(),
            key: Vec::new(),
        }
    }

    /// The same plot, which says what its marks and lines mean.
    #[must_use]
    pub fn keyed(self, key: impl IntoIterator<Item = (Sign, &'static str)>) -> Self {
        let key = key.into_iter().map(|(sign, words)| (sign, words.into()));
        Plot {
            key: key.collect(),
            ..self
        }
    }
}

/// A kind of mark or line that a key explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sign {
    /// A filled mark.
    Filled,
    /// A hollow mark.
    Hollow,
    /// A mark that points down.
    Negative,
    /// A line without points.
    Line(Stroke),
}

/// What is on an axis.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Axis {
    /// The label.
    pub title: String,
    /// What its coordinates are.
    pub scale: Scale,
}

impl Axis {
    /// An axis whose coordinates are decimal logarithms.
    #[must_use]
    pub fn log(title: impl Into<String>) -> Self {
        Axis {
            title: title.into(),
            scale: Scale::Log,
        }
    }

    /// An axis whose coordinates are the values.
    #[must_use]
    pub fn linear(title: impl Into<String>) -> Self {
        Axis {
            title: title.into(),
            scale: Scale::Linear,
        }
    }
}

/// What coordinates are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// The values.
    Linear,
    /// Decimal logarithms of the values.
    Log,
}

/// One curve: its points, and traces that belong to it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// What the legend says; without a name it says nothing.
    pub name: String,
    /// Which colour of the palette, so that a name has the same colour in all plots; otherwise its place in the plot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<usize>,
    /// Which shape its marks have; otherwise that of its colour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<usize>,
    /// Whether a line goes through the points.
    pub line: bool,
    /// The points, in the order of the line.
    pub points: Vec<Point>,
    /// Lines without points.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub traces: Vec<Trace>,
}

impl Series {
    /// Points with a line through them.
    #[must_use]
    pub fn line(name: impl Into<String>, points: impl IntoIterator<Item = Point>) -> Self {
        Series {
            name: name.into(),
            color: None,
            shape: None,
            line: true,
            points: points.into_iter().collect(),
            traces: Vec::new(),
        }
    }

    /// Points alone.
    #[must_use]
    pub fn marks(name: impl Into<String>, points: impl IntoIterator<Item = Point>) -> Self {
        Series {
            line: false,
            ..Series::line(name, points)
        }
    }

    /// The same series in a colour of the palette.
    #[must_use]
    pub fn colored(self, color: usize) -> Self {
        Series {
            color: Some(color),
            ..self
        }
    }

    /// The same series with marks of a shape.
    #[must_use]
    pub fn shaped(self, shape: usize) -> Self {
        Series {
            shape: Some(shape),
            ..self
        }
    }
}

/// A point with what is shown where it is pointed at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// To the right.
    #[serde(deserialize_with = "nullable")]
    pub x: f64,
    /// Upwards.
    #[serde(deserialize_with = "nullable")]
    pub y: f64,
    /// The values in words; the name of the series is added.
    pub label: String,
    /// A few letters beside the mark, such as a number that the legend explains.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub tag: String,
    /// Filled, not hollow: the order was fitted here, say, or no other method is cheaper.
    #[serde(default)]
    pub filled: bool,
    /// A mark that points down: the value has a minus sign, which a logarithm hides.
    #[serde(default)]
    pub negative: bool,
}

impl Point {
    /// A hollow mark.
    #[must_use]
    pub fn new(x: f64, y: f64, label: impl Into<String>) -> Self {
        Point {
            x,
            y,
            label: label.into(),
            tag: String::new(),
            filled: false,
            negative: false,
        }
    }

    /// The same point with a filled mark.
    #[must_use]
    pub fn filled(self) -> Self {
        Point {
            filled: true,
            ..self
        }
    }

    /// The same point with letters beside it.
    #[must_use]
    pub fn tagged(self, tag: impl Into<String>) -> Self {
        Point {
            tag: tag.into(),
            ..self
        }
    }
}

/// A line without points: a model, a floor, a fitted slope, a function. Beside points it widens an axis by a decade at
/// most.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// How it is drawn.
    pub stroke: Stroke,
    /// (x, y) from one end to the other; the line breaks at those that are not finite.
    #[serde(deserialize_with = "super::absent::nullable_pairs")]
    pub points: Vec<(f64, f64)>,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stroke {
    /// As a line through points.
    Solid,
    /// Thin.
    Thin,
    /// Dashed.
    Dashed,
    /// Dotted.
    Dotted,
}

/// A straight line across the plot, with words beside it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Guide {
    /// Upright, at a place on the x axis; otherwise level, at a place on the y axis.
    pub upright: bool,
    /// The place; not a finite number draws no line, and the words stay.
    #[serde(deserialize_with = "nullable")]
    pub at: f64,
    /// The words.
    pub label: String,
}
