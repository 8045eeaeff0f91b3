//! Generated source code, compiled and run, beside the program that it was made from.

use rug::Rational;
use std::env;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use volver::real::Native;
use volver::symbolic::code::{Definition, Language, source};
use volver::symbolic::{Expr, Program};

const INPUTS: [&str; 2] = ["lambda", "s"];

/// Every operation, and the case of the paper: emission sin s², extinction s cos s², and the integral.
const EXPRESSIONS: [&str; 17] = [
    "sin(s^2)",
    "s*cos(s^2)",
    "2-(sin(lambda^2)+2)*exp(-sin(lambda^2)/2)",
    "s/3 - lambda/(s*lambda + 1) + 1e-5 - (s - (lambda - 2/7))",
    "-(1/s + 2/lambda^3)^2*(s/lambda)",
    "sqrt(s) + s^(3/2) + abs(lambda)^(1/3)",
    "ln(1 + s)*ln(lambda) + (exp(s) - 1) - 3*(1 - exp(-lambda))",
    "exp(s)/s - s/exp(lambda)",
    "tan(s) - tanh(lambda)*atan(s)",
    "sinh(s) - cosh(lambda)/s",
    "min(s, lambda) + 2*max(lambda, -s)",
    "piecewise(s < 1/2, ln(s), s <= lambda, pi*s, lambda > 3, -1, s >= -2, 5, 1/lambda)",
    "min(piecewise(s*lambda >= 1, s, lambda), 2)*s",
    "abs(s - 1e30)*1e-300 - (-s)^2 - -lambda/9007199254740993",
    "sin(s)*cos(s) + s*s^2*s^3 + sin(lambda + s*(1 + s*(2 + s*(3 + s*(4 + s*(5 + s*(6 + s*(7 + s))))))))",
    "1e400*s + s/1e-400",
    "7/3",
];

/// Rust's standard library has no erf, and rustc alone finds no crate: this one is not run in Rust.
const ERROR_FUNCTION: &str = "erf(s) - 2*erf(lambda/2)";

/// Names that are taken somewhere, of functions and of their parameters.
const TAKEN: &str = "double exp y0 expf index main NULL M_PI __LINE__ unix lesser \
    def None lambda lambda_ math abs _div float fn type f64 Ok _ self gen t1 LENGTH Upper a__b";

fn points() -> Vec<[f64; 2]> {
    let (infinity, nan) = (f64::INFINITY, f64::NAN);
    let special = [
        0.0, -0.0, 1.0, -1.0, 0.5, infinity, -infinity, nan, 1e-300, 5e-324, 1e308, -1e308, 710.0,
        -750.0, 1e22, -1e-17,
    ];
    let mut points = Vec::new();
    for (i, &x) in special.iter().enumerate() {
        points.push([x, special[(5 * i + 3) % special.len()]]);
        points.push([0.7, x]);
        points.push([x, -0.3]);
    }
    for i in 0..30 {
        let i = f64::from(i);
        points.push([0.61 * i - 5.0, 0.37 * i - 3.0]);
    }
    points
}

/// A program on the path, by the first of its names that is there.
fn tool(names: &[&str]) -> PathBuf {
    let path = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&path)
        .flat_map(|folder| names.iter().map(move |name| folder.join(name)))
        .find(|file| file.is_file())
        .unwrap_or_else(|| panic!("this test needs one of {names:?} on the PATH: install it"))
}

/// The rustc of the cargo that runs the test.
fn rustc() -> PathBuf {
    let beside_cargo = env::var_os("CARGO").map(|cargo| Path::new(&cargo).with_file_name("rustc"));
    match env::var_os("RUSTC") {
        Some(rustc) => rustc.into(),
        None => beside_cargo
            .filter(|file| file.is_file())
            .unwrap_or_else(|| tool(&["rustc"])),
    }
}

fn run(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Distance in units of the last place; two NaN are equal, and so are the zeros.
fn ulps(a: f64, b: f64) -> u64 {
    let ordered = |x: f64| {
        let bits = x.to_bits().cast_signed();
        if bits < 0 { i64::MIN - bits } else { bits }
    };
    match (a.is_nan(), b.is_nan()) {
        (true, true) => 0,
        (false, false) => ordered(a).abs_diff(ordered(b)),
        _ => u64::MAX,
    }
}

/// The programs in a language: its source, and the values that `run_there` gets from it, as bits, one
/// function after the other, compared with those of the programs.
fn compare(
    language: Language,
    expressions: &[&str],
    run_there: impl Fn(&Path, usize, &[[f64; 2]]) -> String,
) {
    let programs: Vec<Program> = expressions
        .iter()
        .map(|text| Program::new(&[text.parse().unwrap()], &INPUTS).unwrap())
        .collect();
    let taken: Vec<&str> = TAKEN.split_ascii_whitespace().collect();
    let exprs = taken.iter().map(|name| Expr::symbol(name).exp());
    let clashing = Program::new(&[Expr::sum(exprs)], &taken).unwrap();
    let names: Vec<String> = (0..programs.len()).map(|i| format!("f{i}")).collect();
    let ours = names.iter().zip(&programs).zip(expressions);
    let ours = ours.map(|((name, program), doc)| Definition { name, doc, program });
    let theirs = taken.iter().map(|name| Definition {
        name,
        doc: "",
        program: &clashing,
    });
    let definitions: Vec<Definition<'_>> = ours.chain(theirs).collect();
    let (two, third) = (Rational::from(2), Rational::from((1, 3)));
    let constants = [("LENGTH", &two), ("third", &third), ("if", &two)];
    let head = "Generated code. \\\n\n*/ \"\"\" ??/";

    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(match language {
        Language::C => "generated.c",
        Language::Python => "generated.py",
        Language::Rust => "generated.rs",
    });
    fs::write(&file, source(language, head, &constants, &definitions)).unwrap();
    let points = points();
    let output = run_there(folder.path(), programs.len(), &points);
    let values: Vec<f64> = output
        .split_ascii_whitespace()
        .map(|bits| f64::from_bits(u64::from_str_radix(bits, 16).unwrap()))
        .collect();
    assert_eq!(values.len(), programs.len() * points.len());

    let (mut worst, mut identical) = (0, 0);
    for ((program, text), values) in programs
        .iter()
        .zip(expressions)
        .zip(values.chunks(points.len()))
    {
        let bound = program.bind(Native::<f64>::new());
        for (&[lambda, s], &value) in points.iter().zip(values) {
            let expected = bound.at(&[&lambda, &s])[0];
            let distance = ulps(value, expected);
            assert!(
                distance <= 2,
                "{language}: {text} at lambda = {lambda:e}, s = {s:e}: {value:e} is not {expected:e}"
            );
            worst = worst.max(distance);
            let same = value.to_bits() == expected.to_bits();
            identical += usize::from(same || value.is_nan() && expected.is_nan());
        }
    }
    println!(
        "{language}: {identical} of {} values identical, at most {worst} ulp apart",
        values.len()
    );
}

/// `[[a, b], …]` in the brackets of a language, as bits.
fn table(points: &[[f64; 2]], open: char, close: char) -> String {
    let mut text = String::new();
    for [a, b] in points {
        let (a, b) = (a.to_bits(), b.to_bits());
        write!(text, "{open}{a:#x}, {b:#x}{close}, ").unwrap();
    }
    text
}

fn list(prefix: &str, count: usize) -> String {
    (0..count).fold(String::new(), |text, i| text + prefix + &format!("f{i}, "))
}

fn with_erf() -> Vec<&'static str> {
    EXPRESSIONS.into_iter().chain([ERROR_FUNCTION]).collect()
}

#[test]
fn c_computes_the_same() {
    compare(Language::C, &with_erf(), |folder, count, points| {
        let prototypes = list("double ", count).replace(", ", "(double, double);\n");
        let main = format!(
            "#include <inttypes.h>
#include <stdio.h>
#include <string.h>
{prototypes}
typedef double (*function)(double, double);
static const function functions[] = {{{}}};
static const uint64_t points[][2] = {{{}}};
int main(void) {{
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        for (size_t j = 0; j < sizeof points / sizeof *points; j++) {{
            double point[2], value;
            uint64_t bits;
            memcpy(point, points[j], sizeof point);
            value = functions[i](point[0], point[1]);
            memcpy(&bits, &value, sizeof bits);
            printf(\"%016\" PRIx64 \"\\n\", bits);
        }}
    return 0;
}}
",
            list("", count),
            table(points, '{', '}'),
        );
        fs::write(folder.join("main.c"), main).unwrap();
        let cc = tool(&["cc", "gcc", "clang"]);
        let strict = ["-Wall", "-Wextra", "-Werror", "-pedantic", "-O2"];
        run(Command::new(&cc)
            .current_dir(folder)
            .arg("-std=c99")
            .args(strict)
            .args(["main.c", "generated.c", "-o", "main", "-lm"]));
        if cfg!(target_arch = "x86_64") {
            // With GNU extensions, multiplications and additions are fused where nothing forbids it.
            let assembly = run(Command::new(&cc)
                .current_dir(folder)
                .arg("-std=gnu11")
                .args(strict)
                .args(["-mfma", "-S", "generated.c", "-o", "-"]));
            assert!(assembly.contains("mulsd") && !assembly.contains("vfm"));
        }
        run(&mut Command::new(folder.join("main")))
    });
}

#[test]
fn python_computes_the_same() {
    compare(Language::Python, &with_erf(), |folder, count, points| {
        let main = format!(
            "import struct
import generated
points = [{}]
for function in [{}]:
    for point in points:
        value = function(*struct.unpack('<dd', struct.pack('<QQ', *point)))
        print('%016x' % struct.unpack('<Q', struct.pack('<d', value)))
",
            table(points, '(', ')'),
            list("generated.", count)
        );
        fs::write(folder.join("main.py"), main).unwrap();
        let python = tool(&["python3"]);
        run(Command::new(python)
            .args(["-W", "error"])
            .arg(folder.join("main.py")))
    });
}

#[test]
fn rust_computes_the_same() {
    compare(Language::Rust, &EXPRESSIONS, |folder, count, points| {
        let main = format!(
            "fn main() {{
    let functions: [fn(f64, f64) -> f64; {count}] = [{}];
    let points: [[u64; 2]; {}] = [{}];
    for function in functions {{
        for point in points {{
            let [a, b] = point.map(f64::from_bits);
            println!(\"{{:016x}}\", function(a, b).to_bits());
        }}
    }}
}}
",
            list("generated::", count),
            points.len(),
            table(points, '[', ']'),
        );
        fs::write(folder.join("main.rs"), main).unwrap();
        let compile = || {
            let mut command = Command::new(rustc());
            command
                .current_dir(folder)
                .args(["--edition", "2021", "-D", "warnings", "-O"]);
            command
        };
        run(compile().args(["--crate-type", "rlib", "generated.rs"]));
        run(compile().args(["--extern", "generated=libgenerated.rlib", "main.rs"]));
        run(&mut Command::new(folder.join("main")))
    });
}
