//! A kernel whose answers are kept.

use super::answered::{Answer, Entry};
use super::digest;
use crate::kernel::{Declaration, Kernel, KernelError, Rendering, Task};

/// Asks another kernel, and keeps all that it answers.
#[derive(Debug)]
pub struct Recorded<'k> {
    kernel: &'k mut dyn Kernel,
    entries: Vec<Entry>,
}

impl<'k> Recorded<'k> {
    /// Nothing answered yet.
    pub fn new(kernel: &'k mut dyn Kernel) -> Self {
        Recorded {
            kernel,
            entries: Vec::new(),
        }
    }

    /// All that it answered, in the order in which it was asked.
    #[must_use]
    pub fn into_entries(self) -> Vec<Entry> {
        self.entries
    }

    fn keep(&mut self, tasks: &[Task<'_>], results: &[Result<Rendering, KernelError>]) {
        let entries = tasks.iter().zip(results).map(|(task, result)| Entry {
            task: digest::of(task),
            answer: Answer::new(result),
        });
        self.entries.extend(entries);
    }
}

impl Kernel for Recorded<'_> {
    fn declaration(&self) -> &Declaration {
        self.kernel.declaration()
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let result = self.kernel.render(task);
        self.keep(std::slice::from_ref(task), std::slice::from_ref(&result));
        result
    }

    fn render_all(&mut self, tasks: &[Task<'_>]) -> Vec<Result<Rendering, KernelError>> {
        let results = self.kernel.render_all(tasks);
        self.keep(tasks, &results);
        results
    }

    fn render_together(
        &mut self,
        tasks: &[Task<'_>],
    ) -> Result<Vec<Result<Rendering, KernelError>>, KernelError> {
        let results = self.kernel.render_together(tasks);
        match &results {
            Ok(results) => self.keep(tasks, results),
            Err(error) => self.entries.push(Entry {
                task: digest::of_all(tasks),
                answer: Answer::Error(error.to_string()),
            }),
        }
        results
    }

    fn gone(&self) -> Option<KernelError> {
        self.kernel.gone()
    }

    fn renew(&mut self) {
        self.kernel.renew();
    }

    fn restart(&mut self) {
        self.kernel.restart();
    }
}
