//! Everything, for programs.

use crate::case::Unproved;
use crate::report::ReportError;
use crate::study::tradeoff::{
    Agreement, Calibration, Cost, Goal, Point, Results, Standing, Unit, agreement, clock_name,
    standings,
};
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    settings: Settings<'a>,
    timing: Option<TimingOf>,
    cases: Vec<CaseOf<'a>>,
    standings: Vec<Standing>,
}

#[derive(Serialize)]
struct Settings<'a> {
    cases: Vec<&'a str>,
    methods: &'a [String],
    formats: &'a [String],
    levels: &'a [u64],
    cost: Cost,
}

#[derive(Serialize)]
struct TimingOf {
    clock: &'static str,
    pinned: bool,
    within_1_5: Vec<AgreementOf>,
}

#[derive(Serialize)]
struct AgreementOf {
    #[serde(flatten)]
    agreement: Agreement,
    share: Option<f64>,
}

#[derive(Serialize)]
struct CaseOf<'a> {
    case: &'a str,
    radiance: String,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    unproved: &'a [Unproved],
    /// Errors are parts of |I|.
    relative: bool,
    cheapest: Vec<GoalOf>,
    front: Vec<Place>,
    units: Vec<UnitOf<'a>>,
}

#[derive(Serialize)]
struct GoalOf {
    error: String,
    best: Option<Place>,
    usual: Option<Place>,
}

/// A point by what finds it again.
#[derive(Serialize)]
struct Place {
    method: String,
    format: String,
    n: u64,
    evaluations: u64,
    operations: u64,
    modelled_ns: Option<f64>,
    measured_ns: Option<f64>,
}

#[derive(Serialize)]
struct UnitOf<'a> {
    format: String,
    bits: u32,
    calibration_ns: Option<&'a Calibration>,
    points: &'a [Point],
}

/// `{"volver": version, "settings": {…}, "timing": {…}, "cases": […], "standings": […]}`, indented, with a newline
/// at the end.
///
/// # Errors
/// [`ReportError::Json`], which no comparison is known to cause.
pub fn json(results: &Results) -> Result<String, ReportError> {
    let header = &results.header;
    let with_share = |agreement: Agreement| AgreementOf {
        share: agreement.share(),
        agreement,
    };
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        settings: Settings {
            cases: header
                .cases
                .iter()
                .map(|[name, ..]| name.as_str())
                .collect(),
            methods: &header.methods,
            formats: &header.formats,
            levels: &header.levels,
            cost: results.cost,
        },
        timing: results.pinned.map(|pinned| TimingOf {
            clock: clock_name(),
            pinned,
            within_1_5: agreement(results).into_iter().map(with_share).collect(),
        }),
        cases: cases(results),
        standings: standings(results, results.cost),
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

fn cases(results: &Results) -> Vec<CaseOf<'_>> {
    results
        .cases
        .iter()
        .map(|case| CaseOf {
            case: &case.name,
            radiance: case.radiance.to_string_radix(10, Some(20)),
            unproved: &case.unproved,
            relative: case.is_relative(),
            cheapest: case.goals(results.cost).iter().map(GoalOf::of).collect(),
            front: case.front(results.cost).into_iter().map(place).collect(),
            units: case.units.iter().map(UnitOf::of).collect(),
        })
        .collect()
}

impl GoalOf {
    fn of(goal: &Goal<'_>) -> GoalOf {
        GoalOf {
            error: super::words::goal(goal),
            best: goal.best.map(place),
            usual: goal.usual.map(place),
        }
    }
}

impl<'a> UnitOf<'a> {
    fn of(unit: &'a Unit) -> UnitOf<'a> {
        UnitOf {
            format: unit.format.to_string(),
            bits: unit.bits,
            calibration_ns: unit.calibration.as_ref(),
            points: &unit.points,
        }
    }
}

fn place((unit, point): (&Unit, &Point)) -> Place {
    Place {
        method: point.method.name(),
        format: unit.format.to_string(),
        n: point.n,
        evaluations: point.counts.evaluations(),
        operations: point.counts.operations(),
        modelled_ns: point.modelled,
        measured_ns: point.measured.map(|timing| timing.median),
    }
}
