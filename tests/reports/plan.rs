//! Plans: the steps, the arithmetic of their bounds, and the radiance beside the exact one.

use std::path::Path;
use volver::document::{About, Block, Document, Tone};
use volver::real::Native;
use volver::render::{markdown, terminal};
use volver::report::plan::{Rendering, document};
use volver::scene::{Scene, read};
use volver::study::plan::{Plan, StoredPlan};

fn about() -> About {
    About::new(["volver", "plan"])
}

fn smoke() -> Scene {
    let path = Path::new("examples/scenes");
    let text = std::fs::read_to_string(path.join("smoke.toml")).unwrap();
    read(&text, path).unwrap()
}

fn planned(scene: &Scene, tolerance: f64) -> Plan {
    let mut plan = Plan::for_scene(scene, tolerance).unwrap();
    plan.check().unwrap();
    plan
}

/// The same plan, of which something else is on record.
fn altered(plan: &Plan, change: impl FnOnce(&mut StoredPlan)) -> Plan {
    let mut stored = plan.stored().clone();
    change(&mut stored);
    Plan::from_stored(plan.scene(), stored).unwrap()
}

fn said(plan: &Plan, explain: bool, width: usize) -> String {
    terminal(&document(plan, explain, &about()), width, false)
}

#[test]
fn a_terminal_has_the_steps_and_with_explanations_the_arithmetic() {
    let plan = planned(&smoke(), 1e-4);
    let steps = &plan.stored().steps;
    let plain = said(&plan, false, 80);
    let head: Vec<&str> = plain.lines().nth(1).unwrap().split_whitespace().collect();
    assert_eq!(head, ["medium", "from", "to", "model", "bound"]);
    let explained = said(&plan, true, 80);
    for text in [&plain, &explained] {
        assert!(
            text.lines().all(|line| line.chars().count() <= 80),
            "{text}"
        );
        for row in ["  air behind  ", "  plume  ", "collocation, "] {
            assert!(text.contains(row), "{text}");
        }
        assert!(text.contains("\nError ≤ "), "{text}");
    }
    let count = |text: &str, words: &str| text.matches(words).count();
    assert_eq!(count(&plain, "what lies between"), 0, "{plain}");
    assert_eq!(count(&plain, " x ("), 0, "{plain}");
    assert_eq!(count(&explained, " x ("), steps.len(), "{explained}");
    assert!(
        explained.contains("\n    what lies between the points\n"),
        "{explained}"
    );
    // Every reason stands below its step, and in writing in its row.
    let written = markdown(&document(&plan, false, &about()));
    assert!(
        written.contains("| left out | T (ΔE + ΔT R) |"),
        "{written}"
    );
    assert_eq!(count(&written, " x ("), steps.len(), "{written}");
}

#[test]
fn what_more_points_err_by_is_counted() {
    let plan = planned(&smoke(), 1e-4);
    let plan = altered(&plan, |stored| stored.steps[2].bound *= 2.0);
    let text = said(&plan, true, 80);
    let row = |line: &&str| line.trim_start().starts_with("counted as ");
    let counted: Vec<&str> = text.lines().filter(row).collect();
    let [counted] = counted[..] else {
        panic!("{text}");
    };
    assert!(counted.ends_with(": more points err by that"), "{text}");
    let bound: f64 = counted
        .split([' ', ':'])
        .find_map(|word| word.parse().ok())
        .unwrap();
    let exact = plan.stored().steps[2].bound;
    assert!(bound >= exact && bound < 1.1 * exact, "{bound} {exact}");
}

#[test]
fn errors_are_judged_by_the_tolerance() {
    let plan = planned(&smoke(), 1e-4);
    let of = |plan: &Plan| document(plan, false, &about());
    let tones = |document: &Document| {
        let judged = document.summary.iter().filter_map(|fact| fact.tone);
        judged.collect::<Vec<Tone>>()
    };
    assert_eq!(tones(&of(&plan)), [Tone::Good; 3]);
    assert_eq!(of(&plan).conclusion.unwrap().tone, Some(Tone::Good));
    let text = said(&plan, false, 80);
    for channel in ["red", "green", "blue"] {
        assert!(
            text.contains(&format!("\n* {channel}: within the tolerance, error ")),
            "{text}"
        );
    }
    let last = text.lines().last().unwrap();
    assert!(
        last.starts_with("smoke: tolerance 1e-4, ") && last.ends_with(", in f32"),
        "{last}"
    );

    let beyond = altered(&plan, |stored| {
        stored.checked.as_mut().unwrap().channels[1].error = 2e-4;
    });
    assert_eq!(tones(&of(&beyond)), [Tone::Good, Tone::Bad, Tone::Good]);
    assert_eq!(of(&beyond).conclusion.unwrap().tone, Some(Tone::Bad));
    let text = said(&beyond, false, 80);
    assert!(
        text.contains("\n! green: BEYOND the tolerance, error 2.0e-4: "),
        "{text}"
    );

    // What is not a number is not within it.
    let lost = altered(&plan, |stored| {
        stored.checked.as_mut().unwrap().channels[0].error = f64::NAN;
    });
    assert_eq!(of(&lost).conclusion.unwrap().tone, Some(Tone::Bad));

    let unchecked = altered(&plan, |stored| stored.checked = None);
    assert!(!said(&unchecked, false, 80).contains("the tolerance"));
    assert_eq!(of(&unchecked).conclusion.unwrap().tone, None);
    assert_eq!(tones(&of(&unchecked)), []);
}

#[test]
fn long_numbers_are_cut_on_a_terminal_and_whole_in_writing() {
    let plan = planned(&smoke(), 1e-25);
    let channel = &plan.stored().checked.as_ref().unwrap().channels[0];
    let longer = channel.radiance.len() > channel.reference.len() + 2;
    assert!(longer, "{channel:?}");
    let text = said(&plan, false, 300);
    assert!(!text.contains(&channel.radiance), "{text}");
    let kept = &channel.radiance[..channel.reference.len()];
    assert!(text.contains(kept) && text.contains("..."), "{text}");
    let written = markdown(&document(&plan, false, &about()));
    for digits in [&channel.radiance, &channel.reference] {
        assert!(written.contains(&format!(" {digits} |")), "{written}");
    }
}

#[test]
fn a_terminal_shows_sixty_steps_and_says_how_many_there_are() {
    let medium = |i: u32| {
        let to = i + 1;
        let (kind, values) = match i % 2 {
            0 => ("vacuum", ""),
            _ => ("constant", "extinction = 0.1\nemission = 1\n"),
        };
        format!(
            "[[media]]\nname = 'medium-{i:02}'\nfrom = {i}\nto = {to}\nkind = '{kind}'\n{values}"
        )
    };
    let text: String = (0..62).map(medium).collect();
    let plan = planned(&read(&text, Path::new(".")).unwrap(), 1e-6);
    assert_eq!(plan.stored().steps.len(), 62);
    let text = said(&plan, false, 80);
    assert!(
        text.contains("medium-59") && !text.contains("medium-60"),
        "{text}"
    );
    assert!(text.contains("\n  … and 2 rows more\n"), "{text}");
    assert!(markdown(&document(&plan, false, &about())).contains("| medium-61 |"));
}

#[test]
fn where_a_ray_may_end_is_said() {
    let plan = planned(&smoke(), 1e-4);
    let words = "The ray may end at 4.5: nothing behind it matters.";
    assert!(!said(&plan, false, 80).contains("may end"));
    let plan = altered(&plan, |stored| stored.stop = Some("9/2".into()));
    assert!(said(&plan, false, 80).contains(words));
    assert!(markdown(&document(&plan, false, &about())).contains(words));
}

/// Logarithms on the page are those of the stored bounds.
#[test]
fn the_figure_adds_the_bounds_up() {
    let plan = planned(&smoke(), 1e-4);
    let document = document(&plan, false, &about());
    let figure = document.blocks().find_map(|block| match block {
        Block::Figure(figure) => Some(figure),
        _ => None,
    });
    let plot = &figure.unwrap().plots[0];
    assert_eq!(plot.title, "How the bounds add up along the ray");
    let sum: f64 = plan.stored().steps.iter().map(|step| step.bound).sum();
    let last = plot.series[1].points.last().unwrap();
    assert!((last.y - sum.log10()).abs() < 1e-12 && (last.x - 8.0).abs() < 1e-12);
    assert!((plot.guides[0].at - -4.0).abs() < 1e-12);
    // Bounds below a millionth of the tolerance are rounding.
    let seen = |bound: f64| bound > 1e-10;
    let own = plan.stored().steps.iter().filter(|step| seen(step.bound));
    assert_eq!(plot.series[0].points.len(), own.count());
}

#[test]
fn a_rendering_has_all_digits_of_every_channel() {
    let plan = planned(&smoke(), 1e-4);
    let format = Native::<f32>::new();
    let rendered = plan.run_in(format).unwrap();
    let rendering = Rendering::new(&plan, format, &rendered);
    let text = terminal(&rendering.document(&about()), 80, false);
    let json: serde_json::Value = serde_json::from_str(&rendering.json().unwrap()).unwrap();
    for (i, name) in ["red", "green", "blue"].into_iter().enumerate() {
        let row = text
            .lines()
            .find(|line| line.trim_start().starts_with(name));
        let row: Vec<&str> = row.unwrap().split_whitespace().collect();
        let numbers = [rendered.radiance[i], rendered.transmittance[i]];
        assert_eq!(row[1..], numbers.map(|number| number.to_string()));
        assert_eq!(json["channels"][i]["radiance"], row[1]);
    }
    let evaluations = plan.evaluations();
    let last = format!("\n{evaluations} evaluations in f32\n");
    assert!(evaluations > 1 && text.ends_with(&last), "{text}");
    assert_eq!(json["evaluations"], evaluations);
}
