//! Twenty pairs of nested rules on ten levels in binary64, from nothing evaluated to the table of errors, beside numpy inside
//! its process.
//!
//! The peer is `peers/study_total.py numpy shared`: every node of the finest level once, every exponential of an inner rule
//! once. Errors are compared first; then both run in turn, by the processor's clock of each process. `VOLVER_PYTHON` is a
//! Python with numpy [python3].

#![allow(missing_docs, clippy::expect_used, clippy::panic)]

use std::env;
use std::io::Write;
use std::process::{Command, Stdio};
use volver::case::manufacture::manufacture;
use volver::case::{AnyNodes, Case, Shared, SineSquared, catalogue};
use volver::method::{Level, Method};
use volver::real::Native;
use volver_benches::{Compared, quartiles, seconds};

const INNER: [&str; 5] = [
    "riemann-left",
    "riemann-right",
    "trapezoid",
    "simpson",
    "boole",
];
const OUTER: [&str; 4] = ["riemann-left", "trapezoid", "simpson", "boole"];
const LEVELS: [u64; 10] = [4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048];
/// Tables in a round, whose median counts.
const TABLES: usize = 21;
/// Errors agree to so much.
const SAME: f64 = 1e-15;
/// The peer, in a process that says how long a table took.
const PEER: &str = r#"
import sys, time
sys.argv = ["study_total.py", "numpy", "shared"]
exec(open(PEER).read())
table = shared()
for inner, outer, n in ORDER:
    print(repr(float(table[inner, outer, n])))
taken = []
for _ in range(TABLES):
    start = time.process_time()
    shared()
    taken.append(time.process_time() - start)
print(sorted(taken)[TABLES // 2])
"#;

fn main() {
    let description = catalogue::find("sine-squared").expect("a case");
    let made = manufacture(&description.expect("a case")).expect("a case");
    let symbolic = &made.first().expect("a channel").case;
    let methods: Vec<Method> = INNER
        .iter()
        .flat_map(|inner| OUTER.iter().map(move |outer| format!("{inner}/{outer}")))
        .map(|name| name.parse().expect("a method"))
        .collect();
    // I as numpy's script has it: 2 − (sin 1 + 2) e^(−sin 1/2).
    let sine = 1.0_f64.sin();
    let exact = 2.0 - (sine + 2.0) * (-sine / 2.0).exp();
    println!("medium     ms     numpy ms  ratio (quartiles)");
    compare("compiled", || table(&SineSquared, &methods, exact));
    compare("formulas", || table(symbolic, &methods, exact));
}

/// Errors, by level and then by method.
fn table<C: Case>(case: &C, methods: &[Method], exact: f64) -> Vec<f64> {
    let nodes = Shared::new(case, Native::<f64>::new());
    let mut errors = Vec::new();
    for n in LEVELS {
        let mut level = Level::of_any(AnyNodes::new(&nodes), n);
        for method in methods {
            let radiance = level.radiance(method).expect("a radiance");
            errors.push(radiance - exact);
        }
    }
    errors
}

fn compare(medium: &str, mut ours: impl FnMut() -> Vec<f64>) {
    let (theirs, _) = numpy();
    for (ours, theirs) in ours().iter().zip(&theirs) {
        assert!((ours - theirs).abs() < SAME, "{ours} and {theirs}");
    }
    let own = || quartiles((0..TABLES).map(|_| seconds(&mut ours)).collect())[1];
    let Compared { own, other, ratio } = Compared::new(own, || numpy().1);
    let [low, ratio, high] = ratio;
    println!(
        "{medium:9} {:6.3}  {:8.3}  {ratio:.2} ({low:.2} to {high:.2})",
        1e3 * own,
        1e3 * other,
    );
}

/// numpy's errors in the same order, and the seconds that its table took.
fn numpy() -> (Vec<f64>, f64) {
    let order: Vec<String> = LEVELS
        .iter()
        .flat_map(|n| INNER.iter().map(move |inner| (n, inner)))
        .flat_map(|(n, inner)| {
            OUTER
                .iter()
                .map(move |outer| format!("({inner:?}, {outer:?}, {n})"))
        })
        .collect();
    let peer = concat!(env!("CARGO_MANIFEST_DIR"), "/peers/study_total.py");
    let script = PEER
        .replace("PEER", &format!("{peer:?}"))
        .replace("ORDER", &format!("[{}]", order.join(", ")))
        .replace("TABLES", &TABLES.to_string());
    let python = env::var("VOLVER_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let mut process = Command::new(python)
        .arg("-")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("a Python");
    let mut input = process.stdin.take().expect("its input");
    input.write_all(script.as_bytes()).expect("a script");
    drop(input);
    let output = process.wait_with_output().expect("its output");
    assert!(output.status.success(), "a Python with numpy");
    let text = String::from_utf8(output.stdout).expect("numbers");
    let mut numbers: Vec<f64> = text
        .lines()
        .map(|line| line.parse().expect("a number"))
        .collect();
    let seconds = numbers.pop().expect("seconds");
    (numbers, seconds)
}
