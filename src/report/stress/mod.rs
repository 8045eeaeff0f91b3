//! The extremes: for a terminal, as a document with a heat map, for programs.

mod html;
mod json;
mod markdown;
mod text;
mod words;

pub use html::page;
pub use json::json;
pub use markdown::markdown;
pub use text::text;

use super::ReportError;
use crate::document::About;
use crate::render::html::place;
use crate::render::{svg, write_files};
use crate::study::stress::Cell;
use std::path::{Path, PathBuf};

/// Cells by scenario, method and format, each axis in the order of appearance.
struct Grid<'a> {
    scenarios: Vec<&'a str>,
    methods: Vec<&'a str>,
    formats: Vec<&'a str>,
    cells: &'a [Cell],
}

impl<'a> Grid<'a> {
    fn new(cells: &'a [Cell]) -> Self {
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

    fn cell(&self, scenario: &str, method: &str, format: &str) -> Option<&'a Cell> {
        self.cells.iter().find(|cell| {
            cell.scenario == scenario && cell.method == method && cell.format == format
        })
    }
}

/// Writes `stress.json`, `stress.md`, `stress.svg` and a page, `index.html`, into `dir`, which is made where it does not exist; returns
/// the paths written. Other files in `dir` stay.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, cells: &[Cell], about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let page = page(cells, about);
    let maps = svg::files(&page).into_iter();
    let mut files: Vec<(PathBuf, String)> = maps.map(|(file, map)| (dir.join(file), map)).collect();
    files.push((dir.join("stress.json"), json(cells)?));
    files.push((dir.join("stress.md"), markdown(cells)));
    let mut paths = write_files(dir, files)?;
    paths.push(place(dir, &page)?);
    Ok(paths)
}
