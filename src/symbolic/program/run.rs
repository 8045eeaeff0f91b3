//! Running a program over many places at once.

use super::{Operand, Operation, Program};
use crate::real::{Format, Real, row};
use crate::symbolic::Function;
use std::cmp::Ordering;
use std::sync::Arc;

/// Places that are computed side by side: enough for the loops to be long, few enough for a cache.
const LANES: usize = 64;

/// A program with its constants in one format.
#[derive(Clone, Debug)]
pub struct Bound<'p, F: Format> {
    pub(super) program: &'p Program,
    pub(super) format: F,
    pub(super) constants: Arc<[F::Real]>,
}

/// One value for each lane, or the same for all.
enum Values<'v, R> {
    Each(&'v [R]),
    All(&'v R),
}

impl<R> Clone for Values<'_, R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R> Copy for Values<'_, R> {}

impl<F: Format> Bound<'_, F> {
    /// Appends the values of output k at every place to `outputs[k]`.
    ///
    /// `inputs[i]` are the values of input i; where they are of different lengths, the shortest counts.
    /// Inputs and outputs that the program does not have are left alone.
    pub fn run(&self, inputs: &[&[F::Real]], outputs: &mut [Vec<F::Real>]) {
        let count = inputs.iter().map(|values| values.len()).min().unwrap_or(0);
        let lanes = count.min(LANES);
        let mut registers = vec![self.format.int(0); lanes * self.program.registers];
        let mut from = 0;
        while from < count {
            let to = (from + lanes).min(count);
            let block = row(inputs.iter().map(|values| &values[from..to]));
            self.run_block(&block, lanes, to - from, &mut registers);
            for (operand, output) in self.program.outputs.iter().zip(outputs.iter_mut()) {
                match self.values(*operand, &block, &registers, lanes, to - from) {
                    Values::Each(values) => output.extend_from_slice(values),
                    Values::All(value) => {
                        output.extend(std::iter::repeat_n(value.clone(), to - from));
                    }
                }
            }
            from = to;
        }
    }

    /// The values of all outputs at one place.
    #[must_use]
    pub fn at(&self, inputs: &[&F::Real]) -> Vec<F::Real> {
        let block = row(inputs.iter().map(|&value| std::slice::from_ref(value)));
        let mut registers = vec![self.format.int(0); self.program.registers];
        self.run_block(&block, 1, 1, &mut registers);
        let outputs = self.program.outputs.iter();
        let value = |operand| self.values(operand, &block, &registers, 1, 1);
        row(outputs.map(|operand| lane(value(*operand), 0).clone()))
    }

    /// Which way every comparison of a piecewise expression goes at one place, in the order of the program.
    #[must_use]
    pub fn branches(&self, inputs: &[&F::Real]) -> Vec<bool> {
        let block = row(inputs.iter().map(|&value| std::slice::from_ref(value)));
        let mut registers = vec![self.format.int(0); self.program.registers];
        self.run_block(&block, 1, 1, &mut registers);
        // No register is filled twice, so what was compared still stands there.
        let value = |operand| lane(self.values(operand, &block, &registers, 1, 1), 0);
        self.program
            .instructions
            .iter()
            .filter_map(|instruction| match instruction.operation {
                Operation::Select {
                    relation,
                    left,
                    right,
                    ..
                } => Some(relation.holds(value(left), value(right))),
                _ => None,
            })
            .collect()
    }

    fn values<'v>(
        &'v self,
        operand: Operand,
        inputs: &[&'v [F::Real]],
        registers: &'v [F::Real],
        lanes: usize,
        count: usize,
    ) -> Values<'v, F::Real> {
        match operand {
            Operand::Input(i) => Values::Each(inputs[i]),
            Operand::Constant(i) => Values::All(&self.constants[i]),
            Operand::Register(i) => Values::Each(&registers[i * lanes..i * lanes + count]),
        }
    }

    /// All instructions on `count` ≤ `lanes` places; register r occupies `registers[r·lanes..]`.
    fn run_block(
        &self,
        inputs: &[&[F::Real]],
        lanes: usize,
        count: usize,
        registers: &mut [F::Real],
    ) {
        for instruction in &self.program.instructions {
            // Operands stand in earlier registers than the target.
            let (earlier, rest) = registers.split_at_mut(instruction.target * lanes);
            let (target, next) = rest.split_at_mut(lanes);
            let target = &mut target[..count];
            let values = |operand| self.values(operand, inputs, earlier, lanes, count);
            match instruction.operation {
                Operation::Add(a, b) => binary(target, values(a), values(b), |x, y| *x += y),
                Operation::Subtract(a, b) => binary(target, values(a), values(b), |x, y| *x -= y),
                Operation::Multiply(a, b) => binary(target, values(a), values(b), |x, y| *x *= y),
                Operation::Divide(a, b) => binary(target, values(a), values(b), |x, y| *x /= y),
                Operation::Min(a, b) => binary(target, values(a), values(b), |x, y| {
                    keep(x, y, Ordering::Less);
                }),
                Operation::Max(a, b) => binary(target, values(a), values(b), |x, y| {
                    keep(x, y, Ordering::Greater);
                }),
                Operation::Negate(a) => unary(target, values(a), |x| -x),
                Operation::Sqrt(a) => unary(target, values(a), Real::sqrt),
                Operation::ExpM1(a) => in_row(target, values(a), Real::exp_m1_row, Real::exp_m1),
                Operation::Ln1p(a) => unary(target, values(a), Real::ln_1p as fn(_) -> _),
                Operation::Call(function, a) => call(function, target, values(a)),
                Operation::SinCos(a) => {
                    let cosines = &mut next[..count];
                    match values(a) {
                        Values::Each(a) => Real::sin_cos_row(a, target, cosines),
                        Values::All(a) => {
                            for (sin, cos) in target.iter_mut().zip(cosines) {
                                (*sin, *cos) = a.clone().sin_cos();
                            }
                        }
                    }
                }
                Operation::Select {
                    relation,
                    left,
                    right,
                    then,
                    otherwise,
                } => {
                    for (i, target) in target.iter_mut().enumerate() {
                        let (left, right) = (lane(values(left), i), lane(values(right), i));
                        let holds = relation.holds(left, right);
                        let comparable = left.partial_cmp(right).is_some();
                        if !comparable {
                            // What NaN leads to is NaN.
                            target.set(left);
                            *target += right;
                        } else if holds {
                            target.set(lane(values(then), i));
                        } else {
                            target.set(lane(values(otherwise), i));
                        }
                    }
                }
            }
        }
    }
}

fn lane<R>(values: Values<'_, R>, i: usize) -> &R {
    match values {
        Values::Each(values) => &values[i],
        Values::All(value) => value,
    }
}

/// target = a, then `apply` with b: in place, so that MPFR reuses its limbs.
#[inline]
fn binary<R: Real>(
    target: &mut [R],
    a: Values<'_, R>,
    b: Values<'_, R>,
    apply: impl Fn(&mut R, &R),
) {
    // One loop for each shape, so that native formats are computed side by side.
    match (a, b) {
        (Values::Each(a), Values::Each(b)) => {
            for ((target, a), b) in target.iter_mut().zip(a).zip(b) {
                target.set(a);
                apply(target, b);
            }
        }
        (Values::Each(a), Values::All(b)) => {
            for (target, a) in target.iter_mut().zip(a) {
                target.set(a);
                apply(target, b);
            }
        }
        (Values::All(a), Values::Each(b)) => {
            for (target, b) in target.iter_mut().zip(b) {
                target.set(a);
                apply(target, b);
            }
        }
        (Values::All(a), Values::All(b)) => {
            for target in target {
                target.set(a);
                apply(target, b);
            }
        }
    }
}

#[inline]
fn unary<R: Real>(target: &mut [R], a: Values<'_, R>, apply: impl Fn(R) -> R) {
    match a {
        Values::Each(a) => {
            for (target, a) in target.iter_mut().zip(a) {
                *target = apply(a.clone());
            }
        }
        Values::All(a) => {
            for target in target {
                *target = apply(a.clone());
            }
        }
    }
}

/// The same of a function that rows have.
fn in_row<R: Real>(
    target: &mut [R],
    a: Values<'_, R>,
    of_row: fn(&[R], &mut [R]),
    of_one: fn(R) -> R,
) {
    match a {
        Values::Each(a) => of_row(a, target),
        Values::All(_) => unary(target, a, of_one),
    }
}

fn call<R: Real>(function: Function, target: &mut [R], a: Values<'_, R>) {
    // The commonest of all.
    if function == Function::Exp {
        return in_row(target, a, R::exp_row, R::exp);
    }
    // Through a pointer, which is nothing beside the function: one loop for all of them.
    let apply: fn(R) -> R = match function {
        Function::Exp => Real::exp,
        Function::Ln => Real::ln,
        Function::Sin => |x| x.sin_cos().0,
        Function::Cos => |x| x.sin_cos().1,
        Function::Tan => Real::tan,
        Function::Sinh => Real::sinh,
        Function::Cosh => Real::cosh,
        Function::Tanh => Real::tanh,
        Function::Atan => Real::atan,
        Function::Erf => Real::erf,
        Function::Abs => Real::abs,
    };
    unary(target, a, apply);
}

/// Replaces x by y where y is less (greater) or NaN.
fn keep<R: Real>(x: &mut R, y: &R, wanted: Ordering) {
    match y.partial_cmp(x) {
        Some(order) if order == wanted => x.set(y),
        Some(_) => {}
        None => *x += y,
    }
}
