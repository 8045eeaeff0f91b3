//! Sines, cosines and tangents of multiples of arc tangents, without either.

use crate::symbolic::{Expr, Function, Kind};

/// The highest multiple of an arc tangent that is taken apart.
const MAX_MULTIPLE: u32 = 8;

/// With sin(k·atan u) and its like as functions of u, the same wherever they have a value:
/// cos kθ + i sin kθ = (1 + iu)ᵏ/(1 + u²)^(k/2) for θ = atan u.
pub(in crate::symbolic) fn without_inverse_angles(expr: &Expr) -> Expr {
    expr.rebuild(|node| {
        let Kind::Call(function @ (Function::Sin | Function::Cos | Function::Tan), argument) =
            node.kind()
        else {
            return None;
        };
        let (negative, multiple, u) = multiple_of_atan(argument)?;
        let (mut cos, mut sin) = (Expr::number(1), Expr::number(0));
        for _ in 0..multiple {
            (cos, sin) = (&cos - &(&sin * u), &sin + &(&cos * u));
        }
        if negative {
            sin = -sin;
        }
        // √(1 + u²)ᵏ
        let length = (Expr::number(1) + u.pow(2)).pow((multiple, 2));
        Some(match function {
            Function::Sin => sin / length,
            Function::Cos => cos / length,
            _ => sin / cos,
        })
    })
}

/// k and u of k·atan u, the sign of k apart.
fn multiple_of_atan(argument: &Expr) -> Option<(bool, u32, &Expr)> {
    match argument.kind() {
        Kind::Call(Function::Atan, u) => Some((false, 1, u)),
        Kind::Product(factors) => match &factors[..] {
            [number, atan] => {
                let Kind::Call(Function::Atan, u) = atan.kind() else {
                    return None;
                };
                let k = number.as_number().filter(|k| *k.denom() == 1)?;
                let multiple = k.numer().clone().abs().to_u32()?;
                (1..=MAX_MULTIPLE)
                    .contains(&multiple)
                    .then_some((*k < 0, multiple, u))
            }
            _ => None,
        },
        _ => None,
    }
}
