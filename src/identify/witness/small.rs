//! Small rays of round numbers, by their numbers of segments.

use super::super::ray::Emission;
use super::doubt::{Doubt, Limits, Shown};
use super::shape::Shape;

/// Where values stand that a segment has one of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::identify) enum Nodes {
    /// At its front.
    Front,
    /// In its middle.
    Middle,
    /// At its back.
    Back,
    /// At all three.
    All,
}

/// A difference of that part is plain to see; one that is smaller may be larger on another ray of as many segments.
const PLAIN: f64 = 1e-2;

/// Extinctions of single segments: thin and thick, skipped and saturated.
const LONE: [f64; 12] = [
    1.0, 3.0, 0.01, 10.0, 0.1, 0.0, 1e-3, 50.0, 1e-4, 1_000.0, 15.0, 1e-5,
];
/// Of two, among them those behind which little is left.
const PAIR: [f64; 9] = [1.0, 3.0, 0.01, 10.0, 0.0, 5.0, 15.0, 50.0, 20.0];
/// Of three.
const TRIPLE: [f64; 4] = [1.0, 0.01, 10.0, 0.0];
/// Emissions of single segments: a background or an offset shows without any, a cut with much.
const BRIGHT: [f64; 5] = [1.0, 0.0, 5.0, 100.0, 10_000.0];
/// Steps beside 1.
const STEPS: [f64; 4] = [0.25, 4.0, 1e-3, 50.0];
/// Numbers of segments beside 3 at which loops that are unrolled, capped or merged differ.
const COUNTS: [usize; 13] = [4, 5, 7, 8, 9, 13, 17, 33, 65, 129, 257, 601, 1_201];
/// A shorter last segment.
const PARTS: [f64; 2] = [0.5, 0.25];

/// One value a segment at the nodes that count, and at the others what stands beside it.
pub(super) fn placed(nodes: Nodes, values: &[f64]) -> Emission {
    let mut edges = values.to_vec();
    match nodes {
        Nodes::Back => edges.insert(0, values.first().copied().unwrap_or(0.0)),
        Nodes::Front | Nodes::Middle | Nodes::All => edges.extend(values.last().copied()),
    }
    Emission {
        edges,
        middles: values.to_vec(),
    }
}

fn shape(nodes: Nodes, step: f64, last: f64, taus: &[f64], emissions: &[Vec<f64>]) -> Shape {
    Shape {
        step,
        last,
        extinction: placed(nodes, taus),
        emission: emissions.iter().map(|c| placed(nodes, c)).collect(),
    }
}

/// Rays of one, two and three segments.
pub(super) fn few(nodes: Nodes) -> Vec<Vec<Shape>> {
    let bright: Vec<Vec<f64>> = BRIGHT.iter().map(|c| vec![*c]).collect();
    let mut ones: Vec<Shape> = Vec::new();
    ones.extend(
        LONE.iter()
            .map(|tau| shape(nodes, 1.0, 1.0, &[*tau], &bright)),
    );
    if nodes == Nodes::All {
        ones.extend(uneven());
    }
    for last in PARTS {
        ones.push(shape(nodes, 1.0, last, &[1.0], &bright));
    }
    for step in STEPS {
        for tau in [1.0, 1e-3, 1e-5] {
            ones.push(shape(nodes, step, 1.0, &[tau], &bright));
        }
    }
    let lit = |n: usize| {
        let mut all = vec![vec![1.0; n]];
        for i in 0..n {
            let mut one = vec![0.0; n];
            one[i] = 1.0;
            all.push(one);
        }
        all.push((0..n).map(|i| if i == 0 { 5.0 } else { 1.0 }).collect());
        all
    };
    let mut twos = Vec::new();
    for last in [1.0, PARTS[0]] {
        for front in PAIR {
            for back in PAIR {
                if last >= 1.0 || (front - back).abs() <= 0.0 {
                    twos.push(shape(nodes, 1.0, last, &[front, back], &lit(2)));
                }
            }
        }
    }
    let mut threes = Vec::new();
    for first in TRIPLE {
        for second in TRIPLE {
            for third in TRIPLE {
                let taus = [first, second, third];
                threes.push(shape(nodes, 1.0, 1.0, &taus, &lit(3)));
            }
        }
    }
    vec![ones, twos, threes]
}

/// One segment with another value at each of its nodes.
fn uneven() -> impl Iterator<Item = Shape> {
    let taus = [
        [1.0, 1.0, 1.0],
        [2.0, 1.0, 0.0],
        [0.0, 1.0, 2.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 1.0],
    ];
    let of = |[front, middle, back]: [f64; 3]| Emission {
        edges: vec![front, back],
        middles: vec![middle],
    };
    taus.into_iter().map(move |taus| Shape {
        step: 1.0,
        last: 1.0,
        extinction: of(taus),
        emission: [
            [1.0, 1.0, 1.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ]
        .map(of)
        .into(),
    })
}

/// Longer ones, thin and thick, lit everywhere and at one end alone.
pub(super) fn many(nodes: Nodes) -> Vec<Vec<Shape>> {
    let of = |n: usize| {
        let lit = |i: usize| {
            let mut one = vec![0.0; n];
            one[i] = 1.0;
            one
        };
        let emissions = [vec![1.0; n], lit(0), lit(n - 1)];
        let mut all = Vec::new();
        for last in [1.0, PARTS[0]] {
            for tau in [0.01, 1.0, 0.0] {
                all.push(shape(nodes, 1.0, last, &vec![tau; n], &emissions));
            }
        }
        all.push(smooth(n));
        all
    };
    COUNTS.into_iter().map(of).collect()
}

/// A medium that changes slowly, as those of users do, of optical depth 2.
fn smooth(n: usize) -> Shape {
    let wave = |phase: f64| {
        let of = move |i: f64| 1.0 + 0.9 * (phase + std::f64::consts::TAU * i / n as f64).sin();
        Emission::of(n, of)
    };
    Shape {
        step: 2.0 / n as f64,
        last: 1.0,
        extinction: wave(0.0),
        emission: vec![wave(1.0), wave(2.5)],
    }
}

/// Rays of a few segments with another emission at each node, for kernels of which not even the place of samples is known.
pub(super) fn scattered() -> Vec<Vec<Shape>> {
    let of = |n: usize| {
        let powers = |first: usize, count: usize| {
            let power = |k: usize| f64::from(1_u32 << ((first + k) % 16));
            (0..count).map(power).collect()
        };
        let emission = Emission {
            edges: powers(0, n + 1),
            middles: powers(n + 1, n),
        };
        let of = |tau: f64| Shape {
            step: 1.0,
            last: 1.0,
            extinction: Emission::even(n, tau),
            emission: vec![emission.clone()],
        };
        [1.0, 0.1].map(of).into()
    };
    [1, 2, 3, 4, 7].into_iter().map(of).collect()
}

/// The first ray that shows a difference plainly, or the one of as few segments that shows the most.
pub(super) fn search(
    doubt: &mut dyn Doubt,
    groups: Vec<Vec<Shape>>,
    limits: Limits,
) -> Option<(Shape, Shown)> {
    for group in groups {
        let mut best: Option<(Shape, Shown)> = None;
        for shape in group {
            let fits =
                shape.count() % limits.multiple == 0 && !(limits.divides && shape.last < 1.0);
            if !fits {
                continue;
            }
            if doubt.is_spent() {
                return best;
            }
            if let Some(shown) = doubt.of(&shape.ray())
                && best.as_ref().is_none_or(|(_, most)| shown.part > most.part)
            {
                let is_plain = shown.part >= PLAIN;
                best = Some((shape, shown));
                if is_plain {
                    return best;
                }
            }
        }
        if best.is_some() {
            return best;
        }
    }
    None
}
