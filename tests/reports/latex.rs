//! The tables of a document for LaTeX.

use super::document;
use volver::document::{Block, Cell, Column, Medium, Table};
use volver::render::latex;

fn table(caption: &str, cell: &str) -> Block {
    let table = Table::new(caption, [Column::text("method"), Column::number("order")]);
    Block::Table(table.with([vec![Cell::text(cell), Cell::number("2", 2.0)]]))
}

#[test]
fn a_table_is_a_tabular_with_rules() {
    let text = latex(&document([table("Orders", "trapezoid")]));
    let expected = format!(
        "% A trial: trial of volver {}; needs \\usepackage{{booktabs}}.\n\
         % Orders\n\\begin{{tabular}}{{lr}}\n\\toprule\nmethod & order \\\\\n\\midrule\n\
         trapezoid & 2 \\\\\n\\bottomrule\n\\end{{tabular}}\n",
        env!("CARGO_PKG_VERSION")
    );
    assert_eq!(text, expected);
}

#[test]
fn everything_is_escaped_and_what_latex_may_not_know_replaced() {
    let escaped = |cell: &str| {
        let text = latex(&document([table("t", cell)]));
        let row = text.lines().nth(6).unwrap();
        row.strip_suffix(" & 2 \\\\").unwrap().to_string()
    };
    for (plain, expected) in [
        ("50% of_a & b#", "50\\% of\\_a \\& b\\#"),
        ("{$x$}", "\\{\\$x\\$\\}"),
        ("\\input{x}", "\\textbackslash{}input\\{x\\}"),
        ("a~b^c", "a$\\sim$b\\textasciicircum{}c"),
        ("4.000 ± 0.009", "4.000 $\\pm$ 0.009"),
        (
            "a × b ≤ c ≥ d < e > f",
            "a $\\times$ b $\\le$ c $\\ge$ d $<$ e $>$ f",
        ),
        (
            "16 … 256 – µ λ τ Δ",
            "16 \\dots{} 256 -- $\\mu$ $\\lambda$ $\\tau$ $\\Delta$",
        ),
        ("音\u{1b}[31m", "??[31m"),
    ] {
        assert_eq!(escaped(plain), expected, "{plain}");
    }
    let hidden = latex(&document([table("a\n\\end{document}", "x")]));
    assert!(
        hidden.contains("\n% a?\\textbackslash{}end\\{document\\}\n"),
        "{hidden}"
    );
}

#[test]
fn groups_stand_where_they_change_behind_a_rule() {
    let columns = [Column::text("inner").grouping(), Column::text("outer")];
    let row = |inner: &str, outer: &str| vec![Cell::text(inner), Cell::text(outer)];
    let rows = [
        row("a", "x"),
        row("a", "y"),
        row("b", "x"),
        vec![Cell::text("b")],
    ];
    let text = latex(&document([Block::Table(
        Table::new("t", columns).with(rows),
    )]));
    let rows = "\\midrule\na & x \\\\\n & y \\\\\n\\midrule\nb & x \\\\\n &  \\\\\n\\bottomrule\n";
    assert!(text.contains(rows), "{text}");
}

#[test]
fn tables_for_latex_stand_for_all_others() {
    let blocks = || [table("other", "x"), table("csv", "y").only(Medium::Csv)];
    let own = table("own", "z").only(Medium::Latex);
    let text = latex(&document(blocks().into_iter().chain([own])));
    assert!(text.contains("% own\n") && text.matches("\\begin{tabular}").count() == 1);
    let text = latex(&document(blocks()));
    assert!(text.contains("% other\n") && text.matches("\\begin{tabular}").count() == 1);
}
