//! What a request to a kernel in a process of its own costs besides rendering: the round trip to kernels that
//! compute nothing, or next to nothing, and what it takes to write the numbers as text, which is part of it unless
//! they go into files.
//!
//! `nothing.c`, compiled here by `cc`, does not even read the numbers; `nothing.py` does, and so does
//! `examples/kernels/front_to_back.c`, whose own work is an exponential a segment.
//!
//! `cargo bench --bench kernel`, or with `-- NAME PROGRAM ARGUMENT…` for another kernel than those listed; that
//! one's own time is then in the figures.
#![allow(missing_docs, clippy::expect_used)]

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use volver::case::catalogue;
use volver::case::manufacture::manufacture;
use volver::kernel::process::{Options, ProcessKernel};
use volver::kernel::{Cut, Data, Kernel, Samples, Segments, Subject, Task};

const WARM_UP: usize = 50;
const REQUESTS: usize = 500;

fn main() {
    let python = concat!(env!("CARGO_MANIFEST_DIR"), "/kernel/nothing.py");
    let folder = tempfile::tempdir().expect("a folder");
    let mut kernels = vec![
        command("C, unread", &in_c("kernel/nothing.c", folder.path()), &[]),
        command(
            "C, text",
            &in_c("../examples/kernels/front_to_back.c", folder.path()),
            &[],
        ),
        command("python, text", "python3", &[python, "json"]),
        command("python, files", "python3", &[python, "npy"]),
    ];
    // Cargo itself says --bench.
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    if let [name, program, rest @ ..] = without_cargo(&arguments) {
        kernels = vec![command(name, program, rest)];
    }
    println!("kernel            n  round trip ms  99 % ms  numbers as text ms");
    let subject = subject("sine-squared");
    for (name, program, arguments) in kernels {
        let mut kernel = ProcessKernel::start(&program, &arguments, Options::default())
            .expect("a kernel that starts");
        for n in [1, 8, 64, 512] {
            measure(&name, &mut kernel, &subject, n);
        }
    }
}

/// The kernel of that file in C, compiled into the folder.
fn in_c(source: &str, folder: &Path) -> String {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join(source);
    let program = folder.join(source.file_stem().expect("a name"));
    let compiled = Command::new("cc")
        .args(["-std=c99", "-O2", "-DVOLVER_PROCESS", "-o"])
        .arg(&program)
        .arg(&source)
        .arg("-lm")
        .status();
    let compiled = compiled.expect("a C compiler, cc");
    assert!(compiled.success(), "{} is compiled", source.display());
    program.to_str().expect("a path in UTF-8").into()
}

fn without_cargo<'a>(arguments: &'a [&'a str]) -> &'a [&'a str] {
    match arguments {
        ["--bench", rest @ ..] | [rest @ .., "--bench"] | rest => rest,
    }
}

fn command(name: &str, program: &str, arguments: &[&str]) -> (String, String, Vec<String>) {
    let arguments = arguments.iter().map(ToString::to_string).collect();
    (name.into(), program.into(), arguments)
}

fn measure(name: &str, kernel: &mut ProcessKernel, subject: &Subject, n: u64) {
    let segments = subject
        .segments(Cut::Segments(n))
        .expect("segments of a case");
    let task = Task {
        subject,
        step: subject.length().to_f64() / n as f64,
        segments: n,
        seed: 0,
        data: Data::Segments(&segments),
    };
    let [trip, slow] = times(|| {
        kernel.render(&task).expect("a radiance");
    });
    let [writing, _] = times(|| written(&segments));
    println!("{name:14} {n:4}  {trip:13.3}  {slow:7.3}  {writing:18.3}");
}

/// Milliseconds: the median, and what one of a hundred exceeds.
fn times(mut action: impl FnMut()) -> [f64; 2] {
    for _ in 0..WARM_UP {
        action();
    }
    let mut times: Vec<Duration> = (0..REQUESTS)
        .map(|_| {
            let start = Instant::now();
            action();
            start.elapsed()
        })
        .collect();
    times.sort_unstable();
    [REQUESTS / 2, REQUESTS * 99 / 100].map(|place| times[place].as_secs_f64() * 1e3)
}

/// Nearly all of a request.
fn written(segments: &Segments) {
    let row = |samples: &Samples| {
        let rows = [&samples.lambda, &samples.extinction];
        serde_json::to_vec(&(rows, &samples.emission))
    };
    for samples in [&segments.edges, &segments.middles] {
        std::hint::black_box(row(samples).expect("numbers as text"));
    }
}

fn subject(name: &str) -> Subject {
    let description = catalogue::find(name).expect("a case of the catalogue");
    let channels = manufacture(&description.expect("a case that is read"));
    let channels = channels.expect("a case that can be made").into_iter();
    Subject::new(name, channels.map(|c| (c.channel, c.case)).collect()).expect("channels")
}
