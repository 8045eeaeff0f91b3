//! The seeded-defect suite.

use super::marcher::{Fault, declared, march};
use super::{run, subjects};
use Fault::*;
use volver::diagnosis::{Fingerprint, Model};
use volver::kernel::Closure;
use volver::study::verify::{Conclusion, Verification};

const FRONT: &str = "front-to-back/front/subtraction";
const MIDDLE: &str = "front-to-back/middle/subtraction";

/// A marcher that says it is the first, does the second, and the words that must stand in the report.
type Mutant = (&'static str, &'static [Fault], &'static [&'static str]);

const SINGLE: &[Mutant] = &[
    (FRONT, &[SampleMiddle], &["middle samples, 1 - exp(-τd)"]),
    (FRONT, &[SampleBack], &["back samples, 1 - exp(-τd)"]),
    (MIDDLE, &[], &["front samples, 1 - exp(-τd)"]),
    (FRONT, &[FirstDropped], &["first sample missing"]),
    (FRONT, &[LastDropped], &["last sample missing"]),
    (FRONT, &[FirstDoubled], &["first sample counted twice"]),
    (FRONT, &[LastDoubled], &["last sample counted twice"]),
    (FRONT, &[OneExtra], &["one extra sample"]),
    (
        MIDDLE,
        &[SampleMiddle, LastDropped],
        &["middle", "last sample missing"],
    ),
    (
        MIDDLE,
        &[SampleMiddle, LastDoubled],
        &["middle", "last sample counted twice"],
    ),
    (FRONT, &[LinearOpacity], &["opacity τd"]),
    (
        FRONT,
        &[Uncorrected(1.0)],
        &["1 - exp(-τ·1), not corrected"],
    ),
    (
        FRONT,
        &[Uncorrected(0.01)],
        &["1 - exp(-τ·0.01), not corrected"],
    ),
    (
        FRONT,
        &[WrongReference(1.25)],
        &["1 - exp(-1.25·τd)", "wrong reference"],
    ),
    (
        MIDDLE,
        &[SampleMiddle, WrongReference(0.5)],
        &["middle", "wrong reference"],
    ),
    (FRONT, &[SkipUnder(1e-4)], &["skipped where", "1e-4"]),
    (
        MIDDLE,
        &[SampleMiddle, SkipUnder(1e-4)],
        &["middle", "skipped where"],
    ),
    (
        FRONT,
        &[StopUnder(1.0 / 255.0)],
        &["ended at a transmittance of 1/255"],
    ),
    (
        FRONT,
        &[StopUnder(0.01)],
        &["ended at a transmittance of 0.01"],
    ),
    (
        FRONT,
        &[StopUnder(0.05)],
        &["ended at a transmittance of 0.05"],
    ),
    (
        FRONT,
        &[StopUnder(0.3)],
        &["ended at a transmittance of 0.3"],
    ),
    (FRONT, &[Bits(8)], &["accumulator of 8 bits"]),
    (FRONT, &[Bits(10)], &["accumulator of 10 bits"]),
    (FRONT, &[Bits(15)], &["accumulator of 15 bits"]),
    (FRONT, &[Bits(16)], &["accumulator of 16 bits"]),
    (FRONT, &[ImageBits(8)], &["accumulator of 8 bits", "1/255"]),
    (
        FRONT,
        &[Unattenuated],
        &["attenuation inside segments neglected"],
    ),
    (FRONT, &[EmissionUnweighted], &["not multiplied by opacity"]),
    (FRONT, &[EmissionTwice], &["multiplied by opacity twice"]),
    (FRONT, &[Swapped], &["back and front swapped"]),
    (FRONT, &[FarWall], &["far wall"]),
    (FRONT, &[Binary32], &["in binary32"]),
    (MIDDLE, &[Table(64)], &["too coarsely (64 entries)"]),
    (MIDDLE, &[Table(256)], &["too coarsely (256 entries)"]),
    (MIDDLE, &[NearestEntry], &["nearest entry"]),
    (FRONT, &[Jittered], &["jittered samples"]),
];

/// What no list of usual values has.
const UNUSUAL: &[Mutant] = &[
    (FRONT, &[SkipUnder(3e-3)], &["skipped where"]),
    (
        FRONT,
        &[StopUnder(0.07)],
        &["ended at a transmittance of 0.07"],
    ),
    (FRONT, &[Bits(9)], &["accumulator of 9 bits"]),
    (FRONT, &[WrongReference(1.1)], &["1 - exp(-1.1·τd)"]),
    (
        FRONT,
        &[Uncorrected(0.37)],
        &["1 - exp(-τ·0.37), not corrected"],
    ),
    (
        FRONT,
        &[FirstDropped, LastDropped],
        &["first sample missing, last sample missing"],
    ),
    (
        FRONT,
        &[FirstDoubled, LastDropped],
        &["first sample counted twice, last sample missing"],
    ),
];

const DOUBLE: &[Mutant] = &[
    (
        FRONT,
        &[SampleBack, OneExtra],
        &["back", "one extra sample"],
    ),
    (
        FRONT,
        &[LastDropped, StopUnder(0.01)],
        &["last sample missing", "transmittance of 0.01"],
    ),
    (
        FRONT,
        &[FirstDoubled, WrongReference(2.0)],
        &["counted twice", "wrong reference"],
    ),
    (
        FRONT,
        &[LinearOpacity, LastDropped],
        &["opacity τd", "last sample missing"],
    ),
    (
        FRONT,
        &[SampleMiddle, LinearOpacity],
        &["middle", "opacity τd"],
    ),
    (FRONT, &[Unattenuated, Swapped], &["neglected", "swapped"]),
    (
        MIDDLE,
        &[SampleMiddle, EmissionTwice, StopUnder(0.05)],
        &["middle", "twice", "transmittance of 0.05"],
    ),
    (
        FRONT,
        &[FarWall, LastDropped],
        &["far wall", "last sample missing"],
    ),
    (
        FRONT,
        &[Bits(16), LastDropped],
        &["16 bits", "last sample missing"],
    ),
    (FRONT, &[Bits(15), Swapped], &["15 bits", "swapped"]),
    (
        FRONT,
        &[Bits(12), LinearOpacity],
        &["12 bits", "opacity τd"],
    ),
    (
        FRONT,
        &[Binary32, LastDropped],
        &["binary32", "last sample missing"],
    ),
    (FRONT, &[Binary32, SampleMiddle], &["binary32", "middle"]),
    (
        FRONT,
        &[EmissionUnweighted, FirstDropped],
        &["not multiplied", "first sample missing"],
    ),
    (
        FRONT,
        &[SkipUnder(1e-4), StopUnder(1.0 / 255.0)],
        &["skipped where", "1/255"],
    ),
    (
        FRONT,
        &[Uncorrected(0.1), LastDropped],
        &["not corrected", "last sample missing"],
    ),
    (
        MIDDLE,
        &[Table(128), StopUnder(0.01)],
        &["128 entries", "transmittance of 0.01"],
    ),
    (
        MIDDLE,
        &[Table(32), LinearOpacity],
        &["32 entries", "opacity τd"],
    ),
];

/// All that the report says of what the kernel computes.
fn said(verification: &Verification) -> String {
    let mut said = Vec::new();
    let found = verification.fingerprint.as_ref();
    if let Some(best) = found.and_then(|found| found.best.as_ref()) {
        said.push(format!(
            "{} [{} of {}]",
            best.model,
            best.agrees.len(),
            best.of
        ));
        said.extend(alike(verification).iter().map(ToString::to_string));
    }
    let findings = verification.findings.iter();
    said.extend(findings.map(|one| format!("{} ({})", one.defect, one.channels.len())));
    said.join(" = ")
}

fn alike(verification: &Verification) -> Vec<Model> {
    let found = verification.fingerprint.as_ref();
    found.map_or_else(Vec::new, |found| found.alike.clone())
}

#[test]
fn seeded_defects_are_flagged_and_named() {
    let subjects = subjects();
    let mutants: Vec<&Mutant> = SINGLE.iter().chain(UNUSUAL).chain(DOUBLE).collect();
    assert!(mutants.len() >= 40);
    let mut unnamed = Vec::new();
    for (method, faults, words) in &mutants {
        let declaration = declared(method, faults);
        let mut kernel = Closure::new(declaration, |task, channel| march(task, channel, faults));
        let verification = run(&mut kernel, &subjects, "8..256", false);
        let contradicted = verification
            .fingerprint
            .as_ref()
            .is_some_and(Fingerprint::contradicts_declaration);
        let flagged = verification.conclusion() != Conclusion::Confirmed || contradicted;
        let said = said(&verification);
        let right = words.iter().all(|word| said.contains(word));
        println!(
            "{} {} {faults:?} as {method}: {said}",
            if flagged { "flagged" } else { "MISSED " },
            if right { "named " } else { "UNNAMED" },
        );
        assert!(flagged, "{faults:?} declared as {method}: {said}");
        if !right {
            unnamed.push(faults);
        }
    }
    println!(
        "{} of {} named",
        mutants.len() - unnamed.len(),
        mutants.len()
    );
    // Nine in ten would do; but what is named once is to stay named.
    assert_eq!(unnamed, Vec::<&&[Fault]>::new());
}
