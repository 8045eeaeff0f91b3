//! What a library declares, as it says it.

use crate::kernel::{Declaration, DepthWeights, FormKind, Quantity, Quantum, Source, UlpBound};
use std::num::{NonZeroU64, NonZeroUsize};
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
    pub(super) output: Option<String>,
    pub(super) quantum_is_relative: bool,
    /// a and b; both 0 for what rounds right.
    pub(super) exp_ulp: [f64; 2],
    pub(super) expm1_ulp: [f64; 2],
    pub(super) pow_ulp: [f64; 2],
    pub(super) subnormals_lost: bool,
    pub(super) noise: f64,
    /// 0 for any.
    pub(super) channels: u32,
    pub(super) positive_emission: bool,
    pub(super) source_per_length: bool,
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
        let quantum = above_zero("a quantum", self.quantum)?;
        let kind = if self.quantum_is_relative {
            Quantum::Relative
        } else {
            Quantum::Absolute
        };
        let quantum = quantum.map(kind);
        let name = self.name.filter(|name| !name.trim().is_empty());
        let mut declaration = Declaration::new(name.as_deref().unwrap_or(default_name));
        if let Some(format) = parsed(self.format)? {
            declaration.format = format;
        }
        Ok(Declaration {
            form,
            method: parsed(self.method)?,
            order,
            output: parsed(self.output)?,
            quantum,
            exp_ulp: ulp("exp_ulp", self.exp_ulp)?,
            expm1_ulp: ulp("expm1_ulp", self.expm1_ulp)?,
            pow_ulp: ulp("pow_ulp", self.pow_ulp)?,
            subnormals_lost: self.subnormals_lost,
            noise: above_zero("noise", self.noise)?,
            channels: usize::try_from(self.channels)
                .ok()
                .and_then(NonZeroUsize::new),
            positive_emission: self.positive_emission,
            source: if self.source_per_length {
                Source::Length
            } else {
                Source::Depth
            },
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

/// None where it is 0.
fn above_zero(what: &str, value: f64) -> Result<Option<f64>, String> {
    if value.is_finite() && value >= 0.0 {
        return Ok(Some(value).filter(|value| *value > 0.0));
    }
    Err(format!(
        "it declares {what} of {value} (allowed: finite, above 0, or 0 for none)"
    ))
}

/// None where both parts are 0.
fn ulp(what: &str, [a, b]: [f64; 2]) -> Result<Option<UlpBound>, String> {
    let bound = UlpBound::new(a, b).map_err(|error| format!("it declares {what}: {error}"))?;
    Ok(Some(bound).filter(|_| a > 0.0 || b > 0.0))
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
