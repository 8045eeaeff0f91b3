//! The extremes: figures and codes, what is silently wrong, and maps.

use volver::document::{About, Block, Cell as Shown, Medium, Table, Tone};
use volver::render::{markdown, terminal};
use volver::report::stress::document;
use volver::study::stress::{Cell, Digits, FORMATS, Verdict};

fn about() -> About {
    About::new(["volver", "stress"])
}

const METHODS: [&str; 2] = ["trapezoid/trapezoid", "tree/middle/expm1"];
const SCENARIOS: [&str; 3] = ["depth/1e0", "fault/minus-infinity", "spike/missed"];

/// 7 digits of 5 promised everywhere, 3 of the exact radiance.
fn cells() -> Vec<Cell> {
    let of = |method: &str, scenario: &str, format: &str| Cell {
        scenario: scenario.into(),
        method: method.into(),
        format: format.into(),
        n: 256,
        digits: Some(Digits::Of(7.9)),
        against_radiance: Some(Digits::Of(3.1)),
        promised: 5.0,
        verdict: None,
        reason: None,
    };
    let mut cells = Vec::new();
    for method in METHODS {
        for scenario in SCENARIOS {
            cells.extend(FORMATS.map(|format| of(method, scenario, format)));
        }
    }
    cells
}

/// The tables of all methods as these readers see them.
fn tables(cells: &[Cell], medium: Medium) -> Vec<Table> {
    let document = document(cells, &about());
    let tables = document
        .blocks()
        .filter_map(|block| match block.shown_in(&[medium]) {
            Some(Block::Table(table)) => Some(table.clone()),
            _ => None,
        });
    tables.collect()
}

fn first(cells: &[Cell], medium: Medium) -> Shown {
    tables(cells, medium)[0].rows[0][1].clone()
}

#[test]
fn a_terminal_has_formats_by_short_names_in_80_columns() {
    let text = terminal(&document(&cells(), &about()), 80, false);
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let head = [
        "scenario", "f16", "bf16", "f32", "f64", "tf32", "e4m3", "fix8", "fix15",
    ];
    for method in METHODS {
        let mut lines = text.lines().skip_while(|line| *line != method).skip(1);
        let words = |line: Option<&str>| -> Vec<String> {
            line.unwrap().split_whitespace().map(String::from).collect()
        };
        assert_eq!(words(lines.next()), head, "{text}");
        for scenario in SCENARIOS {
            let row = words(lines.next());
            assert_eq!(row[0], scenario);
            assert!(
                row.len() == 9 && row[1..].iter().all(|cell| cell == "7/3"),
                "{text}"
            );
        }
    }
    let full = markdown(&document(&cells(), &about()));
    assert!(full.contains("| fp8-e4m3 | fixed:8 | fixed:15 |"), "{full}");
    let last = "48 cells: 48 have the digits promised, 0 a verdict, 0 are silently wrong";
    assert_eq!(text.lines().last(), Some(last));
    assert!(full.contains(&format!("**{last}**")), "{full}");
}

#[test]
fn figures_say_digits_verdicts_and_what_is_silently_wrong() {
    let shown = |change: &dyn Fn(&mut Cell)| {
        let mut cells = cells();
        change(&mut cells[0]);
        let [at, in_writing] = [Medium::Terminal, Medium::Written].map(|to| first(&cells, to));
        assert_eq!(at.text, in_writing.text);
        (at.text.clone(), at.tone.unwrap(), in_writing)
    };
    let (text, tone, written) = shown(&|_| ());
    assert_eq!((&text[..], tone), ("7/3", Tone::Good));
    // A colour by digits, the darkest at 16.
    assert_eq!((written.tone, written.shade), (None, Some(7.9 / 16.0)));
    let (text, _, written) = shown(&|cell| {
        (cell.digits, cell.against_radiance) = (Some(Digits::Exact), None);
    });
    assert_eq!((&text[..], written.shade), ("=/?", Some(1.0)));
    let (text, ..) = shown(&|cell| cell.digits = Some(Digits::Of(17.0)));
    assert_eq!(text, "=/3");
    let (text, tone, written) = shown(&|cell| cell.verdict = Some(Verdict::Overflow));
    assert_eq!((&text[..], tone), ("over", Tone::Open));
    assert_eq!(
        (written.tone, written.shade, written.sort),
        (Some(Tone::Open), None, None)
    );
    let (text, tone, written) = shown(&|cell| cell.digits = Some(Digits::Of(4.4)));
    assert_eq!((&text[..], tone), ("4/3!", Tone::Bad));
    assert_eq!((written.tone, written.shade), (Some(Tone::Bad), None));
}

#[test]
fn what_is_silently_wrong_is_listed_and_counted() {
    let mut cells = cells();
    cells[0].digits = Some(Digits::Of(4.4));
    let accused = "depth/1e0 by trapezoid/trapezoid in f16, n = 256: 4.4 digits where 5.0 are \
                   promised, and no verdict";
    let document = document(&cells, &about());
    let text = terminal(&document, 200, true);
    assert!(
        text.contains(&format!("\u{1b}[31m! {accused}\u{1b}[0m\n")),
        "{text}"
    );
    assert!(
        text.contains(" 0 a verdict, 1 are silently wrong\u{1b}[0m\n"),
        "{text}"
    );
    assert!(markdown(&document).contains(&format!("- **{accused}**")));
    let summary = document
        .summary
        .iter()
        .map(|fact| (&fact.value[..], fact.tone));
    let tones = [Some(Tone::Bad), Some(Tone::Good), Some(Tone::Open), None];
    let wanted: Vec<_> = ["1", "47", "0", "48"].into_iter().zip(tones).collect();
    assert_eq!(summary.collect::<Vec<_>>(), wanted);
}

#[test]
fn codes_that_occur_are_explained_and_what_was_left_out() {
    let mut cells = cells();
    cells[0].verdict = Some(Verdict::NegativeTransmittance);
    for cell in &mut cells[1..3] {
        cell.verdict = Some(Verdict::LeftOut);
        cell.reason = Some("takes too long".into());
    }
    let document = document(&cells, &about());
    let meaning = Verdict::NegativeTransmittance.meaning();
    let text = terminal(&document, 100, false);
    assert!(
        text.contains(&format!("\nneg-T  NegativeTransmittance: {meaning}\n")),
        "{text}"
    );
    assert!(text.contains("\nleft out 2: takes too long\n"), "{text}");
    assert!(
        text.contains("\n7/3: 7 digits of what the method gives "),
        "{text}"
    );
    assert!(
        !text.contains("Overflow") && !text.contains("Scenarios:"),
        "{text}"
    );
    // Signs that are Markdown's stand behind a backslash.
    let written = markdown(&document).replace('\\', "");
    let bold = format!("- **neg-T**: NegativeTransmittance: {meaning}\n");
    assert!(written.contains(&bold), "{written}");
    assert!(written.contains("Scenarios:\n\n- **depth**: "), "{written}");
}

#[test]
fn the_maps_of_all_methods_are_one_file() {
    let maps = tables(&cells(), Medium::Written);
    assert_eq!(maps.len(), METHODS.len());
    for (map, method) in maps.iter().zip(METHODS) {
        assert!(map.is_shaded() && map.file == "stress");
        assert!(
            map.caption.starts_with(&format!("{method}: ")),
            "{}",
            map.caption
        );
    }
    let others = tables(&cells(), Medium::Terminal);
    assert!(
        others
            .iter()
            .all(|table| !table.is_shaded() && table.file.is_empty())
    );
    let text = markdown(&document(&cells(), &about()));
    assert_eq!(text.matches("](stress.svg)").count(), 1, "{text}");
}
