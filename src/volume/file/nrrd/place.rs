//! Where the samples of an NRRD stand.

use super::header::{Header, value};
use crate::binary::{Trouble, refused};
use crate::volume::Grid;
use crate::volume::file::geometry::transposed;

/// Origin, spacing and direction.
pub(super) struct Place {
    pub(super) origin: [f64; 3],
    pub(super) spacing: [f64; 3],
    pub(super) direction: [[f64; 3]; 3],
}

/// By `space directions` and `space origin`, or by `spacings` and `axis mins`; places of patients are turned to left,
/// posterior, superior.
pub(super) fn of(header: &Header) -> Result<Place, Trouble> {
    let signs = signs(header)?;
    let Some(said) = header.get("space directions") else {
        return without_directions(header, signs);
    };
    if signs.is_none() {
        return Err(refused(
            "space directions without a space",
            "'space: …' or 'space dimension: 3' before them",
        ));
    }
    if let Some(said) = header.get("spacings") {
        return Err(value(
            "spacings",
            said,
            "none beside space directions, which hold them",
        ));
    }
    if let Some(said) = header.get("axis mins").or(header.get("axis maxs")) {
        return Err(value(
            "axis mins or maxs",
            said,
            "none beside space directions",
        ));
    }
    let steps = vectors(said)
        .and_then(|vectors| <[[f64; 3]; 3]>::try_from(vectors).ok())
        .ok_or_else(|| value("space directions", said, "three vectors '(x,y,z)'"))?;
    let signs = signs.unwrap_or([1.0; 3]);
    let spacing = steps.map(|[x, y, z]| x.hypot(y).hypot(z));
    let axes = [0, 1, 2].map(|axis| {
        [0, 1, 2].map(|part| {
            let along = signs[part] * steps[axis][part];
            if along == 0.0 {
                0.0
            } else {
                along / spacing[axis]
            }
        })
    });
    Ok(Place {
        origin: origin(header, signs)?,
        spacing,
        direction: transposed(axes),
    })
}

/// What the parts of a place are multiplied by to be left, posterior, superior; `None` without a space.
fn signs(header: &Header) -> Result<Option<[f64; 3]>, Trouble> {
    let many = header.get("space dimension");
    if let Some(said) = many.filter(|said| *said != "3") {
        return Err(value("space dimension", said, "3"));
    }
    let Some(said) = header.get("space") else {
        return Ok(many.map(|_| [1.0; 3]));
    };
    match said.to_ascii_lowercase().as_str() {
        "left-posterior-superior" | "lps" | "3d-right-handed" | "3dr" | "scanner-xyz" => {
            Ok(Some([1.0; 3]))
        }
        "right-anterior-superior" | "ras" => Ok(Some([-1.0, -1.0, 1.0])),
        "left-anterior-superior" | "las" => Ok(Some([1.0, -1.0, 1.0])),
        _ => Err(value(
            "space",
            said,
            "left-posterior-superior, right-anterior-superior, left-anterior-superior, scanner-xyz or 3D-right-handed; programs disagree on others",
        )),
    }
}

fn origin(header: &Header, signs: [f64; 3]) -> Result<[f64; 3], Trouble> {
    let Some(said) = header.get("space origin") else {
        return Ok([0.0; 3]);
    };
    match vectors(said).as_deref() {
        Some([one]) => Ok([0, 1, 2].map(|part| {
            // No zero with a sign.
            if one[part] == 0.0 {
                0.0
            } else {
                signs[part] * one[part]
            }
        })),
        _ => Err(value("space origin", said, "one vector '(x,y,z)'")),
    }
}

fn without_directions(header: &Header, signs: Option<[f64; 3]>) -> Result<Place, Trouble> {
    let spacing = match header.get("spacings") {
        Some(said) => super::super::geometry::three(said)
            .ok_or_else(|| value("spacings", said, "three numbers"))?,
        None => match header.get("axis mins").or(header.get("axis maxs")) {
            None => [1.0; 3],
            Some(said) => {
                return Err(value(
                    "axis mins or maxs",
                    said,
                    "with spacings beside them; programs make different places of mins and maxs alone",
                ));
            }
        },
    };
    // Axes of a space that is turned would be mirrored or turned, which programs that read spacings alone do not see.
    if let Some(signs) = signs.filter(|signs| signs.iter().any(|&sign| sign < 0.0)) {
        return Err(refused(
            format!("spacings in a space that is turned by {signs:?}"),
            "space directions there",
        ));
    }
    let Some(said) = header.get("axis mins") else {
        return Ok(Place {
            origin: origin(header, [1.0; 3])?,
            spacing,
            direction: Grid::ALONG_AXES,
        });
    };
    if header.get("space origin").is_some() {
        return Err(value(
            "axis mins",
            said,
            "one of axis mins and space origin",
        ));
    }
    let mins = super::super::geometry::three(said)
        .ok_or_else(|| value("axis mins", said, "three numbers"))?;
    let centers = header.get("centers").unwrap_or("nothing");
    let words: Vec<_> = centers
        .split_whitespace()
        .map(str::to_ascii_lowercase)
        .collect();
    let mut origin = mins;
    for axis in 0..3 {
        origin[axis] += match words.get(axis).map(String::as_str) {
            Some("node") => 0.0,
            Some("cell") => 0.5 * spacing[axis],
            _ => {
                return Err(value(
                    "centers",
                    centers,
                    "node or cell for each axis where axis mins are given",
                ));
            }
        };
    }
    Ok(Place {
        origin,
        spacing,
        direction: Grid::ALONG_AXES,
    })
}

/// Vectors '(x,y,z)', one after the other.
fn vectors(text: &str) -> Option<Vec<[f64; 3]>> {
    let mut vectors = Vec::new();
    let mut rest = text.trim();
    while !rest.is_empty() {
        let (inner, behind) = rest.strip_prefix('(')?.split_once(')')?;
        let parts: Option<Vec<f64>> = inner
            .split(',')
            .map(|part| part.trim().parse().ok())
            .collect();
        vectors.push(parts?.try_into().ok()?);
        rest = behind.trim_start();
    }
    Some(vectors)
}
