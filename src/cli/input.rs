//! Text that a command reads.

use super::Failure;
use std::fs;
use std::io::{self, Read};

/// The text of a file, or of standard input for `-`.
pub(super) fn read(path: &str) -> Result<String, Failure> {
    let text = if path == "-" {
        let mut text = String::new();
        io::stdin().lock().read_to_string(&mut text).map(|_| text)
    } else {
        fs::read_to_string(path)
    };
    text.map_err(|error| Failure::Input {
        path: path.into(),
        error,
    })
}
