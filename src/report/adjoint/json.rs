//! Everything, for programs.

use crate::render::ReportError;
use crate::study::adjoint::Adjoint;
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    kernel: &'a str,
    at: &'static str,
    sampling: String,
    inner_product: &'static str,
    format: String,
    matched: bool,
    entries: usize,
    differ: usize,
    broken: Vec<&'static str>,
    fault: Option<Fault<'a>>,
    products: Vec<Product>,
    rays: Vec<Ray<'a>>,
}

#[derive(Serialize)]
struct Fault<'a> {
    name: &'a str,
    value: Option<f64>,
    bracket: Option<(f64, f64)>,
    does: &'a str,
}

#[derive(Serialize)]
struct Product {
    vectors: &'static str,
    forward: f64,
    back: f64,
    mismatch: f64,
    agrees: bool,
}

#[derive(Serialize)]
struct Ray<'a> {
    segments: usize,
    held_out: bool,
    /// A eᵢ.
    forward: Vec<f64>,
    /// (Aᵀ 1)ᵢ times the weight of the inner product.
    back: Vec<f64>,
    differ: &'a [usize],
}

/// `{"volver": version, "kernel": …, "matched": …, "products": […], "rays": […]}`, indented, with a newline at the end.
///
/// # Errors
/// [`ReportError::Json`], which no result is known to cause.
pub fn json(adjoint: &Adjoint) -> Result<String, ReportError> {
    let declaration = &adjoint.declaration;
    let floats = |row: &[rug::Float]| row.iter().map(rug::Float::to_f64).collect();
    let rays = adjoint.rays.iter().map(|ray| Ray {
        segments: ray.segments,
        held_out: ray.held_out,
        forward: floats(&ray.forward),
        back: floats(&ray.back),
        differ: &ray.differ,
    });
    let products = adjoint.products.iter().map(|product| Product {
        vectors: product.vectors.name(),
        forward: product.forward.to_f64(),
        back: product.back.to_f64(),
        mismatch: product.mismatch(),
        agrees: product.agrees,
    });
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        kernel: &declaration.name,
        at: adjoint.places.at.name(),
        sampling: adjoint.places.sampling.to_string(),
        inner_product: adjoint.product.name(),
        format: declaration.format.to_string(),
        matched: adjoint.is_matched(),
        entries: adjoint.rays.iter().map(|ray| ray.forward.len()).sum(),
        differ: adjoint.rays.iter().map(|ray| ray.differ.len()).sum(),
        broken: adjoint.broken.iter().map(|broken| broken.name()).collect(),
        fault: adjoint.fault.as_ref().map(|fault| Fault {
            name: fault.name,
            value: fault.value.map(|(value, _)| value),
            bracket: fault.value.map(|(_, bracket)| bracket),
            does: &fault.does,
        }),
        products: products.collect(),
        rays: rays.collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}
