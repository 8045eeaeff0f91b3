//! An order of monomials that products keep, and what a polynomial's terms have in common.

use super::Stop;
use super::arena::{Arena, Atom, AtomKind, Factors, Monomial, Polynomial};
use super::coefficient::Coefficient;
use std::cmp::Ordering;

impl Arena {
    /// 1/P: a monomial where P is one, otherwise the inverse of what all terms share times a divisor.
    pub(super) fn inverse(&mut self, polynomial: Polynomial) -> Result<Polynomial, Stop> {
        if polynomial == self.zero {
            return Err(Stop::Undefined);
        }
        let (shared, leading, rest) = self.split(polynomial)?;
        let mut powers: Vec<(Atom, i32)> = Vec::new();
        for &(atom, power) in &shared.powers {
            powers.push((atom, power.checked_neg().ok_or(Stop::TooLarge)?));
        }
        if rest != self.one {
            let divisor = self.atom(AtomKind::Divisor(rest));
            powers.push((divisor, -1));
            powers.sort_unstable();
            // The same divisor may have been shared.
            powers.dedup_by(|later, kept| {
                let same = later.0 == kept.0;
                if same {
                    kept.1 = kept.1.saturating_add(later.1);
                }
                same
            });
        }
        let exponent = self.scaled(shared.exponent, &Coefficient::real(-1));
        let inverse = self.normal_monomial(exponent, powers)?;
        Ok(self.scaled(inverse, &leading.inverse()))
    }

    /// P = c·m·Q with a monomial m, such that Q is the same for all P that differ by such a factor.
    pub(super) fn split(
        &mut self,
        polynomial: Polynomial,
    ) -> Result<(Factors, Coefficient, Polynomial), Stop> {
        let terms = self.terms(polynomial);
        self.work(terms.len())?;
        let mut leading: Option<(Monomial, Coefficient)> = None;
        let mut least: Option<Vec<(Atom, i32)>> = None;
        for (monomial, coefficient) in terms.iter() {
            let powers = self.factors(*monomial).powers.clone();
            least = Some(match least {
                Some(least) => common(&least, &powers),
                None => powers,
            });
            let is_greater = match &leading {
                Some((known, _)) => self.compare(*monomial, *known) == Ordering::Greater,
                None => true,
            };
            if is_greater {
                leading = Some((*monomial, coefficient.clone()));
            }
        }
        let (Some((monomial, coefficient)), Some(powers)) = (leading, least) else {
            return Err(Stop::Undefined);
        };
        let exponent = self.factors(monomial).exponent;
        let opposite = self.scaled(exponent, &Coefficient::real(-1));
        let inverse = coefficient.inverse();
        let mut rest = Vec::with_capacity(terms.len());
        for (monomial, coefficient) in terms.iter() {
            let factors = self.factors(*monomial);
            let left = Factors {
                exponent: self.sum(factors.exponent, opposite),
                powers: without(&factors.powers, &powers)?,
            };
            rest.push((self.monomial(left), coefficient.times(&inverse)));
        }
        let rest = self.sum_of(rest);
        Ok((Factors { exponent, powers }, coefficient, rest))
    }

    /// Which of two monomials is the greater: a matter of their quotient alone.
    fn compare(&mut self, m: Monomial, n: Monomial) -> Ordering {
        let (a, b) = (self.factors(m), self.factors(n));
        if a.exponent != b.exponent {
            let opposite = self.scaled(b.exponent, &Coefficient::real(-1));
            let difference = self.sum(a.exponent, opposite);
            if let Some((_, coefficient)) = self.terms(difference).last() {
                return if coefficient.is_negative() {
                    Ordering::Less
                } else {
                    Ordering::Greater
                };
            }
        }
        let power = |powers: &[(Atom, i32)], atom: Atom| {
            let found = powers.iter().find(|(a, _)| *a == atom);
            found.map_or(0, |(_, power)| *power)
        };
        let mut atoms: Vec<Atom> = a.powers.iter().chain(&b.powers).map(|(a, _)| *a).collect();
        atoms.sort_unstable();
        for atom in atoms.into_iter().rev() {
            match power(&a.powers, atom).cmp(&power(&b.powers, atom)) {
                Ordering::Equal => {}
                order => return order,
            }
        }
        Ordering::Equal
    }
}

/// For each atom the lesser power.
fn common(a: &[(Atom, i32)], b: &[(Atom, i32)]) -> Vec<(Atom, i32)> {
    let power = |powers: &[(Atom, i32)], atom: Atom| {
        let found = powers.iter().find(|(a, _)| *a == atom);
        found.map_or(0, |(_, power)| *power)
    };
    let mut atoms: Vec<Atom> = a.iter().chain(b).map(|(atom, _)| *atom).collect();
    atoms.sort_unstable();
    atoms.dedup();
    atoms
        .into_iter()
        .map(|atom| (atom, power(a, atom).min(power(b, atom))))
        .filter(|(_, power)| *power != 0)
        .collect()
}

/// Powers divided by others.
fn without(a: &[(Atom, i32)], b: &[(Atom, i32)]) -> Result<Vec<(Atom, i32)>, Stop> {
    let mut result: Vec<(Atom, i32)> = a.to_vec();
    for &(atom, power) in b {
        match result.iter_mut().find(|(known, _)| *known == atom) {
            Some((_, own)) => *own = own.checked_sub(power).ok_or(Stop::TooLarge)?,
            None => result.push((atom, power.checked_neg().ok_or(Stop::TooLarge)?)),
        }
    }
    result.retain(|(_, power)| *power != 0);
    result.sort_unstable();
    Ok(result)
}
