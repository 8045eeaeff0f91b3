//! What an answer says of a kernel.

use super::cell::{Answer, Cell};
use super::promised::{Promise, absolute};
use super::scenario::{emission, ends_at_kinks, largest_extinction};
use super::truth::Truth;
use crate::kernel::{Declaration, Quantity};
use crate::real::FormatName;
use crate::study::stress::{Scenario, digits, relative_error};
use rug::{Float, Rational};

/// What is said of digits that the usual formula loses.
const CANCELS: &str = "digits are lost as by 1 - exp(-tau d), which cancels where tau d is small; expm1 keeps them \
(a kernel that means it declares a method with subtraction)";

/// How a kernel's rule does where C and τ are the same everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Even {
    /// It is exact but for rounding, or what it gives is known.
    Exact,
    /// It converges with that order.
    OfOrder(f64),
}

/// One answer, and what it is measured by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judged<'a> {
    pub(super) declaration: &'a Declaration,
    pub(super) scenario: &'a Scenario,
    pub(super) quantity: Quantity,
    pub(super) promise: &'a Promise,
    pub(super) even: Even,
}

impl Judged<'_> {
    /// The cell of an answer, or of why there is none.
    pub(super) fn cell(&self, truth: &Truth, answer: Result<&Float, String>) -> Cell {
        let mut cell = Cell {
            scenario: self.scenario.name.clone(),
            quantity: self.quantity,
            n: self.scenario.n,
            value: None,
            truth: truth.exact.clone(),
            digits: None,
            against_truth: None,
            promised: None,
            answer: None,
            reason: None,
            is_fault: false,
        };
        match answer {
            Err(reason) => {
                cell.answer = Some(Answer::Missing);
                cell.reason = Some(reason);
                cell.is_fault = !self.promise.may_be_infinite();
            }
            Ok(value) => {
                cell.value = Some(value.clone());
                if value.is_finite() {
                    self.measure(&mut cell, truth, value);
                } else {
                    cell.answer = Some(if value.is_nan() {
                        Answer::NotANumber
                    } else {
                        Answer::Infinite
                    });
                    cell.is_fault = truth.exists && !self.promise.may_be_infinite();
                }
            }
        }
        cell
    }

    /// Of a finite answer.
    fn measure(&self, cell: &mut Cell, truth: &Truth, value: &Float) {
        let found = |exact: &Float| relative_error(value, exact).map(digits);
        cell.against_truth = truth.exact.as_ref().and_then(found);
        let by = |wanted: &Option<Float>| {
            let wanted = wanted.clone()?;
            let allowed = self.allowed(&wanted);
            let error = Float::with_val(wanted.prec(), value - &wanted).abs();
            Some((error <= allowed, wanted))
        };
        let (first, amplified) = (by(&truth.of_method), by(&truth.amplified));
        let is_amplified =
            matches!(amplified, Some((true, _))) && !matches!(first, Some((true, _)));
        let measured = if is_amplified {
            amplified.clone()
        } else {
            first
        };
        // Nothing is known: it is a number, and that is all.
        let Some((is_kept, wanted)) = measured else {
            return;
        };
        cell.digits = found(&wanted);
        let (is_negative, is_coarse) = (amplified.is_some(), self.is_coarse());
        // Neither formats nor rules say what τ below 0 is.
        let is_free = is_negative && self.declaration.method.is_none() && !is_kept;
        let is_promised = !is_coarse && !is_free && !self.promise.is_void();
        cell.promised = is_promised.then(|| self.promised(&wanted));
        cell.answer = match is_kept {
            _ if is_amplified => Some(Answer::Amplified),
            true if is_negative => Some(Answer::Rectified),
            _ if is_free => Some(Answer::Neither),
            _ if value.is_zero() && !wanted.is_zero() => Some(Answer::Zero),
            false if *value < 0 && wanted >= 0 => Some(Answer::Negative),
            false if is_coarse => Some(Answer::Coarse),
            _ => None,
        };
        cell.is_fault = !is_kept && is_promised;
        if !is_kept && self.cancels(value, &wanted) {
            cell.reason = Some(CANCELS.into());
        }
    }

    /// How far off the wanted answer may be.
    fn allowed(&self, wanted: &Float) -> Float {
        let bits = wanted.prec();
        let size = wanted.clone().abs();
        let rounding = match self.quantity {
            Quantity::Radiance if self.promise.digits > 0.0 => {
                let part = Float::with_val(bits, 10_f64.powf(-self.promise.digits));
                size.clone() * part
            }
            // All of it may be lost; it may not be larger than what rounding makes of nothing.
            Quantity::Radiance => size.clone() + self.promise.absolute,
            other => {
                let size = size.to_f64();
                Float::with_val(bits, absolute(self.declaration, other, self.scenario, size))
            }
        };
        let stored = self.stored(wanted.to_f64());
        let discretization = match self.even {
            Even::OfOrder(order) if self.thickest() <= 1.0 => size * self.thickest().powf(order),
            Even::Exact | Even::OfOrder(_) => Float::new(bits),
        };
        rounding + stored + discretization
    }

    /// What storing an answer of that size may cost, and what is lost below the smallest normal number.
    fn stored(&self, wanted: f64) -> f64 {
        let declaration = self.declaration;
        let brightest = emission(&self.scenario.medium).to_f64().abs();
        let quantum = match self.quantity {
            Quantity::Radiance => declaration.quantum.map(|quantum| quantum.of(brightest)),
            _ => None,
        };
        let output = declaration.output.map(|output| output.half_unit(wanted));
        let formats = [Some(declaration.format), declaration.output];
        let least = formats
            .into_iter()
            .flatten()
            .filter_map(FormatName::smallest_normal);
        // The opacity, its product with C, what passes, of every segment, and the answer.
        let pieces = 1.0 + self.scenario.n as f64 * (1.0 + 2.0 * brightest);
        let lost = if declaration.subnormals_lost {
            pieces * least.fold(0.0, f64::max)
        } else {
            0.0
        };
        let noise = declaration.noise.unwrap_or(0.0);
        quantum.unwrap_or(0.0) / 2.0 + output.unwrap_or(0.0) + lost + noise
    }

    /// Digits for what is allowed.
    fn promised(&self, wanted: &Float) -> f64 {
        if wanted.is_zero() {
            return self.promise.digits;
        }
        let part = (self.allowed(wanted) / wanted).abs().to_f64();
        (-part.log10()).max(0.0)
    }

    /// Whether nothing is promised of the rule: of random numbers, in segments too thick for it, or in segments of its own
    /// that do not end where the medium has kinks.
    fn is_coarse(&self) -> bool {
        let is_thick = matches!(self.even, Even::OfOrder(_)) && self.thickest() > 1.0;
        let is_across = self.declaration.method.is_none()
            && !ends_at_kinks(&self.scenario.medium, self.scenario.n);
        self.declaration.stochastic || is_thick || is_across
    }

    /// The largest τ d.
    fn thickest(&self) -> f64 {
        let largest = largest_extinction(&self.scenario.medium);
        (largest / Rational::from(self.scenario.n)).to_f64()
    }

    /// Whether it is as far off as opacities are that are computed by a subtraction.
    fn cancels(&self, value: &Float, wanted: &Float) -> bool {
        if self.quantity != Quantity::Radiance || self.promise.cancelling >= self.promise.digits {
            return false;
        }
        let size = wanted.clone().abs();
        let error = Float::with_val(wanted.prec(), value - wanted).abs();
        let part = Float::with_val(wanted.prec(), 10_f64.powf(-self.promise.cancelling));
        error <= size * part + self.promise.absolute
    }
}
