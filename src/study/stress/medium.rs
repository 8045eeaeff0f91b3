//! The media of the scenarios: as simple as their extremes allow, so that exact values are at hand.

use crate::case::{Break, Case, HomogeneousSlab, PolynomialTransfer, Structure, Transfer};
use crate::real::{Format, Real};
use rug::Rational;

/// A layer of constant C and τ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// λ at its back; its front is the back of the one before it.
    pub back: Rational,
    /// τ ≥ 0.
    pub extinction: Rational,
    /// C ≥ 0.
    pub emission: Rational,
}

/// τ at a place along the ray.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Knot {
    /// λ.
    pub place: Rational,
    /// τ, below 0 too.
    pub extinction: Rational,
}

/// What a transfer function returns in the back half of the ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// τ = 0/0.
    NotANumber,
    /// τ = 1/0.
    Infinity,
    /// C = −1/0.
    NegativeInfinity,
    /// τ = −2.
    NegativeExtinction,
    /// C = −1.
    NegativeEmission,
}

/// A medium that a method may fail on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Medium {
    /// The same everywhere.
    Slab(HomogeneousSlab),
    /// Layers, front to back, on a ray that ends with the last.
    Layers(Vec<Layer>),
    /// τ = s, C = 1, s = 1 + slope·λ on [0, 1].
    Ramp {
        /// ds/dλ ≥ 0.
        slope: Rational,
    },
    /// τ linear between knots, from λ = 0 to the end of the ray, and C = 1: the radiance is the opacity.
    Polyline(Vec<Knot>),
    /// τ = C = 1 on [0, 1], but for a fault where λ > ½.
    Faulty(Fault),
}

impl Medium {
    /// Whether C, τ and s are the same everywhere.
    pub(super) fn is_uniform(&self) -> bool {
        matches!(self, Medium::Slab(_))
    }

    /// Where C or τ jump.
    pub(super) fn edges(&self) -> Vec<Rational> {
        match self {
            Medium::Slab(_) | Medium::Ramp { .. } | Medium::Polyline(_) => Vec::new(),
            Medium::Layers(layers) => {
                let inner = layers.iter().rev().skip(1).rev();
                inner.map(|layer| layer.back.clone()).collect()
            }
            Medium::Faulty(_) => vec![Rational::from((1, 2))],
        }
    }

    fn faulty<R: Real>(fault: Fault, s: &R) -> Transfer<R> {
        let format = s.format();
        let one = format.int(1);
        let zero = format.int(0);
        let mut transfer = Transfer {
            emission: one.clone(),
            extinction: one.clone(),
        };
        if *s > format.fraction(1, 2) {
            match fault {
                Fault::NotANumber => transfer.extinction = zero.clone() / &zero,
                Fault::Infinity => transfer.extinction = one / &zero,
                Fault::NegativeInfinity => transfer.emission = -one / &zero,
                Fault::NegativeExtinction => transfer.extinction = format.int(-2),
                Fault::NegativeEmission => transfer.emission = -one,
            }
        }
        transfer
    }
}

fn layer<'l, R: Real>(layers: &'l [Layer], lambda: &R) -> Option<&'l Layer> {
    let format = lambda.format();
    let found = layers
        .iter()
        .find(|layer| *lambda <= format.ratio(&layer.back));
    found.or(layers.last())
}

impl Case for Medium {
    fn name(&self) -> &str {
        match self {
            Medium::Slab(slab) => slab.name(),
            Medium::Layers(_) => "layers",
            Medium::Ramp { .. } => "ramp",
            Medium::Polyline(_) => "polyline",
            Medium::Faulty(_) => "faulty",
        }
    }

    fn length(&self) -> Rational {
        match self {
            Medium::Slab(slab) => slab.length(),
            Medium::Layers(layers) => layers
                .last()
                .map_or_else(|| Rational::from(1), |layer| layer.back.clone()),
            Medium::Polyline(knots) => knots
                .last()
                .map_or_else(|| Rational::from(1), |knot| knot.place.clone()),
            Medium::Ramp { .. } | Medium::Faulty(_) => Rational::from(1),
        }
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        match self {
            Medium::Slab(slab) => slab.field(lambda),
            Medium::Layers(_) | Medium::Polyline(_) | Medium::Faulty(_) => lambda.clone(),
            Medium::Ramp { slope } => {
                let format = lambda.format();
                format.ratio(slope) * lambda + &format.int(1)
            }
        }
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let format = s.format();
        match self {
            Medium::Slab(slab) => slab.transfer(s),
            Medium::Layers(layers) => match layer(layers, s) {
                Some(layer) => Transfer {
                    emission: format.ratio(&layer.emission),
                    extinction: format.ratio(&layer.extinction),
                },
                None => Transfer {
                    emission: format.int(0),
                    extinction: format.int(0),
                },
            },
            Medium::Ramp { .. } => Transfer {
                emission: format.int(1),
                extinction: s.clone(),
            },
            Medium::Polyline(knots) => Transfer {
                emission: format.int(1),
                extinction: between(knots, s),
            },
            Medium::Faulty(fault) => Medium::faulty(*fault, s),
        }
    }

    fn optical_depth<R: Real>(&self, lambda: &R) -> Option<R> {
        let format = lambda.format();
        match self {
            Medium::Slab(slab) => slab.optical_depth(lambda),
            Medium::Layers(layers) => {
                let mut depth = format.int(0);
                for (layer, width) in crossed(layers, lambda) {
                    depth += &(width * &format.ratio(&layer.extinction));
                }
                Some(depth)
            }
            Medium::Ramp { slope } => {
                let half = format.ratio(&Rational::from(slope / 2));
                Some((half * lambda + &format.int(1)) * lambda)
            }
            Medium::Polyline(knots) => Some(depth_of(knots, lambda)),
            Medium::Faulty(_) => None,
        }
    }

    fn radiance<R: Real>(&self, lambda: &R) -> Option<R> {
        let format = lambda.format();
        match self {
            Medium::Slab(slab) => slab.radiance(lambda),
            Medium::Layers(layers) => {
                let mut radiance = format.int(0);
                let mut depth = format.int(0);
                for (layer, width) in crossed(layers, lambda) {
                    let own = width * &format.ratio(&layer.extinction);
                    let seen = -(-own.clone()).exp_m1() * &(-depth.clone()).exp();
                    radiance += &(seen * &format.ratio(&layer.emission));
                    depth += &own;
                }
                Some(radiance)
            }
            Medium::Ramp { .. } | Medium::Polyline(_) => {
                Some(-(-self.optical_depth(lambda)?).exp_m1())
            }
            Medium::Faulty(_) => None,
        }
    }

    fn structure(&self) -> Structure {
        let zero = || Some(Rational::new());
        let breaks = self.edges().into_iter().map(|edge| Break {
            part: Some(edge / self.length()),
            extinction: zero(),
            source: zero(),
        });
        let polynomial = match self {
            Medium::Slab(slab) => return slab.structure(),
            Medium::Ramp { .. } => Some(PolynomialTransfer {
                extinction: vec![Rational::new(), Rational::from(1)],
                source: vec![Rational::new(), Rational::from(1)],
            }),
            Medium::Layers(_) | Medium::Polyline(_) | Medium::Faulty(_) => None,
        };
        Structure {
            field_degree: Some(1),
            transfer: polynomial,
            breaks: breaks.collect(),
            ..Structure::default()
        }
    }
}

/// The layers as far as λ, each with the width that is crossed.
fn crossed<'l, R: Real>(layers: &'l [Layer], lambda: &R) -> Vec<(&'l Layer, R)> {
    let format = lambda.format();
    let mut front = format.int(0);
    let mut crossed = Vec::new();
    for layer in layers {
        let back = format.ratio(&layer.back);
        let end = if back < *lambda { &back } else { lambda };
        crossed.push((layer, end.clone() - &front));
        if back >= *lambda {
            break;
        }
        front = back;
    }
    crossed
}

/// τ of a piece at a place on it.
fn on<R: Real>(near: &Knot, far: &Knot, lambda: &R) -> R {
    let format = lambda.format();
    let rise = Rational::from(&far.extinction - &near.extinction);
    let slope = rise / Rational::from(&far.place - &near.place);
    let along = lambda.clone() - &format.ratio(&near.place);
    along * &format.ratio(&slope) + &format.ratio(&near.extinction)
}

/// τ at a place; at a knot that of the knot, in every format that has both.
fn between<R: Real>(knots: &[Knot], lambda: &R) -> R {
    let format = lambda.format();
    let mut pieces = knots.windows(2);
    let is_on = |piece: &&[Knot]| matches!(piece, [_, far] if *lambda <= format.ratio(&far.place));
    match (pieces.find(is_on), knots.last()) {
        (Some([near, far]), _) => on(near, far, lambda),
        (_, Some(last)) => format.ratio(&last.extinction),
        (_, None) => format.int(0),
    }
}

/// ∫ τ up to a place: trapezoids.
fn depth_of<R: Real>(knots: &[Knot], lambda: &R) -> R {
    let format = lambda.format();
    let mut depth = format.int(0);
    for piece in knots.windows(2) {
        let [near, far] = piece else { continue };
        let (front, back) = (format.ratio(&near.place), format.ratio(&far.place));
        if *lambda <= front {
            break;
        }
        let end = if back < *lambda { back } else { lambda.clone() };
        let both = on(near, far, &end) + &format.ratio(&near.extinction);
        depth += &((end - &front) * &both * &format.fraction(1, 2));
    }
    depth
}
