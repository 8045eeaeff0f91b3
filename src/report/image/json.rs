//! Everything, for programs.

use super::{Imaged, Standing};
use crate::render::ReportError;
use crate::study::picture::{Likeness, Measured};
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    renderer: &'a str,
    volume: &'a str,
    standing: &'static str,
    axes: &'a [Measured],
    like: &'a [Likeness],
    not_finite: usize,
    quantum: Option<f64>,
    width: usize,
    height: usize,
}

/// `{"volver": version, "renderer": …, "standing": "confirmed", "axes": […], "like": […]}`, indented, with a newline at the
/// end.
///
/// # Errors
/// [`ReportError::Json`], which no result is known to cause.
pub fn json(imaged: &Imaged) -> Result<String, ReportError> {
    let pictures = &imaged.pictures;
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        renderer: &pictures.renderer,
        volume: &imaged.volume,
        standing: match imaged.standing() {
            Standing::Good => "confirmed",
            Standing::Open => "inconclusive",
            Standing::Bad => "contradicted",
        },
        axes: &pictures.axes,
        like: &imaged.like,
        not_finite: pictures.not_finite,
        quantum: pictures.quantum,
        width: pictures.exact.width,
        height: pictures.exact.height,
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}
