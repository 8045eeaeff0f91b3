//! A method run at a level, with the place where it stopped.

use crate::method::{Level, Method, MethodError, Stop};
use crate::real::{Format, Mpfr};
use rug::Float;

/// What came out, and how far along the ray it went.
#[derive(Clone, Debug)]
pub(super) struct Ran<R> {
    pub(super) radiance: R,
    /// Segments composited, where the method stopped early.
    pub(super) stopped: Option<u64>,
}

/// A method without rounding.
#[derive(Clone, Debug)]
pub(super) struct Exact {
    /// The radiance, stopped where the method stops.
    pub(super) declared: Float,
    /// Where that is, if before the end.
    pub(super) stopped: Option<u64>,
    /// The radiance of the whole ray.
    pub(super) whole: Float,
}

/// Whether the method may stop before the end of the ray.
fn may_stop(method: &Method) -> bool {
    matches!(method, Method::Composited(compositing) if compositing.threshold().is_some())
}

/// The method on `level`, stopped as asked.
pub(super) fn run<F: Format>(
    level: &mut Level<'_, F>,
    method: &Method,
    stop: Stop,
) -> Result<Ran<F::Real>, MethodError> {
    if let Method::Composited(compositing) = method {
        let composite = compositing.composite(&level.nodes(), level.segments(), stop)?;
        return Ok(Ran {
            radiance: composite.radiance,
            stopped: composite.stopped,
        });
    }
    Ok(Ran {
        radiance: level.radiance(method)?,
        stopped: None,
    })
}

/// How to stop where another run did.
pub(super) fn follow(stopped: Option<u64>) -> Stop {
    stopped.map_or(Stop::Never, Stop::After)
}

/// A method without rounding on one level.
pub(super) fn exact(level: &mut Level<'_, Mpfr>, method: &Method) -> Result<Exact, MethodError> {
    let declared = run(level, method, Stop::AsDeclared)?;
    let whole = if may_stop(method) && declared.stopped.is_some() {
        run(level, method, Stop::Never)?.radiance.into()
    } else {
        declared.radiance.clone().into()
    };
    Ok(Exact {
        declared: declared.radiance.into(),
        stopped: declared.stopped,
        whole,
    })
}
