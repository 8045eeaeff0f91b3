//! Means over seeds, beside their standard errors.

use super::words::letter;
use crate::convergence::StochasticFit;
use crate::document::{Cell, Column, Fact, Table, Tone};
use crate::method::Expected;
use crate::study::gradient::{Against, Bias, Biased, Gradients, OfCase, Standing};
use serde::Serialize;

/// One row a mean.
pub(super) fn table(gradients: &Gradients) -> Table {
    let columns = [
        Column::text("case").grouping(),
        Column::text("derivative, summed with"),
        Column::number("expected"),
        Column::number("order of the bias"),
        Column::text("bias"),
        Column::verdict("verdict"),
    ];
    let cases = gradients.cases.iter();
    let rows = cases.flat_map(|case| case.biases.iter().map(move |bias| row(case, bias)));
    let caption = "Means over seeds beside theory, with their standard errors, as parts of theory";
    Table::new(caption, columns).with(rows)
}

/// How often a mean without a bias has one by chance at any level: `fit_replicas` measured it.
const ALARMS: f64 = 1e-4;

/// How many seeds there were, and how often chance is taken for a bias.
pub(super) fn facts(gradients: &Gradients) -> [Fact; 2] {
    let means = gradients.biases().count();
    let alarms = means as f64 * ALARMS * 1000.0;
    let words = format!(
        "a t-test of every mean, {means} of them: without a bias one is called biased in at most {alarms:.1} of 1000 runs"
    );
    [
        Fact::new("seeds", gradients.settings.replicas.to_string()),
        Fact::new("chance", words),
    ]
}

fn row(case: &OfCase, bias: &Bias) -> Vec<Cell> {
    let tone = match bias.standing {
        Standing::Confirmed => Tone::Good,
        Standing::Contradicted | Standing::Failed => Tone::Bad,
        Standing::Inconclusive => Tone::Open,
    };
    let expected = match bias.expected {
        Some(Expected::Order(order)) => format!("{order}"),
        _ => "-".into(),
    };
    let order = bias.fit.bias.filter(|order| order.half_width().is_finite());
    let shown = order.map_or("-".into(), |order| {
        format!("{:.2} ± {:.2}", order.order, order.half_width())
    });
    let mean = bias.finest().map_or("-".into(), |level| {
        format!("{:+.1e} ± {:.0e}", level.mean, level.standard_error)
    });
    vec![
        Cell::text(&case.name),
        Cell::text(format!(
            "by {}, {}",
            letter(bias.derivative),
            match bias.against {
                Against::Sum => "1",
                Against::Theory => "theory",
            }
        )),
        Cell::text(expected),
        Cell::number(shown, order.map(|order| order.order)),
        Cell::text(mean),
        Cell::verdict(verdict(case, bias), tone),
    ]
}

/// What is wrong whatever the mean is, else what the mean says.
fn verdict(case: &OfCase, bias: &Bias) -> String {
    let mut troubles = case.troubles.iter();
    if bias.standing == Standing::Failed {
        return "failed".into();
    }
    if let Some(trouble) = troubles.find(|trouble| trouble.concerns(bias.derivative)) {
        return super::words::short(*trouble).into();
    }
    let errors = bias.standard_errors();
    match bias.biased {
        Biased::No => format!("no bias beyond {errors:.1} standard errors"),
        Biased::Falls => "bias falls".into(),
        Biased::Stays => bias.finest().map_or("biased".into(), |level| {
            format!("biased by {:+.1e}", level.mean)
        }),
        Biased::Open => format!("bias of {errors:.0} standard errors, order open"),
        Biased::Unresolved => "standard errors too large".into(),
        Biased::NotFinite => "NaN".into(),
    }
}

/// The same as JSON.
#[derive(Serialize)]
pub(super) struct Mean<'a> {
    derivative: &'static str,
    summed_with: &'static str,
    expected: Option<f64>,
    standing: &'static str,
    verdict: &'static str,
    /// Of the finest level with a bias, or of the finest.
    bias: Option<f64>,
    standard_error: Option<f64>,
    /// By how many of them the mean is off at most at the four finest levels; none where seeds have one answer.
    standard_errors: Option<f64>,
    fit: &'a StochasticFit,
}

impl<'a> Mean<'a> {
    pub(super) fn of(bias: &'a Bias) -> Self {
        let finest = bias.finest();
        Mean {
            derivative: bias.derivative.name(),
            summed_with: bias.against.name(),
            expected: match bias.expected {
                Some(Expected::Order(order)) => Some(order),
                _ => None,
            },
            standing: bias.standing.name(),
            verdict: bias.biased.name(),
            bias: finest.map(|level| level.mean),
            standard_error: finest.map(|level| level.standard_error),
            standard_errors: Some(bias.standard_errors()).filter(|errors| errors.is_finite()),
            fit: &bias.fit,
        }
    }
}
