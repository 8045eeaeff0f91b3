//! What a ray costs besides rendering where many are asked: processor time of volver and of a kernel in Python that
//! computes nothing, by every way that rays can be sent.
//!
//! `cargo bench -p volver-benches --bench batch`. The kernel answers the processor time that it has taken so far;
//! volver's is the clock of this process, all threads counted.
#![allow(missing_docs, clippy::expect_used)]

use rustix::time::{ClockId, clock_gettime};
use volver::case::catalogue;
use volver::case::manufacture::manufacture;
use volver::kernel::process::{Options, ProcessKernel};
use volver::kernel::{Cut, Data, Kernel, Segments, Subject, Task};

const RAYS: usize = 4096;
/// Batches that are measured, behind one that is not.
const TIMES: usize = 5;

/// How rays are sent: its name, the kernel's argument, whether all go in one request.
const WAYS: [(&str, &str, bool); 4] = [
    ("text, one a request", "json", false),
    ("text, all in one", "json", true),
    ("files, one a request", "npy", false),
    ("frames, all in one", "frames", true),
];

fn main() {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/batch/clock.py");
    let subject = subject("sine-squared");
    println!("µs of processor time a ray, {RAYS} rays of one channel in each of {TIMES} batches");
    println!("  n  way                    volver   kernel      all   part of the first");
    for n in [16, 256] {
        let mut first = None;
        for (name, way, at_once) in WAYS {
            let arguments = [script, way].map(String::from);
            let mut kernel = ProcessKernel::start("python3", &arguments, Options::default())
                .expect("a kernel that starts");
            let [own, theirs] = measure(&mut kernel, &subject, n, at_once);
            let all = own + theirs;
            let part = first.get_or_insert(all);
            let part = *part / all;
            println!("{n:3}  {name:20} {own:8.2} {theirs:8.2} {all:8.2}   1/{part:.1}");
        }
    }
}

/// Microseconds a ray of this process and of the kernel's.
fn measure(kernel: &mut ProcessKernel, subject: &Subject, n: u64, at_once: bool) -> [f64; 2] {
    let cut = subject.segments(Cut::Segments(n));
    // Each has numbers of its own, as rays of an image have.
    let cuts: Vec<Segments> = vec![cut.expect("segments of a case"); RAYS];
    let tasks: Vec<Task<'_>> = cuts
        .iter()
        .map(|segments| Task {
            subject,
            step: subject.length().to_f64() / n as f64,
            segments: n,
            seed: 0,
            data: Data::Segments(segments),
        })
        .collect();
    let mut before = [0.0, 0.0];
    let mut now = before;
    for time in 0..=TIMES {
        let last = if at_once {
            kernel.render_all(&tasks).pop()
        } else {
            tasks.iter().map(|task| kernel.render(task)).last()
        };
        let last = last.expect("a result").expect("a radiance");
        now = [clock(), last.radiance[0].to_f64()];
        if time == 0 {
            before = now;
        }
    }
    let rays = (TIMES * RAYS) as f64;
    [0, 1].map(|whose| (now[whose] - before[whose]) * 1e6 / rays)
}

/// Seconds of processor time of this process.
fn clock() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

fn subject(name: &str) -> Subject {
    let description = catalogue::find(name).expect("a case of the catalogue");
    let channels = manufacture(&description.expect("a case that is read"));
    let channels = channels.expect("a case that can be made").into_iter();
    Subject::new(name, channels.map(|c| (c.channel, c.case)).collect()).expect("channels")
}
