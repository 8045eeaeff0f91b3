//! The entries whose optical depth comes from random samples: replicas over seeds.

use super::entry::{Entry, Level};
use super::explain::explain_stochastic;
use super::tables::{Cell, Stochastic};
use super::{REPLICAS, ReproduceError, protocol};
use crate::case::{AnyNodes, Case, Shared};
use crate::convergence::{OrderInterval, Replicas, StochasticFit, fit_replicas};
use crate::method::Level as Ray;
use crate::method::{Expected, Exponential, Inner, Method, MethodError, Nested, Scope};
use crate::parallel;
use crate::real::Native;
use crate::study::Progress;
use crate::study::run::{exact, exact_radiance};
use rug::{Float, Rational};

/// One replica costs about as much as so many evaluations in MPFR.
const UNITS: u64 = 4096;

/// Errors of every cell at every level, in one replica.
type Errors = Vec<Vec<f64>>;

pub(super) fn entries<C: Case>(
    case: &C,
    cells: &[Cell<Stochastic>],
    seed: u64,
    progress: &dyn Progress,
) -> Result<Vec<Entry>, ReproduceError> {
    if cells.is_empty() {
        return Ok(Vec::new());
    }
    let nodes = Shared::new(case, Native::<f64>::new());
    let radiance = exact_radiance(case, f64::MANTISSA_DIGITS)?;
    let seeds: Vec<u64> = (0..REPLICAS as u64).map(|r| seed.wrapping_add(r)).collect();
    let any = AnyNodes::new(&nodes);
    let replicas: Vec<Errors> = parallel::try_map(&seeds, |&seed| {
        let errors = one_replica(any, cells, seed, &radiance)?;
        progress.advance(UNITS);
        Ok::<_, MethodError>(errors)
    })?;
    fitted(&replicas, cells, seed, &case.length(), &radiance)
}

/// The order of every cell.
fn fitted(
    replicas: &[Errors],
    cells: &[Cell<Stochastic>],
    seed: u64,
    length: &Rational,
    radiance: &Float,
) -> Result<Vec<Entry>, ReproduceError> {
    let steps: Vec<f64> = protocol::LADDER
        .iter()
        .map(|&n| Rational::from(length / n).to_f64())
        .collect();
    let floor = f64::EPSILON * radiance.to_f64().abs();
    cells
        .iter()
        .enumerate()
        .map(|(index, cell)| {
            let levels: Vec<Replicas> = protocol::LADDER
                .into_iter()
                .zip(&steps)
                .enumerate()
                .map(|(level, (n, &step))| Replicas {
                    n: Some(n),
                    step,
                    errors: replicas.iter().map(|r| r[index][level]).collect(),
                    floor,
                })
                .collect();
            entry(cell, &levels, seed)
        })
        .collect()
}

fn one_replica(
    nodes: AnyNodes<'_, Native<f64>>,
    cells: &[Cell<Stochastic>],
    seed: u64,
    radiance: &Float,
) -> Result<Errors, MethodError> {
    let mut errors = vec![Vec::with_capacity(protocol::LADDER.len()); cells.len()];
    for n in protocol::LADDER {
        let mut ray = Ray::of_any(nodes, n);
        for (cell, errors) in cells.iter().zip(&mut errors) {
            let method = Method::Nested(Nested {
                inner: Inner::MonteCarlo {
                    sampling: cell.method.sampling,
                    seed,
                },
                outer: cell.method.outer,
                exponential: cell.method.exponential,
                scope: cell.method.scope,
            });
            let value = exact(&ray.radiance(&method)?);
            errors.push(Float::with_val(radiance.prec(), value - radiance).to_f64());
        }
    }
    Ok(errors)
}

fn entry(cell: &Cell<Stochastic>, levels: &[Replicas], seed: u64) -> Result<Entry, ReproduceError> {
    let Stochastic {
        sampling,
        exponential,
        scope,
        ..
    } = cell.method;
    let expected = match (exponential, scope) {
        // What a rule leaves is no matter of chance: beside scatter of order 3/2 Riemann sums have order 1.
        (Exponential::Exact, _) | (_, Scope::PerSegment) => {
            Expected::Order(sampling.order().min(cell.method.outer.order()))
        }
        (_, Scope::Whole) => Expected::Order(0.0),
    };
    let fit = fit_replicas(levels, Some(expected), seed)?;
    // Where the bias falls more slowly, its order is the method's, however fast the scatter falls.
    let order = match (fit.bias, fit.deviation) {
        (Some(bias), Some(deviation)) if bias.high < deviation.low => Some(bias),
        (bias, deviation) => deviation.or(bias),
    };
    let single_runs = single_run_orders(levels);
    Ok(Entry {
        table: cell.table,
        row: cell.row,
        column: cell.column,
        format: "f64".into(),
        paper: cell.paper,
        protocol_order: single_runs.first().copied(),
        expected,
        theorem: None,
        asymptotic_order: order.map(|o| o.order),
        asymptotic_half_width: order.map(half_width),
        window: order.and_then(|order| window(&fit, order)),
        verdict: fit.verdict,
        note: explain_stochastic(cell.paper, &fit, order, &single_runs),
        pairwise: deviation_orders(&fit),
        levels: fit
            .levels
            .iter()
            .map(|level| Level {
                n: level.n.unwrap_or(0),
                error: Float::with_val(53, level.deviation),
                bias: Some(level.mean),
                floor: Float::with_val(53, levels.first().map_or(0.0, |l| l.floor)),
            })
            .collect(),
        replicas: Some(fit.replicas),
    })
}

/// The levels that an order was fitted to: the finest.
fn window(fit: &StochasticFit, order: OrderInterval) -> Option<(u64, u64)> {
    let first = fit.levels.len().checked_sub(order.levels)?;
    fit.levels.get(first)?.n.zip(fit.levels.last()?.n)
}

fn half_width(interval: OrderInterval) -> f64 {
    (interval.order - interval.low).max(interval.high - interval.order)
}

/// The protocol's order of each replica by itself: what one run reports.
fn single_run_orders(levels: &[Replicas]) -> Vec<f64> {
    let replicas = levels.first().map_or(0, |level| level.errors.len());
    (0..replicas)
        .filter_map(|r| {
            let points: Vec<_> = levels
                .iter()
                .map(|level| (level.step.log2(), level.errors[r].abs().log2()))
                .collect();
            protocol::slope(&points)
        })
        .collect()
}

fn deviation_orders(fit: &StochasticFit) -> Vec<f64> {
    fit.levels
        .windows(2)
        .map(|pair| {
            (pair[0].deviation / pair[1].deviation).ln() / (pair[0].step / pair[1].step).ln()
        })
        .collect()
}

/// The units of progress that [`entries`] reports.
pub(super) fn work(cells: &[Cell<Stochastic>]) -> u64 {
    if cells.is_empty() {
        0
    } else {
        REPLICAS as u64 * UNITS
    }
}
