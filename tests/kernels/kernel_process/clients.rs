//! Kernels that are meant to be copied: they compute what they say.

use super::fixture::{segments, subject, task};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;
use volver::case::Fresh;
use volver::kernel::process::{Options, ProcessKernel, schema};
use volver::kernel::{Kernel, KernelError, Rendering, Subject};
use volver::method::Method;
use volver::real::Native;

const CASES: [&str; 4] = [
    "sine-squared",
    "rgb-transfer",
    "homogeneous",
    "jump-off-node",
];

fn in_repository(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    path.to_str().unwrap().into()
}

fn python(script: &str, options: &[&str]) -> ProcessKernel {
    let mut arguments = vec![script.to_string()];
    arguments.extend(options.iter().map(ToString::to_string));
    ProcessKernel::start("python3", &arguments, Options::default()).unwrap()
}

fn render(kernel: &mut ProcessKernel, subject: &Subject, n: u64) -> Rendering {
    kernel
        .render(&task(subject, &segments(subject, n)))
        .unwrap()
}

/// Its radiances are those of the method, in binary64.
fn assert_is(kernel: &mut ProcessKernel, method: &str) {
    let method: Method = method.parse().unwrap();
    let cases = CASES.map(subject);
    for subject in &cases {
        for n in [1, 8, 37, 512] {
            let rendering = render(kernel, subject, n);
            for (radiance, case) in rendering.radiance.iter().zip(subject.cases()) {
                let nodes = Fresh::new(case, Native::<f64>::new());
                let own = method.radiance(&nodes, n).unwrap();
                let difference = (radiance.to_f64() - own).abs();
                assert!(
                    difference <= 1e-13 * own.abs(),
                    "{} {n}: {radiance} {own}",
                    subject.name()
                );
            }
        }
    }
}

#[test]
fn nerf_is_compositing_as_it_declares() {
    let script = in_repository("examples/kernels/nerf.py");
    for (options, method) in [
        (&[][..], "front-to-back/front/subtraction"),
        (
            &["--sampling", "middle"],
            "front-to-back/middle/subtraction",
        ),
    ] {
        let mut kernel = python(&script, options);
        let declaration = kernel.declaration();
        assert_eq!(declaration.name, "nerf");
        assert_eq!(declaration.method.unwrap().name(), method);
        assert!(!declaration.far_wall);
        assert_is(&mut kernel, method);
    }
}

/// Rays of different n, each alone and all at once, are the method's, and the same to the bit.
fn assert_together(kernel: &mut ProcessKernel, method: &str) {
    assert_is(kernel, method);
    let subject = subject("rgb-transfer");
    let cuts = [512, 1, 37, 8].map(|n| segments(&subject, n));
    let tasks = cuts.each_ref().map(|cut| task(&subject, cut));
    let together = kernel.render_together(&tasks).unwrap();
    for (task, among) in tasks.iter().zip(together) {
        assert_eq!(kernel.render(task), among);
    }
}

#[test]
fn many_rays_at_once_are_arrays_to_a_kernel_in_python() {
    let directory = tempfile::tempdir().unwrap();
    let script = directory.path().join("kernel.py");
    let code = "
import math, sys
sys.path.insert(0, sys.argv[1])
import volver_kernel
def render(frame):
    found = []
    for ray in range(frame['rays']):
        depth, radiance = 0.0, [0.0 for _ in frame['channels']]
        for i in range(frame['offsets'][ray], frame['offsets'][ray + 1]):
            length = frame['edges_lambda'][i + ray + 1] - frame['edges_lambda'][i + ray]
            own = frame['middles_extinction'][i] * length
            weight, depth = math.exp(-depth) * -math.expm1(-own), depth + own
            radiance = [r + weight * frame['middles_emission'][k, i] for k, r in enumerate(radiance)]
        found.append(radiance)
    if frame['cases'] == ['homogeneous'] and frame['offsets'][-1] == 7:
        raise ValueError('seven')
    return {'radiance': found}
volver_kernel.serve({'name': 'mine', 'form': 'segments', 'batch': 9}, render)
";
    fs::write(&script, code).unwrap();
    let examples = in_repository("examples/kernels");
    let mut kernel = python(script.to_str().unwrap(), &[&examples]);
    assert_together(&mut kernel, "front-to-back/middle/expm1");
    let homogeneous = subject("homogeneous");
    let seven = kernel.render(&task(&homogeneous, &segments(&homogeneous, 7)));
    let reason = "ValueError: seven".into();
    assert_eq!(seven, Err(KernelError::Refused { reason }));
}

#[test]
fn gradients_of_a_kernel_that_takes_frames_go_as_text() {
    let directory = tempfile::tempdir().unwrap();
    let script = directory.path().join("kernel.py");
    let code = "
import sys
sys.path.insert(0, sys.argv[1])
import volver_kernel
def render(asked):
    if 'rays' in asked:
        return {'radiance': [[1.0]] * asked['rays']}
    [a], n = asked['cotangents'], asked['segments']
    return {'radiance': [2.0], 'gradient': {'extinction': [a] * n, 'emission': [[-a] * n]}}
volver_kernel.serve({'name': 'mine', 'form': 'segments', 'batch': 9, 'gradient': 'middles'}, render)
";
    fs::write(&script, code).unwrap();
    let examples = in_repository("examples/kernels");
    let mut kernel = python(script.to_str().unwrap(), &[&examples]);
    let subject = subject("homogeneous");
    let cut = segments(&subject, 3);
    let task = task(&subject, &cut);
    for _ in 0..2 {
        assert_eq!(kernel.render(&task).unwrap().radiance, [1.0]);
        let (rendering, gradient) = kernel.gradient(&task, &[5.0]).unwrap();
        assert_eq!(rendering.radiance, [2.0]);
        assert_eq!(gradient.extinction, [5.0; 3]);
        assert_eq!(gradient.emission, [[-5.0; 3]]);
    }
}

#[test]
fn batched_is_compositing_as_it_declares() {
    let numpy = Command::new("python3")
        .args(["-c", "import numpy"])
        .status();
    if !numpy.is_ok_and(|status| status.success()) {
        // `make kernels` installs it, and has this kernel always.
        eprintln!("NumPy is not installed: batched.py is left out");
        return;
    }
    let script = in_repository("examples/kernels/batched.py");
    assert_together(&mut python(&script, &[]), "front-to-back/middle/expm1");
}

#[test]
fn the_far_wall_of_nerf_adds_what_stands_behind() {
    let script = in_repository("examples/kernels/nerf.py");
    let mut free = python(&script, &[]);
    let mut walled = python(&script, &["--far-wall"]);
    assert!(walled.declaration().far_wall);
    let subject = subject("homogeneous");
    let [free, walled] = [&mut free, &mut walled].map(|kernel| render(kernel, &subject, 64));
    assert!(walled.radiance[0].clone() - &free.radiance[0] > 1e-3);
}

#[test]
fn the_client_of_the_document_works() {
    let document = fs::read_to_string(in_repository("docs/protocol.md")).unwrap();
    let (_, rest) = document.split_once("```python\n").unwrap();
    let (code, _) = rest.split_once("```").unwrap();
    let directory = tempfile::tempdir().unwrap();
    let script = directory.path().join("client.py");
    fs::write(&script, code).unwrap();
    let mut kernel = python(script.to_str().unwrap(), &[]);
    assert_is(&mut kernel, "front-to-back/front/subtraction");
}

#[test]
fn the_document_names_every_key_of_the_schema() {
    fn keys(schema: &Value, found: &mut Vec<String>) {
        if let Some(properties) = schema["properties"].as_object() {
            found.extend(properties.keys().cloned());
        }
        let parts = schema.as_object().into_iter().flat_map(|all| all.values());
        let items = schema.as_array().into_iter().flatten();
        parts.chain(items).for_each(|part| keys(part, found));
    }
    let document = fs::read_to_string(in_repository("docs/protocol.md")).unwrap();
    let mut found = Vec::new();
    keys(&schema(), &mut found);
    assert!(found.len() > 40, "{found:?}");
    for key in found {
        let named = [format!("`{key}`"), format!("{{\"{key}\":")];
        assert!(named.iter().any(|name| document.contains(name)), "{key}");
    }
}

#[test]
fn nerf_started_by_hand_says_how() {
    let mut command = assert_cmd::Command::new("python3");
    command
        .arg(in_repository("examples/kernels/nerf.py"))
        .env_remove("VOLVER_PROTOCOL")
        .assert()
        .code(1)
        .stderr(predicates::str::starts_with(
            "started by volver alone: volver verify python3 ",
        ));
}

#[test]
fn what_a_python_kernel_raises_is_that_tasks_error_and_what_is_not_finite_comes_through() {
    let directory = tempfile::tempdir().unwrap();
    let script = directory.path().join("kernel.py");
    let code = "
import sys
sys.path.insert(0, sys.argv[1])
import volver_kernel
def render(task):
    print('rendering')
    if task['segments'] == 7:
        raise ValueError('seven')
    return {'radiance': [float('nan')], 'opacity': float('-inf'), 'segments': task['segments']}
volver_kernel.serve({'name': 'mine', 'form': 'segments', 'arrays': 'json'}, render)
";
    fs::write(&script, code).unwrap();
    let examples = in_repository("examples/kernels");
    let mut kernel = python(script.to_str().unwrap(), &[&examples]);
    let subject = subject("homogeneous");
    let cuts = [6, 7, 8].map(|n| segments(&subject, n));
    let tasks = cuts.each_ref().map(|cut| task(&subject, cut));
    let results = kernel.render_all(&tasks);
    let reason = "ValueError: seven".into();
    assert_eq!(results[1], Err(KernelError::Refused { reason }));
    for (result, n) in [(&results[0], 6), (&results[2], 8)] {
        let rendering = result.as_ref().unwrap();
        assert!(rendering.radiance[0].is_nan());
        assert_eq!(*rendering.opacity.as_ref().unwrap(), f64::NEG_INFINITY);
        assert_eq!(rendering.segments, Some(n));
    }
}
