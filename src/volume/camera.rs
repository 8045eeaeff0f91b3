//! A camera, and the ray of a place of its picture.

/// How rays leave a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// All along the same direction, over a picture of this height, in units of length.
    Orthographic {
        /// From the lower edge of the picture to the upper.
        height: f64,
    },
    /// All from the camera's place, over this angle between the lower edge of the picture and the upper, in radians.
    Perspective {
        /// Above 0, below π.
        angle: f64,
    },
}

/// A half line from `origin` along `direction`, which has the length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where λ = 0.
    pub origin: [f64; 3],
    /// How the place changes with λ.
    pub direction: [f64; 3],
}

impl Ray {
    /// The place at λ.
    #[must_use]
    pub fn at(&self, lambda: f64) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.origin[axis] + lambda * self.direction[axis])
    }
}

/// A camera: pixels are square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands.
    pub position: [f64; 3],
    /// What it looks at: the middle of the picture.
    pub target: [f64; 3],
    /// What is above in the picture; not along the line of sight.
    pub up: [f64; 3],
    /// How rays leave it.
    pub lens: Lens,
}

impl Camera {
    /// Right, up and forward in the picture, each of the length 1 and orthogonal to the others; `None` where the
    /// camera looks nowhere, or up.
    #[must_use]
    pub fn axes(&self) -> Option<[[f64; 3]; 3]> {
        let forward = unit([0, 1, 2].map(|axis| self.target[axis] - self.position[axis]))?;
        let right = unit(cross(forward, self.up))?;
        Some([right, cross(right, forward), forward])
    }

    /// The ray of a place of a picture of so many pixels: (0, 0) is its upper left corner, (0.5, 0.5) the middle of
    /// the first pixel. Rays of an orthographic camera begin in the plane through its place.
    #[must_use]
    pub fn ray(&self, [width, height]: [usize; 2], [x, y]: [f64; 2]) -> Option<Ray> {
        let [right, up, forward] = self.axes()?;
        let (width, height) = (width as f64, height as f64);
        // In heights of the picture, from its middle.
        let across = (x - width / 2.0) / height;
        let above = (height / 2.0 - y) / height;
        let moved = |from: [f64; 3], scale: f64| {
            [0, 1, 2].map(|i| from[i] + scale * (across * right[i] + above * up[i]))
        };
        Some(match self.lens {
            Lens::Orthographic { height } => Ray {
                origin: moved(self.position, height),
                direction: forward,
            },
            Lens::Perspective { angle } => Ray {
                origin: self.position,
                direction: unit(moved(forward, 2.0 * (angle / 2.0).tan()))?,
            },
        })
    }
}

fn cross([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 3] {
    [b * f - c * e, c * d - a * f, a * e - b * d]
}

fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let [x, y, z] = vector;
    let length = x.hypot(y).hypot(z);
    (length > 0.0 && length.is_finite()).then(|| vector.map(|part| part / length))
}
