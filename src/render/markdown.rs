//! A document as GitHub Markdown.

use crate::document::{Block, Cell, Column, Document, Fact, Kind, Medium, Table};
use std::collections::HashSet;

const MEDIA: [Medium; 2] = [Medium::Written, Medium::Markdown];

/// The document as GitHub Markdown. Figures and maps are linked as files beside it, named as in [`svg`](super::svg).
#[must_use]
pub fn markdown(document: &Document) -> String {
    let mut text = format!("# {}\n\n", escape(&document.title));
    if let Some(conclusion) = &document.conclusion {
        text += &["**", &escape(&conclusion.words), "**\n\n"].concat();
    }
    let about = &document.about;
    let mut facts = vec![
        Fact::new("volver", &about.version),
        Fact::new("command", &about.command),
    ];
    if !about.seeds.is_empty() {
        let seeds: Vec<String> = about.seeds.iter().map(ToString::to_string).collect();
        facts.push(Fact::new("seed", seeds.join(", ")));
    }
    text += &list(&facts);
    text.push('\n');
    let mut maps = HashSet::new();
    for (section, blocks) in document.shown_in(&MEDIA) {
        if !section.title.is_empty() {
            text += &["## ", &escape(&section.title), "\n\n"].concat();
        }
        for block in blocks {
            text += &self::block(block);
            // Maps of one name stand in one file.
            if let Block::Table(table) = block
                && table.is_shaded()
                && !table.file.is_empty()
                && maps.insert(&table.file)
            {
                text.push('\n');
                text += &image(&table.caption, &table.file);
            }
            text.push('\n');
        }
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

fn block(block: &Block) -> String {
    match block {
        Block::Text(words) => format!("{}\n", escape(words)),
        Block::Lines(lines) => fenced(lines),
        Block::Facts(facts) => list(facts),
        Block::Finding(finding) if finding.label.is_empty() => {
            format!("- **{}**\n", escape(&finding.words))
        }
        Block::Finding(finding) => {
            let (label, words) = (escape(&finding.label), escape(&finding.words));
            format!("- **{label}**: {words}\n")
        }
        Block::Table(table) => self::table(table),
        Block::Figure(figure) => image(&figure.caption, &figure.file),
        Block::For(..) => String::new(),
    }
}

/// Lines as they are; the fence is longer than any within them.
fn fenced(lines: &str) -> String {
    let mut fence = "```".to_string();
    while lines.contains(&fence) {
        fence.push('`');
    }
    format!("{fence}\n{}\n{fence}\n", lines.trim_end())
}

fn list(facts: &[Fact]) -> String {
    let line = |fact: &Fact| {
        let (name, value) = (escape(&fact.name), escape(&fact.value));
        if value.is_empty() {
            format!("- **{name}**\n")
        } else {
            format!("- **{name}**: {value}\n")
        }
    };
    facts.iter().map(line).collect()
}

fn table(table: &Table) -> String {
    let heads: Vec<String> = table.columns.iter().map(|c| escape(&c.title)).collect();
    let rules: String = table.columns.iter().map(rule).collect();
    let mut text = format!("| {} |\n|{rules}\n", heads.join(" | "));
    for row in &table.rows {
        let columns = 0..table.columns.len();
        let cells: Vec<String> = columns
            .map(|i| row.get(i).map_or(String::new(), cell))
            .collect();
        text += &["| ", &cells.join(" | "), " |\n"].concat();
    }
    text
}

fn rule(column: &Column) -> &'static str {
    match column.kind {
        Kind::Number | Kind::Logarithm => "--:|",
        Kind::Text | Kind::Verdict => "---|",
    }
}

fn cell(cell: &Cell) -> String {
    let lines: Vec<String> = cell.text.lines().map(escape).collect();
    lines.join("<br>")
}

/// A file beside the text, where there is one.
fn image(caption: &str, file: &str) -> String {
    if file.is_empty() {
        return String::new();
    }
    format!("![{}]({file}.svg)\n", escape(caption))
}

/// Text in which nothing is markup, in a cell or elsewhere; lines become one.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' | '|' | '*' | '_' | '`' | '<' | '>' | '[' | ']' | '~' | '#' | '&' => {
                escaped.push('\\');
                escaped.push(c);
            }
            control if control.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}
