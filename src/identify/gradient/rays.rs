//! Rays on which gradients are compared.

use crate::identify::random::Random;
use crate::identify::ray::{Emission, Layers, Ray};
use crate::identify::session::Session;

/// A ray, and the cotangents of its channels.
pub(super) struct Probe {
    pub(super) name: &'static str,
    pub(super) ray: Ray,
    pub(super) layers: Layers,
    pub(super) emission: Vec<Emission>,
    pub(super) cotangents: Vec<f64>,
    /// Faults are found on the others.
    pub(super) held_out: bool,
}

/// What depths segments have.
struct Make {
    name: &'static str,
    n: usize,
    step: f64,
    /// Of single segments, from the least to the largest.
    depths: [f64; 2],
    /// One of this depth stands inside.
    inside: Option<f64>,
    held_out: bool,
}

/// Cotangents differ from channel to channel, and in sign.
const COTANGENTS: [[f64; 2]; 2] = [[1.0, -0.625], [0.75, 1.25]];

const MAKES: [Make; 7] = [
    Make {
        name: "a ray of middling depth",
        n: 6,
        step: 0.5,
        depths: [0.15, 0.7],
        inside: None,
        held_out: false,
    },
    Make {
        name: "a deep ray",
        n: 8,
        step: 0.2,
        depths: [0.9, 2.2],
        inside: None,
        held_out: false,
    },
    Make {
        name: "a thin ray",
        n: 5,
        step: 2.0,
        depths: [1e-4, 1e-2],
        inside: None,
        held_out: false,
    },
    Make {
        name: "a ray with an opaque segment",
        n: 6,
        step: 1.0,
        depths: [0.1, 0.5],
        inside: Some(5.5),
        held_out: false,
    },
    Make {
        name: "a ray with a segment that holds nothing",
        n: 6,
        step: 0.7,
        depths: [0.2, 0.9],
        inside: Some(0.0),
        held_out: false,
    },
    Make {
        name: "another ray",
        n: 9,
        step: 0.35,
        depths: [1e-4, 1.4],
        inside: Some(4.8),
        held_out: true,
    },
    Make {
        name: "another deep ray",
        n: 7,
        step: 1.3,
        depths: [0.6, 3.0],
        inside: None,
        held_out: true,
    },
];

/// The rays, of two channels each.
pub(super) fn rays(session: &mut Session<'_>) -> Vec<Probe> {
    let mut random = Random::new(211);
    let cotangents = COTANGENTS.iter().cycle();
    let all = MAKES.iter().zip(cotangents);
    all.map(|(make, cotangents)| make.probe(session, &mut random, cotangents))
        .collect()
}

/// So many rays of as many segments, with the same cotangents; in nothing else are they alike.
pub(super) fn alike(session: &mut Session<'_>, count: usize) -> Vec<Probe> {
    let mut random = Random::new(223);
    let one = |k: usize| {
        let make = Make {
            name: "one of several rays",
            n: 4,
            step: 0.5 + 0.125 * k as f64,
            depths: [0.2, 1.1],
            inside: None,
            held_out: false,
        };
        make.probe(session, &mut random, &COTANGENTS[0])
    };
    (0..count).map(one).collect()
}

impl Make {
    fn probe(&self, session: &mut Session<'_>, random: &mut Random, cotangents: &[f64]) -> Probe {
        let make = self;
        let n = make.n.next_multiple_of(session.multiple);
        let [low, high] = make.depths;
        let mut depths = |count: usize| -> Vec<f64> {
            (0..count).map(|_| random.geometric(low, high)).collect()
        };
        let (mut edges, mut middles) = (depths(n + 1), depths(n));
        if let Some(depth) = make.inside {
            let at = n / 2;
            (edges[at], middles[at]) = (depth, depth);
        }
        for depth in edges.iter_mut().chain(&mut middles) {
            *depth /= make.step;
        }
        let layers = Layers {
            step: make.step,
            last: 1.0,
            edges,
            middles,
        };
        let emission: Vec<Emission> = (0..2)
            .map(|_| Emission::of(n, |_| random.within(0.2, 1.0)))
            .collect();
        Probe {
            name: make.name,
            ray: session.ray(&layers, &emission),
            layers,
            emission,
            cotangents: cotangents.to_vec(),
            held_out: make.held_out,
        }
    }
}
