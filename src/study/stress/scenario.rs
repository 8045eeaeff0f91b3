//! The extremes.

use super::medium::{Fault, Layer, Medium};
use crate::case::HomogeneousSlab;
use rug::ops::Pow;
use rug::{Integer, Rational};

/// A medium and a number of segments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scenario {
    /// The group that it belongs to.
    pub group: &'static str,
    /// Its name: the group and what is extreme.
    pub name: String,
    /// The medium.
    pub medium: Medium,
    /// n.
    pub n: u64,
}

/// The groups, and what is extreme in them.
pub const GROUPS: [(&str, &str); 9] = [
    ("depth", "optical depth of the whole ray"),
    ("length", "length of a ray of optical depth 1"),
    ("segments", "number of segments of a ray of depth 3/8"),
    ("vacuum", "no extinction, everywhere or on a part"),
    ("step", "optical depth of one segment"),
    ("emission", "radiance near the ends of a format"),
    ("fault", "transfer functions that fail on half the ray"),
    ("spike", "a layer much thinner than a segment"),
    ("flat", "field values that hardly differ"),
];

/// Segments of scenarios that do not say otherwise.
pub const SEGMENTS: u64 = 256;
/// Numbers of segments of the group `segments`.
pub const LEVELS: [u64; 6] = [1, 2, 256, 65_536, 1 << 20, 1 << 24];
/// Segments where jumps must not meet rounded places: nodes and sub-intervals are numbers of 7 bits.
const FEW: u64 = 16;

/// All scenarios; `n` instead of their own numbers of segments, but in the group `segments`, which has
/// those of `levels`.
#[must_use]
pub fn scenarios(n: Option<u64>, levels: &[u64]) -> Vec<Scenario> {
    let mut all = slabs(n.unwrap_or(SEGMENTS));
    for &n in levels {
        let (depth, one) = (Rational::from((3, 8)), Rational::from(1));
        all.push(new(
            "segments",
            n.to_string(),
            slab(one.clone(), depth, one),
            n,
        ));
    }
    all.extend(broken(n.unwrap_or(FEW)));
    all.sort_by_key(|scenario| GROUPS.iter().position(|(name, _)| *name == scenario.group));
    all
}

/// A scenario of a group, by what is extreme.
pub(in crate::study) fn new(
    group: &'static str,
    what: impl AsRef<str>,
    medium: Medium,
    n: u64,
) -> Scenario {
    Scenario {
        group,
        name: format!("{group}/{}", what.as_ref()),
        medium,
        n,
    }
}

/// The same everywhere.
pub(in crate::study) fn slab(length: Rational, extinction: Rational, emission: Rational) -> Medium {
    Medium::Slab(HomogeneousSlab {
        length,
        extinction,
        emission,
    })
}

/// 10^exponent.
pub(in crate::study) fn power(exponent: i32) -> Rational {
    let power = Rational::from(Integer::from(10).pow(exponent.unsigned_abs()));
    if exponent < 0 { power.recip() } else { power }
}

fn slabs(n: u64) -> Vec<Scenario> {
    let one = || Rational::from(1);
    let mut all = Vec::new();
    for exponent in [-300, -30, -8, -4, 0, 2, 4, 10, 300] {
        let medium = slab(one(), power(exponent), one());
        all.push(new("depth", format!("1e{exponent}"), medium, n));
    }
    for exponent in [-30, -10, 10, 30] {
        let medium = slab(power(exponent), power(-exponent), one());
        all.push(new("length", format!("1e{exponent}"), medium, n));
    }
    all.push(new("vacuum", "all", slab(one(), Rational::new(), one()), n));
    for (name, of_segment) in [("3/2", (3, 2)), ("5/2", (5, 2))] {
        let extinction = Rational::from(of_segment) * n;
        all.push(new("step", name, slab(one(), extinction, one()), n));
    }
    for exponent in [-310, -40, -6, 4, 6, 38, 308] {
        let medium = slab(one(), Rational::from(8), power(exponent));
        all.push(new("emission", format!("1e{exponent}"), medium, n));
    }
    all
}

fn broken(n: u64) -> Vec<Scenario> {
    let faults = [
        ("nan", Fault::NotANumber),
        ("infinity", Fault::Infinity),
        ("minus-infinity", Fault::NegativeInfinity),
        ("negative-tau", Fault::NegativeExtinction),
        ("negative-c", Fault::NegativeEmission),
    ];
    let mut all: Vec<Scenario> = faults
        .into_iter()
        .map(|(name, fault)| new("fault", name, Medium::Faulty(fault), n))
        .collect();
    let gap = [((3, 10), 1), ((7, 10), 0), ((1, 1), 1)];
    all.push(new("vacuum", "part", layers(&gap), n));
    // Between samples whatever the method, and around one at 5/16.
    let missed = [((3, 10), 0), ((301, 1000), 1000), ((1, 1), 0)];
    all.push(new("spike", "missed", layers(&missed), n));
    let hit = [((311, 1000), 0), ((314, 1000), 300), ((1, 1), 0)];
    all.push(new("spike", "hit", layers(&hit), n));
    for (name, bits) in [("2^-10", 10), ("2^-30", 30), ("2^-60", 60)] {
        let slope = Rational::from((1, 1_u64 << bits));
        all.push(new("flat", name, Medium::Ramp { slope }, n));
    }
    all
}

/// Layers of C = 1, each by its back and its τ.
fn layers(all: &[((u32, u32), u32)]) -> Medium {
    let layer = |&(back, extinction): &((u32, u32), u32)| Layer {
        back: Rational::from(back),
        extinction: Rational::from(extinction),
        emission: Rational::from(1),
    };
    Medium::Layers(all.iter().map(layer).collect())
}
