//! Tables of coloured cells.

use super::sheet::{BODY, CAPTION, HEAD, Letters, MARGIN, Sheet, round, text_width, written};
use crate::document::{Cell, Scale as Kind, Table, Tone};
use crate::render::plot::{Scale, is_dark, ticks};
use maud::{Markup, html};

/// Tables with the same rows stand beside each other up to this width.
const WIDTH: f64 = 1100.0;
/// Cells are as large as these allow.
const CELLS: (f64, f64) = (640.0, 560.0);
const CELL_WIDTHS: (f64, f64) = (12.0, 64.0);
const CELL_HEIGHTS: (f64, f64) = (13.0, 22.0);
const FIGURE: f64 = 9.0;
const NAME: f64 = 10.0;
const LONGEST_NAME: f64 = 240.0;
const BAR: (f64, f64) = (220.0, 12.0);

/// The maps of a file, one below the other; those with the same rows beside each other while there is room.
pub(super) fn map(tables: &[&Table]) -> String {
    let grids: Vec<Grid<'_>> = tables.iter().map(|table| Grid::new(table)).collect();
    let mut bands: Vec<Vec<Grid<'_>>> = Vec::new();
    for grid in grids {
        let fits = |band: &&mut Vec<Grid<'_>>| {
            band[0].rows_are_those_of(&grid) && width(band) + MARGIN + grid.width() <= WIDTH
        };
        match bands.last_mut().filter(fits) {
            Some(band) => band.push(grid),
            None => bands.push(vec![grid]),
        }
    }
    let widest = bands.iter().map(|band| width(band)).fold(420.0, f64::max);
    let mut sheet = Sheet::new(widest + 2.0 * MARGIN);
    let title = tables.first().map_or("", |table| &table.caption);
    sheet.write(title, CAPTION);
    for band in &bands {
        draw(&mut sheet, band, title);
    }
    scale(&mut sheet, tables);
    sheet.file(title, 1.0)
}

/// A table with the sizes of its parts.
struct Grid<'t> {
    table: &'t Table,
    cell: (f64, f64),
    names: f64,
    heads: f64,
    are_upright: bool,
}

impl<'t> Grid<'t> {
    fn new(table: &'t Table) -> Self {
        let columns = table.columns.get(1..).unwrap_or_default();
        let size = |room: f64, count: usize, (least, most): (f64, f64)| {
            (room / count.max(1) as f64).clamp(least, most)
        };
        let figures = table
            .rows
            .iter()
            .flat_map(|row| row.get(1..).unwrap_or_default());
        let wanted = widest(figures.map(line), FIGURE) + 8.0;
        let width = size(CELLS.0, columns.len(), CELL_WIDTHS).min(wanted.max(CELL_WIDTHS.0 + 8.0));
        let head = widest(columns.iter().map(|column| &column.title[..]), NAME);
        let first = table.columns.first().map(|column| &column.title[..]);
        let names = table.rows.iter().filter_map(|row| row.first().map(line));
        let are_upright = head + 4.0 > width;
        Grid {
            table,
            cell: (width, size(CELLS.1, table.rows.len(), CELL_HEIGHTS)),
            names: widest(names.chain(first), NAME).min(LONGEST_NAME) + 6.0,
            heads: if are_upright { head } else { NAME } + 6.0,
            are_upright,
        }
    }

    fn rows_are_those_of(&self, other: &Grid<'_>) -> bool {
        let names = |grid: &Grid<'_>| -> Vec<String> {
            let rows = grid.table.rows.iter();
            rows.map(|row| row.first().map_or("", line).to_string())
                .collect()
        };
        names(self) == names(other)
    }

    fn cells(&self) -> f64 {
        self.cell.0 * self.table.columns.len().saturating_sub(1) as f64
    }

    /// With its names.
    fn width(&self) -> f64 {
        self.names + self.cells()
    }

    /// Column heads and cells; `top` is where the cells begin.
    fn draw(&self, (left, top): (f64, f64)) -> Markup {
        let (width, height) = self.cell;
        let middle = |column: usize| left + (column as f64 + 0.5) * width;
        html! {
            @for (column, head) in self.table.columns.iter().skip(1).enumerate() {
                @let x = round(middle(column));
                @if self.are_upright {
                    text transform={ "translate(" (round(x + 0.35 * NAME)) " " (top - 5.0) ") rotate(-90)" } { (head.title) }
                } @else {
                    text.middle x=(x) y=(top - 5.0) { (head.title) }
                }
            }
            @for (row, cells) in self.table.rows.iter().enumerate() {
                @let y = top + row as f64 * height;
                @for (column, cell) in cells.iter().skip(1).enumerate().take(self.table.columns.len().saturating_sub(1)) {
                    (field(cell, (left + column as f64 * width, y), self.cell))
                }
            }
        }
    }

    /// The names of the rows, and above them what they are.
    fn draw_names(&self, (left, top): (f64, f64)) -> Markup {
        let x = round(left + self.names - 6.0);
        html! {
            @if let Some(first) = self.table.columns.first() {
                text.end x=(x) y=(top - 5.0) { (first.title) }
            }
            @for (row, cells) in self.table.rows.iter().enumerate() {
                @let middle = top + (row as f64 + 0.5) * self.cell.1;
                text.end x=(x) y=(round(middle + 0.35 * NAME)) { (cells.first().map_or("", line)) }
            }
        }
    }
}

/// The first line of what a cell says.
fn line(cell: &Cell) -> &str {
    cell.text.lines().next().unwrap_or_default()
}

fn widest<'t>(texts: impl Iterator<Item = &'t str>, size: f64) -> f64 {
    texts.map(|text| text_width(text, size)).fold(0.0, f64::max)
}

/// Of grids beside each other, of which the first has names.
fn width(band: &[Grid<'_>]) -> f64 {
    let cells: f64 = band.iter().map(|grid| grid.cells() + MARGIN).sum();
    band.first().map_or(0.0, |grid| grid.names) + cells - MARGIN
}

fn draw(sheet: &mut Sheet, band: &[Grid<'_>], title: &str) {
    let Some(first) = band.first() else { return };
    let mut left = MARGIN + first.names;
    let captions: Vec<Vec<String>> = band
        .iter()
        .map(|grid| match &grid.table.caption[..] {
            caption if caption == title => Vec::new(),
            caption => HEAD.lines(caption, grid.cells().max(80.0)),
        })
        .collect();
    let lines = captions.iter().map(Vec::len).max().unwrap_or(0);
    let heads = band.iter().map(|grid| grid.heads).fold(0.0, f64::max);
    let top = sheet.y + lines as f64 * HEAD.line_height() + heads + 8.0;
    let mut parts = vec![first.draw_names((MARGIN, top))];
    for (grid, caption) in band.iter().zip(&captions) {
        parts.push(written(caption, (left, sheet.y + 4.0), HEAD));
        parts.push(grid.draw((left, top)));
        left += grid.cells() + MARGIN;
    }
    sheet.put(html! { g.map { @for part in parts { (part) } } });
    sheet.y = top + first.table.rows.len() as f64 * first.cell.1 + MARGIN;
}

/// A cell, with its figure where there is room, else as a title.
fn field(cell: &Cell, (x, y): (f64, f64), (width, height): (f64, f64)) -> Markup {
    let text = line(cell);
    let fits = text_width(text, FIGURE) + 2.0 <= width && FIGURE + 3.0 <= height;
    let (class, share) = match (cell.shade, cell.tone) {
        (Some(share), _) => ("shade", Some(round(share))),
        (None, Some(tone)) => (class(tone), None),
        (None, None) => ("none", None),
    };
    let letters = cell.shade.map_or(
        "",
        |share| {
            if is_dark(share) { "on-high" } else { "on-low" }
        },
    );
    html! {
        @if !(text.is_empty() && cell.shade.is_none()) {
            rect.(class) x=(round(x)) y=(round(y)) width=(round(width - 1.0)) height=(round(height - 1.0)) fill-opacity=[share] {
                @if !fits { title { (cell.text) } }
            }
            @if fits {
                text.figure.(letters) x=(round(x + width / 2.0)) y=(round(y + height / 2.0 + 0.35 * FIGURE)) { (text) }
            }
        }
    }
}

fn class(tone: Tone) -> &'static str {
    match tone {
        Tone::Good => "good",
        Tone::Open => "open",
        Tone::Bad => "bad",
    }
}

/// What the colours say: a bar with figures where all shades are shares of one number, otherwise words.
fn scale(sheet: &mut Sheet, tables: &[&Table]) {
    let all = || tables.iter().flat_map(|table| table.rows.iter().flatten());
    let (left, top) = (MARGIN, sheet.y + 4.0);
    if let Some(most) = darkest(all()) {
        let scale = Scale::new((0.0, most), (left, left + BAR.0));
        let (ticks, _) = ticks(&scale, Kind::Linear);
        sheet.put(html! {
            g.map {
                linearGradient id="shades" {
                    stop.shade offset="0" stop-opacity="0" {}
                    stop.shade offset="1" {}
                }
                rect fill="url(#shades)" x=(left) y=(top) width=(BAR.0) height=(BAR.1) {}
                @for tick in &ticks {
                    @if let Some(label) = &tick.label {
                        text.middle x=(round(scale.pixel(tick.at))) y=(top + BAR.1 + 12.0) { (label) }
                    }
                }
            }
        });
        sheet.y = top + BAR.1 + 16.0;
    } else {
        sheet.write("pale: little; dark: much", BODY);
    }
    let meant = [
        (Tone::Good, "passes"),
        (Tone::Open, "neither passes nor fails"),
        (Tone::Bad, "fails"),
    ];
    for (tone, words) in meant {
        if all().any(|cell| cell.tone == Some(tone) && cell.shade.is_none()) {
            let (y, letters) = (sheet.y + 2.0, Letters { ..BODY });
            sheet.put(html! { rect.(class(tone)) x=(left) y=(y) width="18" height="12" {} });
            sheet.put(written(
                &[words.to_string()],
                (left + 26.0, y - 2.0),
                letters,
            ));
            sheet.y += BODY.line_height();
        }
    }
}

/// The number of the darkest shade, if all cells agree on it.
fn darkest<'t>(cells: impl Iterator<Item = &'t Cell>) -> Option<f64> {
    let shaded: Vec<(f64, Option<f64>)> = cells
        .filter_map(|cell| Some((cell.shade?, cell.sort)))
        .collect();
    let mut most: Option<f64> = None;
    // The palest may stand for less than 0, the darkest for more than there are colours.
    for (share, number) in shaded
        .iter()
        .filter(|(share, _)| *share > 0.0 && *share < 1.0)
    {
        let own = (*number)? / share;
        if (own - *most.get_or_insert(own)).abs() > 1e-6 * own.abs() {
            return None;
        }
    }
    let darkest = shaded.iter().filter(|(share, _)| *share >= 1.0);
    let least = darkest.filter_map(|(_, number)| *number).reduce(f64::min);
    most.or(least)
        .filter(|most| *most > 0.0 && most.is_finite())
}
