//! Segments in which C and τ are linear, integrated as exactly as the format holds.

use crate::case::Transfer;
use crate::quadrature::Rule;
use crate::real::{Format, Real};

/// Bits of a result that one Gauss–Legendre point is good for, in segments of an optical depth that
/// renderers meet (up to about 20).
const BITS_A_POINT: u32 = 3;
/// Bits beyond the format's that the power series is good for.
const GUARD_BITS: u32 = 8;

/// ∫ C τ e^(−t) over one segment, the depth t being quadratic in the place.
///
/// Where the segment is thin, by the power series of e^(−t), which costs no exponential. Otherwise by
/// Gauss–Legendre points: the integrand is an entire function, so that their error falls faster than any power.
pub struct LinearSegments<R> {
    /// (x, w, x²/2) on the unit interval.
    points: Vec<(R, R, R)>,
    half: R,
    one: R,
    /// 1/1, 1/2, … as far as a series may need them.
    reciprocals: Vec<R>,
}

impl<R: Real> LinearSegments<R> {
    /// For numbers of that format.
    #[must_use]
    pub fn new(format: R::Format) -> Self {
        let bits = format.bits();
        let half = format.fraction(1, 2);
        let count = (bits / BITS_A_POINT).clamp(8, 100);
        let points = match Rule::GaussLegendre(count).table(bits) {
            Ok(table) => {
                let points = table.nodes.iter().zip(&table.weights);
                let points = points.map(|(x, w)| {
                    let x = format.ratio(x);
                    let square = x.clone() * &x * &half;
                    (x, format.ratio(w), square)
                });
                points.collect()
            }
            // Of 8 to 100 points there is a table.
            Err(_) => Vec::new(),
        };
        LinearSegments {
            points,
            half,
            one: format.int(1),
            reciprocals: reciprocals(format),
        }
    }

    /// (∫₀ʰ C τ e^(−t) dx, e^(−t(h))) with C and τ linear from `near` to `far`.
    pub fn segment(&self, near: &Transfer<R>, far: &Transfer<R>, length: &R) -> (R, R) {
        let largest = near.extinction.clone().abs() + &far.extinction.clone().abs();
        if largest * length < self.one {
            self.by_series(near, far, length)
        } else {
            self.by_points(near, far, length)
        }
    }

    /// With u = x/h and t = a u + b u², e^(−t) = Σ yₖ uᵏ from y₀ = 1 and (k + 1) yₖ₊₁ = −(a yₖ + 2 b yₖ₋₁).
    fn by_series(&self, near: &Transfer<R>, far: &Transfer<R>, length: &R) -> (R, R) {
        let zero = length.format().int(0);
        let of_extinction = far.extinction.clone() - &near.extinction;
        let of_emission = far.emission.clone() - &near.emission;
        let a = near.extinction.clone() * length;
        let twice_b = of_extinction.clone() * length;
        // ∫ uʲ e^(−t) du for j = 0, 1, 2, and e^(−t) at u = 1.
        let mut moments = [zero.clone(), zero.clone(), zero.clone()];
        let mut passes = zero.clone();
        let (mut before, mut term) = (zero, self.one.clone());
        let mut was_negligible = false;
        for weights in self.reciprocals.windows(3) {
            for (moment, weight) in moments.iter_mut().zip(weights) {
                *moment += &(term.clone() * weight);
            }
            let sum = passes.clone() + &term;
            let is_negligible = sum == passes;
            passes = sum;
            // Two in a row: what follows is made of them.
            if is_negligible && was_negligible {
                break;
            }
            was_negligible = is_negligible;
            let next = -((before * &twice_b + &(term.clone() * &a)) * &weights[0]);
            (before, term) = (term, next);
        }
        let [zeroth, first, second] = moments;
        // C τ is a polynomial of degree 2.
        let constant = near.emission.clone() * &near.extinction;
        let linear =
            near.emission.clone() * &of_extinction + &(of_emission.clone() * &near.extinction);
        let sum =
            zeroth * &constant + &(first * &linear) + &(of_emission * &of_extinction * &second);
        (sum * length, passes)
    }

    fn by_points(&self, near: &Transfer<R>, far: &Transfer<R>, length: &R) -> (R, R) {
        let slope = |near: &R, far: &R| far.clone() - near;
        let of_extinction = slope(&near.extinction, &far.extinction);
        let of_emission = slope(&near.emission, &far.emission);
        let mut sum = near.extinction.format().int(0);
        for (x, weight, half_square) in &self.points {
            let extinction = of_extinction.clone() * x + &near.extinction;
            let emission = of_emission.clone() * x + &near.emission;
            let depth = near.extinction.clone() * x + &(of_extinction.clone() * half_square);
            let light = (-(depth * length)).exp() * &extinction * &emission;
            sum += &(light * weight);
        }
        let whole = (near.extinction.clone() + &far.extinction) * &self.half * length;
        (sum * length, (-whole).exp())
    }
}

/// 1/k for all k whose yₖ is not far below the format's unit where a = 2 b = −1, of which no thin segment has more.
fn reciprocals<F: Format>(format: F) -> Vec<F::Real> {
    let least = f64::from(format.bits() + GUARD_BITS);
    let mut reciprocals = Vec::new();
    // Of yₖ/yₖ₋₁ and yₖ.
    let (mut ratio, mut log2_term) = (1.0_f64, 0.0);
    for k in 1_u32.. {
        reciprocals.push(format.fraction(1, k.into()));
        if log2_term < -least {
            break;
        }
        ratio = (1.0 + 1.0 / ratio) / f64::from(k + 1);
        log2_term += ratio.log2();
    }
    reciprocals
}
