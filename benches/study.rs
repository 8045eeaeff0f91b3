//! A study as a whole: evaluations a second, peak memory, and what more cores and more cases cost.
//!
//! `cargo bench --bench study` runs a small one in some minutes; with `-- --full` it is 24 cases × 20 pairs of
//! nested rules × 4 formats × 12 levels. Each configuration runs in a process of its own, so that its peak
//! memory is its own.
#![allow(missing_docs, clippy::expect_used, clippy::panic)]

use std::process::Command;
use std::time::Instant;
use volver::case::manufacture::manufacture;
use volver::case::{Case, SymbolicCase, catalogue};
use volver::method::Method;
use volver::real::FormatName;
use volver::study::Silent;
use volver::study::sweep::{Errors, Header, Journal, Sweep, run};

const INNER: [&str; 5] = [
    "riemann-left",
    "trapezoid",
    "midpoint",
    "simpson",
    "gauss-3",
];
const OUTER: [&str; 4] = ["riemann-right", "trapezoid", "simpson", "boole"];
const FORMATS: [&str; 4] = ["f32", "f64", "mpfr:128", "mpfr:256"];
/// Says to a child process what it is to run: cases, finest level, threads.
const CHILD: &str = "VOLVER_BENCH_STUDY";

fn main() {
    if let Ok(configuration) = std::env::var(CHILD) {
        return child(&configuration);
    }
    let full = std::env::args().any(|argument| argument == "--full");
    let (cases, finest) = if full { (24, 1 << 14) } else { (6, 1 << 9) };
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    println!("cases  finest  threads   seconds  evaluations  a second  peak MiB");
    for (cases, threads) in [
        (cases / 3, threads),
        (cases, threads),
        (cases, threads.div_ceil(2)),
    ] {
        parent(cases, finest, threads);
    }
}

fn parent(cases: usize, finest: u64, threads: usize) {
    let Ok(this) = std::env::current_exe() else {
        return;
    };
    let configuration = format!("{cases} {finest} {threads}");
    let done = Command::new(this).env(CHILD, configuration).status();
    assert!(
        done.is_ok_and(|status| status.success()),
        "the child process failed"
    );
}

fn child(configuration: &str) {
    let numbers: Vec<u64> = configuration
        .split(' ')
        .filter_map(|n| n.parse().ok())
        .collect();
    let [cases, finest, threads] = numbers[..] else {
        panic!("{configuration}: cases, finest level and threads");
    };
    let sweep = sweep(cases, finest);
    let directory = tempfile::tempdir().expect("a directory for the journal");
    let path = directory.path().join("study.jsonl");
    let mut journal = Journal::begin(&path, &Header::new(&sweep)).expect("a journal");
    let start = Instant::now();
    let threads = usize::try_from(threads).unwrap_or(1);
    let statistics = run(&sweep, &mut journal, threads, &Silent).expect("a study");
    let seconds = start.elapsed().as_secs_f64();
    let evaluations = statistics.evaluations + statistics.oracle_evaluations;
    println!(
        "{cases:5}  {finest:6}  {threads:7}  {seconds:8.1}  {evaluations:11}  {:8.0}  {:8}",
        evaluations as f64 / seconds,
        peak_mebibytes().map_or("unknown".to_owned(), |peak| peak.to_string()),
    );
}

/// Smooth cases of one channel from the catalogue, levels doubling from 8.
fn sweep(cases: u64, finest: u64) -> Sweep {
    let smooth = catalogue::names().filter_map(|name| {
        let description = catalogue::find(name)?.ok()?;
        let mut made = manufacture(&description).ok()?;
        let case: SymbolicCase = made.pop().filter(|_| made.is_empty())?.case;
        case.structure()
            .breaks
            .is_empty()
            .then(|| (name.to_owned(), case))
    });
    let methods = INNER
        .iter()
        .flat_map(|inner| OUTER.iter().map(move |outer| format!("{inner}/{outer}")));
    Sweep {
        cases: smooth
            .take(usize::try_from(cases).unwrap_or(usize::MAX))
            .collect(),
        methods: methods
            .map(|name| name.parse::<Method>().expect("a method"))
            .collect(),
        formats: FORMATS
            .iter()
            .map(|name| name.parse::<FormatName>().expect("a format"))
            .collect(),
        levels: std::iter::successors(Some(8), |n| Some(2 * n))
            .take_while(|n| *n <= finest)
            .collect(),
        errors: Errors::Split,
    }
}

/// Where the system tells.
fn peak_mebibytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kibibytes / 1024)
}
