//! Every `--out` directory has a page, and `volver report` puts several onto one.

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use volver::document::{Block, Document, Table};
use volver::render::html::read;

fn volver(dir: &Path, arguments: &[&str]) -> Command {
    let mut command = cargo_bin_cmd!("volver");
    command.args(arguments).current_dir(dir);
    command
}

/// A small study at these levels.
fn study(dir: &Path, levels: &str, out: &str) {
    let arguments = [
        "study",
        "--cases",
        "sine-squared",
        "--methods",
        "trapezoid/trapezoid",
        "--formats",
        "f64",
    ];
    volver(
        dir,
        &[
            &arguments[..],
            &["--quiet", "--levels", levels, "--out", out],
        ]
        .concat(),
    )
    .assert()
    .code(0);
}

/// Two studies, `before` and `after`.
fn studies() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    study(dir.path(), "8..64", "before");
    study(dir.path(), "8..128", "after");
    dir
}

fn page(file: &Path) -> Document {
    read(&fs::read_to_string(file).unwrap()).unwrap()
}

/// The table under this heading with this caption.
fn table<'a>(page: &'a Document, heading: &str, caption: &str) -> Option<&'a Table> {
    let sections = page
        .sections
        .iter()
        .filter(|section| section.title == heading);
    sections
        .flat_map(|section| &section.blocks)
        .find_map(|block| match block {
            Block::Table(table) if table.caption == caption => Some(table),
            _ => None,
        })
}

fn plots(page: &Document) -> usize {
    let blocks = page.sections.iter().flat_map(|section| &section.blocks);
    let plots = blocks.map(|block| match block {
        Block::Figure(figure) => figure.plots.len(),
        _ => 0,
    });
    plots.sum()
}

#[test]
fn every_report_has_a_page() {
    let dir = tempfile::tempdir().unwrap();
    let here = dir.path();
    for (arguments, kind, fact, has_plots) in [
        (
            &[
                "study",
                "--cases",
                "sine-squared",
                "--methods",
                "trapezoid/trapezoid",
                "--levels",
                "8..64",
            ][..],
            "study",
            "Confirmed",
            true,
        ),
        (
            &[
                "verify",
                "--cases",
                "sine-squared",
                "--ladder",
                "8..64",
                "method:front-to-back/middle/expm1",
            ],
            "verify",
            "the kernel is",
            true,
        ),
        (
            &["stress", "--scenarios", "depth", "--formats", "f16"],
            "stress",
            "silently wrong",
            false,
        ),
        (
            &["reproduce", "--table", "2", "--levels", "8..128"],
            "reproduce",
            "entries",
            true,
        ),
    ] {
        let (name, rest) = arguments.split_first().unwrap();
        let out = volver(here, &[&[name, "--out", kind], rest].concat())
            .output()
            .unwrap();
        assert!(out.status.code().is_some_and(|code| code <= 1), "{out:?}");
        let page = page(&here.join(kind).join("index.html"));
        assert_eq!(page.kind, kind);
        assert!(
            page.summary.iter().any(|found| found.name == fact),
            "{:?}",
            page.summary
        );
        assert_eq!(plots(&page) > 0, has_plots, "{kind}");
        let command = format!("volver {name} --out {kind} {}", rest.join(" "));
        assert_eq!(page.about.command, command);
        let count = fs::read_dir(here.join(kind)).unwrap().count();
        let said = String::from_utf8(out.stdout).unwrap();
        // The table of a verification has no count of files.
        assert!(
            kind == "verify" || said.contains(&format!("{count} files in {kind}")),
            "{said}"
        );
    }
}

#[test]
fn a_page_asks_for_nothing_and_says_nothing_of_its_maker() {
    let dir = studies();
    let text = fs::read_to_string(dir.path().join("before/index.html")).unwrap();
    let (_, policy) = text
        .split_once("http-equiv=\"Content-Security-Policy\" content=\"")
        .unwrap();
    assert!(policy.starts_with("default-src 'none'; "), "{policy}");
    for outside in ["http://", "https://", "url(", "@import", "src=\""] {
        assert!(!text.contains(outside), "{outside}");
    }
    assert!(!text.contains(&dir.path().display().to_string()));
}

#[test]
fn a_merged_page_says_what_differs_and_keeps_all() {
    let dir = studies();
    let here = dir.path();
    let out = volver(here, &["report", "before", "after"])
        .output()
        .unwrap();
    assert_eq!(out.status.code(), Some(0));
    let said = String::from_utf8(out.stdout).unwrap();
    assert!(said.starts_with("2 reports in report.html: of "), "{said}");
    let merged = page(&here.join("report.html"));
    let both = ["before", "after"].map(|name| page(&here.join(name).join("index.html")));
    assert_eq!(plots(&merged), both.iter().map(plots).sum::<usize>());
    let facts = table(&merged, "Side by side", "Each report in its own words").unwrap();
    let commands: Vec<&str> = facts.rows[1]
        .iter()
        .map(|cell| cell.text.as_str())
        .collect();
    assert_eq!(commands[0], "command");
    assert!(commands[1].ends_with("--out before") && commands[2].ends_with("--out after"));

    let heading = "sine-squared, trapezoid/trapezoid: theory 2";
    let caption = "Orders and roundoff, a row a format";
    let differing = table(&merged, "What differs", &format!("{heading}: {caption}")).unwrap();
    let order = |page: &Document| table(page, heading, caption).unwrap().rows[0][1].clone();
    let [before, after] = both.each_ref().map(order);
    let row = differing
        .rows
        .iter()
        .find(|row| row[1].text == "discretization")
        .unwrap();
    assert_eq!(
        (&row[0].text[..], &row[2].text, &row[3].text),
        ("f64", &before.text, &after.text)
    );
    let change = after.sort.unwrap() - before.sort.unwrap();
    let shown: f64 = row[4].text.replace('−', "-").parse().unwrap();
    assert!(
        (shown - change).abs() <= 0.05 * change.abs() + 5e-4,
        "{shown} {change}"
    );
    // What is the same is not listed.
    assert!(differing.rows.iter().all(|row| row[2] != row[3]));
}

#[test]
fn a_report_differs_nowhere_from_itself() {
    let dir = studies();
    study(dir.path(), "8..64", "again");
    volver(
        dir.path(),
        &["report", "before", "again", "--out", "same.html"],
    )
    .assert()
    .code(0)
    .stdout(predicates::str::ends_with(
        "0 verdicts and 0 others differ\n",
    ));
    // A page that was merged before is not merged again.
    volver(dir.path(), &["report", "before", "--out", "before"])
        .assert()
        .code(0);
    volver(dir.path(), &["report", "before", "again"])
        .assert()
        .code(0)
        .stdout(predicates::str::starts_with("2 reports "));
}

#[test]
fn bad_directories_are_named_in_one_line_and_leave_nothing() {
    let dir = studies();
    let here = dir.path();
    fs::create_dir_all(here.join("empty")).unwrap();
    for name in ["foreign", "damaged", "newer", "cut"] {
        fs::create_dir_all(here.join(name)).unwrap();
    }
    let text = fs::read_to_string(here.join("before/index.html")).unwrap();
    fs::write(
        here.join("foreign/index.html"),
        "<html><body>mine</body></html>",
    )
    .unwrap();
    fs::write(
        here.join("damaged/index.html"),
        text.replace("\"kind\":", "\"kin\":"),
    )
    .unwrap();
    fs::write(
        here.join("cut/index.html"),
        &text[..text.find("\"sections\":").unwrap()],
    )
    .unwrap();
    fs::write(
        here.join("newer/index.html"),
        text.replace("{\"schema\":2,", "{\"schema\":9,"),
    )
    .unwrap();
    for (arguments, message) in [
        (&["before", "nowhere"][..], "'nowhere': "),
        (&["before", "before/index.html"], "'before/index.html': "),
        (&["before", "empty"], "'empty': no page (allowed: "),
        (
            &["before", "foreign"],
            "'foreign/index.html': not a page of volver (allowed: ",
        ),
        (
            &["before", "damaged"],
            "'damaged/index.html': a damaged page: missing field `kind`",
        ),
        (&["before", "cut"], "'cut/index.html': a damaged page: EOF"),
        (
            &["before", "newer"],
            "'newer/index.html': a page of schema 9 (allowed: 2)",
        ),
        (
            &["before", "./before/"],
            "'./before/': the same directory as 'before' (allowed: each once)",
        ),
        (
            &["before", "--out", "before/index.html/x.html"],
            "cannot create the directory 'before/index.html': ",
        ),
    ] {
        let out = volver(here, &[&["report"], arguments].concat())
            .output()
            .unwrap();
        let said = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(2), "{said}");
        assert!(said.starts_with(&format!("volver: {message}")), "{said}");
        assert!(said.contains("(allowed: "), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(out.stdout.is_empty());
        assert!(!here.join("report.html").exists());
    }
}

#[test]
fn the_page_goes_where_it_is_asked_to() {
    let dir = studies();
    for (out, file) in [
        ("pages", "pages/report.html"),
        ("a/b.html", "a/b.html"),
        ("after", "after/report.html"),
    ] {
        volver(dir.path(), &["report", "before", "--out", out, "--quiet"])
            .assert()
            .code(0)
            .stdout("");
        assert_eq!(page(&dir.path().join(file)).kind, "comparison");
    }
    // A directory in the place of the file.
    fs::create_dir(dir.path().join("report.html")).unwrap();
    volver(dir.path(), &["report", "before"])
        .assert()
        .code(2)
        .stderr(predicates::str::starts_with(
            "volver: cannot write 'report.html': ",
        ));
}

#[test]
#[cfg(unix)]
fn the_examples_of_the_help_run() {
    let dir = studies();
    let binary = assert_cmd::cargo::cargo_bin!("volver");
    let path = format!(
        "{}:{}",
        binary.parent().unwrap().display(),
        std::env::var("PATH").unwrap()
    );
    let out = volver(dir.path(), &["report", "--help"]).output().unwrap();
    let help = String::from_utf8(out.stdout).unwrap();
    let (_, examples) = help.split_once("Examples:\n").unwrap();
    let examples: Vec<&str> = examples
        .lines()
        .map_while(|line| line.strip_prefix("  "))
        .collect();
    assert_eq!(examples.len(), 3);
    for example in examples {
        Command::new("sh")
            .args(["-c", example])
            .env("PATH", &path)
            .current_dir(dir.path())
            .assert()
            .code(0)
            .stderr("");
    }
}
