//! Derivatives beside theory, at one level.

use super::along::Along;
use super::{Against, Derivative, Norm};
use crate::kernel::Gradient;
use rug::Float;

/// Bits of differences.
const BITS: u32 = 128;

/// What of a level is compared.
pub(super) struct Looked<'a> {
    pub(super) along: &'a Along,
    /// The length that each value stands for.
    pub(super) lengths: &'a [Option<f64>],
    /// Of each value whether it is looked at, by derivative.
    pub(super) at: &'a [[bool; 2]],
    pub(super) cotangents: &'a [f64],
}

/// Errors of one derivative, as parts of its scale, with the lengths that they stand for.
#[derive(Default)]
pub(super) struct Errors {
    parts: Vec<(f64, f64)>,
}

impl Errors {
    /// In a norm; `None` where nothing is looked at.
    pub(super) fn norm(&self, norm: Norm) -> Option<f64> {
        if self.parts.is_empty() {
            return None;
        }
        let sizes = self.parts.iter().map(|(error, _)| error.abs());
        Some(match norm {
            // NaN is the largest of all.
            Norm::Largest => sizes.max_by(f64::total_cmp)?,
            Norm::MeanSquare => {
                let total: f64 = self.parts.iter().map(|(_, length)| length).sum();
                let squares = self
                    .parts
                    .iter()
                    .map(|(error, length)| error * error * length);
                (squares.sum::<f64>() / total).sqrt()
            }
        })
    }
}

impl Looked<'_> {
    /// The size of what a derivative is compared with: of τ the largest Σ |aₖ Cₖ|, of C the largest |τ| T; 1 where
    /// that is 0.
    pub(super) fn scale(&self, derivative: Derivative) -> f64 {
        let sizes = (0..self.lengths.len()).map(|index| match derivative {
            Derivative::Extinction => {
                let channels = self.along.emission.iter().zip(self.cotangents);
                let sizes = channels.map(|(row, a)| at(row, index).to_f64().abs() * a.abs());
                sizes.sum()
            }
            Derivative::Emission => self.emission(index).to_f64().abs(),
        });
        let largest = sizes.fold(0.0, f64::max);
        if largest > 0.0 { largest } else { 1.0 }
    }

    /// δI/δC = τ T.
    fn emission(&self, index: usize) -> Float {
        at(&self.along.extinction, index) * at(&self.along.transmittance, index)
    }

    /// δ Σ aₖ Iₖ / δτ = Σ aₖ (T Cₖ − Rₖ).
    fn extinction(&self, index: usize) -> Float {
        let mut sum = Float::new(BITS);
        let channels = self.along.emission.iter().zip(&self.along.behind);
        for ((emission, behind), a) in channels.zip(self.cotangents) {
            let own = at(emission, index) * at(&self.along.transmittance, index);
            sum += (own - at(behind, index)) * *a;
        }
        sum
    }

    /// What the derivatives are off, as parts of the scale.
    pub(super) fn errors(&self, gradient: &Gradient, derivative: Derivative) -> Errors {
        let scale = self.scale(derivative);
        let mut errors = Errors::default();
        for (index, looked_at) in self.at.iter().enumerate() {
            let Some(Some(length)) = self.lengths.get(index) else {
                continue;
            };
            if !looked_at[derivative as usize] {
                continue;
            }
            let mut push = |error: Float| errors.parts.push((error.to_f64() / scale, *length));
            match derivative {
                Derivative::Extinction => {
                    push(at(&gradient.extinction, index) / *length - self.extinction(index));
                }
                Derivative::Emission => {
                    for (row, a) in gradient.emission.iter().zip(self.cotangents) {
                        push(at(row, index) / *length / *a - self.emission(index));
                    }
                }
            }
        }
        errors
    }

    /// What the sum along the ray is off, as a part of what theory has without its signs; `None` where that is 0.
    pub(super) fn part(
        &self,
        gradient: &Gradient,
        derivative: Derivative,
        against: Against,
    ) -> Option<f64> {
        let (mut off, mut size) = (Float::new(BITS), Float::new(BITS));
        for (index, looked_at) in self.at.iter().enumerate() {
            let Some(Some(length)) = self.lengths.get(index) else {
                continue;
            };
            if !looked_at[derivative as usize] {
                continue;
            }
            let theory = match derivative {
                Derivative::Extinction => self.extinction(index),
                Derivative::Emission => self.emission(index),
            };
            let weight = match against {
                Against::Sum => Float::with_val(BITS, 1),
                Against::Theory => theory.clone(),
            };
            let whole = theory * *length;
            let mut add = |got: Float| {
                off += (got - &whole) * &weight;
                size += Float::with_val(BITS, &whole * &weight).abs();
            };
            match derivative {
                Derivative::Extinction => add(at(&gradient.extinction, index)),
                Derivative::Emission => {
                    for (row, a) in gradient.emission.iter().zip(self.cotangents) {
                        add(at(row, index) / *a);
                    }
                }
            }
        }
        (!size.is_zero()).then(|| (off / size).to_f64())
    }

    /// Whether theory is 0, within rounding, wherever it is looked at.
    pub(super) fn is_zero(&self, derivative: Derivative) -> bool {
        let small = self.scale(derivative) * f64::EPSILON;
        let mut indices = (0..self.at.len()).filter(|index| {
            let looked_at = self.at.get(*index);
            looked_at.is_some_and(|looked_at| looked_at[derivative as usize])
        });
        indices.all(|index| {
            let value = match derivative {
                Derivative::Extinction => self.extinction(index),
                Derivative::Emission => self.emission(index),
            };
            value.to_f64().abs() <= small
        })
    }

    /// At how many kinks the derivative by τ is 0 although theory's is not.
    pub(super) fn flat(&self, gradient: &Gradient) -> usize {
        let small = self.scale(Derivative::Extinction) * f64::EPSILON;
        let is_flat = |(index, looked_at): (usize, &[bool; 2])| {
            // What else is left out is so by C, too.
            let is_kink = *looked_at == [false, true];
            is_kink
                && at(&gradient.extinction, index).is_zero()
                && self.extinction(index).to_f64().abs() > small
        };
        let flat = self.at.iter().enumerate().filter(|one| is_flat(*one));
        flat.count()
    }

    /// Whether a value that is not used has a derivative.
    pub(super) fn has_unused(&self, gradient: &Gradient) -> bool {
        let rows = gradient.emission.iter().chain([&gradient.extinction]);
        let mut values = rows.flat_map(|row| row.iter().zip(self.lengths));
        values.any(|(value, length)| length.is_none() && !value.is_zero())
    }
}

/// As it is, in so many bits; NaN where there is none.
fn at(row: &[Float], index: usize) -> Float {
    row.get(index).map_or_else(
        || Float::with_val(BITS, f64::NAN),
        |x| Float::with_val(BITS, x),
    )
}

/// All numbers of one derivative.
pub(super) fn numbers(gradient: &Gradient, derivative: Derivative) -> impl Iterator<Item = &Float> {
    let rows = match derivative {
        Derivative::Extinction => std::slice::from_ref(&gradient.extinction),
        Derivative::Emission => &gradient.emission,
    };
    rows.iter().flatten()
}
