use super::latex::escape;
use super::{csv, json, latex, markdown, page, text, write};
use crate::document::{About, Block};
use crate::render::html::render;
use crate::study::sweep::fixture::results;
use crate::study::sweep::{LevelRecord, Results, State};
use serde_json::Value;
use std::fs;

/// With a level that is refused and one that is not finite.
fn odd() -> Results {
    let mut results = results();
    let levels = &mut results.lines[0].row.levels;
    let blank = |level: &LevelRecord, state| LevelRecord {
        state,
        total: None,
        discretization: None,
        truncation: None,
        input: None,
        arithmetic: None,
        of_depth: None,
        resolution: None,
        oracle_bits: None,
        n: level.n,
    };
    levels[0] = blank(
        &levels[0],
        State::Refused("n = 8 does not suit, \"really\"".into()),
    );
    levels[1] = blank(&levels[1], State::NotFinite);
    results
}

#[test]
fn the_table_has_every_figure_in_80_columns() {
    let text = text(&odd(), 80, false);
    assert!(text.contains("made-up, a × b: theory 2\n"), "{text}");
    let line = text.lines().find(|line| line.contains("f32")).unwrap();
    // n* = (0.15·2²⁴)^0.4 = 363.2, found in steps of 1/32 octave; the least error is 2.92e-6 by calculus.
    for figure in ["2.0000 ± 0.0000 Confirmed", "0.50 ± 0.00", "362", "2.9e-6"] {
        assert!(line.contains(figure), "{figure}: {line}");
    }
    assert!(text.contains("! f32: n = 16: NotFinite"), "{text}");
    assert!(
        text.contains("! f32: n = 8: Refused: n = 8 does not suit"),
        "{text}"
    );
    assert!(!text.contains("mpfr:10"), "{text}");
    assert!(
        text.ends_with("\n1 line, discretization: 1 Confirmed\n"),
        "{text}"
    );
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn a_narrow_terminal_and_colour_change_no_figure() {
    let narrow = text(&odd(), 60, false);
    assert!(
        narrow.lines().all(|line| line.chars().count() <= 60),
        "{narrow}"
    );
    assert!(narrow.contains("0.50 ± 0.00"), "{narrow}");
    let mut colored = text(&odd(), 80, true);
    assert!(
        colored.contains("\u{1b}[32m2.0000 ± 0.0000 Confirmed\u{1b}[0m"),
        "{colored}"
    );
    for code in [0, 1, 2, 31, 32, 33] {
        colored = colored.replace(&format!("\u{1b}[{code}m"), "");
    }
    assert_eq!(colored, text(&odd(), 80, false));
}

#[test]
fn csv_has_a_line_a_level_whatever_the_reason_says() {
    let text = csv(&odd()).unwrap();
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    let head = reader.headers().unwrap().clone();
    let at = |name| head.iter().position(|h| h == name).unwrap();
    let records: Vec<_> = reader.records().map(Result::unwrap).collect();
    assert_eq!(records.len(), 4 * 10);
    assert_eq!(&records[0][at("reason")], "n = 8 does not suit, \"really\"");
    assert_eq!(
        (&records[0][at("state")], &records[0][at("total")]),
        ("refused", "")
    );
    assert_eq!(&records[1][at("state")], "not-finite");
    let n: u64 = records[9][at("n")].parse().unwrap();
    let part: f64 = records[9][at("discretization")].parse().unwrap();
    assert_eq!((n, part), (4096, 0.3 / (4096.0 * 4096.0)));
}

#[test]
fn json_has_settings_and_summaries() {
    let document: Value = serde_json::from_str(&json(&odd()).unwrap()).unwrap();
    assert_eq!(
        document["settings"]["sweep_bits"],
        serde_json::json!([10, 12])
    );
    assert_eq!(document["settings"]["levels"][9], 4096);
    let row = &document["rows"][0];
    assert_eq!(row["expected"]["order"], 2.0);
    assert_eq!(row["discretization"]["verdict"], "Confirmed");
    // Ten of the ladder, and 17 between them.
    assert_eq!(row["laws"]["arithmetic"]["levels"], 27);
    assert_eq!(row["states"]["refused"], 1);
    assert_eq!(row["bits_needed"][0]["tolerance"], 1e-3);
    assert!(row["best"]["error"].is_f64() && row["crossing"].is_f64());
    assert_eq!(document["rows"].as_array().unwrap().len(), 4);
}

#[test]
fn latex_and_markdown_escape_what_they_must() {
    assert_eq!(
        escape("a_b & 50% {x} \\ ^ ~ ± × é"),
        "a\\_b \\& 50\\% \\{x\\} \\textbackslash{} \\textasciicircum{} $\\sim$ $\\pm$ $\\times$ ?"
    );
    let table = latex(&odd());
    assert!(
        table.contains(
            "\nmade-up & a $\\times$ b & f32 & 2.0000 $\\pm$ 0.0000 & 2 & 0.50 $\\pm$ 0.00 & - & "
        ),
        "{table}"
    );
    // Every row has as many cells as there are columns.
    for row in table.lines().filter(|line| line.ends_with("\\\\")) {
        assert_eq!(row.matches(" & ").count(), 8, "{row}");
    }
    let document = markdown(&odd());
    assert!(
        document.contains("![The parts of the error against n](parts-made-up-a-b.svg)"),
        "{document}"
    );
    assert!(document.contains("(digits-made-up-a-b.svg)"));
    for row in document.lines().filter(|line| line.starts_with("| f32")) {
        assert_eq!(row.matches('|').count(), 9, "{row}");
    }
}

#[test]
fn a_directory_gets_everything_twice_the_same() {
    let directory = tempfile::tempdir().unwrap();
    let about = About::new(["volver"]);
    let paths = write(directory.path(), &odd(), &about).unwrap();
    let read = || {
        paths
            .iter()
            .map(|path| fs::read_to_string(path).unwrap())
            .collect::<Vec<_>>()
    };
    let before = read();
    write(directory.path(), &odd(), &about).unwrap();
    assert_eq!(before, read());
    let names: Vec<_> = paths
        .iter()
        .map(|path| path.file_name().unwrap().to_str().unwrap())
        .collect();
    assert_eq!(
        names,
        [
            "parts-made-up-a-b.svg",
            "digits-made-up-a-b.svg",
            "study.csv",
            "study.json",
            "study.tex",
            "study.md",
            "index.html"
        ]
    );
    // One panel; n* and the least error beside the line; a map with a cell a level and format.
    assert!(
        before[0].contains("n* = 362") && before[0].contains("best 2.9e-6"),
        "{}",
        before[0]
    );
    assert!(before[1].matches("<rect").count() > 30);
    assert!(before[1].contains("Correct decimal digits"));
}

#[test]
fn a_page_has_the_tables_and_plots_of_the_document() {
    let results = odd();
    let page = page(&results, &About::new(["volver"]));
    let document = markdown(&results).replace('\\', "");
    let blocks = || page.sections.iter().flat_map(|section| &section.blocks);
    let mut rows = 0;
    let mut shades = 0;
    for block in blocks() {
        let Block::Table(table) = block else { continue };
        shades += table
            .rows
            .iter()
            .flatten()
            .filter(|cell| cell.shade.is_some())
            .count();
        if table.columns[0].title == "format" {
            for row in &table.rows {
                rows += 1;
                assert!(
                    row.iter().all(|cell| document.contains(&cell.text)),
                    "{row:?}"
                );
            }
        }
    }
    let lines = results.lines.iter().filter(|line| !line.swept);
    assert_eq!(rows, lines.clone().count());
    assert!(shades > 10, "{shades}");
    let plots: Vec<_> = blocks()
        .filter_map(|block| match block {
            Block::Figure(figure) => Some(&figure.plots),
            _ => None,
        })
        .flatten()
        .collect();
    assert_eq!(plots.len(), lines.count());
    let names: Vec<&str> = plots[0]
        .series
        .iter()
        .map(|series| &series.name[..])
        .collect();
    assert!(
        names[0] == "total" && names[1].starts_with("discretization"),
        "{names:?}"
    );
    assert!(
        plots[0].guides[0].label.contains("n* = 362"),
        "{:?}",
        plots[0].guides
    );
    for remark in ["Refused: ", "NotFinite: "] {
        assert!(render(&page).unwrap().contains(remark), "{remark}");
    }
}
