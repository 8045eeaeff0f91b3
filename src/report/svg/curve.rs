//! What a figure shows: curves of measured errors, sorted into panels.

use crate::convergence::Verdict;
use crate::real::{MpfrReal, Real};
use crate::report::{Group, Row};
use crate::study::reproduce::{Entry, Level};
use rug::Float;
use std::f64::consts::LOG10_2;

/// Orders of less than this are no slope worth a triangle.
const FLAT: f64 = 0.1;

/// The error at one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mark {
    /// log₂ n, or −log₂ d: an octave to the right halves the step.
    pub(super) x: f64,
    /// log₁₀|e|.
    pub(super) y: f64,
    pub(super) negative: bool,
    /// The order was fitted to this level, among others.
    pub(super) fitted: bool,
}

/// Errors against segments of one method.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    /// Its place in the palette.
    pub(super) color: usize,
    pub(super) legend: String,
    /// Coarse to fine; `None` where there is no logarithm.
    pub(super) marks: Vec<Option<Mark>>,
    /// (x, log₁₀|bias|), where the marks are standard deviations.
    pub(super) bias: Vec<(f64, f64)>,
    /// (x, log₁₀ floor).
    pub(super) floor: Vec<(f64, f64)>,
    /// The order of the marks in the window, where there is one and it is not flat.
    pub(super) slope: Option<f64>,
}

/// One pair of axes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Panel {
    pub(super) title: String,
    pub(super) x_label: &'static str,
    pub(super) y_label: &'static str,
    /// (x, label), coarse to fine; without any, ticks stand at powers of ten of the step.
    pub(super) ticks: Vec<(f64, String)>,
    pub(super) curves: Vec<Curve>,
    /// What was fitted to the curves, drawn thin.
    pub(super) models: Vec<Model>,
    /// An n of interest.
    pub(super) guide: Option<Guide>,
}

/// A fitted curve.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Model {
    /// Its place in the palette.
    pub(super) color: usize,
    /// (x, log₁₀|e|), from left to right.
    pub(super) path: Vec<(f64, f64)>,
}

/// A vertical line with words beside it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Guide {
    /// Where, if within the axes or near them.
    pub(super) x: Option<f64>,
    /// The words, line by line.
    pub(super) lines: Vec<String>,
}

impl Curve {
    pub(super) fn marks(&self) -> impl Iterator<Item = Mark> + '_ {
        self.marks.iter().copied().flatten()
    }
}

impl Panel {
    /// Whether there is anything to draw.
    pub(super) fn is_empty(&self) -> bool {
        self.curves
            .iter()
            .all(|curve| curve.marks().next().is_none())
    }
}

/// log₁₀|x|, `None` for 0, NaN and infinities.
pub(super) fn log10_abs(x: &Float) -> Option<f64> {
    let log = MpfrReal::from(x.clone()).log2_abs() * LOG10_2;
    log.is_finite().then_some(log)
}

/// "boole 4.00"; other verdicts than the unremarkable ones by name.
pub(super) fn legend(name: &str, order: Option<f64>, verdict: Verdict) -> String {
    let order = order.map(|p| format!("{p:.2}"));
    let remark = match verdict {
        Verdict::Confirmed | Verdict::Fitted => None,
        Verdict::NotFinite => Some("not finite"),
        other => Some(other.name()),
    };
    let figure = match (verdict, order, remark) {
        (Verdict::Exact | Verdict::NotFinite | Verdict::Stalled, _, Some(remark)) => remark.into(),
        (_, Some(order), Some(remark)) => format!("{order} {remark}"),
        (_, Some(order), None) => order,
        (_, None, remark) => remark.unwrap_or("no order").into(),
    };
    format!("{name} {figure}").trim().to_string()
}

/// One panel a row of a table.
pub(super) fn panels(group: &Group<'_>) -> Vec<Panel> {
    let columns = group.columns();
    let (row_axis, _) = group.table.axes();
    group
        .rows
        .iter()
        .map(|row| panel(row, row_axis, &columns))
        .collect()
}

fn panel(row: &Row<'_>, axis: &str, columns: &[&str]) -> Panel {
    let replicas = row
        .entries
        .iter()
        .find_map(|e| Some((e.replicas?, &e.format)));
    let title = match replicas {
        Some((replicas, format)) => format!("{axis}: {} ({replicas} replicas, {format})", row.name),
        None => format!("{axis}: {}", row.name),
    };
    let mut levels: Vec<u64> = row
        .entries
        .iter()
        .flat_map(|e| e.levels.iter().map(|level| level.n))
        .filter(|&n| n > 0)
        .collect();
    levels.sort_unstable();
    levels.dedup();
    Panel {
        title,
        x_label: "segments n",
        y_label: if replicas.is_some() {
            "standard deviation of error"
        } else {
            "|error|"
        },
        ticks: ticks(&levels),
        curves: row
            .entries
            .iter()
            .map(|entry| {
                let color = columns.iter().position(|&c| c == entry.column);
                of_entry(entry, color.unwrap_or(0))
            })
            .collect(),
        models: Vec::new(),
        guide: None,
    }
}

pub(super) fn ticks(levels: &[u64]) -> Vec<(f64, String)> {
    let tick = |&n: &u64| ((n as f64).log2(), n.to_string());
    levels.iter().map(tick).collect()
}

fn of_entry(entry: &Entry, color: usize) -> Curve {
    let levels = || entry.levels.iter().filter(|level| level.n > 0);
    let x = |level: &Level| (level.n as f64).log2();
    // A stalled entry with replicas has the order of its bias, which is not the curve drawn.
    let slope_is_of_marks = entry.replicas.is_none() || entry.verdict != Verdict::Stalled;
    Curve {
        color,
        legend: legend(entry.column, entry.asymptotic_order, entry.verdict),
        marks: levels()
            .map(|level| {
                Some(Mark {
                    x: x(level),
                    y: log10_abs(&level.error)?,
                    negative: level.error.is_sign_negative(),
                    fitted: slope_is_of_marks
                        && entry
                            .window
                            .is_some_and(|(first, last)| (first..=last).contains(&level.n)),
                })
            })
            .collect(),
        bias: levels()
            .filter_map(|level| {
                let log = level.bias?.abs().log10();
                log.is_finite().then_some((x(level), log))
            })
            .collect(),
        floor: levels()
            .filter_map(|level| Some((x(level), log10_abs(&level.floor)?)))
            .collect(),
        slope: entry
            .asymptotic_order
            .filter(|p| slope_is_of_marks && entry.window.is_some() && is_slope(*p)),
    }
}

pub(super) fn is_slope(order: f64) -> bool {
    order.is_finite() && order.abs() >= FLAT
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::{entry, replicated};
    use crate::report::groups;
    use rug::float::Special;

    #[test]
    fn a_panel_a_row_and_a_color_a_column() {
        let entries = [
            entry("simpson", "trapezoid"),
            entry("simpson", "boole"),
            entry("gauss-3", "boole"),
        ];
        let panels = panels(&groups(&entries)[0]);
        let titles: Vec<&str> = panels.iter().map(|p| p.title.as_str()).collect();
        assert_eq!(titles, ["inner: simpson", "inner: gauss-3"]);
        assert_eq!(panels[1].curves[0].color, 1);
        assert_eq!(panels[0].ticks[1], (4.0, "16".to_string()));
    }

    #[test]
    fn marks_are_logarithms_with_sign_and_window() {
        let mut measured = entry("simpson", "boole");
        measured.levels[1].error = -measured.levels[1].error.clone();
        measured.levels[2].error = Float::new(53);
        measured.levels[3].error = Float::with_val(53, Special::Nan);
        measured.levels[4].error = Float::with_val(53, 1) >> 10_000_u32;
        let curve = of_entry(&measured, 0);
        let first = curve.marks[0].unwrap();
        assert_eq!((first.x, first.negative, first.fitted), (3.0, false, false));
        assert!((first.y - -12.0 * LOG10_2).abs() < 1e-12);
        let second = curve.marks[1].unwrap();
        assert!(second.negative && second.fitted);
        assert_eq!(curve.marks[2], None);
        assert_eq!(curve.marks[3], None);
        assert!((curve.marks[4].unwrap().y - -3010.3).abs() < 0.01);
        assert_eq!(curve.slope, Some(4.0));
    }

    #[test]
    fn a_stalled_bias_is_not_the_slope_of_the_deviation() {
        let mut stalled = replicated("monte-carlo", "boole");
        assert_eq!(of_entry(&stalled, 0).slope, Some(0.5));
        assert_eq!(of_entry(&stalled, 0).bias.len(), 6);
        stalled.verdict = Verdict::Stalled;
        stalled.asymptotic_order = Some(-0.2);
        let curve = of_entry(&stalled, 0);
        assert_eq!(curve.slope, None);
        assert_eq!(curve.legend, "boole Stalled");
    }

    #[test]
    fn legends_say_what_cannot_be_drawn() {
        assert_eq!(legend("boole", Some(4.0), Verdict::Confirmed), "boole 4.00");
        assert_eq!(legend("boole", None, Verdict::Exact), "boole Exact");
        assert_eq!(
            legend("boole", None, Verdict::NotFinite),
            "boole not finite"
        );
        assert_eq!(
            legend("boole", Some(2.5), Verdict::TooLow),
            "boole 2.50 TooLow"
        );
    }
}
