//! What a kernel showed once beside what it shows now.

use super::{SMOOTH, composite, declared, front, run, settings, subjects};
use rug::Rational;
use volver::kernel::{Closure, Segments, Subject};
use volver::study::verify::{Baseline, BaselineError, Settings, Steps, Verification};

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
    assert_eq!(read.fingerprint.unwrap(), "front samples, 1 - exp(-τd)");
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
    let other = text.replace("\"volver_baseline\": 1", "\"volver_baseline\": 2");
    let found = 2;
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
    assert_eq!(moved[0].before, "computes front samples, 1 - exp(-τd)");
    let sine = moved.iter().find(|one| one.name == "sine-squared").unwrap();
    assert!(
        sine.before.starts_with("confirmed (Confirmed, order 1.0"),
        "{sine}"
    );
    assert!(sine.now.starts_with("contradicted ("), "{sine}");
    let back = Baseline::new(&bad, &asked()).moved(&good);
    // Where order 1 shows: what was blind or hidden and is so again is no better.
    let better = back.iter().filter(|one| one.better);
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
