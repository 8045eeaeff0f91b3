//! Entries made up for tests.

use rug::Float;
use volver::convergence::Verdict;
use volver::method::Expected;
use volver::study::reproduce::{Entry, Level, Table};

/// Order 4 from n = 16 on: |e| = n⁻⁴ over n = 8 … 256.
pub(crate) fn entry(row: &'static str, column: &'static str) -> Entry {
    Entry {
        table: Table::Exact,
        row,
        column,
        format: "mpfr:128".into(),
        paper: Some(4.8),
        protocol_order: Some(4.679_161),
        expected: Expected::Order(4.0),
        theorem: None,
        asymptotic_order: Some(4.0),
        asymptotic_half_width: Some(0.009),
        window: Some((16, 256)),
        verdict: Verdict::Confirmed,
        note: Some("pre-asymptotic window (+0.66): pairwise orders 6.00 5.53".into()),
        pairwise: vec![4.0; 5],
        levels: (3..=8)
            .map(|k| Level {
                n: 1 << k,
                error: Float::with_val(128, 1) >> (4 * k),
                bias: None,
                floor: Float::with_val(64, 1e-30),
            })
            .collect(),
        replicas: None,
    }
}

/// Order 1/2 in binary64, with a bias of a tenth of the deviation.
pub(crate) fn replicated(row: &'static str, column: &'static str) -> Entry {
    Entry {
        format: "f64".into(),
        paper: Some(0.42),
        expected: Expected::Order(0.5),
        asymptotic_order: Some(0.5),
        asymptotic_half_width: Some(0.05),
        window: Some((8, 256)),
        note: None,
        pairwise: vec![0.5; 5],
        levels: (3..=8)
            .map(|k| Level {
                n: 1 << k,
                error: Float::with_val(53, -0.5 * f64::from(k)).exp2(),
                bias: Some((-0.5 * f64::from(k)).exp2() / -10.0),
                floor: Float::with_val(53, 1e-17),
            })
            .collect(),
        replicas: Some(64),
        ..entry(row, column)
    }
}
