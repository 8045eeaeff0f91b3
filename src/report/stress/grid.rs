//! Cells by what they are of.

use crate::study::stress::Cell;

/// Cells by scenario, method and format, each axis in the order of appearance.
pub(super) struct Grid<'a> {
    pub(super) scenarios: Vec<&'a str>,
    pub(super) methods: Vec<&'a str>,
    pub(super) formats: Vec<&'a str>,
    cells: &'a [Cell],
}

impl<'a> Grid<'a> {
    pub(super) fn new(cells: &'a [Cell]) -> Self {
        let mut grid = Grid {
            scenarios: Vec::new(),
            methods: Vec::new(),
            formats: Vec::new(),
            cells,
        };
        for cell in cells {
            for (axis, name) in [
                (&mut grid.scenarios, &cell.scenario),
                (&mut grid.methods, &cell.method),
                (&mut grid.formats, &cell.format),
            ] {
                if !axis.contains(&name.as_str()) {
                    axis.push(name);
                }
            }
        }
        grid
    }

    pub(super) fn cell(&self, scenario: &str, method: &str, format: &str) -> Option<&'a Cell> {
        self.cells.iter().find(|cell| {
            cell.scenario == scenario && cell.method == method && cell.format == format
        })
    }
}
