//! Asking a kernel, and counting what it costs.

use super::pose::{Made, Pose, Posed};
use super::ray::{Emission, Layers, Ray};
use super::rule::Channels;
use super::silence::Silence;
use crate::kernel::{Gradient, GradientAt, Kernel, KernelError, Rendering, Task};
use std::num::NonZeroUsize;
use std::ops::Range;
use std::time::{Duration, Instant};

/// What may be spent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Rays.
    pub rays: u64,
    /// Time.
    pub time: Duration,
    /// The most channels of one ray.
    pub channels: usize,
}

impl Default for Budget {
    fn default() -> Self {
        Budget {
            rays: 1_000,
            time: Duration::from_secs(600),
            channels: 66,
        }
    }
}

/// What was spent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spent {
    /// Rays.
    pub rays: u64,
    /// Segments of all of them.
    pub segments: u64,
    /// Segments of the longest.
    pub longest: u64,
    /// Rays without an answer.
    pub unanswered: u64,
}

/// Fewer rays than this are for the first questions only.
const SHORT: u64 = 70;
/// Channels that every renderer takes.
const FEW: usize = 3;

/// The answers of channels, where they stand, and the opacity.
pub(super) type Answer = (Vec<f64>, Option<f64>);

/// A conversation with a kernel.
pub(super) struct Session<'k> {
    kernel: &'k mut dyn Kernel,
    budget: Budget,
    started: Instant,
    pub(super) spent: Spent,
    /// Every question is asked twice, and the second answer counts.
    pub(super) twice: bool,
    /// Where the answers of channels stand.
    pub(super) channels: Channels,
    /// Numbers of segments are multiples of this.
    pub(super) multiple: usize,
    /// Steps divide the ray.
    pub(super) divides: bool,
    /// No emission is below 0.
    pub(super) positive: bool,
    /// The opacity that came with the last answer.
    pub(super) opacity: Option<f64>,
    /// The most samples that a ray may be made for.
    pub(super) most_samples: usize,
    /// In what form it is asked.
    pub(super) pose: Pose,
    names: u64,
    heard: &'k mut dyn FnMut(&Spent),
}

impl<'k> Session<'k> {
    pub(super) fn new(
        kernel: &'k mut dyn Kernel,
        budget: Budget,
        heard: &'k mut dyn FnMut(&Spent),
    ) -> Self {
        let declaration = kernel.declaration();
        let multiple = usize::try_from(declaration.multiple_of.get()).unwrap_or(usize::MAX);
        let divides = declaration.step_divides;
        let pose = Pose::new(declaration.form);
        let positive = declaration.positive_emission;
        // Counted as they are asked: more of them are several requests.
        let most = declaration.channels.map_or(usize::MAX, NonZeroUsize::get);
        let budget = Budget {
            channels: budget.channels.min(most),
            ..budget
        };
        Session {
            kernel,
            budget,
            started: Instant::now(),
            spent: Spent::default(),
            twice: false,
            channels: Channels::Straight,
            multiple,
            divides,
            positive,
            opacity: None,
            most_samples: usize::MAX,
            pose,
            names: 0,
            heard,
        }
    }

    /// Whether a ray tells of few nodes, so that many are dear.
    pub(super) fn is_narrow(&self) -> bool {
        self.budget.channels <= 2 * FEW
    }

    /// The most channels of one request.
    pub(super) fn width(&self) -> usize {
        self.budget.channels
    }

    /// Whether there are too few rays for all questions.
    pub(super) fn is_short(&self) -> bool {
        self.budget.rays < SHORT
    }

    /// No ray gets more channels than that any more; whether it got more before.
    pub(super) fn limit_channels(&mut self, most: usize) -> bool {
        let is_less = most < self.budget.channels;
        self.budget.channels = self.budget.channels.min(most.max(1));
        is_less
    }

    /// A name that no ray had.
    pub(super) fn name(&mut self) -> String {
        self.names += 1;
        format!("probe-{}", self.names)
    }

    /// A ray through the medium with those channels.
    pub(super) fn ray(&mut self, layers: &Layers, emission: &[Emission]) -> Ray {
        let name = self.name();
        layers.ray(name, emission)
    }

    /// A kernel that remembers nothing, where it can be had.
    pub(super) fn restart(&mut self) {
        self.kernel.restart();
    }

    fn count(&mut self, segments: usize) -> Result<(), Silence> {
        if self.spent.rays >= self.budget.rays {
            return Err(Silence::Budget(format!("{} rays", self.budget.rays)));
        }
        if self.started.elapsed() > self.budget.time {
            let seconds = self.budget.time.as_secs();
            return Err(Silence::Budget(format!("{seconds} s")));
        }
        let segments = segments as u64;
        self.spent.rays += 1;
        self.spent.segments += segments;
        self.spent.longest = self.spent.longest.max(segments);
        (self.heard)(&self.spent);
        Ok(())
    }

    /// One ray as it is: the answers of its channels, where they stand, and the opacity.
    pub(super) fn once(&mut self, ray: &Ray) -> Result<Answer, Silence> {
        let posed = self.pose.of(ray)?;
        self.put(&posed)
    }

    /// All that is answered to one ray, or why nothing is.
    pub(super) fn alone(&mut self, ray: &Ray) -> Result<Result<Rendering, KernelError>, Silence> {
        self.count(ray.segments.count())?;
        let posed = self.pose.of(ray)?;
        Ok(self.kernel.render(&posed.task()))
    }

    /// The same of rays in a single request, none of which is asked again; or why none has an answer.
    pub(super) fn at_once(
        &mut self,
        rays: &[Ray],
    ) -> Result<Result<Vec<Result<Rendering, KernelError>>, KernelError>, Silence> {
        let mut posed = Vec::with_capacity(rays.len());
        for ray in rays {
            self.count(ray.segments.count())?;
            posed.push(self.pose.of(ray)?);
        }
        let tasks: Vec<Task<'_>> = posed.iter().map(Posed::task).collect();
        self.kernel.renew();
        Ok(self.kernel.render_together(&tasks))
    }

    fn put(&mut self, posed: &Posed<'_>) -> Result<Answer, Silence> {
        let task = posed.task();
        self.count(usize::try_from(task.segments).unwrap_or(usize::MAX))?;
        let answer = self.kernel.render(&task);
        self.read(&task, answer)
    }

    /// The derivatives of Σₖ aₖ Iₖ by the ray's numbers, as many as there are values `at` the places declared.
    pub(super) fn derivatives(
        &mut self,
        ray: &Ray,
        cotangents: &[f64],
        at: GradientAt,
    ) -> Result<Gradient, Silence> {
        let segments = ray.segments.count();
        self.count(segments)?;
        let answer = self.kernel.gradient(&ray.task(), cotangents);
        let checked = answer
            .and_then(|(_, gradient)| gradient.checked(at, &ray.segments, ray.channels.len()));
        checked.map_err(|error| {
            self.spent.unanswered += 1;
            self.kernel.renew();
            Silence::Kernel { segments, error }
        })
    }

    /// The same of several rays, each with its own cotangents, in a single request; or why none has an answer.
    pub(super) fn derivatives_together(
        &mut self,
        asked: &[(&Ray, Vec<f64>)],
        at: GradientAt,
    ) -> Result<Result<Vec<Result<Gradient, KernelError>>, KernelError>, Silence> {
        for (ray, _) in asked {
            self.count(ray.segments.count())?;
        }
        let tasks: Vec<(Task<'_>, &[f64])> = asked
            .iter()
            .map(|(ray, cotangents)| (ray.task(), cotangents.as_slice()))
            .collect();
        self.kernel.renew();
        let answered = self.kernel.gradients_together(&tasks);
        Ok(answered.map(|answered| {
            let missing =
                std::iter::repeat_with(|| Err(KernelError::GradientAsked { given: false }));
            let all = asked.iter().zip(answered.into_iter().chain(missing));
            let checked = all.map(|((ray, _), answer)| {
                let (_, gradient) = answer?;
                gradient.checked(at, &ray.segments, ray.channels.len())
            });
            checked.collect()
        }))
    }

    /// Several rays in one request.
    pub(super) fn together(&mut self, rays: &[Ray]) -> Vec<Result<Answer, Silence>> {
        let mut posed = Vec::with_capacity(rays.len());
        for ray in rays {
            match self
                .count(ray.segments.count())
                .and_then(|()| self.pose.of(ray))
            {
                Ok(one) => posed.push(one),
                Err(silence) => return rays.iter().map(|_| Err(silence.clone())).collect(),
            }
        }
        let tasks: Vec<_> = posed.iter().map(Posed::task).collect();
        let answers = self.kernel.render_all(&tasks);
        let both = tasks.iter().zip(answers);
        both.map(|(task, answer)| self.read(task, answer)).collect()
    }

    fn read(
        &mut self,
        task: &Task<'_>,
        answer: Result<Rendering, KernelError>,
    ) -> Result<Answer, Silence> {
        let segments = usize::try_from(task.segments).unwrap_or(usize::MAX);
        let wanted = task.subject.channels().len();
        let checked = answer.and_then(|answer| {
            let got = answer.radiance.len();
            if got == wanted {
                Ok(answer)
            } else {
                Err(KernelError::Channels { got, wanted })
            }
        });
        match checked {
            Ok(answer) => Ok((
                answer.radiance.iter().map(rug::Float::to_f64).collect(),
                answer.opacity.map(|opacity| opacity.to_f64()),
            )),
            Err(error) => {
                self.spent.unanswered += 1;
                // What comes next has nothing to do with this one.
                self.kernel.renew();
                Err(Silence::Kernel { segments, error })
            }
        }
    }

    /// The finite answers of all channels, in their order, in as many requests as it takes.
    pub(super) fn ask(&mut self, ray: &Ray) -> Result<Vec<f64>, Silence> {
        let answers = self.ask_any(ray)?;
        if answers.iter().all(|y| y.is_finite()) {
            Ok(answers)
        } else {
            let segments = ray.segments.count();
            Err(Silence::NotFinite { segments })
        }
    }

    /// The same, finite or not.
    pub(super) fn ask_any(&mut self, ray: &Ray) -> Result<Vec<f64>, Silence> {
        let count = ray.channels.len();
        self.in_parts(count, |session, range| {
            let part = (range.len() < count).then(|| ray.part(range));
            session.once(part.as_ref().unwrap_or(ray))
        })
    }

    /// The finite answers of all channels of a ray made in another form.
    pub(super) fn ask_made(&mut self, made: &Made) -> Result<Vec<f64>, Silence> {
        let answers = self.in_parts(made.channels(), |session, range| {
            session.put(&Posed::Made(Box::new(made.part(range))))
        })?;
        if answers.iter().all(|y| y.is_finite()) {
            Ok(answers)
        } else {
            let segments = made.segments;
            Err(Silence::NotFinite { segments })
        }
    }

    /// Answers in the order of the channels, no more channels at once than may be.
    fn in_parts(
        &mut self,
        count: usize,
        mut once: impl FnMut(&mut Self, Range<usize>) -> Result<Answer, Silence>,
    ) -> Result<Vec<f64>, Silence> {
        let mut answers = Vec::with_capacity(count);
        while answers.len() < count {
            let start = answers.len();
            let end = (start + self.budget.channels).min(count);
            let answer = match self.heard_out(start..end, &mut once) {
                // It may be the number of channels that it does not take.
                Err(Silence::Kernel { .. }) if end - start > FEW => {
                    let fewer = self.heard_out(start..start + FEW, &mut once)?;
                    self.limit_channels(FEW);
                    fewer
                }
                answer => answer?,
            };
            let (y, opacity) = answer;
            self.opacity = opacity;
            let count = y.len();
            answers.extend((0..count).map(|k| y[self.channels.place(k, count)]));
        }
        Ok(answers)
    }

    /// The answer that counts.
    fn heard_out(
        &mut self,
        range: Range<usize>,
        once: &mut impl FnMut(&mut Self, Range<usize>) -> Result<Answer, Silence>,
    ) -> Result<Answer, Silence> {
        if self.twice {
            once(self, range.clone())?;
        }
        once(self, range)
    }
}
