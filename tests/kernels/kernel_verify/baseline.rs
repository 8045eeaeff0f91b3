//! What a kernel showed once beside what it shows now.

use super::{SMOOTH, composite, declared, front, run, settings, subjects};
use rug::Rational;
use serde_json::Value;
use volver::kernel::{Closure, Segments, Subject};
use volver::study::verify::{Baseline, BaselineError, Moved, Settings, Steps, Verification};

const METHOD: &str = "front-to-back/front/expm1";

fn asked() -> Vec<String> {
    SMOOTH.map(String::from).into()
}

fn verified(
    subjects: &[Subject],
    settings: &Settings,
    changed: fn(&Segments, f64) -> f64,
) -> Verification {
    let mut kernel = Closure::new(declared(METHOD), |task, channel| {
        let segments = task.cut().expect("segments are asked for");
        changed(segments, composite(front(segments, channel)))
    });
    run(&mut kernel, subjects, settings)
}

fn same(_: &Segments, radiance: f64) -> f64 {
    radiance
}

/// Half of the light, however fine the steps.
fn worse(_: &Segments, radiance: f64) -> f64 {
    0.5 * radiance
}

#[test]
fn it_is_read_as_it_was_written() {
    let settings = Settings {
        steps: Steps::Uneven,
        expect: Some(Rational::from((3, 2))),
        ..settings("10..810x3")
    };
    let verification = verified(&subjects(&SMOOTH), &settings, same);
    let baseline = Baseline::new(&verification, &asked());
    let text = baseline.to_json().unwrap();
    assert!(text.ends_with("}\n"));
    let read = Baseline::read(&text).unwrap();
    assert_eq!(read, baseline);
    assert_eq!(read.cases, asked());
    assert_eq!(read.lines.len(), verification.lines.len());
    let rule = read.rule.unwrap();
    let words: Vec<&str> = rule.iter().map(|part| &part.words[..]).collect();
    assert_eq!(words, ["samples lie at the front of segments"]);
    assert_eq!(read.deviations, []);
    // And asks the same again.
    assert_eq!(baseline.settings().unwrap(), settings);
}

/// Steps divided the ray before they could do otherwise, and are asked for so again.
#[test]
fn an_older_one_is_asked_on_the_ladder_it_was_made_with() {
    let settings = Settings {
        steps: Steps::Divide,
        ..settings("8..128")
    };
    let verification = verified(&subjects(&["cloud"]), &settings, same);
    let text = Baseline::new(&verification, &[]).to_json().unwrap();
    let older = text.replace("  \"divides\": true,\n", "");
    assert_ne!(older, text);
    let older = Baseline::read(&older).unwrap();
    assert_eq!(older.settings().unwrap(), settings);
    assert_eq!(older.moved(&verification), []);
    let newer = text.replace("\"divides\": true", "\"divides\": false");
    let newer = Baseline::read(&newer).unwrap().settings().unwrap();
    assert_eq!(newer.steps, Steps::PartLast);
}

#[test]
fn what_is_none_is_refused() {
    let verification = verified(&subjects(&["cloud"]), &settings("8..128"), same);
    let text = Baseline::new(&verification, &[]).to_json().unwrap();
    let other = text.replace("\"volver_baseline\": 2", "\"volver_baseline\": 3");
    let found = 3;
    assert_eq!(
        Baseline::read(&other),
        Err(BaselineError::Version { found })
    );
    for broken in [
        "",
        "{}",
        "[]",
        &text[..text.len() / 2],
        &text.replace("uneven", "odd"),
    ] {
        let refused = Baseline::read(broken).unwrap_err().to_string();
        assert!(refused.starts_with("no baseline: "), "{refused}");
    }
}

#[test]
fn noise_moves_nothing() {
    let (subjects, settings) = (subjects(&SMOOTH), settings("8..512"));
    let before = verified(&subjects, &settings, same);
    let baseline = Baseline::new(&before, &asked());
    assert_eq!(baseline.moved(&before), []);
    // As another compiler rounds.
    let rounded = |segments: &Segments, radiance: f64| {
        let up = segments.count().trailing_zeros().is_multiple_of(2);
        if up {
            radiance.next_up()
        } else {
            radiance.next_down()
        }
    };
    assert_eq!(baseline.moved(&verified(&subjects, &settings, rounded)), []);
}

#[test]
fn what_breaks_has_moved_and_what_is_mended_is_better() {
    let (subjects, settings) = (subjects(&SMOOTH), settings("8..512"));
    let (good, bad) = (
        verified(&subjects, &settings, same),
        verified(&subjects, &settings, worse),
    );
    let moved = Baseline::new(&good, &asked()).moved(&bad);
    // Every channel, and what it computes.
    assert_eq!(moved.len(), good.lines.len() + 1);
    assert!(moved.iter().all(|one| !one.better));
    assert_eq!(moved[0].name, "kernel");
    // Half of the light is half of the weight.
    assert_eq!(moved[0].before, "plain");
    assert_eq!(
        moved[0].now,
        "the weight of the emission is multiplied by 0.5"
    );
    let sine = moved.iter().find(|one| one.name == "sine-squared").unwrap();
    assert!(
        sine.before.starts_with("confirmed (Confirmed, order 1.0"),
        "{sine}"
    );
    assert!(sine.now.starts_with("contradicted ("), "{sine}");
    let back = Baseline::new(&bad, &asked()).moved(&good);
    // Where order 1 shows: what was blind or hidden and is so again is no better.
    let (kernel, channels) = back.split_first().unwrap();
    assert!(kernel.name == "kernel" && kernel.better, "{kernel}");
    let better = channels.iter().filter(|one| one.better);
    assert_eq!(better.count(), good.counts().confirmed);
    assert!(good.counts().confirmed > 5);
}

#[test]
fn cases_that_come_and_go_are_said() {
    let settings = settings("8..256");
    let both = verified(
        &subjects(&["sine-squared", "decaying-field"]),
        &settings,
        same,
    );
    let one = verified(&subjects(&["sine-squared"]), &settings, same);
    let gone = Baseline::new(&both, &[]).moved(&one);
    let [gone] = &gone[..] else {
        panic!("{gone:?}");
    };
    assert_eq!(
        (&gone.name[..], &gone.now[..]),
        ("decaying-field", "not there")
    );
    assert!(!gone.better);
    let came = Baseline::new(&one, &[]).moved(&both);
    let [came] = &came[..] else {
        panic!("{came:?}");
    };
    assert_eq!(
        (&came.name[..], &came.before[..]),
        ("decaying-field", "not there")
    );
    assert!(came.better);
}

/// What came into the catalogue since is not asked.
#[test]
fn a_baseline_of_all_of_the_catalogue_asks_its_own_cases() {
    let settings = settings("8..256");
    let of_two = verified(
        &subjects(&["rgb-transfer", "sine-squared"]),
        &settings,
        same,
    );
    let asked = |cases: &[String]| Baseline::new(&of_two, cases).asked();
    assert_eq!(asked(&[]), ["rgb-transfer", "sine-squared"]);
    let by_tag = ["@paper".to_string()];
    assert_eq!(asked(&by_tag), by_tag);
}

/// Half of the emission, which a baseline has recorded; a third is another deviation.
#[test]
fn deviations_that_were_recorded_pass_as_long_as_they_stay() {
    let (subjects, settings) = (subjects(&["cloud", "sine-squared"]), settings("8..256"));
    let bad = verified(&subjects, &settings, worse);
    let baseline = Baseline::new(&bad, &[]);
    let recorded = &baseline.deviations;
    assert_eq!(
        (&recorded[0].name[..], recorded[0].value),
        ("scale", Some(0.5))
    );
    assert!(bad.deviates());
    let known = baseline.settings().unwrap();
    assert_eq!(known.accept[0].to_string(), "scale=0.5");
    let again = verified(&subjects, &known, worse);
    assert!(!again.deviates());
    assert_eq!(baseline.moved(&again), []);
    let third = verified(&subjects, &known, |_, radiance| radiance / 3.0);
    assert!(third.deviates());
    let kernel = |moved: Vec<Moved>| moved.into_iter().find(|one| one.name == "kernel");
    let moved = kernel(baseline.moved(&third)).unwrap();
    assert!(
        moved.now.ends_with("is multiplied by 0.3333333333333333") && !moved.better,
        "{moved}"
    );
    // What is mended is better.
    let mended = kernel(baseline.moved(&verified(&subjects, &known, same))).unwrap();
    assert!(mended.better, "{mended}");
}

/// The first version has no rule: what deviates now is told, and has not moved.
#[test]
fn a_baseline_of_the_first_version_is_read_and_knows_no_deviations() {
    let (subjects, settings) = (subjects(&["cloud"]), settings("8..128"));
    let bad = verified(&subjects, &settings, worse);
    let mut first: Value =
        serde_json::from_str(&Baseline::new(&bad, &[]).to_json().unwrap()).unwrap();
    let keys = first.as_object_mut().unwrap();
    for key in ["rule", "deviations", "identify"] {
        assert!(keys.remove(key).is_some(), "{key}");
    }
    keys.insert("volver_baseline".into(), 1.into());
    keys.insert("fingerprint".into(), "front samples, 1 - exp(-τd)".into());
    let first = Baseline::read(&first.to_string()).unwrap();
    assert_eq!(first.settings().unwrap(), settings);
    assert_eq!(first.moved(&bad), []);
    let told = first.unrecorded(&bad);
    assert!(told[0].starts_with("scale: "), "{told:?}");
}
