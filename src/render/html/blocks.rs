//! The pieces of a section.

use super::tone::{classes, facts, sign};
use super::{figure, table};
use crate::document::{Block, Finding, Plot};
use maud::{Markup, html};

pub(super) fn blocks(blocks: &[&Block]) -> Markup {
    html! {
        @for run in blocks.chunk_by(|a, b| plots(a).is_some() && plots(b).is_some()) {
            @match run {
                [Block::Text(text)] => p { (text) },
                // It scrolls by itself, and keyboards have to reach it.
                [Block::Lines(lines)] => pre tabindex="0" { (lines) },
                [Block::Facts(some)] => (facts(some)),
                [Block::Finding(found)] => (finding(found)),
                [Block::Table(some)] => (table::table(some)),
                figures => div.plots {
                    @for plot in figures.iter().filter_map(|block| plots(block)).flatten() {
                        (figure::figure(plot))
                    }
                },
            }
        }
    }
}

fn plots(block: &Block) -> Option<&[Plot]> {
    match block {
        Block::Figure(figure) => Some(&figure.plots),
        _ => None,
    }
}

fn finding(finding: &Finding) -> Markup {
    html! {
        p class=(classes("finding", finding.tone)) {
            (sign(finding.tone))
            @if !finding.label.is_empty() { strong { (finding.label) ": " } }
            (finding.words)
        }
    }
}
