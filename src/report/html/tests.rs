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

/// The drawing of a page with one plot.
fn drawing(plot: Plot) -> String {
    let mut page = page();
    let mut section = Section::new("s", "S");
    section.blocks.push(Block::Plot(plot));
    page.sections.push(section);
    let html = render(&page).unwrap();
    // What the page says of itself in numbers comes behind the drawing.
    let (main, _) = html.split_once("</main>").unwrap();
    main.split_once("<main>").unwrap().1.into()
}

#[test]
fn errors_below_all_numbers_have_a_place_on_logarithmic_axes() {
    let mut plot = Plot::new("deep", Axis::log("n"), Axis::log("|error|"));
    let points = [
        Point::new(1.0, -10.0, "n = 10"),
        Point::new(2.0, -400.0, "n = 100").filled(),
    ];
    plot.series.push(Series::line("total", points));
    let drawing = drawing(plot);
    assert!(drawing.contains(">10⁻⁴⁰⁰</text>"), "{drawing}");
    assert_eq!(drawing.matches("data-label=").count(), 2);
    assert!(drawing.contains("class=\"mark filled\""));
    assert!(
        !drawing.contains("NaN") && !drawing.contains("inf"),
        "{drawing}"
    );
}

#[test]
fn what_has_no_logarithm_breaks_the_line_and_has_no_mark() {
    let mut plot = Plot::new("broken", Axis::log("n"), Axis::log("|error|"));
    let points = [
        (1.0, -1.0),
        (2.0, f64::NEG_INFINITY),
        (3.0, f64::NAN),
        (4.0, -4.0),
        (5.0, -5.0),
    ];
    plot.series.push(Series::line(
        "total",
        points.map(|(x, y)| Point::new(x, y, "p")),
    ));
    let drawing = drawing(plot);
    assert_eq!(drawing.matches("data-label=").count(), 3);
    let line = drawing.split("class=\"line\" d=\"").nth(2).unwrap();
    let line = line.split('"').next().unwrap();
    assert_eq!(
        (line.matches('M').count(), line.matches('L').count()),
        (2, 1),
        "{line}"
    );
}

#[test]
fn plots_and_tables_without_anything_say_so() {
    let mut plot = Plot::new("empty", Axis::log("n"), Axis::linear("x"));
    plot.series
        .push(Series::line("nothing", [Point::new(f64::NAN, 1.0, "p")]));
    let empty = drawing(plot);
    assert!(empty.contains("Nothing to draw: nothing"), "{empty}");
    assert!(!empty.contains("<svg"), "{empty}");

    let mut page = page();
    let mut section = Section::new("s", "S");
    section.blocks.push(Block::Table(Table::new(
        "none",
        [Column::text("a"), Column::number("b")],
    )));
    section
        .blocks
        .push(Block::Table(Table::new("no columns", [])));
    page.sections.push(section);
    let html = render(&page).unwrap();
    assert!(
        html.contains("<td class=\"none\" colspan=\"2\">nothing</td>"),
        "{html}"
    );
    assert_eq!(read(&html).unwrap(), page);
}

#[test]
fn numbers_that_are_none_sort_last_and_survive() {
    let mut table = Table::new(
        "t",
        [Column::text("a"), Column::number("b"), Column::verdict("c")],
    );
    let nan = Cell {
        sort: Some(f64::NAN),
        ..Cell::text("NaN")
    };
    table.rows.push(vec![
        Cell::text("x"),
        nan,
        Cell::verdict("TooLow", Tone::Bad),
    ]);
    table
        .rows
        .push(vec![Cell::text("y"), Cell::number("1e-9", 1e-9)]);
    let mut section = Section::new("s", "S");
    section.blocks.push(Block::Table(table));
    let mut page = page();
    page.sections.push(section);
    let html = render(&page).unwrap();
    assert!(html.contains("<td class=\"number\">NaN</td>"), "{html}");
    assert!(
        html.contains("<td class=\"number\" data-sort=\"0.000000001\">1e-9</td>"),
        "{html}"
    );
    assert!(
        html.contains("<td class=\"verdict\" data-sort=\"0\">"),
        "{html}"
    );
    let back = read(&html).unwrap();
    let Block::Table(table) = &back.sections[0].blocks[0] else {
        unreachable!("a table was written");
    };
    assert_eq!(table.rows[0][1].sort, None);
    assert_eq!(read(&render(&back).unwrap()).unwrap(), back);
}

#[test]
fn pages_come_back_as_they_were() {
    let mut page = page();
    page.about.seeds = vec![u64::MAX];
    let mut plot = Plot::new("p", Axis::log("n"), Axis::linear("y"));
    let mut series = Series::marks("s", [Point::new(f64::NAN, 0.1 + 0.2, "l")]).colored(5);
    series.traces.push(Trace {
        stroke: Stroke::Dotted,
        points: vec![(1.0, f64::INFINITY), (1e-300, -0.0)],
    });
    plot.series.push(series);
    plot.guides.push(Guide {
        upright: false,
        at: f64::NAN,
        label: "n*".into(),
    });
    let mut section = Section::new("s", "S");
    section.blocks.push(Block::Plot(plot));
    page.sections.push(section);
    let html = render(&page).unwrap();
    let back = read(&html).unwrap();
    assert_eq!(back.about, page.about);
    assert_eq!(render(&back).unwrap(), html);
}

#[test]
fn other_documents_are_told_from_damaged_ones() {
    let html = render(&page()).unwrap();
    assert!(matches!(read("<html></html>"), Err(PageError::Foreign)));
    let cut = &html[..html.find("\"sections\"").unwrap()];
    assert!(matches!(read(cut), Err(PageError::Damaged(_))));
    let newer = html.replace("{\"schema\":1,", "{\"schema\":2,");
    let error = read(&newer).unwrap_err();
    assert_eq!(error.to_string(), "a page of schema 2 (allowed: 1)");
}

#[test]
fn sections_have_addresses_of_their_own() {
    let mut page = page();
    for id in ["Words!", "words-", "about", "", "words-"] {
        page.sections.push(Section::new(id, id));
    }
    let html = render(&page).unwrap();
    let ids: Vec<&str> = html
        .split("<section id=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    assert_eq!(ids, ["words-", "words--2", "about-2", "-2", "words--3"]);
}

#[test]
fn reports_of_two_kinds_share_a_directory_and_link_to_each_other() {
    let dir = tempfile::tempdir().unwrap();
    let about = || About::new(["volver"]);
    let tables = Page::new("reproduce", "Tables", about());
    let breaks = Page::new("nonsmooth", "Breaks", about());
    for _ in 0..2 {
        assert_eq!(
            place(dir.path(), &tables).unwrap(),
            dir.path().join("index.html")
        );
        assert_eq!(
            place(dir.path(), &breaks).unwrap(),
            dir.path().join("nonsmooth.html")
        );
    }
    let links = |file: &str| {
        let html = std::fs::read_to_string(dir.path().join(file)).unwrap();
        read(&html).unwrap().links
    };
    let link = |file: &str, title: &str| {
        vec![Link {
            file: file.into(),
            title: title.into(),
        }]
    };
    assert_eq!(links("index.html"), link("nonsmooth.html", "Breaks"));
    assert_eq!(links("nonsmooth.html"), link("index.html", "Tables"));
}

#[test]
fn the_index_of_another_program_stays() {
    let dir = tempfile::tempdir().unwrap();
    let index = dir.path().join("index.html");
    std::fs::write(&index, "<html>mine</html>").unwrap();
    let page = Page::new("study", "Study", About::new(["volver"]));
    assert_eq!(
        place(dir.path(), &page).unwrap(),
        dir.path().join("study.html")
    );
    assert_eq!(
        std::fs::read_to_string(&index).unwrap(),
        "<html>mine</html>"
    );
}
