//! A model of a method's error in a format: where roundoff overtakes discretization, and how good it can get.
//!
//! |e|² ≈ D(n)² + (cᵢ u n^qᵢ)² + (cₐ u n^qₐ)², with the discretization error D as measured and carried
//! on by its order, and laws fitted to input and arithmetic rounding, which no number of segments makes vanish. It is a model: fitted where both
//! are seen, it tells of n and of formats that were not run.

mod curve;
mod law;

pub use law::RoundoffLaw;

use super::Split;
use super::sample::log2_abs;
use curve::Curve;
use rug::Float;
use serde::Serialize;

/// Numbers of segments are looked for up to 2^this.
const MOST_LOG2_SEGMENTS: f64 = 60.0;
/// Steps a doubling of n in which they are looked for.
const STEPS: u32 = 32;
/// The least exponents with which rounding is carried on beyond the finest level: independent errors of n samples have −½ in
/// their mean, and what arithmetic rounds last is rounded at every n. A few levels that scatter may show less.
const LEAST_INPUT: f64 = -0.5;
const LEAST_ARITHMETIC: f64 = 0.0;
/// Most bits that a tolerance may need.
const MOST_BITS: u32 = 1 << 20;

/// What splits over a ladder tell of a method on a case in a format.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorModel {
    bits: u32,
    discretization: Option<Curve>,
    /// log₂ of the coarsest level and of the finest.
    first: f64,
    last: f64,
    /// What became of rounding.
    pub laws: Laws,
}

/// How the parts of roundoff grow with n; `None` where there is too little of one to fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Laws {
    /// Input rounding.
    pub input: Option<RoundoffLaw>,
    /// Arithmetic rounding.
    pub arithmetic: Option<RoundoffLaw>,
    /// Arithmetic rounding that comes of the transmittances.
    pub of_depth: Option<RoundoffLaw>,
    /// Arithmetic rounding that comes of summing the radiance.
    pub of_radiance: Option<RoundoffLaw>,
}

/// The least error that a method can reach in a format.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Best {
    /// log₂ of the number of segments.
    pub log2_n: f64,
    /// log₂ of the error, as a root mean square over neighbouring n.
    pub log2_error: f64,
}

impl ErrorModel {
    /// The model of these splits, n ascending, in a format of `bits` bits; `order` is that of the
    /// discretization beyond the finest level, where a fit or theory knows one.
    #[must_use]
    pub fn new(splits: &[(u64, &Split)], bits: u32, order: Option<f64>) -> Self {
        let law = |part: &dyn Fn(&Split) -> Option<Float>| {
            let errors: Vec<_> = splits
                .iter()
                .filter_map(|(n, split)| Some((*n, part(split)?, split.resolution.clone())))
                .collect();
            RoundoffLaw::fit(&errors, bits)
        };
        let points: Vec<(f64, f64)> = splits
            .iter()
            .filter(|(_, split)| {
                split
                    .discretization
                    .cmp_abs(&split.resolution)
                    .is_some_and(std::cmp::Ordering::is_gt)
            })
            .map(|(n, split)| ((*n as f64).log2(), log2_abs(&split.discretization)))
            .collect();
        ErrorModel {
            bits,
            discretization: Curve::new(&points, order),
            first: splits.first().map_or(0.0, |(n, _)| (*n as f64).log2()),
            last: splits.last().map_or(0.0, |(n, _)| (*n as f64).log2()),
            laws: Laws {
                input: law(&|split| Some(split.input.clone())),
                arithmetic: law(&|split| Some(split.arithmetic.clone())),
                of_depth: law(&|split| split.of_depth.clone()),
                of_radiance: law(&|split| Some(split.of_radiance())),
            },
        }
    }

    /// log₂ of the discretization error at n = 2^`log2_n`; −∞ where there is none.
    #[must_use]
    pub fn log2_discretization(&self, log2_n: f64) -> f64 {
        self.discretization
            .as_ref()
            .map_or(f64::NEG_INFINITY, |curve| curve.at(log2_n))
    }

    /// log₂ of input and arithmetic rounding together with `bits` bits, as a root mean square.
    #[must_use]
    pub fn log2_rounding(&self, log2_n: f64, bits: f64) -> f64 {
        let [input, arithmetic] = self.rounding(log2_n, bits);
        log2_hypot(input, arithmetic)
    }

    /// The same of input and of arithmetic.
    fn rounding(&self, log2_n: f64, bits: f64) -> [f64; 2] {
        let beyond = (log2_n - self.last).max(0.0);
        let at = |law: Option<RoundoffLaw>, least: f64| {
            law.map_or(f64::NEG_INFINITY, |law| {
                law.log2_at(log2_n - beyond, bits) + beyond * law.exponent.max(least)
            })
        };
        [
            at(self.laws.input, LEAST_INPUT),
            at(self.laws.arithmetic, LEAST_ARITHMETIC),
        ]
    }

    /// log₂ of the whole error in the format, as a root mean square.
    #[must_use]
    pub fn log2_error(&self, log2_n: f64) -> f64 {
        let rounding = self.log2_rounding(log2_n, f64::from(self.bits));
        log2_hypot(self.log2_discretization(log2_n), rounding)
    }

    /// n*: from there on roundoff is larger than discretization. `None` where one of them is unknown or
    /// nothing, or where that is below the coarsest level or beyond 2⁶⁰.
    #[must_use]
    pub fn crossing(&self) -> Option<f64> {
        let bits = f64::from(self.bits);
        let discretizes = |log2_n: f64| {
            let [input, arithmetic] = self.rounding(log2_n, bits);
            is_above(self.log2_discretization(log2_n), input, arithmetic)
        };
        if self.log2_rounding(self.first, bits) == f64::NEG_INFINITY {
            return None;
        }
        let coarser = self
            .grid()
            .take_while(|log2_n| *log2_n < MOST_LOG2_SEGMENTS);
        let last = coarser.filter(|log2_n| discretizes(*log2_n)).last()?;
        (last + 1.0 / f64::from(STEPS) < MOST_LOG2_SEGMENTS).then(|| last.exp2())
    }

    /// The best that the method can do in the format, by the model.
    #[must_use]
    pub fn best(&self) -> Option<Best> {
        self.best_with(f64::from(self.bits))
    }

    fn best_with(&self, bits: f64) -> Option<Best> {
        let mut best: Option<Best> = None;
        for log2_n in self.grid() {
            let discretization = self.log2_discretization(log2_n);
            let parts = self.rounding(log2_n, bits);
            // Where one part alone is worse, the sum need not be known, which takes exponentials and logarithms.
            let alone = discretization.max(parts[0]).max(parts[1]);
            if best.is_some_and(|best| alone > best.log2_error) {
                continue;
            }
            let log2_error = log2_hypot(discretization, log2_hypot(parts[0], parts[1]));
            let is_better = best.is_none_or(|best| log2_error.total_cmp(&best.log2_error).is_lt());
            if log2_error.is_finite() && is_better {
                best = Some(Best { log2_n, log2_error });
            }
        }
        best
    }

    /// The fewest bits with which some n reaches an error of 2^`log2_tolerance`, by the model.
    #[must_use]
    pub fn bits_for(&self, log2_tolerance: f64) -> Option<u32> {
        let [bits] = self.bits_for_each([log2_tolerance]);
        bits
    }

    /// The same of several.
    #[must_use]
    pub fn bits_for_each<const N: usize>(&self, log2_tolerances: [f64; N]) -> [Option<u32>; N] {
        let all: Vec<(f64, f64)> = self
            .grid()
            .map(|log2_n| (log2_n, self.log2_discretization(log2_n)))
            .collect();
        log2_tolerances.map(|tolerance| self.fewest_bits(&all, tolerance))
    }

    /// The same where discretization is known at these n.
    fn fewest_bits(&self, discretizations: &[(f64, f64)], tolerance: f64) -> Option<u32> {
        // Where discretization alone is too much, no number of bits helps.
        let fine = || {
            let all = discretizations.iter();
            all.filter(|(_, discretization)| *discretization <= tolerance)
        };
        let reaches = |bits: u32| {
            fine().any(|&(log2_n, discretization)| {
                let [input, arithmetic] = self.rounding(log2_n, f64::from(bits));
                if input.max(arithmetic) > tolerance {
                    return false;
                }
                let error = log2_hypot(discretization, log2_hypot(input, arithmetic));
                error.is_finite() && error <= tolerance
            })
        };
        // With fewer bits one part of rounding alone is too much at every n.
        let at_least = fine().map(|&(log2_n, _)| {
            let [input, arithmetic] = self.rounding(log2_n, 0.0);
            input.max(arithmetic) - tolerance
        });
        let at_least = at_least.fold(f64::INFINITY, f64::min);
        if at_least > f64::from(MOST_BITS) {
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturating, and at most MOST_BITS"
        )]
        let mut low = (at_least.max(2.0) as u32).saturating_sub(1).max(1);
        let (mut high, mut step) = (low + 1, 1);
        // More bits never make it worse.
        while !reaches(high) {
            if high >= MOST_BITS {
                return None;
            }
            (low, step) = (high, 2 * step);
            high = (low + step).min(MOST_BITS);
        }
        while high - low > 1 {
            let middle = u32::midpoint(low, high);
            if reaches(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(high)
    }

    /// log₂ n from the coarsest level up.
    fn grid(&self) -> impl Iterator<Item = f64> {
        let first = self
            .discretization
            .as_ref()
            .map_or(self.first, Curve::first);
        let steps = f64::from(STEPS);
        (0_u32..)
            .map(move |i| first + f64::from(i) / steps)
            .take_while(|log2_n| *log2_n <= MOST_LOG2_SEGMENTS)
    }
}

/// log₂ √(4^a + 4^b).
fn log2_hypot(a: f64, b: f64) -> f64 {
    let (large, small) = if a > b { (a, b) } else { (b, a) };
    if large == f64::NEG_INFINITY {
        return large;
    }
    large + 0.5 * (2.0 * (small - large)).exp2().ln_1p() / std::f64::consts::LN_2
}

/// Whether x > log₂ √(4^a + 4^b), which lies between the larger of both and ½ more: mostly that says it.
fn is_above(x: f64, a: f64, b: f64) -> bool {
    let large = a.max(b);
    if x <= large {
        return false;
    }
    x > large + 1.0 || x > log2_hypot(a, b)
}
