//! The paper's tables as a document.

use super::entries::{entry, replicated};
use super::markdown::is_regular;
use super::{about, without_color};
use volver::convergence::Verdict;
use volver::document::Document;
use volver::method::Theorem;
use volver::render::{latex, markdown, terminal};
use volver::report::reproduce::{Group, document, groups, json};
use volver::study::reproduce::{Entry, Settings};

fn report(entries: &[Entry]) -> Document {
    document(&Settings::default(), entries, &about())
}

fn text(entries: &[Entry]) -> String {
    terminal(&report(entries), 80, false)
}

/// Two entries that pass, and one with replicas that stalled.
fn entries() -> Vec<Entry> {
    let mut stalled = replicated("monte-carlo", "boole");
    stalled.verdict = Verdict::Stalled;
    stalled.note = Some("a|b *c*\n<d>".into());
    let passed = [entry("simpson", "trapezoid"), entry("simpson", "boole")];
    passed.into_iter().chain([stalled]).collect()
}

#[test]
fn an_entry_shows_paper_protocol_order_and_verdict() {
    let text = text(&entries()[1..]);
    for part in [
        "inner: simpson\n  boole   4.80      4.68  4.000 ± 0.009  16 … 256  Confirmed\n",
        "inner: monte-carlo (64 replicas in f64)\n  boole   0.42      4.68  0.500 ± 0.050   8 … 256  Stalled\n",
        "\n* simpson × boole: pre-asymptotic window (+0.66)",
        "\nStalled (1)    the error stays",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(!text.contains("Diverged"));
    assert!(text.ends_with("\n2 entries: 1 Confirmed, 1 Stalled\n"));
    assert!(!text.contains('\u{1b}'));
}

#[test]
fn figures_that_are_missing_are_dashes() {
    let row = |e: Entry| {
        let text = text(&[e]);
        let row = text
            .lines()
            .find(|line| line.starts_with("  boole "))
            .unwrap();
        row.split("  ")
            .filter(|s| !s.is_empty())
            .map(|s| s.trim().to_string())
            .collect::<Vec<_>>()
    };
    let e = || entry("simpson", "boole");
    assert_eq!(
        row(e()),
        [
            "boole",
            "4.80",
            "4.68",
            "4.000 ± 0.009",
            "16 … 256",
            "Confirmed"
        ]
    );
    let narrow = Entry {
        asymptotic_half_width: Some(0.00022),
        ..e()
    };
    assert_eq!(row(narrow)[3], "4.0000 ± 0.0002");
    let bare = Entry {
        asymptotic_half_width: None,
        ..e()
    };
    assert_eq!(row(bare)[3], "4.000");
    let none = Entry {
        paper: None,
        protocol_order: None,
        asymptotic_order: None,
        window: None,
        ..e()
    };
    assert_eq!(row(none)[1..5], ["-"; 4]);
}

#[test]
fn conclusions_count_verdicts() {
    let mut entries = vec![entry("a", "b"); 3];
    entries[0].verdict = Verdict::Stalled;
    let said = |entries: &[Entry]| report(entries).conclusion.unwrap().words;
    assert_eq!(said(&entries), "3 entries: 2 Confirmed, 1 Stalled");
    assert_eq!(said(&entries[..1]), "1 entry: 1 Stalled");
    assert_eq!(terminal(&report(&[]), 0, true), "0 entries\n");
}

#[test]
fn color_adds_escapes_and_nothing_else() {
    let report = report(&entries());
    let colored = terminal(&report, 80, true);
    assert!(colored.contains("\u{1b}[32mConfirmed\u{1b}[0m"));
    assert!(colored.contains("\u{1b}[31mStalled\u{1b}[0m"));
    assert_eq!(without_color(&colored), terminal(&report, 80, false));
}

#[test]
fn lines_fit_80_columns() {
    let mut long = entry("monte-carlo-independent", "trapezoid");
    long.note = Some("pairwise orders 6.00 5.53 4.97 ".repeat(9));
    long.verdict = Verdict::PreAsymptotic;
    long.window = Some((1024, 65536));
    let text = text(&[long]);
    assert!(text.lines().all(|l| l.chars().count() <= 80), "{text}");
}

#[test]
fn entries_stand_with_their_theorem_and_the_rest_last() {
    let of = |row, theorem| Entry {
        theorem,
        note: None,
        ..entry(row, "boole")
    };
    let [riemann, .., nested, _, _, _] = Theorem::ALL;
    let other_order = Theorem { order: 6, ..nested };
    let text = markdown(&report(&[
        of("monte-carlo", None),
        of("riemann", Some(riemann)),
        of("a", Some(nested)),
        of("b", Some(other_order)),
        of("c", Some(nested)),
        of("d", Some(nested)),
    ]));
    let (_, proofs) = text
        .split_once("Proofs of the orders expected:\n\n")
        .unwrap();
    let proofs = proofs.replace("\\_", "_");
    let expected = format!(
        "- **{riemann}**: riemann × boole\n- **{nested}**: 4 entries\n- **no theorem**: monte-carlo × boole\n\n"
    );
    assert!(proofs.starts_with(&expected), "{proofs}");
}

#[test]
fn the_run_is_stated() {
    let text = markdown(&report(&entries()));
    for line in [
        concat!("- **volver**: ", env!("CARGO_PKG_VERSION")),
        "- **tables**: 1, 2",
        "- **formats**: mpfr:128",
        "- **levels n**: 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096",
        "- **seed**: 1",
        "- **replicas of Monte Carlo**: 64",
        "**3 entries: 2 Confirmed, 1 Stalled**",
    ] {
        assert!(text.lines().any(|l| l == line), "{line}\n{text}");
    }
}

#[test]
fn the_matrix_has_a_cell_a_column_even_where_an_entry_is_missing() {
    let text = markdown(&report(&entries()));
    let rows = "\
| inner \\\\ outer | trapezoid | boole |
|---|--:|--:|
| simpson | 4.000 ± 0.009<br>paper 4.80 | 4.000 ± 0.009<br>paper 4.80 |
| monte-carlo |  | 0.500 ± 0.050<br>paper 0.42<br>Stalled |
";
    assert!(text.contains(rows), "{text}");
    is_regular(&text);
}

#[test]
fn entries_and_notes_are_listed_and_escaped() {
    let text = markdown(&report(&entries()));
    for part in [
        "| simpson | boole | 4.80 | 4.68 | 4.000 ± 0.009 | 16 … 256 | Confirmed |\n",
        "| monte-carlo (64 replicas in f64) | boole | 0.42 |",
        "- **monte-carlo × boole**: a\\|b \\*c\\* \\<d\\>\n",
        "](table-1-exact.svg)\n",
        "- **Confirmed (2)**: the order expected",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(!text.contains("Diverged"));
    assert!(latex(&report(&entries())).contains(" & boole & 4.80 & 4.68 & 4.000 $\\pm$ 0.009"));
}

fn names(groups: &[Group<'_>]) -> Vec<(String, Vec<&'static str>)> {
    groups
        .iter()
        .map(|g| (g.file_stem(), g.rows.iter().map(|r| r.name).collect()))
        .collect()
}

#[test]
fn replicas_stand_with_the_only_format_of_their_table() {
    let entries = [
        entry("simpson", "boole"),
        replicated("monte-carlo", "boole"),
    ];
    let found = groups(&entries);
    assert_eq!(
        names(&found),
        [("table-1-exact".to_string(), vec!["simpson", "monte-carlo"])]
    );
    assert_eq!(found[0].format, "mpfr:128");
}

#[test]
fn replicas_stand_with_binary64_where_it_was_asked_for() {
    let mut entries = vec![
        replicated("monte-carlo", "boole"),
        entry("simpson", "boole"),
        entry("simpson", "boole"),
        entry("gauss-3", "boole"),
    ];
    entries[2].format = "f64".into();
    entries[3].format = "f64".into();
    let found = groups(&entries);
    assert_eq!(
        names(&found),
        [
            ("table-1-exact-mpfr-128".to_string(), vec!["simpson"]),
            (
                "table-1-exact-f64".to_string(),
                vec!["simpson", "gauss-3", "monte-carlo"]
            ),
        ]
    );
}

#[test]
fn replicas_alone_make_a_group() {
    let entries = [replicated("monte-carlo", "boole")];
    assert_eq!(
        groups(&entries)[0].title(),
        "Table 1, top: nested rules, exact exponential (f64)"
    );
    assert!(groups(&[]).is_empty());
}

#[test]
fn rows_and_columns_keep_their_order() {
    let entries = [
        entry("simpson", "trapezoid"),
        entry("simpson", "boole"),
        entry("gauss-3", "boole"),
    ];
    let found = groups(&entries);
    assert_eq!(found[0].columns(), ["trapezoid", "boole"]);
    let rows: Vec<usize> = found[0].rows.iter().map(|r| r.entries.len()).collect();
    assert_eq!(rows, [2, 1]);
}

#[test]
fn json_has_version_settings_and_entries() {
    let entries = [
        entry("simpson", "boole"),
        replicated("monte-carlo", "boole"),
    ];
    let text = json(&Settings::default(), &entries).unwrap();
    assert!(text.ends_with("}\n"));
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["volver"], env!("CARGO_PKG_VERSION"));
    assert_eq!(json["settings"]["tables"][1], "2");
    assert_eq!(json["settings"]["formats"][0], "mpfr:128");
    assert_eq!(json["settings"]["ladder"][9], 4096);
    assert_eq!(json["settings"]["seed"], 1);
    assert_eq!(json["settings"]["replicas"], 64);
    assert_eq!(json["entries"].as_array().unwrap().len(), 2);
    assert_eq!(json["entries"][0]["table"], "1-exact");
    assert_eq!(json["entries"][0]["inner"], "simpson");
    assert_eq!(json["entries"][0]["levels"][0]["n"], 8);
}

#[test]
fn numbers_that_are_none_do_not_break_json() {
    let mut broken = entry("simpson", "boole");
    broken.asymptotic_order = Some(f64::NAN);
    broken.levels[0].error = rug::Float::with_val(53, rug::float::Special::Nan);
    let text = json(&Settings::default(), &[broken]).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert!(json["entries"][0]["asymptotic_order"].is_null());
    assert_eq!(json["entries"][0]["levels"][0]["error"], "NaN");
}
