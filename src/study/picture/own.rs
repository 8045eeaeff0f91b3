//! The library's own renderer as one that is put to the test.

use super::renderer::{Asked, RenderError, Rendered, Renderer};
use crate::method::{Expected, Method};
use crate::raycast::{Interpolation, LastStep, Precision, Raycaster};
use crate::volume::Grid;
use std::str::FromStr;

/// An interpolation, a method and a format.
#[derive(Debug)]
pub struct Own {
    interpolation: Interpolation,
    method: Method,
    precision: Precision,
    /// The grid that is there already.
    grid: Option<(usize, Grid)>,
}

/// What is no renderer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "'{text}' is no renderer of volver's own (allowed: raycast:INTERPOLATION/METHOD[@FORMAT] with nearest, linear or cubic, a method such as front-to-back/middle/expm1, and f32 or f64)"
)]
pub struct OwnError {
    /// As it was given.
    text: String,
}

impl FromStr for Own {
    type Err = OwnError;

    /// `linear/front-to-back/middle/expm1@f32`.
    fn from_str(text: &str) -> Result<Self, OwnError> {
        let error = || OwnError {
            text: text.escape_debug().to_string(),
        };
        let (rule, format) = text.split_once('@').unwrap_or((text, "f64"));
        let (interpolation, method) = rule.split_once('/').ok_or_else(error)?;
        Ok(Own {
            interpolation: match interpolation {
                "nearest" => Interpolation::Nearest,
                "linear" => Interpolation::Linear,
                "cubic" => Interpolation::Cubic,
                _ => return Err(error()),
            },
            method: method.parse().map_err(|_| error())?,
            precision: match format {
                "f32" => Precision::Binary32,
                "f64" => Precision::Binary64,
                _ => return Err(error()),
            },
            grid: None,
        })
    }
}

impl Own {
    /// Orders of the step, of the grid and of pixels, as theory gives them.
    #[must_use]
    pub fn expected(&self) -> [Option<f64>; 3] {
        let of_step = match self.method.order() {
            Expected::Order(order) => Some(order),
            _ => None,
        };
        let of_grid = f64::from(self.interpolation.order());
        // Steps finer than cells see jumps, or kinks, where interpolants of cells meet; those of cubics are small.
        let most: f64 = match self.interpolation {
            Interpolation::Nearest => 1.0,
            Interpolation::Linear => 2.0,
            Interpolation::Cubic => 4.0,
        };
        let of_step = of_step.map(|order| most.min(order));
        [of_step, Some(of_grid), Some(2.0)]
    }
}

impl Renderer for Own {
    fn name(&self) -> String {
        let format = match self.precision {
            Precision::Binary32 => "f32",
            Precision::Binary64 => "f64",
        };
        let interpolation = match self.interpolation {
            Interpolation::Nearest => "nearest",
            Interpolation::Linear => "linear",
            Interpolation::Cubic => "cubic",
        };
        format!("raycast:{interpolation}/{}@{format}", self.method.name())
    }

    fn has_equal_segments(&self) -> Option<bool> {
        Some(true)
    }

    fn render(&mut self, asked: &Asked<'_>) -> Result<Rendered, RenderError> {
        let grid = match self.grid.take() {
            Some((cells, grid)) if cells == asked.cells => grid,
            _ => asked.case.sampled([asked.cells + 1; 3]),
        };
        let picture = Raycaster {
            grid: &grid,
            transfer: &asked.case.transfer,
            camera: asked.case.camera,
            size: asked.size,
            step: asked.step,
            last_step: LastStep::Equal,
            interpolation: self.interpolation,
            method: self.method,
            precision: self.precision,
            opacity: false,
        }
        .render();
        self.grid = Some((asked.cells, grid));
        let picture = picture.map_err(|error| RenderError::Given(error.to_string()))?;
        Ok(Rendered {
            image: picture.image,
            quantum: None,
        })
    }
}
