//! What one segment with one extinction does: what its emission is multiplied by, and what it lets through.

use super::Depth;
use super::range::{Range, Step, Table, below, to_multiple, whole};
use crate::real::{Format, Real};
use serde::{Deserialize, Serialize};

/// (w, p) of τ and d.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Law {
    /// x.
    pub depth: Depth,
    /// p of x.
    pub shape: Shape,
    /// w of p and x.
    pub weight: Weight,
    /// What w is multiplied by.
    pub scale: Scale,
    /// What is added to p.
    pub eps: f64,
    /// What the opacity is multiplied by before anything is let through.
    pub cover: Scale,
    /// How an exponential is computed.
    pub formula: Formula,
    /// Lengths are rounded to so many significant bits.
    pub length_bits: Option<u32>,
    /// Where p is not what the shape says.
    pub range: Range,
}

/// How 1 − e^(−x) is computed: the same but for rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Formula {
    /// By one exponential.
    #[default]
    Direct,
    /// 1 − (1 − α₁)^d from the opacity α₁ of a unit of length: where that rounds to 1 the segment is opaque.
    Power,
}

/// A factor, 1 unless it is another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scale(pub f64);

impl Default for Scale {
    fn default() -> Self {
        Scale(1.0)
    }
}

/// What is let through, of the depth x.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// e^(−x).
    #[default]
    Exponential,
    /// 1 − x.
    Linear,
    /// 1/(1 + x).
    Reciprocal,
    /// 1 − x + x²/2.
    Quadratic,
    /// (1 − x/2)/(1 + x/2).
    CrankNicolson,
    /// 1: nothing is absorbed.
    Clear,
}

impl Shape {
    /// All of which a depth can be told.
    pub const ABSORBING: [Shape; 5] = [
        Shape::Exponential,
        Shape::Linear,
        Shape::Reciprocal,
        Shape::Quadratic,
        Shape::CrankNicolson,
    ];

    /// 1 − p and p.
    pub fn of<R: Real>(self, x: &R) -> (R, R) {
        let format = x.format();
        let one = || format.int(1);
        match self {
            Shape::Exponential => (-(-x.clone()).exp_m1(), (-x.clone()).exp()),
            Shape::Linear => (x.clone(), one() - x),
            Shape::Reciprocal => {
                let p = one() / &(one() + x);
                (p.clone() * x, p)
            }
            Shape::Quadratic => {
                let a = x.clone() - &(x.clone() * x * &format.fraction(1, 2));
                let p = one() - &a;
                (a, p)
            }
            Shape::CrankNicolson => {
                let half = x.clone() * &format.fraction(1, 2);
                let under = one() + &half;
                (x.clone() / &under, (one() - &half) / &under)
            }
            Shape::Clear => (format.int(0), one()),
        }
    }

    /// x of p in binary64, and of 1 − p, which is given too; NaN where there is none.
    #[must_use]
    pub fn depth(self, opacity: f64, passes: f64) -> f64 {
        match self {
            Shape::Exponential if passes < 0.5 => -passes.ln(),
            Shape::Exponential => -(-opacity).ln_1p(),
            Shape::Linear => opacity,
            Shape::Reciprocal => opacity / passes,
            Shape::Quadratic => {
                // x = 1 − √(1 − 2α).
                let root = (1.0 - 2.0 * opacity).sqrt();
                2.0 * opacity / (1.0 + root)
            }
            Shape::CrankNicolson => 2.0 * opacity / (1.0 + passes),
            Shape::Clear => f64::NAN,
        }
    }
}

/// What the emission is multiplied by, but for the scale.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Weight {
    /// (1 − p)^a p^b.
    Opacity {
        /// a.
        opacity: super::Power,
        /// b.
        passes: super::Power,
    },
    /// x′ p^b with a depth of its own.
    Depth {
        /// x′, whose factor is the scale.
        depth: Depth,
        /// b.
        passes: super::Power,
    },
    /// 1 − p′ of the same shape, with a depth of its own.
    Own {
        /// x′.
        depth: Depth,
        /// The shape of p′.
        shape: Shape,
    },
}

impl Default for Weight {
    /// 1 − p.
    fn default() -> Self {
        Weight::Opacity {
            opacity: super::Power::ONE,
            passes: super::Power::ZERO,
        }
    }
}

impl Law {
    /// (w, p) of a segment of length d on a ray of length D.
    pub fn of<R: Real>(&self, extinction: &R, length: &R, ray: &R) -> (R, R) {
        let format = length.format();
        let range = &self.range;
        let narrow = self.length_bits.map(|bits| rounded(length, bits));
        let length = narrow.as_ref().unwrap_or(length);
        let clamped = range
            .extinction_max
            .map(|most| smaller(extinction.clone(), format.binary64(most)));
        let extinction = clamped.as_ref().unwrap_or(extinction);
        let mut x = self.depth.of(extinction, length, ray);
        if let Some(most) = range.depth_max {
            x = smaller(x, format.binary64(most));
        }
        let (mut opacity, mut passes) = match range.table {
            Some(table) => self.looked_up(table, extinction, length, ray, x.clone()),
            None if self.is_by_power() => self.by_power(extinction, length, ray),
            None => self.shape.of(&x),
        };
        if (self.cover.0 - 1.0).abs() > 0.0 {
            opacity *= &format.binary64(self.cover.0);
            passes = format.int(1) - &opacity;
        }
        let mut set = |value: R| {
            passes = format.int(1) - &value;
            opacity = value;
        };
        if let Some(series) = range.series
            && x < format.binary64(series.below)
        {
            set(taylor(&x, series.terms));
        }
        if let Some(threshold) = range.uncorrected_under {
            let of_table = extinction.clone() * &format.binary64(range.uncorrected_length);
            let (table, through) = Shape::Exponential.of(&of_table);
            if table <= format.binary64(threshold) {
                (opacity, passes) = (table, through);
            }
        }
        let is_skipped = range
            .skip
            .is_some_and(|least| opacity < format.binary64(least));
        let is_skipped = is_skipped
            || range
                .skip_extinction
                .is_some_and(|least| *extinction < format.binary64(least));
        if is_skipped {
            return (format.int(0), format.int(1) + &format.binary64(self.eps));
        }
        if let Some(most) = range.opacity_max {
            let most = format.binary64(most);
            if opacity > most {
                passes = format.int(1) - &most;
                opacity = most;
            }
        }
        if let Some(quantum) = range.quantum.filter(|_| !range.quantised.is_of_unit()) {
            opacity = range.quantised.of(opacity, &format.binary64(quantum));
            passes = format.int(1) - &opacity;
        }
        let weight = self.weigh(&opacity, &passes, [extinction, length, ray]);
        if (self.eps).abs() > 0.0 {
            passes += &format.binary64(self.eps);
        }
        (weight, passes)
    }

    /// Whether the opacity of a unit of length is raised to a power.
    #[must_use]
    pub fn is_by_power(&self) -> bool {
        let has_quantum = self.range.quantum.is_some() && self.range.quantised.is_of_unit();
        self.formula == Formula::Power || has_quantum
    }

    /// (α, p) with p = (1 − α₁)^d.
    fn by_power<R: Real>(&self, extinction: &R, length: &R, ray: &R) -> (R, R) {
        let one = || length.format().int(1);
        let of_unit = Depth {
            length: super::Power::ZERO,
            ..self.depth
        };
        let mut unit = one() - &(-of_unit.of(extinction, length, ray)).exp();
        if let Some(quantum) = self
            .range
            .quantum
            .filter(|_| self.range.quantised.is_of_unit())
        {
            unit = self
                .range
                .quantised
                .of(unit, &length.format().binary64(quantum));
        }
        let through = one() - &unit;
        let passes = if through > length.format().int(0) {
            (through.ln() * length).exp()
        } else {
            through
        };
        (one() - &passes, passes)
    }

    fn weigh<R: Real>(&self, opacity: &R, passes: &R, of: [&R; 3]) -> R {
        let format = opacity.format();
        let [extinction, length, ray] = of;
        let mut weight = match self.weight {
            Weight::Opacity {
                opacity: a,
                passes: b,
            } => {
                let mut weight = a.of(opacity);
                if b != super::Power::ZERO {
                    weight *= &b.of(passes);
                }
                weight
            }
            Weight::Depth { depth, passes: b } => {
                let mut weight = depth.of(extinction, length, ray);
                if let Some(most) = self.range.opacity_max {
                    weight = smaller(weight, format.binary64(most));
                }
                if b != super::Power::ZERO {
                    weight *= &b.of(passes);
                }
                weight
            }
            Weight::Own { depth, shape } => shape.of(&depth.of(extinction, length, ray)).0,
        };
        if (self.scale.0 - 1.0).abs() > 0.0 {
            weight *= &format.binary64(self.scale.0);
        }
        weight
    }

    fn looked_up<R: Real>(
        &self,
        table: Table,
        extinction: &R,
        length: &R,
        ray: &R,
        x: R,
    ) -> (R, R) {
        let format = x.format();
        let step = format.binary64(table.step);
        if table.between == Step::NearestExtinction {
            let rounded = to_multiple(extinction.clone(), &step);
            return self.shape.of(&self.depth.of(&rounded, length, ray));
        }
        let x = match table.top {
            Some(top) => smaller(x, format.binary64(top)),
            None => x,
        };
        match table.between {
            Step::Nearest => self.shape.of(&to_multiple(x, &step)),
            Step::Below => self.shape.of(&below(&x, &step)),
            Step::PowersOfTwo => {
                // z = (step − x)/ln 2; p = 2^⌊z⌋ (1 + z − ⌊z⌋).
                let z = (step - &x) / &format.int(2).ln();
                let low = whole(&z);
                let power = (low.clone() * &format.int(2).ln()).exp();
                let passes = (format.int(1) + &(z - &low)) * &power;
                (format.int(1) - &passes, passes)
            }
            Step::Linear | Step::NearestExtinction => {
                let low = below(&x, &step);
                let high = low.clone() + &step;
                let part = (x - &low) / &step;
                let (near, far) = (self.shape.of(&low).0, self.shape.of(&high).0);
                let opacity = near.clone() + &((far - &near) * &part);
                let passes = format.int(1) - &opacity;
                (opacity, passes)
            }
        }
    }
}

fn smaller<R: Real>(x: R, most: R) -> R {
    if x > most { most } else { x }
}

/// x − x²/2 + … up to that many terms.
fn taylor<R: Real>(x: &R, terms: u8) -> R {
    let format = x.format();
    let (mut sum, mut term) = (format.int(0), format.int(-1));
    for k in 1..=terms {
        term = -(term * x) / &format.int(k.into());
        sum += &term;
    }
    sum
}

/// To that many significant bits, to nearest.
fn rounded<R: Real>(x: &R, bits: u32) -> R {
    match x.to_rational() {
        Some(exact) => {
            let narrow = rug::Float::with_val(bits.max(1), &exact);
            let narrow = narrow.to_rational().unwrap_or_default();
            x.format().ratio(&narrow)
        }
        None => x.clone(),
    }
}
