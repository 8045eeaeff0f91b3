//! The document as a page.

use super::tone::{classes, sign};
use super::{blocks, embed, head};
use crate::document::{Block, Document, Medium, Section};
use crate::render::ReportError;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::collections::HashSet;

/// The page as one HTML document, which asks nothing of any network.
///
/// # Errors
/// [`ReportError::Json`], which no page is known to cause.
pub fn render(page: &Document) -> Result<String, ReportError> {
    let sections = page.shown_in(&[Medium::Written, Medium::Page]);
    let ids = ids(&sections);
    let document = html! {
        (DOCTYPE)
        html lang="en" {
            (head::head(&page.title))
            body {
                (head::top(page))
                (contents(&sections, &ids))
                @if let Some(conclusion) = &page.conclusion {
                    p class=(classes("conclusion", conclusion.tone)) { (sign(conclusion.tone)) (conclusion.words) }
                }
                main {
                    @for ((section, blocks), id) in sections.iter().zip(&ids) {
                        section id=(id) {
                            @if !section.title.is_empty() { h2 { (section.title) a.anchor href={ "#" (id) } aria-label="link to this section" { "#" } } }
                            (blocks::blocks(blocks))
                        }
                    }
                }
                (about(page))
                (PreEscaped(embed::element(page)?))
                (head::script())
            }
        }
    };
    Ok(document.into_string() + "\n")
}

/// A section with what is seen of it.
type Shown<'a> = (&'a Section, Vec<&'a Block>);

/// Safe names for sections, no two alike.
fn ids(sections: &[Shown<'_>]) -> Vec<String> {
    // What the page's own elements are called.
    let mut taken: HashSet<String> = ["volver-page", "about", "theme", "tip", "said"]
        .map(String::from)
        .into();
    let mut id = |wanted: &str| {
        let safe: String = wanted
            .chars()
            .map(|c| {
                if c.is_ascii_alphanumeric() {
                    c.to_ascii_lowercase()
                } else {
                    '-'
                }
            })
            .collect();
        let numbered = (2_u64..).map(|k| format!("{safe}-{k}"));
        let free = std::iter::once(safe.clone())
            .filter(|safe| !safe.is_empty())
            .chain(numbered)
            .find(|id| taken.insert(id.clone()));
        free.unwrap_or(safe)
    };
    sections
        .iter()
        .map(|(section, _)| id(&section.id))
        .collect()
}

/// Links to the sections that have a heading, where there are several.
fn contents(sections: &[Shown<'_>], ids: &[String]) -> Markup {
    let sections = sections.iter().zip(ids);
    let named: Vec<_> = sections.filter(|((s, _), _)| !s.title.is_empty()).collect();
    html! {
        @if named.len() > 1 {
            nav aria-label="Sections" {
                details open[named.len() <= 12] {
                    summary { (named.len()) " sections" }
                    ol {
                        @for ((section, _), id) in named {
                            li { a href={ "#" (id) } { (section.title) } }
                        }
                    }
                }
            }
        }
    }
}

fn about(page: &Document) -> Markup {
    let about = &page.about;
    let seeds: Vec<String> = about.seeds.iter().map(ToString::to_string).collect();
    html! {
        footer id="about" {
            h2 { "How this page came to be" }
            dl {
                dt { "command" } dd { code { (about.command) } }
                dt { "volver" } dd { (about.version) }
                @if !seeds.is_empty() { dt { "seed" } dd { (seeds.join(", ")) } }
                dt { "machine" } dd { (about.machine) }
            }
        }
    }
}
