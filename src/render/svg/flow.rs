//! Samples with their names, in lines that wrap.

use super::sheet::{BODY, at, round};
use crate::render::plot::{Entry, SAMPLE};
use maud::{Markup, html};

const LINE: f64 = 18.0;
/// Between a sample and its name.
const GAP: f64 = 4.0;
/// Between a name and the next sample.
const BETWEEN: f64 = 10.0;

/// Entries in their places below a place, and the height that they take.
pub(super) fn flow(entries: &[Entry], (left, top): (f64, f64), width: f64) -> (Markup, f64) {
    let (mut x, mut y) = (0.0, 0.0);
    let mut places = Vec::new();
    for entry in entries {
        let own = SAMPLE.0 + GAP + BODY.width(&entry.words);
        if x > 0.0 && x + own > width {
            (x, y) = (0.0, y + LINE);
        }
        places.push((left + x, top + y));
        x += own + BETWEEN;
    }
    let drawn = html! {
        @for (entry, place) in entries.iter().zip(places) {
            g.(entry.class) {
                (at((place.0, place.1 + 2.0), &entry.sample))
                text x=(round(place.0 + SAMPLE.0 + GAP)) y=(round(place.1 + 13.0)) { (entry.words) }
            }
        }
    };
    (drawn, if entries.is_empty() { 0.0 } else { y + LINE })
}
