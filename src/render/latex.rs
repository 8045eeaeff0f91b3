//! The tables of a document for LaTeX.

use crate::document::{Column, Document, Kind, Medium, Table};

/// A `tabular` for the package booktabs a table: those for LaTeX if the document has such, otherwise all. Cells of a column of
/// groups stand where they change, behind a rule. All text is escaped.
#[must_use]
pub fn latex(document: &Document) -> String {
    let tables = super::csv::tables(document, Medium::Latex);
    let mut text = format!(
        "% {}: {} of volver {}; needs \\usepackage{{booktabs}}.\n",
        escape(&document.title),
        document.kind,
        document.about.version
    );
    for table in tables {
        text += &tabular(table);
    }
    text
}

fn tabular(table: &Table) -> String {
    let kinds: String = table.columns.iter().map(letter).collect();
    let titles: Vec<String> = table.columns.iter().map(|c| escape(&c.title)).collect();
    let mut text = format!(
        "% {}\n\\begin{{tabular}}{{{kinds}}}\n\\toprule\n{} \\\\\n",
        escape(&table.caption),
        titles.join(" & ")
    );
    let groups: Vec<usize> = (0..table.columns.len())
        .filter(|i| table.columns.get(*i).is_some_and(|c| c.is_group))
        .collect();
    let of = |row: &[crate::document::Cell], i: usize| {
        row.get(i).map_or(String::new(), |cell| cell.text.clone())
    };
    let mut above: Option<Vec<String>> = None;
    for row in &table.rows {
        let own: Vec<String> = groups.iter().map(|i| of(row, *i)).collect();
        let is_new = above.as_ref() != Some(&own);
        if above.is_none() || (is_new && !groups.is_empty()) {
            text += "\\midrule\n";
        }
        let cells = (0..table.columns.len()).map(|i| {
            if groups.contains(&i) && !is_new {
                String::new()
            } else {
                escape(&of(row, i))
            }
        });
        text += &cells.collect::<Vec<_>>().join(" & ");
        text += " \\\\\n";
        above = Some(own);
    }
    text += "\\bottomrule\n\\end{tabular}\n";
    text
}

fn letter(column: &Column) -> char {
    match column.kind {
        Kind::Number | Kind::Logarithm => 'r',
        Kind::Text | Kind::Verdict => 'l',
    }
}

/// Text that LaTeX sets as it stands; letters that it may not know become commands or question marks.
fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                escaped.push('\\');
                escaped.push(c);
            }
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("$\\sim$"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '<' => escaped.push_str("$<$"),
            '>' => escaped.push_str("$>$"),
            '±' => escaped.push_str("$\\pm$"),
            '×' => escaped.push_str("$\\times$"),
            '≤' => escaped.push_str("$\\le$"),
            '≥' => escaped.push_str("$\\ge$"),
            '…' => escaped.push_str("\\dots{}"),
            '–' => escaped.push_str("--"),
            'µ' => escaped.push_str("$\\mu$"),
            'λ' => escaped.push_str("$\\lambda$"),
            'τ' => escaped.push_str("$\\tau$"),
            'Δ' => escaped.push_str("$\\Delta$"),
            c if c.is_ascii() && !c.is_ascii_control() => escaped.push(c),
            _ => escaped.push('?'),
        }
    }
    escaped
}
