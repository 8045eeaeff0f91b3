//! What came out of a plan that was run.

use crate::document::{About, Block, Cell, Column, Conclusion, Document, Section, Table};
use crate::real::Format;
use crate::report::ReportError;
use crate::study::plan::{Plan, Rendered};
use serde::Serialize;

/// What came out of a plan that was run, with all digits.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Rendering {
    volver: &'static str,
    scene: String,
    format: String,
    evaluations: u64,
    channels: Vec<Row>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
struct Row {
    channel: String,
    radiance: String,
    transmittance: String,
}

impl Rendering {
    /// What `rendered` is, by the names of the channels of the plan's scene.
    #[must_use]
    pub fn new<F: Format>(plan: &Plan, format: F, rendered: &Rendered<F::Real>) -> Self {
        let both = rendered.radiance.iter().zip(&rendered.transmittance);
        let names = plan.scene().channels().iter();
        let channels = names
            .zip(both)
            .map(|(name, (radiance, transmittance))| Row {
                channel: name.clone(),
                radiance: radiance.to_string(),
                transmittance: transmittance.to_string(),
            });
        Rendering {
            volver: env!("CARGO_PKG_VERSION"),
            scene: plan.scene().name().into(),
            format: format.to_string(),
            evaluations: rendered.evaluations,
            channels: channels.collect(),
        }
    }

    /// Radiance and transmittance, a row a channel.
    #[must_use]
    pub fn document(&self, about: &About) -> Document {
        let title = format!("The radiance of {}", self.scene);
        let mut document = Document::new("render", title, about.clone());
        let titles = ["channel", "radiance", "transmittance"];
        let rows = self.channels.iter().map(|of| {
            let texts = [&of.channel, &of.radiance, &of.transmittance];
            texts.map(Cell::text).into()
        });
        let table = Table::new(&document.title, titles.map(Column::text)).with(rows);
        let section = Section::of("radiance", &self.scene, [Block::Table(table)]);
        document.sections.push(section);
        let plural = if self.evaluations == 1 { "" } else { "s" };
        document.conclusion = Some(Conclusion::new(format!(
            "{} evaluation{plural} in {}",
            self.evaluations, self.format
        )));
        document
    }

    /// One JSON document.
    ///
    /// # Errors
    /// [`ReportError::Json`], which no rendering is known to cause.
    pub fn json(&self) -> Result<String, ReportError> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }
}
