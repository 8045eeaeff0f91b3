//! How a kernel keeps the transmittance, by swamping: behind a segment that takes a part of the light, thin ones take
//! about half a unit in the last place each, and what becomes of these is a matter of how T is made.
//!
//! With T = 3/4 and opacities of 5/8 of a unit, 1 − α is rounded to take a whole unit, so that a product falls by one at
//! each; T α is less than half a unit, so that what remains never falls; a sum of depths keeps another part; and nothing
//! is lost where T has more digits. Each is what [`Compositing`] makes of the same samples with the same bits.

use super::Precision;
use super::deviation::right_of;
use super::random::Random;
use super::ray::{Emission, Layers};
use super::rule::{Node, Output, Place, Rule, Scheme, StopBy};
use super::session::Session;
use super::silence::Silence;
use crate::kernel::FormKind;
use crate::method::{
    Accumulation, Compositing, CompositingOrder, OpacityFormula, Position, Summation,
};
use crate::real::{Format, Mpfr, Real};
use serde::Serialize;
use std::fmt;

/// How the transmittance in front of a sample is made of what stands before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Transmittance {
    /// T (1 − α), where 1 − α is rounded before it is multiplied.
    Products,
    /// T − T α.
    Remainder,
    /// exp(−Σ τ d), the depths added one by one.
    Depths,
    /// Nothing of thin segments is lost: sums are compensated, in pairs, or have more digits than answers.
    Kept,
}

impl fmt::Display for Transmittance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Transmittance::Products => "products of 1 − α, each rounded",
            Transmittance::Remainder => "what remains, T − T α",
            Transmittance::Depths => "exponentials of depths added one by one",
            Transmittance::Kept => {
                "kept with what thin segments take: compensated, in pairs, or with more digits than answers have"
            }
        })
    }
}

/// Bits of formats in which thin segments are normal numbers, and few of them do not take all.
const BITS: [u32; 3] = [11, 24, 53];
/// The length of segments, a power of two: depths are as exact as extinctions.
const STEP: f64 = 0.25;
/// The depth of the last segment, which is opaque in every format, and its emission: T is seen through that.
const OPAQUE: f64 = 100.0;
const BRIGHT: f64 = 0.75;
/// What the second segment shines with in a channel of its own, in 1 by the unit: so its opacity is seen.
const SHOWS: f64 = 0.125;
/// Thin segments of a ray.
const COUNT: usize = 256;
/// The transmittance in front of thin segments, and their opacities in units of 2^(−bits): in the first what remains never
/// falls, in the second it does, but not where T has fewer digits than answers.
const THIN: [(f64, f64); 2] = [(0.75, 0.625), (0.75, 0.875)];
/// Units that an answer may be off what explains it, and twice as many that others are off it on some ray.
const OFF: f64 = 3.0;
/// The part of an opacity by which it may be off and has not lost its digits in 1 − e^(−x).
const PRECISE: f64 = 1.0 / 16.0;
/// Rays held out on which all that is known differs, of so many that are drawn, with thin segments of an opacity in units, and T
/// in front of them, between these; and segments and depth of one more, where none is as deep as another.
const HELD_OUT: usize = 2;
const DRAWN: usize = 100;
const HELD_UNITS: (f64, f64) = (0.3, 2.5);
const HELD_FRONT: (f64, f64) = (0.55, 0.95);
const UNEVEN: (usize, f64) = (512, 1.0);
/// Roundings of that one need not be the same, each by chance half a unit or less: four standard deviations of the
/// difference of two walks of so many.
const UNEVEN_OFF: f64 = 4.0 * 0.408;
/// An early end at less than this is behind all that is looked at.
const STOP: f64 = 0.1;

/// What is known to keep T so: methods that do, each in exact arithmetic the same.
fn known(position: Position) -> Vec<(Transmittance, Compositing)> {
    use CompositingOrder::{BackToFront, Tree};
    let front_to_back = |depth, summation| CompositingOrder::FrontToBack {
        depth,
        summation,
        stop: None,
    };
    let (naive, neumaier) = (Summation::Naive, Summation::Neumaier);
    let all = [
        (
            Transmittance::Products,
            front_to_back(Accumulation::Transmittances, naive),
        ),
        (Transmittance::Products, BackToFront),
        (Transmittance::Products, Tree),
        (
            Transmittance::Remainder,
            front_to_back(Accumulation::Remainder, naive),
        ),
        (
            Transmittance::Depths,
            front_to_back(Accumulation::Depths, naive),
        ),
        (
            Transmittance::Kept,
            front_to_back(Accumulation::Depths, neumaier),
        ),
    ];
    let of = |(name, order)| {
        let compositing = Compositing {
            position,
            opacity: OpacityFormula::Expm1,
            order,
        };
        (name, compositing)
    };
    all.into_iter().map(of).collect()
}

/// How T is kept by a rule of one plain sample a segment, where one of the known ways alone explains the answers, and
/// answers to rays that it was not found with.
///
/// An opacity that has lost its digits in 1 − e^(−x) hides how: T (1 − α) and T − T α are the same then.
pub(super) fn transmittance(
    session: &mut Session<'_>,
    rule: &Rule,
    precision: Option<Precision>,
) -> Result<Option<Transmittance>, Silence> {
    let Scheme::Sample { place, .. } = &rule.scheme else {
        return Ok(None);
    };
    let stops_late = rule
        .stop
        .is_none_or(|stop| stop.by == StopBy::Transmittance && stop.under < STOP);
    let is_plain = Rule {
        channels: rule.channels,
        stop: rule.stop,
        ..right_of(rule)
    } == *rule;
    let bits = match precision {
        Some(Precision::Bits(bits)) if BITS.contains(&bits) => bits,
        _ => return Ok(None),
    };
    if !is_plain
        || !stops_late
        || rule.output != Output::default()
        || session.pose.form != FormKind::Segments
        || COUNT + 2 > session.most_samples
    {
        return Ok(None);
    }
    let asker = Asker {
        place: *place,
        bits,
        known: known(match place {
            Place::Front => Position::Front,
            Place::Middle => Position::Middle,
            Place::Back => Position::Back,
        }),
    };
    asker.told(session)
}

/// Rays as depths of their segments, in units in the last place of a number between 1/2 and 1.
struct Asker {
    place: Place,
    bits: u32,
    known: Vec<(Transmittance, Compositing)>,
}

impl Asker {
    fn unit(&self) -> f64 {
        (-f64::from(self.bits)).exp2()
    }

    fn told(&self, session: &mut Session<'_>) -> Result<Option<Transmittance>, Silence> {
        let mut worst = vec![0.0_f64; self.known.len()];
        for (front, units) in THIN {
            let depths = self.thin(session, (front, units));
            let Some([bright, second]) = self.ask(session, &depths)? else {
                return Ok(None);
            };
            if (second / (SHOWS * front * units) - 1.0).abs() > PRECISE {
                return Ok(None);
            }
            for (worst, want) in worst.iter_mut().zip(self.wanted(&depths)) {
                *worst = worst.max((bright - want).abs());
            }
        }
        let names = || self.known.iter().map(|(name, _)| *name).zip(&worst);
        let near = names().filter(|(_, off)| **off <= OFF);
        let mut near: Vec<Transmittance> = near.map(|(name, _)| name).collect();
        near.dedup();
        let [name] = near[..] else {
            return Ok(None);
        };
        // What is nearly as near may be it, too.
        if names().any(|(other, off)| other != name && *off <= 2.0 * OFF) {
            return Ok(None);
        }
        Ok(self.holds(session, name)?.then_some(name))
    }

    /// Whether one method of that name explains the answers to rays that are held out.
    fn holds(&self, session: &mut Session<'_>, name: Transmittance) -> Result<bool, Silence> {
        let mut random = Random::new(173);
        let drawn = (0..DRAWN).map(|_| {
            let front = random.within(HELD_FRONT.0, HELD_FRONT.1);
            let units = random.within(HELD_UNITS.0, HELD_UNITS.1);
            self.thin(session, (front, units))
        });
        let telling = drawn.filter(|depths| self.tells(depths));
        let mut all: Vec<(Vec<f64>, f64)> =
            telling.take(HELD_OUT).map(|depths| (depths, OFF)).collect();
        if all.len() < HELD_OUT {
            return Ok(false);
        }
        let (n, depth) = UNEVEN;
        let mut uneven = random.many(n, 0.0, 2.0 * depth / n as f64);
        end(session, &mut uneven);
        all.push((uneven, OFF + UNEVEN_OFF * (n as f64).sqrt()));
        let mut left: Vec<bool> = self.known.iter().map(|(own, _)| *own == name).collect();
        for (depths, most) in all {
            let Some([bright, _]) = self.ask(session, &depths)? else {
                return Ok(false);
            };
            for (left, want) in left.iter_mut().zip(self.wanted(&depths)) {
                *left &= (bright - want).abs() <= most;
            }
        }
        Ok(left.contains(&true))
    }

    /// A part of the light taken, then thin segments.
    fn thin(&self, session: &Session<'_>, (front, units): (f64, f64)) -> Vec<f64> {
        let mut depths = vec![units * self.unit(); COUNT + 1];
        depths[0] = -front.ln();
        end(session, &mut depths);
        depths
    }

    /// Whether what is known under different names differs by more than answers may be off any of it.
    fn tells(&self, depths: &[f64]) -> bool {
        let wanted = self.wanted(depths);
        let all = || self.known.iter().zip(&wanted);
        all().all(|((one, _), want)| {
            let mut others = all().filter(|((other, _), _)| other != one);
            others.all(|(_, other)| (want - other).abs() > 2.0 * OFF)
        })
    }

    /// What is seen of the last sample by each of the known, in units.
    fn wanted(&self, depths: &[f64]) -> Vec<f64> {
        let format = Mpfr { bits: self.bits };
        let last = depths.len() - 1;
        let of = |(_, method): &(Transmittance, Compositing)| {
            let samples = depths.iter().enumerate().map(|(index, depth)| {
                let emission = if index == last { BRIGHT } else { 0.0 };
                (format.binary64(emission), format.binary64(*depth))
            });
            let want = method.radiance_of(format, samples).to_float();
            want.to_f64() / self.unit()
        };
        self.known.iter().map(of).collect()
    }

    /// What is seen of the last sample, in units, and of the second one.
    fn ask(&self, session: &mut Session<'_>, depths: &[f64]) -> Result<Option<[f64; 2]>, Silence> {
        let n = depths.len();
        let extinctions: Vec<f64> = depths.iter().map(|depth| depth / STEP).collect();
        let mut layers = Layers::of(STEP, &extinctions);
        for (index, extinction) in extinctions.iter().enumerate() {
            if let Some(Node::Edge(i)) = self.node(index) {
                layers.edges[i] = *extinction;
            }
        }
        let lit = [(n - 1, BRIGHT), (1, SHOWS / self.unit())];
        let emission = lit.map(|(index, bright)| {
            let mut emission = Emission::even(n, 0.0);
            if let Some(node) = self.node(index) {
                *emission.at_mut(node) = bright;
            }
            emission
        });
        let ray = session.ray(&layers, &emission);
        let got = session.ask(&ray)?;
        let [bright, second] = got[..] else {
            return Ok(None);
        };
        Ok(Some([bright / self.unit(), second]))
    }

    /// Where the sample of a segment stands.
    fn node(&self, index: usize) -> Option<Node> {
        self.place.node(isize::try_from(index).ok()?)
    }
}

/// As many segments as can be, of which the last one hides all behind it.
fn end(session: &Session<'_>, depths: &mut Vec<f64>) {
    let thin = depths.last().copied().unwrap_or(0.0);
    let n = (depths.len() + 1).next_multiple_of(session.multiple);
    depths.resize(n - 1, thin);
    depths.push(OPAQUE);
}
