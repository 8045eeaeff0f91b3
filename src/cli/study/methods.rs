//! Which methods.

use super::asked::{Asked, Asking, split};
use crate::cli::Failure;
use std::str::FromStr;
use volver::method::Method;

/// One for each of the orders 1, 2 and 4, and what most renderers do.
const DEFAULT: [&str; 4] = [
    "riemann-left/riemann-left",
    "trapezoid/trapezoid",
    "simpson/simpson",
    "front-to-back/middle/subtraction",
];

pub(in crate::cli) fn chosen(asking: &Asking, given: &[String]) -> Result<Vec<Method>, Failure> {
    let in_file = asking.file.methods.as_ref();
    let asked = asking.names("--methods", given, in_file, "methods", split)?;
    let default = || {
        let asked = |text: &str| Asked {
            text: text.into(),
            at: "--methods".into(),
            directory: None,
        };
        DEFAULT.map(asked).to_vec()
    };
    let mut methods = Vec::new();
    for name in asked.unwrap_or_else(default) {
        let method = Method::from_str(&name.text).map_err(|error| name.refused(error))?;
        if methods.contains(&method) {
            let why = format!(
                "'{}' a second time (allowed: each method once)",
                name.shown()
            );
            return Err(name.refused(why));
        }
        methods.push(method);
    }
    Ok(methods)
}
