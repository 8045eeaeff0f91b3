//! The paper's tables: rules, methods, and the figures it prints.
//!
//! Source: Etiene, Kirby and Silva (2013), Tables 1 and 2 and the cubic-exponential remark in section 3.

use crate::method::{
    Color, Exponential, Inner, Integration, Interpolant, LastSegment, Method, Nested, Opacity,
    Outer, Preintegrated, Scope,
};
use crate::quadrature::{Rule, Sampling};
use serde::Serialize;
use std::fmt;
use std::str::FromStr;

/// A table of the paper, or a part of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum Table {
    /// Table 1, top: nested rules with the exact exponential.
    #[serde(rename = "1-exact")]
    Exact,
    /// Table 1, bottom: nested rules with the linear exponential.
    #[serde(rename = "1-linear")]
    Linear,
    /// The remark under Table 1: trapezoid under trapezoid with the cubic exponential.
    #[serde(rename = "1-cubic")]
    Cubic,
    /// Table 2: pre-integration.
    #[serde(rename = "2")]
    Preintegrated,
}

impl Table {
    /// The heading of a report.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Table::Exact => "Table 1, top: nested rules, exact exponential",
            Table::Linear => "Table 1, bottom: nested rules, linear exponential",
            Table::Cubic => "Remark in section 3: cubic exponential",
            Table::Preintegrated => "Table 2: pre-integration",
        }
    }

    /// What rows and columns choose.
    #[must_use]
    pub fn axes(self) -> (&'static str, &'static str) {
        match self {
            Table::Preintegrated => ("color", "opacity"),
            _ => ("inner", "outer"),
        }
    }
}

/// An inner or outer rule, as Table 1 names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RuleName(&'static str);

/// Text that names no row or column of Table 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown rule '{name}' (allowed: {allowed})")]
pub struct RuleNameError {
    /// The text given.
    pub name: String,
    /// The names there are.
    pub allowed: String,
}

impl RuleName {
    /// A row: an inner rule.
    ///
    /// # Errors
    /// [`RuleNameError`] where Table 1 has no such row.
    pub fn inner(name: &str) -> Result<Self, RuleNameError> {
        let deterministic = INNER.map(|(name, _)| name);
        let random = [
            Sampling::Shared,
            Sampling::Independent,
            Sampling::Stratified,
        ]
        .map(monte_carlo_name);
        Self::among(&[&deterministic[..], &random].concat(), name)
    }

    /// A column: an outer rule.
    ///
    /// # Errors
    /// [`RuleNameError`] where Table 1 has no such column.
    pub fn outer(name: &str) -> Result<Self, RuleNameError> {
        Self::among(&OUTER.map(|(name, _)| name), name)
    }

    fn among(names: &[&'static str], name: &str) -> Result<Self, RuleNameError> {
        names
            .iter()
            .find(|&&known| known == name)
            .map(|&known| RuleName(known))
            .ok_or_else(|| RuleNameError {
                name: name.into(),
                allowed: names.join(", "),
            })
    }
}

fn monte_carlo_name(sampling: Sampling) -> &'static str {
    match sampling {
        Sampling::Shared => "monte-carlo",
        Sampling::Independent => "monte-carlo-independent",
        Sampling::Stratified => "monte-carlo-stratified",
    }
}

/// Keeps the cells whose inner and outer rules are asked for; no name asks for all of them.
pub(super) fn chosen<M>(
    cells: Vec<Cell<M>>,
    inner: &[RuleName],
    outer: &[RuleName],
) -> Vec<Cell<M>> {
    let asked = |names: &[RuleName], name| names.is_empty() || names.contains(&RuleName(name));
    cells
        .into_iter()
        .filter(|cell| asked(inner, cell.row) && asked(outer, cell.column))
        .collect()
}

/// Which of the paper's numbered tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableNumber {
    /// Table 1, both halves, and the remark on the cubic exponential.
    One,
    /// Table 2.
    Two,
}

/// Text that names no table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown table '{name}' (allowed: 1, 2)")]
pub struct TableError {
    /// The text given.
    pub name: String,
}

impl FromStr for TableNumber {
    type Err = TableError;

    fn from_str(name: &str) -> Result<Self, TableError> {
        match name {
            "1" => Ok(TableNumber::One),
            "2" => Ok(TableNumber::Two),
            _ => Err(TableError { name: name.into() }),
        }
    }
}

impl fmt::Display for TableNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            TableNumber::One => "1",
            TableNumber::Two => "2",
        })
    }
}

/// A place in a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell<M> {
    pub(super) table: Table,
    pub(super) row: &'static str,
    pub(super) column: &'static str,
    /// The figure the paper prints there.
    pub(super) paper: Option<f64>,
    pub(super) method: M,
}

/// A method whose depth comes from random samples; the seed is the replica's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stochastic {
    pub(super) sampling: Sampling,
    pub(super) outer: Outer,
    pub(super) exponential: Exponential,
    pub(super) scope: Scope,
}

const OUTER: [(&str, Rule); 4] = [
    ("riemann", Rule::RiemannRight),
    ("trapezoid", Rule::Trapezoid),
    ("simpson", Rule::Simpson),
    ("boole", Rule::Boole),
];

const INNER: [(&str, Rule); 4] = [
    ("riemann", Rule::RiemannLeft),
    ("trapezoid", Rule::Trapezoid),
    ("simpson", Rule::Simpson),
    ("gauss-3", Rule::GaussLegendre(3)),
];

/// Rows as [`INNER`], columns as [`OUTER`].
const PAPER_EXACT: [[f64; 4]; 4] = [
    [1.01, 1.00, 1.00, 1.00],
    [1.00, 2.00, 1.98, 2.00],
    [0.99, 1.99, 4.02, 4.80],
    [1.00, 2.00, 4.00, 5.54],
];
const PAPER_LINEAR: [[f64; 4]; 4] = [
    [1.03, 1.00, 1.01, 1.01],
    [0.99, 1.06, 0.98, 0.98],
    [0.99, 1.08, 1.01, 1.01],
    [0.99, 1.08, 1.01, 1.01],
];

/// The paper's Monte Carlo is one run with one sample set for all nodes.
const PAPER_EXACT_MONTE_CARLO: [f64; 4] = [0.48, 0.41, 0.42, 0.42];
const PAPER_LINEAR_MONTE_CARLO: [f64; 4] = [0.08, 0.01, 0.00, 0.04];

/// The row "linear" is garbled in the paper's scan; its text says second order for both.
const PAPER_PREINTEGRATED: [[f64; 2]; 4] = [[2.00, 2.00], [1.98, 2.99], [1.98, 1.80], [1.00, 1.01]];

/// The deterministic entries of Table 1, row by row.
pub(super) fn nested() -> Vec<Cell<Method>> {
    let halves = [
        (Table::Exact, Exponential::Exact, Scope::Whole, PAPER_EXACT),
        (
            Table::Linear,
            Exponential::Linear,
            Scope::PerSegment,
            PAPER_LINEAR,
        ),
    ];
    let mut cells = Vec::new();
    for (table, exponential, scope, paper) in halves {
        for ((row, inner), figures) in INNER.into_iter().zip(paper) {
            for ((column, outer), figure) in OUTER.into_iter().zip(figures) {
                cells.push(Cell {
                    table,
                    row,
                    column,
                    paper: Some(figure),
                    method: Method::Nested(Nested {
                        inner: Inner::PerSegment(inner),
                        outer: Outer(outer),
                        exponential,
                        scope,
                    }),
                });
            }
        }
    }
    cells.push(Cell {
        table: Table::Cubic,
        row: "trapezoid",
        column: "trapezoid",
        paper: Some(2.00),
        method: Method::Nested(Nested {
            inner: Inner::PerSegment(Rule::Trapezoid),
            outer: Outer(Rule::Trapezoid),
            exponential: Exponential::Cubic,
            scope: Scope::PerSegment,
        }),
    });
    cells
}

/// The Monte Carlo entries of Table 1; only the shared sample set is the paper's. With the linear
/// exponential it is the whole depth that is linearised, as the paper's figures show.
pub(super) fn monte_carlo() -> Vec<Cell<Stochastic>> {
    let exact = (Table::Exact, Exponential::Exact);
    let linear = (Table::Linear, Exponential::Linear);
    let rows = [
        (exact, Sampling::Shared, Some(PAPER_EXACT_MONTE_CARLO)),
        (exact, Sampling::Independent, None),
        (exact, Sampling::Stratified, None),
        (linear, Sampling::Shared, Some(PAPER_LINEAR_MONTE_CARLO)),
    ];
    let mut cells = Vec::new();
    for ((table, exponential), sampling, figures) in rows {
        for (index, (column, outer)) in OUTER.into_iter().enumerate() {
            cells.push(Cell {
                table,
                row: monte_carlo_name(sampling),
                column,
                paper: figures.map(|figures: [f64; 4]| figures[index]),
                method: Stochastic {
                    sampling,
                    outer: Outer(outer),
                    exponential,
                    scope: Scope::Whole,
                },
            });
        }
    }
    cells
}

/// The entries of Table 2, row by row.
pub(super) fn preintegrated() -> Vec<Cell<Method>> {
    let quadratic = Interpolant::Quadratic(LastSegment::Beyond);
    let sub_intervals = |count| Integration::SubIntervals {
        count,
        rule: Rule::Trapezoid,
    };
    let color = |interpolant, attenuated, integration| Color {
        interpolant,
        attenuated,
        integration,
    };
    let rows = [
        (
            "linear",
            color(Interpolant::Linear, true, Integration::Closed),
        ),
        ("quadratic-100", color(quadratic, true, sub_intervals(100))),
        ("quadratic-10", color(quadratic, true, sub_intervals(10))),
        (
            "no-attenuation",
            color(Interpolant::Linear, false, Integration::Closed),
        ),
    ];
    let columns = [("linear", Interpolant::Linear), ("quadratic", quadratic)];
    let mut cells = Vec::new();
    for ((row, color), figures) in rows.into_iter().zip(PAPER_PREINTEGRATED) {
        for ((column, interpolant), figure) in columns.into_iter().zip(figures) {
            cells.push(Cell {
                table: Table::Preintegrated,
                row,
                column,
                paper: Some(figure),
                method: Method::Preintegrated(Preintegrated {
                    color,
                    opacity: Opacity {
                        interpolant,
                        integration: Integration::Closed,
                    },
                }),
            });
        }
    }
    cells
}
