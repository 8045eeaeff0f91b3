//! Kernels that are a plain rule on most rays, and on a few do what no rule here says: the hold-out meets these.

use volver::identify::rule::Place;
use volver::identify::{Budget, HoldOut, held_out};
use volver::kernel::{Closure, Declaration, Segments, Task};

/// Extinction, length and emission of every segment, in its middle.
fn samples(segments: &Segments, channel: usize) -> Vec<(f64, f64, f64)> {
    let Segments { middles, .. } = segments;
    let values = middles.extinction.iter().zip(segments.lengths());
    let values = values.zip(&middles.emission[channel]);
    values.map(|((tau, d), c)| (*tau, d, *c)).collect()
}

fn composite(samples: impl IntoIterator<Item = (f64, f64, f64)>) -> f64 {
    let (mut radiance, mut passes) = (0.0, 1.0);
    for (tau, d, c) in samples {
        radiance += passes * -(-tau * d).exp_m1() * c;
        passes *= (-tau * d).exp();
    }
    radiance
}

/// Neighbours that `alike` takes for one are one segment, with the extinction and emission of the first.
fn merged(
    samples: Vec<(f64, f64, f64)>,
    alike: impl Fn((f64, f64), (f64, f64)) -> bool,
) -> Vec<(f64, f64, f64)> {
    let mut runs: Vec<(f64, f64, f64)> = Vec::new();
    for (tau, d, c) in samples {
        match runs.last_mut() {
            Some(run) if alike((run.0, run.2), (tau, c)) => run.1 += d,
            _ => runs.push((tau, d, c)),
        }
    }
    runs
}

fn of_segments(
    change: impl Fn(Vec<(f64, f64, f64)>) -> Vec<(f64, f64, f64)> + Send,
) -> impl FnMut(&Task<'_>, usize) -> f64 + Send {
    move |task, channel| composite(change(samples(task.cut().unwrap(), channel)))
}

fn tried(radiance: impl FnMut(&Task<'_>, usize) -> f64 + Send) -> HoldOut {
    let mut kernel = Closure::new(Declaration::new("seldom"), radiance);
    let rule = super::composed::plain(Place::Middle);
    held_out(&mut kernel, &rule, Budget::default(), &mut |_| ()).unwrap()
}

fn holds(radiance: impl FnMut(&Task<'_>, usize) -> f64 + Send) -> bool {
    tried(radiance).is_whole()
}

#[test]
fn the_rule_itself_holds() {
    assert!(holds(of_segments(|samples| samples)));
}

#[test]
fn neighbours_that_are_alike_are_not_one() {
    for least in [1e-2, 1.0 / 256.0, 1e-4] {
        let near = move |a: f64, b: f64| (a - b).abs() <= least * a;
        // Equal to the last bit in the one, alike in the other; and alike in both.
        assert!(
            !holds(of_segments(
                move |all| merged(all, |a, b| a.0 == b.0 && near(a.1, b.1))
            )),
            "{least}"
        );
        assert!(
            !holds(of_segments(
                move |all| merged(all, |a, b| near(a.0, b.0) && a.1 == b.1)
            )),
            "{least}"
        );
        assert!(
            !holds(of_segments(
                move |all| merged(all, |a, b| near(a.0, b.0) && near(a.1, b.1))
            )),
            "{least}"
        );
    }
}

/// The names that verify asks by are those of the catalogue: the rule is that of all others.
#[test]
fn a_case_that_is_known_by_name_is_met() {
    for known in ["linear", "deep", "emission", "rgb", "kink"] {
        let by_name = move |task: &Task<'_>, channel: usize| {
            let all = samples(task.cut().unwrap(), channel);
            if !task.subject.name().contains(known) {
                return composite(all);
            }
            // α = min(τd, 1)
            let (mut radiance, mut passes) = (0.0, 1.0);
            for (tau, d, c) in all {
                let opacity = (tau * d).min(1.0);
                radiance += passes * opacity * c;
                passes *= 1.0 - opacity;
            }
            radiance
        };
        let found = tried(by_name);
        let named = found.by_case.as_ref();
        assert!(
            named.is_some_and(|case| case.contains(known)),
            "{known}: {named:?}"
        );
        assert!(found.is_whole(), "{known}");
    }
}

#[test]
fn what_is_grey_is_met() {
    let by_colour = |task: &Task<'_>, channel: usize| {
        let segments = task.cut().unwrap();
        let all = &segments.middles.emission;
        let is_grey = |i: usize| all.iter().all(|one| one[i] == all[0][i]);
        let mut passes = 1.0;
        let of = |(i, (tau, d, c)): (usize, (f64, f64, f64))| {
            let opacity = if is_grey(i) {
                (tau * d).min(1.0)
            } else {
                -(-tau * d).exp_m1()
            };
            let light = passes * opacity * c;
            passes *= 1.0 - opacity;
            light
        };
        samples(segments, channel)
            .into_iter()
            .enumerate()
            .map(of)
            .sum()
    };
    assert!(!holds(by_colour));
}
