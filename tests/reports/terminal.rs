//! Documents on a terminal.

use super::{document, without_color};
use volver::document::{
    Block, Cell, Column, Conclusion, Document, Fact, Figure, Finding, Medium, Section, Table, Tone,
};
use volver::render::terminal;
use volver::render::terminal::{heading, row, wrap};

fn text(blocks: impl IntoIterator<Item = Block>, width: usize) -> String {
    terminal(&document(blocks), width, false)
}

fn cells<const N: usize>(texts: [&str; N]) -> Vec<Cell> {
    texts.map(Cell::text).into()
}

#[test]
fn words_wrap_with_an_indent() {
    assert_eq!(
        wrap("aa bb ccccccc d", 7, "* ", "  "),
        ["* aa bb", "  ccccccc", "  d"]
    );
    assert_eq!(wrap("", 7, "* ", "  "), ["* "]);
}

#[test]
fn pieces_stand_below_each_other_and_the_conclusion_last() {
    let mut document = document([
        Block::Text("Some words.".into()),
        Block::Facts(vec![Fact::new("a", "1"), Fact::new("long", "2")]),
        Block::Finding(Finding::new("label", "bad").toned(Tone::Bad)),
        Block::Finding(Finding::new("", "plain")),
        Block::Lines("x  =  1\n\n  y\n".into()),
        Block::Figure(Figure::new("f", "Not drawn", [])),
    ]);
    let legend = Block::Facts(vec![Fact::new("word", "meaning")]);
    let legend = Section::of("words", "Words", [legend]).aside();
    document.sections.push(legend);
    document.conclusion = Some(Conclusion::new("1 line: 1 Confirmed"));
    let expected = "S\nSome words.\na     1\nlong  2\n! label: bad\n* plain\n  x  =  1\n\n    y\n\n\
                    word  meaning\n\n1 line: 1 Confirmed\n";
    assert_eq!(terminal(&document, 80, false), expected);
    document.sections.clear();
    assert_eq!(terminal(&document, 0, true), "1 line: 1 Confirmed\n");
}

#[test]
fn what_is_for_others_is_not_shown() {
    let word = |word: &str, medium| Block::Text(word.into()).only(medium);
    let shown = text(
        [
            word("terminal", Medium::Terminal),
            word("written", Medium::Written),
            word("page", Medium::Page),
            word("csv", Medium::Csv),
        ],
        80,
    );
    assert_eq!(shown, "S\nterminal\n");
    assert_eq!(text([word("written", Medium::Written)], 80), "");
    assert_eq!(text([Block::Figure(Figure::new("f", "", []))], 80), "");
}

#[test]
fn columns_are_as_wide_as_their_cells_and_numbers_stand_to_the_right() {
    let table = Table::new(
        "t",
        [
            Column::text("name"),
            Column::number("n"),
            Column::text("empty"),
            Column::verdict("verdict"),
        ],
    );
    let rows = [
        cells(["µ", "1024", "", "Exact"]),
        cells(["simpson", "8", "", "TooLow"]),
    ];
    let expected = "S\n  name        n  verdict\n  µ        1024  Exact\n  simpson     8  TooLow\n";
    assert_eq!(text([Block::Table(table.with(rows))], 80), expected);
}

#[test]
fn columns_that_do_not_fit_go_to_further_lines_of_the_row() {
    let columns = ["first", "second", "third", "fourth"].map(Column::number);
    let wide = ["1", "2", "3", "4"].map(|digit| digit.repeat(18));
    let row = wide.clone().map(Cell::text).into();
    let table = Table::new("t", columns).with([row]);
    let text = text([Block::Table(table)], 40);
    let [a, b, c, d] = wide;
    let expected = format!(
        "S\n{:>20}  {:>18}\n{:>22}\n{:>22}\n  {a}  {b}\n    {c}\n    {d}\n",
        "first", "second", "third", "fourth"
    );
    assert_eq!(text, expected);
    assert!(text.lines().all(|line| line.chars().count() <= 40));
}

#[test]
fn text_at_the_end_of_a_line_is_wrapped_where_there_is_room() {
    let columns = || [Column::text("check"), Column::text("outcome")];
    let outcome = "refuted at lambda = 1/3 where the value is in [1, 2]";
    let table = Table::new("t", columns()).with([cells(["C >= 0", outcome])]);
    assert_eq!(
        text([Block::Table(table)], 40),
        "S\n  check   outcome\n  C >= 0  refuted at lambda = 1/3 where\n          the value is in [1, 2]\n"
    );
    // A word is never broken: rather it has a line of its own.
    let word = "linear_exponential_first_order";
    let table = Table::new("t", columns()).with([cells(["simpson/linear", word])]);
    let expected = format!("S\n  check\n    outcome\n  simpson/linear\n    {word}\n");
    assert_eq!(text([Block::Table(table)], 40), expected);
}

#[test]
fn a_brief_column_is_cut_and_one_below_stands_below() {
    let columns = [
        Column::text("case"),
        Column::text("tags").brief(),
        Column::text("open").below(),
    ];
    let name = "n".repeat(20);
    let row = |tags: &str, open: &str| cells([&name, tags, open]);
    let rows = [
        row("thin, paper", ""),
        row(
            "thin, paper, smooth",
            "C >= 0: undecided near one third of the ray\nt' = tau: refuted",
        ),
        row("thin, paperish, smooth", ""),
    ];
    let table = Table::new("t", columns).with(rows);
    let blank = " ".repeat(18);
    let expected = format!(
        "S\n  case{blank}tags\n  {name}  thin, paper\n  {name}  thin, paper, smo…\n\
         \x20   C >= 0: undecided near one third of\n    the ray\n    t' = tau: refuted\n  {name}  thin, paperish…\n"
    );
    assert_eq!(text([Block::Table(table)], 41), expected);
}

#[test]
fn groups_are_headings_and_details_are_left_out() {
    let columns = [
        Column::text("inner").grouping(),
        Column::text("outer"),
        Column::number("detail").detail(),
        Column::number("order"),
    ];
    let row = |inner, outer| cells([inner, outer, "hidden", "4"]);
    let rows = [
        row("simpson", "boole"),
        row("simpson", "riemann"),
        row("boole", "boole"),
    ];
    let expected = "S\n  outer    order\ninner: simpson\n  boole        4\n  riemann      4\ninner: boole\n  boole        4\n";
    let table = Table::new("t", columns).with(rows);
    assert_eq!(text([Block::Table(table)], 80), expected);
}

#[test]
fn cells_of_several_lines_stand_beside_each_other() {
    let table = Table::new("t", [Column::text("rule"), Column::number("order")]).with([
        cells(["simpson", "4.00\nusual 3.8"]),
        cells(["a\nb\nc", "1"]),
    ]);
    let expected = "S\n  rule         order\n  simpson       4.00\n           usual 3.8\n  a                1\n  b\n  c\n";
    assert_eq!(text([Block::Table(table)], 80), expected);
}

#[test]
fn a_long_table_ends_early_and_says_so() {
    let row = |k: i32| vec![Cell::text(k.to_string())];
    let table = |most| {
        Table::new("t", [Column::number("n")])
            .with((0..12).map(row))
            .at_most(most)
    };
    let shown = text([Block::Table(table(2))], 80);
    assert_eq!(shown, "S\n  n\n  0\n  1\n  … and 10 rows more\n");
    assert!(!text([Block::Table(table(12))], 80).contains('…'));
}

#[test]
fn rows_shown_one_by_one_stand_as_in_the_whole_table() {
    let columns = [
        Column::text("case").wide(12),
        Column::verdict("outcome").wide(11),
        Column::text("file"),
        Column::text("reason").below(),
    ];
    let rows = [
        cells(["thick", "failed", "./thick.v", "No applicable tactic."]),
        cells(["sine-squared", "proved", "./sine_squared.v", ""]),
    ];
    let empty = Table::new("t", columns);
    let one_by_one: Vec<String> = rows
        .iter()
        .map(|cells| row(&empty, cells, 60, false))
        .collect();
    let one_by_one = "S\n".to_string() + &heading(&empty, 60, false) + &one_by_one.concat();
    assert_eq!(one_by_one, text([Block::Table(empty.with(rows))], 60));
    assert!(one_by_one.contains("./thick.v\n    No applicable tactic.\n"));
}

/// One of each piece, with something that steers a terminal wherever a file's words may stand.
fn steering() -> Document {
    let evil = "a\u{1b}[31mb\u{7}c\u{9b}2Jd";
    let lines = format!("{evil}\n{evil}");
    let columns = [
        Column::text(evil).grouping(),
        Column::text(evil),
        Column::text(evil).brief(),
        Column::text(evil).below(),
    ];
    let table = Table::new(evil, columns).with([cells([evil, &lines, evil, &lines])]);
    let mut document = document([
        Block::Text(evil.into()),
        Block::Lines(lines.clone()),
        Block::Facts(vec![Fact::new(evil, evil).toned(Tone::Good)]),
        Block::Finding(Finding::new(evil, evil).toned(Tone::Bad)),
        Block::Table(table),
    ]);
    document.title = evil.into();
    document.sections[0].title = evil.into();
    document.conclusion = Some(Conclusion::new(evil).toned(Tone::Open));
    document
}

#[test]
fn what_a_file_says_does_not_steer_the_terminal() {
    let text = terminal(&steering(), 60, false);
    let is_harmless = |c: char| c == '\n' || !c.is_control();
    assert!(text.chars().all(is_harmless), "{text:?}");
    assert!(text.contains("a [31mb c 2Jd"), "{text}");
}

#[test]
fn color_adds_escapes_and_nothing_else() {
    let document = steering();
    let colored = terminal(&document, 60, true);
    assert_eq!(without_color(&colored), terminal(&document, 60, false));
    for painted in [
        "\u{1b}[32ma [31mb",
        "\u{1b}[31m! a",
        "\u{1b}[33ma",
        "\u{1b}[1ma",
    ] {
        assert!(colored.contains(painted), "{colored:?}");
    }
}
