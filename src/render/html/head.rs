//! The top of a document: rules for the browser, the heading, what matters most.

use super::tone::{class, sign};
use crate::document::{Document, Link};
use crate::render::plot::STYLE;
use maud::{Markup, PreEscaped, html};

const PAGE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Nothing is loaded from anywhere, and nothing is sent.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; \
                      base-uri 'none'; form-action 'none'";

pub(super) fn head(title: &str) -> Markup {
    html! {
        head {
            meta charset="utf-8";
            meta http-equiv="Content-Security-Policy" content=(POLICY);
            meta name="viewport" content="width=device-width, initial-scale=1";
            meta name="color-scheme" content="light dark";
            meta name="generator" content={ "volver " (env!("CARGO_PKG_VERSION")) };
            title { (title) " · volver" }
            // Browsers ask the server for an icon otherwise.
            link rel="icon" href="data:,";
            style { (PreEscaped(STYLE)) "\n" (PreEscaped(PAGE)) }
        }
    }
}

/// Without it all is there but sorting, pointing and switching.
pub(super) fn script() -> Markup {
    html! { script { (PreEscaped(SCRIPT)) } }
}

pub(super) fn top(page: &Document) -> Markup {
    html! {
        header {
            div.bar {
                p.program { "volver " span { (page.about.version) } }
                button id="theme" type="button" hidden { "Theme: system" }
            }
            h1 { (page.title) }
            p.command { code { (page.about.command) } }
            @if !page.summary.is_empty() {
                ul.summary {
                    @for fact in &page.summary {
                        li class=[class(fact.tone)] {
                            span.value { (fact.value) }
                            span.name { (sign(fact.tone)) (fact.name) }
                        }
                    }
                }
            }
            @if page.links.iter().any(is_plain) {
                p.links {
                    "Beside this page: "
                    @for (index, link) in page.links.iter().filter(|link| is_plain(link)).enumerate() {
                        @if index > 0 { ", " }
                        a href=(link.file) { (link.title) }
                    }
                }
            }
        }
    }
}

/// A file of the same directory and nothing else: a page that was read may say anything.
fn is_plain(link: &Link) -> bool {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    link.file.strip_suffix(".html").is_some() && link.file.chars().all(is_plain)
}
