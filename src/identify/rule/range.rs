//! Where a law does not hold: clamps, skips, series, steps and tables.

use crate::real::{Format, Real};
use serde::{Deserialize, Serialize};

/// Where a law does not hold, or holds otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// A depth above this counts as this.
    pub depth_max: Option<f64>,
    /// An extinction above this counts as this.
    pub extinction_max: Option<f64>,
    /// An opacity under this is none.
    pub skip: Option<f64>,
    /// An extinction under this is none.
    pub skip_extinction: Option<f64>,
    /// An opacity above this is this.
    pub opacity_max: Option<f64>,
    /// Where 1 − e^(−τℓ) is not above this, that is the opacity, whatever the step.
    pub uncorrected_under: Option<f64>,
    /// ℓ of it.
    pub uncorrected_length: f64,
    /// A polynomial in place of e^(−x) where x is small.
    pub series: Option<Series>,
    /// Opacities are multiples of this.
    pub quantum: Option<f64>,
    /// Which opacities are, and which multiple is taken.
    pub quantised: Quantised,
    /// Opacities are looked up.
    pub table: Option<Table>,
}

/// How opacities become multiples of a quantum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantised {
    /// To the nearest one.
    #[default]
    Nearest,
    /// To the one below.
    Below,
    /// The opacity α₁ of a unit of length is, to the nearest one; that of a segment is 1 − (1 − α₁)^d.
    UnitNearest,
    /// The same to the one below.
    UnitBelow,
}

impl Quantised {
    /// All of them.
    pub const ALL: [Quantised; 4] = [
        Quantised::Nearest,
        Quantised::Below,
        Quantised::UnitNearest,
        Quantised::UnitBelow,
    ];

    /// Whether it is the opacity of a unit of length.
    #[must_use]
    pub fn is_of_unit(self) -> bool {
        matches!(self, Quantised::UnitNearest | Quantised::UnitBelow)
    }

    /// Whether the multiple below is taken.
    #[must_use]
    pub fn is_below(self) -> bool {
        matches!(self, Quantised::Below | Quantised::UnitBelow)
    }

    pub(super) fn of<R: Real>(self, opacity: R, quantum: &R) -> R {
        if self.is_below() {
            below(&opacity, quantum)
        } else {
            to_multiple(opacity, quantum)
        }
    }
}

/// 1 − e^(−x) ≈ x − x²/2 + … up to xᴷ, where x < `below`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// The depth.
    pub below: f64,
    /// K.
    pub terms: u8,
}

/// e^(−x) by a table over x.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// The width of its cells.
    pub step: f64,
    /// The depth of the last entry, above which its value is taken.
    pub top: Option<f64>,
    /// What is done between entries.
    pub between: Step,
}

/// What a table gives between its entries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Step {
    /// The nearest one.
    Nearest,
    /// The one before.
    Below,
    /// The line between both.
    Linear,
    /// The nearest of a table of extinctions: τ is rounded, and not x.
    NearestExtinction,
    /// The line between powers of two of which e^(−x) has one at x = `step`, as where the bits of a float are taken for
    /// its logarithm (Schraudolph 1999).
    PowersOfTwo,
}

impl Range {
    /// Whether the law holds everywhere.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        *self
            == Range {
                uncorrected_length: self.uncorrected_length,
                ..Range::default()
            }
    }
}

/// The nearest multiple.
pub(super) fn to_multiple<R: Real>(x: R, step: &R) -> R {
    let format = x.format();
    let half = step.clone() * &format.fraction(1, 2);
    below(&(x + &half), step)
}

/// The multiple that is not above.
pub(super) fn below<R: Real>(x: &R, step: &R) -> R {
    let cells = x.clone() / step;
    whole(&cells) * step
}

/// The integer that is not above; x itself where it is not finite.
pub(super) fn whole<R: Real>(x: &R) -> R {
    match x.to_rational() {
        Some(exact) => x.format().ratio(&exact.floor()),
        None => x.clone(),
    }
}
