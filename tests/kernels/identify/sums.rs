//! Rays that end where opacities sum to a threshold: named with it, or not at all.
//!
//! Kernels that look alike on the probes, and what tells them: a largest number of samples (thin rays); an end by the
//! transmittance or the optical depth (segments of other depths); by the sum of what another law gives than the weights' (thick
//! segments); by the sum of what is seen (rays with something in front); a transmittance that is 1 less the sum (an
//! extinction raised).

use volver::identify::{Budget, Examined, examine};
use volver::kernel::Closure;

/// τ d, the sum so far and T to: the weight, what is added to the sum, what is let through, and whether the ray ends.
type Step = fn(f64, f64, f64) -> (f64, f64, f64, bool);

fn examined(step: Step) -> Examined {
    let mut kernel = Closure::segments("sums", move |segments, channel| {
        let (edges, middles) = (&segments.edges, &segments.middles);
        let (mut radiance, mut through, mut sum) = (0.0, 1.0, 0.0);
        for i in 0..segments.count() {
            let d = edges.lambda[i + 1] - edges.lambda[i];
            let (weight, adds, passes, ends) = step(middles.extinction[i] * d, sum, through);
            radiance += weight * middles.emission[channel][i];
            sum += adds;
            through *= passes;
            if ends {
                break;
            }
        }
        radiance
    });
    examine(&mut kernel, Budget::default(), &mut |_| ())
}

fn opacity(x: f64) -> f64 {
    -(-x).exp_m1()
}

#[test]
fn an_end_by_a_sum_is_named_with_its_threshold() {
    let kernels: [(&str, f64, &[&str], Step); 5] = [
        (
            "added up until opacities sum to 1",
            1.0,
            &["opacity-law", "weight", "early-end"],
            |x, sum, _| (opacity(x), opacity(x), 1.0, sum + opacity(x) >= 1.0),
        ),
        (
            "until they sum to 0.95, without the sample that takes them there",
            0.95,
            &["opacity-law", "weight", "early-end", "early-end-sample"],
            |x, sum, _| {
                let ends = sum + opacity(x) >= 0.95;
                (if ends { 0.0 } else { opacity(x) }, opacity(x), 1.0, ends)
            },
        ),
        (
            "clamped",
            1.0,
            &["opacity-law", "weight", "early-end", "early-end-sample"],
            |x, sum, _| {
                let added = opacity(x).min(1.0 - sum);
                (added, added, 1.0, sum + opacity(x) >= 1.0)
            },
        ),
        (
            "depths up to 2.5",
            2.5,
            &["opacity-law", "weight", "early-end"],
            |x, sum, _| (x, x, 1.0, sum + x >= 2.5),
        ),
        (
            "opacities up to 0.7",
            0.7,
            &["opacity-law", "weight", "early-end"],
            |x, sum, _| (opacity(x), opacity(x), 1.0, sum + opacity(x) >= 0.7),
        ),
    ];
    for (what, threshold, names, step) in kernels {
        let found = examined(step);
        let named: Vec<&str> = found.deviations.iter().map(|d| d.name).collect();
        let mut said = found.found.not_identified.iter().map(|part| &part.reason);
        assert_eq!(named, names, "{what}: {:?}", said.next());
        let end = found.deviations.iter().find(|d| d.name == "early-end");
        let end = end.expect("an end");
        assert_eq!(end.value, Some(threshold), "{what}");
        let (low, high) = end.bracket.expect("a bracket");
        assert!(
            low <= threshold && threshold <= high,
            "{what}: {low} {high}"
        );
        assert!(high - low <= 1e-6 * threshold, "{what}: {low} {high}");
        let witness = found.witness.expect("a witness");
        assert!(witness.segments() <= 4, "{what}: {witness}");
    }
}

#[test]
fn what_looks_like_an_end_by_a_sum_and_is_none_has_no_such_name() {
    let kernels: [(&str, Step); 5] = [
        (
            "composited until opacities sum to 1.5",
            |x, sum, through| {
                let ends = sum + opacity(x) >= 1.5;
                (through * opacity(x), opacity(x), (-x).exp(), ends)
            },
        ),
        ("opacities, by the depth", |x, sum, _| {
            (opacity(x), x, 1.0, sum + x >= 1.0)
        }),
        ("a transmittance that is 1 less the sum", |x, sum, _| {
            ((1.0 - sum).max(0.0) * opacity(x), opacity(x), 1.0, false)
        }),
        ("the sum of squares", |x, sum, _| {
            let a = opacity(x);
            (a, a * a, 1.0, sum + a * a >= 0.5)
        }),
        ("opacities, of thick segments alone", |x, sum, _| {
            let counts = if x > 0.02 { opacity(x) } else { 0.0 };
            (opacity(x), counts, 1.0, sum + counts >= 1.0)
        }),
    ];
    for (what, step) in kernels {
        let found = examined(step);
        let named = found.found.named().map(ToString::to_string);
        assert_eq!(named, None, "{what}");
        assert!(found.witness.is_some(), "{what}");
    }
    // An end by the optical depth is one by the transmittance.
    let found = examined(|x, sum, through| (through * opacity(x), x, (-x).exp(), sum + x > 3.0));
    let named = found.found.named().expect("a rule").to_string();
    assert!(named.contains("transmittance"), "{named}");
}
