//! A renderer of volumes along three axes of refinement.

mod json;
mod maps;

pub use json::json;

use crate::convergence::Verdict;
use crate::document::{
    About, Axis as PlotAxis, Block, Cell, Column, Conclusion, Document, Fact, Figure, Finding,
    Medium, Plot, Point, Section, Series, Table, Tone,
};
use crate::render::{ReportError, write_document};
use crate::study::picture::{Axis, Likeness, Measured, Norms, Pictures};
use std::path::{Path, PathBuf};

/// What was measured of a renderer on a volume, and what its picture is like.
#[derive(Debug)]
pub struct Imaged {
    /// The volume.
    pub volume: String,
    /// What was measured.
    pub pictures: Pictures,
    /// What the picture is that is not the right one; several where they cannot be told apart.
    pub like: Vec<Likeness>,
}

/// What all comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Every order that was expected is confirmed.
    Good,
    /// Some order could be neither confirmed nor contradicted.
    Open,
    /// An order is contradicted, the picture is another one, or values are no numbers.
    Bad,
}

impl Imaged {
    /// What it comes to.
    #[must_use]
    pub fn standing(&self) -> Standing {
        let worst = self.pictures.axes.iter().map(of_axis).min();
        let is_other = !self.like.is_empty() || self.pictures.not_finite > 0;
        match worst {
            _ if is_other => Standing::Bad,
            Some(Tone::Bad) => Standing::Bad,
            Some(Tone::Good) | None => Standing::Good,
            Some(Tone::Open) => Standing::Open,
        }
    }
}

/// How good or bad an axis is.
fn of_axis(measured: &Measured) -> Tone {
    if measured.changes_nothing {
        // Interpolation may be exact; a program that takes no notice of its steps is not.
        return if measured.axis == Axis::Grid {
            Tone::Good
        } else {
            Tone::Open
        };
    }
    match measured.fit.as_ref().map(|fit| fit.verdict) {
        Some(Verdict::Confirmed | Verdict::Exact | Verdict::Fitted) => Tone::Good,
        Some(Verdict::TooLow) if is_of_kinks(measured) => Tone::Open,
        Some(Verdict::TooLow | Verdict::Stalled | Verdict::Diverged | Verdict::NotFinite) => {
            Tone::Bad
        }
        _ if measured.falls_short().is_some() => Tone::Bad,
        // Better than expected is no fault of a renderer.
        Some(Verdict::TooHigh) => Tone::Good,
        _ => Tone::Open,
    }
}

/// Whether kinks between cells of the grid may be what leaves steps an order of 2: they are all that steps finer than cells
/// see of a method of a higher order.
fn is_of_kinks(measured: &Measured) -> bool {
    let order = measured.fit.as_ref().and_then(|fit| fit.order);
    measured.axis == Axis::Step
        && measured.by_differences
        && measured.expected.is_some_and(|expected| expected > 2.0)
        && order.is_some_and(|order| order > 1.5)
}

/// Orders and verdicts, the levels of every axis, where orders are lost, pictures, what a wrong one is like.
#[must_use]
pub fn document(imaged: &Imaged, about: &About) -> Document {
    let pictures = &imaged.pictures;
    let title = format!("{} on {}", pictures.renderer, imaged.volume);
    let mut document = Document::new("image", &title, about.clone());
    let (tone, word) = match imaged.standing() {
        Standing::Good => (Tone::Good, "confirmed"),
        Standing::Open => (Tone::Open, "inconclusive"),
        Standing::Bad => (Tone::Bad, "contradicted"),
    };
    document.summary = vec![Fact::new("the picture is", word).toned(tone)];
    document.conclusion = Some(Conclusion::new(whole(imaged, word)).toned(tone));
    let mut orders = vec![Block::Table(table(&pictures.axes))];
    orders.extend(pictures.axes.iter().filter_map(limited).map(Block::Text));
    document
        .sections
        .push(Section::of("orders", "Orders", orders));
    let findings: Vec<Block> = findings(imaged);
    if !findings.is_empty() {
        let section = Section::of("findings", "What the picture is", findings);
        document.sections.push(section);
    }
    let lost: Vec<Block> = pictures.axes.iter().filter_map(lost).collect();
    if !lost.is_empty() {
        let section = Section::of("lost", "Where the order is lost", lost);
        document.sections.push(section);
    }
    let levels = pictures.axes.iter().map(|axis| Block::Table(levels(axis)));
    let levels = std::iter::once(Block::Figure(figure(&pictures.axes)).only(Medium::Written))
        .chain(levels.map(|table| table.only(Medium::Written)));
    document
        .sections
        .push(Section::of("levels", "Errors", levels));
    let maps = maps::all(pictures);
    if !maps.is_empty() {
        let maps = maps
            .into_iter()
            .map(|map| Block::Table(map).only(Medium::Written));
        document
            .sections
            .push(Section::of("maps", "Over the picture", maps));
    }
    document
}

/// Writes `image.md`, `image.json` and a page, `index.html`, into `dir`; see [`write_document`]. Returns the paths written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, imaged: &Imaged, about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("image.json".to_string(), json(imaged)?)];
    write_document(dir, &document(imaged, about), "image", data)
}

fn whole(imaged: &Imaged, word: &str) -> String {
    let pictures = &imaged.pictures;
    let said = |axis: &Measured| {
        let verdict = axis.fit.as_ref().map(|fit| fit.verdict);
        let verdict = verdict.map_or("no levels", Verdict::name);
        let verdict = own_word(axis).unwrap_or(verdict);
        format!("{} {}", axis.axis.name(), verdict)
    };
    let axes: Vec<String> = pictures.axes.iter().map(said).collect();
    let like = imaged.like.first().map(|like| format!("; {}", like.name));
    format!(
        "{} on {}: {word} ({}){}",
        pictures.renderer,
        imaged.volume,
        axes.join(", "),
        like.unwrap_or_default()
    )
}

fn table(axes: &[Measured]) -> Table {
    let columns = [
        Column::text("axis"),
        Column::text("levels"),
        Column::number("order"),
        Column::number("expected"),
        Column::number("max of all").detail(),
        Column::number("L1 of all").detail(),
        Column::number("L2 of all"),
        Column::verdict("verdict"),
    ];
    let caption =
        "Orders of L2 over pixels where everything is analytic, and over all that show the volume";
    let row = |axis: &Measured| {
        let fit = axis.fit.as_ref();
        let order = fit.and_then(|fit| Some((fit.order?, fit.half_width?)));
        let order = order.map_or(Cell::text("–"), |(order, half)| {
            Cell::number(format!("{order:.3} ± {half:.3}"), order)
        });
        let counts = [axis.levels.first(), axis.levels.last()];
        let counts = counts.map(|level| level.map_or(0, |level| level.count));
        let of = |order: Option<f64>| {
            order.map_or(Cell::text("–"), |order| {
                Cell::number(format!("{order:.2}"), order)
            })
        };
        let verdict = fit.map_or("no levels", |fit| fit.verdict.name());
        let verdict = own_word(axis).unwrap_or(verdict);
        let expected = axis.expected.map_or(Cell::text("–"), |order| {
            Cell::number(format!("{order}"), order)
        });
        vec![
            Cell::text(axis.axis.name()),
            Cell::text(format!("{} … {}", counts[0], counts[1])),
            order,
            expected,
            of(axis.orders[0]),
            of(axis.orders[1]),
            of(axis.orders[2]),
            Cell::verdict(verdict, of_axis(axis)),
        ]
    };
    Table::new(caption, columns).with(axes.iter().map(row))
}

/// The word for an axis whose orders go nowhere near what is expected.
const SHORT: &str = "falls short";

/// A word of its own for what is no fit's.
fn own_word(axis: &Measured) -> Option<&'static str> {
    let verdict = axis.fit.as_ref().map(|fit| fit.verdict);
    if axis.changes_nothing {
        Some("no change")
    } else if verdict == Some(Verdict::Stalled) {
        None
    } else {
        axis.falls_short().map(|_| SHORT)
    }
}

/// Which axis stands in the way of another.
fn limited(axis: &Measured) -> Option<String> {
    let others = match axis.axis {
        Axis::Step => "the grid and the quantum of values",
        Axis::Grid => "the step and the quantum of values",
        Axis::Pixel => "the step, the grid and the quantum of values",
    };
    if axis.changes_nothing {
        return Some(format!(
            "{}: refining it changes nothing beyond rounding.",
            axis.axis.name()
        ));
    }
    if is_of_kinks(axis) && of_axis(axis) == Tone::Open {
        return Some(
            "step: kinks where interpolants of cells meet leave steps finer than cells an order of 2, whatever the method has (allowed: --steps that are coarser, --cells that are more)."
                .into(),
        );
    }
    if axis.by_differences {
        return Some(format!(
            "{}: errors of {others} are not under a tenth everywhere; differences of levels one behind the other, of which they are no part, show the order.",
            axis.axis.name()
        ));
    }
    if own_word(axis) == Some(SHORT)
        && let Some([first, second, third]) = axis.falls_short()
    {
        return Some(format!(
            "{}: orders go from {first:.2} over {second:.2} to {third:.2}, and not to what is expected.",
            axis.axis.name()
        ));
    }
    let unclean: Vec<String> = axis
        .levels
        .iter()
        .filter(|level| !level.is_clean)
        .map(|level| level.count.to_string())
        .collect();
    (!unclean.is_empty()).then(|| {
        format!(
            "{}: at {} errors of {others} may be more than a tenth.",
            axis.axis.name(),
            unclean.join(", ")
        )
    })
}

fn findings(imaged: &Imaged) -> Vec<Block> {
    let mut all = Vec::new();
    let several = imaged.like.len() > 1;
    for like in &imaged.like {
        let or = if several { " (one of these)" } else { "" };
        let words = format!("{}{or}; {:.1e} of the error is left", like.words, like.left);
        all.push(Finding::new(like.name, words).toned(Tone::Bad));
    }
    let not_finite = imaged.pictures.not_finite;
    if not_finite > 0 {
        let words = format!("{not_finite} values of the finest picture are NaN or infinite");
        all.push(Finding::new("not-finite", words).toned(Tone::Bad));
    }
    all.into_iter().map(Block::Finding).collect()
}

fn lost(axis: &Measured) -> Option<Block> {
    if axis.lost.is_empty() {
        return None;
    }
    let columns = [
        Column::text("rays meet"),
        Column::number("pixels"),
        Column::number("with an order"),
        Column::number("half an order lower"),
        Column::number("of the squared error"),
    ];
    let count = |count: usize| Cell::number(count.to_string(), count as f64);
    let rows = axis.lost.iter().map(|lost| {
        vec![
            Cell::text(lost.class.words()),
            count(lost.pixels),
            count(lost.shown),
            count(lost.lower),
            Cell::number(format!("{:.0} %", 100.0 * lost.share), lost.share),
        ]
    });
    let caption = format!("Refining the {}: orders pixel by pixel", axis.axis.name());
    Some(Block::Table(Table::new(caption, columns).with(rows)))
}

fn levels(axis: &Measured) -> Table {
    let columns = [
        Column::number(match axis.axis {
            Axis::Step => "steps along the diagonal",
            Axis::Grid => "cells",
            Axis::Pixel => "pixels",
        }),
        Column::logarithm("max"),
        Column::logarithm("L1"),
        Column::logarithm("L2"),
        Column::logarithm("L2, smooth pixels"),
        Column::logarithm("of the other axes"),
    ];
    let rows = axis.levels.iter().map(|level| {
        let Norms { max, l1, l2, .. } = level.all;
        let count = Cell::number(level.count.to_string(), level.count as f64);
        let errors = [max, l1, l2, level.smooth.l2, level.others];
        let cells = errors
            .into_iter()
            .map(|error| Cell::number(format!("{error:.3e}"), error.log10()));
        std::iter::once(count).chain(cells).collect()
    });
    let caption = format!("Refining the {}", axis.axis.name());
    Table::new(caption, columns)
        .with(rows)
        .named(format!("levels-{}", axis.axis.name()))
}

/// L2 over smooth pixels, by the size of what is refined.
fn figure(axes: &[Measured]) -> Figure {
    let x = PlotAxis::log("step, distance of samples, size of pixels (1 at the coarsest)");
    let y = PlotAxis::log("L2 of the error over smooth pixels");
    let mut plot = Plot::new("Errors along the axes", x, y);
    for axis in axes {
        let coarsest = axis.levels.first().map_or(1.0, |level| level.size);
        let points = axis.levels.iter().map(|level| {
            let label = format!("{} at {}", level.smooth.l2, level.count);
            let (x, y) = ((level.size / coarsest).log10(), level.smooth.l2.log10());
            let point = Point::new(x, y, label);
            if level.is_clean {
                point.filled()
            } else {
                point
            }
        });
        plot.series.push(Series::line(axis.axis.name(), points));
    }
    let caption = "Filled where errors of the other two axes are under a tenth";
    Figure::new("errors", caption, [plot])
}
