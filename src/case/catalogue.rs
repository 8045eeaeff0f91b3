//! The cases that come with the program, each a file beside its derivation, embedded.

use super::file::{Description, FileError};

/// The texts of the case files, in the order of their names.
macro_rules! embedded {
    ($($name:literal,)*) => {
        &[$(($name, include_str!(concat!("catalogue/", $name, ".toml"))),)*]
    };
}

const FILES: &[(&str, &str)] = embedded![
    "absorption-only",
    "aliased-extinction",
    "atmosphere",
    "balanced-jump",
    "beam",
    "cloud",
    "constant-source",
    "decaying-field",
    "deep-growing",
    "deep-rise",
    "deep-uniform",
    "deep-wall",
    "emission-back",
    "emission-bump",
    "emission-cubic",
    "emission-dip",
    "emission-front",
    "emission-jump",
    "even-emission",
    "even-emission-body",
    "even-emission-thin",
    "faint",
    "faint-long",
    "half-length",
    "homogeneous",
    "hyperbolic-tangent",
    "jump-moving",
    "jump-off-node",
    "jump-on-node",
    "kilometres",
    "kink-moving",
    "kink-off-node",
    "kink-on-node",
    "linear-transfer",
    "long-ray",
    "millimetre",
    "oscillating-extinction",
    "oscillating-field",
    "rational-radiance",
    "reciprocal",
    "reciprocal-square",
    "rgb-emission",
    "rgb-layers",
    "rgb-radiance",
    "rgb-transfer",
    "sine-squared",
    "spike-gaussian",
    "spike-lorentzian",
    "spike-sech",
    "square-root-edge",
    "square-root-field",
    "steep-ramp",
    "steep-ramp-clamped",
    "tangent",
    "tent",
    "thick",
    "thick-back",
    "thick-front",
    "transfer-window",
    "two-layers",
    "vacuum",
    "vacuum-gap",
];

/// The names of all cases, in order.
#[must_use]
pub fn names() -> impl ExactSizeIterator<Item = &'static str> {
    FILES.iter().map(|(name, _)| *name)
}

/// The case file of that name.
#[must_use]
pub fn text(name: &str) -> Option<&'static str> {
    let place = FILES.binary_search_by_key(&name, |(name, _)| name).ok()?;
    FILES.get(place).map(|(_, text)| *text)
}

/// The case of that name, as its file describes it; `None` where there is none.
///
/// # Errors
/// [`FileError`], which for the embedded files would be a mistake of this crate.
pub fn find(name: &str) -> Option<Result<Description, FileError>> {
    text(name).map(Description::read)
}
