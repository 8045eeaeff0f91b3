//! Fields in space, by formulas.

use crate::volume::Ray;

/// s = offset + height · shape(x).
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Added.
    pub offset: f64,
    /// Multiplied.
    pub height: f64,
    /// What changes from place to place.
    pub shape: Shape,
}

/// What a field is like.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// g · x: linear in any direction.
    Ramp {
        /// g, per unit of length.
        slope: [f64; 3],
    },
    /// |x − c|: analytic but at c.
    Radial {
        /// c.
        center: [f64; 3],
    },
    /// sin(k · x + φ).
    Wave {
        /// k, in radians per unit of length.
        wave: [f64; 3],
        /// φ, in radians.
        phase: f64,
    },
    /// exp(−|x − c|²/w²).
    Blob {
        /// c.
        center: [f64; 3],
        /// w.
        width: f64,
    },
    /// |n · x − o|: a kink in a plane.
    Kink {
        /// n, per unit of length.
        normal: [f64; 3],
        /// o.
        place: f64,
    },
    /// 1 where |x − c| < r, and 0 elsewhere.
    Jump {
        /// c.
        center: [f64; 3],
        /// r.
        radius: f64,
    },
}

/// What a shape is along a ray, from its argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Along {
    /// a + b λ.
    Linear {
        /// a.
        at: f64,
        /// b.
        slope: f64,
    },
    /// The squared distance from a centre: a (λ − λ₀)² + ρ², in which nothing cancels.
    Squared {
        /// a.
        square: f64,
        /// λ₀.
        nearest: f64,
        /// ρ².
        apart: f64,
    },
}

impl Along {
    pub(super) fn at(self, lambda: f64) -> f64 {
        match self {
            Along::Linear { at, slope } => at + slope * lambda,
            Along::Squared {
                square,
                nearest,
                apart,
            } => square * (lambda - nearest) * (lambda - nearest) + apart,
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn away(place: [f64; 3], center: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| place[axis] - center[axis])
}

impl Field {
    /// s(x).
    #[must_use]
    pub fn at(&self, place: [f64; 3]) -> f64 {
        let argument = match &self.shape {
            Shape::Ramp { slope } => dot(*slope, place),
            Shape::Wave { wave, phase } => dot(*wave, place) + phase,
            Shape::Kink { normal, place: o } => dot(*normal, place) - o,
            Shape::Radial { center } | Shape::Blob { center, .. } | Shape::Jump { center, .. } => {
                let from = away(place, *center);
                dot(from, from)
            }
        };
        self.of(argument)
    }

    /// s of the argument: a linear function of the place, or the squared distance from the centre.
    pub(super) fn of(&self, argument: f64) -> f64 {
        let shape = match &self.shape {
            Shape::Ramp { .. } => argument,
            Shape::Radial { .. } => argument.max(0.0).sqrt(),
            Shape::Wave { .. } => argument.sin(),
            Shape::Blob { width, .. } => (-argument / (width * width)).exp(),
            Shape::Kink { .. } => argument.abs(),
            Shape::Jump { radius, .. } => f64::from(u8::from(argument < radius * radius)),
        };
        self.offset + self.height * shape
    }

    /// The argument along a ray.
    pub(super) fn along(&self, ray: &Ray) -> Along {
        let linear = |vector: [f64; 3], offset: f64| Along::Linear {
            at: dot(vector, ray.origin) + offset,
            slope: dot(vector, ray.direction),
        };
        match &self.shape {
            Shape::Ramp { slope } => linear(*slope, 0.0),
            Shape::Wave { wave, phase } => linear(*wave, *phase),
            Shape::Kink { normal, place } => linear(*normal, -place),
            Shape::Radial { center } | Shape::Blob { center, .. } | Shape::Jump { center, .. } => {
                let square = dot(ray.direction, ray.direction);
                let nearest = -dot(away(ray.origin, *center), ray.direction) / square;
                let apart = away(ray.at(nearest), *center);
                Along::Squared {
                    square,
                    nearest,
                    apart: dot(apart, apart),
                }
            }
        }
    }

    /// The same field moved by a vector.
    #[must_use]
    pub fn moved(&self, by: [f64; 3]) -> Field {
        let to = |center: &[f64; 3]| [0, 1, 2].map(|axis| center[axis] + by[axis]);
        let mut field = self.clone();
        match &mut field.shape {
            Shape::Ramp { slope } => field.offset -= field.height * dot(*slope, by),
            Shape::Wave { wave, phase } => *phase -= dot(*wave, by),
            Shape::Kink { normal, place } => *place += dot(*normal, by),
            Shape::Radial { center } | Shape::Blob { center, .. } | Shape::Jump { center, .. } => {
                *center = to(center);
            }
        }
        field
    }

    /// Whether it is smooth everywhere in space, but perhaps at single points.
    #[must_use]
    pub fn is_smooth(&self) -> bool {
        !matches!(self.shape, Shape::Kink { .. } | Shape::Jump { .. })
    }

    /// Whether interpolation linear between samples is exact.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        matches!(self.shape, Shape::Ramp { .. })
    }
}
