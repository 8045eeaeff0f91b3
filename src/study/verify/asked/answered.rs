//! What comes of a kernel's answers.

use super::resolved::Middles;
use super::sampled;
use super::{Answers, Asked, Level, Wanted, depth_rule};
use crate::convergence::{FitError, Replicas, Sample, fit, fit_replicas, reported_error};
use crate::kernel::{Cut, FormKind, KernelError, Quantity, Rendering};
use crate::method::{Expected, Method};
use crate::study::verify::line::{Failure, LevelRadiances, Line, Measured, Radiances};
use crate::study::verify::nominal::{self, Given, Nominal};
use crate::study::verify::peer::Peer;
use crate::study::verify::peers::Peers;
use crate::study::verify::remark::{Seen, remarks};
use crate::study::verify::standing::{self, Judged};
use crate::study::verify::{Axis, VerifyError, expectation, truth};
use rug::{Float, Rational};

/// Bits of references beyond those of the kernel's format.
const REFERENCE_BITS: u32 = 75;

/// One level of a channel.
struct Looked {
    radiances: LevelRadiances,
    /// Of samples in the middles of segments.
    middles: f64,
    /// Whether the answer is the declared method's; `None` where that has none.
    as_declared: Option<bool>,
}

impl Asked<'_> {
    /// What one channel shows, or another quantity; `None` where that has no value on this ray.
    pub(in crate::study::verify) fn line(
        &self,
        wanted: &Wanted,
        answers: &Answers,
    ) -> Result<Option<Line>, VerifyError> {
        let bits = self.declaration.format.bits().max(f64::MANTISSA_DIGITS);
        let bits = bits + REFERENCE_BITS;
        let Some((exact, unproved)) = truth::of(wanted, bits, self.declaration.wall())? else {
            return Ok(None);
        };
        let stepwise = match self.levels.first().map(|level| &level.volume) {
            Some(Some(volume)) if self.settings.axis == Axis::Step => {
                let length = self.subject.length();
                truth::of_volume(volume, length, wanted, bits)
            }
            _ => exact,
        };
        let of_tables = self.of_tables(wanted.channel)?;
        let mut radiances = Radiances::new(stepwise);
        let mut middles = Middles::default();
        let mut failures = Vec::new();
        let mut in_range = true;
        let mut as_declared = Vec::new();
        for (place, (level, renderings)) in self.levels.iter().zip(&answers.levels).enumerate() {
            let whole: Result<Vec<&Rendering>, &KernelError> =
                renderings.iter().map(Result::as_ref).collect();
            let renderings = match whole.and_then(|whole| answers.are_of(wanted, place, whole)) {
                Ok(renderings) => renderings,
                Err(error) => {
                    let n = level.count;
                    failures.push(Failure::new(n, error));
                    continue;
                }
            };
            // An opacity that nobody declared need not be there.
            let is_there = renderings.iter().all(|one| wanted.of(one).is_some());
            if renderings.is_empty() || !is_there {
                continue;
            }
            let Looked {
                radiances: seen,
                middles: of_middles,
                as_declared: agrees,
            } = self.looked(level, &renderings, wanted, &radiances.exact, of_tables)?;
            as_declared.push(agrees);
            let finite = |nominal: &Nominal| nominal.in_format.is_finite();
            in_range = in_range && seen.nominal.as_ref().is_none_or(finite);
            if self.declaration.stochastic {
                middles.push(seen.n, seen.step, of_middles, &radiances.exact, &seen.floor);
            }
            radiances.push(seen);
        }
        let mut spots = Radiances::new(radiances.exact.clone());
        for (spot, answer) in self.spots.iter().zip(&answers.spots) {
            match answer {
                Ok(rendering) if wanted.of(rendering).is_none() => {}
                Ok(rendering) => {
                    let exact = &radiances.exact;
                    let looked = self.looked(spot, &[rendering], wanted, exact, of_tables)?;
                    spots.push(looked.radiances);
                }
                Err(error) => failures.push(Failure::new(spot.count, error)),
            }
        }
        let steady = is_steady(wanted, answers, self.declaration.noise);
        let is_compared = steady && failures.is_empty() && self.is_compared(&radiances);
        let all: Option<Vec<bool>> = as_declared.into_iter().collect();
        let all = all.filter(|all| is_compared && !all.is_empty());
        Ok(Some(Line {
            unproved,
            as_declared: all.map(|all| all.into_iter().all(|agrees| agrees)),
            ..self.judged(
                wanted,
                (radiances, &spots),
                failures,
                (steady, in_range, middles.are_resolved()),
            )?
        }))
    }

    /// Whether answers say something of the method that is declared.
    fn is_compared(&self, radiances: &Radiances) -> bool {
        let says = !radiances.exact.is_zero() && radiances.are_finite();
        says && !self.declaration.stochastic && self.settings.axis == Axis::Step
    }

    /// What was answered to one level, and how the ray is cut there.
    fn looked(
        &self,
        level: &Level,
        renderings: &[&Rendering],
        wanted: &Wanted,
        exact: &Float,
        of_tables: f64,
    ) -> Result<Looked, VerifyError> {
        let used = self.used(level, renderings.first().copied())?;
        let count = used.count;
        let is_uneven = used.is_adaptive || matches!(level.cut, Cut::Spaced(..));
        let brightest = self.brightest(level, &used.segments);
        let segments = wanted.lit(used.segments);
        let channel = wanted.channel;
        let given = Given {
            case: &wanted.case,
            segments: &segments,
            step: used.step,
            channel,
            uniform: used.is_uniform.then_some(count),
        };
        let nominal = self.nominal(wanted, &given);
        let values = renderings.iter().filter_map(|one| wanted.of(one).cloned());
        let values: Vec<Float> = values.collect();
        let (n, step) = self.coordinate(level, count, given.step);
        let allowance = self.allowance(wanted, exact, &given, brightest);
        let mut floor = self.floor(wanted, exact, level, nominal.as_ref(), &given, allowance);
        floor += self.not_refined(level, &given)? + of_tables;
        // Of a volume a method that is no rule has not the samples.
        let has_samples =
            level.volume.is_none() || nominal.as_ref().is_some_and(Nominal::is_of_samples);
        let model = nominal.as_ref().filter(|_| has_samples).zip(values.first());
        let scale = exact.to_f64().abs();
        let as_declared = model.map(|(nominal, value)| {
            let allowance = allowance.whole();
            nominal.agrees(value.to_f64(), scale, &given, self.declaration, allowance)
        });
        let middles = if self.declaration.stochastic {
            sampled::by_middles(wanted, &segments, given.step, channel)
        } else {
            f64::NAN
        };
        let reported = renderings.iter().filter_map(|rendering| {
            let errors = rendering.standard_error.as_ref()?;
            let of_radiance = wanted.quantity == Quantity::Radiance;
            errors.get(channel).copied().filter(|_| of_radiance)
        });
        Ok(Looked {
            radiances: LevelRadiances {
                segments: count,
                uneven: is_uneven.then_some(segments),
                n,
                step,
                values,
                floor,
                stored: allowance.stored,
                nominal,
                reported: reported.collect(),
            },
            middles,
            as_declared,
        })
    }

    /// What the declared method gives of a quantity, where that follows from its name.
    ///
    /// A composite has the opacity that its weights add up to, and sums its depth; whatever else a kernel makes of a method is
    /// its own matter.
    fn nominal(&self, wanted: &Wanted, given: &Given<'_>) -> Option<Nominal> {
        match (wanted.quantity, self.declaration.method) {
            (Quantity::Radiance, Some(Method::Composited(_))) if wanted.background != 0.0 => {
                Some(nominal::at_level(self.declaration, given)?.before(wanted.background))
            }
            (Quantity::Radiance, _) if wanted.background != 0.0 => None,
            (Quantity::Radiance, _) | (Quantity::Opacity, Some(Method::Composited(_))) => {
                nominal::at_level(self.declaration, given)
            }
            (
                Quantity::OpticalDepth | Quantity::Emission,
                Some(Method::Composited(compositing)),
            ) => {
                let (place, _) = depth_rule(&compositing)?;
                Some(nominal::depth_at_level(self.declaration, given, place))
            }
            _ => None,
        }
    }

    /// The methods that a channel is measured by: the declared one, or those of the declared order on rays that these can
    /// be run on. None where random numbers are drawn: one run shows no order.
    fn peers(
        &self,
        wanted: &Wanted,
        radiances: &Radiances,
        levels: &[(u64, Sample)],
        expected: Option<Expected>,
    ) -> Result<Peers, FitError> {
        if self.declaration.stochastic {
            return Ok(Peers::None);
        }
        // Against another order than its own the method is no measure.
        if self.settings.expect.is_none() {
            let exact = radiances.nominal_samples(|nominal| &nominal.exact);
            let in_format = radiances.nominal_samples(|nominal| &nominal.in_format);
            if let (Some(exact), Some(in_format)) = (exact, in_format) {
                return Peers::of_method(exact, in_format, expected);
            }
        }
        let runs = self.settings.axis == Axis::Step
            && self.declaration.form != FormKind::Volume
            && !self.declaration.far_wall;
        let order = match expected {
            Some(Expected::Order(order)) if runs => Some(order),
            Some(Expected::Unknown) if runs => {
                let expect = self.settings.expect.as_ref().map(Rational::to_f64);
                expect.or(self.declaration.claimed_order())
            }
            _ => None,
        };
        let format = self.declaration.format;
        let uneven = radiances.uneven();
        order.map_or(Ok(Peers::None), |order| {
            let methods = if uneven.is_empty() {
                wanted.methods(order)
            } else {
                wanted.methods_between(order, &uneven)
            };
            Peers::of_order(&methods, expected, format, &radiances.exact, levels)
        })
    }

    /// As [`Line::right_to_quantum`].
    fn right_to_quantum(
        quantum: Option<f64>,
        levels: &[(u64, Sample)],
        peers: &[Peer],
    ) -> Option<bool> {
        let quantum = quantum?;
        let size = |sample: &Sample| sample.error.to_f64().abs();
        let (_, finest) = levels.last()?;
        let of_peers = peers
            .iter()
            .filter_map(|peer| peer.samples.last())
            .map(size);
        let largest = of_peers.reduce(f64::max)?;
        (largest < quantum / 2.0).then(|| size(finest) <= quantum)
    }

    fn judged(
        &self,
        wanted: &Wanted,
        (radiances, spots): (Radiances, &Radiances),
        failures: Vec<Failure>,
        (steady, in_range, resolved): (bool, bool, bool),
    ) -> Result<Line, VerifyError> {
        let expected = expectation::of(self.declaration, self.settings, wanted);
        let name = wanted.name.clone();
        let mut reported = None;
        let measured = if self.declaration.stochastic {
            let levels: Vec<Replicas> = radiances.replicas();
            reported = reported_error(&levels, &radiances.reported(), 0);
            if levels.len() < 3 {
                Measured::Nothing
            } else {
                let fitted = fit_replicas(&levels, expected, 0);
                Measured::Scattered(Box::new(fitted.map_err(|error| VerifyError::Replicas {
                    case: name.clone(),
                    error,
                })?))
            }
        } else {
            let samples: Vec<Sample> = radiances.samples();
            let fitted = fit(&samples, expected).map_err(|error| VerifyError::Fit {
                case: name.clone(),
                error,
            })?;
            Measured::Fitted {
                fit: Box::new(fitted),
                samples,
            }
        };
        let fit_error = |error| VerifyError::Fit {
            case: name.clone(),
            error,
        };
        let levels = radiances.counted_samples();
        let quantum = radiances.quantum();
        let peers = self.peers(wanted, &radiances, &levels, expected);
        let peers = peers.map_err(fit_error)?;
        let beside = spots.counted_samples();
        let of_spots = self.peers(wanted, spots, &beside, expected);
        let of_spots = of_spots.map_err(fit_error)?;
        let exact = &radiances.exact;
        let seen = peers.beside(exact, &levels);
        // Of few uneven segments each rule makes something else.
        let remarks = if radiances.uneven().is_empty() {
            remarks(&seen, &of_spots.beside(exact, &beside))
        } else {
            Vec::new()
        };
        // What scatters may do so about 1.
        let is_bounded = wanted.quantity == Quantity::Opacity && !self.declaration.stochastic;
        let outside = is_bounded
            .then(|| radiances.outside_of_opacities())
            .flatten();
        let standing = standing::of(&Judged {
            measured: &measured,
            expected,
            failures: &failures,
            of_method: peers.verdict_of_method(),
            of_order: &peers.verdicts_of_order(),
            resolvable: peers.resolvable(expected),
            in_range,
            sound: steady && remarks.is_empty() && outside.is_none(),
            resolved,
            reported,
        });
        Ok(Line {
            name,
            quantity: wanted.quantity,
            outside,
            expected,
            exact: radiances.exact,
            unproved: Vec::new(),
            as_declared: None,
            measured,
            failures,
            is_required: peers.all_show(expected),
            is_as_good: seen.last().is_some_and(Seen::is_as_good),
            right_to_quantum: Self::right_to_quantum(quantum, &levels, peers.all()),
            remarks,
            steady,
            reported,
            standing,
        })
    }
}

/// Whether a kernel answers the same twice: one that draws random numbers to the same seed.
fn is_steady(wanted: &Wanted, answers: &Answers, noise: Option<f64>) -> bool {
    let first = answers.levels.first().and_then(|level| level.first());
    match (first, &answers.again) {
        (Some(Ok(first)), Some(Ok(again))) => {
            let (first, again) = (wanted.of(first), wanted.of(again));
            let are_none = |one: Option<&Float>| one.is_some_and(Float::is_nan);
            // Both are off by no more than that.
            let is_noise = |noise: f64| {
                let both = first.zip(again);
                both.is_some_and(|(first, again)| {
                    Float::with_val(first.prec(), first - again).abs() <= 2.0 * noise
                })
            };
            first == again || (are_none(first) && are_none(again)) || noise.is_some_and(is_noise)
        }
        _ => true,
    }
}
