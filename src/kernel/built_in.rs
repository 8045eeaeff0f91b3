//! Methods of this crate as kernels.

use super::made_up::MadeUp;
use super::{Declaration, FormKind, Kernel, KernelError, Rendering, Task};
use crate::case::{Case, Fresh};
use crate::method::{Inner, Method, MethodError, Nested};
use crate::real::{Format, FormatName, Real, WithFormat};
use rug::{Float, Rational};
use std::num::NonZeroU64;

/// Rules take segments in groups of up to so many.
const LARGEST_GROUP: usize = 16;

/// A method in a format. It cuts rays into equal segments: where the step does not divide the ray, or the
/// number of segments does not suit the method, it uses the next shorter one that does, and says so.
#[derive(Clone, Debug)]
pub struct BuiltIn {
    method: Method,
    declaration: Declaration,
}

impl BuiltIn {
    /// `method`, run in `format`.
    #[must_use]
    pub fn new(method: Method, format: FormatName) -> Self {
        let declaration = Declaration {
            form: FormKind::Function,
            method: Some(method),
            format,
            stochastic: is_random(&method),
            step_divides: true,
            multiple_of: NonZeroU64::new(suitable(&method, 1)).unwrap_or(NonZeroU64::MIN),
            ..Declaration::new(&format!("method:{}@{format}", method.name()))
        };
        BuiltIn {
            method,
            declaration,
        }
    }
}

/// The next number of segments that suits a method: some rules take groups of them.
fn suitable(method: &Method, segments: u64) -> u64 {
    let mut further = (segments..).take(LARGEST_GROUP);
    let suits = |n: &u64| method.check_segments(*n).is_ok();
    further.find(suits).unwrap_or(segments)
}

impl Kernel for BuiltIn {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let format = self.declaration.format;
        let segments = suitable(&self.method, task.segments);
        let method = seeded(self.method, task.seed);
        let cases = task.subject.cases();
        let channels = 0..task.subject.channels().len();
        let run = |channel| match cases.get(channel) {
            Some(case) => radiance_in(format, &method, case, segments),
            None => radiance_in(
                format,
                &method,
                &MadeUp::new(task.subject, channel),
                segments,
            ),
        };
        let radiance: Result<Vec<Float>, MethodError> = channels.map(run).collect();
        let used = Rational::from(task.subject.length() / segments).to_f64();
        Ok(Rendering {
            radiance: radiance?,
            step: Some(used).filter(|used| used.to_bits() != task.step.to_bits()),
            ..Rendering::default()
        })
    }
}

fn is_random(method: &Method) -> bool {
    matches!(
        method,
        Method::Nested(Nested {
            inner: Inner::MonteCarlo { .. },
            ..
        })
    )
}

/// The method with random numbers of that seed; seed 0 has its own.
fn seeded(mut method: Method, of_task: u64) -> Method {
    if let Method::Nested(nested) = &mut method
        && let Inner::MonteCarlo { seed, .. } = &mut nested.inner
    {
        *seed = seed.wrapping_add(of_task);
    }
    method
}

/// The radiance of a case by a method on n segments, in a format known only at run time.
///
/// # Errors
/// As [`Method::radiance`].
pub(crate) fn radiance_in<C: Case>(
    format: FormatName,
    method: &Method,
    case: &C,
    segments: u64,
) -> Result<Float, MethodError> {
    format.with(Run {
        case,
        method: *method,
        segments,
    })
}

struct Run<'c, C> {
    case: &'c C,
    method: Method,
    segments: u64,
}

impl<C: Case> WithFormat for Run<'_, C> {
    type Output = Result<Float, MethodError>;

    fn run<F: Format>(self, format: F) -> Self::Output {
        let nodes = Fresh::new(self.case, format);
        Ok(self.method.radiance(&nodes, self.segments)?.to_float())
    }
}
