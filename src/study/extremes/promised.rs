//! What format and method promise of an answer: what a run of the method in the format keeps.

use super::scenario::{emission, largest_extinction};
use crate::kernel::{Declaration, Quantity};
use crate::method::{
    Accumulation, Compositing, CompositingOrder, Method, OpacityFormula, Position, Summation,
};
use crate::real::{FormatName, Ieee};
use crate::study::run::Silent;
use crate::study::stress::{self, Kind, METHODS, Scenario, Settings, StressError, Verdict};

/// Exponents of a format that stands for MPFR, which has no ends within reach.
const FAR_END: i32 = 200_000;
/// Most bits of such a format.
const MOST_BITS: u32 = 64;
/// Digits that roundings of transmittances above 1 may cost where τ is below 0.
const AMPLIFIED: f64 = 1.0;

/// What may be lost of the answer to one scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Promise {
    /// Digits, of what the method gives without rounding.
    pub(super) digits: f64,
    /// Of 1 − e^(−x) as it is written, which cancels.
    pub(super) cancelling: f64,
    /// How far off an answer may be of which no digit is promised.
    pub(super) absolute: f64,
    /// What befalls the method itself in that format.
    pub(super) befell: Option<Verdict>,
}

impl Promise {
    /// Whether the method has no finite answer in that format either.
    pub(super) fn may_be_infinite(&self) -> bool {
        matches!(
            self.befell,
            Some(
                Verdict::NotANumber
                    | Verdict::Infinite
                    | Verdict::Overflow
                    | Verdict::Saturated
                    | Verdict::Oscillating
                    | Verdict::Refused
            )
        )
    }

    /// Whether no answer is far off.
    pub(super) fn is_void(&self) -> bool {
        self.befell.is_some() && !is_negative(self.befell) && !is_lost(self.befell)
    }
}

/// Opacities as they are written most often: 1 − e^(−x), in the middles of segments.
fn subtraction() -> Method {
    Method::Composited(Compositing {
        position: Position::Middle,
        opacity: OpacityFormula::Subtraction,
        order: CompositingOrder::FrontToBack {
            depth: Accumulation::Transmittances,
            summation: Summation::Naive,
            stop: None,
        },
    })
}

/// The methods that do not lose digits where rays are thin, of those whose roundoff is bounded.
fn keeping() -> impl Iterator<Item = Method> {
    let methods = METHODS.iter().filter_map(|name| name.parse().ok());
    methods.filter(|method| match method {
        Method::Composited(compositing) => matches!(
            compositing.opacity,
            OpacityFormula::Expm1 | OpacityFormula::Relative
        ),
        _ => true,
    })
}

/// The methods whose roundoff is promised, the weakest promise of all of them: the declared one, where its own is bounded;
/// where none is declared, all that keep digits in thin rays.
fn promising(declaration: &Declaration) -> Vec<Method> {
    match declaration.method {
        Some(method) if Kind::of(&method).is_ok() => vec![method],
        Some(_) => vec![subtraction()],
        None => keeping().collect(),
    }
}

/// The format, or the widest one with ends where it has none.
fn bounded(format: FormatName) -> Option<FormatName> {
    match format {
        FormatName::Mpfr(bits) => {
            let bits = bits.clamp(2, MOST_BITS);
            let format = Ieee::new(bits, -FAR_END, FAR_END).ok()?;
            Some(FormatName::Ieee(format))
        }
        other => Some(other),
    }
}

/// Of the radiance of every scenario.
pub(super) fn promises(
    declaration: &Declaration,
    scenarios: &[Scenario],
) -> Result<Vec<Promise>, StressError> {
    let run = |methods| {
        let settings = Settings {
            scenarios: scenarios.to_vec(),
            methods,
            formats: bounded(declaration.format).into_iter().collect(),
        };
        stress::run(&settings, &Silent)
    };
    let own = run(promising(declaration))?;
    let cancelling = run(vec![subtraction()])?;
    let of = |scenario: &Scenario| {
        let is_own = |cell: &&stress::Cell| cell.scenario == scenario.name;
        let own: Vec<&stress::Cell> = own.iter().filter(is_own).collect();
        // One that cannot run promises nothing, and befalls nobody else.
        let runs = |cell: &&&stress::Cell| cell.verdict != Some(Verdict::Refused);
        let befell = match own.iter().find(runs) {
            Some(cell) => cell.verdict,
            None => Some(Verdict::Refused),
        };
        let promised = own.iter().filter(runs).map(|cell| cell.promised);
        let promised = if is_lost(befell) {
            0.0
        } else {
            promised.fold(f64::INFINITY, f64::min)
        };
        let amplified = if is_negative(befell) { AMPLIFIED } else { 0.0 };
        let less = amplified + of_depth(declaration, scenario);
        let bright = emission(&scenario.medium).to_f64();
        let cancelling = cancelling.iter().find(is_own);
        Promise {
            digits: (promised - less).max(0.0),
            cancelling: cancelling.map_or(0.0, |cell| cell.promised),
            absolute: 8.0 * scenario.n as f64 * unit(declaration) * bright,
            befell,
        }
    };
    Ok(scenarios.iter().map(of).collect())
}

/// Digits that an unknown method may lose by e^(−t): a depth t is rounded to t u.
fn of_depth(declaration: &Declaration, scenario: &Scenario) -> f64 {
    match declaration.method {
        Some(method) if Kind::of(&method).is_err() => {
            let largest = largest_extinction(&scenario.medium).to_f64();
            largest.max(1.0).log10()
        }
        _ => 0.0,
    }
}

/// Numbers became too small beside others: digits are lost, but what is left is no larger than that.
fn is_lost(befell: Option<Verdict>) -> bool {
    matches!(
        befell,
        Some(Verdict::Absorbed | Verdict::Underflow | Verdict::Stalled)
    )
}

/// τ below 0, which is a matter of its own.
fn is_negative(befell: Option<Verdict>) -> bool {
    matches!(
        befell,
        Some(Verdict::NegativeMedium | Verdict::NegativeRadiance)
    )
}

/// How far off another quantity may be: 1 − T and −ln T are known to a unit of 1, and sums of n terms are rounded n times.
pub(super) fn absolute(
    declaration: &Declaration,
    quantity: Quantity,
    scenario: &Scenario,
    size: f64,
) -> f64 {
    let roundings = 4.0 * scenario.n as f64 + 16.0;
    match quantity {
        Quantity::ExpectedDepth | Quantity::Emission => f64::INFINITY,
        Quantity::Radiance | Quantity::Opacity | Quantity::OpticalDepth => {
            roundings * unit(declaration) * size.max(1.0)
        }
    }
}

/// 2^(−p) of the declared format.
fn unit(declaration: &Declaration) -> f64 {
    (-f64::from(declaration.format.bits())).exp2()
}
