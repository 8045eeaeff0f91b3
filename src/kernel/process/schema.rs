//! The messages as a JSON Schema.

use super::frame::message::{WireFrame, WireFrameAnswer};
use super::message::{Answer, KernelHello, Render, VolverHello};
use super::number::Number;
use super::written::{Array, Written};
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};
use std::borrow::Cow;

/// The JSON Schema of one line of the protocol, whoever writes it.
#[must_use]
pub fn schema() -> Value {
    let mut generator = SchemaGenerator::new(SchemaSettings::draft2020_12());
    let messages = [
        generator.subschema_for::<VolverHello>(),
        generator.subschema_for::<KernelHello>(),
        generator.subschema_for::<Render<'_>>(),
        generator.subschema_for::<Answer>(),
        generator.subschema_for::<WireFrame<'_>>(),
        generator.subschema_for::<WireFrameAnswer>(),
    ];
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A message of volver's protocol, versions 1 and 2",
        "oneOf": messages,
        "$defs": generator.take_definitions(true),
    })
}

impl JsonSchema for Number {
    fn schema_name() -> Cow<'static, str> {
        "Number".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Binary64 as a JSON number; anything else as text: a decimal of any length, a hexadecimal float, nan, inf or -inf.",
            "anyOf": [
                { "type": "number" },
                {
                    "type": "string",
                    "pattern": "^[-+]?([0-9]+\\.?[0-9]*([eE][-+]?[0-9]+)?|\\.[0-9]+([eE][-+]?[0-9]+)?|0[xX][0-9a-fA-F]+\\.?[0-9a-fA-F]*([pP][-+]?[0-9]+)?|[nN][aA][nN]|[iI][nN][fF]([iI][nN][iI][tT][yY])?)$",
                },
            ],
        })
    }
}

impl JsonSchema for Written {
    fn schema_name() -> Cow<'static, str> {
        "Binary64".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A binary64: a JSON number, or text if the kernel wants hexadecimal floats, or if it is nan, inf or -inf.",
            "anyOf": [
                { "type": "number" },
                {
                    "type": "string",
                    "pattern": "^(-?0x[01](\\.[0-9a-f]+)?p[-+][0-9]+|nan|-?inf)$",
                },
            ],
        })
    }
}

impl JsonSchema for Array<'_> {
    fn schema_name() -> Cow<'static, str> {
        "Array".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let number = generator.subschema_for::<Written>();
        json_schema!({
            "anyOf": [
                { "type": "array", "items": number },
                {
                    "description": "The path of a file in NumPy's format: binary64, little-endian, one axis. It is there until the answer.",
                    "type": "object",
                    "properties": { "npy": { "type": "string" } },
                    "required": ["npy"],
                    "additionalProperties": false,
                },
            ],
        })
    }
}
