//! From radiance to answer.

use crate::real::{Format, Real};
use serde::{Deserialize, Serialize};

/// y = round(clip(g(x))).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Output {
    /// g.
    pub curve: Curve,
    /// The smallest answer.
    pub low: Option<f64>,
    /// The largest one.
    pub high: Option<f64>,
    /// Answers are multiples of this.
    pub quantum: Option<f64>,
}

/// g.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Curve {
    /// x.
    #[default]
    Linear,
    /// x^γ.
    Gamma(f64),
    /// 12.92 x, and 1.055 x^(1/2.4) − 0.055 above 0.0031308.
    Srgb,
    /// x/(1 + x).
    Reinhard,
    /// 1 − e^(−x).
    Exposure,
}

impl Curve {
    /// g(x).
    pub fn of<R: Real>(self, x: R) -> R {
        let format = x.format();
        match self {
            Curve::Linear => x,
            Curve::Gamma(power) => raised(x, &format.binary64(power)),
            Curve::Srgb => {
                if x <= format.fraction(31_308, 10_000_000) {
                    return x * &format.fraction(1292, 100);
                }
                let power = format.fraction(10, 24);
                raised(x, &power) * &format.fraction(1055, 1000) - &format.fraction(55, 1000)
            }
            Curve::Reinhard => x.clone() / &(format.int(1) + &x),
            Curve::Exposure => -(-x).exp_m1(),
        }
    }

    /// x of g(x).
    #[must_use]
    pub fn inverse(self, y: f64) -> f64 {
        match self {
            Curve::Linear => y,
            Curve::Gamma(power) => y.max(0.0).powf(1.0 / power),
            Curve::Srgb if y <= 12.92 * 0.003_130_8 => y / 12.92,
            Curve::Srgb => ((y + 0.055) / 1.055).powf(2.4),
            Curve::Reinhard => y / (1.0 - y),
            Curve::Exposure => -(-y).ln_1p(),
        }
    }
}

/// x to a power; 0 of what is below 0, and NaN of NaN.
fn raised<R: Real>(x: R, power: &R) -> R {
    let zero = x.format().int(0);
    if x <= zero {
        zero
    } else {
        (x.ln() * power).exp()
    }
}

impl Output {
    /// y.
    pub fn of<R: Real>(&self, x: R) -> R {
        let format = x.format();
        let mut y = self.curve.of(x);
        if let Some(low) = self.low.map(|low| format.binary64(low))
            && y < low
        {
            y = low;
        }
        if let Some(high) = self.high.map(|high| format.binary64(high))
            && y > high
        {
            y = high;
        }
        if let Some(quantum) = self.quantum {
            let quantum = format.binary64(quantum);
            let count = y / &quantum + &format.fraction(1, 2);
            y = super::range::whole(&count) * &quantum;
        }
        y
    }
}

/// Whose answer stands where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Channels {
    /// Each channel's in its own place.
    #[default]
    Straight,
    /// The first and the last of every three have changed places.
    ReversedByThrees,
    /// The last channel's comes first.
    Reversed,
}

impl Channels {
    /// Where the answer of the channel of that index stands among `count`.
    #[must_use]
    pub fn place(self, index: usize, count: usize) -> usize {
        match self {
            Channels::Straight => index,
            Channels::Reversed => count - 1 - index,
            Channels::ReversedByThrees => {
                let start = index - index % 3;
                let length = (count - start).min(3);
                start + length - 1 - index % 3
            }
        }
    }
}
