//! Powers and logarithms of positive rational numbers.

use super::arena::{Arena, Atom, Result};
use super::coefficient::Coefficient;
use super::polynomial::Polynomial;
use super::ratio::Ratio;
use rug::{Integer, Rational};

/// Primes below this are split off; what is left stays whole, so relations between such numbers may be
/// missed.
const MAX_PRIME: u32 = 1000;

/// Roots of longer numbers aren't looked for.
const MAX_ROOT_BITS: u32 = 4096;

impl Arena {
    /// cᵉ for a rational c > 0: perfect roots fold, √8 is 2·√2.
    pub(super) fn power_of_number(&mut self, c: &Ratio, e: &Ratio) -> Result<Polynomial> {
        let mut result = Polynomial::one();
        for (base, k) in self.prime_powers(c)? {
            let base = self.number_id(&base)?;
            let radical = self.atom_id(Atom::Radical(base))?;
            let power = self.assemble(&Polynomial::default(), vec![(radical, k.mul(e))])?;
            result = self.multiply(&result, &power)?;
        }
        Ok(result)
    }

    /// ln c for a rational c > 0, a sum over primes.
    pub(super) fn ln_of_number(&mut self, c: &Ratio) -> Result<Polynomial> {
        let mut result = Polynomial::default();
        for (base, k) in self.prime_powers(c)? {
            let base = self.number_id(&base)?;
            let ln = self.of_atom(Atom::Ln(base))?;
            result = result.add(&ln.scale(&Coefficient::real(k)));
        }
        Ok(result)
    }

    fn number_id(&mut self, n: &Integer) -> Result<super::arena::PolynomialId> {
        let n = Ratio::from(Rational::from(n));
        self.polynomial_id(Polynomial::constant(Coefficient::real(n)))
    }

    /// Integers > 1 and powers of which c > 0 is the product.
    fn prime_powers(&mut self, c: &Ratio) -> Result<Vec<(Integer, Ratio)>> {
        self.spend(1 + 64 * c.words())?;
        let (mut n, mut d) = c.to_rational().into_numer_denom();
        let mut powers = Vec::new();
        for p in 2..MAX_PRIME {
            if n == 1 && d == 1 {
                break;
            }
            // Only primes are left to divide.
            let p = Integer::from(p);
            let k = i64::from(n.remove_factor_mut(&p)) - i64::from(d.remove_factor_mut(&p));
            if k != 0 {
                powers.push((p, Ratio::from(k)));
            }
        }
        for (rest, sign) in [(n, 1), (d, -1)] {
            if rest > 1 {
                let (root, k) = perfect_root(rest);
                powers.push((root, Ratio::from(i64::from(k) * sign)));
            }
        }
        Ok(powers)
    }
}

/// The least root of n that is an integer, and which root it is, for n without small primes.
fn perfect_root(n: Integer) -> (Integer, u32) {
    if n.significant_bits() <= MAX_ROOT_BITS && n.is_perfect_power() {
        // Every prime in n has at least 10 bits.
        for k in (2..=n.significant_bits() / 9).rev() {
            let (root, rest) = n.clone().root_rem(Integer::new(), k);
            if rest == 0 {
                return (root, k);
            }
        }
    }
    (n, 1)
}
