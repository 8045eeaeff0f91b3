//! Recipes and what is found by them, on kernels that are recipes.

mod linear;
mod recipe;
mod words;

use volver::case::catalogue;
use volver::case::manufacture::manufacture;
use volver::case::{Case, Fresh, SymbolicCase};
use volver::diagnosis::{
    Accuracy, OpacityModel, Places, Ray, Recipe, Watched, WatchedLevel, fingerprint, likeness,
    radiance,
};
use volver::kernel::{Cut, Declaration, Subject};
use volver::method::Method;
use volver::real::{Mpfr, MpfrReal, Native, Real};

fn case(name: &str) -> SymbolicCase {
    let description = catalogue::find(name).unwrap().unwrap();
    manufacture(&description).unwrap().remove(0).case
}

fn subject(name: &str) -> Subject {
    Subject::new(name, vec![(None, case(name))]).unwrap()
}

fn watched(name: &str, ladder: &[u64], value: impl Fn(&Ray<f64>) -> f64) -> Watched {
    let subject = subject(name);
    let level = |n: &u64| {
        let segments = subject.segments(Cut::Segments(*n)).unwrap();
        let ray = Ray::new(&segments, 0, Native::<f64>::new());
        WatchedLevel {
            value: value(&ray),
            uniform: Some(*n),
            ray,
        }
    };
    let case = case(name);
    Watched {
        name: name.into(),
        scale: case.radiance(&1.0).unwrap_or(1.0).abs(),
        levels: ladder.iter().map(level).collect(),
        again: None,
        lookups: Vec::new(),
        case,
    }
}

fn of(recipe: Recipe) -> impl Fn(&Ray<f64>) -> f64 {
    move |ray| radiance(&recipe, ray, Native::<f64>::new())
}

/// Recipes that are methods give what the methods give, in many bits.
#[test]
fn recipes_are_the_methods_that_they_stand_for() {
    let format = Mpfr { bits: 200 };
    for name in [
        "front-to-back/front/expm1",
        "front-to-back/middle/expm1",
        "tree/back/relative",
        "front-to-back/front/linear",
        "back-to-front/middle/linear",
        "front-to-back/back/linear/depths",
        "front-to-back/front/expm1/stop=1:2",
        "trapezoid/trapezoid",
        "riemann-left/riemann-left",
        "riemann-left/riemann-left/linear",
    ] {
        let method: Method = name.parse().unwrap();
        let recipe = Recipe::of_method(&method).unwrap();
        // The case's numbers in binary64 are what both start from: here they are the same to that many bits.
        let segments = subject("thick").segments(Cut::Segments(16)).unwrap();
        let ray: Ray<MpfrReal> = Ray::new(&segments, 0, format);
        let by_recipe = radiance(&recipe, &ray, format).to_float();
        let thick = case("thick");
        let by_method = method.radiance(&Fresh::new(&thick, format), 16).unwrap();
        let error = (by_recipe - by_method.to_float()).abs();
        assert!(error < 1e-14, "{name}: {error}");
    }
}

/// Where C and τ are linear, linear segments are exact.
#[test]
fn linear_segments_are_exact_on_a_linear_medium() {
    let subject = subject("linear-transfer");
    let exact: f64 = case("linear-transfer").radiance(&2.0).unwrap();
    let segments = subject.segments(Cut::Segments(4)).unwrap();
    let ray: Ray<f64> = Ray::new(&segments, 0, Native::<f64>::new());
    let recipe = Recipe {
        places: Places::Linear,
        ..Recipe::default()
    };
    let error = radiance(&recipe, &ray, Native::<f64>::new()) - exact;
    assert!(error.abs() < 1e-14, "{error}");
}

#[test]
fn an_error_is_like_the_defect_that_makes_it() {
    let ladder = [8, 16, 32, 64, 128, 256, 512];
    let skipped = Recipe {
        opacity: OpacityModel::SkippedUnder {
            threshold: 1e-4,
            length: 1.0,
        },
        ..Recipe::default()
    };
    // Rounded to four digits, no model reproduces the values any more.
    let coarse = |value: f64| format!("{value:.3e}").parse::<f64>().unwrap();
    let faint = watched("faint", &ladder, |ray| coarse(of(skipped)(ray)));
    let found = likeness(&faint, 1.499_99e-5).unwrap();
    assert!(matches!(
        found.recipe.opacity,
        OpacityModel::SkippedUnder { .. } | OpacityModel::Uncorrected { .. }
    ));
    assert!(
        found
            .recipe
            .defect()
            .contains("correction for the step skipped")
    );
    // An error that compositing makes anyway needs no defect.
    let sound = watched("faint", &ladder, |ray| coarse(of(Recipe::default())(ray)));
    assert_eq!(likeness(&sound, 1.499_99e-5), None);
}

#[test]
fn what_no_model_computes_is_not_named() {
    let ladder = [8, 16, 32, 64];
    let names = [
        "thick",
        "cloud",
        "sine-squared",
        "emission-bump",
        "emission-back",
    ];
    let all: Vec<Watched> = names
        .iter()
        .enumerate()
        .map(|(k, name)| {
            let wrong = 1.0 + 0.01 * (k as f64 + 1.0).sqrt();
            watched(name, &ladder, |ray| {
                wrong * of(Recipe::default())(ray) + 1e-3
            })
        })
        .collect();
    let declaration = Declaration {
        method: Some("front-to-back/front/expm1".parse().unwrap()),
        ..Declaration::new("wrong")
    };
    let found = fingerprint(&all, &declaration, Accuracy::new(0.0, 0.0));
    assert!(!found.is_named(), "{:?}", found.best);
    assert!(found.contradicts_declaration());
}
