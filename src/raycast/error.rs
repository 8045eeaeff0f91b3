//! Why there is no picture.

use super::span::Frame;
use super::{Interpolation, LastStep, Precision, Raycaster};
use crate::method::{Method, MethodError};
use crate::raycast::way::Way;
use crate::volume::TransferFunction;

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RaycastError {
    /// A camera whose place is its target, that looks up, or that has no number.
    #[error(
        "the camera looks nowhere (allowed: a target that is another place, and an up that is not along the line of sight)"
    )]
    Camera,
    /// A lens that shows nothing.
    #[error(
        "the lens shows nothing (allowed: a height above 0, or an angle between 0 and pi radians)"
    )]
    Lens,
    /// A picture of no pixels, or of more than can be counted.
    #[error("{width} x {height} pixels of {channels} channels (allowed: at least one of each)")]
    Size {
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
        /// Channels.
        channels: usize,
    },
    /// A step that leads nowhere.
    #[error(
        "step {step} (allowed: above 0, and at least {least}, of which {most} lead through the volume)"
    )]
    Step {
        /// What was given.
        step: f64,
        /// The least.
        least: f64,
        /// The most segments of a ray.
        most: usize,
    },
    /// Too few samples along an axis, or too many.
    #[error(
        "{found} samples along axis {axis} (allowed: {least} to {most} for {interpolation} interpolation)"
    )]
    Samples {
        /// 0, 1 or 2.
        axis: usize,
        /// How many there are.
        found: usize,
        /// How many there have to be.
        least: usize,
        /// How many there may be.
        most: usize,
        /// Of what.
        interpolation: Interpolation,
    },
    /// An array that has not the grid's samples.
    #[error("{found} samples in a grid of {expected} (allowed: as many)")]
    Count {
        /// How many there are.
        found: usize,
        /// The product of the dimensions.
        expected: usize,
    },
    /// A grid without a place in space.
    #[error(
        "the grid has no place in space (allowed: a finite origin, spacings above 0, a direction whose determinant is not 0)"
    )]
    Place,
    /// A transfer function that says nothing.
    #[error("transfer function: {what} (allowed: {allowed})")]
    Transfer {
        /// What is wrong.
        what: String,
        /// What would not be.
        allowed: &'static str,
    },
    /// Segments of unequal length, which the method does not take.
    #[error(
        "method {method} takes no shorter last step (allowed: equal steps; or trapezoid/trapezoid, front-to-back/POSITION/OPACITY[/depths|/remainder] with subtraction, expm1 or linear)"
    )]
    LastStep {
        /// Its name.
        method: String,
    },
    /// A method that does not go on such rays.
    #[error(transparent)]
    Method(#[from] MethodError),
}

/// Whether there is a picture to be had.
pub(super) fn check(
    raycaster: &Raycaster<'_>,
    frame: &Frame,
    transfer: &TransferFunction,
) -> Result<(), RaycastError> {
    let Raycaster {
        grid,
        camera,
        size: [width, height],
        ..
    } = *raycaster;
    camera.axes().ok_or(RaycastError::Camera)?;
    if !camera.position.into_iter().all(f64::is_finite) {
        return Err(RaycastError::Camera);
    }
    if !shows(camera.lens) {
        return Err(RaycastError::Lens);
    }
    let channels = transfer.channels.len();
    let values = width
        .checked_mul(height)
        .and_then(|pixels| pixels.checked_mul(channels));
    // The values' bytes can be counted too.
    if !values.is_some_and(|values| values > 0 && values <= isize::MAX as usize / 16)
        && channels > 0
    {
        return Err(RaycastError::Size {
            width,
            height,
            channels,
        });
    }
    check_transfer(transfer)?;
    let most = match raycaster.precision {
        Precision::Binary32 => 1 << 20,
        Precision::Binary64 => 1 << 30,
    };
    let least_samples = raycaster.interpolation.least_samples();
    for (axis, found) in grid.dimensions.into_iter().enumerate() {
        if found < least_samples || found > most {
            return Err(RaycastError::Samples {
                axis,
                found,
                least: least_samples,
                most,
                interpolation: raycaster.interpolation,
            });
        }
    }
    let [x, y, z] = grid.dimensions;
    let expected = x.saturating_mul(y).saturating_mul(z);
    if grid.samples.len() != expected {
        return Err(RaycastError::Count {
            found: grid.samples.len(),
            expected,
        });
    }
    let least = frame.diagonal() / most as f64;
    // Not a number is no step either.
    if !(raycaster.step > 0.0 && raycaster.step >= least) {
        return Err(RaycastError::Step {
            step: raycaster.step,
            least,
            most,
        });
    }
    if raycaster.last_step == LastStep::Shorter && Way::of(&raycaster.method).is_none() {
        return Err(RaycastError::LastStep {
            method: raycaster.method.name(),
        });
    }
    check_method(&raycaster.method)
}

fn shows(lens: crate::volume::Lens) -> bool {
    match lens {
        crate::volume::Lens::Orthographic { height } => height > 0.0 && height.is_finite(),
        crate::volume::Lens::Perspective { angle } => angle > 0.0 && angle < std::f64::consts::PI,
    }
}

fn check_method(method: &Method) -> Result<(), RaycastError> {
    super::nodes::segments(method, 1)?;
    Ok(())
}

fn check_transfer(transfer: &TransferFunction) -> Result<(), RaycastError> {
    let wrong = |what: String, allowed| Err(RaycastError::Transfer { what, allowed });
    let channels = transfer.channels.len();
    if channels == 0 {
        return wrong("no channel".into(), "at least one");
    }
    if transfer.points.is_empty() {
        return wrong("no control point".into(), "at least one");
    }
    for (i, point) in transfer.points.iter().enumerate() {
        if point.emission.len() != channels {
            let found = point.emission.len();
            let what = format!("control point {i} has {found} emissions of {channels} channels");
            return wrong(what, "as many");
        }
        let mut numbers = point.emission.iter().chain([&point.s, &point.extinction]);
        if !numbers.all(|number| number.is_finite()) {
            return wrong(format!("control point {i} has no number"), "finite numbers");
        }
        if point.extinction < 0.0 {
            let what = format!("extinction {} at control point {i}", point.extinction);
            return wrong(what, "0 or more");
        }
    }
    let pairs = transfer.points.iter().zip(transfer.points.iter().skip(1));
    match pairs.enumerate().find(|(_, (near, far))| near.s > far.s) {
        Some((i, _)) => wrong(
            format!("control point {} lies below point {i}", i + 1),
            "rising s",
        ),
        None => Ok(()),
    }
}
