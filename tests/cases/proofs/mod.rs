//! The code does what the theorems of `proofs/theory/` speak about.

mod bounds;
mod compositing;
mod limits;
mod opacity;
mod prove;
mod readme;
mod rules;
mod script;

use std::path::{Path, PathBuf};

fn proofs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("proofs")
}

/// A file of the theory, every stretch of white space as one blank.
fn theory(file: &str) -> String {
    let text = std::fs::read_to_string(proofs().join("theory").join(file)).unwrap();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
