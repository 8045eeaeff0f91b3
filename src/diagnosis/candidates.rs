//! The recipes and methods that a kernel's values are compared with.

use super::{EmissionModel, End, Ends, OpacityModel, Places, Recipe};
use crate::method::{
    Color, Exponential, Inner, Integration, Interpolant, LastSegment, Method, Nested, Opacity,
    Outer, Preintegrated, Scope,
};
use crate::quadrature::Rule;

/// Opacities under which a correction is known to be skipped.
const SKIPPED: [f64; 8] = [1e-4, 1e-3, 1e-2, 1.0 / 255.0, 1e-5, 1.0 / 256.0, 1e-6, 0.05];

/// A recipe, perhaps with a parameter still to be found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) recipe: Recipe,
    /// Its opacity has one: a reference length, or a factor of the depth.
    pub(super) is_free: bool,
}

/// Everything that may be wrong in compositing, in every combination; without stops and accumulators, which
/// are found otherwise.
pub(super) fn recipes() -> Vec<Candidate> {
    let sampled = [Places::Front, Places::Middle, Places::Back];
    let mut all = Vec::new();
    for places in sampled {
        for ends in ends(places) {
            for emission in [
                EmissionModel::TimesOpacity,
                EmissionModel::Unweighted,
                EmissionModel::TimesOpacityTwice,
            ] {
                for (swapped, wall) in [(false, false), (true, false), (false, true), (true, true)]
                {
                    let recipe = Recipe {
                        places,
                        ends,
                        emission,
                        swapped,
                        wall,
                        ..Recipe::default()
                    };
                    all.extend(of_opacities(&recipe));
                }
            }
        }
    }
    let both_ends = [Places::Ends, Places::Linear];
    all.extend(both_ends.into_iter().flat_map(|places| {
        [false, true].map(|swapped| Candidate {
            recipe: Recipe {
                places,
                swapped,
                ..Recipe::default()
            },
            is_free: false,
        })
    }));
    all
}

/// What may become of the samples at the ends.
fn ends(places: Places) -> Vec<Ends> {
    let kinds = [End::Kept, End::Dropped, End::Doubled];
    let one_extra = Ends {
        one_extra: true,
        ..Ends::default()
    };
    let both = kinds.into_iter().flat_map(|first| {
        kinds.map(|last| Ends {
            first,
            last,
            one_extra: false,
        })
    });
    // There is no sample beyond the last middle: it counts twice.
    let extra = Some(one_extra).filter(|_| places != Places::Middle);
    both.chain(extra).collect()
}

fn of_opacities(recipe: &Recipe) -> impl Iterator<Item = Candidate> {
    let recipe = *recipe;
    let with = move |opacity| Candidate {
        recipe: Recipe { opacity, ..recipe },
        is_free: false,
    };
    let known = [
        OpacityModel::Exact,
        OpacityModel::Linear,
        OpacityModel::Unattenuated,
    ];
    let skipped = SKIPPED.map(|threshold| OpacityModel::SkippedUnder {
        threshold,
        length: 1.0,
    });
    let free = Candidate {
        recipe,
        is_free: true,
    };
    let known = known.into_iter().chain(skipped).map(with);
    known.chain([free])
}

/// Methods of this crate that are no compositing of one sample a segment: nested rules and pre-integration.
pub(super) fn methods() -> Vec<Method> {
    let rules = [
        Rule::RiemannLeft,
        Rule::RiemannRight,
        Rule::Midpoint,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::Boole,
        Rule::GaussLegendre(2),
        Rule::GaussLegendre(3),
    ];
    let exponentials = [
        (Exponential::Exact, Scope::Whole),
        (Exponential::Linear, Scope::PerSegment),
        (Exponential::Quadratic, Scope::PerSegment),
        (Exponential::Cubic, Scope::PerSegment),
    ];
    let mut all = Vec::new();
    for inner in rules {
        for outer in rules {
            for (exponential, scope) in exponentials {
                all.push(Method::Nested(Nested {
                    inner: Inner::PerSegment(inner),
                    outer: Outer(outer),
                    exponential,
                    scope,
                }));
            }
        }
    }
    let interpolants = [
        Interpolant::Linear,
        Interpolant::Quadratic(LastSegment::Beyond),
    ];
    for color in interpolants {
        for opacity in interpolants {
            for attenuated in [true, false] {
                let trapezoids = Integration::SubIntervals {
                    rule: Rule::Trapezoid,
                    count: 100,
                };
                all.push(Method::Preintegrated(Preintegrated {
                    color: Color {
                        interpolant: color,
                        integration: trapezoids,
                        attenuated,
                    },
                    opacity: Opacity {
                        interpolant: opacity,
                        integration: trapezoids,
                    },
                }));
            }
        }
    }
    all
}
