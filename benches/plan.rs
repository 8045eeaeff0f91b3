//! What it costs to plan: scenes of 12 media, read before.

#![allow(clippy::expect_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;
use volver::scene::{self, Scene};
use volver::study::plan::Plan;

/// Twelve media, one after the other of these kinds.
fn scene(kinds: &[&str]) -> Scene {
    let mut text = String::new();
    for i in 0..12 {
        let kind = kinds[i % kinds.len()];
        writeln!(text, "[[media]]\nfrom = {i}\nto = {}\n{kind}", i + 1).expect("a text");
    }
    scene::read(&text, Path::new(".")).expect("a scene")
}

const CONSTANT: &str = "kind = 'constant'\nextinction = 0.3\nemission = 0.5";
const VACUUM: &str = "kind = 'vacuum'";
const LINEAR: &str =
    "kind = 'linear'\nextinction = {front = 0, back = 0.6}\nemission = {front = 1, back = 0.2}";
const WAVES: &str =
    "kind = 'expression'\nextinction = '(1 + sin(7*lambda))/5'\nemission = '(1 + cos(3*lambda))/2'";
const KINK: &str =
    "kind = 'expression'\nextinction = 'max(0.2, sin(4*lambda))'\nemission = 'exp(-lambda/5)'";
const BUMP: &str =
    "kind = 'expression'\nextinction = 'exp(-(lambda - 6)^2)'\nemission = '1/(1 + lambda^2)'";
const SAMPLED: &str = "kind = 'sampled'\nsamples = [0.1, 0.9, 0.4, 0.3, 0.7, 0.2, 0.8, 0.5, 0.6]\nextinction = 's/2'\nemission = '1 - s'";

fn plans(criterion: &mut Criterion) {
    let mixed = [CONSTANT, WAVES, VACUUM, LINEAR, KINK, SAMPLED, BUMP];
    let scenes = [
        ("simple", scene(&[CONSTANT, VACUUM, LINEAR])),
        ("mixed", scene(&mixed)),
        ("waves", scene(&[WAVES])),
    ];
    let mut group = criterion.benchmark_group("plan of 12 media");
    for (name, scene) in &scenes {
        for tolerance in [1e-2, 1e-4, 1e-6, 1e-10] {
            group.bench_function(format!("{name}, {tolerance:e}"), |bencher| {
                bencher.iter(|| Plan::for_scene(black_box(scene), tolerance).expect("a plan"));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, plans);
criterion_main!(benches);
