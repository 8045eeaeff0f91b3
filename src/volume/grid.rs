//! Samples of a field on a regular grid in space.

/// The values, the first axis (x) fastest.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// In binary32.
    F32(Vec<f32>),
    /// In binary64.
    F64(Vec<f64>),
}

impl Samples {
    /// How many.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Samples::F32(values) => values.len(),
            Samples::F64(values) => values.len(),
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The value at a place of the array; NaN where there is none.
    #[must_use]
    pub fn at(&self, index: usize) -> f64 {
        match self {
            Samples::F32(values) => values
                .get(index)
                .map_or(f64::NAN, |&value| f64::from(value)),
            Samples::F64(values) => values.get(index).copied().unwrap_or(f64::NAN),
        }
    }
}

/// Samples of a field: sample (i, j, k) stands at origin + D (spacing ∘ (i, j, k)).
///
/// Samples are points, and the volume is the box that the outermost of them span: (n − 1) · spacing along each axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// How many samples along x, y and z.
    pub dimensions: [usize; 3],
    /// Where the first sample stands.
    pub origin: [f64; 3],
    /// The distance of samples along each axis, above 0.
    pub spacing: [f64; 3],
    /// D, row by row: its columns are the directions of the axes.
    pub direction: [[f64; 3]; 3],
    /// The product of the dimensions as many values, x fastest, z slowest.
    pub samples: Samples,
}

impl Grid {
    /// The direction of a grid along the axes.
    pub const ALONG_AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// The place of sample (i, j, k) in the array.
    #[must_use]
    pub fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        let [width, height, _] = self.dimensions;
        i + width * (j + height * k)
    }

    /// Where sample (i, j, k) stands; numbers between are places between samples.
    #[must_use]
    pub fn place(&self, index: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = [0, 1, 2].map(|axis| self.spacing[axis] * index[axis]);
        [0, 1, 2].map(|row| {
            let [a, b, c] = self.direction[row];
            self.origin[row] + (a * x + b * y + c * z)
        })
    }

    /// The determinant of D: below 0 of a mirrored grid.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.direction;
        a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    }
}
