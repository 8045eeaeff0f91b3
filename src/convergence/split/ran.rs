//! A method run at a level, with the place where it stopped.

use crate::case::{Nodes, Number};
use crate::method::{Level, Method, MethodError, Stop};

/// What came out, and how far along the ray it went.
#[derive(Clone, Debug)]
pub(super) struct Ran<R> {
    pub(super) radiance: R,
    /// Segments composited, where the method stopped early.
    pub(super) stopped: Option<u64>,
}

/// Whether the method may stop before the end of the ray.
pub(super) fn may_stop(method: &Method) -> bool {
    matches!(method, Method::Composited(compositing) if compositing.threshold().is_some())
}

/// The method on `level`, stopped as asked.
pub(super) fn run<N: Nodes>(
    level: &mut Level<'_, N>,
    method: &Method,
    stop: Stop,
) -> Result<Ran<Number<N>>, MethodError> {
    if let Method::Composited(compositing) = method {
        let composite = compositing.composite(level.nodes(), level.segments(), stop)?;
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
