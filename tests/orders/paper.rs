//! The paper's tables come out as the paper, its protocol and theory say.
//!
//! Figures called "independent" were measured with numpy and mpmath scripts that share no code with
//! this crate.

use std::sync::LazyLock;
use volver::convergence::Verdict;
use volver::method::Expected;
use volver::study::Silent;
use volver::study::reproduce::{Entry, Settings, Table, reproduce};

static ENTRIES: LazyLock<Vec<Entry>> =
    LazyLock::new(|| reproduce(&Settings::default(), &Silent).unwrap());

const DETERMINISTIC: [&str; 4] = ["riemann", "trapezoid", "simpson", "gauss-3"];
const OUTER: [&str; 4] = ["riemann", "trapezoid", "simpson", "boole"];

fn entry(table: Table, row: &str, column: &str) -> &'static Entry {
    ENTRIES
        .iter()
        .find(|e| e.table == table && e.row == row && e.column == column)
        .unwrap_or_else(|| panic!("no entry {row} × {column}"))
}

/// The deterministic entries of one half of Table 1.
fn nested(table: Table) -> impl Iterator<Item = &'static Entry> {
    DETERMINISTIC
        .into_iter()
        .flat_map(move |row| OUTER.map(|column| entry(table, row, column)))
}

fn distance_from_paper(entry: &Entry) -> f64 {
    (entry.protocol_order.unwrap() - entry.paper.unwrap()).abs()
}

fn asymptotic(entry: &Entry) -> (f64, f64) {
    (
        entry.asymptotic_order.unwrap(),
        entry.asymptotic_half_width.unwrap(),
    )
}

#[test]
fn the_protocol_gives_all_16_deterministic_entries_of_the_bottom_table() {
    for entry in nested(Table::Linear) {
        let distance = distance_from_paper(entry);
        assert!(
            distance <= 0.03,
            "{} × {}: {distance}",
            entry.row,
            entry.column
        );
    }
}

#[test]
fn the_protocol_gives_14_of_16_entries_of_the_top_table_and_the_others_are_explained() {
    let off: Vec<&Entry> = nested(Table::Exact)
        .filter(|entry| distance_from_paper(entry) > 0.03)
        .collect();
    let names: Vec<_> = off.iter().map(|e| (e.row, e.column)).collect();
    assert_eq!(names, [("simpson", "boole"), ("gauss-3", "boole")]);

    let simpson = entry(Table::Exact, "simpson", "boole");
    let note = simpson.note.as_deref().unwrap();
    assert!(note.starts_with("pre-asymptotic window"), "{note}");
    let gauss = entry(Table::Exact, "gauss-3", "boole");
    let note = gauss.note.as_deref().unwrap();
    assert!(note.starts_with("roundoff floor"), "{note}");
}

#[test]
fn asymptotic_orders_of_table_1_are_min_p_q_and_the_exponentials() {
    let inner = [1.0, 2.0, 4.0, 6.0];
    let outer = [1.0, 2.0, 4.0, 6.0];
    for (row, p) in DETERMINISTIC.into_iter().zip(inner) {
        for (column, q) in OUTER.into_iter().zip(outer) {
            let exact = entry(Table::Exact, row, column);
            let linear = entry(Table::Linear, row, column);
            for (entry, theory) in [(exact, f64::min(p, q)), (linear, 1.0)] {
                let (order, half_width) = asymptotic(entry);
                let name = format!("{:?} {row} × {column}: {order} ± {half_width}", entry.table);
                assert!((order - theory).abs() <= 0.01, "{name}");
                assert!((order - theory).abs() <= half_width, "{name}");
                assert_eq!(entry.verdict, Verdict::Confirmed, "{name}");
                assert_eq!(entry.expected, Expected::Order(theory), "{name}");
            }
        }
    }
    let cubic = entry(Table::Cubic, "trapezoid", "trapezoid");
    assert!((asymptotic(cubic).0 - 2.0).abs() <= 0.01);
    assert!(distance_from_paper(cubic) <= 0.005);
}

fn assert_pairwise(entry: &Entry, independent: &[f64]) {
    for (measured, expected) in entry.pairwise.iter().zip(independent) {
        assert!(
            (measured - expected).abs() <= 0.0051,
            "{} × {}: {:?}",
            entry.row,
            entry.column,
            entry.pairwise
        );
    }
    assert!(entry.pairwise.len() >= independent.len());
}

#[test]
fn pairwise_orders_are_the_independent_ones() {
    assert_pairwise(
        entry(Table::Exact, "simpson", "boole"),
        &[6.00, 5.53, 4.97, 4.40, 4.12, 4.03, 4.01, 4.00],
    );
    assert_pairwise(
        entry(Table::Exact, "gauss-3", "boole"),
        &[6.14, 5.96, 5.99, 6.00, 6.00],
    );
    assert_pairwise(
        entry(Table::Preintegrated, "quadratic-10", "quadratic"),
        &[3.18, 3.78, 3.77, 0.29, 1.56, 1.82, 1.92, 1.96],
    );
    assert_pairwise(
        entry(Table::Preintegrated, "quadratic-100", "quadratic"),
        &[2.89, 2.95, 2.98, 3.00, 3.03, 3.07, 3.16],
    );
}

#[test]
fn table_2_has_its_orders_its_degenerate_entry_and_its_transitions() {
    let at = |row, column| entry(Table::Preintegrated, row, column);
    for (row, column, order) in [
        ("linear", "linear", 2.0),
        ("quadratic-100", "linear", 2.0),
        ("quadratic-10", "linear", 2.0),
        ("no-attenuation", "linear", 1.0),
        ("no-attenuation", "quadratic", 1.0),
    ] {
        let entry = at(row, column);
        assert_eq!(entry.verdict, Verdict::Confirmed, "{row} × {column}");
        assert!((asymptotic(entry).0 - order).abs() <= 0.01);
        assert!(distance_from_paper(entry) <= 0.01, "{row} × {column}");
    }
    let blind = at("linear", "quadratic");
    assert_eq!(blind.verdict, Verdict::Blind);
    assert!((asymptotic(blind).0 - 3.0).abs() <= 0.01);
    assert!(
        blind
            .note
            .as_deref()
            .unwrap()
            .starts_with("degenerate case")
    );
    // With ten sub-intervals the transition is over, and pairwise orders settle: 1.82, 1.92, 1.96, 1.98.
    for (row, verdict) in [
        ("quadratic-100", Verdict::PreAsymptotic),
        ("quadratic-10", Verdict::Confirmed),
    ] {
        let entry = at(row, "quadratic");
        assert_eq!(entry.verdict, verdict, "{row}");
        let note = entry.note.as_deref().unwrap();
        assert!(
            note.starts_with("transition to the sub-integration's order 2"),
            "{note}"
        );
    }
}

/// The crossover n that a note gives.
fn crossover(row: &str) -> f64 {
    let note = entry(Table::Preintegrated, row, "quadratic")
        .note
        .as_deref();
    let (_, n) = note.unwrap().rsplit_once("crossover near n = ").unwrap();
    n.parse().unwrap()
}

#[test]
fn crossovers_lie_where_the_error_changes_sign_and_grow_like_the_square_of_n() {
    // Both terms of a·d³ + b·d² are equal where the error is 0, between the levels of other sign.
    let levels = &entry(Table::Preintegrated, "quadratic-10", "quadratic").levels;
    let change = levels
        .windows(2)
        .find(|pair| pair[0].error.is_sign_negative() != pair[1].error.is_sign_negative())
        .unwrap();
    let ten = crossover("quadratic-10");
    assert!(
        (change[0].n as f64..=change[1].n as f64).contains(&ten),
        "{ten}"
    );
    // The sub-integration's error is d²/N²: ten times the sub-intervals, a hundred times the n.
    let ratio = crossover("quadratic-100") / ten;
    assert!((80.0..=125.0).contains(&ratio), "{ratio}");
}

#[test]
fn monte_carlo_scatter_has_orders_one_half_one_and_three_halves() {
    for (row, order) in [
        ("monte-carlo", 0.5),
        ("monte-carlo-independent", 1.0),
        ("monte-carlo-stratified", 1.5),
    ] {
        for column in ["trapezoid", "simpson", "boole"] {
            let entry = entry(Table::Exact, row, column);
            let (measured, half_width) = asymptotic(entry);
            let name = format!("{row} × {column}: {measured} ± {half_width}");
            assert!((measured - order).abs() <= half_width, "{name}");
            assert!(half_width < 0.1, "{name}");
            assert_eq!(entry.verdict, Verdict::Confirmed, "{name}");
            assert_eq!(entry.replicas, Some(64));
        }
    }
}

#[test]
fn linearising_the_whole_depth_does_not_converge() {
    for column in OUTER {
        let entry = entry(Table::Linear, "monte-carlo", column);
        assert_eq!(entry.verdict, Verdict::Stalled, "{column}");
        assert!(entry.asymptotic_order.unwrap().abs() < 0.1, "{column}");
        let note = entry.note.as_deref().unwrap();
        assert!(note.starts_with("unconverging linearisation"), "{note}");
        // What is left is ∫ C τ (1 − t − e^(−t)), by mpmath: −0.00702675.
        let bias = entry.levels.last().unwrap().bias.unwrap();
        assert!((bias + 0.007_026_75).abs() < 3.0e-4, "{bias}");
    }
}

#[test]
fn every_difference_from_the_paper_has_its_line() {
    for entry in ENTRIES.iter().filter(|e| e.paper.is_some()) {
        let (order, half_width) = asymptotic(entry);
        let differs = (entry.paper.unwrap() - order).abs() > 0.005 + half_width;
        if differs || entry.verdict != Verdict::Confirmed {
            assert!(entry.note.is_some(), "{} × {}", entry.row, entry.column);
        }
    }
}

#[test]
fn nothing_contradicts_theory() {
    assert!(!ENTRIES.iter().any(Entry::contradicts_theory));
}

#[test]
fn fitted_orders() {
    let lines: Vec<String> = ENTRIES
        .iter()
        .map(|e| {
            format!(
                "{:?} {} × {}: {} protocol {:.2} order {:.2} window {:?} {}",
                e.table,
                e.row,
                e.column,
                e.paper
                    .map_or("no figure".into(), |p| format!("paper {p:.2}")),
                e.protocol_order.unwrap(),
                e.asymptotic_order.unwrap(),
                e.window,
                e.verdict,
            )
        })
        .collect();
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("paper_fitted_orders", lines.join("\n")));
}
