//! Where samples stand: what a grid may be.

use crate::binary::{Trouble, product, refused};
use crate::volume::Grid;

/// How far from orthonormal a direction may be: headers are often written with seven digits.
const ORTHONORMAL: f64 = 1e-6;

/// Whether a grid is one: as many samples as it says, finite, spacing above 0, axes orthonormal and not mirrored.
pub(super) fn check(grid: &Grid) -> Result<(), Trouble> {
    let count = product(&grid.dimensions)?;
    if grid.samples.len() != count {
        return Err(refused(
            format!("{} samples", grid.samples.len()),
            format!("{count}, the product of the dimensions"),
        ));
    }
    place(grid.origin, grid.spacing, grid.direction)
}

/// Whether samples can stand so.
pub(super) fn place(
    origin: [f64; 3],
    spacing: [f64; 3],
    direction: [[f64; 3]; 3],
) -> Result<(), Trouble> {
    if !origin.iter().all(|part| part.is_finite()) {
        return Err(refused(
            format!("an origin of {origin:?}"),
            "finite numbers",
        ));
    }
    if !spacing.iter().all(|&part| part > 0.0 && part.is_finite()) {
        return Err(refused(
            format!("a spacing of {spacing:?}"),
            "finite numbers above 0; programs disagree on others",
        ));
    }
    for row in 0..3 {
        for column in row..3 {
            let product: f64 = (0..3)
                .map(|i| direction[i][row] * direction[i][column])
                .sum();
            let wanted = if row == column { 1.0 } else { 0.0 };
            // A NaN is not near.
            let near = (product - wanted).abs() <= ORTHONORMAL;
            if !near {
                return Err(refused(
                    format!(
                        "directions of axes {direction:?}, row by row, are sheared or not of length 1"
                    ),
                    format!("orthonormal columns, within {ORTHONORMAL:e}"),
                ));
            }
        }
    }
    let [[a, b, c], [d, e, f], [g, h, i]] = direction;
    if a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0 {
        return Err(refused(
            format!(
                "axes that are mirrored: directions {direction:?}, row by row, have the determinant -1"
            ),
            "right-handed axes: reverse the samples along one axis, negate its direction and move the origin to the other end",
        ));
    }
    Ok(())
}

/// Three numbers of a text.
pub(super) fn three(text: &str) -> Option<[f64; 3]> {
    numbers(text)?.try_into().ok()
}

/// Nine numbers of a text, row by row.
pub(super) fn nine(text: &str) -> Option<[[f64; 3]; 3]> {
    let [a, b, c, d, e, f, g, h, i] = numbers(text)?.try_into().ok()?;
    Some([[a, b, c], [d, e, f], [g, h, i]])
}

/// The numbers of a text, each the nearest of binary64.
fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split_whitespace()
        .map(|word| word.parse().ok())
        .collect()
}

/// Numbers with the fewest digits that no other number of binary64 is nearer to.
pub(super) fn text(numbers: &[f64]) -> String {
    let words: Vec<_> = numbers.iter().map(|number| format!("{number:?}")).collect();
    words.join(" ")
}

pub(super) fn transposed(matrix: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[column][row]))
}
