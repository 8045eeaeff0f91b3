//! The pieces of a section.

use super::{facts, figure, table};
use crate::report::html::{Block, Plot};
use maud::{Markup, html};

pub(super) fn blocks(blocks: &[Block]) -> Markup {
    html! {
        @for run in blocks.chunk_by(|a, b| is_plot(a) && is_plot(b)) {
            @match run {
                [Block::Text(text)] => p { (text) },
                [Block::Facts(some)] => (facts(some)),
                [Block::Table(some)] => (table::table(some)),
                plots => div.plots {
                    @for plot in plots.iter().filter_map(plot) { (figure::figure(plot)) }
                },
            }
        }
    }
}

fn plot(block: &Block) -> Option<&Plot> {
    match block {
        Block::Plot(plot) => Some(plot),
        Block::Text(_) | Block::Facts(_) | Block::Table(_) => None,
    }
}

fn is_plot(block: &Block) -> bool {
    plot(block).is_some()
}
