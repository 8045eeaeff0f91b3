//! A rule as a kernel: what computes by it and by nothing else.

use super::Rule;
use crate::kernel::{Declaration, FormKind, Kernel, KernelError, Rendering, Task};
use crate::real::Real;

/// Answers what a rule answers, in the format that it is declared in.
#[derive(Clone, Debug)]
pub struct RuleKernel {
    rule: Rule,
    declaration: Declaration,
}

impl RuleKernel {
    /// Of rays that are given as segments, whatever the form declared.
    #[must_use]
    pub fn new(rule: Rule, declaration: Declaration) -> Self {
        RuleKernel {
            rule,
            declaration: Declaration {
                form: FormKind::Segments,
                ..declaration
            },
        }
    }
}

impl Kernel for RuleKernel {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let segments = task.cut().ok_or_else(|| KernelError::Form {
            given: task.data.kind(),
            wanted: FormKind::Segments,
        })?;
        // Of any format: a rule is asked seldom, and so compiled once.
        let answers = self
            .rule
            .answers(segments, task.step, self.declaration.format);
        Ok(Rendering {
            radiance: answers.iter().map(Real::to_float).collect(),
            ..Rendering::default()
        })
    }
}
