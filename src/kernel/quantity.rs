//! What a kernel may answer of a ray.

use std::fmt;

/// A number, or one a channel, that a kernel answers of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// I, of every channel.
    Radiance,
    /// 1 − T of the whole ray.
    Opacity,
    /// t of the whole ray: the integral of τ.
    OpticalDepth,
    /// Where along the ray the light is taken from: the mean of λ with weights τ e^(−t), divided by the opacity
    /// where the kernel says so.
    ExpectedDepth,
    /// ∫ j dλ, the radiance of a source j per length where nothing absorbs; of a kernel whose source is per length.
    Emission,
}

impl Quantity {
    /// Those that kernels answer, in the order in which they are reported.
    pub const ALL: [Quantity; 4] = [
        Quantity::Radiance,
        Quantity::Opacity,
        Quantity::OpticalDepth,
        Quantity::ExpectedDepth,
    ];

    /// Those that are measured: the emission is the radiance of a ray of its own.
    pub const MEASURED: [Quantity; 5] = [
        Quantity::Radiance,
        Quantity::Opacity,
        Quantity::OpticalDepth,
        Quantity::ExpectedDepth,
        Quantity::Emission,
    ];

    /// Its name, as in the protocol and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Radiance => "radiance",
            Quantity::Opacity => "opacity",
            Quantity::OpticalDepth => "optical_depth",
            Quantity::ExpectedDepth => "expected_depth",
            Quantity::Emission => "emission",
        }
    }
}

impl fmt::Display for Quantity {
    /// In words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Quantity::Radiance => "radiance",
            Quantity::Opacity => "opacity",
            Quantity::OpticalDepth => "optical depth",
            Quantity::ExpectedDepth => "expected depth",
            Quantity::Emission => "emission",
        })
    }
}

/// What an expected depth is divided by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DepthWeights {
    /// Nothing: Σ w λ.
    #[default]
    Plain,
    /// The opacity: Σ w λ / Σ w.
    ByOpacity,
}

impl DepthWeights {
    /// Its name, as in the protocol and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            DepthWeights::Plain => "plain",
            DepthWeights::ByOpacity => "by-opacity",
        }
    }
}
