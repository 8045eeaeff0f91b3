//! What is wrong with the entries of a backprojector.

use super::rays::Projected;
use super::{OfRay, ROUNDINGS};
use crate::identify::simplest;
use crate::kernel::InnerProduct;
use rug::Float;

/// A fault that explains all entries, on rays that it was not found with too.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// By a name that stays.
    pub name: &'static str,
    /// Its parameter, and between what that lies.
    pub value: Option<(f64, (f64, f64))>,
    /// In words.
    pub does: String,
}

/// What an entry would be.
struct Candidate {
    name: &'static str,
    does: &'static str,
    of: fn(&One<'_>) -> f64,
}

/// An entry: what A has there, and the lengths that go with it.
struct One<'r> {
    forward: &'r Float,
    back: &'r Float,
    length: f64,
    even: f64,
    is_last: bool,
    product: InnerProduct,
    held_out: bool,
    /// The largest entry of its ray.
    most: &'r Float,
}

const CANDIDATES: [Candidate; 4] = [
    Candidate {
        name: "adjoint-zero",
        does: "Aᵀ y is 0 everywhere",
        of: |_| 0.0,
    },
    Candidate {
        name: "adjoint-weights",
        does: "Aᵀ is that of the other inner product: the weights declared are not those used",
        of: |one| match one.product {
            InnerProduct::Plain => 1.0 / one.length,
            InnerProduct::Lengths => one.length,
        },
    },
    Candidate {
        name: "adjoint-even-lengths",
        does: "Aᵀ takes all segments to be as long as the first",
        of: |one| one.even / one.length,
    },
    Candidate {
        name: "adjoint-last",
        does: "Aᵀ leaves the last value out",
        of: |one| if one.is_last { 0.0 } else { 1.0 },
    },
];

/// The one fault that all entries have, if there is one.
pub(super) fn named(
    rays: &[Projected],
    found: &[OfRay],
    product: InnerProduct,
    unit: &Float,
) -> Option<Fault> {
    if found.iter().all(|ray| ray.differ.is_empty()) {
        return None;
    }
    let largest: Vec<Float> = found
        .iter()
        .map(|ray| {
            let all = ray.forward.iter().chain(&ray.back).cloned();
            all.fold(Float::new(64), |most, x| most.max(&x.abs()))
        })
        .collect();
    let mut entries = Vec::new();
    for ((ray, found), most) in rays.iter().zip(found).zip(&largest) {
        let last = ray.lengths.iter().rposition(|length| *length > 0.0);
        let lengths = ray.lengths.iter().zip(&ray.even);
        let both = found.forward.iter().zip(&found.back);
        for (at, ((forward, back), (length, even))) in both.zip(lengths).enumerate() {
            entries.push(One {
                forward,
                back,
                length: *length,
                even: *even,
                is_last: last == Some(at),
                product,
                held_out: found.held_out,
                most,
            });
        }
    }
    let fits = |candidate: &&Candidate| {
        let is = |one: &One<'_>| one.is((candidate.of)(one), unit);
        entries.iter().filter(|one| one.length > 0.0).all(is)
    };
    let mut fitting = CANDIDATES.iter().filter(fits);
    let first = fitting.next().filter(|_| fitting.next().is_none());
    let plain = first.map(|candidate| Fault {
        name: candidate.name,
        value: None,
        does: candidate.does.into(),
    });
    plain.or_else(|| factor(&entries, unit))
}

impl One<'_> {
    /// Whether the backprojector has so many times what A has.
    fn is(&self, times: f64, unit: &Float) -> bool {
        let bits = self.forward.prec().max(self.back.prec());
        let wanted = Float::with_val(bits, self.forward * times);
        let off = Float::with_val(bits, &wanted - self.back).abs();
        let size = self.most.clone().max(&wanted.abs());
        off <= size * unit * ROUNDINGS
    }
}

/// A constant factor, found on some rays and held out on the others.
fn factor(entries: &[One<'_>], unit: &Float) -> Option<Fault> {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for one in entries.iter().filter(|one| !one.held_out) {
        let size = one.forward.to_f64().abs();
        let error = (one.most.clone() * unit).to_f64() * ROUNDINGS;
        if size <= error {
            continue;
        }
        let factor = one.back.to_f64() / one.forward.to_f64();
        low = low.max(factor - error / size);
        high = high.min(factor + error / size);
    }
    if !(low.is_finite() && high.is_finite() && low <= high) {
        return None;
    }
    let value = simplest(low, high);
    if !entries.iter().all(|one| one.is(value, unit)) {
        return None;
    }
    let is_sign = (value + 1.0).abs() <= 0.0;
    let (name, does) = if is_sign {
        ("adjoint-sign", "Aᵀ has the other sign".into())
    } else {
        ("adjoint-factor", format!("Aᵀ is multiplied by {value:?}"))
    };
    Some(Fault {
        name,
        value: (!is_sign).then_some((value, (low, high))),
        does,
    })
}
