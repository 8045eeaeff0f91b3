//! `scene.toml`, as text.

use super::Interpolation;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value as Json;
use toml::Spanned;

/// A scene as a file describes it.
///
/// ```toml
/// name = "smoke"
/// channels = ["red", "green", "blue"]
/// background = [0.1, 0.1, 0.2]
///
/// [[media]]
/// from = 0
/// to = 0.5
/// kind = "vacuum"
///
/// [[media]]
/// from = 0.5
/// to = 2
/// kind = "expression"
/// extinction = "4*exp(-lambda)"
/// emission = ["1", "1/2", "lambda/4"]
/// ```
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[schemars(title = "A scene of volver", transform = without_defaults)]
pub struct SceneFile {
    /// A short name.
    #[serde(default)]
    pub name: Option<String>,
    /// Names of channels; one without a name where this is left out.
    #[serde(default)]
    #[schemars(with = "Vec<String>", length(min = 1, max = 8))]
    pub channels: Option<Spanned<Vec<String>>>,
    /// The radiance that comes in at the far end: one for all channels, or one each. 0 where it is left out.
    #[serde(default)]
    #[schemars(with = "Value")]
    pub background: Option<Spanned<Value>>,
    /// What the media do: emission and absorption, which is what the integral has.
    #[serde(default)]
    #[schemars(with = "Vec<String>")]
    pub features: Option<Spanned<Vec<String>>>,
    /// The media from front to back.
    #[serde(default)]
    #[schemars(with = "Vec<MediumFile>", length(min = 1))]
    pub media: Vec<Spanned<MediumFile>>,
}

/// A medium as a file describes it.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct MediumFile {
    /// A short name.
    #[serde(default)]
    pub name: Option<String>,
    /// Where on the ray it begins.
    #[schemars(with = "Number")]
    pub from: Spanned<Number>,
    /// Where on the ray it ends.
    #[schemars(with = "Number")]
    pub to: Spanned<Number>,
    /// What it is.
    pub kind: KindName,
    /// τ: a number, an expression, or the two ends of a linear one; for all channels or for each.
    #[serde(default)]
    #[schemars(with = "Value")]
    pub extinction: Option<Spanned<Value>>,
    /// C, likewise; 0 where it is left out.
    #[serde(default)]
    #[schemars(with = "Value")]
    pub emission: Option<Spanned<Value>>,
    /// s as an expression of lambda, which extinction and emission are expressions of.
    #[serde(default)]
    #[schemars(with = "String")]
    pub field: Option<Spanned<String>>,
    /// The field at equal distances from the beginning to the end: a list, or a file (CSV or .npy).
    #[serde(default)]
    #[schemars(with = "SamplesFile")]
    pub samples: Option<Spanned<SamplesFile>>,
    /// The distance between samples, checked against the ends.
    #[serde(default)]
    #[schemars(with = "Number")]
    pub spacing: Option<Spanned<Number>>,
    /// What is between samples: linear where this is left out.
    #[serde(default)]
    pub interpolation: Option<Interpolation>,
    /// A file (CSV) with columns s, extinction and emission, or a column for each channel.
    #[serde(default)]
    #[schemars(with = "String")]
    pub table: Option<Spanned<String>>,
    /// What is between entries of the table: linear where this is left out.
    #[serde(default)]
    pub table_interpolation: Option<Interpolation>,
    /// Refused: the integral has no light that changes its direction.
    #[serde(default)]
    #[schemars(skip)]
    pub scattering: Option<Spanned<Json>>,
    /// Refused likewise.
    #[serde(default)]
    #[schemars(skip)]
    pub albedo: Option<Spanned<Json>>,
    /// Refused likewise.
    #[serde(default)]
    #[schemars(skip)]
    pub phase: Option<Spanned<Json>>,
}

/// The kinds of media.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum KindName {
    /// Nothing.
    Vacuum,
    /// Numbers.
    Constant,
    /// Numbers at both ends.
    Linear,
    /// Expressions of lambda, or of s with a field.
    Expression,
    /// Samples of a field.
    Sampled,
}

/// A number, or an expression in quotes.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "no number (allowed: a number, or one in quotes)"
)]
pub enum Number {
    /// 2
    Integer(i64),
    /// 0.5
    Float(f64),
    /// "1/3"
    Text(String),
}

/// A value for all channels, one for each, or those at both ends.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "no value (allowed: a number, an expression in quotes, a list of them, or {front = .., back = ..})"
)]
pub enum Value {
    /// One for all.
    One(Number),
    /// One for each.
    Each(Vec<Number>),
    /// At both ends.
    Ends {
        /// At the front.
        front: Numbers,
        /// At the back.
        back: Numbers,
    },
}

/// One for all channels, or one for each.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "no number (allowed: a number, or a list of them)"
)]
pub enum Numbers {
    /// One for all.
    One(Number),
    /// One for each.
    Each(Vec<Number>),
}

/// Where samples are.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "no samples (allowed: a list of numbers, or the path of a file)"
)]
pub enum SamplesFile {
    /// Here.
    List(Vec<Number>),
    /// In a file beside the scene.
    Path(String),
}

impl SceneFile {
    /// The JSON Schema of the file.
    #[must_use]
    pub fn schema() -> Json {
        schemars::schema_for!(SceneFile).to_value()
    }
}

/// A key that is left out has no value in TOML: not even null.
fn without_defaults(schema: &mut schemars::Schema) {
    fn strip(value: &mut Json) {
        match value {
            Json::Object(map) => {
                if let Some(Json::Object(properties)) = map.get_mut("properties") {
                    for property in properties.values_mut() {
                        if let Some(property) = property.as_object_mut() {
                            property.remove("default");
                        }
                    }
                }
                map.values_mut().for_each(strip);
            }
            Json::Array(values) => values.iter_mut().for_each(strip),
            _ => {}
        }
    }
    let mut value = schema.clone().to_value();
    strip(&mut value);
    if let Ok(stripped) = schemars::Schema::try_from(value) {
        *schema = stripped;
    }
}
