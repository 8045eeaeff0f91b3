//! The samples that a kernel was given, in a format.

use super::Places;
use crate::case::Transfer;
use crate::kernel::Segments;
use crate::real::{Format, Real};
use rug::Rational;

/// One channel of a ray cut into segments.
#[derive(Clone, Debug)]
pub struct Ray<R> {
    /// Of the segments.
    pub(super) lengths: Vec<R>,
    pub(super) edges: Vec<Transfer<R>>,
    pub(super) middles: Vec<Transfer<R>>,
}

/// One sample and the length that it stands for.
#[derive(Clone, Debug)]
pub(super) struct Sample<R> {
    pub(super) transfer: Transfer<R>,
    pub(super) length: R,
}

impl<R: Real> Ray<R> {
    /// The channel of that index, its binary64 values rounded to `format`; lengths are rounded once.
    #[must_use]
    pub fn new(segments: &Segments, channel: usize, format: R::Format) -> Self {
        let transfers = |samples: &crate::kernel::Samples| {
            let emission = samples.emission.get(channel).into_iter().flatten();
            let both = samples.extinction.iter().zip(emission);
            let both = both.map(|(&extinction, &emission)| Transfer {
                emission: format.binary64(emission),
                extinction: format.binary64(extinction),
            });
            both.collect()
        };
        let lambdas = &segments.edges.lambda;
        let ends = lambdas.iter().zip(lambdas.iter().skip(1));
        let lengths = ends.map(|(&near, &far)| difference(far, near, format));
        Ray {
            lengths: lengths.collect(),
            edges: transfers(&segments.edges),
            middles: transfers(&segments.middles),
        }
    }

    /// n.
    #[must_use]
    pub fn count(&self) -> usize {
        self.lengths.len()
    }

    /// One sample a segment, front to back.
    pub(super) fn samples(&self, places: Places) -> Vec<Sample<R>> {
        let transfers = match places {
            Places::Middle => self.middles.iter(),
            Places::Back => self.edges.get(1..).unwrap_or_default().iter(),
            Places::Front | Places::Ends | Places::Linear => self.edges.iter(),
        };
        let both = transfers.zip(&self.lengths);
        let both = both.map(|(transfer, length)| Sample {
            transfer: transfer.clone(),
            length: length.clone(),
        });
        both.collect()
    }

    /// The sample that one step too many takes.
    pub(super) fn extra(&self, places: Places) -> Option<Sample<R>> {
        let transfer = match places {
            Places::Back => self.edges.first(),
            Places::Middle => self.middles.last(),
            Places::Front | Places::Ends | Places::Linear => self.edges.last(),
        };
        Some(Sample {
            transfer: transfer?.clone(),
            length: self.lengths.first()?.clone(),
        })
    }
}

/// far − near, rounded once.
fn difference<F: Format>(far: f64, near: f64, format: F) -> F::Real {
    let rounded = far - near;
    // What rounding took (Knuth's two-sum): nothing of neighbours on a ray, but for the very first.
    let taken = far - rounded;
    let lost = (far - (rounded + taken)) - (near - taken);
    if lost == 0.0 {
        return format.binary64(rounded);
    }
    let exact = Rational::from_f64(far).zip(Rational::from_f64(near));
    exact.map_or_else(
        || format.binary64(f64::NAN),
        |(far, near)| format.ratio(&(far - near)),
    )
}
