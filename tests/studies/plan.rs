//! Plans of random scenes: always within their tolerance, and never much dearer than what can be found by search.

mod certify;
mod choose;
mod long;
mod scenes;
mod smooth;
mod thick;
mod uniform;

use rayon::prelude::*;
use rug::Float;
use scenes::Generator;
use std::path::Path;
use uniform::Uniform;
use volver::scene::{self, Form, Scene};
use volver::study::plan::{Plan, scene_radiance};

const TOLERANCES: [f64; 9] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];

fn read(text: &str) -> Scene {
    scene::read(text, Path::new(".")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn plan(scene: &Scene, tolerance: f64, text: &str) -> Plan {
    Plan::for_scene(scene, tolerance).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Scenes, each of its own seed.
fn texts(count: u64, channels: usize, background: bool) -> Vec<String> {
    let text = |seed| Generator::new(seed).scene(channels, background);
    (0..count).map(text).collect()
}

/// The largest error of a plan, run in its own format.
fn error(plan: &mut Plan) -> f64 {
    let checked = plan.check().unwrap();
    checked
        .channels
        .iter()
        .map(|channel| channel.error)
        .fold(0.0, f64::max)
}

fn within_tolerance(texts: &[String]) {
    texts.par_iter().for_each(|text| {
        let scene = read(text);
        for tolerance in TOLERANCES {
            let mut plan = plan(&scene, tolerance, text);
            let claimed = plan.stored().uncertainty.total();
            let error = error(&mut plan);
            assert!(claimed <= tolerance, "{claimed} > {tolerance}:\n{text}");
            assert!(
                error <= claimed,
                "{error} > {claimed} for {tolerance}:\n{text}"
            );
        }
    });
}

#[test]
fn radiances_are_within_what_the_plan_says_and_that_is_within_the_tolerance() {
    within_tolerance(&texts(60, 1, true));
    within_tolerance(&texts(15, 3, true));
}

/// What a plan costs beside the cheapest uniform method there is.
struct Compared {
    planned: u64,
    media: u64,
    /// The fewest evaluations of a uniform method that is within the tolerance; none up to the limit of the search.
    uniform: Option<u64>,
}

fn compared(text: &str) -> Vec<Compared> {
    let scene = read(text);
    let exact = scene_radiance(&scene, 60).unwrap().remove(0);
    let uniform = Uniform::new(&scene);
    let media = scene.media().len() as u64;
    let one = |tolerance| {
        let planned = plan(&scene, tolerance, text).evaluations();
        // Beyond three times the plan's evaluations nothing else is to be known.
        let limit = 3 * planned.max(1);
        let uniform = uniform.cheapest(limit, |radiance| {
            let error = Float::with_val(64, &exact - radiance).abs();
            error <= tolerance
        });
        Compared {
            planned,
            media,
            uniform,
        }
    };
    TOLERANCES.map(one).into()
}

fn cheaper_than_uniform(texts: &[String]) {
    let all: Vec<Compared> = texts.par_iter().flat_map(|text| compared(text)).collect();
    // Never above twice the best uniform method and eight evaluations a medium.
    let beyond: Vec<(u64, u64)> = all
        .iter()
        .filter_map(|one| Some((one.planned, 2 * one.uniform? + 8 * one.media)))
        .filter(|(planned, allowed)| planned > allowed)
        .collect();
    // The median of planned/uniform is at most a third where at least half of them are.
    let third = |one: &&Compared| one.uniform.is_none_or(|uniform| 3 * one.planned <= uniform);
    let cheap = all.iter().filter(third).count();
    let mut ratios: Vec<f64> = all
        .iter()
        .filter_map(|one| Some(one.planned as f64 / one.uniform? as f64))
        .collect();
    ratios.sort_by(f64::total_cmp);
    println!(
        "{} plans, {cheap} at most a third of the best uniform method; the others: median {:?}, worst {:?}",
        all.len(),
        ratios.get(ratios.len() / 2),
        ratios.last()
    );
    assert!(2 * cheap >= all.len(), "{cheap} of {}", all.len());
    assert!(beyond.is_empty(), "planned, and allowed: {beyond:?}");
}

#[test]
fn plans_cost_a_third_of_the_best_uniform_method_and_never_much_more_than_it() {
    cheaper_than_uniform(&texts(60, 1, false));
}

#[test]
#[ignore = "takes minutes"]
fn a_thousand_scenes_are_within_their_tolerances() {
    within_tolerance(&texts(1000, 1, true));
}

#[test]
#[ignore = "takes minutes"]
fn a_thousand_plans_are_cheap() {
    cheaper_than_uniform(&texts(1000, 1, false));
}

#[test]
fn what_is_empty_or_constant_takes_one_evaluation_a_medium_at_most() {
    let mut seen = 0;
    for text in texts(400, 1, true) {
        let scene = read(&text);
        let pieces = || scene.media().iter().flat_map(|medium| &medium.pieces);
        let is_simple = |form: &Form| matches!(form, Form::Vacuum | Form::Constant(_));
        let one_each = scene.media().iter().all(|medium| medium.pieces.len() == 1);
        if !one_each || !pieces().all(|piece| is_simple(&piece.form)) {
            continue;
        }
        seen += 1;
        let constant = pieces().filter(|piece| matches!(piece.form, Form::Constant(_)));
        let constant = constant.count() as u64;
        for tolerance in TOLERANCES {
            let plan = plan(&scene, tolerance, &text);
            assert!(plan.evaluations() <= constant, "{text}");
        }
    }
    assert!(seen >= 10, "{seen}");
}
