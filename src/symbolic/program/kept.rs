//! Programs that keep their constants in every format they were run in.

use super::{Bound, Program};
use crate::real::{Format, Real};
use std::any::Any;
use std::sync::{Arc, PoisonError, RwLock};

/// A program that is run place by place in formats that come and go: constants are rounded once a format.
#[derive(Debug)]
pub struct KeptProgram {
    program: Program,
    kept: RwLock<Vec<Kept>>,
}

/// The constants in one format. The format itself is the key: emulated formats of the same number type and
/// the same bits may differ in range.
#[derive(Debug)]
struct Kept {
    format: Box<dyn Any + Send + Sync>,
    constants: Arc<dyn Any + Send + Sync>,
}

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

    fn find<F: Format>(&self, format: F) -> Option<Arc<[F::Real]>> {
        let kept = self.kept.read().unwrap_or_else(PoisonError::into_inner);
        let found = kept
            .iter()
            .find(|kept| kept.format.downcast_ref() == Some(&format))?;
        found.constants.downcast_ref::<Arc<[F::Real]>>().cloned()
    }

    fn keep<F: Format>(&self, format: F) -> Arc<[F::Real]> {
        let constants = self.program.constants_in(format);
        let mut kept = self.kept.write().unwrap_or_else(PoisonError::into_inner);
        kept.push(Kept {
            format: Box::new(format),
            constants: Arc::new(Arc::clone(&constants)),
        });
        constants
    }
}
