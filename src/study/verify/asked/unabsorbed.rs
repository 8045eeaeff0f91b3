//! The ray of a case where nothing absorbs: lit by a source per length that is the case's τ, its radiance is t(D).

use super::{Answers, Asked, Level};
use crate::kernel::{
    Data, Kernel, KernelError, Medium, Quantity, Rendering, Samples, Segments, Subject, Task,
};
use rug::Rational;

/// The ray.
#[derive(Debug)]
pub(super) struct Unabsorbed<'a> {
    subject: &'a Subject,
    name: String,
    channels: [String; 1],
}

impl<'a> Unabsorbed<'a> {
    pub(super) fn new(subject: &'a Subject) -> Self {
        let quantity = Quantity::Emission.name();
        Unabsorbed {
            subject,
            name: format!("{}:{quantity}", subject.name()),
            channels: [quantity.into()],
        }
    }
}

impl Medium for Unabsorbed<'_> {
    fn name(&self) -> &str {
        &self.name
    }

    fn channels(&self) -> &[String] {
        &self.channels
    }

    fn length(&self) -> &Rational {
        self.subject.length()
    }

    fn at(&self, lambda: f64, emission: &mut [f64]) -> f64 {
        let source = self.subject.at(lambda, &mut []);
        emission.fill(source);
        0.0
    }

    fn is_per_length(&self) -> bool {
        true
    }
}

/// The segments of a ray, lit by its extinction, which is gone.
fn unabsorbed(segments: &Segments) -> Segments {
    let of = |samples: &Samples| Samples {
        lambda: samples.lambda.clone(),
        extinction: vec![0.0; samples.extinction.len()],
        emission: vec![samples.extinction.clone()],
    };
    Segments {
        edges: of(&segments.edges),
        middles: of(&segments.middles),
    }
}

impl Asked<'_> {
    /// Asks that ray at every level, with the seeds of the answers, which the emission is put to.
    pub(super) fn ask_unabsorbed(&self, kernel: &mut dyn Kernel, answers: &mut Answers) {
        if !self.declaration.has(Quantity::Emission) {
            return;
        }
        let ray = Unabsorbed::new(self.subject);
        let mut failed = Vec::with_capacity(self.levels.len());
        for (level, answers) in self.levels.iter().zip(&mut answers.levels) {
            failed.push(self.emitted(kernel, &ray, level, answers));
        }
        answers.no_emission = failed;
        // Beside the levels, and asked again, an answer that is missing is no failure of a level.
        for (spot, answer) in self.spots.iter().zip(&mut answers.spots) {
            self.emitted(kernel, &ray, spot, std::slice::from_mut(answer));
        }
        if let (Some(level), Some(again)) = (self.levels.first(), &mut answers.again) {
            self.emitted(kernel, &ray, level, std::slice::from_mut(again));
        }
    }

    /// Puts what that ray shows to the answers; the first error that comes instead.
    fn emitted(
        &self,
        kernel: &mut dyn Kernel,
        ray: &Unabsorbed<'_>,
        level: &Level,
        answers: &mut [Result<Rendering, KernelError>],
    ) -> Option<KernelError> {
        let segments = level.segments.as_ref().map(unabsorbed)?;
        let tasks: Vec<Task<'_>> = (0..answers.len() as u64)
            .map(|seed| Task {
                subject: ray,
                data: Data::Segments(&segments),
                ..self.task(level, seed)
            })
            .collect();
        let mut failed = None;
        for (answer, emitted) in answers.iter_mut().zip(kernel.render_all(&tasks)) {
            let one = emitted.and_then(|rendering| {
                let (got, wanted) = (rendering.radiance.len(), 1);
                let one = rendering.radiance.into_iter().next();
                one.filter(|_| got == wanted)
                    .ok_or(KernelError::Channels { got, wanted })
            });
            match (answer, one) {
                (Ok(rendering), Ok(one)) => rendering.emission = Some(one),
                (_, Err(error)) => failed = failed.or(Some(error)),
                (Err(_), Ok(_)) => {}
            }
        }
        failed
    }
}
