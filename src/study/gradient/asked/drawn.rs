//! One case of a kernel that draws random numbers: all seeds of every level.

use super::{Asked, Found, Level, cotangents, is_same};
use crate::convergence::{Replicas, fit_replicas};
use crate::kernel::{Cut, Kernel, Subject};
use crate::study::Progress;
use crate::study::gradient::along::Theory;
use crate::study::gradient::compare::Looked;
use crate::study::gradient::{
    Against, Bias, Derivative, Failure, GradientError, OfCase, Trouble, expected,
};

/// Of the resamples that intervals are made of.
const RESAMPLING: u64 = 29;
/// Fewer levels have no means that could be fitted.
const FEWEST: usize = 3;

/// Errors of every seed, by derivative and what they are summed with.
type Series = [[Vec<Replicas>; 2]; 2];

impl Asked<'_> {
    /// The mean over seeds beside theory.
    pub(in crate::study::gradient) fn drawn(
        &self,
        kernel: &mut dyn Kernel,
        subject: &Subject,
        progress: &dyn Progress,
    ) -> Result<OfCase, GradientError> {
        let theory = Theory::new(subject, self.declaration.wall())?;
        let cotangents = cotangents(subject.channels().len());
        let mut found = Found::default();
        let mut series = Series::default();
        let mut first = None;
        for cut in self.settings.cuts(subject.length()) {
            let level = Level::new(subject, cut).map_err(|error| GradientError::Cut {
                case: subject.name().into(),
                error,
            })?;
            let count = level.count;
            let asked = self.level(kernel, subject, (&level, &theory), &cotangents, &mut found);
            if let Some((answer, errors)) = asked {
                first.get_or_insert((level, answer));
                push(&mut series, errors);
            }
            progress.advance(count.saturating_mul(self.settings.replicas as u64));
        }
        // The same seed has the same answer.
        if let Some((level, answer)) = first {
            match level.ask(kernel, subject, &cotangents, 0) {
                Ok(again) if is_same(&again, &answer) => {}
                Ok(_) => found.troubles.push(Trouble::Unsteady),
                Err(error) => found.failures.push(Failure {
                    segments: level.count,
                    error,
                }),
            }
        }
        found.note_zeros();
        let biases = self.biases(subject, &found, &series)?;
        Ok(found.of_case(subject, cotangents, &theory, Vec::new(), biases))
    }

    /// All seeds of a level: the first answer, and the errors; `None` where a seed has no answer.
    fn level(
        &self,
        kernel: &mut dyn Kernel,
        subject: &Subject,
        (level, theory): (&Level, &Theory<'_>),
        cotangents: &[f64],
        found: &mut Found,
    ) -> Option<(super::Answered, Series)> {
        let samples = self.places.samples(&level.segments);
        let lengths = self.places.lengths(&level.segments);
        let (at, left_out) = self
            .places
            .looked_at(&level.segments, self.declaration.far_wall);
        let along = theory.at(&samples.lambda);
        found.count(&left_out, &lengths, along.error);
        let looked = Looked {
            along: &along,
            lengths: &lengths,
            at: &at,
            cotangents,
        };
        let floor = self.floor(level.count) + along.error;
        let n = match level.cut {
            Cut::Segments(n) => Some(n),
            Cut::Step(_) | Cut::Spaced(..) => None,
        };
        let mut series: [[Vec<f64>; 2]; 2] = Default::default();
        let mut first = None;
        for seed in 0..self.settings.replicas as u64 {
            let answer = match level.ask(kernel, subject, cotangents, seed) {
                Ok(answer) => answer,
                Err(error) => {
                    found.failures.push(Failure {
                        segments: level.count,
                        error,
                    });
                    return None;
                }
            };
            found.note(level.count, &looked, &answer);
            for derivative in Derivative::ALL {
                for against in Against::ALL {
                    let part = looked.part(&answer.1, derivative, against);
                    series[derivative as usize][against as usize].extend(part);
                }
            }
            first.get_or_insert(answer);
        }
        let replicas = |errors: Vec<f64>| {
            let level = Replicas {
                n,
                step: level.step,
                errors,
                floor,
            };
            // Theory is 0 there, or nothing is looked at.
            let is_there = !level.errors.is_empty();
            is_there.then_some(level).into_iter().collect()
        };
        Some((first?, series.map(|of| of.map(replicas))))
    }

    fn biases(
        &self,
        subject: &Subject,
        found: &Found,
        series: &Series,
    ) -> Result<Vec<Bias>, GradientError> {
        let mut biases = Vec::new();
        for derivative in Derivative::ALL {
            let expected = Some(expected(self.orders[derivative as usize], subject));
            let mut troubles = found.troubles.iter();
            let trouble = troubles.find(|trouble| trouble.concerns(derivative));
            for against in Against::ALL {
                let levels = &series[derivative as usize][against as usize];
                if levels.len() < FEWEST {
                    continue;
                }
                let fit = fit_replicas(levels, expected, RESAMPLING);
                let fit = fit.map_err(|error| GradientError::Replicas {
                    case: subject.name().into(),
                    error,
                })?;
                let failed = !found.failures.is_empty();
                let of = (derivative, against);
                biases.push(Bias::new(of, expected, fit, trouble, failed));
            }
        }
        Ok(biases)
    }
}

fn push(series: &mut Series, level: Series) {
    for (of, own) in series.iter_mut().flatten().zip(level.into_iter().flatten()) {
        of.extend(own);
    }
}
