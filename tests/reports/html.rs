//! From a document to a page and back.

use super::{about, document};
use volver::document::{
    About, Axis, Block, Cell, Column, Conclusion, Document, Fact, Figure, Finding, Guide, Link,
    Medium, Plot, Point, Section, Series, Stroke, Table, Tone, Trace,
};
use volver::render::html::{PageError, place, read, render};

fn page() -> Document {
    Document::new(
        "trial",
        "A <trial> & \"more\"",
        About::new(["volver", "<b>", "</script>"]),
    )
}

/// A figure of one plot.
fn figure(plot: Plot) -> Block {
    Block::Figure(Figure::new("f", "F", [plot]))
}

#[test]
fn nothing_that_a_document_says_becomes_markup() {
    let mut page = page();
    let evil = "</script><script>alert(1)</script>\"'&<!--";
    page.summary.push(Fact::new(evil, evil).toned(Tone::Bad));
    page.conclusion = Some(Conclusion::new(evil).toned(Tone::Open));
    let table = Table::new(evil, [Column::text(evil)]).named(evil);
    let mut plot = Plot::new(evil, Axis::log(evil), Axis::linear(evil));
    plot.series
        .push(Series::line(evil, [Point::new(1.0, 2.0, evil)]));
    plot.guides.push(Guide {
        upright: true,
        at: 1.0,
        label: evil.into(),
    });
    let blocks = [
        Block::Text(evil.into()),
        Block::Lines(evil.into()),
        Block::Facts(vec![Fact::new(evil, evil)]),
        Block::Finding(Finding::new(evil, evil).toned(Tone::Bad)),
        Block::Table(table.with([vec![Cell::verdict(evil, Tone::Open)]])),
        Block::Figure(Figure::new(evil, evil, [plot])),
    ];
    page.sections.push(Section::of(evil, evil, blocks));
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

#[test]
fn findings_conclusions_and_lines_are_shown_and_what_is_for_others_is_not() {
    let mut page = document([
        Block::Finding(Finding::new("defect", "words").toned(Tone::Bad)),
        Block::Finding(Finding::new("", "plain")),
        Block::Lines("a  b\n c".into()),
        Block::Text("on paper".into()).only(Medium::Written),
        Block::Text("on pages".into()).only(Medium::Page),
        Block::Text("on terminals".into()).only(Medium::Terminal),
        Block::Text("for programs".into()).only(Medium::Csv),
    ]);
    page.conclusion = Some(Conclusion::new("it is good").toned(Tone::Good));
    let html = render(&page).unwrap();
    let (shown, _) = html.split_once("</main>").unwrap();
    for part in [
        "<p class=\"finding bad\">✗ <strong>defect: </strong>words</p>",
        "<p class=\"finding\">plain</p>",
        ">a  b\n c</pre>",
        "<p>on paper</p><p>on pages</p></section>",
        "<p class=\"conclusion good\">✓ it is good</p>",
    ] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
}

#[test]
fn tables_without_anything_say_so() {
    let columns = [Column::text("a"), Column::number("b")];
    let page = document([
        Block::Table(Table::new("none", columns)),
        Block::Table(Table::new("no columns", [])),
    ]);
    let html = render(&page).unwrap();
    assert!(
        html.contains("<td class=\"none\" colspan=\"2\">nothing</td>"),
        "{html}"
    );
    assert_eq!(read(&html).unwrap(), page);
}

#[test]
fn numbers_that_are_none_sort_last_and_survive() {
    let columns = [Column::text("a"), Column::number("b"), Column::verdict("c")];
    let nan = Cell {
        sort: Some(f64::NAN),
        ..Cell::text("NaN")
    };
    let bad = Cell::verdict("TooLow", Tone::Bad);
    let table = Table::new("t", columns).with([
        vec![Cell::text("x"), nan, bad],
        vec![Cell::text("y"), Cell::number("1e-9", 1e-9)],
    ]);
    let html = render(&document([Block::Table(table)])).unwrap();
    for cell in [
        "<td class=\"number\">NaN</td>",
        "<td class=\"number\" data-sort=\"0.000000001\">1e-9</td>",
        "<td class=\"verdict\" data-sort=\"0\">",
    ] {
        assert!(html.contains(cell), "{html}");
    }
    let back = read(&html).unwrap();
    let Block::Table(table) = &back.sections[0].blocks[0] else {
        unreachable!("a table was written");
    };
    assert_eq!(table.rows[0][1].sort, None);
    assert_eq!(read(&render(&back).unwrap()).unwrap(), back);
}

#[test]
fn pages_come_back_as_they_were() {
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
    let columns = [
        Column::text("g").grouping(),
        Column::logarithm("d").detail(),
        Column::text("w").wide(7).brief(),
        Column::text("b").below(),
    ];
    let cell = Cell::text("a\nb").toned(Tone::Open).shaded(0.25);
    let table = Table::new("t", columns).named("map").at_most(3);
    let mut page = document([figure(plot), Block::Table(table.with([vec![cell]]))]);
    page.about.seeds = vec![u64::MAX];
    let aside = Section::of("i", "I", [Block::Lines("l\n".into())]).aside();
    page.sections.push(aside);
    let html = render(&page).unwrap();
    let back = read(&html).unwrap();
    assert_eq!(back.about, page.about);
    assert_eq!(back.sections[0].blocks[1], page.sections[0].blocks[1]);
    assert_eq!(back.sections[1], page.sections[1]);
    assert_eq!(render(&back).unwrap(), html);
}

#[test]
fn other_documents_are_told_from_damaged_ones() {
    let html = render(&page()).unwrap();
    assert!(matches!(read("<html></html>"), Err(PageError::Foreign)));
    let cut = &html[..html.find("\"sections\"").unwrap()];
    assert!(matches!(read(cut), Err(PageError::Damaged(_))));
    let newer = html.replace("{\"schema\":2,", "{\"schema\":3,");
    let error = read(&newer).unwrap_err();
    assert_eq!(error.to_string(), "a page of schema 3 (allowed: 2)");
}

#[test]
fn sections_have_addresses_of_their_own_and_a_heading_where_they_have_a_title() {
    let mut page = page();
    for id in ["Words!", "words-", "about", "", "words-"] {
        let block = Block::Text("words".into());
        page.sections.push(Section::of(id, id, [block]));
    }
    let html = render(&page).unwrap();
    let ids: Vec<&str> = html
        .split("<section id=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    assert_eq!(ids, ["words-", "words--2", "about-2", "-2", "words--3"]);
    // One heading is the footer's.
    assert_eq!(html.matches("<h2>").count(), 5);
    assert!(html.contains("<summary>4 sections</summary>"));
}

#[test]
fn reports_of_two_kinds_share_a_directory_and_link_to_each_other() {
    let dir = tempfile::tempdir().unwrap();
    let tables = Document::new("reproduce", "Tables", about());
    let breaks = Document::new("nonsmooth", "Breaks", about());
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
    let page = Document::new("study", "Study", about());
    assert_eq!(
        place(dir.path(), &page).unwrap(),
        dir.path().join("study.html")
    );
    assert_eq!(
        std::fs::read_to_string(&index).unwrap(),
        "<html>mine</html>"
    );
}

#[test]
fn a_command_can_be_pasted_into_a_shell() {
    let said = |arguments: &[&str]| About::new(arguments).command;
    assert_eq!(
        said(&["/opt/x y/volver", "study", "--cases", "it's $HOME", ""]),
        r"volver study --cases 'it'\''s $HOME' ''"
    );
    assert_eq!(
        said(&["volver", "front-to-back/middle/expm1@f32", "a;b"]),
        "volver front-to-back/middle/expm1@f32 'a;b'"
    );
}

#[test]
fn the_machine_is_named_without_its_owner() {
    let machine = about().machine;
    let parts: Vec<&str> = machine.split(", ").collect();
    assert_eq!(parts[1], std::env::consts::ARCH);
    assert!(parts.last().unwrap().contains("core"), "{machine}");
    // The processor has the name that the system gives.
    let told = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let named = told.lines().find(|line| line.starts_with("model name\t"));
    if let Some((_, name)) = named.and_then(|line| line.split_once(':')) {
        let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(machine.contains(&format!(", {name}, ")), "{machine}");
    }
}
