//! Pictures of radiance: numbers, not colours.

pub mod file;

/// A picture: rows from the upper edge down, each from left to right, the channels of a pixel side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The names of the channels, in the order of the values.
    pub channels: Vec<String>,
    /// width · height · channels values.
    pub values: Vec<f64>,
}

impl Image {
    /// Of zeros.
    #[must_use]
    pub fn new(width: usize, height: usize, channels: Vec<String>) -> Image {
        let values = vec![0.0; width * height * channels.len()];
        Image {
            width,
            height,
            channels,
            values,
        }
    }

    /// The channels of a pixel, (0, 0) in the upper left corner; empty outside.
    #[must_use]
    pub fn pixel(&self, x: usize, y: usize) -> &[f64] {
        let many = self.channels.len();
        let from = (y * self.width + x) * many;
        let inside = x < self.width && y < self.height;
        let pixel = inside.then(|| self.values.get(from..from + many));
        pixel.flatten().unwrap_or_default()
    }
}
