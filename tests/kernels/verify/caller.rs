//! A process that is the kernel itself, and starts volver.

use super::run::{Marked, Run, SHORT, in_repository, volver};
use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin;
use std::time::{Duration, Instant};

/// volver with `arguments`, started by the fixture with `options`, after which neither is left.
fn called(arguments: &[&str], options: &[&str]) -> Run {
    let marked = Marked::new();
    let script = in_repository("tests/kernels/verify/caller.py");
    let kernel = marked.kernel(options);
    let mut command = Command::new("python3");
    command
        .args(["-S", &script])
        .arg(cargo_bin!("volver"))
        .args(arguments)
        .arg("--")
        // Without python3, its option and the script.
        .args(&kernel[3..])
        .timeout(Duration::from_secs(300));
    let run = Run::of(command);
    marked.assert_gone();
    run
}

fn verify(options: &[&str], kernel: &[&str]) -> Run {
    called(&[&["verify"], &SHORT[..], options].concat(), kernel)
}

#[test]
fn a_caller_is_judged_as_a_child_is() {
    for (options, code) in [(&[][..], 0), (&["--drop-last"], 1)] {
        let caller = verify(&[], options).with_code(code);
        let child = Marked::new().verify(&[], options).with_code(code);
        assert_eq!(caller.out, child.out);
    }
    let run = called(&["identify", "--budget", "300"], &[]).with_code(0);
    run.shows("front to back");
}

#[test]
fn what_fails_once_is_given_up_at_once() {
    for (trouble, words) in [
        ("garbage", "no JSON object: "),
        ("half-line", "half a line in the answer '"),
        ("wrong-id", "an answer to request "),
        ("noise", "a line too long (allowed: "),
        ("closes-answers", "the kernel closed its answer pipe"),
    ] {
        // Not on the first case: what was shown of others does not count.
        let options = ["--trouble", trouble, "--case", "thick"];
        let run = verify(&[], &options).with_code(2);
        assert!(run.err.starts_with("volver: fd:"), "{}", run.err);
        assert!(run.err.contains(words), "{}", run.err);
        run.hides("confirmed");
    }
    let run = verify(&[], &["--trouble", "start-garbage"]).with_code(2);
    assert!(
        run.err.contains("no JSON object in the answer 'hello!'"),
        "{}",
        run.err
    );
}

#[test]
fn a_caller_that_hangs_is_waited_for_no_longer_than_a_child() {
    for (trouble, what) in [("hangs", "answer"), ("start-hangs", "greeting")] {
        let start = Instant::now();
        let limits = ["--timeout", "1", "--start-timeout", "1"];
        let run = verify(&limits, &["--trouble", trouble]).with_code(2);
        let words = format!(": no {what} in 1 s (allowed: up to --");
        assert!(run.err.contains(&words), "{}", run.err);
        assert!(start.elapsed() < Duration::from_secs(20));
    }
}

#[test]
fn descriptors_that_are_none_are_named() {
    for (kernel, words) in [
        ("fd:", "no descriptors (allowed: fd:READ,WRITE, "),
        ("fd:5", "no descriptors (allowed: fd:READ,WRITE, "),
        ("fd:5,5", "no descriptors (allowed: fd:READ,WRITE, "),
        ("fd:0,1", "no descriptors (allowed: fd:READ,WRITE, "),
        ("fd:-3,4", "no descriptors (allowed: fd:READ,WRITE, "),
        ("fd:3,70000", "no descriptors (allowed: fd:READ,WRITE, "),
        (
            "fd:61001,61002",
            "descriptor 61001: it is not open (allowed: an end of a pipe that the caller hands down)",
        ),
    ] {
        let run = volver(&["verify", kernel]).with_code(2);
        let said = format!("volver: {kernel}: {words}");
        assert!(run.err.starts_with(&said), "{}", run.err);
    }
    let run = volver(&["verify", "fd:5,6", "more"]).with_code(2);
    assert!(
        run.err
            .contains("'more' behind descriptors, which takes no arguments"),
        "{}",
        run.err
    );
    let binary = cargo_bin!("volver").display();
    let mut shell = Command::new("sh");
    shell.args([
        "-c",
        &format!("{binary} verify fd:7,8 7</dev/null 8>/dev/null"),
    ]);
    let run = Run::of(shell).with_code(2);
    assert!(
        run.err.contains("descriptor 7: it is no pipe"),
        "{}",
        run.err
    );
}
