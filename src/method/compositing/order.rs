//! In which order segments are composited.

use super::summation::Sum;
use super::tree::Tree;
use super::{OpacityFormula, Sample, Summation, Threshold};
use crate::real::{Format, Real, row};
use std::fmt;

/// In which order segments are composited; the same number in exact arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompositingOrder {
    /// Σ Cⱼ αⱼ Tⱼ from the eye on.
    FrontToBack {
        /// Where Tⱼ comes from.
        depth: Accumulation,
        /// How the radiance's terms are summed, and the depths or what is absorbed where these are.
        summation: Summation,
        /// Where the ray ends early.
        stop: Option<Threshold>,
    },
    /// I ← C α + (1 − α) I from the far end on (Porter and Duff 1984: over). Keeps all samples.
    BackToFront,
    /// Pairs (I, T) of neighbouring stretches merged as (I₁ + T₁ I₂, T₁ T₂) in a balanced binary tree,
    /// neighbours first: over is associative, which parallel renderers live by.
    Tree,
}

/// Where the transmittance in front of a segment comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Accumulation {
    /// T ← T (1 − α), with the very opacity that the segment shows.
    Transmittances,
    /// T = exp(−Σ τ d).
    Depths,
    /// T ← T − T α, what remains of 1 when what is absorbed is taken off. Where segments are thin 1 − α has lost most
    /// of α, and all n losses may go one way; here each is one of the last bits of T, up or down by chance.
    Remainder,
}

/// Compositing from the eye on, ready to run in one format.
pub(super) struct FrontToBack<R> {
    pub(super) opacity: OpacityFormula,
    pub(super) depth: Accumulation,
    pub(super) summation: Summation,
    pub(super) threshold: Option<R>,
}

impl<R: Real> FrontToBack<R> {
    /// The radiance and the number of segments composited; `record` is shown T in front of each.
    pub(super) fn composite(
        &self,
        format: R::Format,
        samples: impl Iterator<Item = Sample<R>>,
        mut record: impl FnMut(&R),
    ) -> (R, u64) {
        let one = format.int(1);
        let mut so_far = SoFar::new(self, format, &one);
        // One loop each: the shorter one is to be one with the evaluation of the case.
        if R::Format::IN_LANES {
            for (sample, alpha) in in_rows(self.opacity, samples) {
                record(&so_far.transmittance);
                let segment = Segment::new(self.depth, sample, alpha, &one);
                if so_far.passes(self, segment) {
                    break;
                }
            }
        } else {
            for sample in samples {
                let alpha = self.opacity.of(&sample.depth);
                record(&so_far.transmittance);
                let segment = Segment::new(self.depth, sample, alpha, &one);
                if so_far.passes(self, segment) {
                    break;
                }
            }
        }
        (so_far.radiance.value(), so_far.composited)
    }

    /// The same of `count` segments that are all alike.
    pub(super) fn composite_even(
        &self,
        sample: Sample<R>,
        count: u64,
        mut record: impl FnMut(&R),
    ) -> (R, u64) {
        let format = sample.depth.format();
        let one = format.int(1);
        let mut so_far = SoFar::new(self, format, &one);
        let alpha = self.opacity.of(&sample.depth);
        let segment = Segment::new(self.depth, sample, alpha, &one);
        for _ in 0..count {
            record(&so_far.transmittance);
            if so_far.passes(self, segment.clone()) {
                break;
            }
        }
        (so_far.radiance.value(), so_far.composited)
    }
}

/// What a segment shows, and what it does to what is seen through it.
#[derive(Clone)]
struct Segment<R> {
    /// C α.
    shown: R,
    /// 1 − α, τ d or α: what T comes from.
    effect: R,
}

impl<R: Real> Segment<R> {
    #[inline]
    fn new(depth: Accumulation, sample: Sample<R>, alpha: R, one: &R) -> Self {
        Segment {
            shown: sample.emission * &alpha,
            effect: match depth {
                Accumulation::Transmittances => one.clone() - &alpha,
                Accumulation::Depths => sample.depth,
                Accumulation::Remainder => alpha,
            },
        }
    }
}

/// What has been composited from the eye on.
struct SoFar<R> {
    radiance: Sum<R>,
    /// The depth, or what remains.
    passed: Sum<R>,
    transmittance: R,
    composited: u64,
}

impl<R: Real> SoFar<R> {
    fn new(way: &FrontToBack<R>, format: R::Format, one: &R) -> Self {
        let mut passed = Sum::new(way.summation, format);
        if way.depth == Accumulation::Remainder {
            passed.add(one);
        }
        SoFar {
            radiance: Sum::new(way.summation, format),
            passed,
            transmittance: one.clone(),
            composited: 0,
        }
    }

    /// Passes a segment; whether the ray ends behind it.
    #[inline]
    fn passes(&mut self, way: &FrontToBack<R>, segment: Segment<R>) -> bool {
        let light = segment.shown * &self.transmittance;
        self.radiance.add(&light);
        self.composited += 1;
        match way.depth {
            Accumulation::Transmittances => self.transmittance *= &segment.effect,
            Accumulation::Depths => {
                self.passed.add(&segment.effect);
                self.transmittance = (-self.passed.value()).exp();
            }
            Accumulation::Remainder => {
                self.passed.add(&-(segment.effect * &self.transmittance));
                self.transmittance = self.passed.value();
            }
        }
        let threshold = way.threshold.as_ref();
        threshold.is_some_and(|threshold| self.transmittance < *threshold)
    }
}

/// Samples whose opacities are computed together.
const ROW: usize = 512;

/// Samples with their opacities, a row of these at a time.
fn in_rows<R: Real>(
    opacity: OpacityFormula,
    mut samples: impl Iterator<Item = Sample<R>>,
) -> impl Iterator<Item = (Sample<R>, R)> {
    let rows = std::iter::from_fn(move || {
        let samples = row(samples.by_ref().take(ROW));
        let depths = row(samples.iter().map(|sample| sample.depth.clone()));
        (!samples.is_empty()).then(|| samples.into_iter().zip(opacity.of_row(&depths)))
    });
    rows.flatten()
}

/// I ← C α + (1 − α) I over all samples, given from front to back.
pub(super) fn back_to_front<R: Real>(
    format: R::Format,
    opacity: OpacityFormula,
    samples: Vec<Sample<R>>,
) -> R {
    let one = format.int(1);
    let mut radiance = format.int(0);
    for sample in samples.into_iter().rev() {
        Stretch::new(opacity, sample, &one).cover(&mut radiance);
    }
    radiance
}

/// The same of `count` segments that are all alike.
pub(super) fn back_to_front_even<R: Real>(
    opacity: OpacityFormula,
    sample: Sample<R>,
    count: u64,
) -> R {
    let format = sample.depth.format();
    let segment = Stretch::new(opacity, sample, &format.int(1));
    let mut radiance = format.int(0);
    for _ in 0..count {
        segment.cover(&mut radiance);
    }
    radiance
}

/// The front of the balanced tree over all samples, given from front to back.
pub(super) fn by_tree<R: Real>(
    format: R::Format,
    opacity: OpacityFormula,
    samples: impl Iterator<Item = Sample<R>>,
) -> R {
    let one = format.int(1);
    let mut tree = Tree::new();
    for sample in samples {
        tree.push(Stretch::new(opacity, sample, &one), Stretch::over);
    }
    let whole = tree.root(Stretch::over);
    whole.map_or_else(|| format.int(0), |whole| whole.radiance)
}

/// The same of `count` segments that are all alike.
pub(super) fn by_tree_even<R: Real>(opacity: OpacityFormula, sample: Sample<R>, count: u64) -> R {
    let format = sample.depth.format();
    let segment = Stretch::new(opacity, sample, &format.int(1));
    let whole = Tree::of_equal(segment, count, Stretch::over);
    whole.map_or_else(|| format.int(0), |whole| whole.radiance)
}

/// A stretch of the ray: what it emits to its front, and what it lets through.
#[derive(Clone)]
struct Stretch<R> {
    radiance: R,
    transmittance: R,
}

impl<R: Real> Stretch<R> {
    /// That of one segment.
    #[inline]
    fn new(opacity: OpacityFormula, sample: Sample<R>, one: &R) -> Self {
        let alpha = opacity.of(&sample.depth);
        Stretch {
            radiance: sample.emission * &alpha,
            transmittance: one.clone() - &alpha,
        }
    }

    /// Puts this in front of what shines with that radiance.
    #[inline]
    fn cover(&self, behind: &mut R) {
        *behind *= &self.transmittance;
        *behind += &self.radiance;
    }

    fn over(self, behind: Self) -> Self {
        let through = behind.radiance * &self.transmittance;
        Stretch {
            radiance: self.radiance + &through,
            transmittance: self.transmittance * &behind.transmittance,
        }
    }
}

impl fmt::Display for Accumulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Accumulation::Transmittances => "transmittances",
            Accumulation::Depths => "depths",
            Accumulation::Remainder => "remainder",
        })
    }
}
