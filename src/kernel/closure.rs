//! Rust code linked in.

use super::pieces::{in_pieces, one};
use super::{Declaration, Kernel, KernelError, Rendering, Segments, Task};
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

impl Closure<fn(&Task<'_>, usize) -> f64> {
    /// The kernel that makes a radiance of the segments of a ray and the index of a channel; nothing else is
    /// declared of it.
    pub fn segments<G: FnMut(&Segments, usize) -> f64 + Send>(
        name: &str,
        mut radiance: G,
    ) -> Closure<impl FnMut(&Task<'_>, usize) -> f64 + Send> {
        // Tasks in another form are refused before they come here.
        let of_task = move |task: &Task<'_>, channel: usize| {
            task.cut()
                .map_or(f64::NAN, |segments| radiance(segments, channel))
        };
        Closure::new(Declaration::new(name), of_task)
    }
}

impl<F: FnMut(&Task<'_>, usize) -> f64 + Send> Kernel for Closure<F> {
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

impl<F: FnMut(&Task<'_>, usize) -> f64 + Send> Closure<F> {
    /// Of a ray of as many channels as are declared.
    fn whole(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
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
