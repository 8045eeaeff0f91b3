//! Running it: errors and counts on all threads, times on one.

use super::catalogue::{USUAL_FORMAT, USUAL_METHOD};
use super::counting::{counted_segments, counts};
use super::measure::{nanoseconds, runs_a_measurement};
use super::{Calibration, JournalError, Outcome, Point, Timing, Unit};
use crate::case::{Fresh, SymbolicCase};
use crate::method::{Method, MethodError};
use crate::parallel;
use crate::real::{Counts, Format, FormatName, WithFormat};
use crate::reference::{self, Reference, ReferenceError};
use crate::study::Progress;
use crate::study::run::exact;
use crate::study::sweep::Sweep;
use rug::Float;
use std::hint::black_box;

/// Bits that an error is kept with.
const ERROR_BITS: u32 = 80;
/// I is known to at least so many bits, and to some more than the widest format has.
const LEAST_BITS: u32 = 160;
/// Every run is measured so often, if it is short.
const REPEATS: usize = 5;

/// A run of so many nanoseconds is long: what warms up is nothing beside it.
const LONG: f64 = 5e6;

/// What to run.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Cases, methods, formats and levels.
    pub sweep: Sweep,
    /// Whether times are measured and modelled.
    pub timed: bool,
}

/// Why it stopped.
#[derive(Debug, thiserror::Error)]
pub enum TradeoffError {
    /// The exact radiance of a case is not to be had.
    #[error("case '{case}': {error}")]
    Reference {
        /// The case.
        case: String,
        /// Why.
        error: ReferenceError,
    },
    /// A finished unit cannot be kept.
    #[error(transparent)]
    Journal(#[from] JournalError),
}

/// One format, with the methods to run in it.
struct Part {
    format: FormatName,
    /// Each with whether it is there for comparison alone.
    methods: Vec<(Method, bool)>,
}

/// The formats, the usual choice among them though nobody asked for it.
fn parts(sweep: &Sweep) -> Vec<Part> {
    let mut parts: Vec<Part> = sweep
        .formats
        .iter()
        .map(|format| Part {
            format: *format,
            methods: sweep
                .methods
                .iter()
                .map(|method| (*method, false))
                .collect(),
        })
        .collect();
    if let Ok(usual) = USUAL_METHOD.parse::<Method>() {
        if !parts.iter().any(|part| part.format == USUAL_FORMAT) {
            parts.push(Part {
                format: USUAL_FORMAT,
                methods: Vec::new(),
            });
        }
        for part in parts.iter_mut().filter(|part| part.format == USUAL_FORMAT) {
            if !part.methods.iter().any(|(method, _)| *method == usual) {
                part.methods.push((usual, true));
            }
        }
    }
    parts
}

/// The work of it all, as progress counts it.
#[must_use]
pub fn estimate(settings: &Settings) -> u64 {
    let rounds = if settings.timed {
        1 + REPEATS as u64
    } else {
        1
    };
    let segments = settings
        .sweep
        .levels
        .iter()
        .fold(0_u64, |a, n| a.saturating_add(*n));
    let methods: usize = parts(&settings.sweep)
        .iter()
        .map(|part| part.methods.len())
        .sum();
    let runs = methods as u64 * settings.sweep.cases.len() as u64;
    runs.saturating_mul(segments).saturating_mul(rounds)
}

/// Seconds that a segment of a method takes at 128 bits where every operation is counted, on one core, roughly.
const COUNTED_SECONDS: f64 = 2e-5;
/// The same where none is.
const MPFR_SECONDS: f64 = 5e-6;
/// The same in what processors compute with.
const NATIVE_SECONDS: f64 = 3e-7;
/// The numbers that a method keeps of a segment: s, C and τ at its nodes, depths, transmittances.
const NUMBERS: f64 = 16.0;
/// Bytes a number takes beside its digits.
const HEADER_BYTES: f64 = 48.0;

/// Seconds that it will take, within a factor of a few. What is timed runs on one thread.
#[must_use]
pub fn seconds(settings: &Settings, threads: usize) -> f64 {
    let Settings { sweep, timed } = settings;
    let threads = if *timed { 1 } else { threads.max(1) };
    let runs = if *timed { 1.0 + REPEATS as f64 } else { 1.0 };
    let of_part = |part: &Part, case: &SymbolicCase| -> f64 {
        let weight = f64::max(1.0, f64::from(part.format.bits()) / 128.0);
        let plain = match part.format {
            FormatName::F32 | FormatName::F64 | FormatName::F32Lanes | FormatName::F64Lanes => {
                NATIVE_SECONDS
            }
            _ => MPFR_SECONDS * weight,
        };
        let methods = part.methods.iter().map(|(method, _)| {
            let levels = sweep.levels.iter().map(|n| {
                let counted = counted_segments(case, method, *n) as f64;
                counted * COUNTED_SECONDS * weight + *n as f64 * plain * runs
            });
            levels.sum::<f64>()
        });
        methods.sum()
    };
    let parts = parts(sweep);
    let cases = sweep.cases.iter();
    let all = cases.flat_map(|(_, case)| parts.iter().map(move |part| (part, case)));
    all.map(|(part, case)| of_part(part, case)).sum::<f64>() / threads as f64
}

/// Bytes that it will take: of as many runs at a time as there are threads.
#[must_use]
pub fn bytes(settings: &Settings, threads: usize) -> f64 {
    let finest = settings.sweep.levels.iter().copied().max().unwrap_or(0) as f64;
    let formats = settings.sweep.formats.iter();
    let bits = formats.map(|format| f64::from(format.bits()));
    let number = bits.fold(0.0, f64::max) / 8.0 + HEADER_BYTES;
    finest * NUMBERS * number * threads.max(1) as f64
}

/// Runs all; `finished` hears of every unit, by case and then by format.
///
/// # Errors
/// [`TradeoffError::Reference`] for a case without a radiance to compare with; what `finished` fails with.
pub fn run(
    settings: &Settings,
    progress: &dyn Progress,
    mut finished: impl FnMut(&Unit) -> Result<(), JournalError>,
) -> Result<Vec<Unit>, TradeoffError> {
    let Settings { sweep, timed } = settings;
    let parts = parts(sweep);
    let mut units = Vec::new();
    for (name, case) in &sweep.cases {
        let bits = parts.iter().map(|part| part.format.bits()).max();
        let bits = bits.unwrap_or(0).saturating_add(32).max(LEAST_BITS);
        let truth = reference::radiance(case, bits).map_err(|error| TradeoffError::Reference {
            case: name.clone(),
            error,
        })?;
        for part in &parts {
            let unit = part.format.with(OneUnit {
                name,
                case,
                part,
                levels: &sweep.levels,
                truth: &truth,
                timed: *timed,
                progress,
            });
            finished(&unit)?;
            units.push(unit);
        }
    }
    Ok(units)
}

/// One case in one format, the format still to be chosen.
struct OneUnit<'a> {
    name: &'a str,
    case: &'a SymbolicCase,
    part: &'a Part,
    levels: &'a [u64],
    truth: &'a Reference,
    timed: bool,
    progress: &'a dyn Progress,
}

impl WithFormat for OneUnit<'_> {
    type Output = Unit;

    fn run<F: Format>(self, format: F) -> Unit {
        // A run prepares its nodes itself, as those do that the calibration is made of.
        let radiance = |method: Method, n| {
            let nodes = Fresh::new(self.case, format);
            Ok(exact(&method.radiance(&nodes, n)?))
        };
        let once = |method: Method, n| {
            let nodes = Fresh::new(self.case, format);
            drop(black_box(method.radiance(&nodes, n)));
        };
        let mut points = self.points(format.bits(), &radiance);
        let calibration = self.timed.then(|| self.time(&mut points, &once));
        Unit {
            case: self.name.into(),
            format: self.part.format,
            bits: format.bits(),
            radiance: Float::with_val(ERROR_BITS, &self.truth.value),
            unproved: self.truth.unproved(self.case),
            points,
            calibration,
        }
    }
}

impl OneUnit<'_> {
    /// Errors and counts of all runs, on all threads.
    fn points(
        &self,
        bits: u32,
        radiance: &(dyn Fn(Method, u64) -> Result<Float, MethodError> + Sync),
    ) -> Vec<Point> {
        let runs: Vec<(Method, bool, u64)> = self
            .part
            .methods
            .iter()
            .flat_map(|(method, usual)| self.levels.iter().map(|n| (*method, *usual, *n)))
            .collect();
        parallel::map(&runs, |&(method, only_usual, n)| {
            let (outcome, counts) = match radiance(method, n) {
                Ok(radiance) => (self.outcome(&radiance), counts(self.case, bits, &method, n)),
                Err(error) => {
                    let reason = error.to_string();
                    (Outcome::Refused { reason }, Counts::default())
                }
            };
            self.progress.advance(n);
            Point {
                method,
                n,
                outcome,
                counts,
                modelled: None,
                measured: None,
                only_usual,
            }
        })
    }

    /// The error of a radiance, exactly subtracted and rounded once.
    fn outcome(&self, radiance: &Float) -> Outcome {
        if !radiance.is_finite() {
            return Outcome::NotFinite;
        }
        let truth = &self.truth.value;
        let mut error = Float::with_val(ERROR_BITS, radiance - truth).abs();
        // What the reference itself may be off by is no error of the method.
        if error <= self.truth.error {
            return Outcome::Exact;
        }
        if !truth.is_zero() {
            error /= truth.clone().abs();
        }
        Outcome::Error { error }
    }

    /// Times all points on this thread, pass by pass: what disturbs the machine for a while disturbs one
    /// measurement of each at most. `once` runs a method on n segments.
    fn time(&self, points: &mut [Point], once: &dyn Fn(Method, u64)) -> Calibration {
        let before = Calibration::of_format(self.part.format);
        let mut timed: Vec<(&mut Point, u32, Vec<f64>)> = Vec::new();
        for point in points {
            if let Outcome::Refused { .. } = point.outcome {
                self.progress
                    .advance(point.n.saturating_mul(REPEATS as u64));
                continue;
            }
            let (method, n) = (point.method, point.n);
            let first = nanoseconds(1, || once(method, n));
            timed.push(if first > LONG {
                (point, 1, vec![first])
            } else {
                (point, runs_a_measurement(|| once(method, n)), Vec::new())
            });
        }
        for _ in 0..REPEATS {
            for (point, runs, times) in &mut timed {
                let (method, n) = (point.method, point.n);
                self.progress.advance(n);
                // Two measurements say all of a long run.
                if times.len() > 1 && times.first().is_some_and(|time| *time > LONG) {
                    continue;
                }
                times.push(nanoseconds(*runs, || once(method, n)));
            }
        }
        // The machine's pace drifts: its costs are those between before and after.
        let calibration = before.mean(&Calibration::of_format(self.part.format));
        for (point, _, times) in timed {
            point.measured = Timing::of(times);
            point.modelled = Some(calibration.nanoseconds(&point.counts));
        }
        calibration
    }
}
