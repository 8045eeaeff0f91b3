//! Tables of coloured cells.

use super::sheet::{BODY, CAPTION, HEAD, Letters, MARGIN, Sheet, round, written};
use crate::document::{Cell, Scale as Kind, Table, Tone};
use crate::render::plot::{Scale, is_dark, ticks};
use maud::{Markup, html};

/// Tables with the same rows stand beside each other up to this width.
const WIDTH: f64 = 1100.0;
const LEAST_WIDTH: f64 = 420.0;
/// Cells are as large as these allow.
const ROOM: (f64, f64) = (640.0, 560.0);
const CELL_WIDTHS: (f64, f64) = (14.0, 64.0);
const CELL_HEIGHTS: (f64, f64) = (13.0, 22.0);
const FIGURE: Letters = Letters("figure", 9.0);
const NAME: Letters = Letters("name", 10.0);
/// From the line of a text to its middle.
const MIDDLE: f64 = 3.5;
const GAP: f64 = 6.0;
const BAR: (f64, f64) = (220.0, 12.0);

/// The maps of a file, one below the other; those with the same rows beside each other while there is room.
pub(super) fn map(tables: &[&Table]) -> String {
    let (title, heads) = captions(tables);
    let mut bands: Vec<Vec<Grid<'_>>> = Vec::new();
    for (grid, head) in tables.iter().zip(heads) {
        let grid = Grid::new(grid, head);
        let fits = |band: &&mut Vec<Grid<'_>>| {
            band[0].row_names() == grid.row_names() && width(band) + MARGIN + grid.width() <= WIDTH
        };
        match bands.last_mut().filter(fits) {
            Some(band) => band.push(grid),
            None => bands.push(vec![grid]),
        }
    }
    let widest = bands.iter().map(|band| width(band));
    let mut sheet = Sheet::new(widest.fold(LEAST_WIDTH, f64::max) + 2.0 * MARGIN);
    sheet.write(title, CAPTION);
    for band in &bands {
        draw(&mut sheet, band);
    }
    scale(&mut sheet, tables);
    sheet.file(tables.first().map_or("", |table| &table.caption), 1.0)
}

/// What all captions say, and what each says beyond: "tree: digits" and "front: digits" are digits, of tree and front.
fn captions<'t>(tables: &[&'t Table]) -> (&'t str, Vec<&'t str>) {
    let all = || tables.iter().map(|table| &table.caption[..]);
    let parts: Option<Vec<(&str, &str)>> = all().map(|caption| caption.split_once(": ")).collect();
    match (&all().collect::<Vec<_>>()[..], parts.as_deref()) {
        ([only], _) => (only, vec![""]),
        (_, Some([(_, common), rest @ ..])) if rest.iter().all(|part| part.1 == *common) => (
            common,
            all()
                .filter_map(|caption| Some(caption.split_once(": ")?.0))
                .collect(),
        ),
        (all, _) => ("", all.to_vec()),
    }
}

/// A table with the sizes of its parts.
struct Grid<'t> {
    table: &'t Table,
    head: &'t str,
    cell: (f64, f64),
    /// The width of the names of its rows.
    names: f64,
    /// The height of the names of its columns.
    titles: f64,
    is_upright: bool,
}

impl<'t> Grid<'t> {
    fn new(table: &'t Table, head: &'t str) -> Self {
        let widest = |texts: &mut dyn Iterator<Item = &'t str>, letters: Letters| {
            texts.map(|text| letters.width(text)).fold(0.0, f64::max)
        };
        let figures = &mut table
            .rows
            .iter()
            .flat_map(|row| row.iter().skip(1).map(line));
        let titles = &mut table.columns.iter().skip(1).map(|column| &column.title[..]);
        let (figure, title) = (widest(figures, FIGURE), widest(titles, NAME));
        let first = table.columns.iter().take(1).map(|column| &column.title[..]);
        let names = &mut table
            .rows
            .iter()
            .flat_map(|row| row.iter().take(1).map(line))
            .chain(first);
        let size = |room: f64, count: usize, (least, most): (f64, f64)| {
            (room / count.max(1) as f64).clamp(least, most)
        };
        let width = size(ROOM.0, table.columns.len(), CELL_WIDTHS).min((figure + 8.0).max(20.0));
        Grid {
            table,
            head,
            cell: (width, size(ROOM.1, table.rows.len(), CELL_HEIGHTS)),
            names: widest(names, NAME) + GAP,
            titles: if title + 4.0 > width { title } else { NAME.1 } + GAP,
            is_upright: title + 4.0 > width,
        }
    }

    fn row_names(&self) -> Vec<&str> {
        let rows = self.table.rows.iter();
        rows.map(|row| row.first().map_or("", line)).collect()
    }

    /// Of its cells.
    fn width(&self) -> f64 {
        self.cell.0 * self.table.columns.len().saturating_sub(1) as f64
    }

    /// Names of columns, and cells from `top` on.
    fn draw(&self, (left, top): (f64, f64)) -> Markup {
        let (width, height) = self.cell;
        let columns = || self.table.columns.iter().skip(1).enumerate();
        html! {
            @for (column, title) in columns() {
                @let x = left + (column as f64 + 0.5) * width;
                @if self.is_upright {
                    text transform={ "translate(" (round(x + MIDDLE)) " " (round(top - GAP)) ") rotate(-90)" } { (title.title) }
                } @else {
                    text.middle x=(round(x)) y=(round(top - GAP)) { (title.title) }
                }
            }
            @for (row, cells) in self.table.rows.iter().enumerate() {
                @for ((column, _), cell) in columns().zip(cells.iter().skip(1)) {
                    (field(cell, (left + column as f64 * width, top + row as f64 * height), self.cell))
                }
            }
        }
    }

    /// The names of the rows, and above them what they are; all end at `right`.
    fn draw_names(&self, right: f64, top: f64) -> Markup {
        html! {
            @if let Some(first) = self.table.columns.first() {
                text.end x=(round(right)) y=(round(top - GAP)) { (first.title) }
            }
            @for (row, name) in self.row_names().into_iter().enumerate() {
                @let middle = top + (row as f64 + 0.5) * self.cell.1;
                text.end x=(round(right)) y=(round(middle + MIDDLE)) { (name) }
            }
        }
    }
}

/// The first line of what a cell says.
fn line(cell: &Cell) -> &str {
    cell.text.lines().next().unwrap_or_default()
}

/// Of grids beside each other, of which the first has names.
fn width(band: &[Grid<'_>]) -> f64 {
    let cells: f64 = band.iter().map(|grid| grid.width() + MARGIN).sum();
    band.first().map_or(0.0, |grid| grid.names) + cells - MARGIN
}

fn draw(sheet: &mut Sheet, band: &[Grid<'_>]) {
    let Some(first) = band.first() else { return };
    let most = |of: &dyn Fn(&Grid<'_>) -> f64| band.iter().map(of).fold(0.0, f64::max);
    let head = |grid: &Grid<'_>| HEAD.lines(grid.head, grid.width().max(80.0));
    let heads = most(&|grid| head(grid).len() as f64 * HEAD.line_height());
    let top = sheet.y + heads + most(&|grid| grid.titles) + GAP;
    let mut left = MARGIN + first.names;
    let mut parts = vec![first.draw_names(left - GAP, top)];
    for grid in band {
        parts.push(written(&head(grid), (left, sheet.y + 4.0), HEAD));
        parts.push(grid.draw((left, top)));
        left += grid.width() + MARGIN;
    }
    sheet.put(html! { g.map { @for part in parts { (part) } } });
    sheet.y = top + first.table.rows.len() as f64 * first.cell.1 + MARGIN;
}

/// A cell, with its figure where there is room, else as a title.
fn field(cell: &Cell, (x, y): (f64, f64), (width, height): (f64, f64)) -> Markup {
    let text = line(cell);
    let fits = FIGURE.width(text) + 2.0 <= width;
    let (ground, letters) = match (cell.shade, cell.tone) {
        (Some(share), _) if is_dark(share) => ("shade", "on-high"),
        (Some(_), _) => ("shade", "on-low"),
        (None, Some(tone)) => (class(tone), ""),
        (None, None) => ("none", ""),
    };
    html! {
        @if !text.is_empty() || cell.shade.is_some() {
            rect.(ground) x=(round(x)) y=(round(y)) width=(round(width - 1.0)) height=(round(height - 1.0)) fill-opacity=[cell.shade.map(round)] {
                @if !fits { title { (cell.text) } }
            }
            @if fits {
                text.figure.(letters) x=(round(x + width / 2.0)) y=(round(y + height / 2.0 + MIDDLE)) { (text) }
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
    let cells = || tables.iter().flat_map(|table| table.rows.iter().flatten());
    let (left, top) = (MARGIN, sheet.y);
    if let Some(most) = darkest(cells()) {
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
                    text.middle x=(round(scale.pixel(tick.at))) y=(round(top + BAR.1 + 12.0)) { (tick.label.as_deref().unwrap_or_default()) }
                }
            }
        });
        sheet.y += BAR.1 + 18.0;
    } else {
        sheet.write("pale: little; dark: much", BODY);
    }
    for (tone, words) in [
        (Tone::Good, "passes"),
        (Tone::Open, "neither passes nor fails"),
        (Tone::Bad, "fails"),
    ] {
        if cells().any(|cell| cell.tone == Some(tone) && cell.shade.is_none()) {
            sheet.put(html! { rect.(class(tone)) x=(left) y=(round(sheet.y + 1.0)) width="18" height="12" {} });
            sheet.put(written(&[words.into()], (left + 26.0, sheet.y), BODY));
            sheet.y += BODY.line_height();
        }
    }
}

/// The number of the darkest shade, if all cells agree on it.
fn darkest<'t>(cells: impl Iterator<Item = &'t Cell>) -> Option<f64> {
    let shaded: Vec<(f64, f64)> = cells
        .filter_map(|cell| Some((cell.shade?, cell.sort.unwrap_or(f64::NAN))))
        .collect();
    // The palest may stand for less than 0, the darkest for more than there are colours.
    let inner = shaded
        .iter()
        .filter(|(share, _)| *share > 0.0 && *share < 1.0);
    let all: Vec<f64> = inner.map(|(share, number)| number / share).collect();
    let dark = shaded.iter().filter(|(share, _)| *share >= 1.0);
    let least = dark.map(|(_, number)| *number).reduce(f64::min);
    let most = all.first().copied().or(least)?;
    let agree = all.iter().all(|own| (own - most).abs() <= 1e-6 * most);
    (agree && most > 0.0 && most.is_finite()).then_some(most)
}
