//! The exponential and the functions made of it.

use super::arena::{Arena, Atom, PolynomialId, Result};
use super::coefficient::Coefficient;
use super::polynomial::{Accumulator, MonomialId, Polynomial};
use super::ratio::Ratio;
use crate::symbolic::Function;

impl Arena {
    /// eᵖ, with e^(a·ln u) = uᵃ for rational a; u > 0 where ln u is.
    pub(super) fn exp(&mut self, p: &Polynomial) -> Result<Polynomial> {
        let p = self.simplest(p)?;
        let mut exponent = Accumulator::default();
        let mut powers = Vec::new();
        for (monomial, c) in p.terms() {
            match self.single_atom(*monomial) {
                Some(Atom::Ln(argument)) => {
                    powers.push((argument, c.re.clone()));
                    exponent.add(*monomial, Coefficient::imaginary(c.im.clone()));
                }
                _ => exponent.add(*monomial, c.clone()),
            }
        }
        let mut result = self.assemble(&exponent.finish(), Vec::new())?;
        for (argument, power) in powers {
            let argument = self.polynomial(argument);
            let power = self.power(&argument, &power)?;
            result = self.multiply(&result, &power)?;
        }
        Ok(result)
    }

    /// The atom that the monomial is, if it is one to the power 1.
    fn single_atom(&self, monomial: MonomialId) -> Option<Atom> {
        let monomial = self.monomial(monomial);
        match &monomial.factors[..] {
            [(atom, power)] if power.is_one() && monomial.exponent == PolynomialId::ZERO => {
                Some((*self.atom(*atom)).clone())
            }
            _ => None,
        }
    }

    /// A trigonometric or hyperbolic function by Euler's formulas; of no other function.
    pub(super) fn euler(&mut self, function: Function, p: &Polynomial) -> Result<Polynomial> {
        let trigonometric = matches!(function, Function::Sin | Function::Cos | Function::Tan);
        let unit = if trigonometric {
            Coefficient::I
        } else {
            Coefficient::ONE
        };
        let exponent = p.scale(&unit);
        if matches!(function, Function::Tan | Function::Tanh) {
            // tanh u = 1 − 2/(e²ᵘ + 1) has fewer terms than the quotient.
            let two = Coefficient::real(Ratio::from(2));
            let square = self.exp(&exponent.scale(&two))?;
            let inverse = self.recip(&square.add(&Polynomial::one()))?;
            let tanh = Polynomial::one().sub(&inverse.scale(&two));
            return Ok(tanh.scale(&unit.conjugate()));
        }
        let half = Coefficient::real(Ratio::Small(1, 2));
        let plus = self.exp(&exponent)?;
        let minus = self.exp(&exponent.neg())?;
        Ok(match function {
            // 1/i = −i.
            Function::Sin | Function::Sinh => plus.sub(&minus).scale(&unit.conjugate()),
            _ => plus.add(&minus),
        }
        .scale(&half))
    }

    /// The exponent without quarters of a turn, which become powers of i, nor what else has a closed form:
    /// e^(iπ·k/12).
    pub(super) fn split_turn(
        &mut self,
        p: &Polynomial,
    ) -> Result<(Polynomial, Option<Polynomial>)> {
        let pi = p
            .terms()
            .iter()
            .find(|(monomial, _)| self.single_atom(*monomial) == Some(Atom::Pi));
        let Some((monomial, Coefficient { im: angle, .. })) = pi else {
            return Ok((p.clone(), None));
        };
        let quarters = angle.mul(&Ratio::from(2)).floor();
        let rest = angle.sub(&quarters.mul(&Ratio::Small(1, 2)));
        let twelfths = rest.mul(&Ratio::from(12)).to_integer().unwrap_or(0);
        let removed = if twelfths == 0 && !rest.is_zero() {
            angle.sub(&rest)
        } else {
            angle.clone()
        };
        if removed.is_zero() {
            return Ok((p.clone(), None));
        }
        let removed = Polynomial::term(*monomial, Coefficient::imaginary(removed));
        let quarter = quarters.sub(
            &quarters
                .mul(&Ratio::Small(1, 4))
                .floor()
                .mul(&Ratio::from(4)),
        );
        let quarter = match quarter.to_integer() {
            Some(1) => Coefficient::I,
            Some(2) => Coefficient::ONE.neg(),
            Some(3) => Coefficient::I.neg(),
            _ => Coefficient::ONE,
        };
        let turn = self.twelfth(twelfths)?.scale(&quarter);
        Ok((p.sub(&removed), Some(turn)))
    }

    /// e^(iπ·k/12) for k from 0 to 5.
    fn twelfth(&mut self, k: i64) -> Result<Polynomial> {
        // Cosine and sine in halves and quarters of roots: of 60°, 45° and 15°.
        let mut root = |n: i64, divisor: i64| -> Result<Polynomial> {
            let root = self.power_of_number(&Ratio::from(n), &Ratio::Small(1, 2))?;
            Ok(root.scale(&Coefficient::real(Ratio::Small(1, divisor))))
        };
        let (cos, sin) = match k {
            1 => (root(6, 4)?.add(&root(2, 4)?), root(6, 4)?.sub(&root(2, 4)?)),
            2 => (root(3, 2)?, root(1, 2)?),
            3 => (root(2, 2)?, root(2, 2)?),
            4 => (root(1, 2)?, root(3, 2)?),
            5 => (root(6, 4)?.sub(&root(2, 4)?), root(6, 4)?.add(&root(2, 4)?)),
            _ => return Ok(Polynomial::one()),
        };
        Ok(cos.add(&sin.scale(&Coefficient::I)))
    }
}
