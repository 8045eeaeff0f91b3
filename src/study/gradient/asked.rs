//! One case, asked level by level.

mod drawn;

use super::along::Theory;
use super::compare::{Looked, numbers};
use super::{
    Bias, Derivative, Failure, GradientError, LeftOut, LevelError, Line, Norm, OfCase, Places,
    Standing, Trouble, expected,
};
use crate::convergence::{Sample, fit};
use crate::kernel::{
    Cut, Data, Declaration, Gradient, Kernel, KernelError, Rendering, Segments, Subject, Task,
};
use crate::study::Progress;
use crate::study::verify::Settings;
use rug::Float;

/// Bits of errors.
const BITS: u32 = f64::MANTISSA_DIGITS;

/// What is asked of every case.
pub(super) struct Asked<'a> {
    pub(super) declaration: &'a Declaration,
    pub(super) settings: &'a Settings,
    pub(super) places: Places,
    pub(super) orders: [f64; 2],
}

/// Errors by derivative and norm.
type Series = [[Vec<Sample>; 2]; 2];

/// An answer with its gradient.
type Answered = (Rendering, Gradient);

/// What is found on the way.
#[derive(Default)]
struct Found {
    series: Series,
    left_out: LeftOut,
    samples: usize,
    failures: Vec<Failure>,
    troubles: Vec<Trouble>,
    integrated: f64,
    /// Whether all derivatives were 0 at all levels, where theory has others.
    is_zero: [Option<bool>; 2],
}

impl Asked<'_> {
    pub(super) fn of(
        &self,
        kernel: &mut dyn Kernel,
        subject: &Subject,
        progress: &dyn Progress,
    ) -> Result<OfCase, GradientError> {
        let cut_error = |error| GradientError::Cut {
            case: subject.name().into(),
            error,
        };
        let theory = Theory::new(subject, self.declaration.wall())?;
        let cotangents = cotangents(subject.channels().len());
        let mut found = Found::default();
        let mut first = None;
        for cut in self.settings.cuts(subject.length()) {
            let level = Level::new(subject, cut).map_err(cut_error)?;
            let level_count = level.count;
            match level.ask(kernel, subject, &cotangents, 0) {
                Ok(answer) => {
                    self.look(&level, &theory, &cotangents, &answer, &mut found);
                    first.get_or_insert((level, answer));
                }
                Err(error) => found.failures.push(Failure {
                    segments: level.count,
                    error,
                }),
            }
            progress.advance(level_count);
        }
        // After all others: what keeps something of an answer for the next has another one by now.
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
        let lines = self.lines(subject, &found)?;
        Ok(found.of_case(subject, cotangents, &theory, lines, Vec::new()))
    }

    /// What one level shows.
    fn look(
        &self,
        level: &Level,
        theory: &Theory<'_>,
        cotangents: &[f64],
        answer: &Answered,
        found: &mut Found,
    ) {
        let segments = level.count;
        let samples = self.places.samples(&level.segments);
        let lengths = self.places.lengths(&level.segments);
        let (at, left_out) = self
            .places
            .looked_at(&level.segments, self.declaration.far_wall);
        let along = theory.at(&samples.lambda);
        let looked = Looked {
            along: &along,
            lengths: &lengths,
            at: &at,
            cotangents,
        };
        let left_out = LeftOut {
            flat: looked.flat(&answer.1),
            ..left_out
        };
        found.count(&left_out, &lengths, along.error);
        found.note(segments, &looked, answer);
        for derivative in Derivative::ALL {
            let errors = looked.errors(&answer.1, derivative);
            let floor = self.floor(segments) + along.error / looked.scale(derivative);
            for norm in Norm::ALL {
                let Some(error) = errors.norm(norm) else {
                    continue;
                };
                found.series[derivative as usize][norm as usize].push(Sample {
                    n: match level.cut {
                        Cut::Segments(n) => Some(n),
                        Cut::Step(_) | Cut::Spaced(..) => None,
                    },
                    step: level.step,
                    error: Float::with_val(BITS, error),
                    floor: Float::with_val(BITS, floor),
                });
            }
        }
    }

    /// Roundings of as many segments, by chance up and down, as a part of the scale.
    fn floor(&self, segments: u64) -> f64 {
        let unit = (-f64::from(self.declaration.format.bits())).exp2();
        unit * (segments as f64).sqrt()
    }

    fn lines(&self, subject: &Subject, found: &Found) -> Result<Vec<Line>, GradientError> {
        let mut lines = Vec::new();
        for derivative in Derivative::ALL {
            let expected = Some(expected(self.orders[derivative as usize], subject));
            let mut troubles = found.troubles.iter();
            let trouble = troubles.find(|trouble| trouble.concerns(derivative));
            for norm in Norm::ALL {
                let samples = found.series[derivative as usize][norm as usize].clone();
                let fit = fit(&samples, expected).map_err(|error| GradientError::Fit {
                    case: subject.name().into(),
                    error,
                })?;
                let failed = !found.failures.is_empty();
                let standing = Standing::of(fit.verdict, expected, trouble, failed);
                lines.push(Line {
                    derivative,
                    norm,
                    expected,
                    fit,
                    samples,
                    standing,
                });
            }
        }
        Ok(lines)
    }
}

impl Found {
    /// What no error is measured at, and how well theory is known.
    fn count(&mut self, left_out: &LeftOut, lengths: &[Option<f64>], error: f64) {
        self.left_out.kinks += left_out.kinks;
        self.left_out.flat += left_out.flat;
        self.left_out.wall += left_out.wall;
        self.left_out.uneven += left_out.uneven;
        self.samples += lengths.iter().flatten().count();
        self.integrated = self.integrated.max(error);
    }

    /// What is wrong with an answer whatever its errors are.
    fn note(&mut self, segments: u64, looked: &Looked<'_>, (rendering, gradient): &Answered) {
        let has_value = rendering.radiance.iter().all(Float::is_finite);
        // The first of a kind says enough.
        let mut add = |trouble: Trouble, is_same: &dyn Fn(&Trouble) -> bool| {
            if !self.troubles.iter().any(is_same) {
                self.troubles.push(trouble);
            }
        };
        for derivative in Derivative::ALL {
            if has_value && !numbers(gradient, derivative).all(Float::is_finite) {
                let trouble = Trouble::NotFinite {
                    derivative,
                    segments,
                };
                add(trouble, &|known| {
                    known.name() == trouble.name() && known.concerns(derivative)
                });
            }
        }
        if looked.has_unused(gradient) {
            let trouble = Trouble::Unused { segments };
            add(trouble, &|known| known.name() == trouble.name());
        }
        for derivative in Derivative::ALL {
            let all_zero = numbers(gradient, derivative).all(Float::is_zero);
            if !looked.is_zero(derivative) {
                let before = self.is_zero[derivative as usize].unwrap_or(true);
                self.is_zero[derivative as usize] = Some(before && all_zero);
            }
        }
    }

    /// Derivatives that were 0 in all answers.
    fn note_zeros(&mut self) {
        for derivative in Derivative::ALL {
            if self.is_zero[derivative as usize] == Some(true) {
                self.troubles.push(Trouble::Zero(derivative));
            }
        }
    }

    fn of_case(
        self,
        subject: &Subject,
        cotangents: Vec<f64>,
        theory: &Theory<'_>,
        lines: Vec<Line>,
        biases: Vec<Bias>,
    ) -> OfCase {
        OfCase {
            name: subject.name().into(),
            channels: subject.channels().to_vec(),
            cotangents,
            unproved: theory.unproved.clone(),
            integrated: (self.integrated > 0.0).then_some(self.integrated),
            left_out: self.left_out,
            samples: self.samples,
            failures: self.failures,
            troubles: self.troubles,
            lines,
            biases,
        }
    }
}

/// One cut of a ray.
struct Level {
    cut: Cut,
    step: f64,
    count: u64,
    segments: Segments,
}

impl Level {
    fn new(subject: &Subject, cut: Cut) -> Result<Self, crate::kernel::CutError> {
        let (step, count) = cut.on(subject.length())?;
        Ok(Level {
            cut,
            step: step.to_f64(),
            count,
            segments: subject.segments(cut)?,
        })
    }

    fn ask(
        &self,
        kernel: &mut dyn Kernel,
        subject: &Subject,
        cotangents: &[f64],
        seed: u64,
    ) -> Result<Answered, LevelError> {
        let task = Task {
            subject,
            step: self.step,
            segments: self.count,
            seed,
            data: Data::Segments(&self.segments),
        };
        let (rendering, gradient) = kernel.gradient(&task, cotangents)?;
        let at = kernel
            .declaration()
            .gradient
            .ok_or(KernelError::NoGradient)?;
        // Those inside the process have not been checked.
        let gradient = gradient.checked(at, &self.segments, subject.channels().len())?;
        // Exactly: it is said to be the same number.
        #[allow(clippy::float_cmp)]
        let other_step = rendering.step.is_some_and(|step| step != self.step);
        let other_count = rendering.segments.is_some_and(|count| count != self.count);
        if other_step || other_count || rendering.edges.is_some() {
            return Err(LevelError::OtherCut);
        }
        Ok((rendering, gradient))
    }
}

/// Others for every channel, of both signs and none of 1: what leaves them out, or takes one for another, shows.
fn cotangents(channels: usize) -> Vec<f64> {
    let of = |channel: usize| {
        let size = 0.75 + 0.5 * channel as f64;
        if channel.is_multiple_of(2) {
            size
        } else {
            -size
        }
    };
    (0..channels).map(of).collect()
}

/// Whether two answers are the same, NaN being the same as NaN.
fn is_same(a: &Answered, b: &Answered) -> bool {
    let same = |a: &Float, b: &Float| a == b || (a.is_nan() && b.is_nan());
    let all = |answer: &Answered| -> Vec<Float> {
        let (rendering, gradient) = answer;
        let radiance = rendering.radiance.iter();
        let of = |derivative| numbers(gradient, derivative);
        let derivatives = Derivative::ALL.into_iter().flat_map(of);
        radiance.chain(derivatives).cloned().collect()
    };
    let (a, b) = (all(a), all(b));
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| same(a, b))
}
