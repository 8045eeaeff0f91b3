//! A file that is filled from above.

use crate::render::plot::STYLE;
use crate::render::terminal::wrap;
use maud::{Markup, PreEscaped, html};

/// Left free at all sides, and between parts.
pub(super) const MARGIN: f64 = 14.0;
/// Of a sans-serif letter, in em; a little wide, so that estimated widths are safe.
const LETTER: f64 = 0.56;

/// What a file has beyond its plots.
const OWN: &str = "text { fill: var(--text); font: 12px sans-serif; }
.ground { fill: var(--ground); }
.caption { font-size: 15px; font-weight: bold; }
.head { font-size: 13px; font-weight: bold; }
.key { color: var(--muted); }
.map text { font-size: 10px; }
.map text.figure { font-size: 9px; text-anchor: middle; }
.map text.end { text-anchor: end; }
.map text.middle { text-anchor: middle; }
.map text.on-low { fill: var(--on-low); }
.map text.on-high { fill: var(--on-high); }
.shade { fill: var(--shade); stop-color: var(--shade); }
.none { fill: var(--sunk); }
.good { fill: var(--good-ground); }
.open { fill: var(--open-ground); }
.bad { fill: var(--bad-ground); stroke: var(--bad); }
";

/// The letters of a class, and their size.
#[derive(Clone, Copy)]
pub(super) struct Letters(pub(super) &'static str, pub(super) f64);

pub(super) const CAPTION: Letters = Letters("caption", 15.0);
pub(super) const HEAD: Letters = Letters("head", 13.0);
pub(super) const BODY: Letters = Letters("body", 12.0);

impl Letters {
    pub(super) fn line_height(self) -> f64 {
        (1.45 * self.1).ceil()
    }

    /// The width that a text takes, about: fonts are the reader's.
    pub(super) fn width(self, text: &str) -> f64 {
        text.chars().count() as f64 * self.1 * LETTER
    }

    /// The text in lines of this width.
    pub(super) fn lines(self, text: &str, width: f64) -> Vec<String> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a few hundred letters"
        )]
        let columns = (width / (LETTER * self.1)) as usize;
        let mut lines = wrap(text, columns, "", "");
        lines.retain(|line| !line.is_empty());
        lines
    }
}

/// A part at a place.
pub(super) fn at((x, y): (f64, f64), part: &Markup) -> Markup {
    html! { g transform={ "translate(" (round(x)) " " (round(y)) ")" } { (part) } }
}

/// To a hundredth of a pixel.
pub(super) fn round(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

/// What was put down so far.
pub(super) struct Sheet {
    width: f64,
    /// Where there is room.
    pub(super) y: f64,
    parts: Vec<Markup>,
}

impl Sheet {
    pub(super) fn new(width: f64) -> Self {
        Sheet {
            width,
            y: MARGIN,
            parts: Vec::new(),
        }
    }

    /// A part whose places are those of the sheet.
    pub(super) fn put(&mut self, part: Markup) {
        self.parts.push(part);
    }

    /// Words in as many lines as they need.
    pub(super) fn write(&mut self, text: &str, letters: Letters) {
        let lines = letters.lines(text, self.width - 2.0 * MARGIN);
        self.put(written(&lines, (MARGIN, self.y), letters));
        self.y += lines.len() as f64 * letters.line_height();
    }

    /// The file, so many times as large on a screen.
    pub(super) fn file(self, title: &str, scale: f64) -> String {
        let (width, height) = (self.width.ceil(), (self.y + MARGIN).ceil());
        let svg = html! {
            svg width=(round(scale * width)) height=(round(scale * height)) viewBox={ "0 0 " (width) " " (height) }
                xmlns="http://www.w3.org/2000/svg" role="img" {
                title { (title) }
                style { (PreEscaped(style())) }
                rect.ground width=(width) height=(height) {}
                @for part in &self.parts { (part) }
            }
        };
        // Lines are for those who compare files; text has no such pair of signs.
        let mut svg = svg.into_string().replace("><", ">\n<");
        svg.retain(is_xml);
        svg.push('\n');
        svg
    }
}

/// Lines of text below a place.
pub(super) fn written(lines: &[String], (x, y): (f64, f64), letters: Letters) -> Markup {
    html! {
        @for (index, line) in lines.iter().enumerate() {
            @let below = index as f64 * letters.line_height() + letters.1;
            text.(letters.0) x=(round(x)) y=(round(y + below)) { (line) }
        }
    }
}

/// The rules with the colours of the light theme in their places: not every viewer knows names of colours.
fn style() -> String {
    let (theme, rules) = STYLE.split_once('}').unwrap_or_default();
    let mut style = format!("\n{OWN}{}", rules.trim_start());
    let (_, theme) = theme.split_once('{').unwrap_or_default();
    for declaration in theme.split(';') {
        if let Some((name, value)) = declaration.split_once(':') {
            style = style.replace(&format!("var({})", name.trim()), value.trim());
        }
    }
    style
}

/// Whether XML 1.0 has the character.
fn is_xml(c: char) -> bool {
    matches!(c, '\t' | '\n' | ' '..) && !matches!(c, '\u{fffe}' | '\u{ffff}')
}
