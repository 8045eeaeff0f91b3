//! What a library declares, as it says it.

use crate::kernel::{Declaration, DepthWeights, FormKind, Quantity};
use std::num::NonZeroU64;
use std::str::FromStr;

/// `volver_declaration`, with its strings.
#[derive(Debug)]
// Facts that do not depend on each other.
#[allow(clippy::struct_excessive_bools)]
pub(super) struct Declared {
    pub(super) name: Option<String>,
    pub(super) form: Option<String>,
    pub(super) method: Option<String>,
    pub(super) format: Option<String>,
    pub(super) sampling: Option<String>,
    pub(super) order: f64,
    pub(super) quantum: f64,
    pub(super) stochastic: bool,
    pub(super) far_wall: bool,
    pub(super) step_divides: bool,
    /// 0 for any.
    pub(super) multiple_of: u64,
    /// By bits; 0 for the radiance.
    pub(super) answers: u32,
    pub(super) by_opacity: bool,
    pub(super) background: bool,
    pub(super) language: Option<String>,
}

impl Declared {
    /// The declaration, or what is wrong with it.
    pub(super) fn checked(self, default_name: &str) -> Result<Declaration, String> {
        let form = form(self.form.as_deref(), self.language)?;
        let order = Some(self.order).filter(|order| !order.is_nan());
        if let Some(order) = order.filter(|order| !order.is_finite() || *order < 0.0) {
            return Err(format!(
                "it declares order {order} (allowed: finite, 0 or above, or NaN for none)"
            ));
        }
        let quantum = self.quantum;
        if !(quantum.is_finite() && quantum >= 0.0) {
            return Err(format!(
                "it declares a quantum of {quantum} (allowed: finite, above 0, or 0 for none)"
            ));
        }
        let name = self.name.filter(|name| !name.trim().is_empty());
        let mut declaration = Declaration::new(name.as_deref().unwrap_or(default_name));
        if let Some(format) = parsed(self.format)? {
            declaration.format = format;
        }
        Ok(Declaration {
            form,
            method: parsed(self.method)?,
            order,
            quantum: Some(quantum).filter(|quantum| *quantum > 0.0),
            stochastic: self.stochastic,
            sampling: parsed(self.sampling)?,
            far_wall: self.far_wall,
            step_divides: self.step_divides,
            multiple_of: NonZeroU64::new(self.multiple_of).unwrap_or(NonZeroU64::MIN),
            background: self.background,
            answers: answers(self.answers)?,
            expected_depth: if self.by_opacity {
                DepthWeights::ByOpacity
            } else {
                DepthWeights::Plain
            },
            ..declaration
        })
    }
}

/// What the bits of `VOLVER_RADIANCE` and the others name.
fn answers(bits: u32) -> Result<Vec<Quantity>, String> {
    if bits == 0 {
        return Ok(vec![Quantity::Radiance]);
    }
    let known = (1 << Quantity::ALL.len()) - 1;
    if bits > known {
        return Err(format!(
            "it declares answers {bits:#x} (allowed: 0x1 to {known:#x}, of VOLVER_RADIANCE and the others)"
        ));
    }
    let all = Quantity::ALL.into_iter().enumerate();
    let named = all.filter(|(place, _)| bits >> place & 1 == 1);
    Ok(named.map(|(_, quantity)| quantity).collect())
}

fn form(form: Option<&str>, language: Option<String>) -> Result<FormKind, String> {
    let form = match (form, language) {
        (Some("formula"), Some(language)) => {
            let read = language.parse();
            return read
                .map(FormKind::Formula)
                .map_err(|error| format!("it declares a language: {error}"));
        }
        (Some("formula"), None) => {
            return Err("it declares no language of the formula (allowed: c, python, rust)".into());
        }
        (None | Some("segments"), None) => FormKind::Segments,
        (Some("function"), None) => FormKind::Function,
        (Some("volume"), None) => FormKind::Volume,
        (None | Some("segments" | "function" | "volume"), Some(_)) => {
            return Err(
                "it declares a language without need (allowed: with the form formula)".into(),
            );
        }
        (Some(other), _) => {
            let form = other.escape_debug();
            return Err(format!(
                "it declares form '{form}' (allowed: segments, function, volume, formula)"
            ));
        }
    };
    Ok(form)
}

fn parsed<T: FromStr<Err: ToString>>(text: Option<String>) -> Result<Option<T>, String> {
    let read = |text: String| {
        text.parse()
            .map_err(|error: T::Err| format!("in its declaration: {}", error.to_string()))
    };
    text.map(read).transpose()
}
