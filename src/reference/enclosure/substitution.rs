//! Panels of another variable: λ = a ± w vᵖ, in which roots at a are analytic.
//!
//! Where C or τ is a series of powers of (λ − a)^(1/p) around an end a of a part of the ray, it is one of powers of v.
//! What it is there is told by [germs](super::germ) at v = 0; further on by the program itself. It goes from the front
//! to the back: u = v behind a and u = −v in front of it.

use super::germ::{Germ, power};
use super::number::{Number, Plane};
use super::rectangle::Rectangle;
use super::run::{Branches, Run, constants, run};
use crate::symbolic::{Constant, Interval, Operand, Program};
use rug::{Float, Rational};

/// Powers that are tried, the least first.
const POWERS: [u32; 7] = [1, 2, 3, 4, 6, 8, 12];
/// Part of the width on which it is seen whether a power does, as a power of 2.
const NEAR: u32 = 10;

/// An end of a part of the ray.
#[derive(Clone, Debug)]
pub(super) struct End {
    /// Where it is.
    pub(super) place: Interval,
    /// The same, where it is known exactly.
    pub(super) exact: Option<Rational>,
    /// What is as great as a number there: a side of a comparison that the program makes.
    pub(super) equal: Option<(Operand, Rational)>,
}

impl End {
    /// A number.
    pub(super) fn rational(bits: u32, q: &Rational) -> End {
        End {
            place: Interval::point(bits, q),
            exact: Some(q.clone()),
            equal: None,
        }
    }

    /// A number that is held without rounding.
    pub(super) fn exactly(x: &Float) -> End {
        End {
            place: Interval::exactly(x),
            exact: x.to_rational(),
            equal: None,
        }
    }
}

/// λ = a ± w vᵖ.
#[derive(Clone, Debug)]
pub(super) struct Substitution {
    /// a.
    pub(super) end: End,
    /// w.
    pub(super) width: Interval,
    /// p.
    pub(super) power: u32,
    /// Whether a is the far end: v falls from the front to the back.
    pub(super) is_far: bool,
}

/// What a medium is in another variable u.
#[derive(Clone, Debug)]
pub(super) struct Values<N> {
    /// τ dλ/du.
    pub(super) extinction: N,
    /// C τ dλ/du.
    pub(super) source: N,
}

/// C and τ of λ as they are.
pub(super) fn plain<N: Number>(
    program: &Program,
    constants: &[N],
    branches: &Branches,
    lambda: &N,
) -> Option<Values<N>> {
    let mut outputs = run(program, constants, lambda, branches).into_iter();
    let (emission, extinction) = outputs.next()?.zip(outputs.next()?)?;
    Some(Values {
        source: emission.times(&extinction),
        extinction,
    })
}

impl Substitution {
    /// λ at u.
    pub(super) fn lambda<N: Plane>(&self, u: &N) -> N {
        self.place_at(&self.variable(u))
    }

    /// v at u.
    fn variable<N: Plane>(&self, u: &N) -> N {
        if self.is_far { u.negated() } else { u.clone() }
    }

    /// w, or −w where a is the far end.
    fn signed_width<N: Plane>(&self, bits: u32) -> N {
        let width = N::real(&self.width.to_bits(bits));
        if self.is_far { width.negated() } else { width }
    }

    fn place_at<N: Plane>(&self, v: &N) -> N {
        let bits = v.bits();
        let step = self.signed_width::<N>(bits);
        let step = power(v, self.power).map_or(step.clone(), |power| power.times(&step));
        N::real(&self.end.place.to_bits(bits)).plus(&step)
    }

    /// p w v^(p − 1), as a germ.
    fn slope<N: Plane>(&self, v: &N) -> Germ<N> {
        let bits = v.bits();
        let factor = N::real(&self.width.to_bits(bits));
        let power = Rational::from(self.power);
        let factor = factor.times(&N::constant(bits, &power));
        match self.power {
            0 | 1 => Germ::number(factor, None),
            p => Germ::power(bits, p.cast_signed() - 1, factor, v.clone()),
        }
    }

    /// What the medium is at all u of a set.
    pub(super) fn values<N: Plane>(
        &self,
        program: &Program,
        constants: &[N],
        branches: &Branches,
        u: &N,
    ) -> Option<Values<N>> {
        let v = self.variable(u);
        // On the way from real v ≥ 0 the program's own roots are the right ones.
        let is_right = v.is_right();
        let plain = is_right.then(|| self.away_from_end(program, constants, branches, &v));
        plain
            .flatten()
            .or_else(|| self.at_germ(program, constants, branches, &v))
    }

    fn away_from_end<N: Plane>(
        &self,
        program: &Program,
        constants: &[N],
        branches: &Branches,
        v: &N,
    ) -> Option<Values<N>> {
        let values = plain(program, constants, branches, &self.place_at(v))?;
        let slope = self.slope(v).value()?;
        Some(Values {
            extinction: values.extinction.times(&slope),
            source: values.source.times(&slope),
        })
    }

    fn at_germ<N: Plane>(
        &self,
        program: &Program,
        constants: &[N],
        branches: &Branches,
        v: &N,
    ) -> Option<Values<N>> {
        let bits = v.bits();
        let step = Germ::power(
            bits,
            self.power.cast_signed(),
            self.signed_width(bits),
            v.clone(),
        );
        let place = Germ::number(
            N::real(&self.end.place.to_bits(bits)),
            self.end.exact.clone(),
        );
        let mut input = place.plus(&step);
        let equal = self.end.equal.as_ref();
        if let Some((Operand::Input(_), q)) = equal {
            input = input.based_on(bits, q);
        }
        let constants = germs(program, constants);
        let mut run = Run::new(program, &constants, &input);
        for (instruction, &way) in program.instructions().iter().zip(&branches.0) {
            run.step(instruction, way);
            if let Some((Operand::Register(register), q)) = equal
                && (instruction.target..instruction.target + 2).contains(register)
            {
                run.base(*register, bits, q);
            }
        }
        let mut outputs = run.outputs().into_iter();
        let (emission, extinction) = outputs.next()?.zip(outputs.next()?)?;
        let extinction = extinction.times(&self.slope(v));
        Some(Values {
            source: emission.times(&extinction).value()?,
            extinction: extinction.value()?,
        })
    }

    /// The least power in which the medium is analytic around an end; 1, too, where none is found. The part of
    /// the ray reaches as far as `width`.
    pub(super) fn power_at(
        program: &Program,
        constants: &[Interval],
        branches: &Branches,
        end: &End,
        width: &Interval,
        is_far: bool,
    ) -> u32 {
        let bits = width.bits();
        let near = Float::with_val(bits, width.lower() >> NEAR);
        let does = |power: &u32| {
            let here = Substitution {
                end: end.clone(),
                width: Interval::exactly(&near),
                power: *power,
                is_far,
            };
            let whole = Interval::hull(bits, &Rational::new(), &Rational::from(1));
            let found = here.at_germ(program, constants, branches, &whole);
            found.is_some_and(|found| found.extinction.is_finite() && found.source.is_finite())
        };
        POWERS.into_iter().find(does).unwrap_or(1)
    }
}

/// τ dλ/du and C τ dλ/du of a program without branches on a rectangle of u, for λ = `end` ± `width` vᵖ.
#[must_use]
pub fn substituted(
    program: &Program,
    [end, width]: [&Rational; 2],
    power: u32,
    is_far: bool,
    u: &Rectangle,
) -> Option<[Rectangle; 2]> {
    let bits = u.re.bits();
    let substitution = Substitution {
        end: End::rational(bits, end),
        width: Interval::point(bits, width),
        power,
        is_far,
    };
    let branches = Branches(vec![None; program.instructions().len()]);
    let constants = constants(program, bits);
    let found = substitution.values(program, &constants, &branches, u)?;
    Some([found.extinction, found.source])
}

/// The constants of a program, known exactly where they are rational.
pub(super) fn germs<N: Plane>(program: &Program, constants: &[N]) -> Vec<Germ<N>> {
    let both = program.constants().iter().zip(constants);
    both.map(|(constant, enclosed)| {
        let exact = match constant {
            Constant::Rational(q) => Some(q.clone()),
            Constant::Pi => None,
        };
        Germ::number(enclosed.clone(), exact)
    })
    .collect()
}
