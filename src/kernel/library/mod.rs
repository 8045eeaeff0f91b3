//! Kernels in shared libraries, by the C interface of `include/volver.h`.
//!
//! A library shares this process: one that crashes, loops for ever or writes where it must not takes the
//! process with it, and everything measured. [`process`](super::process) is the safe way; this one is for code
//! that is known to behave, and for callbacks λ → (C, τ), which no pipe is quick enough for.

mod abi;
mod declared;
mod tables;

use super::pieces::{in_pieces, one};
use super::{Data, Declaration, Kernel, KernelError, Quantity, Rendering, Task, Volume};
use abi::{Failure, Functions};
use rug::Float;
use std::fs;
use std::path::Path;

/// A kernel in a shared library.
#[derive(Debug)]
pub struct LibraryKernel {
    path: String,
    functions: Functions,
    declaration: Declaration,
}

impl LibraryKernel {
    /// Loads the library and asks it what it is. It stays loaded until the process ends: threads that it
    /// started, OpenMP's for instance, would run on without their code.
    ///
    /// Its code runs in this process and is trusted to keep to `include/volver.h`, as a program that is run is
    /// trusted with what its user may do.
    ///
    /// # Errors
    /// [`KernelError::Library`] where the file is missing, is no shared library, lacks one of the interface's
    /// functions, was compiled for another version of it, or declares what is not possible.
    pub fn open(path: &Path) -> Result<Self, KernelError> {
        let shown = path.display().to_string();
        let fails = |problem| KernelError::Library {
            path: shown.clone(),
            problem,
        };
        // A name without a slash would be looked for among the system's libraries.
        let file = fs::canonicalize(path).map_err(|error| fails(error.to_string()))?;
        let functions = Functions::load(&file).map_err(fails)?;
        let default_name = path.file_stem().unwrap_or(path.as_os_str());
        let declaration = functions
            .declare()
            .and_then(|declared| declared.checked(&default_name.to_string_lossy()))
            .map_err(fails)?;
        Ok(LibraryKernel {
            path: shown,
            functions,
            declaration,
        })
    }
}

impl Kernel for LibraryKernel {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        one(self.render_all(std::slice::from_ref(task)))
    }

    fn render_all(&mut self, tasks: &[Task<'_>]) -> Vec<Result<Rendering, KernelError>> {
        let declaration = self.declaration.clone();
        in_pieces(&declaration, tasks, |tasks| {
            tasks.iter().map(|task| self.whole(task)).collect()
        })
    }
}

impl LibraryKernel {
    /// The answer to a ray of as many channels as are declared.
    fn whole(&self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let (given, wanted) = (task.data.kind(), self.declaration.form);
        if given != wanted {
            return Err(KernelError::Form { given, wanted });
        }
        let answer = self
            .functions
            .render(task, self.declaration.background)
            .map_err(|failure| match failure {
                Failure::Refused(reason) => KernelError::Refused { reason },
                Failure::Broken(problem) => KernelError::Library {
                    path: self.path.clone(),
                    problem: problem.into(),
                },
            })?;
        if !(answer.step >= 0.0 && answer.step.is_finite()) {
            return Err(KernelError::Used {
                what: "step",
                value: answer.step,
            });
        }
        let told = |values: &[f64]| values.iter().any(|value| !value.is_nan());
        let float = |value: &f64| Float::with_val(f64::MANTISSA_DIGITS, *value);
        let has = |quantity| self.declaration.has(quantity);
        let radiance = answer.radiance.iter().filter(|_| has(Quantity::Radiance));
        // What is declared is an answer where it is no number, too.
        let is_told = |opacity: &&f64| !opacity.is_nan() || has(Quantity::Opacity);
        let of = |quantity, value: &f64| has(quantity).then(|| float(value));
        Ok(Rendering {
            radiance: radiance.map(float).collect(),
            opacity: Some(&answer.opacity).filter(is_told).map(float),
            optical_depth: of(Quantity::OpticalDepth, &answer.optical_depth),
            expected_depth: of(Quantity::ExpectedDepth, &answer.expected_depth),
            emission: None,
            gradient: None,
            step: Some(answer.step).filter(|step| *step > 0.0),
            segments: Some(answer.segments).filter(|segments| *segments > 0),
            edges: None,
            standard_error: Some(answer.standard_error).filter(|errors| told(errors)),
        })
    }
}

/// Whether arrays are as long as a library will take them to be.
fn fits(task: &Task<'_>) -> bool {
    let channels = task.subject.channels().len();
    if let Data::Volume(Volume { field, table }) = task.data {
        let columns = &table.emission;
        return field.len() > 1
            && columns.len() == channels
            && columns.iter().all(|c| c.len() == table.entries());
    }
    let Data::Segments(segments) = task.data else {
        return true;
    };
    [(&segments.edges, 1), (&segments.middles, 0)]
        .into_iter()
        .all(|(samples, more)| {
            let count = segments.count() + more;
            samples.lambda.len() == count
                && samples.extinction.len() == count
                && samples.emission.len() == channels
                && samples.emission.iter().all(|c| c.len() == count)
        })
        && u64::try_from(segments.count()) == Ok(task.segments)
}
