//! What answers may be off by what their kernel declares of its arithmetic, beside roundings of its format.

use super::{Asked, Level, Wanted};
use crate::kernel::{Quantity, Segments, Source, UlpBound};
use crate::real::FormatName;
use crate::study::verify::nominal::{Given, unit};
use rug::Float;
use std::f64::consts::LN_2;

/// Of one answer.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Allowance {
    /// Half of what answers are multiples of: rounded once, at the end.
    pub(super) stored: f64,
    /// What scatters by chance, and what is lost below the smallest normal number.
    pub(super) chance: f64,
    /// What functions that are not rounded right come to in all.
    pub(super) functions: f64,
}

impl Allowance {
    pub(super) fn whole(self) -> f64 {
        self.stored + self.chance + self.functions
    }
}

impl Asked<'_> {
    /// Of an answer of that size to rays of which the largest |C| is the `brightest`.
    pub(super) fn allowance(
        &self,
        wanted: &Wanted,
        exact: &Float,
        given: &Given<'_>,
        brightest: f64,
    ) -> Allowance {
        let declaration = self.declaration;
        // Radiances, and opacities, which are stored beside them.
        let quantum = match wanted.quantity {
            Quantity::Radiance => declaration.quantum.map(|quantum| quantum.of(brightest)),
            Quantity::Opacity => declaration.quantum.map(|quantum| quantum.of(1.0)),
            // Stored as the radiance of a ray whose emission is τ.
            Quantity::Emission => {
                let samples = [&given.segments.edges, &given.segments.middles].into_iter();
                let all = samples.flat_map(|samples| &samples.extinction);
                let most = all.copied().fold(0.0, f64::max);
                declaration.quantum.map(|quantum| quantum.of(most))
            }
            Quantity::OpticalDepth | Quantity::ExpectedDepth => None,
        };
        let output = declaration.output;
        let output = output.map_or(0.0, |output| output.half_unit(exact.to_f64()));
        let parts = Parts::new(given);
        // −ln T is off by what T is off by as a part of itself.
        let functions = match wanted.quantity {
            Quantity::OpticalDepth => parts.relative(self),
            // Nothing absorbs.
            Quantity::Emission => 0.0,
            Quantity::ExpectedDepth if wanted.is_divided() => {
                parts.functions(self) / parts.opacity().max(f64::MIN_POSITIVE)
            }
            _ => parts.functions(self),
        };
        let lost = if declaration.subnormals_lost {
            let least = declaration.format.smallest_normal().unwrap_or(0.0);
            let stored = declaration.output.and_then(FormatName::smallest_normal);
            parts.lost(least) + stored.unwrap_or(0.0)
        } else {
            0.0
        };
        Allowance {
            stored: quantum.unwrap_or(0.0) / 2.0 + output,
            chance: declaration.noise.unwrap_or(0.0) + lost,
            functions,
        }
    }

    /// The largest |C| that a kernel is given of a ray, or |C τ| of one that takes the source per length.
    pub(super) fn brightest(&self, level: &Level, segments: &Segments) -> f64 {
        if self.declaration.source == Source::Length {
            let samples = [&segments.edges, &segments.middles].into_iter();
            let rows = samples.flat_map(|samples| {
                let row = |row| (row, &samples.extinction);
                samples.emission.iter().map(row)
            });
            let all = rows.flat_map(|(c, tau): (&Vec<f64>, &Vec<f64>)| c.iter().zip(tau));
            return all.map(|(c, tau)| (c * tau).abs()).fold(0.0, f64::max);
        }
        let emission: Vec<&Vec<f64>> = if let Some(volume) = &level.volume {
            volume.table.emission.iter().collect()
        } else {
            let (edges, middles) = (&segments.edges.emission, &segments.middles.emission);
            edges.iter().chain(middles).collect()
        };
        let all = emission.into_iter().flatten();
        all.map(|c| c.abs()).fold(0.0, f64::max)
    }
}

/// One segment of a ray of samples in the middles.
#[derive(Clone, Copy, Debug)]
struct Part {
    /// τ d.
    depth: f64,
    /// t in front of it.
    before: f64,
    /// C.
    emission: f64,
    /// The radiance of what is behind it, seen from its end.
    behind: f64,
}

/// A ray, to the first order in errors of its opacities.
///
/// I = Σ Cⱼ Tⱼ (1 − fⱼ), Tⱼ = Π_{i<j} fᵢ with fⱼ = e^(−τⱼ dⱼ). An error εⱼ of fⱼ changes I by Tⱼ (Rⱼ − Cⱼ) εⱼ, Rⱼ being the
/// radiance of what is behind segment j. Where fⱼ is right in the opacity and not in the transmittance that is Tⱼ Rⱼ εⱼ, and
/// Tⱼ Cⱼ εⱼ where it is the other way round: the largest of the three counts. Equal segments have equal errors, so that they
/// add up: the sum grows like n where εⱼ does not fall, and not like √n.
struct Parts(Vec<Part>);

impl Parts {
    fn new(given: &Given<'_>) -> Parts {
        let middles = &given.segments.middles;
        let lengths = given.segments.lengths();
        let depths = middles.extinction.iter().zip(lengths);
        let none = Vec::new();
        let emission = middles.emission.get(given.channel).unwrap_or(&none);
        let mut before = 0.0;
        let mut parts: Vec<Part> = depths
            .zip(emission)
            .map(|((extinction, length), emission)| {
                let depth = (extinction * length).max(0.0);
                let part = Part {
                    depth,
                    before,
                    emission: *emission,
                    behind: 0.0,
                };
                before += depth;
                part
            })
            .collect();
        let mut behind = 0.0;
        for part in parts.iter_mut().rev() {
            part.behind = behind;
            let passes = (-part.depth).exp();
            behind = part.emission * -(-part.depth).exp_m1() + passes * behind;
        }
        Parts(parts)
    }

    /// Σ |∂I/∂fⱼ| εⱼ of errors εⱼ of every segment.
    fn sum(&self, error: impl Fn(&Part) -> f64) -> f64 {
        let all = self.0.iter().map(|part| {
            let (c, r) = (part.emission, part.behind);
            let size = c.abs().max(r.abs()).max((r - c).abs());
            (-part.before).exp() * size * error(part)
        });
        all.sum()
    }

    /// What declared bounds of functions come to, one declared beside another one used beside it.
    fn functions(&self, asked: &Asked<'_>) -> f64 {
        let declaration = asked.declaration;
        let u = unit(declaration);
        let exp = declaration.exp_ulp.map_or(0.0, |bound| {
            let of_segments = self.sum(|part| bound.at(part.depth) * unit_of(-part.depth, u));
            of_segments.max(self.of_whole_depths(bound, u))
        });
        let expm1 = declaration.expm1_ulp.map_or(0.0, |bound| {
            let opacity = |part: &Part| -(-part.depth).exp_m1();
            self.sum(|part| bound.at(part.depth) * (2.0 * u * opacity(part)).min(u))
        });
        let pow = declaration.pow_ulp.map_or(0.0, |bound| {
            self.sum(|part| bound.at(part.depth / LN_2) * unit_of(-part.depth, u))
        });
        exp + expm1 + pow
    }

    /// Where e^(−t) is that of the whole depth in front: Σ Cⱼ (e^(−tⱼ) − e^(−tⱼ₊₁)) = C₀ + Σ (Cⱼ − Cⱼ₋₁) e^(−tⱼ) − …, or a
    /// quadrature Σ Cⱼ τⱼ dⱼ e^(−tⱼ).
    fn of_whole_depths(&self, bound: UlpBound, u: f64) -> f64 {
        let Some(last) = self.0.last() else {
            return 0.0;
        };
        let error = |t: f64| bound.at(t) * unit_of(-t, u);
        let mut sum = 0.0;
        let mut c = 0.0;
        for part in &self.0 {
            let steps = (part.emission - c).abs() + part.emission.abs() * part.depth;
            sum += steps * error(part.before);
            c = part.emission;
        }
        sum + c.abs() * error(last.before + last.depth)
    }

    /// By what part of itself T may be off.
    fn relative(&self, asked: &Asked<'_>) -> f64 {
        let declaration = asked.declaration;
        let u = unit(declaration);
        let all = self.0.iter().map(|part| {
            let at = |bound: Option<UlpBound>, x: f64| bound.map_or(0.0, |bound| bound.at(x));
            let exp = at(declaration.exp_ulp, part.depth);
            let pow = at(declaration.pow_ulp, part.depth / LN_2);
            let expm1 = at(declaration.expm1_ulp, part.depth);
            2.0 * u * (exp + pow + expm1 * part.depth.exp_m1().min(1.0))
        });
        all.sum()
    }

    /// Opacities, products and transmittances below the smallest normal number are 0.
    fn lost(&self, least: f64) -> f64 {
        let of_opacities = self.sum(|_| least);
        let brightest = self.0.iter().map(|part| part.emission.abs());
        of_opacities + least * (1.0 + self.0.len() as f64 + brightest.fold(0.0, f64::max))
    }

    fn opacity(&self) -> f64 {
        let last = self.0.last();
        last.map_or(0.0, |last| -(-last.before - last.depth).exp_m1())
    }
}

/// A unit in the last place of e^x, x ≤ 0, where 2u is that of 1: u itself down to ½, no more than 2u e^x anywhere.
fn unit_of(x: f64, u: f64) -> f64 {
    (2.0 * u * x.exp()).min(u)
}
