//! Answers that were kept, as a kernel.

use super::answered::Entry;
use super::digest;
use crate::kernel::{Declaration, Kernel, KernelError, Rendering, Task};
use crate::study::shards::Key;
use std::collections::{HashMap, VecDeque};

/// Answers what was answered before: to a ray that was asked several times in the same order.
#[derive(Debug)]
pub struct Replayed {
    declaration: Declaration,
    kept: HashMap<Key, VecDeque<Entry>>,
}

impl Replayed {
    /// Of all that was kept.
    pub fn new(declaration: Declaration, entries: impl IntoIterator<Item = Entry>) -> Self {
        let mut kept: HashMap<Key, VecDeque<Entry>> = HashMap::new();
        for entry in entries {
            kept.entry(entry.task).or_default().push_back(entry);
        }
        Replayed { declaration, kept }
    }

    fn next(&mut self, task: Key) -> Option<Result<Rendering, KernelError>> {
        self.kept.get_mut(&task)?.pop_front()?.answer.result()
    }
}

impl Kernel for Replayed {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let kept = self.next(digest::of(task));
        kept.unwrap_or_else(|| {
            let case = task.subject.name().into();
            Err(KernelError::NotKept { case })
        })
    }

    fn render_together(
        &mut self,
        tasks: &[Task<'_>],
    ) -> Result<Vec<Result<Rendering, KernelError>>, KernelError> {
        match self.next(digest::of_all(tasks)) {
            Some(Err(error)) => Err(error),
            Some(Ok(_)) | None => Ok(self.render_all(tasks)),
        }
    }
}
