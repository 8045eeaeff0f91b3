//! Functions of Taylor series, each by the recurrence that its differential equation gives.

use super::series::sum;
use super::{Range, Taylor};

/// A small integer, and its reciprocal.
fn whole(k: usize) -> Range {
    // Orders are below a thousand.
    Range::point(k as f64)
}

fn part(k: usize) -> Range {
    whole(k).reciprocal()
}

impl Taylor {
    /// f′, coefficient k of which is (k + 1) times coefficient k + 1 of f.
    fn derivative(&self) -> Taylor {
        let terms = self.0.iter().enumerate().skip(1);
        Taylor(terms.map(|(k, c)| c.times(whole(k))).collect())
    }

    /// The function that begins with `first` and has that derivative.
    fn from_derivative(first: Range, derivative: &Taylor, order: usize) -> Taylor {
        let terms = derivative.0.iter().enumerate().take(order);
        let rest = terms.map(|(k, c)| c.times(part(k + 1)));
        Taylor(std::iter::once(first).chain(rest).collect())
    }

    /// f/g; any number where g may be 0.
    pub(super) fn divided_by(&self, other: &Taylor, order: usize) -> Taylor {
        let first = other.coefficient(0).reciprocal();
        if other.len() <= 1 {
            return Taylor(self.0.iter().map(|c| c.times(first)).collect());
        }
        let mut quotient: Vec<Range> = Vec::with_capacity(order + 1);
        for k in 0..=order {
            let known = (1..=k.min(other.len() - 1))
                .map(|j| other.0[j].times_to_nearest(quotient[k - j]).negated());
            let rest = sum(known.chain([self.coefficient(k)]));
            quotient.push(rest.times(first));
        }
        Taylor(quotient)
    }

    /// y with y′ = a f′ and a of y's coefficients so far: `next` is shown the function's coefficients before
    /// the one that is asked for and returns coefficient j of a.
    fn solve(&self, first: Range, order: usize, a: impl Fn(&[Range], usize) -> Range) -> Taylor {
        let slope = self.derivative();
        let mut y = vec![first];
        let mut factors: Vec<Range> = Vec::with_capacity(order);
        for k in 1..=order {
            factors.push(a(&y, k - 1));
            let terms =
                (0..k.min(slope.len())).map(|j| slope.0[j].times_to_nearest(factors[k - 1 - j]));
            y.push(sum(terms).times(part(k)));
        }
        Taylor(y)
    }

    /// e^f.
    pub(super) fn exp(&self, order: usize) -> Taylor {
        let first = self.coefficient(0).increasing(f64::exp);
        let first = first.intersection(Range::new(0.0, f64::INFINITY));
        self.solve(first, order, |y, j| y[j])
    }

    /// e^f − 1.
    pub(super) fn exp_m1(&self, order: usize) -> Taylor {
        let mut series = self.exp(order);
        if let Some(first) = series.0.first_mut() {
            *first = self.coefficient(0).increasing(f64::exp_m1);
        }
        series
    }

    /// ln f; any number where f may be 0 or less.
    pub(super) fn ln(&self, order: usize) -> Taylor {
        let first = self.coefficient(0);
        if first.low <= 0.0 {
            return Taylor::unknown(order);
        }
        let slope = self.derivative().divided_by(self, order);
        Taylor::from_derivative(first.increasing(f64::ln), &slope, order)
    }

    /// ln(1 + f).
    pub(super) fn ln_1p(&self, order: usize) -> Taylor {
        let argument = self.plus(&Taylor::constant(Range::point(1.0)));
        let mut series = argument.ln(order);
        if self.coefficient(0).low > -1.0
            && let Some(first) = series.0.first_mut()
        {
            *first = self.coefficient(0).increasing(f64::ln_1p);
        }
        series
    }

    /// √f; where f may be 0 only the value is known.
    pub(super) fn sqrt(&self, order: usize) -> Taylor {
        let first = self.coefficient(0);
        if first.low < 0.0 {
            return Taylor::unknown(order);
        }
        let root = first
            .increasing(f64::sqrt)
            .intersection(Range::new(0.0, f64::INFINITY));
        let half = root.plus(root).reciprocal();
        let mut y = vec![root];
        for k in 1..=order {
            let known = (1..k).map(|j| y[j].times_to_nearest(y[k - j]).negated());
            let rest = sum(known.chain([self.coefficient(k)]));
            y.push(rest.times(half));
        }
        Taylor(y)
    }

    /// (sin f, cos f).
    pub(super) fn sin_cos(&self, order: usize) -> (Taylor, Taylor) {
        let first = self.coefficient(0);
        self.pair(first.wave(f64::sin), first.wave(f64::cos), true, order)
    }

    /// (sinh f, cosh f).
    pub(super) fn sinh_cosh(&self, order: usize) -> (Taylor, Taylor) {
        let first = self.coefficient(0);
        let up = first.increasing(f64::exp);
        let down = first.negated().increasing(f64::exp);
        let cosh = up.plus(down).times(Range::point(0.5));
        let cosh = cosh.intersection(Range::new(1.0, f64::INFINITY));
        self.pair(first.increasing(f64::sinh), cosh, false, order)
    }

    /// s′ = c f′ and c′ = ∓s f′.
    fn pair(&self, s: Range, c: Range, turns: bool, order: usize) -> (Taylor, Taylor) {
        let slope = self.derivative();
        let (mut sines, mut cosines) = (vec![s], vec![c]);
        for k in 1..=order {
            let of = |other: &[Range]| {
                let terms =
                    (0..k.min(slope.len())).map(|j| slope.0[j].times_to_nearest(other[k - 1 - j]));
                sum(terms).times(part(k))
            };
            let (sine, cosine) = (of(&cosines), of(&sines));
            sines.push(sine);
            cosines.push(if turns { cosine.negated() } else { cosine });
        }
        (Taylor(sines), Taylor(cosines))
    }

    /// tan f; any number where cos f may be 0.
    pub(super) fn tan(&self, order: usize) -> Taylor {
        let (sin, cos) = self.sin_cos(order);
        sin.divided_by(&cos, order)
    }

    /// tanh f, by y′ = (1 − y²) f′.
    pub(super) fn tanh(&self, order: usize) -> Taylor {
        let first = self.coefficient(0).increasing(f64::tanh);
        self.solve(first, order, |y, j| {
            let square = sum((0..=j).map(|i| y[i].times_to_nearest(y[j - i]))).negated();
            if j == 0 {
                square.plus(Range::point(1.0))
            } else {
                square
            }
        })
    }

    /// atan f, by y′ = f′/(1 + f²).
    pub(super) fn atan(&self, order: usize) -> Taylor {
        let square = self.squared(order);
        let below = square.plus(&Taylor::constant(Range::point(1.0)));
        let slope = self.derivative().divided_by(&below, order);
        Taylor::from_derivative(self.coefficient(0).increasing(f64::atan), &slope, order)
    }

    /// erf f, by y′ = 2/√π e^(−f²) f′.
    pub(super) fn erf(&self, order: usize) -> Taylor {
        let square = self.squared(order);
        let bell = square.negated().exp(order);
        let factor = std::f64::consts::FRAC_2_SQRT_PI;
        let factor = Taylor::constant(Range::point(factor).widened(factor * f64::EPSILON));
        let slope = self.derivative().times(&bell, order).times(&factor, order);
        Taylor::from_derivative(self.coefficient(0).increasing(libm::erf), &slope, order)
    }
}
