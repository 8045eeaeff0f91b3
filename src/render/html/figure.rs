//! A plot with its legend.

use crate::document::Plot;
use crate::render::plot::{HEIGHT, Reader, SAMPLE, Scales, WIDTH, drawing, key, legend, names};
use maud::{Markup, html};

pub(super) fn figure(plot: &Plot) -> Markup {
    html! {
        figure.plot {
            figcaption { (plot.title) }
            @match Scales::new(plot) {
                Some(scales) => {
                    ul.legend {
                        @for entry in legend(plot) {
                            li.(entry.class) data-series=[entry.index] { (sample(&entry.sample)) span { (entry.words) } }
                        }
                    }
                    @let key = key(&[(plot, scales)]);
                    @if !key.is_empty() {
                        ul.key {
                            @for entry in key { li { (sample(&entry.sample)) (entry.words) } }
                        }
                    }
                    (image(plot, &scales))
                },
                None => p.none {
                    @let names = names(plot);
                    "Nothing to draw" @if !names.is_empty() { ": " (names) }
                },
            }
        }
    }
}

fn sample(drawing: &Markup) -> Markup {
    html! { svg.swatch viewBox={ "0 0 " (SAMPLE.0) " " (SAMPLE.1) } aria-hidden="true" { (drawing) } }
}

fn image(plot: &Plot, scales: &Scales) -> Markup {
    let label = format!(
        "{}: {} against {}; {}",
        plot.title,
        plot.y.title,
        plot.x.title,
        names(plot)
    );
    html! {
        svg viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } role="img" aria-label=(label) { (drawing(plot, scales, Reader::Script)) }
    }
}
