//! Documents as GitHub Markdown.

use super::document;
use volver::document::{
    Block, Cell, Column, Conclusion, Fact, Figure, Finding, Medium, Section, Table, Tone,
};
use volver::render::markdown;

/// Every row of a table has as many cells as its heading.
pub(crate) fn is_regular(markdown: &str) {
    let mut cells = None;
    for line in markdown.lines() {
        if !line.starts_with('|') {
            cells = None;
            continue;
        }
        let here = line.replace("\\|", "").matches('|').count();
        assert_eq!(*cells.get_or_insert(here), here, "{line}");
    }
}

#[test]
fn every_piece_has_its_form() {
    let mut document = document([
        Block::Text("Some words.".into()),
        Block::Facts(vec![
            Fact::new("a", "1"),
            Fact::new("b", "").toned(Tone::Bad),
        ]),
        Block::Finding(Finding::new("label", "words")),
        Block::Finding(Finding::new("", "bare")),
        Block::Lines("x  =  1\n".into()),
        Block::Figure(Figure::new("plot", "A [figure]", [])),
        Block::Figure(Figure::new("", "No file", [])),
    ]);
    document.about.seeds = vec![7, 8];
    document.conclusion = Some(Conclusion::new("1 line"));
    let untitled = Section::of("u", "", [Block::Text("end".into())]);
    document.sections.push(untitled);
    let text = markdown(&document);
    let head = format!(
        "# A trial\n\n**1 line**\n\n- **volver**: {}\n- **command**: volver\n- **seed**: 7, 8\n\n## S\n\n",
        env!("CARGO_PKG_VERSION")
    );
    let (start, rest) = text.split_at(head.len());
    assert_eq!(start, head);
    let expected = "Some words.\n\n- **a**: 1\n- **b**\n\n- **label**: words\n\n- **bare**\n\n\
                    ```\nx  =  1\n```\n\n![A \\[figure\\]](plot.svg)\n\n";
    assert!(rest.starts_with(expected), "{rest}");
    assert!(rest.ends_with("\n\nend\n"), "{rest}");
}

#[test]
fn nothing_is_markup_and_every_row_has_as_many_cells() {
    let columns = [
        Column::text("a|b"),
        Column::number("*n*"),
        Column::verdict("`v`"),
        Column::logarithm("<d>").detail(),
    ];
    let rows = [
        vec![Cell::text("x|y\\|z\n_low_")],
        vec![Cell::text(""), Cell::number("1\u{7}2\r\n3", 1.0)],
        vec![Cell::text("long"); 6],
    ];
    let evil = "a|b *c*\n<d> # ~e~ [f](g) &amp;";
    let text = markdown(&document([
        Block::Table(Table::new("t", columns).with(rows)),
        Block::Text(evil.into()),
    ]));
    let table = "| a\\|b | \\*n\\* | \\`v\\` | \\<d\\> |\n|---|--:|---|--:|\n\
                 | x\\|y\\\\\\|z<br>\\_low\\_ |  |  |  |\n|  | 1 2<br>3 |  |  |\n| long | long | long | long |\n";
    assert!(text.contains(table), "{text}");
    assert!(
        text.contains("\na\\|b \\*c\\* \\<d\\> \\# \\~e\\~ \\[f\\](g) \\&amp;\n"),
        "{text}"
    );
    is_regular(&text);
}

#[test]
fn lines_stay_whatever_fence_is_in_them() {
    let text = markdown(&document([Block::Lines("a\n```\n````\nb|c".into())]));
    assert!(
        text.contains("\n`````\na\n```\n````\nb|c\n`````\n"),
        "{text}"
    );
}

#[test]
fn a_map_is_drawn_beside_its_table_and_what_is_for_others_is_left_out() {
    let map = |file: &str| {
        let cell = Cell::number("3", 3.0).shaded(0.5);
        let table = Table::new("Digits", [Column::number("n")]).named(file);
        Block::Table(table.with([vec![cell]]))
    };
    let word = |word: &str, medium| Block::Text(word.into()).only(medium);
    let text = markdown(&document([
        map("digits"),
        word("written", Medium::Written),
        word("markdown", Medium::Markdown),
        word("terminal", Medium::Terminal),
        word("page", Medium::Page),
        word("latex", Medium::Latex),
    ]));
    assert!(
        text.ends_with("| 3 |\n\n![Digits](digits.svg)\n\nwritten\n\nmarkdown\n"),
        "{text}"
    );
    assert!(!markdown(&document([map("")])).contains("!["));
}
