//! The medium on the nested points of a panel: every point is sampled once.

use super::super::ReferenceError;
use super::super::chebyshev::{Circle, Series, log2_abs};
use super::super::medium::Medium;
use super::panel::Panel;
use super::stretch::Stretch;
use super::{Settings, Work};
use rug::Float;
use std::f64::consts::LOG2_E;

/// Values of the medium on the points of a panel, from the left.
pub(super) struct Grid<'g> {
    stretch: &'g Stretch,
    panel: &'g Panel,
    /// Whether the left and the right end may belong to the other side of a break.
    is_open: [bool; 2],
    /// τ, times dλ/dv.
    extinction: Vec<Float>,
    /// C·τ, times dλ/dv.
    source: Vec<Float>,
}

impl<'g> Grid<'g> {
    /// No points yet.
    pub(super) fn new(stretch: &'g Stretch, panel: &'g Panel) -> Grid<'g> {
        Grid {
            stretch,
            panel,
            is_open: [
                panel.is_first && stretch.is_open_left,
                panel.is_last && stretch.is_open_right,
            ],
            extinction: Vec::new(),
            source: Vec::new(),
        }
    }

    /// n, of n + 1 points.
    pub(super) fn degree(&self) -> usize {
        self.extinction.len().saturating_sub(1)
    }

    /// C·τ on the points.
    pub(super) fn source(&self) -> &[Float] {
        &self.source
    }

    /// The series of τ and C·τ.
    pub(super) fn series(&self, circle: &Circle) -> [Series; 2] {
        [&self.extinction, &self.source].map(|values| Series::through(values, circle))
    }

    /// Samples the points of degree `n` that are not there yet: all, or every other one.
    pub(super) fn refine(
        &mut self,
        case: &dyn Medium,
        n: usize,
        circle: &mut Circle,
        work: &mut Work,
    ) -> Result<(), ReferenceError> {
        circle.grow(n);
        let width = self.panel.width();
        let step = if self.extinction.is_empty() { 1 } else { 2 };
        let mut new = Vec::new();
        for k in (step - 1..=n).step_by(step) {
            let [open_left, open_right] = self.is_open;
            if (k == 0 && open_left) || (k == n && open_right) {
                new.push((Float::new(circle.bits()), Float::new(circle.bits())));
                continue;
            }
            let v = circle.place(k, n) * &width + &self.panel.left;
            new.push(self.stretch.sample(case, &v, work)?);
        }
        let (extinction, source): (Vec<Float>, Vec<Float>) = new.into_iter().unzip();
        self.extinction = interleaved(std::mem::take(&mut self.extinction), extinction);
        self.source = interleaved(std::mem::take(&mut self.source), source);
        for values in [&mut self.extinction, &mut self.source] {
            extrapolate(values, self.is_open, circle);
        }
        Ok(())
    }

    /// Refuses a negative τ, but for what rounding does where it is 0.
    pub(super) fn check_signs(
        &self,
        circle: &Circle,
        settings: &Settings,
    ) -> Result<(), ReferenceError> {
        let n = self.degree();
        let [open_left, open_right] = self.is_open;
        let inside = usize::from(open_left)..=n - usize::from(open_right);
        let largest = self
            .extinction
            .iter()
            .map(log2_abs)
            .fold(f64::NEG_INFINITY, f64::max);
        let allowed = largest - f64::from(settings.target) / 2.0;
        for k in inside {
            let value = &self.extinction[k];
            if value.is_sign_negative() && log2_abs(value) > allowed {
                let v = circle.place(k, n) * self.panel.width() + &self.panel.left;
                return Err(ReferenceError::NegativeExtinction {
                    lambda: self.stretch.place(&v).to_f64(),
                });
            }
        }
        Ok(())
    }

    /// log₂ of the light of the panel, roughly and from above, where T is 1 at its left end: what
    /// tolerances are measured by.
    pub(super) fn log2_light(&self) -> f64 {
        let n = self.degree();
        let width = self.panel.width().to_f64();
        let place = |k: usize| {
            let angle = std::f64::consts::PI * k as f64 / n as f64;
            (1.0 - angle.cos()) / 2.0 * width
        };
        let (mut depth, mut most) = (0.0, f64::NEG_INFINITY);
        for k in 0..n {
            let step = place(k + 1) - place(k);
            let larger = log2_abs(&self.source[k]).max(log2_abs(&self.source[k + 1]));
            most = most.max(larger + step.log2() - depth * LOG2_E);
            let sum = self.extinction[k].to_f64() + self.extinction[k + 1].to_f64();
            depth += step * sum / 2.0;
        }
        most
    }
}

/// Old values at even places, new ones between them; the new ones where there are no old ones.
pub(super) fn interleaved(old: Vec<Float>, new: Vec<Float>) -> Vec<Float> {
    let mut old = old.into_iter();
    let Some(first) = old.next() else { return new };
    let mut all = vec![first];
    for (new, old) in new.into_iter().zip(old) {
        all.extend([new, old]);
    }
    all
}

/// Gives open ends the values of the polynomial through the other points: where f is of degree below n,
/// Σ (−1)ᵏ fₖ = 0, and below n − 1 also Σ (−1)ᵏ ξₖ fₖ = 0, ends halved.
fn extrapolate(values: &mut [Float], is_open: [bool; 2], circle: &Circle) {
    let n = values.len().saturating_sub(1);
    let bits = circle.bits();
    let (mut sum, mut moment) = (Float::new(bits), Float::new(bits));
    for (k, value) in values.iter().enumerate().take(n).skip(1) {
        let term = Float::with_val(bits, value * circle.cosine(k, n));
        if k % 2 == 0 {
            sum += value;
            moment += term;
        } else {
            sum -= value;
            moment -= term;
        }
    }
    match is_open {
        [false, false] => {}
        [true, false] => values[0] = -(Float::with_val(bits, &sum << 1_u32) + &values[n]),
        [false, true] => values[n] = -(Float::with_val(bits, &sum << 1_u32) + &values[0]),
        [true, true] => {
            values[0] = -Float::with_val(bits, &sum + &moment);
            values[n] = Float::with_val(bits, &moment - &sum);
        }
    }
}
