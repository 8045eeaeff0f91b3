//! Errors and orders over the picture, as coloured tables.

use crate::document::{Cell, Column, Table};
use crate::study::picture::{Map, Pictures};

/// Cells of a map along its longer side; several pixels share one where there are more.
const CELLS: usize = 32;
/// Decades below the largest error that are told apart.
const DECADES: f64 = 4.0;

/// What there is to show of each axis.
pub(super) fn all(pictures: &Pictures) -> Vec<Table> {
    let mut tables = Vec::new();
    if let Some(error) = pictures.axes.iter().find_map(|axis| axis.error.as_ref()) {
        tables.push(errors(error));
    }
    for axis in &pictures.axes {
        if let Some(orders) = &axis.per_pixel {
            tables.push(of_orders(orders, axis.axis.name()));
        }
    }
    tables
}

/// Squares of pixels, and what is made of each square's values.
fn squares(map: &Map, of: impl Fn(&[f64]) -> f64) -> Vec<Vec<f64>> {
    let side = map.width.max(map.height).div_ceil(CELLS).max(1);
    let rows = map.height.div_ceil(side);
    let columns = map.width.div_ceil(side);
    let square = |row: usize, column: usize| {
        let mut values = Vec::new();
        for y in row * side..((row + 1) * side).min(map.height) {
            for x in column * side..((column + 1) * side).min(map.width) {
                values.push(
                    map.values
                        .get(y * map.width + x)
                        .copied()
                        .unwrap_or(f64::NAN),
                );
            }
        }
        of(&values)
    };
    (0..rows)
        .map(|row| (0..columns).map(|column| square(row, column)).collect())
        .collect()
}

fn table(caption: String, file: &str, rows: Vec<Vec<Cell>>) -> Table {
    let columns = rows.first().map_or(0, Vec::len);
    let columns = (0..columns).map(|column| Column::number((column + 1).to_string()));
    Table::new(caption, columns).with(rows).named(file)
}

fn errors(map: &Map) -> Table {
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let squares = squares(map, largest);
    let most = squares.iter().flatten().copied().fold(0.0, f64::max);
    let cell = |error: f64| {
        let shade = 1.0 + (error / most).log10() / DECADES;
        Cell::number(format!("{error:.0e}"), error.log10()).shaded(shade)
    };
    let rows = squares
        .into_iter()
        .map(|row| row.into_iter().map(cell).collect());
    let caption = format!(
        "Errors of the finest picture, the largest of each square: dark is {most:.1e}, pale {DECADES} decades less"
    );
    table(caption, "map-errors", rows.collect())
}

fn of_orders(map: &Map, axis: &str) -> Table {
    let median = |values: &[f64]| {
        let mut values: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
    };
    let squares = squares(map, median);
    let finite = squares
        .iter()
        .flatten()
        .copied()
        .filter(|order| order.is_finite());
    let most = finite.fold(1.0, f64::max);
    let cell = |order: f64| {
        if order.is_finite() {
            Cell::number(format!("{order:.1}"), order).shaded(order / most)
        } else {
            Cell::text("–")
        }
    };
    let rows = squares
        .into_iter()
        .map(|row| row.into_iter().map(cell).collect());
    let caption = format!("Orders of pixels as the {axis} is refined: dark is {most:.1}, pale 0");
    table(caption, &format!("map-{axis}"), rows.collect())
}
