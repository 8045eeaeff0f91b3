//! Random rules, with every field and variant among them, and random rays.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rug::Rational;
use volver::identify::Rule;
use volver::identify::rule::{
    At, Blocks, Channels, Curve, Depth, Effect, End, Extra, Formula, LastStep, Law, Output, Place,
    Power, Quantised, Range, Scale, Scheme, Seam, Segment, Sequence, Series, Shape, Step, Stop,
    StopBy, Table, Wall, Weight, Which, Whole,
};
use volver::kernel::{Samples, Segments};

/// A stream of choices.
pub(super) struct Random(Pcg64);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Random(Pcg64::seed_from_u64(seed))
    }

    fn index(&mut self, count: usize) -> usize {
        usize::try_from(self.0.next_u64() % count as u64).unwrap()
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn of<T: Clone>(&mut self, choices: &[T]) -> T {
        choices[self.index(choices.len())].clone()
    }

    fn one_in(&mut self, count: usize) -> bool {
        self.index(count) == 0
    }

    /// A number of that range, one time in five.
    fn rarely(&mut self, low: f64, high: f64) -> Option<f64> {
        self.one_in(5).then(|| self.between(low, high))
    }

    fn power(&mut self, halves: &[i8]) -> Power {
        Power {
            halves: self.of(halves),
        }
    }

    fn depth(&mut self) -> Depth {
        if self.one_in(2) {
            return Depth::default();
        }
        Depth {
            factor: self.of(&[1.0, 0.5, 1.3]),
            // τ may be 0.
            extinction: self.power(&[1, 2, 3, 4]),
            length: self.power(&[-2, 0, 1, 2, 4]),
            ray: self.power(&[-2, -1, 0, 0, 2]),
        }
    }

    fn scale(&mut self) -> Scale {
        Scale(self.rarely(0.3, 1.5).unwrap_or(1.0))
    }

    fn law(&mut self) -> Law {
        let shape = self.of(&[
            Shape::Exponential,
            Shape::Exponential,
            Shape::Linear,
            Shape::Reciprocal,
            Shape::Quadratic,
            Shape::CrankNicolson,
            Shape::Clear,
        ]);
        let range = if self.one_in(3) {
            Range::default()
        } else {
            self.range()
        };
        // Roots and reciprocals of what may be negative or nothing are left out.
        let is_powers = range
            .table
            .is_some_and(|table| table.between == Step::PowersOfTwo);
        let of_passes: &[i8] = match shape {
            Shape::Exponential | Shape::Reciprocal => &[-1, 0, 0, 1, 2, 4],
            _ => &[0, 0, 2, 4],
        };
        let of_opacity: &[i8] = match shape {
            Shape::Exponential | Shape::Reciprocal if !is_powers => &[0, 1, 2, 4],
            _ => &[0, 2, 4],
        };
        let weight = match self.index(6) {
            0 | 1 => Weight::default(),
            2 | 3 => Weight::Opacity {
                opacity: self.power(of_opacity),
                passes: self.power(of_passes),
            },
            4 => Weight::Depth {
                depth: self.depth(),
                passes: self.power(of_passes),
            },
            _ => Weight::Own {
                depth: self.depth(),
                shape: self.of(&Shape::ABSORBING),
            },
        };
        Law {
            depth: self.depth(),
            shape,
            weight,
            scale: self.scale(),
            eps: self.rarely(1e-10, 1e-2).unwrap_or(0.0),
            cover: Scale(self.rarely(0.5, 0.99).unwrap_or(1.0)),
            formula: self.of(&[Formula::Direct, Formula::Direct, Formula::Power]),
            length_bits: self.one_in(6).then_some(9),
            range,
        }
    }

    fn range(&mut self) -> Range {
        let table = self.one_in(4).then(|| Table {
            step: self.between(0.01, 0.3),
            top: self.rarely(0.3, 1.0),
            between: self.of(&[
                Step::Nearest,
                Step::Below,
                Step::Linear,
                Step::NearestExtinction,
                Step::PowersOfTwo,
            ]),
        });
        let quantum = self.one_in(6).then_some(1.0 / 255.0);
        let series = self.one_in(5).then(|| Series {
            below: self.between(0.1, 0.5),
            terms: self.of(&[1, 2, 3, 5]),
        });
        Range {
            depth_max: self.rarely(0.3, 1.0),
            extinction_max: self.rarely(1.0, 3.0),
            skip: self.rarely(0.01, 0.2),
            skip_extinction: self.rarely(0.2, 1.0),
            // Of more than all, roots are of negative numbers.
            opacity_max: self.rarely(0.3, 0.9),
            uncorrected_under: self.rarely(0.1, 0.7),
            uncorrected_length: 0.25,
            series,
            quantum,
            // Those of a unit of length go with one law of opacity alone.
            quantised: match quantum {
                Some(_) => self.of(&[Quantised::Nearest, Quantised::Below]),
                None => Quantised::default(),
            },
            table,
        }
    }

    fn three(&mut self) -> [Rational; 3] {
        let parts: [&[(i32, i32)]; 6] = [
            &[(1, 2), (0, 1), (1, 2)],
            &[(1, 6), (2, 3), (1, 6)],
            &[(5, 24), (1, 3), (-1, 24)],
            &[(0, 1), (1, 1), (0, 1)],
            &[(1, 1), (0, 1), (0, 1)],
            &[(-1, 24), (1, 3), (17, 24)],
        ];
        let parts = self.of(&parts);
        [0, 1, 2].map(|k| Rational::from(parts[k]))
    }

    fn scheme(&mut self) -> Scheme {
        if !self.one_in(3) {
            return Scheme::Sample {
                place: self.of(&[Place::Front, Place::Middle, Place::Back]),
                law: self.law(),
            };
        }
        let weights = match self.index(6) {
            0 => Segment::Opacity {
                parts: self.three(),
            },
            1 => Segment::LinearInDepth {
                swapped: self.one_in(2),
            },
            2 => Segment::Linear,
            3 => Segment::Quadrature {
                parts: self.three(),
                half: self.three(),
            },
            4 => Segment::Sum {
                parts: self.three(),
            },
            _ => Segment::Halves,
        };
        Scheme::Segments {
            depth: self.three(),
            weights,
            scale: self.scale(),
        }
    }

    fn sequence(&mut self) -> Sequence {
        let ends = [End::Once, End::Once, End::Missing, End::Twice];
        Sequence {
            first: self.of(&ends),
            last: self.of(&ends),
            extra: self.of(&[None, None, Some(Extra::Step), Some(Extra::Last)]),
            swapped: self.one_in(4),
            late: self.one_in(4),
            unrolled: self.of(&[1, 1, 1, 4]),
            most: self.of(&[None, None, None, Some(5)]),
            last_step: self.of(&[
                LastStep::Own,
                LastStep::Own,
                LastStep::Whole,
                LastStep::Dropped,
                LastStep::Even,
            ]),
            seam: self.one_in(2).then(|| self.seam()),
        }
    }

    fn seam(&mut self) -> Seam {
        let count = self.of(&[2, 3, 4, 5]);
        let blocks = self.of(&[
            Blocks::Segments,
            Blocks::Floor,
            Blocks::Rest,
            Blocks::Ceiling,
            Blocks::Even,
        ]);
        let at = [At::First, At::Last, At::Index(1)];
        let blocks = blocks(count);
        let has_index = matches!(blocks, Blocks::Segments(_));
        Seam {
            blocks,
            at: self.of(if has_index { &at } else { &at[..2] }),
            effect: self.of(&[Effect::Missing, Effect::Twice, Effect::Only]),
            of: self.of(&[Which::All, Which::Whole, Which::Inner]),
            fewest: self.of(&[1, 1, 4, 9]),
        }
    }

    fn stop(&mut self) -> Stop {
        let by = self.of(&[StopBy::Transmittance, StopBy::Weight, StopBy::Sum]);
        let is_weight = by == StopBy::Weight;
        Stop {
            by,
            under: if is_weight {
                self.between(0.001, 0.1)
            } else {
                self.between(0.1, 0.9)
            },
            before: self.one_in(3),
            // A weight may end a ray of which nothing was absorbed: 0/0.
            cut: !is_weight && self.one_in(3),
            renormalised: by == StopBy::Transmittance && self.one_in(2),
        }
    }

    fn curve(&mut self) -> Curve {
        self.of(&[
            Curve::Linear,
            Curve::Linear,
            Curve::Linear,
            Curve::Gamma(1.0 / 2.2),
            Curve::Srgb,
            Curve::Reinhard,
            Curve::Exposure,
        ])
    }

    /// A rule with a few of everything.
    pub(super) fn rule(&mut self) -> Rule {
        let rarely = |random: &mut Self| random.one_in(2);
        Rule {
            lattice: None,
            scheme: self.scheme(),
            sequence: if rarely(self) {
                self.sequence()
            } else {
                Sequence::default()
            },
            stop: self.one_in(3).then(|| self.stop()),
            wall: match self.index(8) {
                0 => Some(Wall::Opaque),
                1 => Some(Wall::LastEmission),
                2 => Some(Wall::Length(1e10)),
                _ => None,
            },
            whole: self.of(&[
                Whole::One,
                Whole::One,
                Whole::One,
                Whole::ByOpacity,
                Whole::TimesOpacity,
            ]),
            emission: self.curve(),
            emission_max: self.rarely(0.7, 1.2),
            emission_min: self.rarely(0.0, 0.1),
            background: self.rarely(0.1, 1.0).unwrap_or(0.0),
            offset: self.rarely(-0.1, 0.1).unwrap_or(0.0),
            output: Output {
                curve: self.curve(),
                low: self.rarely(0.0, 0.2),
                high: self.rarely(0.4, 1.0),
                quantum: self.one_in(8).then_some(1.0 / 255.0),
            },
            channels: self.of(&[
                Channels::Straight,
                Channels::Straight,
                Channels::Reversed,
                Channels::ReversedByThrees,
            ]),
        }
    }

    /// A ray of n segments and five channels, the last segment shorter or not; nothing absorbs here and there.
    pub(super) fn ray(&mut self, n: usize) -> (Segments, f64) {
        let step = self.between(0.05, 0.5);
        let last = self.of(&[1.0, 0.4]);
        let mut lambda: Vec<f64> = (0..n).map(|i| i as f64 * step).collect();
        lambda.push((n as f64 - 1.0 + last) * step);
        let middles = lambda
            .windows(2)
            .map(|ends| f64::midpoint(ends[0], ends[1]));
        let middles = middles.collect();
        let segments = Segments {
            edges: self.samples(lambda),
            middles: self.samples(middles),
        };
        (segments, step)
    }

    fn samples(&mut self, lambda: Vec<f64>) -> Samples {
        let n = lambda.len();
        let extinction = |random: &mut Self| {
            if random.one_in(8) {
                0.0
            } else {
                random.between(0.05, 4.0)
            }
        };
        Samples {
            extinction: (0..n).map(|_| extinction(self)).collect(),
            emission: (0..5)
                .map(|_| (0..n).map(|_| self.between(-0.2, 2.0)).collect())
                .collect(),
            lambda,
        }
    }
}
