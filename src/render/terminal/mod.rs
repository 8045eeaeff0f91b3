//! A document on a terminal.
//!
//! Tables are set in columns as wide as their cells. Where they do not fit, text in the last column is wrapped, and other
//! columns go to a second line of each row, and so on: nothing is left out but what a builder calls a detail.

mod paint;
mod table;
mod wrap;

pub use paint::Style;
pub use table::{below, heading, row};
pub use wrap::wrap;

use crate::document::{Block, Document, Fact, Medium, Section, Tone};
use paint::paint;
use wrap::harmless;

/// Narrower than this, lines are cut by the terminal instead.
pub const MIN_WIDTH: usize = 40;

/// Names of facts in one column, but no wider than this.
const NAME: usize = 28;

/// The document in lines of at most `width` columns, with ANSI colour where `color` says so. The conclusion is its last line.
#[must_use]
pub fn terminal(document: &Document, width: usize, color: bool) -> String {
    let mut page = Page::new(width, color);
    for (section, blocks) in document.shown_in(&[Medium::Terminal]) {
        page.section(section, &blocks);
    }
    if let Some(conclusion) = &document.conclusion {
        page.gap();
        let style = conclusion.tone.map_or(Style::Plain, Style::of);
        page.put(&conclusion.words, "", "", style);
    }
    page.text
}

/// Lines, as they are written.
struct Page {
    width: usize,
    color: bool,
    text: String,
}

impl Page {
    fn new(width: usize, color: bool) -> Self {
        Page {
            width: width.max(MIN_WIDTH),
            color,
            text: String::new(),
        }
    }

    fn section(&mut self, section: &Section, blocks: &[&Block]) {
        if blocks.iter().all(|block| matches!(block, Block::Figure(_))) {
            return;
        }
        self.gap();
        if !section.title.is_empty() && !section.is_aside {
            self.put(&section.title, "", "  ", Style::Bold);
        }
        let style = if section.is_aside {
            Style::Faint
        } else {
            Style::Plain
        };
        for block in blocks {
            self.block(block, style);
        }
    }

    /// An empty line, but for the first.
    fn gap(&mut self) {
        if !self.text.is_empty() {
            self.text.push('\n');
        }
    }

    fn block(&mut self, block: &Block, style: Style) {
        match block {
            Block::Text(words) => self.put(words, "", "  ", style),
            Block::Lines(lines) => self.lines(lines),
            Block::Facts(facts) => self.facts(facts, style),
            Block::Finding(finding) => {
                let first = match finding.tone {
                    Some(Tone::Bad | Tone::Open) => "! ",
                    Some(Tone::Good) | None => "* ",
                };
                let style = finding.tone.map_or(style, Style::of);
                self.put(&finding.sentence(), first, "  ", style);
            }
            Block::Table(table) => self.text += &table::table(table, self.width, self.color),
            // A terminal draws nothing, and what is for others was sorted out before.
            Block::Figure(_) | Block::For(..) => {}
        }
    }

    fn facts(&mut self, facts: &[Fact], style: Style) {
        let names = facts.iter().map(|fact| fact.name.chars().count());
        let widest = names.filter(|name| *name <= NAME).max().unwrap_or(0);
        let later = " ".repeat(widest + 2);
        for fact in facts {
            let style = fact.tone.map_or(style, Style::of);
            if fact.name.chars().count() > widest {
                self.put(&format!("{}: {}", fact.name, fact.value), "", "  ", style);
                continue;
            }
            let first = format!("{:<widest$}  ", fact.name);
            self.put(&fact.value, &first, &later, style);
        }
    }

    /// Lines as they are: formulas may stand in columns.
    fn lines(&mut self, lines: &str) {
        for line in lines.trim_end().lines() {
            self.text += format!("  {}", harmless(line)).trim_end();
            self.text.push('\n');
        }
    }

    fn put(&mut self, words: &str, first: &str, later: &str, style: Style) {
        for line in wrap(words, self.width, first, later) {
            self.text += &paint(harmless(&line).trim_end(), style, self.color);
            self.text.push('\n');
        }
    }
}
