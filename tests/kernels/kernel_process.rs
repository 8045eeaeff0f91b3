//! Whatever a kernel in a process of its own does, volver names it, goes on, and leaves no process behind.

mod clients;
mod fixture;
mod frames;
mod log;
mod messages;
mod stop;

use fixture::{Fixture, hasty, patient, segments, subject, task};
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};
use volver::kernel::process::{Options, ProcessKernel};
use volver::kernel::{Cut, Data, FormKind, Kernel, KernelError, Rendering, Task};

/// The radiance that `task` with so many segments gets from a fixture that behaves.
fn radiance(result: Result<Rendering, KernelError>) -> f64 {
    result.unwrap().radiance[0].to_f64()
}

fn error_of_start(mode: &str) -> String {
    let fixture = Fixture::new();
    let error = fixture.start(mode, patient()).unwrap_err();
    fixture.assert_gone();
    error.to_string()
}

/// What comes of one request, and then of another.
fn two_requests(mode: &str) -> [Result<Rendering, KernelError>; 2] {
    let fixture = Fixture::new();
    let mut kernel = fixture.start(mode, patient()).unwrap();
    let subject = subject("sine-squared");
    let results = [8, 16].map(|n| kernel.render(&task(&subject, &segments(&subject, n))));
    if kernel.id().is_none() {
        fixture.assert_gone();
    }
    drop(kernel);
    fixture.assert_gone();
    results
}

#[test]
fn a_kernel_that_behaves_is_asked_again_and_again() {
    let fixture = Fixture::new();
    let mut kernel = fixture.start("behaves", patient()).unwrap();
    assert_eq!(kernel.declaration().name, "behaves");
    let subject = subject("rgb-transfer");
    let cuts = [4, 8, 16].map(|n| segments(&subject, n));
    for cut in &cuts {
        let rendering = kernel.render(&task(&subject, cut)).unwrap();
        assert_eq!(rendering.radiance.len(), 3);
        assert_eq!(rendering.radiance[2], cut.count());
    }
    let tasks: Vec<Task<'_>> = cuts.iter().map(|cut| task(&subject, cut)).collect();
    let all = kernel.render_all(&tasks);
    let all: Vec<f64> = all.into_iter().map(radiance).collect();
    assert_eq!(all, [4.0, 8.0, 16.0]);
    assert!(kernel.render_all(&[]).is_empty());
    assert_eq!(fixture.starts(), 1);
    // Idle kernels end by themselves when no more is asked: they need not be told to.
    let start = Instant::now();
    drop(kernel);
    assert!(start.elapsed() < Duration::from_secs(2));
    fixture.assert_gone();
}

#[test]
fn what_cannot_be_run_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("kernel");
    fs::write(&file, "no program").unwrap();
    for file in [file.as_path(), directory.path()] {
        let program = file.to_str().unwrap();
        let error = ProcessKernel::start(program, &[], Options::default()).unwrap_err();
        assert!(matches!(error, KernelError::Start { .. }), "{error:?}");
        let said = error.to_string();
        assert!(said.contains("denied") && said.contains(program), "{said}");
    }
    let error = ProcessKernel::start("no-such-program", &[], Options::default()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "'no-such-program' does not start: No such file or directory (os error 2) (allowed: a program that can be run)"
    );
}

#[test]
fn a_start_that_fails_shows_how_and_the_last_lines() {
    assert_eq!(
        error_of_start("exits"),
        "the kernel exited with code 3; its standard error ends: second | no module named torch | giving up"
    );
    assert_eq!(error_of_start("dies"), "the kernel was killed by signal 9");
    let said = error_of_start("noisy-start");
    assert!(
        said.starts_with("a line too long (allowed: up to 1048576 bytes) in the answer 'xxx"),
        "{said}"
    );
    let said = error_of_start("half-greeting");
    assert!(said.starts_with("half a line in the answer '{"), "{said}");
    for (mode, words) in [
        ("unknown-key", "unknown key 'metod' (allowed: 'type', "),
        ("version-3", "protocol 3 (allowed: 1, 2)"),
        ("no-name", "missing key 'name'"),
        (
            "function",
            "unknown variant 'function' (allowed: 'segments', 'volume', 'formula')",
        ),
    ] {
        let said = error_of_start(mode);
        let words = format!("the kernel's greeting: {words}");
        assert!(said.starts_with(&words), "{said}");
    }
}

#[test]
fn a_kernel_that_never_greets_is_ended_in_time_with_all_its_descendants() {
    for mode in ["never-greets", "greets-on-stdout"] {
        let fixture = Fixture::new();
        let options = hasty();
        let start = Instant::now();
        let error = fixture.start(mode, options.clone()).unwrap_err();
        let what = "greeting";
        let after = options.start_timeout;
        assert!(
            matches!(&error, KernelError::TimedOut { what: w, after: a, .. } if *w == what && *a == after),
            "{error:?}"
        );
        assert!(start.elapsed() < Duration::from_secs(5));
        fixture.assert_gone();
    }
}

#[test]
fn a_slow_start_has_a_time_of_its_own() {
    let fixture = Fixture::new();
    // As good as none.
    let start_timeout = Duration::MAX;
    let timeout = Duration::from_secs(1);
    let options = Options {
        start_timeout,
        timeout,
        ..Options::default()
    };
    let mut kernel = fixture.start("slow-start", options).unwrap();
    let subject = subject("homogeneous");
    assert_eq!(
        radiance(kernel.render(&task(&subject, &segments(&subject, 8)))),
        8.0
    );
    drop(kernel);
    let error = fixture.start("slow-start", hasty()).unwrap_err();
    assert!(matches!(error, KernelError::TimedOut { .. }), "{error:?}");
    fixture.assert_gone();
}

#[test]
#[ignore = "half a minute of waiting"]
fn a_start_of_half_a_minute_is_no_trouble() {
    let fixture = Fixture::new();
    let mut kernel = fixture
        .start("very-slow-start", Options::default())
        .unwrap();
    let subject = subject("homogeneous");
    assert_eq!(
        radiance(kernel.render(&task(&subject, &segments(&subject, 8)))),
        8.0
    );
}

#[test]
fn a_kernel_that_is_refused_is_told_before_it_is_killed() {
    let fixture = Fixture::new();
    let mut kernel = fixture.start("told", patient()).unwrap();
    let subject = subject("homogeneous");
    let result = kernel.render(&task(&subject, &segments(&subject, 8)));
    assert!(matches!(result, Err(KernelError::Garbage { .. })));
    assert_eq!(fixture.told(), "end of requests\nterminated\n");
    fixture.assert_gone();
}

#[test]
fn a_kernel_that_hangs_is_killed_and_given_up_after_three_times() {
    for mode in ["never-answers", "descendant", "does-not-read"] {
        let fixture = Fixture::new();
        let timeout = Duration::from_millis(500);
        let options = Options {
            timeout,
            ..patient()
        };
        let mut kernel = fixture.start(mode, options).unwrap();
        // More than a pipe holds: who does not read blocks who writes.
        let subject = subject("homogeneous");
        let cut = segments(&subject, 1 << 14);
        let start = Instant::now();
        for failures in 1..=3 {
            let error = kernel.render(&task(&subject, &cut)).unwrap_err();
            assert!(
                matches!(&error, KernelError::TimedOut { what: "answer", .. }),
                "{mode}: {error:?}"
            );
            assert_eq!(fixture.starts(), failures);
            fixture.assert_gone();
        }
        let error = kernel.render(&task(&subject, &cut)).unwrap_err();
        assert!(
            matches!(&error, KernelError::GivenUp { failures: 3, last } if matches!(**last, KernelError::TimedOut { .. })),
            "{error:?}"
        );
        assert_eq!(fixture.starts(), 3);
        assert!(start.elapsed() < Duration::from_secs(30));
    }
}

#[test]
fn answers_that_are_none_are_shown() {
    for (mode, words) in [
        (
            "garbage",
            "no JSON object: expected value in the answer 'Traceback (most recent call last):'",
        ),
        ("half-line", "half a line in the answer '{\\\"type\\\":"),
        (
            "not-an-answer",
            "invalid value: string \"much\" (allowed: a number, or text such as ",
        ),
        (
            "noise-line",
            "a line too long (allowed: up to 1048576 bytes) in the answer 'xxx",
        ),
        (
            "noise-lines",
            "no JSON object: expected ident in the answer 'noise'",
        ),
        (
            "noise-stderr",
            "no JSON object: expected value in the answer '?' (allowed: see docs/protocol.md); its standard error ends: xxx",
        ),
        (
            "too-few",
            "0 results (allowed: 1, one a task) in the answer '{",
        ),
        (
            "neither",
            "a result without 'radiance' and 'error' in the answer '{",
        ),
        ("extra-key", "unknown key 'stdev' (allowed: 'radiance', "),
    ] {
        for result in two_requests(mode) {
            let error = result.unwrap_err();
            assert!(matches!(error, KernelError::Garbage { .. }), "{error:?}");
            let said = error.to_string();
            assert!(said.starts_with(words), "{mode}: {said}");
            assert!(said.len() < 1000, "{mode}: {said}");
            assert!(!said.chars().any(char::is_control), "{mode}: {said:?}");
        }
    }
    for (mode, got) in [("wrong-id", "2"), ("text-id", "\"7\"")] {
        let [first, _] = two_requests(mode);
        let stderr = String::new();
        let got = got.into();
        assert_eq!(
            first,
            Err(KernelError::WrongId {
                got,
                wanted: 1,
                stderr
            })
        );
    }
}

#[test]
fn after_a_failure_the_next_request_is_answered() {
    let [first, second] = two_requests("garbage-once");
    assert!(matches!(first, Err(KernelError::Garbage { .. })));
    assert_eq!(radiance(second), 16.0);
    let [first, second] = two_requests("out-of-order");
    assert!(matches!(first, Err(KernelError::WrongId { wanted: 1, .. })));
    assert_eq!(radiance(second), 16.0);
    // One answer too many is taken for the next one's.
    let [first, second] = two_requests("twice");
    assert_eq!(radiance(first), 8.0);
    assert!(
        matches!(&second, Err(KernelError::WrongId { got, wanted: 2, .. }) if got == "1"),
        "{second:?}"
    );
}

#[test]
fn results_that_cannot_be_are_refused_one_by_one() {
    for (mode, error) in [
        (
            "too-many-channels",
            "2 radiances (allowed: 1, one a channel)",
        ),
        (
            "standard-errors",
            "0 standard errors (allowed: 1, one a channel)",
        ),
        (
            "step-zero",
            "a step of 0 really used (allowed: above 0, whole for a number, and up to 1048576 segments)",
        ),
        (
            "half-a-segment",
            "a number of segments of 0.5 really used (allowed: above 0, whole for a number, and up to 1048576 segments)",
        ),
        ("refuses", "the kernel refuses: no such case"),
    ] {
        for result in two_requests(mode) {
            assert_eq!(result.unwrap_err().to_string(), error);
        }
    }
}

#[test]
fn numbers_of_every_kind_come_through() {
    for mode in ["nan", "nan-text"] {
        for result in two_requests(mode) {
            assert!(result.unwrap().radiance[0].is_nan());
        }
    }
    let [rendering, _] = two_requests("all");
    let rendering = rendering.unwrap();
    assert_eq!(rendering.radiance[0], 0.1875);
    assert_eq!(rendering.opacity.unwrap(), 0.5);
    assert_eq!((rendering.step, rendering.segments), (Some(0.25), Some(4)));
    assert_eq!(rendering.standard_error.unwrap(), [1e-3]);
    let [wide, _] = two_requests("wide");
    let wide = &wide.unwrap().radiance[0];
    assert!(wide.prec() >= 200 && (wide.clone() * 3_u32 - 1_u32).abs() < 1e-59);
}

#[test]
fn noise_where_it_belongs_does_no_harm() {
    let subject = subject("homogeneous");
    for (mode, end) in [("prints", "}"), ("noise-stdout", "the end")] {
        let fixture = Fixture::new();
        let mut kernel = fixture.start(mode, patient()).unwrap();
        for n in [8, 16] {
            let result = kernel.render(&task(&subject, &segments(&subject, n)));
            assert_eq!(radiance(result), n as f64);
        }
        assert_eq!(fixture.starts(), 1);
        fixture::eventually(|| kernel.output().trim_end().ends_with(end));
        assert!(kernel.output().len() <= 4096);
    }
}

#[test]
fn where_one_level_kills_the_kernel_the_others_have_their_radiance() {
    let fixture = Fixture::new();
    let mut kernel = fixture.start("dies-at-7", patient()).unwrap();
    let subject = subject("sine-squared");
    let cuts: Vec<_> = (4..10).map(|n| segments(&subject, n)).collect();
    let tasks: Vec<Task<'_>> = cuts.iter().map(|cut| task(&subject, cut)).collect();
    // Failures with answers between them are not counted together.
    for _ in 0..3 {
        for (n, result) in (4..).zip(kernel.render_all(&tasks)) {
            if n == 7 {
                let stderr = String::new();
                let how = "was killed by signal 11".into();
                assert_eq!(result, Err(KernelError::Exited { how, stderr }));
            } else {
                assert_eq!(radiance(result), f64::from(n));
            }
        }
    }
    drop(kernel);
    fixture.assert_gone();
}

#[test]
fn closed_pipes_are_named() {
    let fixture = Fixture::new();
    let subject = subject("homogeneous");
    let cut = segments(&subject, 8);
    for (mode, words) in [
        ("closes-requests", "the kernel closed its request pipe"),
        ("closes-answers", "the kernel closed its answer pipe"),
    ] {
        let mut kernel = fixture.start(mode, patient()).unwrap();
        let error = kernel.render(&task(&subject, &cut)).unwrap_err();
        assert_eq!(error.to_string(), words);
        fixture.assert_gone();
    }
}

#[test]
fn another_greeting_after_a_restart_is_refused() {
    let fixture = Fixture::new();
    let mut kernel = fixture.start("changes", patient()).unwrap();
    let subject = subject("homogeneous");
    let cut = segments(&subject, 8);
    fixture.kill();
    let error = kernel.render(&task(&subject, &cut)).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("the kernel was killed by signal 9"),
        "{error}"
    );
    for _ in 0..2 {
        let error = kernel.render(&task(&subject, &cut)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "started anew, the kernel declares other values of: order, format (allowed: the same always)"
        );
        fixture.assert_gone();
    }
}

#[test]
fn kernels_that_do_not_end_are_ended() {
    for mode in ["does-not-end", "leaves-descendant"] {
        let fixture = Fixture::new();
        let kernel = fixture.start(mode, patient()).unwrap();
        let start = Instant::now();
        drop(kernel);
        assert!(start.elapsed() < Duration::from_secs(4), "{mode}");
        fixture.assert_gone();
    }
}

#[test]
fn every_form_is_sent() {
    let fixture = Fixture::new();
    let subject = subject("rgb-transfer");
    let subject_of_one = fixture::subject("sine-squared");
    let volume = subject_of_one.volume(4, 3);
    let mut kernel = fixture.start("volume", patient()).unwrap();
    let cut = segments(&subject_of_one, 4);
    let mut wanted = task(&subject_of_one, &cut);
    wanted.data = Data::Volume(&volume);
    assert_eq!(radiance(kernel.render(&wanted)), 5.03);

    let mut kernel = fixture.start("formula", patient()).unwrap();
    let FormKind::Formula(language) = kernel.declaration().form else {
        panic!("{:?}", kernel.declaration());
    };
    let formula = subject_of_one.formula(language).unwrap();
    wanted.data = Data::Formula(&formula);
    let value = subject_of_one.at(0.25, &mut [0.0]);
    assert!((radiance(kernel.render(&wanted)) - value).abs() < 1e-15);
    // One in another form is refused, and those beside it are not.
    let other = task(&subject_of_one, &cut);
    let results = kernel.render_all(&[other, wanted, other]);
    let (given, wanted) = (FormKind::Segments, FormKind::Formula(language));
    assert_eq!(results[2], Err(KernelError::Form { given, wanted }));
    assert!(results[0].is_err() && results[1].is_ok());

    let mut kernel = fixture.start("hexadecimal", patient()).unwrap();
    let cut = subject.segments(Cut::Step(0.3)).unwrap();
    let mut wanted = task(&subject, &cut);
    wanted.step = 0.3;
    let rendering = kernel.render(&wanted).unwrap();
    assert_eq!(
        rendering.radiance[0],
        cut.edges.extinction.iter().sum::<f64>()
    );
    assert_eq!(rendering.radiance[1], 0.3);
    assert_eq!(rendering.radiance[2], 1.0);
}

#[test]
fn arrays_in_files_are_gone_after_the_answer_and_their_directory_after_the_kernel() {
    let fixture = Fixture::new();
    let mut kernel = fixture.start("npy", patient()).unwrap();
    let subject = subject("sine-squared");
    let cut = segments(&subject, 8);
    let sum: f64 = cut.middles.extinction.iter().sum();
    assert_eq!(radiance(kernel.render(&task(&subject, &cut))), sum);
    fixture::eventually(|| kernel.output().ends_with('\n'));
    let directory = kernel.output();
    let directory = Path::new(directory.trim());
    assert_eq!(fs::read_dir(directory).unwrap().count(), 0);
    drop(kernel);
    assert!(!directory.exists());
}
