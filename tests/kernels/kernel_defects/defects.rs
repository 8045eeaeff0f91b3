//! The seeded-defect suite.

use super::marcher::{Fault, declared, march};
use super::{run, subjects};
use Fault::*;
use volver::identify::Deviation;
use volver::kernel::Closure;
use volver::study::verify::{Conclusion, Verification};

const FRONT: &str = "front-to-back/front/subtraction";
const MIDDLE: &str = "front-to-back/middle/subtraction";

/// A marcher that says it is the first, does the second, and in what that deviates; in nothing that has a name where it only
/// rounds, looks up otherwise, or ends so early or so oddly that no rule is identified.
type Mutant = (
    &'static str,
    &'static [Fault],
    &'static [(&'static str, Option<f64>)],
);

const SINGLE: &[Mutant] = &[
    (FRONT, &[SampleMiddle], &[("place", None)]),
    (FRONT, &[SampleBack], &[("place", None)]),
    (MIDDLE, &[], &[("place", None)]),
    (FRONT, &[FirstDropped], &[("first-sample", None)]),
    (FRONT, &[LastDropped], &[("last-sample", None)]),
    (FRONT, &[FirstDoubled], &[("first-sample", None)]),
    (FRONT, &[LastDoubled], &[("last-sample", None)]),
    (FRONT, &[OneExtra], &[("extra-sample", None)]),
    (
        MIDDLE,
        &[SampleMiddle, LastDropped],
        &[("last-sample", None)],
    ),
    (
        MIDDLE,
        &[SampleMiddle, LastDoubled],
        &[("last-sample", None)],
    ),
    (FRONT, &[LinearOpacity], &[("opacity-law", None)]),
    (FRONT, &[Uncorrected(1.0)], &[("depth-powers", None)]),
    (
        FRONT,
        &[Uncorrected(0.01)],
        &[("depth-factor", Some(0.01)), ("depth-powers", None)],
    ),
    (
        FRONT,
        &[WrongReference(1.25)],
        &[("depth-factor", Some(1.25))],
    ),
    (
        MIDDLE,
        &[SampleMiddle, WrongReference(0.5)],
        &[("depth-factor", Some(0.5))],
    ),
    (
        FRONT,
        &[SkipUnder(1e-4)],
        &[("uncorrected-opacity", Some(1e-4))],
    ),
    (
        MIDDLE,
        &[SampleMiddle, SkipUnder(1e-4)],
        &[("uncorrected-opacity", Some(1e-4))],
    ),
    (
        FRONT,
        &[StopUnder(1.0 / 255.0)],
        &[("early-end", Some(1.0 / 255.0))],
    ),
    (FRONT, &[StopUnder(0.01)], &[("early-end", Some(0.01))]),
    (FRONT, &[StopUnder(0.05)], &[("early-end", Some(0.05))]),
    (FRONT, &[StopUnder(0.3)], &[]),
    (FRONT, &[Bits(8)], &[]),
    (FRONT, &[Bits(10)], &[]),
    (FRONT, &[Bits(15)], &[]),
    (FRONT, &[Bits(16)], &[]),
    (FRONT, &[ImageBits(8)], &[]),
    (FRONT, &[Unattenuated], &[("weight", None)]),
    (FRONT, &[EmissionUnweighted], &[("weight", None)]),
    (FRONT, &[EmissionTwice], &[("weight", None)]),
    (FRONT, &[Swapped], &[("swapped-ends", None)]),
    (FRONT, &[FarWall], &[("wall", None)]),
    (FRONT, &[Binary32], &[("format", Some(24.0))]),
    (MIDDLE, &[Table(64)], &[]),
    (MIDDLE, &[Table(256)], &[]),
    (MIDDLE, &[NearestEntry], &[("table-lookup", None)]),
    (FRONT, &[Jittered], &[("seed", None)]),
];

/// What no list of usual values has.
const UNUSUAL: &[Mutant] = &[
    (
        FRONT,
        &[SkipUnder(3e-3)],
        &[("uncorrected-opacity", Some(3e-3))],
    ),
    (FRONT, &[StopUnder(0.07)], &[("early-end", Some(0.07))]),
    (FRONT, &[Bits(9)], &[]),
    (
        FRONT,
        &[WrongReference(1.1)],
        &[("depth-factor", Some(1.1))],
    ),
    (
        FRONT,
        &[Uncorrected(0.37)],
        &[("depth-factor", Some(0.37)), ("depth-powers", None)],
    ),
    (FRONT, &[FirstDropped, LastDropped], &[]),
    (
        FRONT,
        &[FirstDoubled, LastDropped],
        &[("first-sample", None), ("last-sample", None)],
    ),
];

const DOUBLE: &[Mutant] = &[
    (
        FRONT,
        &[SampleBack, OneExtra],
        &[("place", None), ("extra-sample", None)],
    ),
    (
        FRONT,
        &[LastDropped, StopUnder(0.01)],
        &[("last-sample", None), ("early-end", Some(0.01))],
    ),
    (
        FRONT,
        &[FirstDoubled, WrongReference(2.0)],
        &[("depth-factor", Some(2.0)), ("first-sample", None)],
    ),
    (
        FRONT,
        &[LinearOpacity, LastDropped],
        &[("opacity-law", None), ("last-sample", None)],
    ),
    (
        FRONT,
        &[SampleMiddle, LinearOpacity],
        &[("place", None), ("opacity-law", None)],
    ),
    (
        FRONT,
        &[Unattenuated, Swapped],
        &[("weight", None), ("swapped-ends", None)],
    ),
    (
        MIDDLE,
        &[SampleMiddle, EmissionTwice, StopUnder(0.05)],
        &[("weight", None), ("early-end", Some(0.05))],
    ),
    (
        FRONT,
        &[FarWall, LastDropped],
        &[("last-sample", None), ("wall", None)],
    ),
    (FRONT, &[Bits(16), LastDropped], &[]),
    (FRONT, &[Bits(15), Swapped], &[]),
    (FRONT, &[Bits(12), LinearOpacity], &[]),
    (
        FRONT,
        &[Binary32, LastDropped],
        &[("last-sample", None), ("format", Some(24.0))],
    ),
    (
        FRONT,
        &[Binary32, SampleMiddle],
        &[("place", None), ("format", Some(24.0))],
    ),
    (
        FRONT,
        &[EmissionUnweighted, FirstDropped],
        &[("weight", None), ("first-sample", None)],
    ),
    (
        FRONT,
        &[SkipUnder(1e-4), StopUnder(1.0 / 255.0)],
        &[
            ("uncorrected-opacity", Some(1e-4)),
            ("early-end", Some(1.0 / 255.0)),
        ],
    ),
    (
        FRONT,
        &[Uncorrected(0.1), LastDropped],
        &[
            ("depth-factor", Some(0.1)),
            ("depth-powers", None),
            ("last-sample", None),
        ],
    ),
    (MIDDLE, &[Table(128), StopUnder(0.01)], &[]),
    (MIDDLE, &[Table(32), LinearOpacity], &[]),
];

/// A value that was bisected lies so near.
const NEAR: f64 = 1e-6;

fn deviations(verification: &Verification) -> &[Deviation] {
    let identified = verification.identification.as_ref();
    identified.map_or(&[], |identified| &identified.examined.deviations)
}

#[test]
fn seeded_defects_are_flagged_and_named() {
    let subjects = subjects();
    let mutants: Vec<&Mutant> = SINGLE.iter().chain(UNUSUAL).chain(DOUBLE).collect();
    assert!(mutants.len() >= 40);
    let mut misnamed = Vec::new();
    for (method, faults, wanted) in &mutants {
        let declaration = declared(method, faults);
        let mut kernel = Closure::new(declaration, |task, channel| march(task, channel, faults));
        let verification = run(&mut kernel, &subjects, "8..256", false);
        let found = deviations(&verification);
        let flagged = verification.conclusion() != Conclusion::Confirmed;
        let is_value = |wanted: Option<f64>, found: Option<f64>| match (wanted, found) {
            (Some(wanted), Some(found)) => (found - wanted).abs() <= NEAR * wanted,
            (wanted, _) => wanted.is_none(),
        };
        let is_found = |(name, value): &(&str, Option<f64>)| {
            let mut of_name = found.iter().filter(|one| one.name == *name);
            of_name.any(|one| is_value(*value, one.value))
        };
        let right = found.len() == wanted.len() && wanted.iter().all(is_found);
        let said: Vec<String> = found
            .iter()
            .map(|one| format!("{} {:?}", one.name, one.value))
            .collect();
        println!(
            "{} {} {faults:?} as {method}: {said:?}",
            if flagged { "flagged" } else { "MISSED " },
            if right { "named   " } else { "MISNAMED" },
        );
        assert!(flagged, "{faults:?} declared as {method}: {said:?}");
        if !right {
            misnamed.push((faults, said));
        }
    }
    assert!(misnamed.is_empty(), "{misnamed:#?}");
}
