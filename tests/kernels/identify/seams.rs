//! Samples between blocks of segments that are left out or taken twice: named with their blocks, or not at all.
//!
//! Kernels that look alike on the probes, and what tells them: blocks of so many segments and of a part of the ray (n);
//! ⌊n/m⌋, ⌈n/m⌉ and m even blocks, with and without what is left over (n that is no multiple of m); blocks of a length
//! along λ (the step); seams that are dark, and absorb (the weights behind); samples that count twice and absorb once (the
//! same); seams from some n on (rays of that n); of thick segments only (the extinction).

use volver::identify::{Budget, Examined, Verdict, examine};
use volver::kernel::{Closure, Segments};

/// How often sample i of n is taken, and how often it absorbs.
type Times = fn(usize, usize, &Segments) -> (usize, usize);

fn marched(place: usize, times: Times) -> impl FnMut(&Segments, usize) -> f64 {
    move |segments, channel| {
        let n = segments.count();
        let (edges, middles) = (&segments.edges, &segments.middles);
        let (mut sum, mut through) = (0.0, 1.0);
        for i in 0..n {
            let d = edges.lambda[i + 1] - edges.lambda[i];
            let of = |edges: &[f64], middles: &[f64]| [edges[i], middles[i], edges[i + 1]][place];
            let opacity = -(-of(&edges.extinction, &middles.extinction) * d).exp_m1();
            let c = of(&edges.emission[channel], &middles.emission[channel]);
            let (emits, absorbs) = times(i, n, segments);
            let mut seen = through;
            for _ in 0..emits {
                sum += seen * opacity * c;
                if absorbs == emits {
                    seen *= 1.0 - opacity;
                }
            }
            for _ in 0..absorbs {
                through *= 1.0 - opacity;
            }
        }
        sum
    }
}

fn examined(place: usize, times: Times) -> Examined {
    let mut kernel = Closure::segments("seams", marched(place, times));
    examine(&mut kernel, Budget::default(), &mut |_| ())
}

/// As often as it absorbs.
fn both(times: usize) -> (usize, usize) {
    (times, times)
}

#[test]
#[expect(clippy::too_many_lines, reason = "a list of kernels")]
fn seams_are_named_with_their_blocks() {
    let kernels: [(usize, f64, &str, Times); 14] = [
        (
            1,
            4.0,
            "of every ⌊n/4⌋ of n segments the last is missing, where n is 8 or more",
            |i, n, _| both(usize::from((i + 1) % (n / 4).max(1) != 0 || n < 8)),
        ),
        (
            1,
            4.0,
            "of every ⌊n/4⌋ of n segments the first counts twice, but for that of the ray",
            |i, n, _| both(1 + usize::from(i > 0 && i % (n / 4).max(1) == 0)),
        ),
        (
            0,
            8.0,
            "of every 8 segments the last is missing",
            |i, _, _| both(usize::from(i % 8 != 7)),
        ),
        (
            2,
            64.0,
            "of every 64 segments the first counts twice, but for that of the ray",
            |i, _, _| both(1 + usize::from(i > 0 && i % 64 == 0)),
        ),
        (
            1,
            2.0,
            "of every 2 segments the last is missing",
            |i, _, _| both(usize::from(i % 2 == 0)),
        ),
        (
            1,
            2.0,
            "of every 2 segments the first is missing",
            |i, _, _| both(usize::from(i % 2 == 1)),
        ),
        (
            0,
            3.0,
            "of every 3 segments the first alone is taken",
            |i, _, _| both(usize::from(i % 3 == 0)),
        ),
        (
            1,
            5.0,
            "of every 5 segments the sample behind 2 others is missing",
            |i, _, _| both(usize::from(i % 5 != 2)),
        ),
        (
            1,
            4.0,
            "of every ⌈n/4⌉ of n segments the first is missing, but for that of the ray",
            |i, n, _| both(usize::from(i == 0 || i % n.div_ceil(4) != 0)),
        ),
        (
            1,
            3.0,
            "of 3 blocks, as even as n allows, the last counts twice, but for that of the ray's end",
            |i, n, _| both(1 + usize::from((1..3).any(|j| i + 1 == j * n / 3))),
        ),
        (
            2,
            4.0,
            "of 4 blocks of ⌊n/4⌋ segments, the last with what is left over, the last is missing",
            |i, n, _| {
                let size = (n / 4).max(1);
                let is_last = i + 1 == n || ((i + 1) % size == 0 && i + 1 < 4 * size);
                both(usize::from(!is_last))
            },
        ),
        (
            1,
            16.0,
            "of every 16 segments the last is missing, and of what is left over",
            |i, n, _| both(usize::from(i % 16 != 15 && i + 1 != n)),
        ),
        (
            1,
            32.0,
            "of every 32 segments the last counts twice",
            |i, _, _| both(1 + usize::from(i % 32 == 31)),
        ),
        (
            0,
            128.0,
            "of every 128 segments the last is missing",
            |i, _, _| both(usize::from(i % 128 != 127)),
        ),
    ];
    for (place, count, words, times) in kernels {
        let found = examined(place, times);
        let named: Vec<&str> = found.deviations.iter().map(|d| d.name).collect();
        let said: Vec<String> = found
            .found
            .not_identified
            .iter()
            .map(|part| part.reason.clone())
            .collect();
        assert_eq!(named, ["seam"], "{words}: {said:?}");
        let seam = &found.deviations[0];
        assert_eq!(seam.does, words);
        assert_eq!(seam.value, Some(count), "{words}");
        assert!(seam.exact);
        let witness = found.witness.expect("a witness");
        // The first sample that is not taken once.
        assert!(witness.segments() <= 128, "{words}: {witness}");
    }
}

#[test]
fn what_looks_like_a_seam_and_is_none_has_no_name() {
    let kernels: [(&str, Times); 9] = [
        ("blocks of a length along λ", |i, _, segments| {
            let at = |i: usize| (segments.edges.lambda[i] / 1.0).floor();
            both(usize::from(at(i) == at(i + 1)))
        }),
        ("seams that absorb, and are dark", |i, _, _| {
            (usize::from(i % 8 != 7), 1)
        }),
        ("seams that shine, and are clear", |i, _, _| {
            (1, usize::from(i % 8 != 7))
        }),
        ("samples that count twice, and absorb once", |i, _, _| {
            (1 + usize::from(i % 8 == 7), 1)
        }),
        ("samples that count three times", |i, _, _| {
            both(1 + 2 * usize::from(i % 8 == 7))
        }),
        ("blocks of n/4, rounded", |i, n, _| {
            let size = (n as f64 / 4.0).round().max(1.0) as usize;
            both(usize::from((i + 1) % size != 0 || n < 8))
        }),
        ("blocks of √n", |i, n, _| {
            let size = (n as f64).sqrt().floor() as usize;
            both(usize::from((i + 1) % size.max(2) != 0))
        }),
        ("where segments are thick", |i, _, segments| {
            let is_thick = segments.middles.extinction[i] > 0.7;
            both(usize::from(i % 8 != 7 || !is_thick))
        }),
        ("up to 300 segments", |i, n, _| {
            both(usize::from(i % 8 != 7 || n > 300))
        }),
    ];
    for (what, times) in kernels {
        let found = examined(1, times);
        let named = found.found.named().map(ToString::to_string);
        assert_eq!(named, None, "{what}");
        assert_eq!(found.verdict(), Verdict::NotIdentified, "{what}");
        assert!(found.witness.is_some(), "{what}");
    }
}

/// Other parts are read off behind a seam.
#[test]
fn a_seam_hides_no_other_part() {
    let mut kernel = Closure::segments("seam and clamp", |segments, channel| {
        let (edges, middles) = (&segments.edges, &segments.middles);
        let (mut sum, mut through) = (0.0, 1.0);
        for i in (0..segments.count()).filter(|i| i % 4 != 3) {
            let d = edges.lambda[i + 1] - edges.lambda[i];
            let opacity = (-(-middles.extinction[i] * d).exp_m1()).min(0.97);
            sum += through * opacity * middles.emission[channel][i];
            through *= 1.0 - opacity;
            if through < 0.01 {
                break;
            }
        }
        sum + 0.25 * through
    });
    let found = examine(&mut kernel, Budget::default(), &mut |_| ());
    let named: Vec<(&str, Option<f64>)> =
        found.deviations.iter().map(|d| (d.name, d.value)).collect();
    assert_eq!(
        named,
        [
            ("opacity-clamp", Some(0.97)),
            ("seam", Some(4.0)),
            ("early-end", Some(0.01)),
            ("background", Some(0.25)),
        ]
    );
}
