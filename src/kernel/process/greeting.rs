//! What a kernel says of itself, and how it wants to be talked to.

mod accuracy;

use super::frame;
use super::message::{
    Arrays, Form, HelloTag, KernelHello, VolverHello, WireLanguage, WireQuantity, WireStep,
};
use super::number::Number;
use super::trouble::{Trouble, said};
use super::written::Numbers;
use super::{SECOND, VERSION, VERSIONS};
use crate::kernel::{Declaration, DepthWeights, FormKind, Quantity, Source};
use crate::real::FormatName;
use crate::symbolic::code::Language;
use serde_json::Value;
use std::fmt::Display;
use std::num::{NonZeroU64, NonZeroUsize};
use std::str::FromStr;

/// The longest name, in characters.
const MAX_NAME: usize = 100;

/// A greeting that makes sense.
#[derive(Clone, Debug, PartialEq)]
pub struct Greeting {
    /// The version of the protocol that it keeps to.
    pub version: u64,
    /// What it declares.
    pub declaration: Declaration,
    /// How it wants its numbers.
    pub numbers: Numbers,
    pub(super) arrays: Arrays,
    /// The line itself.
    pub said: String,
}

/// What volver says first.
pub(super) fn hello() -> VolverHello {
    VolverHello {
        tag: HelloTag::Hello,
        protocol: VERSION,
        protocols: VERSIONS,
        program: concat!("volver ", env!("CARGO_PKG_VERSION")),
    }
}

/// The kernel's answer to that.
///
/// # Errors
/// [`Trouble`] where it makes no sense.
pub fn read(line: &[u8]) -> Result<Greeting, Trouble> {
    let value: Value = match serde_json::from_slice(line) {
        Ok(value @ Value::Object(_)) => value,
        Ok(_) | Err(_) => return Err(Trouble::garbage("no JSON object", line)),
    };
    // Another version may well have other keys: that is said first.
    let version = value.get("protocol");
    let known = version.and_then(Value::as_u64);
    match (version, known.filter(|known| VERSIONS.contains(known))) {
        (Some(version), None) => {
            let allowed = VERSIONS.map(|version| version.to_string()).join(", ");
            Err(format!("protocol {version} (allowed: {allowed})"))
        }
        // Without one it is refused as any other key that is needed.
        (_, known) => serde_json::from_value(value)
            .map_err(|error| said(&error))
            .and_then(|hello| greeting(known.unwrap_or(VERSION), hello))
            .map(|greeting| Greeting {
                said: String::from_utf8_lossy(line.trim_ascii_end()).into_owned(),
                ..greeting
            }),
    }
    .map_err(|problem| Trouble::Greeting { problem })
}

fn greeting(version: u64, hello: KernelHello) -> Result<Greeting, String> {
    if hello.background.is_some() && version < SECOND {
        return Err(of_second("background", version));
    }
    if hello.gradient.is_some() && version < SECOND {
        return Err(of_second("gradient", version));
    }
    if hello.adjoint.is_some() && version < SECOND {
        return Err(of_second("adjoint", version));
    }
    if hello.batch.is_some() && version < SECOND {
        return Err(of_second("batch", version));
    }
    let exact = accuracy::of(version, &hello)?;
    let answers = answers(version, hello.answers)?;
    let expected_depth = match hello.expected_depth {
        None => DepthWeights::default(),
        Some(weights) if answers.contains(&Quantity::ExpectedDepth) => weights.into(),
        Some(_) => {
            return Err(
                "expected_depth without need (allowed: where it is among the answers)".into(),
            );
        }
    };
    let name = hello.name;
    if !(1..=MAX_NAME).contains(&name.chars().count()) || name.chars().any(char::is_control) {
        return Err(format!(
            "name '{}' (allowed: 1 to {MAX_NAME} characters that can be seen)",
            name.escape_debug()
        ));
    }
    let form = match (hello.form, hello.language) {
        (Form::Segments, None) => FormKind::Segments,
        (Form::Volume, None) => FormKind::Volume,
        (Form::Formula, Some(language)) => FormKind::Formula(match language {
            WireLanguage::Python => Language::Python,
            WireLanguage::C => Language::C,
            WireLanguage::Rust => Language::Rust,
        }),
        (Form::Formula, None) => {
            return Err("no language of the formula (allowed: python, c, rust)".into());
        }
        (Form::Segments | Form::Volume, Some(_)) => {
            return Err("a language without need (allowed: with the form formula)".into());
        }
    };
    if hello.gradient.is_some() && form != FormKind::Segments {
        return Err("gradient of another form (allowed: with the form segments)".into());
    }
    let is_projector = hello.gradient.is_some() && answers[..] == [Quantity::OpticalDepth];
    if hello.adjoint.is_some() && !is_projector {
        return Err(
            "adjoint of no projector (allowed: beside gradient and the answers [\"optical_depth\"])".into(),
        );
    }
    let format = match hello.format {
        Some(name) => named("format", &name)?,
        None => FormatName::F64,
    };
    if exact.source == Source::Length && form != FormKind::Segments {
        return Err("source per length of another form (allowed: with the form segments)".into());
    }
    let declaration = Declaration {
        name,
        form,
        batch: batch(hello.batch, form, format)?,
        gradient: hello.gradient.map(Into::into),
        adjoint: hello.adjoint.map(Into::into),
        method: hello
            .method
            .map(|name| named("method", &name))
            .transpose()?,
        order: above_zero("order", hello.order.as_ref())?,
        format,
        stochastic: hello.stochastic,
        sampling: hello.sampling.map(Into::into),
        step_divides: hello.step.is_some_and(|WireStep::Divides| true),
        multiple_of: match hello.segments.map(|segments| segments.multiple_of) {
            None => NonZeroU64::MIN,
            Some(multiple) => NonZeroU64::new(multiple)
                .ok_or("segments: multiples of 0 (allowed: of 1 or more)")?,
        },
        far_wall: hello.far_wall,
        background: hello.background.unwrap_or(false),
        answers,
        expected_depth,
        ..exact
    };
    Ok(Greeting {
        version,
        declaration,
        numbers: hello.numbers,
        arrays: hello.arrays,
        said: String::new(),
    })
}

/// A key that the first version has not.
fn of_second(key: &str, version: u64) -> String {
    format!("{key} in protocol {version} (allowed: in protocol {SECOND})")
}

/// How many rays at once it takes.
fn batch(
    declared: Option<u64>,
    form: FormKind,
    format: FormatName,
) -> Result<Option<NonZeroUsize>, String> {
    let Some(count) = declared else {
        return Ok(None);
    };
    if form != FormKind::Segments {
        return Err("batch of another form (allowed: with the form segments)".into());
    }
    if format.bits() > f64::MANTISSA_DIGITS {
        return Err(format!(
            "batch of the format {format}, whose numbers have no room in binary64 (allowed: formats of up to {} bits)",
            f64::MANTISSA_DIGITS
        ));
    }
    let known = Some(count).filter(|count| frame::RAYS.contains(count));
    let known = known.and_then(|count| NonZeroUsize::new(usize::try_from(count).ok()?));
    known.map(Some).ok_or_else(|| {
        let (least, most) = (frame::RAYS.start(), frame::RAYS.end());
        format!("batch {count} (allowed: {least} to {most})")
    })
}

/// What it answers, in volver's order.
fn answers(version: u64, declared: Option<Vec<WireQuantity>>) -> Result<Vec<Quantity>, String> {
    let Some(declared) = declared else {
        return Ok(vec![Quantity::Radiance]);
    };
    if version < SECOND {
        return Err(of_second("answers", version));
    }
    let mut answers: Vec<Quantity> = declared.into_iter().map(Into::into).collect();
    let count = answers.len();
    answers.sort_unstable();
    answers.dedup();
    match answers.len() {
        0 => Err("no answers (allowed: one or more)".into()),
        different if different < count => Err("the same answer twice (allowed: each once)".into()),
        _ => Ok(answers),
    }
}

fn named<T: FromStr<Err: Display>>(key: &str, name: &str) -> Result<T, String> {
    name.parse().map_err(|error| format!("{key}: {error}"))
}

fn above_zero(key: &str, number: Option<&Number>) -> Result<Option<f64>, String> {
    let Some(number) = number else {
        return Ok(None);
    };
    let value = number.to_f64();
    if value.is_finite() && value > 0.0 {
        return Ok(Some(value));
    }
    Err(format!("{key} {value} (allowed: finite, above 0)"))
}

impl Greeting {
    /// The keys in which another greeting differs.
    #[must_use]
    pub fn changes(&self, other: &Greeting) -> Vec<&'static str> {
        let (a, b) = (&self.declaration, &other.declaration);
        [
            ("protocol", self.version == other.version),
            ("name", a.name == b.name),
            ("form", a.form == b.form),
            ("method", a.method == b.method),
            ("order", a.order == b.order),
            ("format", a.format == b.format),
            ("output", a.output == b.output),
            ("quantum", a.quantum == b.quantum),
            ("exp_ulp", a.exp_ulp == b.exp_ulp),
            ("expm1_ulp", a.expm1_ulp == b.expm1_ulp),
            ("pow_ulp", a.pow_ulp == b.pow_ulp),
            ("subnormals", a.subnormals_lost == b.subnormals_lost),
            ("noise", a.noise == b.noise),
            ("channels", a.channels == b.channels),
            ("emission", a.positive_emission == b.positive_emission),
            ("source", a.source == b.source),
            ("stochastic", a.stochastic == b.stochastic),
            ("sampling", a.sampling == b.sampling),
            ("step", a.step_divides == b.step_divides),
            ("segments", a.multiple_of == b.multiple_of),
            ("far_wall", a.far_wall == b.far_wall),
            ("background", a.background == b.background),
            ("gradient", a.gradient == b.gradient),
            ("adjoint", a.adjoint == b.adjoint),
            ("batch", a.batch == b.batch),
            ("answers", a.answers == b.answers),
            ("expected_depth", a.expected_depth == b.expected_depth),
            ("numbers", self.numbers == other.numbers),
            ("arrays", self.arrays == other.arrays),
        ]
        .into_iter()
        .filter_map(|(key, same)| (!same).then_some(key))
        .collect()
    }
}
