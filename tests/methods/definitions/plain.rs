//! The second implementation: formulas written down one by one, for a medium without transcendentals.

use super::exact::Exact;
use rug::Rational;
use volver::case::{Case, Structure, Transfer};
use volver::method::{Exponential, Filling, Inner, Scope};
use volver::quadrature::{Draws, Rule, Sampling};
use volver::real::{Format, Real};

/// s = λ, τ = τ₀ + τ₁ s + τ₂ s², C = 2 − s.
#[derive(Clone, Debug)]
pub(crate) struct Ramp {
    pub(crate) length: Rational,
    pub(crate) extinction: [Rational; 3],
}

impl Ramp {
    fn tau(&self, lambda: &Rational) -> Rational {
        let [constant, slope, bend] = &self.extinction;
        (Rational::from(bend * lambda) + slope) * lambda + constant
    }

    fn source(&self, lambda: &Rational) -> Rational {
        Rational::from(2 - lambda) * self.tau(lambda)
    }
}

impl Case for Ramp {
    fn name(&self) -> &'static str {
        "ramp"
    }
    fn length(&self) -> Rational {
        self.length.clone()
    }
    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }
    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        let [constant, slope, bend] = self.extinction.each_ref().map(|c| s.format().ratio(c));
        Transfer {
            emission: s.format().int(2) - s,
            extinction: (bend * s + &slope) * s + &constant,
        }
    }
    fn optical_depth<R: Real>(&self, _: &R) -> Option<R> {
        unimplemented!("no method may look at it")
    }
    fn radiance<R: Real>(&self, _: &R) -> Option<R> {
        unimplemented!("no method may look at it")
    }
    fn structure(&self) -> Structure {
        Structure {
            field_degree: Some(1),
            transfer: None,
            ..Structure::default()
        }
    }
}

pub(crate) fn q(numerator: i64, denominator: i64) -> Rational {
    Rational::from((numerator, denominator))
}

/// Nodes and weights on [0, 1] as textbooks print them; Gauss–Legendre's are tested by themselves.
fn textbook(rule: Rule) -> Vec<(Rational, Rational)> {
    match rule {
        Rule::RiemannLeft => vec![(q(0, 1), q(1, 1))],
        Rule::RiemannRight => vec![(q(1, 1), q(1, 1))],
        Rule::Midpoint => vec![(q(1, 2), q(1, 1))],
        Rule::Trapezoid => vec![(q(0, 1), q(1, 2)), (q(1, 1), q(1, 2))],
        Rule::Simpson => vec![(q(0, 1), q(1, 6)), (q(1, 2), q(2, 3)), (q(1, 1), q(1, 6))],
        Rule::Boole => vec![
            (q(0, 1), q(7, 90)),
            (q(1, 4), q(16, 45)),
            (q(1, 2), q(2, 15)),
            (q(3, 4), q(16, 45)),
            (q(1, 1), q(7, 90)),
        ],
        Rule::GaussLegendre(_) => {
            let table = rule.table(Exact.bits()).unwrap();
            let pairs = table.nodes.iter().zip(&table.weights);
            pairs.map(|(x, w)| (x.clone(), w.clone())).collect()
        }
    }
}

/// The plain implementation, on the ramp.
pub(crate) struct Plain {
    pub(crate) ramp: Ramp,
    pub(crate) n: u64,
    pub(crate) inner: Inner,
    pub(crate) exponential: Exponential,
    pub(crate) scope: Scope,
}

impl Plain {
    fn step(&self) -> Rational {
        Rational::from(&self.ramp.length / self.n)
    }

    /// λ = (j + x) d.
    fn place(&self, j: u64, x: &Rational) -> Rational {
        Rational::from(x + j) * self.step()
    }

    /// ∫ τ over the first x of segment j.
    fn partial_depth(&self, j: u64, x: &Rational) -> Rational {
        let width = x * self.step();
        match self.inner {
            Inner::PerSegment(rule) => {
                let mean: Rational = textbook(rule)
                    .into_iter()
                    .map(|(c, w)| w * self.ramp.tau(&self.place(j, &(c * x))))
                    .sum();
                mean * width
            }
            Inner::SimpsonPairs(filling) => self.pair_depth(filling, j, x),
            Inner::BooleFours => self.four_depth(j, x),
            Inner::MonteCarlo { sampling, seed } => match sampling {
                Sampling::Shared => {
                    let (from, to) = (self.place(j, &q(0, 1)), self.place(j, x));
                    let inside = |lambda: &Rational| from <= *lambda && *lambda < to;
                    let samples = self.uniforms(seed, self.n);
                    let lambdas = samples.into_iter().map(|u| u * &self.ramp.length);
                    let sum: Rational = lambdas.filter(inside).map(|l| self.ramp.tau(&l)).sum();
                    sum * self.step()
                }
                Sampling::Stratified => {
                    let seed = if *x == 1 { seed } else { !seed };
                    let u = self
                        .uniforms(seed, self.n)
                        .swap_remove(usize::try_from(j).unwrap());
                    self.ramp.tau(&self.place(j, &(u * x))) * width
                }
                Sampling::Independent if *x == 1 => {
                    let depth =
                        |i| self.independent_depth(seed, i, &q(i64::try_from(i).unwrap(), 1));
                    if j == 0 {
                        depth(1)
                    } else {
                        depth(j + 1) - depth(j)
                    }
                }
                Sampling::Independent => {
                    let whole = self.independent_depth(!seed, j + 1, &Rational::from(x + j));
                    whole - self.depth(j)
                }
            },
        }
    }

    /// The `draw`-th estimate of ∫ τ up to λ = position · d, each from n samples on [0, λ].
    fn independent_depth(&self, seed: u64, draw: u64, position: &Rational) -> Rational {
        let lambda = position * self.step();
        let skip = usize::try_from((draw - 1) * self.n).unwrap();
        let samples = self.uniforms(seed, draw * self.n).split_off(skip);
        let sum: Rational = samples
            .iter()
            .map(|u| self.ramp.tau(&Rational::from(u * &lambda)))
            .sum();
        sum * lambda / self.n
    }

    fn uniforms(&self, seed: u64, count: u64) -> Vec<Rational> {
        let mut draws = Draws::new(seed, self.n);
        (0..count).map(|_| draws.draw().at(Exact).0).collect()
    }

    /// From the pair's three values: the parabola through them, integrated by Simpson's rule (which is
    /// exact for it), or trapezoids; the back segment of a pair has what Simpson leaves.
    fn pair_depth(&self, filling: Filling, j: u64, x: &Rational) -> Rational {
        let first = j - j % 2;
        let value = |k: u64| self.ramp.tau(&self.place(first + k, &q(0, 1)));
        let parabola = |u: &Rational| -> Rational {
            let (a, b) = (Rational::from(u - 1_u32), Rational::from(u - 2_u32));
            value(0) * &a * &b / 2 - value(1) * u * &b + value(2) * u * &a / 2
        };
        let simpson = |u: &Rational| -> Rational {
            let middle = Rational::from(u / 2_u32);
            (parabola(&q(0, 1)) + parabola(&middle) * 4 + parabola(u)) * u / 6
        };
        let trapezoid = |k: u64, x: &Rational| -> Rational {
            let chord = value(k) + (value(k + 1) - value(k)) * x;
            (value(k) + chord) * x / 2
        };
        let in_steps = match (filling, j % 2) {
            (Filling::Parabola, 0) => simpson(x),
            (Filling::Parabola, _) => simpson(&Rational::from(x + 1)) - simpson(&q(1, 1)),
            (Filling::Trapezoid, 1) if *x == 1 => simpson(&q(2, 1)) - trapezoid(0, x),
            (Filling::Trapezoid, k) => trapezoid(k, x),
        };
        in_steps * self.step()
    }

    /// The polynomial through the four segments' five values, by Newton's divided differences, integrated by Boole's rule, which
    /// is exact for it.
    fn four_depth(&self, j: u64, x: &Rational) -> Rational {
        let first = j - j % 4;
        let mut row: Vec<Rational> = (first..=first + 4)
            .map(|k| self.ramp.tau(&self.place(k, &q(0, 1))))
            .collect();
        let mut differences = Vec::new();
        for order in 1_u32..=5 {
            differences.push(row[0].clone());
            let next = row
                .windows(2)
                .map(|pair| Rational::from(&pair[1] - &pair[0]));
            row = next.map(|difference| difference / order).collect();
        }
        let polynomial = |u: &Rational| -> Rational {
            let from_last = differences.iter().zip([0_u32, 1, 2, 3, 4]).rev();
            from_last.fold(q(0, 1), |sum, (difference, k)| {
                sum * Rational::from(u - k) + difference
            })
        };
        let boole = |u: &Rational| -> Rational {
            let at = |k: u32| polynomial(&(Rational::from(u * k) / 4_u32));
            (at(0) * 7 + at(1) * 32 + at(2) * 12 + at(3) * 32 + at(4) * 7) * u / 90
        };
        let front = Rational::from(j % 4);
        (boole(&Rational::from(x + &front)) - boole(&front)) * self.step()
    }

    /// ∫ τ up to boundary i.
    fn depth(&self, i: u64) -> Rational {
        (0..i).map(|j| self.partial_depth(j, &q(1, 1))).sum()
    }

    /// 1 − x + x²/2 − x³/6, up to the exponential's degree.
    fn attenuate(&self, x: &Rational) -> Rational {
        let square = Rational::from(x.square_ref());
        let cube = Rational::from(&square * x);
        let linear = Rational::from(1 - x);
        match self.exponential {
            Exponential::Exact => unreachable!("not rational"),
            Exponential::Linear => linear,
            Exponential::Quadratic => linear + square / 2,
            Exponential::Cubic => linear + square / 2 - cube / 6,
        }
    }

    /// T at (j + x) d.
    fn transmittance(&self, j: u64, x: &Rational) -> Rational {
        let partial = if *x == 0 {
            q(0, 1)
        } else {
            self.partial_depth(j, x)
        };
        match self.scope {
            Scope::Whole => self.attenuate(&(self.depth(j) + partial)),
            Scope::PerSegment => {
                let segments = (0..j).map(|k| self.attenuate(&self.partial_depth(k, &q(1, 1))));
                segments.product::<Rational>() * self.attenuate(&partial)
            }
        }
    }

    /// Panel by panel: a closed rule spans one, two or four segments, an open one a segment.
    pub(crate) fn radiance(&self, outer: Rule) -> Rational {
        let span: u64 = match outer {
            Rule::Simpson => 2,
            Rule::Boole => 4,
            _ => 1,
        };
        let mut sum = Rational::new();
        for panel in 0..self.n / span {
            for (node, weight) in textbook(outer) {
                // In segments: whole for a closed rule.
                let place = node * span + panel * span;
                let (x, j) = place.fract_floor(rug::Integer::new());
                let j = j.to_u64().unwrap();
                let source = self.ramp.source(&self.place(j, &x));
                sum += weight * source * self.transmittance(j, &x) * span;
            }
        }
        sum * self.step()
    }
}
