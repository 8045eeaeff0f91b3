//! Journals: cut off, broken, of another study.

use super::fixture::{results, unit};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use volver::study::sweep::{Errors, Header, Journal, JournalError};

fn header() -> Header {
    results().header
}

/// A journal of the units of 11 and of 24 bits, in this order.
fn begun() -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("study.jsonl");
    let mut journal = Journal::begin(&path, &header()).unwrap();
    journal.append(unit("mpfr:11", 11)).unwrap();
    journal.append(unit("f32", 24)).unwrap();
    (directory, path)
}

fn resumed(path: &Path) -> Result<Journal, JournalError> {
    Journal::resume(path, &header())
}

/// The message; the file must stay as it is.
fn refused(path: &Path) -> String {
    let before = fs::read(path).unwrap();
    let said = resumed(path).unwrap_err().to_string();
    assert_eq!(fs::read(path).unwrap(), before);
    assert!(
        said.contains("(allowed: ") && said.lines().count() == 1,
        "{said}"
    );
    said
}

#[test]
fn units_come_back_as_they_were_and_in_the_order_of_the_header() {
    let (_directory, path) = begun();
    assert!(matches!(
        Journal::begin(&path, &header()),
        Err(JournalError::Exists { .. })
    ));
    let journal = resumed(&path).unwrap();
    assert_eq!(journal.len(), 2);
    assert!(
        journal.names().contains(&("made-up", "f32"))
            && !journal.names().contains(&("made-up", "mpfr:10"))
    );
    let ordered: Vec<_> = journal.ordered(&header()).into_iter().cloned().collect();
    assert_eq!(ordered, [unit("f32", 24), unit("mpfr:11", 11)]);
    assert_eq!(journal.finish(&header()).unwrap(), ordered);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.lines().nth(1).unwrap().contains("\"format\":\"f32\""));
    assert_eq!(text.lines().count(), 3);
    assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    assert_eq!(resumed(&path).unwrap().len(), 2);
}

#[test]
fn a_line_that_was_cut_off_is_dropped_wherever_that_was() {
    let (_directory, path) = begun();
    let whole = fs::read(&path).unwrap();
    let lines: Vec<usize> = (0..whole.len())
        .filter(|i| whole[*i] == b'\n')
        .map(|i| i + 1)
        .collect();
    // A cut anywhere in the file leaves the lines before it.
    for cut in (0..whole.len())
        .step_by(97)
        .chain(lines.iter().flat_map(|end| [end - 1, *end]))
    {
        fs::write(&path, &whole[..cut]).unwrap();
        let kept = lines.iter().filter(|end| **end <= cut).count();
        let journal = resumed(&path).unwrap();
        assert_eq!(journal.len(), kept.saturating_sub(1), "cut at {cut}");
        let left = fs::read(&path).unwrap();
        assert_eq!(left, whole[..lines[kept.max(1) - 1]], "cut at {cut}");
    }
    let mut journal = resumed(&path).unwrap();
    if !journal.names().contains(&("made-up", "f32")) {
        journal.append(unit("f32", 24)).unwrap();
    }
    assert_eq!(fs::read(&path).unwrap(), whole);
}

#[test]
fn a_line_in_the_middle_that_is_no_unit_of_the_study_is_refused_by_number() {
    let (_directory, path) = begun();
    let text = fs::read_to_string(&path).unwrap();
    for (from, to, reason) in [
        ("\"format\":\"mpfr:11\"", "\"format\":\"mpfr:11", "line 2: "),
        (
            "\"format\":\"mpfr:11\"",
            "\"format\":\"f64\"",
            "line 2: made-up in f64 is no unit of this study",
        ),
        (
            "\"format\":\"mpfr:11\"",
            "\"format\":\"f32\"",
            "line 3: made-up in f32 stands there twice",
        ),
        (
            "\"method\":\"a × b\"",
            "\"method\":\"c\"",
            "line 2: the methods are not those of this study",
        ),
        (
            "\"n\":16,",
            "\"n\":17,",
            "line 2: the levels are not those of this study",
        ),
        (
            "\"total\":\"",
            "\"total\":\"x",
            "line 2: not a decimal number",
        ),
        (
            "\"rows\":",
            "\"more\":1,\"rows\":",
            "line 2: unknown field `more`",
        ),
    ] {
        let broken = text.replacen(from, to, 1);
        assert_ne!(broken, text, "{from}");
        fs::write(&path, broken).unwrap();
        let said = refused(&path);
        assert!(said.contains(reason), "{said}");
    }
}

#[test]
fn journals_of_other_studies_and_other_files_are_left_alone() {
    let (_directory, path) = begun();
    let wanted = header();
    for (what, other) in [
        (
            "version",
            Header {
                volver: "x".into(),
                ..header()
            },
        ),
        (
            "cases",
            Header {
                cases: vec![["other", "1", "lambda", "1", "s"].map(String::from)],
                ..header()
            },
        ),
        (
            "methods",
            Header {
                methods: vec!["c".into()],
                ..header()
            },
        ),
        (
            "formats",
            Header {
                formats: vec!["f32".into()],
                ..header()
            },
        ),
        (
            "levels",
            Header {
                levels: vec![8],
                ..header()
            },
        ),
        (
            "errors",
            Header {
                errors: Errors::Total,
                ..header()
            },
        ),
    ] {
        let before = fs::read(&path).unwrap();
        let error = Journal::resume(&path, &other).unwrap_err();
        assert!(
            matches!(&error, JournalError::OtherStudy { what: w, .. } if *w == what),
            "{error}"
        );
        assert_eq!(fs::read(&path).unwrap(), before);
    }
    for text in ["my notes", "my notes\n", "{}\n", "{\"volver\""] {
        fs::write(&path, text).unwrap();
        if text.starts_with("{\"") {
            // The beginning of a header that was cut off.
            assert!(resumed(&path).unwrap().is_empty());
        } else {
            assert!(
                refused(&path).contains("is no journal of a study"),
                "{text}"
            );
        }
    }
    assert!(Journal::resume(&path, &wanted).unwrap().is_empty());
}
