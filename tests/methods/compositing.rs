//! Compositing's variants: the same approximation in exact arithmetic, each with roundings of its own.

mod orders;
mod rounding;
mod stops;
mod variants;

use rug::Float;
use volver::case::HomogeneousSlab;
use volver::case::manufacture::{Manufactured, manufacture};
use volver::case::{SymbolicCase, catalogue};
use volver::method::{
    Accumulation, Compositing, CompositingOrder, OpacityFormula, Position, Summation, Threshold,
};

const POSITIONS: [Position; 3] = [Position::Front, Position::Middle, Position::Back];
const EXACT_OPACITIES: [OpacityFormula; 3] = [
    OpacityFormula::Subtraction,
    OpacityFormula::Expm1,
    OpacityFormula::Relative,
];
const SUMMATIONS: [Summation; 3] = [Summation::Naive, Summation::Pairwise, Summation::Neumaier];

fn front_to_back(depth: Accumulation, summation: Summation) -> CompositingOrder {
    CompositingOrder::FrontToBack {
        depth,
        summation,
        stop: None,
    }
}

fn until(numerator: u32, denominator: u32) -> CompositingOrder {
    CompositingOrder::FrontToBack {
        depth: Accumulation::Transmittances,
        summation: Summation::Naive,
        stop: Some(Threshold::new(numerator, denominator).unwrap()),
    }
}

/// Every order without a threshold whose transmittance is made of the opacities.
fn orders_of_opacities() -> Vec<CompositingOrder> {
    let mut orders = vec![CompositingOrder::BackToFront, CompositingOrder::Tree];
    orders.extend(SUMMATIONS.map(|sum| front_to_back(Accumulation::Transmittances, sum)));
    orders.extend(SUMMATIONS.map(|sum| front_to_back(Accumulation::Remainder, sum)));
    orders
}

/// Every order without a threshold.
fn orders() -> Vec<CompositingOrder> {
    let mut orders = orders_of_opacities();
    orders.extend(SUMMATIONS.map(|sum| front_to_back(Accumulation::Depths, sum)));
    orders
}

fn compositing(
    position: Position,
    opacity: OpacityFormula,
    order: CompositingOrder,
) -> Compositing {
    Compositing {
        position,
        opacity,
        order,
    }
}

/// No number here is one of binary64.
fn slab() -> HomogeneousSlab {
    HomogeneousSlab {
        length: (13, 10).into(),
        extinction: (4, 3).into(),
        emission: (7, 10).into(),
    }
}

fn made(name: &str) -> Vec<SymbolicCase> {
    let made: Vec<Manufactured> = manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap();
    made.into_iter().map(|made| made.case).collect()
}

fn case(name: &str) -> SymbolicCase {
    made(name).remove(0)
}

/// |a − b|/|b|.
fn relative(a: &Float, b: &Float) -> Float {
    (Float::with_val(1000, a - b) / b).abs()
}

fn decimal(text: &str) -> Float {
    Float::with_val(100, Float::parse(text).unwrap())
}
