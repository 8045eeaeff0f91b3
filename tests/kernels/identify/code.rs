//! A rule printed as a program computes what the rule does.

use super::random::Random;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::fs;
use std::process::Command;
use volver::case::catalogue;
use volver::case::manufacture::manufacture;
use volver::identify::Rule;
use volver::kernel::process::{Options, ProcessKernel};
use volver::kernel::{Cut, Data, Kernel, Samples, Segments, Subject, Task};
use volver::real::Native;

const RULES: u64 = 250;

/// Rules, each with rays.
fn trials() -> Vec<(Rule, Vec<(Segments, f64)>)> {
    let trial = |seed| {
        let mut random = Random::new(seed);
        let rule = random.rule();
        let rays = [1, 2, 3, 4, 9, 18].map(|n| random.ray(n));
        (rule, rays.into())
    };
    (0..RULES).map(trial).collect()
}

/// The answers agree with those of the rule.
fn assert_agree(rule: &Rule, (ray, step): &(Segments, f64), answers: &[f64], code: &str) {
    let format = Native::<f64>::new();
    let expected = rule.answers(ray, *step, format);
    // Emissions are at most 2; weights of both signs may cancel.
    let composed = rule.composed(ray, *step, format);
    let weights: f64 = composed.terms.iter().map(|(_, weight)| weight.abs()).sum();
    let scale = 1.0 + composed.factor.abs() * (2.0 * weights + composed.passes.abs());
    assert_eq!(expected.len(), answers.len());
    for (expected, got) in expected.iter().zip(answers) {
        let is_near = (expected - got).abs() <= 2e-12 * (scale + expected.abs());
        assert!(
            is_near || expected.total_cmp(got).is_eq() || (expected.is_nan() && got.is_nan()),
            "{got} is not {expected}\n{rule:?}\n{code}\n{ray:?}"
        );
    }
}

fn task((ray, step): &(Segments, f64)) -> Value {
    let samples = |samples: &Samples| {
        json!({
            "lambda": samples.lambda,
            "extinction": samples.extinction,
            "emission": samples.emission,
        })
    };
    json!({
        "channels": ["a", "b", "c", "d", "e"],
        "length": ray.edges.lambda.last(),
        "step": step,
        "segments": ray.count(),
        "seed": 0,
        "data": {
            "form": "segments",
            "edges": samples(&ray.edges),
            "middles": samples(&ray.middles),
        },
    })
}

#[test]
fn in_python_rules_compute_what_they_do_here() {
    let folder = tempfile::tempdir().unwrap();
    let trials = trials();
    for (k, (rule, _)) in trials.iter().enumerate() {
        fs::write(folder.path().join(format!("rule{k}.py")), rule.python()).unwrap();
    }
    let rays: Vec<Vec<Value>> = trials
        .iter()
        .map(|(_, rays)| rays.iter().map(task).collect())
        .collect();
    fs::write(folder.path().join("rays.json"), json!(rays).to_string()).unwrap();
    let program = "\
import importlib, json
for k, rays in enumerate(json.load(open('rays.json'))):
    rule = importlib.import_module(f'rule{k}')
    answers = []
    for task in rays:
        try:
            answers.append([repr(float(x)) for x in rule.render(task)])
        except (OverflowError, ValueError, ZeroDivisionError):
            answers.append([])
    print(json.dumps(answers))
";
    let run = Command::new("python3")
        .env("PYTHONPATH", folder.path())
        .current_dir(&folder)
        .args(["-c", program])
        .output();
    let Ok(run) = run else {
        eprintln!("skipped: there is no python3 on the PATH");
        return;
    };
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}");
    let lines = String::from_utf8(run.stdout).unwrap();
    assert_eq!(lines.lines().count(), trials.len());
    let mut raised = 0;
    for (line, (rule, rays)) in lines.lines().zip(&trials) {
        let answers: Vec<Vec<String>> = serde_json::from_str(line).unwrap();
        for (ray, answers) in rays.iter().zip(&answers) {
            let answers: Vec<f64> = answers.iter().map(|x| x.parse().unwrap()).collect();
            // Python raises an error where others have an infinity.
            if answers.is_empty() {
                raised += 1;
                continue;
            }
            assert_agree(rule, ray, &answers, &rule.python());
        }
    }
    assert!(raised <= 6 * RULES / 50, "{raised} rays raise an error");
}

/// Arrays of a ray as literals, and the calls that print what a function makes of its channels.
fn calls((ray, step): &(Segments, f64), function: &str) -> String {
    let array = |name: &str, values: &[f64]| {
        let values: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
        format!("static const double {name}[] = {{{}}};\n", values.join(","))
    };
    let mut code = String::from("{\n");
    code += &array("lam", &ray.edges.lambda);
    code += &array("te", &ray.edges.extinction);
    code += &array("tm", &ray.middles.extinction);
    for (k, (ce, cm)) in ray
        .edges
        .emission
        .iter()
        .zip(&ray.middles.emission)
        .enumerate()
    {
        code += &array(&format!("ce{k}"), ce);
        code += &array(&format!("cm{k}"), cm);
        let n = ray.count();
        writeln!(
            code,
            "printf(\"%.17g\\n\", {function}(lam, te, tm, ce{k}, cm{k}, {n}, {step:?}));"
        )
        .unwrap();
    }
    code + "}\n"
}

#[test]
fn in_c_rules_compute_what_they_do_here() {
    let folder = tempfile::tempdir().unwrap();
    let trials = trials();
    let mut source = String::from("#include <stdio.h>\n");
    let mut main = String::from("int main(void) {\n");
    for (k, (rule, rays)) in trials.iter().enumerate() {
        let names = ["radiance", "emission", "rounded", "linear"];
        for name in names {
            writeln!(source, "#define {name} {name}_{k}").unwrap();
        }
        source += &rule.c();
        for name in names {
            writeln!(source, "#undef {name}").unwrap();
        }
        for ray in rays {
            main += &calls(ray, &format!("radiance_{k}"));
        }
    }
    let path = folder.path().join("rules.c");
    fs::write(&path, source + &main + "return 0;\n}\n").unwrap();
    let program = folder.path().join("rules");
    let compiler = Command::new("cc")
        .args([
            "-std=c99",
            "-pedantic",
            "-Wall",
            "-Werror",
            "-ffp-contract=off",
        ])
        .arg(&path)
        .arg("-o")
        .arg(&program)
        .arg("-lm")
        .output();
    let Ok(compiler) = compiler else {
        eprintln!("skipped: there is no compiler cc on the PATH");
        return;
    };
    let said = String::from_utf8_lossy(&compiler.stderr);
    assert!(compiler.status.success(), "{said}");
    let run = Command::new(program).output().unwrap();
    assert!(run.status.success());
    let lines = String::from_utf8(run.stdout).unwrap();
    let mut lines = lines.lines().map(|line| line.parse::<f64>().unwrap());
    for (rule, rays) in &trials {
        for ray in rays {
            let of_channels: Vec<f64> = lines.by_ref().take(5).collect();
            let mut answers = vec![f64::NAN; 5];
            for (k, answer) in of_channels.into_iter().enumerate() {
                answers[rule.channels.place(k, 5)] = answer;
            }
            assert_agree(rule, ray, &answers, &rule.c());
        }
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn in_python_a_rule_is_a_kernel() {
    if Command::new("python3").arg("--version").output().is_err() {
        eprintln!("skipped: there is no python3 on the PATH");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let clients = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/kernels");
    let rule = Random::new(5).rule();
    let path = folder.path().join("rule.py");
    let serve = format!(
        "import sys\nsys.path.append({clients:?})\nimport volver_kernel\n\
         volver_kernel.serve({{'name': 'read off', 'form': 'segments'}}, render)\n"
    );
    fs::write(&path, rule.python() + &serve).unwrap();
    let arguments = [path.to_str().unwrap().to_string()];
    let mut kernel = ProcessKernel::start("python3", &arguments, Options::default()).unwrap();
    let description = catalogue::find("rgb-transfer").unwrap().unwrap();
    let channels = manufacture(&description).unwrap();
    let channels = channels.into_iter().map(|c| (c.channel, c.case)).collect();
    let subject = Subject::new("rgb-transfer", channels).unwrap();
    let segments = subject.segments(Cut::Segments(8)).unwrap();
    let step = subject.length().to_f64() / 8.0;
    let task = Task {
        subject: &subject,
        step,
        segments: 8,
        seed: 0,
        data: Data::Segments(&segments),
    };
    let rendering = kernel.render(&task).unwrap();
    let answers: Vec<f64> = rendering.radiance.iter().map(rug::Float::to_f64).collect();
    assert_agree(&rule, &(segments, step), &answers, &rule.python());
}
