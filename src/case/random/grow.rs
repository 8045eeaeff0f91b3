//! Parts of a depth: functions of λ that begin at 0 and never fall.

use super::Draw;
use rug::Rational;

/// A part of a depth t(λ); all its numbers are positive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Grow {
    /// a λⁿ.
    Power {
        /// a.
        factor: Rational,
        /// n ≥ 1.
        exponent: u32,
    },
    /// a (1 − e^(−kλ)).
    Saturation {
        /// a.
        factor: Rational,
        /// k.
        rate: Rational,
    },
    /// a (λ + b/k sin kλ), of extinction a (1 + b cos kλ).
    Sine {
        /// a.
        factor: Rational,
        /// b ≤ 1.
        part: Rational,
        /// k.
        frequency: Rational,
    },
    /// a (λ + b/k (1 − cos kλ)), of extinction a (1 + b sin kλ).
    Cosine {
        /// a.
        factor: Rational,
        /// b ≤ 1.
        part: Rational,
        /// k.
        frequency: Rational,
    },
    /// a (3x² − 2x³) with x = λ/D, of an extinction that is 0 at both ends: it hides what Riemann sums do
    /// wrong there.
    Hump {
        /// a.
        factor: Rational,
    },
}

impl Grow {
    pub(super) fn draw(draw: &mut Draw, decays_only: bool) -> Grow {
        let factor = draw.factor();
        if decays_only {
            // Integer rates make integer powers of the field.
            let rate = draw.number(1, 2);
            return Grow::Saturation { factor, rate };
        }
        match draw.below(9) {
            0..4 => Grow::Power {
                factor,
                exponent: 1 + draw.below(4),
            },
            4 | 5 => Grow::Saturation {
                factor,
                rate: draw.number(1, 4) / 2,
            },
            6 => Grow::Sine {
                factor,
                part: draw.number(1, 4) / 4,
                frequency: draw.number(1, 6) / 2,
            },
            7 => Grow::Cosine {
                factor,
                part: draw.number(1, 4) / 4,
                frequency: draw.number(1, 6) / 2,
            },
            _ => Grow::Hump { factor },
        }
    }

    pub(super) fn factor_mut(&mut self) -> &mut Rational {
        match self {
            Grow::Power { factor, .. }
            | Grow::Saturation { factor, .. }
            | Grow::Sine { factor, .. }
            | Grow::Cosine { factor, .. }
            | Grow::Hump { factor } => factor,
        }
    }

    /// About what it is at λ = `length`, the far end.
    #[must_use]
    pub fn at_far_end(&self, length: f64) -> f64 {
        match self {
            Grow::Power { factor, exponent } => {
                let power: f64 = (0..*exponent).map(|_| length).product();
                factor.to_f64() * power
            }
            Grow::Saturation { factor, rate } => {
                factor.to_f64() * -(-rate.to_f64() * length).exp_m1()
            }
            // The oscillation is at most as much again.
            Grow::Sine { factor, .. } | Grow::Cosine { factor, .. } => factor.to_f64() * length,
            Grow::Hump { factor } => factor.to_f64(),
        }
    }

    /// As a case file has it, for a ray of that length.
    pub(super) fn text(&self, length: &Rational) -> String {
        match self {
            Grow::Power { factor, exponent } => format!("{factor}*lambda^{exponent}"),
            Grow::Saturation { factor, rate } => format!("{factor}*(1 - exp(-{rate}*lambda))"),
            Grow::Sine {
                factor,
                part,
                frequency,
            } => {
                let part = Rational::from(part / frequency);
                format!("{factor}*(lambda + {part}*sin({frequency}*lambda))")
            }
            Grow::Cosine {
                factor,
                part,
                frequency,
            } => {
                let part = Rational::from(part / frequency);
                format!("{factor}*(lambda + {part}*(1 - cos({frequency}*lambda)))")
            }
            Grow::Hump { factor } => {
                format!("{factor}*(3*(lambda/({length}))^2 - 2*(lambda/({length}))^3)")
            }
        }
    }
}
