//! Which way a program goes on a part of the ray.

use super::number::Number;
use super::run::{Branches, Registers, Run};
use crate::symbolic::{Function, Interval, Operand, Operation, Program, Relation};
use std::collections::BTreeMap;

/// What is known of a program on a panel.
pub(super) enum Taken {
    /// One way almost everywhere, which makes all that is needed analytic within, wherever it is defined.
    Known(Branches),
    /// More than one, or it cannot be told.
    Open {
        /// What is known of the way.
        taken: Branches,
        /// The first instruction that is needed and of which it is not known.
        place: usize,
    },
}

/// What an operation that chooses compares: a left side, a right one or 0, and how.
pub(super) fn sides(operation: Operation) -> Option<(Operand, Option<Operand>, Relation)> {
    match operation {
        Operation::Call(Function::Abs, a) => Some((a, None, Relation::GreaterEqual)),
        Operation::Min(a, b) => Some((a, Some(b), Relation::LessEqual)),
        Operation::Max(a, b) => Some((a, Some(b), Relation::GreaterEqual)),
        Operation::Select {
            relation,
            left,
            right,
            ..
        } => Some((left, Some(right), relation)),
        _ => None,
    }
}

/// Whether a relation holds of two sides that differ.
pub(super) fn holds(relation: Relation, is_less: bool) -> bool {
    match relation {
        Relation::Less | Relation::LessEqual => is_less,
        Relation::Greater | Relation::GreaterEqual => !is_less,
    }
}

/// Decides all choices that the outputs need on a panel, from its values there and at one place within.
///
/// Where the two sides of a comparison touch but never cross, it is decided by the place within: both sides are
/// analytic, and where they differ somewhere they are equal in single places only, which an integral does not see.
/// What is known in another way stands in `known`.
pub(super) fn branches(
    program: &Program,
    constants: &[Interval],
    panel: &Interval,
    within: &Interval,
    known: &BTreeMap<usize, bool>,
) -> Taken {
    let count = program.instructions().len();
    let mut taken = Branches(vec![None; count]);
    let mut everywhere = Run::new(program, constants, panel);
    let mut somewhere = Run::new(program, constants, within);
    let mut is_analytic = true;
    for (place, instruction) in program.instructions().iter().enumerate() {
        if let Some((left, right, relation)) = sides(instruction.operation) {
            let zero = Interval::constant(panel.bits(), &rug::Rational::new());
            let both = |run: &Run<'_, Interval>| {
                let right = right.map_or(Some(zero.clone()), |right| run.value(right));
                run.value(left).zip(right)
            };
            if let (Some(all), Some(one)) = (both(&everywhere), both(&somewhere)) {
                taken.0[place] = decided(relation, &all, &one, is_analytic);
            }
            if let Some(&way) = known.get(&place) {
                taken.0[place] = Some(way);
            }
        }
        is_analytic &= !reaches_a_branch_point(&everywhere, instruction.operation);
        everywhere.step(instruction, taken.0[place]);
        somewhere.step(instruction, taken.0[place]);
    }
    needed(program, taken)
}

/// Whether a root or a logarithm is taken of what may be 0 somewhere.
fn reaches_a_branch_point(run: &Run<'_, Interval>, operation: Operation) -> bool {
    match operation {
        Operation::Sqrt(a) | Operation::Call(Function::Ln, a) => {
            run.value(a).is_none_or(|a| !a.is_positive())
        }
        _ => false,
    }
}

fn decided(
    relation: Relation,
    all: &(Interval, Interval),
    one: &(Interval, Interval),
    is_analytic: bool,
) -> Option<bool> {
    let below = all.0.upper() <= all.1.lower();
    let above = all.0.lower() >= all.1.upper();
    if below && above {
        // The same number on both sides, everywhere.
        return Some(matches!(
            relation,
            Relation::LessEqual | Relation::GreaterEqual
        ));
    }
    let strictly_below =
        all.0.upper() < all.1.lower() || is_analytic && one.0.upper() < one.1.lower();
    let strictly_above =
        all.0.lower() > all.1.upper() || is_analytic && one.0.lower() > one.1.upper();
    let less = if below && strictly_below {
        true
    } else if above && strictly_above {
        false
    } else {
        return None;
    };
    Some(holds(relation, less))
}

/// Only what the outputs need, `Open` where that is not decided.
fn needed(program: &Program, mut taken: Branches) -> Taken {
    let mut undecided: Option<usize> = None;
    let instructions = program.instructions();
    let mut makers: Registers<usize> = Registers::default();
    for (place, instruction) in instructions.iter().enumerate() {
        makers.put(instruction.target, place);
        if let Operation::SinCos(_) = instruction.operation {
            makers.put(instruction.target + 1, place);
        }
    }
    let mut seen = vec![false; instructions.len()];
    let mut open: Vec<Operand> = program.outputs().to_vec();
    while let Some(operand) = open.pop() {
        let Operand::Register(register) = operand else {
            continue;
        };
        let Some(&place) = makers.get(register) else {
            continue;
        };
        if std::mem::replace(&mut seen[place], true) {
            continue;
        }
        let way = taken.0[place];
        match (instructions[place].operation, way) {
            (Operation::Call(Function::Abs, a), Some(_)) => open.push(a),
            (Operation::Min(a, b) | Operation::Max(a, b), Some(first)) => {
                open.push(if first { a } else { b });
            }
            (
                Operation::Select {
                    then, otherwise, ..
                },
                Some(holds),
            ) => open.push(if holds { then } else { otherwise }),
            (operation, _) => match sides(operation) {
                Some((left, right, _)) => {
                    undecided = Some(undecided.map_or(place, |first| first.min(place)));
                    open.extend([Some(left), right].into_iter().flatten());
                }
                None => open.extend(operation.operands()),
            },
        }
    }
    if let Some(place) = undecided {
        return Taken::Open { taken, place };
    }
    for (way, seen) in taken.0.iter_mut().zip(seen) {
        if !seen {
            *way = None;
        }
    }
    Taken::Known(taken)
}
