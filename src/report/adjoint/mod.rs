//! A projector beside its backprojector.

mod json;

pub use json::json;

use crate::document::{
    About, Block, Cell, Column, Conclusion, Document, Fact, Finding, Section, Table, Tone,
};
use crate::render::{ReportError, write_document};
use crate::study::adjoint::{Adjoint, Broken, Fault, OfRay, Product, Vectors};
use std::path::{Path, PathBuf};

/// Entries of a ray that are shown.
const SHOWN: usize = 3;

/// Whether the pair is matched, what is wrong, the products, and entries that differ.
#[must_use]
pub fn document(adjoint: &Adjoint, about: &About) -> Document {
    let mut document = Document::new("adjoint", &adjoint.declaration.name, about.clone());
    let (tone, word) = if adjoint.is_matched() {
        (Tone::Good, "matched")
    } else {
        (Tone::Bad, "unmatched")
    };
    document.summary = vec![
        Fact::new("the pair is", word).toned(tone),
        Fact::new("entries that differ", counts(adjoint)).toned(tone),
    ];
    document.conclusion = Some(Conclusion::new(whole(adjoint, word)).toned(tone));
    document.sections = vec![
        Section::of(
            "products",
            "⟨A x, y⟩ and ⟨x, Aᵀ y⟩",
            [Block::Table(products(adjoint))],
        ),
        Section::of("findings", "What is wrong", findings(adjoint)),
        Section::of("run", "What was run", [run(adjoint)]),
    ];
    document
}

/// Writes `adjoint.md`, `adjoint.json` and a page, `index.html`, into `dir`; see [`write_document`]. Returns the paths
/// written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, adjoint: &Adjoint, about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("adjoint.json".to_string(), json(adjoint)?)];
    write_document(dir, &document(adjoint, about), "adjoint", data)
}

fn entries(adjoint: &Adjoint) -> usize {
    adjoint.rays.iter().map(|ray| ray.forward.len()).sum()
}

fn differ(adjoint: &Adjoint) -> usize {
    adjoint.rays.iter().map(|ray| ray.differ.len()).sum()
}

fn counts(adjoint: &Adjoint) -> String {
    format!("{} of {}", differ(adjoint), entries(adjoint))
}

fn whole(adjoint: &Adjoint, word: &str) -> String {
    let name = &adjoint.declaration.name;
    let broken = adjoint.broken.iter().map(|broken| broken.name());
    let fault = adjoint.fault.iter().map(|fault| fault.name);
    let names: Vec<&str> = broken.chain(fault).collect();
    let why = if names.is_empty() {
        String::new()
    } else {
        format!(": {}", names.join(", "))
    };
    format!(
        "{name}: projector and backprojector are {word} in the inner product '{}', {} entries differ{why}",
        adjoint.product.name(),
        counts(adjoint)
    )
}

fn products(adjoint: &Adjoint) -> Table {
    let columns = [
        Column::text("x and y"),
        Column::number("⟨A x, y⟩"),
        Column::number("⟨x, Aᵀ y⟩"),
        Column::logarithm("relative mismatch"),
        Column::verdict("verdict"),
    ];
    let caption =
        "Both sides over all rays in one request; of matched pairs they differ by rounding";
    Table::new(caption, columns).with(adjoint.products.iter().map(row))
}

fn row(product: &Product) -> Vec<Cell> {
    let (forward, back) = (product.forward.to_f64(), product.back.to_f64());
    let mismatch = product.mismatch();
    let (word, tone) = if product.agrees {
        ("equal", Tone::Good)
    } else {
        ("differ", Tone::Bad)
    };
    vec![
        Cell::text(match product.vectors {
            Vectors::Positive => "positive",
            Vectors::ZeroMean => "of zero mean",
            Vectors::Image => "y = A x′",
        }),
        Cell::number(format!("{forward:.6e}"), forward),
        Cell::number(format!("{back:.6e}"), back),
        Cell::number(format!("{mismatch:.1e}"), mismatch.log10()),
        Cell::verdict(word, tone),
    ]
}

fn findings(adjoint: &Adjoint) -> Vec<Block> {
    let broken = adjoint.broken.iter().map(|broken| {
        let words = match broken {
            Broken::Forward => "A x is not Σ xᵢ A eᵢ: the projector is not linear",
            Broken::Signed => {
                "A x is not Σ xᵢ A eᵢ where some xᵢ are below 0, as residuals of a reconstruction are"
            }
            Broken::Back => "Aᵀ y is not y Aᵀ 1, or depends on x",
            Broken::NotFinite => "an answer is NaN or infinite",
        };
        Finding::new(broken.name(), words)
    });
    let fault = adjoint
        .fault
        .iter()
        .map(|fault| Finding::new(fault.name, said(fault)));
    let rays = adjoint.rays.iter().filter(|ray| !ray.differ.is_empty());
    let entries = rays.map(|ray| Finding::new("entries", listed(ray)));
    let all = broken.chain(fault).chain(entries);
    all.map(|finding| Block::Finding(finding.toned(Tone::Bad)))
        .collect()
}

fn said(fault: &Fault) -> String {
    match fault.value {
        Some((_, (low, high))) => format!("{} (between {low:?} and {high:?})", fault.does),
        None => fault.does.clone(),
    }
}

/// "n = 9: 2 of 9 differ: at 8 A has 0.105 and Aᵀ 0.35".
fn listed(ray: &OfRay) -> String {
    let of = |at: &usize| {
        let (forward, back) = (ray.forward.get(*at)?, ray.back.get(*at)?);
        Some(format!(
            "at {at} A has {} and Aᵀ {}",
            forward.to_f64(),
            back.to_f64()
        ))
    };
    let shown: Vec<String> = ray.differ.iter().take(SHOWN).filter_map(of).collect();
    let more = if ray.differ.len() > SHOWN {
        ", …"
    } else {
        ""
    };
    format!(
        "n = {}: {} of {} differ: {}{more}",
        ray.segments,
        ray.differ.len(),
        ray.forward.len(),
        shown.join(", ")
    )
}

fn run(adjoint: &Adjoint) -> Block {
    let segments: Vec<String> = adjoint
        .rays
        .iter()
        .map(|ray| ray.segments.to_string())
        .collect();
    Block::Facts(vec![
        Fact::new("values", adjoint.places.at.name()),
        Fact::new("inner product", adjoint.product.meaning()),
        Fact::new("segments of the rays", segments.join(", ")),
    ])
}
