//! From a page to a document and back.

use super::*;

fn page() -> Page {
    Page::new(
        "trial",
        "A <trial> & \"more\"",
        About::new(["volver", "<b>", "</script>"]),
    )
}

#[test]
fn nothing_that_a_page_says_becomes_markup() {
    let mut page = page();
    let evil = "</script><script>alert(1)</script>\"'&<!--";
    page.summary.push(Fact::new(evil, evil).toned(Tone::Bad));
    let mut section = Section::new(evil, evil);
    section.blocks.push(Block::Text(evil.into()));
    section
        .blocks
        .push(Block::Facts(vec![Fact::new(evil, evil)]));
    let mut table = Table::new(evil, [Column::text(evil)]);
    table.rows.push(vec![Cell::verdict(evil, Tone::Open)]);
    section.blocks.push(Block::Table(table));
    let mut plot = Plot::new(evil, Axis::log(evil), Axis::linear(evil));
    plot.series
        .push(Series::line(evil, [Point::new(1.0, 2.0, evil)]));
    plot.guides.push(Guide {
        upright: true,
        at: 1.0,
        label: evil.into(),
    });
    section.blocks.push(Block::Plot(plot));
    page.sections.push(section);
    let html = render(&page).unwrap();
    assert!(!html.contains("<script>alert"), "{html}");
    assert!(!html.contains("<!--\""), "{html}");
    // The embedded page and the program.
    assert_eq!(html.matches("<script").count(), 2);
    assert_eq!(html.matches("</script>").count(), 2);
    assert_eq!(read(&html).unwrap(), page);
}

#[test]
fn links_lead_to_files_beside_the_page_and_nowhere_else() {
    let mut page = page();
    for file in [
        "javascript:alert(1)//.html",
        "../up.html",
        "https://a.b/c.html",
        "x.svg",
        "nonsmooth.html",
    ] {
        page.links.push(Link {
            file: file.into(),
            title: "t".into(),
        });
    }
    let html = render(&page).unwrap();
    let targets: Vec<&str> = html
        .split("href=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .filter(|target| !target.starts_with('#'))
        .collect();
    assert_eq!(targets, ["data:,", "nonsmooth.html"]);
}
