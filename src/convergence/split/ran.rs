//! A method run at a level, with the place where it stopped.

use crate::case::{Nodes, Number};
use crate::method::{Level, Method, MethodError};

#[derive(Clone, Copy)]
pub(super) enum Stop {
    AsDeclared,
    Never,
    After(u64),
}

/// What came out, and how far along the ray it went.
#[derive(Clone, Debug)]
pub(super) struct Ran<R> {
    pub(super) radiance: R,
    /// Segments composited, where the method stopped early.
    pub(super) stopped: Option<u64>,
}

/// Whether the method may stop before the end of the ray.
pub(super) fn may_stop(method: &Method) -> bool {
    false
}

/// The method on `level`, stopped as asked.
pub(super) fn run<N: Nodes>(
    level: &mut Level<'_, N>,
    method: &Method,
    stop: Stop,
) -> Result<Ran<Number<N>>, MethodError> {
    Ok(Ran {
        radiance: level.radiance(method)?,
        stopped: None,
    })
}

/// How to stop where another run did.
pub(super) fn follow(stopped: Option<u64>) -> Stop {
    stopped.map_or(Stop::Never, Stop::After)
}
