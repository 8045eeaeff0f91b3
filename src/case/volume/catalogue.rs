//! The volumes that come with the program, embedded.

use super::{VolumeCase, read};

/// The texts of the files, in the order of their names.
macro_rules! embedded {
    ($($name:literal,)*) => {
        &[$(($name, include_str!(concat!("catalogue/", $name, ".toml"))),)*]
    };
}

const FILES: &[(&str, &str)] = embedded![
    "blob",
    "jump-sphere",
    "kink-plane",
    "radial",
    "ramp",
    "wave",
];

/// Their names, in order.
pub fn names() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|(name, _)| *name)
}

/// The text of a file.
#[must_use]
pub fn text(name: &str) -> Option<&'static str> {
    FILES
        .iter()
        .find(|(of, _)| *of == name)
        .map(|(_, text)| *text)
}

/// A volume by its name.
#[must_use]
pub fn find(name: &str) -> Option<VolumeCase> {
    read(text(name)?).ok()
}
