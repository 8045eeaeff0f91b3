//! A ray that is made up, as a case to methods: it has no closed form, and its medium comes in binary64.

use super::Medium;
use crate::case::{Case, Structure, Transfer};
use crate::real::{Format, Real};
use rug::Rational;

/// One channel of a medium.
#[derive(Debug)]
pub(super) struct MadeUp<'m> {
    medium: &'m dyn Medium,
    channel: usize,
}

impl<'m> MadeUp<'m> {
    pub(super) fn new(medium: &'m dyn Medium, channel: usize) -> Self {
        MadeUp { medium, channel }
    }
}

impl Case for MadeUp<'_> {
    fn name(&self) -> &str {
        self.medium.name()
    }

    fn length(&self) -> Rational {
        self.medium.length().clone()
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let format = s.format();
        let mut emission = vec![0.0; self.medium.channels().len()];
        let extinction = self.medium.at(s.to_float().to_f64(), &mut emission);
        let emission = emission.get(self.channel).copied().unwrap_or(f64::NAN);
        Transfer {
            emission: format.binary64(emission),
            extinction: format.binary64(extinction),
        }
    }

    fn optical_depth<R: Real>(&self, _: &R) -> Option<R> {
        None
    }

    fn radiance<R: Real>(&self, _: &R) -> Option<R> {
        None
    }

    fn structure(&self) -> Structure {
        Structure::default()
    }
}
