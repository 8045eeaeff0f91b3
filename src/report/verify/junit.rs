//! `JUnit` XML, which CI servers show: one test case a channel, and one for what the kernel computes.

use super::words::{failure, failures, findings, not_declared, order, theory};
use super::{answers, deviates, identified, together};
use crate::document::Finding;
use crate::study::verify::{Conclusion, Line, Standing, Verification};
use std::fmt::Write;

/// The document. A channel that contradicts is a failure, one that failed is an error; an inconclusive or blind one is
/// skipped. Values that are not those of the declared method are a failure too.
#[must_use]
pub fn junit(verification: &Verification) -> String {
    let mut cases = String::new();
    let suite = escape(&verification.declaration.name);
    for line in &verification.lines {
        let name = escape(&line.name);
        // Writing to a String does not fail.
        let _ = writeln!(
            cases,
            "    <testcase classname=\"{suite}\" name=\"{name}\">{}</testcase>",
            body(line, verification.is_accepted(line.quantity))
        );
    }
    let deviates = deviates(verification);
    let said = identified::findings(verification).into_iter();
    let said = said.chain(together::said(verification));
    let said = said.chain(not_declared(verification));
    let said = said.chain(findings(verification, usize::MAX));
    let sentences: Vec<String> = said.map(|said| Finding::sentence(&said)).collect();
    let sentences = escape(&sentences.join("; "));
    let inside = if deviates {
        format!("<failure message=\"{sentences}\"/>")
    } else {
        format!("<system-out>{sentences}</system-out>")
    };
    let _ = writeln!(
        cases,
        "    <testcase classname=\"{suite}\" name=\"identification\">{inside}</testcase>"
    );
    let counts = verification.counts();
    let accepted = verification.lines.iter().filter(|line| {
        line.standing == Standing::Contradicted && verification.is_accepted(line.quantity)
    });
    let accepted = accepted.count();
    let contradicted = counts.contradicted - accepted;
    let nothing = verification.conclusion() != Conclusion::Confirmed
        && contradicted + counts.failed == 0
        && !deviates;
    if nothing {
        let not_shown: Vec<String> = answers::not_shown(verification)
            .map(|said| said.words)
            .collect();
        let why = if not_shown.is_empty() {
            "no order is confirmed".into()
        } else {
            escape(&not_shown.join("; "))
        };
        let _ = writeln!(
            cases,
            "    <testcase classname=\"{suite}\" name=\"conclusion\"><failure message=\"{why}\"/></testcase>"
        );
    }
    let tests = verification.lines.len() + 1 + usize::from(nothing);
    let failures = contradicted + usize::from(deviates) + usize::from(nothing);
    let skipped = counts.inconclusive + counts.unresolved + counts.blind + accepted;
    let totals = format!(
        "tests=\"{tests}\" failures=\"{failures}\" errors=\"{}\" skipped=\"{skipped}\"",
        counts.failed
    );
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {totals}>\n  <testsuite name=\"{suite}\" {totals}>\n{cases}  </testsuite>\n</testsuites>\n"
    )
}

fn body(line: &Line, is_accepted: bool) -> String {
    let found = format!(
        "{}: expected {}, measured {}",
        line.measured.verdict(),
        theory(line.expected),
        order(line)
    );
    let found = escape(&found);
    match line.standing {
        Standing::Confirmed => String::new(),
        Standing::Contradicted if is_accepted => {
            format!("<skipped message=\"accepted ({found})\"/>")
        }
        Standing::Contradicted => format!("<failure message=\"{found}\"/>"),
        Standing::Inconclusive | Standing::Unresolved | Standing::Blind => {
            format!("<skipped message=\"{} ({found})\"/>", line.standing)
        }
        Standing::Failed => {
            let errors: Vec<String> = failures(line).iter().map(failure).collect();
            format!("<error message=\"{}\"/>", escape(&errors.join("; ")))
        }
    }
}

/// Text inside XML; characters that XML has no place for become spaces.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => escaped.push(' '),
            control if control.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}
