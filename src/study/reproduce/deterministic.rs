//! The entries whose methods draw no random numbers.

use super::entry::{Entry, Level};
use super::explain::{Evidence, explain};
use super::tables::Cell;
use super::{ORACLE_BITS, ReproduceError, Settings, protocol};
use crate::case::Case;
use crate::convergence::{Fit, Verdict, fit};
use crate::method::{Expected, Limit, Method};
use crate::real::{Format, FormatName, Mpfr, Native, WithFormat};
use crate::study::run::units_a_segment;
use crate::study::{Progress, Run, samples};

/// An MPFR run needs that many bits less than another to have it as its oracle.
const ORACLE_MARGIN: u32 = 32;

pub(super) fn entries<C: Case>(
    case: &C,
    cells: &[Cell<Method>],
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Vec<Entry>, ReproduceError> {
    if cells.is_empty() {
        return Ok(Vec::new());
    }
    let methods: Vec<Method> = cells.iter().map(|cell| cell.method).collect();
    let oracle = Run::new(
        case,
        Mpfr { bits: ORACLE_BITS },
        &methods,
        &all_levels(settings),
        progress,
    )?;
    let binary64 = Run::new(
        case,
        Native::<f64>::new(),
        &methods,
        &binary64_levels(settings),
        progress,
    )?;
    let protocol = binary64.at_levels(&protocol::LADDER);
    let protocol_oracle = oracle.at_levels(&protocol::LADDER);
    let mut entries = Vec::new();
    for &name in &settings.formats {
        // What has run already does not run again.
        let run = match name {
            FormatName::Mpfr(ORACLE_BITS) => oracle.at_levels(&settings.ladder),
            FormatName::F64 => binary64.at_levels(&settings.ladder),
            _ => name.with(RunIn {
                case,
                methods: &methods,
                ladder: &settings.ladder,
                progress,
            })?,
        };
        let floors = Some(&oracle).filter(|o| o.bits >= run.bits + ORACLE_MARGIN);
        for (index, cell) in cells.iter().enumerate() {
            let limits = cell.method.limits(case);
            let expected = Expected::from_limits(&limits);
            let measured = samples(case, &run, index, floors)?;
            let mut fit = fit(&measured, Some(expected))?;
            if on_plateau_of_another_part(&fit, &limits) {
                fit.verdict = Verdict::PreAsymptotic;
            }
            let in_binary64 = samples(case, &protocol, index, Some(&oracle))?;
            let in_exact = samples(case, &protocol_oracle, index, None)?;
            let note = explain(&Evidence {
                paper: cell.paper,
                limits: &limits,
                expected,
                fit: &fit,
                samples: &measured,
                in_binary64: &in_binary64,
                in_exact: &in_exact,
            });
            entries.push(Entry {
                table: cell.table,
                row: cell.row,
                column: cell.column,
                format: name.to_string(),
                paper: cell.paper,
                protocol_order: protocol::order(&in_binary64),
                expected,
                theorem: cell.method.theorem(&case.structure()),
                asymptotic_order: fit.order,
                asymptotic_half_width: fit.half_width,
                window: fit
                    .window
                    .as_ref()
                    .and_then(|w| Some((w.coarsest_n?, w.finest_n?))),
                verdict: fit.verdict,
                note,
                pairwise: fit.pairs.iter().map(|pair| pair.order).collect(),
                levels: measured.iter().map(Level::from).collect(),
                replicas: None,
            });
        }
    }
    Ok(entries)
}

/// Whether the order is too high because it is that of a part which is not the limiting one: the
/// limiting part's error is still below it, and shows on a longer ladder.
fn on_plateau_of_another_part(fit: &Fit, limits: &[Limit]) -> bool {
    let (Verdict::TooHigh, Some(order), Some(half_width)) =
        (fit.verdict, fit.order, fit.half_width)
    else {
        return false;
    };
    limits.iter().any(|limit| {
        !limit.vanishes
            && limit
                .order
                .is_some_and(|limit| (limit - order).abs() <= half_width)
    })
}

/// The levels that the oracle is needed at: those asked for and the protocol's.
fn all_levels(settings: &Settings) -> Vec<u64> {
    let mut levels = settings.ladder.clone();
    levels.extend(protocol::LADDER);
    levels.sort_unstable();
    levels.dedup();
    levels
}

/// The levels that binary64 is needed at.
fn binary64_levels(settings: &Settings) -> Vec<u64> {
    if settings.formats.contains(&FormatName::F64) {
        all_levels(settings)
    } else {
        protocol::LADDER.to_vec()
    }
}

struct RunIn<'a, C> {
    case: &'a C,
    methods: &'a [Method],
    ladder: &'a [u64],
    progress: &'a dyn Progress,
}

impl<C: Case> WithFormat for RunIn<'_, C> {
    type Output = Result<Run, crate::method::MethodError>;

    fn run<F: Format>(self, format: F) -> Self::Output {
        Run::new(self.case, format, self.methods, self.ladder, self.progress)
    }
}

/// The units of progress that [`entries`] reports.
pub(super) fn work(cells: &[Cell<Method>], settings: &Settings) -> u64 {
    let other_formats = settings
        .formats
        .iter()
        .filter(|name| !matches!(name, FormatName::Mpfr(ORACLE_BITS) | FormatName::F64))
        .count() as u64;
    let segments = all_levels(settings).iter().sum::<u64>()
        + binary64_levels(settings).iter().sum::<u64>()
        + other_formats * settings.ladder.iter().sum::<u64>();
    let weights: u64 = cells.iter().map(|cell| units_a_segment(&cell.method)).sum();
    weights * segments
}
