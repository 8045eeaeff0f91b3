//! Derivatives of a radiance by the numbers of a task.

use super::{KernelError, Segments};
use rug::Float;

/// Where the values lie by which a kernel differentiates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GradientAt {
    /// In the middles of segments.
    Middles,
    /// At the ends of segments.
    Edges,
}

impl GradientAt {
    /// Its name, as in the protocol and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            GradientAt::Middles => "middles",
            GradientAt::Edges => "edges",
        }
    }

    /// The values that there are of n segments.
    #[must_use]
    pub fn count(self, n: usize) -> usize {
        match self {
            GradientAt::Middles => n,
            GradientAt::Edges => n + 1,
        }
    }
}

/// The inner product of values, in which a backprojector is the adjoint of a projector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum InnerProduct {
    /// Σ xᵢ zᵢ.
    Plain,
    /// Σ dᵢ xᵢ zᵢ, dᵢ the length that value i stands for.
    Lengths,
}

impl InnerProduct {
    /// Its name, as in the protocol and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            InnerProduct::Plain => "plain",
            InnerProduct::Lengths => "lengths",
        }
    }

    /// In words.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            InnerProduct::Plain => "plain: Σ xᵢ zᵢ",
            InnerProduct::Lengths => "lengths: Σ dᵢ xᵢ zᵢ, dᵢ the length that value i stands for",
        }
    }
}

/// The derivatives of Σₖ aₖ Iₖ, aₖ the cotangents of the channels, by the numbers of a task.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gradient {
    /// By τ, value by value.
    pub extinction: Vec<Float>,
    /// By C, channel by channel and value by value.
    pub emission: Vec<Vec<Float>>,
}

impl Gradient {
    /// As many numbers as there are values and channels; the last of the ends may be left out, and counts as 0.
    ///
    /// # Errors
    /// [`KernelError::Gradient`] where there are more, or fewer.
    pub fn checked(
        mut self,
        at: GradientAt,
        segments: &Segments,
        channels: usize,
    ) -> Result<Gradient, KernelError> {
        let n = segments.count();
        let wanted = at.count(n);
        let rows = std::iter::once(("extinction", &mut self.extinction));
        let emission = self.emission.iter_mut().map(|row| ("emission", row));
        for (what, row) in rows.chain(emission) {
            if at == GradientAt::Edges && row.len() == n {
                row.push(Float::new(f64::MANTISSA_DIGITS));
            }
            let got = row.len();
            if got != wanted {
                return Err(KernelError::Gradient { what, got, wanted });
            }
        }
        let (what, got, wanted) = ("channels of emission", self.emission.len(), channels);
        if got != wanted {
            return Err(KernelError::Gradient { what, got, wanted });
        }
        Ok(self)
    }
}
