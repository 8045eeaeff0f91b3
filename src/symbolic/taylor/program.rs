//! Programs run on Taylor series.

use super::{Range, Taylor};
use crate::symbolic::{Constant, Function, Operand, Operation, Program, Relation};

/// The Taylor series of all outputs up to `order`, of the first input over a panel. Every other input has no
/// value, and what depends on it no bound.
///
/// Where it cannot be told which branch a panel takes, or where a function may not be defined, the
/// coefficients may be any number.
#[must_use]
pub fn taylor(program: &Program, panel: &Taylor, order: usize) -> Vec<Taylor> {
    let constants: Vec<Taylor> = program.constants().iter().map(constant).collect();
    let unknown = Taylor::unknown(order);
    let mut registers: Vec<Taylor> = Vec::with_capacity(program.instructions().len() + 1);
    for instruction in program.instructions() {
        let of = |operand: Operand| value(operand, panel, &constants, &registers, &unknown);
        let mut second = None;
        let result = match instruction.operation {
            Operation::Add(a, b) => of(a).plus(of(b)),
            Operation::Subtract(a, b) => of(a).minus(of(b)),
            Operation::Multiply(a, b) if a == b => of(a).squared(order),
            Operation::Multiply(a, b) => of(a).times(of(b), order),
            Operation::Divide(a, b) => of(a).divided_by(of(b), order),
            Operation::Negate(a) => of(a).negated(),
            Operation::Sqrt(a) => of(a).sqrt(order),
            Operation::ExpM1(a) => of(a).exp_m1(order),
            Operation::Ln1p(a) => of(a).ln_1p(order),
            Operation::SinCos(a) => {
                let (sin, cos) = of(a).sin_cos(order);
                second = Some(cos);
                sin
            }
            Operation::Call(function, a) => call(function, of(a), order),
            Operation::Min(a, b) => chosen(Relation::Less, of(a), of(b), of(a), of(b), order),
            Operation::Max(a, b) => chosen(Relation::Less, of(a), of(b), of(b), of(a), order),
            Operation::Select {
                relation,
                left,
                right,
                then,
                otherwise,
            } => chosen(
                relation,
                of(left),
                of(right),
                of(then),
                of(otherwise),
                order,
            ),
        };
        registers.resize(instruction.target, Taylor(Vec::new()));
        registers.push(result);
        registers.extend(second);
    }
    let outputs = program.outputs().iter();
    outputs
        .map(|&operand| value(operand, panel, &constants, &registers, &unknown).clone())
        .collect()
}

fn constant(constant: &Constant) -> Taylor {
    let range = match constant {
        Constant::Rational(q) => Range::around(q),
        Constant::Pi => {
            let pi = std::f64::consts::PI;
            Range::new(pi, pi.next_up())
        }
    };
    Taylor::constant(range)
}

fn value<'v>(
    operand: Operand,
    panel: &'v Taylor,
    constants: &'v [Taylor],
    registers: &'v [Taylor],
    unknown: &'v Taylor,
) -> &'v Taylor {
    let found = match operand {
        Operand::Input(0) => Some(panel),
        Operand::Input(_) => None,
        Operand::Constant(i) => constants.get(i),
        Operand::Register(i) => registers.get(i),
    };
    found.unwrap_or(unknown)
}

fn call(function: Function, a: &Taylor, order: usize) -> Taylor {
    match function {
        Function::Exp => a.exp(order),
        Function::Ln => a.ln(order),
        Function::Sin => a.sin_cos(order).0,
        Function::Cos => a.sin_cos(order).1,
        Function::Tan => a.tan(order),
        Function::Sinh => a.sinh_cosh(order).0,
        Function::Cosh => a.sinh_cosh(order).1,
        Function::Tanh => a.tanh(order),
        Function::Atan => a.atan(order),
        Function::Erf => a.erf(order),
        Function::Abs => {
            let zero = Taylor::constant(Range::ZERO);
            chosen(Relation::Less, a, &zero, &a.negated(), a, order)
        }
    }
}

/// `then` where the panel certainly satisfies the relation, `otherwise` where it certainly does not. Where
/// that is open the values are those of either, and nothing is known of derivatives.
fn chosen(
    relation: Relation,
    left: &Taylor,
    right: &Taylor,
    then: &Taylor,
    otherwise: &Taylor,
    order: usize,
) -> Taylor {
    let (l, r) = (left.coefficient(0), right.coefficient(0));
    let certain = match relation {
        Relation::Less => certainty(l.high < r.low, l.low >= r.high),
        Relation::LessEqual => certainty(l.high <= r.low, l.low > r.high),
        Relation::Greater => certainty(l.low > r.high, l.high <= r.low),
        Relation::GreaterEqual => certainty(l.low >= r.high, l.high < r.low),
    };
    match certain {
        Some(true) => then.clone(),
        Some(false) => otherwise.clone(),
        None => {
            let (a, b) = (then.coefficient(0), otherwise.coefficient(0));
            let mut open = Taylor::unknown(order);
            if let Some(first) = open.0.first_mut() {
                *first = Range::new(a.low.min(b.low), a.high.max(b.high));
            }
            open
        }
    }
}

fn certainty(holds: bool, fails: bool) -> Option<bool> {
    match (holds, fails) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}
