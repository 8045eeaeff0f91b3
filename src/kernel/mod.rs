//! Kernels: somebody's implementation of the volume rendering integral, inside the process or outside.
//!
//! A [`Kernel`] is given a [`Task`] (a case cut into segments, as a volume with tables, as source code or as a
//! function of λ), and returns a [`Rendering`]. It says of itself, in its [`Declaration`], what it claims to
//! compute. Kernels stand where methods stand: to everything that measures, both are the same, and every
//! [`Method`](crate::method::Method) is a kernel too, by [`BuiltIn`].
//!
//! | kernel | where it runs |
//! |---|---|
//! | [`BuiltIn`] | a method of this crate, in any format |
//! | [`Closure`] | Rust code linked in, in a test for instance |
//! | [`process`] | a program that talks JSON lines (`docs/protocol.md`) |
//! | [`library`] | a shared library with the C interface of `include/volver.h` |

mod accuracy;
mod built_in;
mod closure;
mod cut;
mod declaration;
mod error;
mod gradient;
mod gridded;
pub mod library;
mod made_up;
mod medium;
mod pieces;
pub mod process;
mod quantity;
mod rendering;
mod source;
mod spacing;
mod subject;
mod task;
mod volume;

pub use accuracy::{Quantum, UlpBound, UlpBoundError};
pub use built_in::BuiltIn;
pub(crate) use built_in::radiance_in;
pub use closure::Closure;
pub use cut::{Cut, CutError, MAX_TASK_SEGMENTS};
pub use declaration::{Declaration, DeclarationError, Sampling, WallAt};
pub use error::KernelError;
pub use gradient::{Gradient, GradientAt, InnerProduct};
pub use gridded::Gridded;
pub use medium::Medium;
pub use quantity::{DepthWeights, Quantity};
pub use rendering::Rendering;
pub use source::Source;
pub use spacing::{Spacing, SpacingError};
pub use subject::{Subject, SubjectError};
pub use task::{Data, FormKind, Formula, Samples, Segments, Table, Task, Volume};

use std::fmt::Debug;

/// What is answered to several tasks with cotangents, one result a task.
pub type Gradients = Vec<Result<(Rendering, Gradient), KernelError>>;

/// An implementation under test.
pub trait Kernel: Debug + Send {
    /// What it says of itself.
    fn declaration(&self) -> &Declaration;

    /// What it said of itself in its own words, where it is a program that has to be run to be asked.
    fn greeting(&self) -> Option<&str> {
        None
    }

    /// What it answers of the task: the radiance of every channel, if its declaration says no other.
    ///
    /// # Errors
    /// [`KernelError`] where no radiance comes of it. A kernel that fails may be asked again: one outside the
    /// process is started anew.
    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError>;

    /// The radiances of several tasks, in their order; kernels outside the process save round trips.
    fn render_all(&mut self, tasks: &[Task<'_>]) -> Vec<Result<Rendering, KernelError>> {
        tasks.iter().map(|task| self.render(task)).collect()
    }

    /// The same in a single request, where there are requests: whatever goes wrong with it, no ray is asked again by
    /// itself.
    ///
    /// # Errors
    /// [`KernelError`] where no ray has an answer, [`KernelError::Together`] where they are too many.
    fn render_together(
        &mut self,
        tasks: &[Task<'_>],
    ) -> Result<Vec<Result<Rendering, KernelError>>, KernelError> {
        Ok(self.render_all(tasks))
    }

    /// The same with the gradient of Σₖ aₖ Iₖ by the numbers of the task, aₖ being the cotangents, one a channel.
    ///
    /// # Errors
    /// [`KernelError::NoGradient`] of a kernel that declares none; else as [`Kernel::render`].
    fn gradient(
        &mut self,
        task: &Task<'_>,
        cotangents: &[f64],
    ) -> Result<(Rendering, Gradient), KernelError> {
        let _ = (task, cotangents);
        Err(KernelError::NoGradient)
    }

    /// Gradients of several tasks, each with its own cotangents, in a single request, where there are requests.
    ///
    /// # Errors
    /// [`KernelError`] where no ray has an answer, [`KernelError::Together`] where they are too many.
    fn gradients_together(
        &mut self,
        asked: &[(Task<'_>, &[f64])],
    ) -> Result<Gradients, KernelError> {
        let one = |(task, cotangents): &(Task<'_>, &[f64])| self.gradient(task, cotangents);
        Ok(asked.iter().map(one).collect())
    }

    /// Forgets failures: what is asked next has nothing to do with what was asked before. One that was given up
    /// is tried again.
    fn renew(&mut self) {}

    /// Forgets all that was asked, where it can: a program is started anew.
    fn restart(&mut self) {}

    /// Why it will never answer again, where that is so.
    fn gone(&self) -> Option<KernelError> {
        None
    }
}
