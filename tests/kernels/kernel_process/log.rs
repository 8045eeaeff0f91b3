//! What is kept of a conversation.

use super::fixture::{Fixture, patient, segments, subject, task};
use std::fs;
use std::time::Duration;
use volver::kernel::Kernel;
use volver::kernel::process::Options;

/// The log of one request of that many segments.
fn logged(mode: &str, timeout: Duration) -> String {
    let fixture = Fixture::new();
    let (log, path) = fixture.log();
    let options = Options {
        timeout,
        log: Some(log),
        ..patient()
    };
    if let Ok(mut kernel) = fixture.start(mode, options) {
        let subject = subject("sine-squared");
        let _ = kernel.render(&task(&subject, &segments(&subject, 2)));
    }
    fs::read_to_string(path).unwrap()
}

fn long() -> Duration {
    patient().timeout
}

/// The lines of one descriptor, without its number.
fn of<'l>(log: &'l str, mark: &str) -> Vec<&'l str> {
    let lines = log.lines().filter_map(|line| line.split_once(' '));
    lines
        .filter(|(own, _)| *own == mark)
        .map(|(_, line)| line)
        .collect()
}

#[test]
fn both_directions_and_what_is_printed_are_kept() {
    let log = logged("prints", long());
    let requests = of(&log, "3");
    assert!(requests[0].starts_with(r#"{"type":"hello","protocol":1,"#));
    assert!(requests[1].starts_with(r#"{"type":"render","id":1,"tasks":[{"case":"sine-squared","#));
    assert!(requests[1].contains(r#""lambda":[0.0,0.5,1.0]"#), "{log}");
    let answers = of(&log, "4");
    assert!(answers[0].contains(r#""name": "prints""#), "{log}");
    assert!(
        answers[1].contains(r#""results": [{"radiance": [2]}]"#),
        "{log}"
    );
    assert_eq!(
        of(&log, "1"),
        [r#"{"type":"radiance","id":1,"results":[]}"#]
    );
    assert_eq!(of(&log, "2"), ["rendering"]);
    let said = of(&log, "-");
    assert!(
        said[0].starts_with("process ") && said[0].contains("python3 -S "),
        "{log}"
    );
    assert_eq!(said[1..], ["the process exited with code 0"]);
    assert_eq!(log.lines().count(), 2 + 2 + 1 + 1 + 2, "{log}");
}

#[test]
fn arrays_in_files_stand_in_the_log() {
    let log = logged("npy", long());
    assert!(
        of(&log, "3")[1].contains(r#""lambda":[0.0,0.5,1.0]"#),
        "{log}"
    );
}

#[test]
fn what_has_no_end_is_kept() {
    let log = logged("half-line", long());
    assert_eq!(of(&log, "4")[1], r#"{"type":"radiance","id":"#);
    let log = logged("exits", long());
    assert_eq!(
        of(&log, "2"),
        ["first", "second", "", "no module named torch", "giving up"]
    );
    assert_eq!(of(&log, "-")[1..], ["the process exited with code 3"]);
    let log = logged("never-answers", Duration::from_millis(300));
    assert_eq!(of(&log, "3").len(), 2, "{log}");
    assert_eq!(of(&log, "-")[1..], ["the process was killed by signal 15"]);
}

#[test]
fn a_line_that_another_came_into_goes_on_behind_it() {
    let log = logged("half-words", long());
    let behind = log.split_once("\n2 half\n4 ").unwrap().1;
    let (_, behind) = behind.split_once('\n').unwrap();
    assert!(
        behind.starts_with("2+  a word\n2 and half\n- the process"),
        "{log}"
    );
}

#[test]
fn a_log_that_cannot_be_written_is_named() {
    let full = std::path::Path::new("/dev/full");
    let fixture = Fixture::new();
    let options = Options {
        log: Some(volver::kernel::process::Log::create(full).unwrap()),
        ..patient()
    };
    let error = fixture.start("behaves", options).unwrap_err().to_string();
    assert!(
        error.starts_with("the log cannot be written: No space left"),
        "{error}"
    );
    assert!(error.ends_with("(allowed: a place with room)"), "{error}");
    fixture.assert_gone();
}
