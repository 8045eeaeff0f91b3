//! Many rays in one request, as arrays behind a line.

use super::fixture::{Fixture, patient, segments, subject, task};
use std::fs;
use std::num::NonZeroUsize;
use std::time::Duration;
use volver::case::Fresh;
use volver::kernel::process::{Options, ProcessKernel};
use volver::kernel::{Cut, Kernel, KernelError, Quantity, Rendering, Segments, Subject, Task};
use volver::method::Method;
use volver::real::Native;

fn start(fixture: &Fixture, mode: &str, options: Options) -> ProcessKernel {
    fixture
        .run("framed.py", &["frames", mode], options)
        .unwrap()
}

/// What comes of rays of 6, 7 and 9 segments in one request, and of one of 8 after it; whether the first child lives on.
fn results(mode: &str, options: Options) -> (Vec<Result<Rendering, KernelError>>, bool) {
    let fixture = Fixture::new();
    let mut kernel = start(&fixture, mode, options);
    let subject = subject("homogeneous");
    let cuts = [6, 7, 9].map(|n| segments(&subject, n));
    let tasks = cuts.each_ref().map(|cut| task(&subject, cut));
    let mut results = kernel.render_together(&tasks).unwrap_or_else(|error| {
        let all = tasks.iter();
        all.map(|_| Err(error.clone())).collect()
    });
    results.push(kernel.render(&task(&subject, &segments(&subject, 8))));
    let starts = fixture.starts();
    drop(kernel);
    fixture.assert_gone();
    (results, starts == 1)
}

fn said(mode: &str, options: Options) -> (String, bool) {
    let (mut results, lives) = results(mode, options);
    let error = results.swap_remove(0).unwrap_err();
    (error.to_string(), lives)
}

/// The radiance of the method that the fixture is, in the first channel.
fn own(subject: &Subject, n: u64) -> f64 {
    let method: Method = "front-to-back/middle/expm1".parse().unwrap();
    let nodes = Fresh::new(&subject.cases()[0], Native::<f64>::new());
    method.radiance(&nodes, n).unwrap()
}

#[test]
fn rays_of_different_n_and_case_are_rendered_in_one_request() {
    let fixture = Fixture::new();
    let mut kernel = start(&fixture, "behaves", patient());
    assert_eq!(
        kernel.declaration().batch.map(NonZeroUsize::get),
        Some(4096)
    );
    let subjects = ["sine-squared", "homogeneous", "thick"].map(subject);
    let levels = [(0, 1), (1, 37), (0, 512), (2, 8), (1, 2)];
    let cuts: Vec<(&Subject, Segments)> = levels
        .iter()
        .map(|(which, n)| (&subjects[*which], segments(&subjects[*which], *n)))
        .collect();
    let tasks: Vec<Task<'_>> = cuts
        .iter()
        .map(|(subject, cut)| task(subject, cut))
        .collect();
    let results = kernel.render_all(&tasks);
    assert_eq!(results.len(), tasks.len());
    for ((task, (subject, _)), result) in tasks.iter().zip(&cuts).zip(results) {
        let (radiance, own) = (result.unwrap().radiance, own(subject, task.segments));
        assert_eq!(radiance.len(), 1);
        let got = radiance[0].to_f64();
        assert!(
            (got - own).abs() <= 1e-13 * own.abs(),
            "{}: {got} {own}",
            subject.name()
        );
    }
    assert_eq!(fixture.asked(), ["frame 5"]);
}

#[test]
fn every_block_is_where_the_document_says() {
    let fixture = Fixture::new();
    let mut kernel = start(&fixture, "parts", patient());
    let subjects = ["rgb-transfer", "rgb-layers"]
        .map(|name| subject(name).before(vec![0.5, 0.1, -3.0]).unwrap());
    let step = 0.3;
    let cuts = [Cut::Segments(5), Cut::Step(step), Cut::Segments(1)];
    let rays: Vec<(&Subject, Segments)> = cuts
        .iter()
        .zip([&subjects[0], &subjects[1], &subjects[1]])
        .map(|(cut, subject)| (subject, subject.segments(*cut).unwrap()))
        .collect();
    let seeds = [3, u64::MAX, 0];
    let tasks: Vec<Task<'_>> = rays
        .iter()
        .zip(seeds)
        .map(|((subject, cut), seed)| Task {
            seed,
            step: 0.1 + seed as f64,
            ..task(subject, cut)
        })
        .collect();
    for (result, task) in kernel.render_all(&tasks).into_iter().zip(&tasks) {
        let rendering = result.unwrap();
        let cut = task.cut().unwrap();
        let length = task.subject.length().to_f64();
        let given = [task.seed as f64, length, task.step];
        assert_eq!(rendering.radiance, given);
        let of = |quantity| rendering.of(quantity, 0).unwrap().to_f64();
        let edges = &cut.edges;
        assert_eq!(of(Quantity::Opacity), length);
        assert_eq!(
            of(Quantity::OpticalDepth),
            edges.emission[2][0] - edges.extinction[cut.count()]
        );
        assert_eq!(
            of(Quantity::ExpectedDepth),
            0.1 + task.subject.name().len() as f64
        );
    }
    assert_eq!(fixture.asked(), ["frame 3"]);
}

#[test]
fn no_more_rays_are_asked_at_once_than_the_kernel_takes_nor_of_other_channels() {
    let fixture = Fixture::new();
    let mut kernel = start(&fixture, "three", patient());
    let (one, three) = (subject("sine-squared"), subject("rgb-transfer"));
    let cuts: Vec<(&Subject, Segments)> = [&one, &one, &one, &one, &three, &three, &one]
        .iter()
        .zip(2..)
        .map(|(subject, n)| (*subject, segments(subject, n)))
        .collect();
    let tasks: Vec<Task<'_>> = cuts
        .iter()
        .map(|(subject, cut)| task(subject, cut))
        .collect();
    let counts: Vec<usize> = kernel
        .render_all(&tasks)
        .into_iter()
        .map(|result| result.unwrap().radiance.len())
        .collect();
    assert_eq!(counts, [1, 1, 1, 1, 3, 3, 1]);
    assert_eq!(
        fixture.asked(),
        ["frame 3", "frame 1", "frame 2", "frame 1"]
    );
    assert_eq!(
        kernel.render_together(&tasks),
        Err(KernelError::Together { rays: 7, most: 3 })
    );
}

#[test]
fn what_single_rays_lack_is_theirs_alone() {
    let (results, lives) = results("used", patient());
    assert!(lives);
    let what = |value| KernelError::Used {
        what: "number of segments",
        value,
    };
    assert_eq!(results[0], Err(what(0.0)));
    let second = results[1].as_ref().unwrap();
    assert_eq!((second.segments, second.step), (Some(2), Some(1.0)));
    assert_eq!(second.standard_error, Some(vec![0.5]));
    assert!(
        matches!(&results[2], Err(KernelError::Used { what: "step", value }) if *value == f64::INFINITY)
    );

    let (results, lives) = self::results("refuses-one", patient());
    assert!(lives);
    let reason = "too thick".to_string();
    assert!(results[0].is_ok() && results[1].is_ok());
    assert_eq!(results[2], Err(KernelError::Refused { reason }));

    let (results, lives) = self::results("nan", patient());
    assert!(
        lives
            && results
                .iter()
                .all(|one| one.as_ref().unwrap().radiance[0].is_nan())
    );
}

#[test]
fn a_frame_that_is_refused_is_asked_ray_by_ray() {
    let fixture = Fixture::new();
    let mut kernel = start(&fixture, "refuses-many", patient());
    let subject = subject("homogeneous");
    let cuts = [6, 7].map(|n| segments(&subject, n));
    let tasks = cuts.each_ref().map(|cut| task(&subject, cut));
    assert!(kernel.render_all(&tasks).iter().all(Result::is_ok));
    assert_eq!(fixture.asked(), ["frame 2", "frame 1", "frame 1"]);
    assert_eq!(fixture.starts(), 1);
    let reason = "no memory".to_string();
    assert_eq!(
        kernel.render_together(&tasks),
        Err(KernelError::Refused { reason })
    );
    // What refuses for ever is not given up: it does what it should.
    let mut kernel = start(&fixture, "refuses", patient());
    for _ in 0..5 {
        let error = kernel.render(&tasks[0]).unwrap_err();
        assert_eq!(error.to_string(), "the kernel refuses: no memory");
    }
}

#[test]
fn a_ray_that_kills_the_kernel_costs_the_others_nothing() {
    let fixture = Fixture::new();
    let mut kernel = start(&fixture, "dies-at-7", patient());
    let subject = subject("homogeneous");
    let cuts = [6, 7, 8].map(|n| segments(&subject, n));
    let tasks = cuts.each_ref().map(|cut| task(&subject, cut));
    let results = kernel.render_all(&tasks);
    assert!(results[0].is_ok() && results[2].is_ok());
    assert!(
        matches!(results[1], Err(KernelError::Exited { .. })),
        "{:?}",
        results[1]
    );
}

#[test]
fn answers_that_are_no_frame_are_named_and_end_the_kernel() {
    for (mode, words) in [
        (
            "no-frame",
            "unknown variant 'answer' (allowed: 'frame') in the answer '{",
        ),
        (
            "too-much",
            "a frame of 8000000000 bytes (allowed: up to 168) in the answer '{",
        ),
        (
            "sizes",
            "blocks of 24 bytes in a frame of 32 (allowed: all of them) in the answer '{",
        ),
        (
            "huge",
            "blocks of too many bytes in a frame of 0 (allowed: all of them) in the answer '{",
        ),
        (
            "negative",
            "invalid value: integer '-1' (allowed: u64) in the answer '{",
        ),
        (
            "twice",
            "a block 'radiance' twice (allowed: each once) in the answer '{",
        ),
        (
            "unknown-block",
            "unknown variant 'stdev' (allowed: 'radiance', 'opacity', ",
        ),
        (
            "unknown-type",
            "unknown variant '<f4' (allowed: '<f8', '<i8', '<u8') in the answer '{",
        ),
        (
            "error-beside",
            "a frame with 'blocks' or 'errors' and 'error' in the answer '{",
        ),
        (
            "errors-outside",
            "an error of ray 3 (allowed: 0 to 2, ascending) in the answer '{",
        ),
        (
            "errors-twice",
            "an error of ray 0 (allowed: 0 to 2, ascending) in the answer '{",
        ),
        ("cut", "a frame cut short, 12 of 24 bytes, in the answer '{"),
    ] {
        let (said, lives) = said(mode, patient());
        assert!(said.starts_with(words), "{mode}: {said}");
        assert!(!said.chars().any(char::is_control), "{mode}: {said:?}");
        assert!(!lives, "{mode}");
    }
    let (said, lives) = said("wrong-id", patient());
    assert_eq!(
        (&said[..], lives),
        (
            "an answer to request 2 (allowed: to 1, the one asked)",
            false
        )
    );
    let options = Options {
        timeout: Duration::from_millis(800),
        ..patient()
    };
    let (said, lives) = self::said("half", options);
    assert_eq!(
        (&said[..], lives),
        ("no whole frame in 0.8 s (allowed: up to --timeout)", false)
    );
}

#[test]
fn a_frame_with_the_wrong_blocks_is_no_answer_and_the_kernel_goes_on() {
    for (mode, words) in [
        (
            "wrong-shape",
            "a block 'radiance' of <f8 [3] (allowed: <f8 [3, 1])",
        ),
        (
            "wrong-type",
            "a block 'radiance' of <i8 [3, 1] (allowed: <f8 [3, 1])",
        ),
        (
            "undeclared",
            "an undeclared 'opacity' (allowed: what the greeting declares, and all of it)",
        ),
        (
            "missing",
            "no 'radiance' (allowed: what the greeting declares, and all of it)",
        ),
    ] {
        assert_eq!(said(mode, patient()), (words.into(), true), "{mode}");
    }
}

#[test]
fn what_stands_behind_a_frame_is_the_next_answers_trouble() {
    let (mut results, _) = results("behind", patient());
    assert!(results[0].is_ok());
    let said = results.pop().unwrap().unwrap_err().to_string();
    assert!(
        said.starts_with("no JSON object: expected value in the answer 'more{"),
        "{said}"
    );
}

#[test]
fn frames_stand_in_the_log_as_text() {
    for (mode, last) in [
        ("behaves", Some(r#"4 {"block":"radiance","values":["#)),
        ("slow", Some(r#"4 {"block":"radiance","values":["#)),
        ("cut", None),
    ] {
        let fixture = Fixture::new();
        let (log, path) = fixture.log();
        let options = Options {
            log: Some(log),
            ..patient()
        };
        let mut kernel = start(&fixture, mode, options);
        let subject = subject("homogeneous");
        let cuts = [2, 1].map(|n| segments(&subject, n));
        let tasks = cuts.each_ref().map(|cut| task(&subject, cut));
        let _ = kernel.render_together(&tasks);
        drop(kernel);
        let log = fs::read(&path).unwrap();
        let log = String::from_utf8(log).unwrap();
        assert!(log.chars().all(|c| c == '\n' || !c.is_control()), "{log:?}");
        let requests: Vec<&str> = log.lines().filter(|line| line.starts_with("3 ")).collect();
        assert!(
            requests[1].starts_with(r#"3 {"type":"frame","id":1,"rays":2,"#),
            "{log}"
        );
        assert_eq!(requests[2], r#"3 {"block":"offsets","values":[0,2,3]}"#);
        assert_eq!(requests[4], r#"3 {"block":"seed","values":[0,0]}"#);
        assert_eq!(
            requests[7],
            r#"3 {"block":"edges_lambda","values":[0.0,1.0,2.0,0.0,2.0]}"#
        );
        assert_eq!(requests.len(), 2 + 11, "{log}");
        let answers: Vec<&str> = log.lines().filter(|line| line.starts_with("4 ")).collect();
        assert!(
            answers[1].starts_with(r#"4 {"type": "frame", "id": 1, "#),
            "{log}"
        );
        assert_eq!(answers.get(2).is_some(), last.is_some(), "{log}");
        if let (Some(line), Some(words)) = (answers.get(2), last) {
            assert!(line.starts_with(words), "{log}");
        }
    }
}
