//! + − × ÷ of expressions.

use super::Expr;
use std::ops;

macro_rules! operator {
    ($trait:ident, $method:ident, |$a:ident, $b:ident| $result:expr) => {
        impl ops::$trait<&Expr> for &Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr {
                let ($a, $b) = (self.clone(), other.clone());
                $result
            }
        }
        impl ops::$trait<Expr> for Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                let ($a, $b) = (self, other);
                $result
            }
        }
    };
}
operator!(Add, add, |a, b| Expr::sum([a, b]));
operator!(Sub, sub, |a, b| Expr::sum([a, -b]));
operator!(Mul, mul, |a, b| Expr::product([a, b]));
operator!(Div, div, |a, b| Expr::product([a, b.recip()]));

impl ops::Neg for Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        Expr::product([Expr::number(-1), self])
    }
}

impl ops::Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        -self.clone()
    }
}
