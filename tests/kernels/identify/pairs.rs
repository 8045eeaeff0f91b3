//! Rules that differ on few rays only: the hold-out of one tells the other.

use super::composed::{law, of_rule, plain};
use volver::identify::rule::{
    At, Blocks, Effect, End, Extra, LastStep, Output, Place, Power, Seam, Series, Stop, StopBy,
    Wall, Weight, Which, Whole,
};
use volver::identify::{Budget, Kind, Rule, held_out};

/// A rule of samples in the middle with something changed.
fn with(change: impl FnOnce(&mut Rule)) -> Rule {
    let mut rule = plain(Place::Middle);
    change(&mut rule);
    rule
}

fn stop(under: f64, before: bool, renormalised: bool) -> Rule {
    with(|rule| {
        rule.stop = Some(Stop {
            by: StopBy::Transmittance,
            under,
            before,
            cut: false,
            renormalised,
        });
    })
}

fn clipped(high: f64) -> Rule {
    with(|rule| {
        rule.output = Output {
            high: Some(high),
            ..Output::default()
        };
    })
}

#[expect(clippy::too_many_lines, reason = "a list of pairs")]
/// Both, and on what they differ.
fn pairs() -> Vec<(&'static str, Rule, Rule)> {
    let middle = || plain(Place::Middle);
    let wall = |wall| with(|rule| rule.wall = Some(wall));
    let last = |step| with(|rule| rule.sequence.last_step = step);
    let most = |count| with(|rule| rule.sequence.most = Some(count));
    let seam = |blocks, effect, of, fewest| {
        with(|rule| {
            rule.sequence.seam = Some(Seam {
                blocks,
                at: At::Last,
                effect,
                of,
                fewest,
            });
        })
    };
    let skip = |under| with(|rule| law(rule).range.skip = Some(under));
    vec![
        (
            "τ = 0 at the end",
            wall(Wall::Opaque),
            wall(Wall::LastEmission),
        ),
        (
            "C above 1",
            with(|rule| rule.emission_max = Some(1.0)),
            clipped(1.0),
        ),
        (
            "C below 0",
            with(|rule| rule.emission_min = Some(0.0)),
            middle(),
        ),
        (
            "answers below 0",
            with(|rule| rule.output.low = Some(0.0)),
            middle(),
        ),
        ("n above 60", most(60), middle()),
        ("n above 1,000", most(1_000), middle()),
        ("100 and 101 samples", most(100), most(101)),
        ("a whole last step", last(LastStep::Whole), middle()),
        ("a last step left out", last(LastStep::Dropped), middle()),
        ("even steps", last(LastStep::Even), middle()),
        (
            "an early end at 0.01 and 0.0101",
            stop(0.01, false, false),
            stop(0.0101, false, false),
        ),
        ("an early end at 1e-4", stop(1e-4, false, false), middle()),
        (
            "the sample that ends the ray",
            stop(0.01, true, false),
            stop(0.01, false, false),
        ),
        (
            "a ray that ended divided by its opacity",
            stop(1e-3, false, true),
            stop(1e-3, false, false),
        ),
        ("skips under 1e-3 and 1.1e-3", skip(1e-3), skip(1.1e-3)),
        ("skips under 1e-7", skip(1e-7), middle()),
        (
            "a clamp at 0.9999",
            with(|rule| law(rule).range.opacity_max = Some(0.9999)),
            middle(),
        ),
        (
            "a clamp of extinction at 1,000",
            with(|rule| law(rule).range.extinction_max = Some(1_000.0)),
            middle(),
        ),
        (
            "1e-12 added to what is let through",
            with(|rule| law(rule).eps = 1e-12),
            middle(),
        ),
        (
            "1 + 1e-12 times as much",
            with(|rule| law(rule).scale.0 = 1.0 + 1e-12),
            middle(),
        ),
        (
            "a series of three terms under 0.05",
            with(|rule| {
                law(rule).range.series = Some(Series {
                    below: 0.05,
                    terms: 3,
                });
            }),
            middle(),
        ),
        (
            "background and offset",
            with(|rule| rule.background = 1e-3),
            with(|rule| rule.offset = 1e-3),
        ),
        (
            "behind a step of its length, or by the ray's",
            with(|rule| law(rule).depth.ray = Power { halves: -2 }),
            middle(),
        ),
        (
            "own attenuation",
            with(|rule| {
                law(rule).weight = Weight::Opacity {
                    opacity: Power::ONE,
                    passes: Power::ONE,
                };
            }),
            middle(),
        ),
        (
            "divided by the ray's opacity",
            with(|rule| rule.whole = Whole::ByOpacity),
            middle(),
        ),
        (
            "the first of the front missing, the last of the back missing",
            {
                let mut rule = plain(Place::Front);
                rule.sequence.first = End::Missing;
                rule
            },
            {
                let mut rule = plain(Place::Back);
                rule.sequence.last = End::Missing;
                rule
            },
        ),
        (
            "one too many, as long as the step or as the last",
            {
                let mut rule = plain(Place::Front);
                rule.sequence.extra = Some(Extra::Step);
                rule
            },
            {
                let mut rule = plain(Place::Front);
                rule.sequence.extra = Some(Extra::Last);
                rule
            },
        ),
        (
            "unrolled by 2",
            with(|rule| rule.sequence.unrolled = 2),
            middle(),
        ),
        (
            "every second and every fourth sample",
            seam(Blocks::Segments(2), Effect::Missing, Which::Whole, 1),
            seam(Blocks::Segments(4), Effect::Missing, Which::Whole, 1),
        ),
        (
            "blocks of 512 segments",
            seam(Blocks::Segments(512), Effect::Missing, Which::Whole, 1),
            middle(),
        ),
        (
            "a rest of a part of the ray, in a block of its own or in the last",
            seam(Blocks::Floor(4), Effect::Twice, Which::Inner, 1),
            seam(Blocks::Rest(4), Effect::Twice, Which::Inner, 1),
        ),
        (
            "blocks of n/4, rounded up or down",
            seam(Blocks::Floor(4), Effect::Missing, Which::Whole, 1),
            seam(Blocks::Ceiling(4), Effect::Missing, Which::Whole, 1),
        ),
        (
            "blocks of n/3, as even as may be or with the rest in the last",
            seam(Blocks::Even(3), Effect::Missing, Which::Inner, 1),
            seam(Blocks::Rest(3), Effect::Missing, Which::Inner, 1),
        ),
        (
            "blocks from 8 segments on, or from 9",
            seam(Blocks::Floor(4), Effect::Missing, Which::Whole, 8),
            seam(Blocks::Floor(4), Effect::Missing, Which::Whole, 9),
        ),
        (
            "the last of all, too",
            seam(Blocks::Segments(16), Effect::Twice, Which::All, 1),
            seam(Blocks::Segments(16), Effect::Twice, Which::Whole, 1),
        ),
        (
            "late by one",
            with(|rule| rule.sequence.late = true),
            middle(),
        ),
    ]
}

fn holds(kernel: &Rule, rule: &Rule) -> bool {
    let mut kernel = of_rule(kernel.clone());
    let found = held_out(&mut kernel, rule, Budget::default(), &mut |_| ()).unwrap();
    // Of negative emissions too, on which a rule may fail and be named.
    found.is_whole() && found.kinds.iter().all(Kind::holds)
}

/// What differs on few rays needs a ray of its own among those held out.
#[test]
fn rules_that_differ_on_few_rays_are_told() {
    let unseen: Vec<&str> = pairs()
        .iter()
        .filter(|(_, one, other)| holds(one, other) || holds(other, one))
        .map(|(what, ..)| *what)
        .collect();
    assert!(unseen.is_empty(), "not seen: {unseen:?}");
}

#[test]
fn a_rule_holds_against_itself() {
    for (what, one, other) in pairs() {
        assert!(holds(&one, &one), "{what}");
        assert!(holds(&other, &other), "{what}");
    }
}
