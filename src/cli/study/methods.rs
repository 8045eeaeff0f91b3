//! Which methods.

use super::asked::{Asked, Asking, split};
use crate::cli::Failure;
use std::str::FromStr;
use volver::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use volver::quadrature::Rule;

/// One for each of the orders 1, 2 and 4.
const DEFAULT: [&str; 3] = [
    "riemann-left/riemann-left",
    "trapezoid/trapezoid",
    "simpson/simpson",
];

pub(super) fn chosen(asking: &Asking, given: &[String]) -> Result<Vec<Method>, Failure> {
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
        let method = method(&name)?;
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

/// INNER/OUTER with an exact exponential.
fn method(name: &Asked) -> Result<Method, Failure> {
    let (inner, outer) = name.text.split_once('/').ok_or_else(|| {
        name.refused(format!(
            "no method '{}' (allowed: INNER/OUTER, such as trapezoid/simpson)",
            name.shown()
        ))
    })?;
    let rule = |text: &str| Rule::from_str(text).map_err(|error| name.refused(error));
    Ok(Method::Nested(Nested {
        inner: Inner::PerSegment(rule(inner)?),
        outer: Outer(rule(outer)?),
        exponential: Exponential::Exact,
        scope: Scope::Whole,
    }))
}
