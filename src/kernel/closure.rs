//! Rust code linked in.

use super::{Declaration, Kernel, KernelError, Rendering, Task};
use rug::Float;
use std::fmt;

/// A function of a task and a channel, which it returns the radiance of.
pub struct Closure<F> {
    declaration: Declaration,
    radiance: F,
}

impl<F: FnMut(&Task<'_>, usize) -> f64 + Send> Closure<F> {
    /// The kernel that calls `radiance` for every channel, by its index; what it declares is to be fitting.
    pub fn new(declaration: Declaration, radiance: F) -> Self {
        Closure {
            declaration,
            radiance,
        }
    }
}

impl<F: FnMut(&Task<'_>, usize) -> f64 + Send> Kernel for Closure<F> {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let given = task.data.kind();
        let wanted = self.declaration.form;
        if given != wanted {
            return Err(KernelError::Form { given, wanted });
        }
        let channels = 0..task.subject.channels().len();
        let radiance = channels.map(|channel| {
            let value = (self.radiance)(task, channel);
            Float::with_val(f64::MANTISSA_DIGITS, value)
        });
        Ok(Rendering {
            radiance: radiance.collect(),
            ..Rendering::default()
        })
    }
}

impl<F> fmt::Debug for Closure<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("Closure");
        shown.field("declaration", &self.declaration);
        shown.finish_non_exhaustive()
    }
}
