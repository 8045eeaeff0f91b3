//! A case that counts how often it is evaluated.

use super::{Case, Structure, Transfer};
use crate::real::Real;
use crate::real::counted::{Kind, tick};
use crate::symbolic::{Interval, Program};
use rug::Rational;

/// A case around another that adds every evaluation of s, of C and τ, and of τ alone to the tally of
/// [`count`](crate::real::counted::count), in whatever format.
///
/// ```
/// use volver::case::{CountedCase, Fresh, SineSquared};
/// use volver::method::Method;
/// use volver::real::counted::{Counted, Kind, count};
/// use volver::real::Native;
///
/// let case = CountedCase(&SineSquared);
/// let method: Method = "front-to-back/middle/expm1".parse()?;
/// let nodes = Fresh::new(&case, Counted(Native::<f32>::new()));
/// let (radiance, counts) = count(|| method.radiance(&nodes, 100));
/// assert!(radiance.is_ok());
/// assert_eq!(counts[Kind::Transfer], 100);
/// assert_eq!(counts[Kind::ExponentialMinusOne], 100);
/// # Ok::<(), volver::method::MethodNameError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct CountedCase<'c, C>(pub &'c C);

impl<C: Case> Case for CountedCase<'_, C> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn length(&self) -> Rational {
        self.0.length()
    }

    fn field<R: Real>(&self, lambda: &R) -> R {
        tick(Kind::Field);
        self.0.field(lambda)
    }

    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        tick(Kind::Transfer);
        self.0.transfer(s)
    }

    fn extinction<R: Real>(&self, s: &R) -> R {
        tick(Kind::Extinction);
        self.0.extinction(s)
    }

    fn branches<R: Real>(&self, lambda: &R) -> Vec<bool> {
        self.0.branches(lambda)
    }

    fn transfer_branches<R: Real>(&self, s: &R) -> Vec<bool> {
        self.0.transfer_branches(s)
    }

    fn optical_depth<R: Real>(&self, lambda: &R) -> Option<R> {
        self.0.optical_depth(lambda)
    }

    fn radiance<R: Real>(&self, lambda: &R) -> Option<R> {
        self.0.radiance(lambda)
    }

    fn structure(&self) -> Structure {
        self.0.structure()
    }

    fn integrand(&self) -> Option<Program> {
        self.0.integrand()
    }

    fn closed_forms(&self) -> [Option<Program>; 2] {
        self.0.closed_forms()
    }

    fn break_places(&self, bits: u32) -> Vec<Option<Interval>> {
        self.0.break_places(bits)
    }
}
