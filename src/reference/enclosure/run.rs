//! Programs run on sets of numbers, their branches known.

use super::germ::Germ;
use super::number::{Number, Plane};
use super::rectangle::Rectangle;
use crate::symbolic::{
    Constant, Function, Instruction, Interval, Operand, Operation, Program, Relation,
};

/// For every instruction the way it takes: whether |x| is x, a minimum or maximum its first, a choice its `then`.
/// `None` where there is nothing to choose, or where what is chosen is not needed.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Branches(pub(super) Vec<Option<bool>>);

/// What registers hold, nothing where an operation may not be defined.
#[derive(Clone, Debug)]
pub(super) struct Registers<T>(Vec<Option<T>>);

impl<T> Default for Registers<T> {
    fn default() -> Self {
        Registers(Vec::new())
    }
}

impl<T> Registers<T> {
    pub(super) fn put(&mut self, register: usize, value: T) {
        self.set(register, Some(value));
    }

    fn set(&mut self, register: usize, value: Option<T>) {
        if self.0.len() <= register {
            self.0.resize_with(register + 1, || None);
        }
        self.0[register] = value;
    }

    pub(super) fn get(&self, register: usize) -> Option<&T> {
        self.0.get(register)?.as_ref()
    }
}

/// A program on its way.
pub(super) struct Run<'p, N> {
    program: &'p Program,
    input: N,
    constants: &'p [N],
    registers: Registers<N>,
}

/// The constants of a program, enclosed.
pub(super) fn constants<N: Number>(program: &Program, bits: u32) -> Vec<N> {
    let enclosed = program.constants().iter().map(|constant| match constant {
        Constant::Rational(q) => N::constant(bits, q),
        Constant::Pi => N::pi(bits),
    });
    enclosed.collect()
}

/// The outputs of a program on `input` along known branches.
pub(super) fn run<N: Number>(
    program: &Program,
    constants: &[N],
    input: &N,
    branches: &Branches,
) -> Vec<Option<N>> {
    let mut run = Run::new(program, constants, input);
    for (instruction, &way) in program.instructions().iter().zip(&branches.0) {
        run.step(instruction, way);
    }
    run.outputs()
}

/// All values of a program without branches on a rectangle, where it is known to be analytic.
#[must_use]
pub fn range(program: &Program, input: &Rectangle) -> Vec<Option<Rectangle>> {
    let bits = input.re.bits();
    let branches = Branches(vec![None; program.instructions().len()]);
    run(
        program,
        &constants::<Rectangle>(program, bits),
        input,
        &branches,
    )
}

/// All values that the outputs take on a part of the ray, whichever way it goes there.
pub(super) fn hull(
    program: &Program,
    constants: &[Interval],
    input: &Interval,
) -> Vec<Option<Interval>> {
    let mut run = Run::new(program, constants, input);
    for instruction in program.instructions() {
        let both = |a: Operand, b: Operand| {
            let (a, b) = (run.value(a)?, run.value(b)?);
            Some((a, b))
        };
        let result = match instruction.operation {
            Operation::Call(Function::Abs, a) => run.value(a).map(|a| a.abs()),
            Operation::Min(a, b) => both(a, b).map(|(a, b)| a.min(&b)),
            Operation::Max(a, b) => both(a, b).map(|(a, b)| a.max(&b)),
            Operation::Select {
                relation,
                left,
                right,
                then,
                otherwise,
            } => match both(left, right).and_then(|sides| holds(relation, &sides)) {
                Some(true) => run.value(then),
                Some(false) => run.value(otherwise),
                None => both(then, otherwise).map(|(a, b)| a.union(&b)),
            },
            _ => {
                run.step(instruction, None);
                continue;
            }
        };
        run.registers.set(instruction.target, result);
    }
    run.outputs()
}

/// Whether a relation holds of all numbers in two intervals, or of none.
fn holds(relation: Relation, (left, right): &(Interval, Interval)) -> Option<bool> {
    let (less, greater) = (left.upper() < right.lower(), left.lower() > right.upper());
    let (at_most, at_least) = (left.upper() <= right.lower(), left.lower() >= right.upper());
    let (always, never) = match relation {
        Relation::Less => (less, at_least),
        Relation::LessEqual => (at_most, greater),
        Relation::Greater => (greater, at_most),
        Relation::GreaterEqual => (at_least, less),
    };
    match (always, never) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

impl<'p, N: Number> Run<'p, N> {
    pub(super) fn new(program: &'p Program, constants: &'p [N], input: &N) -> Self {
        Run {
            program,
            input: input.clone(),
            constants,
            registers: Registers::default(),
        }
    }

    pub(super) fn outputs(&self) -> Vec<Option<N>> {
        let outputs = self.program.outputs().iter();
        outputs.map(|&operand| self.value(operand)).collect()
    }

    fn find(&self, operand: Operand) -> Option<&N> {
        match operand {
            Operand::Input(0) => Some(&self.input),
            Operand::Input(_) => None,
            Operand::Constant(i) => self.constants.get(i),
            Operand::Register(i) => self.registers.get(i),
        }
    }

    pub(super) fn value(&self, operand: Operand) -> Option<N> {
        self.find(operand).cloned()
    }

    /// Fills the registers of one instruction, going the way it is told.
    pub(super) fn step(&mut self, instruction: &Instruction, way: Option<bool>) {
        let mut second = None;
        let result = self.result(instruction.operation, way, &mut second);
        self.registers.set(instruction.target, result);
        if let Operation::SinCos(_) = instruction.operation {
            self.registers.set(instruction.target + 1, second);
        }
    }

    fn result(&self, operation: Operation, way: Option<bool>, second: &mut Option<N>) -> Option<N> {
        let of = |operand| self.find(operand);
        match operation {
            Operation::Add(a, b) => Some(of(a)?.plus(of(b)?)),
            Operation::Subtract(a, b) => Some(of(a)?.minus(of(b)?)),
            Operation::Multiply(a, b) if a == b => Some(of(a)?.squared()),
            Operation::Multiply(a, b) => Some(of(a)?.times(of(b)?)),
            Operation::Divide(a, b) => of(a)?.over(of(b)?),
            Operation::Negate(a) => Some(of(a)?.negated()),
            Operation::Sqrt(a) => of(a)?.sqrt(),
            Operation::ExpM1(a) => of(a)?.exp_m1(),
            Operation::Ln1p(a) => of(a)?.ln_1p(),
            Operation::SinCos(a) => {
                let (sin, cos) = of(a)?.sin_cos();
                *second = Some(cos);
                Some(sin)
            }
            Operation::Call(Function::Abs, a) => Some(if way? {
                of(a)?.clone()
            } else {
                of(a)?.negated()
            }),
            Operation::Call(function, a) => of(a)?.call(function),
            Operation::Min(a, b) | Operation::Max(a, b) => self.value(if way? { a } else { b }),
            Operation::Select {
                then, otherwise, ..
            } => self.value(if way? { then } else { otherwise }),
        }
    }
}

impl<N: Plane> Run<'_, Germ<N>> {
    /// What a register holds is that number at v = 0.
    pub(super) fn base(&mut self, register: usize, bits: u32, q: &rug::Rational) {
        if let Some(germ) = self.registers.get(register).cloned() {
            self.registers.put(register, germ.based_on(bits, q));
        }
    }
}
