//! Programs that keep their constants in every format they were run in.

use super::{Bound, Program};
use crate::real::counted::uncounted;
use crate::real::{Format, Real};
use std::any::Any;
use std::sync::{Arc, PoisonError, RwLock};

/// A program that is run place by place in formats that come and go: constants are rounded once a format.
#[derive(Debug)]
pub struct KeptProgram {
    program: Program,
    /// A [`Kept`] for each format: one of as many bits may have another range.
    kept: RwLock<Vec<Box<dyn Any + Send + Sync>>>,
}

/// A format with the constants in it.
type Kept<F> = (F, Arc<[<F as Format>::Real]>);

impl KeptProgram {
    /// The program, run in no format yet.
    #[must_use]
    pub fn new(program: Program) -> Self {
        KeptProgram {
            program,
            kept: RwLock::new(Vec::new()),
        }
    }

    /// The program itself.
    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The program with its constants in `format`.
    pub fn bind<F: Format>(&self, format: F) -> Bound<'_, F> {
        let constants = self.find(format).unwrap_or_else(|| self.keep(format));
        Bound {
            program: &self.program,
            format,
            constants,
        }
    }

    /// Which way every comparison goes at one place, in the order of the program.
    pub fn branches_at<R: Real>(&self, input: &R) -> Vec<bool> {
        self.bind(input.format()).branches(&[input])
    }

    /// The values of all outputs at one place, in the format of the first input.
    pub fn at<R: Real>(&self, input: &R) -> Vec<R> {
        self.bind(input.format()).at(&[input])
    }

    /// The values of the first N outputs at many places, in the format of the first of these.
    pub fn all<R: Real, const N: usize>(&self, inputs: &[R]) -> [Vec<R>; N] {
        let mut outputs = std::array::from_fn(|_| Vec::with_capacity(inputs.len()));
        if let Some(first) = inputs.first() {
            self.bind(first.format()).run(&[inputs], &mut outputs);
        }
        outputs
    }

    fn find<F: Format>(&self, format: F) -> Option<Arc<[F::Real]>> {
        let kept = self.kept.read().unwrap_or_else(PoisonError::into_inner);
        kept.iter()
            .filter_map(|kept| kept.downcast_ref::<Kept<F>>())
            .find(|(kept, _)| *kept == format)
            .map(|(_, constants)| Arc::clone(constants))
    }

    fn keep<F: Format>(&self, format: F) -> Arc<[F::Real]> {
        // Rounded for all runs to come: no part of the work of the first.
        let constants = uncounted(|| self.program.constants_in(format));
        let mut kept = self.kept.write().unwrap_or_else(PoisonError::into_inner);
        let entry: Kept<F> = (format, Arc::clone(&constants));
        kept.push(Box::new(entry));
        constants
    }
}
