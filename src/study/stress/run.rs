//! All scenarios, methods and formats, in parallel.

use super::cell::Cell;
use super::exact::{Exact, exact};
use super::facts::facts;
use super::judge::{Ran, digits, relative_error, verdict};
use super::medium::Medium;
use super::method::Kind;
use super::places::Places;
use super::promise::{Facts, Promise, promise};
use super::range::Range;
use super::scenario::Scenario;
use super::watched::{Events, Watched};
use super::{StressError, Verdict};
use crate::case::{Case, Nodes, Transfer};
use crate::method::{
    Accumulation, CompositingOrder, Method, MethodError, OpacityFormula, Position,
};
use crate::parallel;
use crate::real::lanes::LaneFormat;
use crate::real::{Format, FormatName, Native, Real};
use crate::study::Progress;
use half::{bf16, f16};
use rug::{Float, Rational};
use std::cmp::Reverse;
use std::sync::OnceLock;

/// What to run.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The extremes.
    pub scenarios: Vec<Scenario>,
    /// The methods, each of a known [`Kind`].
    pub methods: Vec<Method>,
    /// The formats: any but MPFR, which has no ends within reach.
    pub formats: Vec<FormatName>,
}

/// Segments beyond which a cell is left out.
const MOST: u64 = 1 << 24;
/// The same of methods that keep all segments in memory.
const MOST_KEPT: u64 = 1 << 20;
/// The same of emulated and 16-bit formats, and of pre-integration.
const MOST_SLOW: u64 = 1 << 16;

/// The cells, scenario by scenario, method by method, format by format.
///
/// # Errors
/// [`StressError`] where a method has no bound or a format no ends.
pub fn run(settings: &Settings, progress: &dyn Progress) -> Result<Vec<Cell>, StressError> {
    for format in &settings.formats {
        if matches!(format, FormatName::Mpfr(_)) {
            return Err(StressError::Format {
                name: format.to_string(),
            });
        }
    }
    let mut rays = Vec::new();
    for scenario in &settings.scenarios {
        for method in &settings.methods {
            rays.push(Ray {
                scenario,
                method,
                kind: Kind::of(method)?,
                known: OnceLock::new(),
            });
        }
    }
    let mut tasks = Vec::new();
    for ray in &rays {
        for &format in &settings.formats {
            tasks.push((tasks.len(), ray, format));
        }
    }
    tasks.sort_by_key(|(_, ray, _)| Reverse(ray.scenario.n));
    let mut cells = parallel::map(&tasks, |&(place, ray, format)| {
        let cell = ray.cell(format);
        progress.advance(units(ray.kind, format, ray.scenario.n));
        (place, cell)
    });
    cells.sort_by_key(|(place, _)| *place);
    Ok(cells.into_iter().map(|(_, cell)| cell).collect())
}

/// The units that [`Progress`] will hear of in all: the segments of all cells that are run.
#[must_use]
pub fn work(settings: &Settings) -> u64 {
    let mut work = 0_u64;
    for method in &settings.methods {
        // Another method is refused.
        let Ok(kind) = Kind::of(method) else { continue };
        for format in &settings.formats {
            let segments = settings.scenarios.iter();
            let segments = segments.map(|scenario| units(kind, *format, scenario.n));
            work = segments.fold(work, u64::saturating_add);
        }
    }
    work
}

/// The segments of a cell, none where it is left out.
fn units(kind: Kind, format: FormatName, n: u64) -> u64 {
    if left_out(kind, format, n).is_some() {
        0
    } else {
        n
    }
}

/// Why a cell is not run.
fn left_out(kind: Kind, format: FormatName, n: u64) -> Option<String> {
    let slow_format = !matches!(
        format,
        FormatName::F32 | FormatName::F64 | FormatName::F32Lanes | FormatName::F64Lanes
    );
    let keeps = match kind {
        Kind::Simpson => true,
        Kind::Composited(compositing) => compositing.order == CompositingOrder::BackToFront,
        Kind::Trapezoid | Kind::ClosedSegments | Kind::SubIntervals(_) => false,
    };
    let segments = matches!(kind, Kind::ClosedSegments | Kind::SubIntervals(_));
    let (most, why) = if slow_format {
        (MOST_SLOW, "of 16 bits or emulated formats")
    } else if segments {
        (MOST_SLOW, "of pre-integration")
    } else if keeps {
        (MOST_KEPT, "kept in memory")
    } else {
        (MOST, "at all")
    };
    (n > most).then(|| format!("more than {most} segments {why}"))
}

/// A method on a scenario, in whatever format.
struct Ray<'a> {
    scenario: &'a Scenario,
    method: &'a Method,
    kind: Kind,
    /// What is known without rounding, once for all formats.
    known: OnceLock<Result<Known, MethodError>>,
}

/// What is known without rounding.
struct Known {
    exact: Exact,
    facts: Facts,
}

impl Ray<'_> {
    fn cell(&self, format: FormatName) -> Cell {
        let Scenario { name, n, .. } = self.scenario;
        let mut cell = Cell {
            scenario: name.clone(),
            method: self.method.name(),
            format: format.to_string(),
            n: *n,
            digits: None,
            against_radiance: None,
            promised: 0.0,
            verdict: None,
            reason: None,
        };
        if let Some(reason) = left_out(self.kind, format, *n) {
            cell.verdict = Some(Verdict::LeftOut);
            cell.reason = Some(reason);
            return cell;
        }
        let run = match self.known.get_or_init(|| self.without_rounding()) {
            Err(error) => Err(error.clone()),
            Ok(known) => match format {
                FormatName::F16 => self.fill(&mut cell, known, Native::<f16>::new()),
                FormatName::Bf16 => self.fill(&mut cell, known, Native::<bf16>::new()),
                FormatName::F32 => self.fill(&mut cell, known, Native::<f32>::new()),
                FormatName::F64 => self.fill(&mut cell, known, Native::<f64>::new()),
                FormatName::F32Lanes => self.fill(&mut cell, known, LaneFormat::<f32>::new()),
                FormatName::F64Lanes => self.fill(&mut cell, known, LaneFormat::<f64>::new()),
                FormatName::Ieee(format) => self.fill(&mut cell, known, format),
                FormatName::Fixed(format) => self.fill(&mut cell, known, format),
                // Refused beforehand.
                FormatName::Mpfr(_) => Ok(()),
            },
        };
        if let Err(error) = run {
            cell.verdict = Some(Verdict::Refused);
            cell.reason = Some(error.to_string());
        }
        cell
    }

    fn without_rounding(&self) -> Result<Known, MethodError> {
        let Scenario { medium, n, .. } = self.scenario;
        let exact = exact(medium, self.method, self.kind, *n)?;
        let facts = facts(medium, *n, self.kind, &exact.approximation);
        Ok(Known { exact, facts })
    }

    /// Runs it in a format and says what came of it.
    fn fill<F: Range>(&self, cell: &mut Cell, known: &Known, format: F) -> Result<(), MethodError> {
        let Known { exact, facts } = known;
        let rounding = format.rounding();
        let ran = self.observe(format)?;
        let promise = promise(self.kind, facts, &rounding);
        let error = |exact| relative_error(&ran.radiance, exact);
        cell.digits = error(&exact.approximation).map(digits);
        let radiance = exact.radiance.as_ref();
        cell.against_radiance = radiance.and_then(|exact| error(exact).map(digits));
        cell.promised = Promise::digits(promise.roundoff + promise.underflow);
        cell.verdict = verdict(&ran, exact, &promise, &rounding, self.scenario.n);
        Ok(())
    }

    fn observe<F: Range>(&self, format: F) -> Result<Ran, MethodError> {
        let Scenario { medium, n, .. } = self.scenario;
        let watched = Watched(format);
        let places = Places::new(medium, watched);
        let step = watched.ratio(&(medium.length() / *n));
        let mut ran = Ran {
            radiance: Float::new(2),
            events: Events::NONE,
            lost: 0.0,
            of_inputs: step.events,
            thickest: Float::new(2),
            negative_medium: false,
            linear: is_linear(self.kind),
            diverged: diverges(medium, *n, places_in_segment(self.kind), format),
        };
        let mut see = |transfer: Transfer<_>| look(&mut ran, transfer, &step);
        let whole = usize::try_from(*n).unwrap_or(usize::MAX);
        let (boundaries, middles) = places_of(self.kind, whole);
        if medium.is_uniform() {
            places.march(1).take(1).for_each(&mut see);
        } else {
            let seen = places
                .march(*n)
                .skip(boundaries.start)
                .take(boundaries.len());
            seen.for_each(&mut see);
            let half = Rational::from((1, 2));
            places
                .march_inside(*n, half)
                .take(middles)
                .for_each(&mut see);
        }
        let radiance = self.method.radiance(&places, *n)?;
        ran.radiance = radiance.to_float();
        ran.events = radiance.events;
        ran.lost = f64::from(radiance.lost);
        Ok(ran)
    }
}

/// What one place adds to what is known of a run's inputs.
fn look<F: Range>(
    ran: &mut Ran,
    transfer: Transfer<super::watched::Observed<F>>,
    step: &super::watched::Observed<F>,
) {
    let Transfer {
        emission,
        extinction,
    } = transfer;
    ran.negative_medium |= F::is_negative(&emission.value) || F::is_negative(&extinction.value);
    let depth = extinction * step;
    ran.of_inputs |= emission.events | depth.events;
    let depth = depth.to_float();
    if depth > ran.thickest {
        ran.thickest = depth;
    }
}

/// Opacities are τ d, and the transmittance is made of them.
fn is_linear(kind: Kind) -> bool {
    let Kind::Composited(compositing) = kind else {
        return false;
    };
    let by_depths = matches!(
        compositing.order,
        CompositingOrder::FrontToBack {
            depth: Accumulation::Depths,
            ..
        }
    );
    compositing.opacity == OpacityFormula::Linear && !by_depths
}

/// Which of the n + 1 boundaries are looked at, and how many of the middles.
fn places_of(kind: Kind, n: usize) -> (std::ops::Range<usize>, usize) {
    match kind {
        Kind::Composited(compositing) => match compositing.position {
            Position::Front => (0..n, 0),
            Position::Middle => (0..0, n),
            Position::Back => (1..n.saturating_add(1), 0),
        },
        Kind::Trapezoid | Kind::ClosedSegments => (0..n.saturating_add(1), 0),
        Kind::Simpson | Kind::SubIntervals(_) => (0..n.saturating_add(1), n),
    }
}

/// Places are multiples of this part of a segment.
fn places_in_segment(kind: Kind) -> u32 {
    match kind {
        Kind::Trapezoid | Kind::ClosedSegments => 1,
        Kind::Simpson => 2,
        Kind::Composited(compositing) => match compositing.position {
            Position::Middle => 2,
            Position::Front | Position::Back => 1,
        },
        Kind::SubIntervals(count) => count,
    }
}

/// Whether a place, or a jump, may be rounded across the other.
fn diverges<F: Range>(medium: &Medium, n: u64, parts: u32, format: F) -> bool {
    let edges = medium.edges();
    if edges.is_empty() {
        return false;
    }
    let length = medium.length();
    let off = |exact: &Rational| {
        let rounded = format.ratio(exact).to_rational();
        rounded.map(|rounded| (rounded - exact).abs())
    };
    let rounding = format.rounding();
    // What interpolation makes of places that are rounded: a few roundings more.
    let few = Float::with_val(64, rounding.unit.max(rounding.log2_quantum.exp2())) * 4_u32;
    let few = few.to_rational().unwrap_or_default() * &length;
    (0..=n * u64::from(parts)).any(|i| {
        let place = Rational::from(&length * i) / n / parts;
        let by_place = match off(&place) {
            Some(off) if off == 0 => Rational::new(),
            _ => few.clone(),
        };
        edges.iter().any(|edge| {
            let Some(by_edge) = off(edge) else {
                return true;
            };
            let both = by_edge + &by_place;
            let distance = Rational::from(edge - &place).abs();
            both > 0 && distance <= both
        })
    })
}
