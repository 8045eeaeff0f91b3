//! The messages as a JSON Schema.

use super::message::{KernelHello, Radiance, Render, VolverHello};
use schemars::SchemaGenerator;
use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

/// The JSON Schema of one line of the protocol, whoever writes it.
#[must_use]
pub fn schema() -> Value {
    let mut generator = SchemaGenerator::new(SchemaSettings::draft2020_12());
    let messages = [
        generator.subschema_for::<VolverHello>(),
        generator.subschema_for::<KernelHello>(),
        generator.subschema_for::<Render<'_>>(),
        generator.subschema_for::<Radiance>(),
    ];
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": format!("A message of volver's protocol, version {}", super::VERSION),
        "oneOf": messages,
        "$defs": generator.take_definitions(true),
    })
}
