//! From a program to named steps and one value, as text.

use super::callee::Callee;
use super::layout::{Body, Choice, Layout};
use super::names::Names;
use super::number;
use super::text::{Strength, Text};
use crate::symbolic::{Constant, Function, Operand, Operation, Program};
use std::collections::HashMap;

/// Longer texts become a step of their own, although they are needed once: lines stay readable, and
/// nesting stays shallow enough for every compiler.
const MAX_NESTED: usize = 60;

/// The first output of the program; `callees` gets what it calls, each once.
pub(super) fn body(
    program: &Program,
    layout: &dyn Layout,
    names: &Names<'_>,
    callees: &mut Vec<Callee>,
) -> Body {
    let mut names = names.clone();
    let inputs: Vec<&str> = program.inputs().collect();
    let parameters = names.claim(&inputs);
    let operations = operations(program);
    let output = program.outputs().first().copied();
    let uses = uses(&operations, output);

    let mut texts: HashMap<Operand, Text> = HashMap::new();
    for (place, name) in parameters.iter().enumerate() {
        texts.insert(Operand::Input(place), Text::atom(name.as_str()));
    }
    let mut divisors = Vec::new();
    for (place, constant) in program.constants().iter().enumerate() {
        let text = match constant {
            Constant::Rational(q) => number::rational(q, layout),
            Constant::Pi => Text::atom(layout.pi()),
        };
        texts.insert(Operand::Constant(place), text);
        if !matches!(constant, Constant::Rational(q) if number::rounded(q) == 0.0) {
            divisors.push(Operand::Constant(place));
        }
    }

    let mut steps = Vec::new();
    let mut last = 0;
    for (target, operation) in operations {
        let Some(&count) = uses.get(&target) else {
            continue;
        };
        let mut writer = Writer {
            layout,
            texts: &texts,
            divisors: &divisors,
            callees: &mut *callees,
        };
        let text = writer.operation(operation);
        let short = text.strength > Strength::Choice && text.text.len() <= MAX_NESTED;
        let text = if count == 1 && (short || output == Some(target)) {
            text
        } else {
            let name = names.local(&mut last);
            steps.push((name.clone(), text.text));
            Text::atom(name)
        };
        texts.insert(target, text);
    }
    let value = output.and_then(|output| texts.get(&output));
    let value = value.map_or(layout.nan().into(), |value| value.text.clone());
    let unused = (0..)
        .zip(&parameters)
        .filter(|(place, _)| !uses.contains_key(&Operand::Input(*place)))
        .map(|(_, name)| name.clone())
        .collect();
    Body {
        parameters,
        unused,
        steps,
        value,
    }
}

/// The operations with the registers they fill, sines and cosines apart.
fn operations(program: &Program) -> Vec<(Operand, Operation)> {
    let mut operations = Vec::new();
    for instruction in program.instructions() {
        let target = instruction.target;
        match instruction.operation {
            Operation::SinCos(a) => {
                let (sin, cos) = (Function::Sin, Function::Cos);
                operations.push((Operand::Register(target), Operation::Call(sin, a)));
                operations.push((Operand::Register(target + 1), Operation::Call(cos, a)));
            }
            operation => operations.push((Operand::Register(target), operation)),
        }
    }
    operations
}

/// How often each operand is written where the output is wanted.
fn uses(operations: &[(Operand, Operation)], output: Option<Operand>) -> HashMap<Operand, usize> {
    let mut uses: HashMap<Operand, usize> = output.into_iter().map(|output| (output, 1)).collect();
    for (target, operation) in operations.iter().rev() {
        if !uses.contains_key(target) {
            continue;
        }
        let mut written = operation.operands();
        if let Operation::Select { left, right, .. } = operation {
            // Both are compared twice.
            written.extend([*left, *right]);
        }
        for operand in written {
            *uses.entry(operand).or_default() += 1;
        }
    }
    uses
}

struct Writer<'w> {
    layout: &'w dyn Layout,
    texts: &'w HashMap<Operand, Text>,
    /// What is not 0 for certain.
    divisors: &'w [Operand],
    callees: &'w mut Vec<Callee>,
}

impl Writer<'_> {
    fn operand(&self, operand: Operand) -> Text {
        let text = self.texts.get(&operand).cloned();
        text.unwrap_or_else(|| Text::atom(self.layout.nan()))
    }

    /// a and b with a sign between them; operators bind to the left.
    fn binary(&self, a: Operand, sign: &str, b: Operand, strength: Strength) -> Text {
        let tighter = if strength == Strength::Sum {
            Strength::Product
        } else {
            Strength::Sign
        };
        let (a, b) = (self.operand(a), self.operand(b));
        Text {
            text: format!("{} {sign} {}", a.at(strength), b.at(tighter)),
            strength,
        }
    }

    fn call(&mut self, callee: Callee, arguments: &[Operand]) -> Text {
        if !self.callees.contains(&callee) {
            self.callees.push(callee);
        }
        let arguments: Vec<String> = arguments
            .iter()
            .map(|&argument| self.operand(argument).text)
            .collect();
        let name = self.layout.callee(callee);
        Text::atom(format!("{name}({})", arguments.join(", ")))
    }

    fn operation(&mut self, operation: Operation) -> Text {
        match operation {
            Operation::Add(a, b) => self.binary(a, "+", b, Strength::Sum),
            Operation::Subtract(a, b) => self.binary(a, "-", b, Strength::Sum),
            Operation::Multiply(a, b) => self.binary(a, "*", b, Strength::Product),
            Operation::Divide(a, b)
                if self.layout.division_raises() && !self.divisors.contains(&b) =>
            {
                self.call(Callee::Divide, &[a, b])
            }
            Operation::Divide(a, b) => self.binary(a, "/", b, Strength::Product),
            Operation::Negate(a) => Text {
                text: format!("-{}", self.operand(a).at(Strength::Atom)),
                strength: Strength::Sign,
            },
            Operation::Sqrt(a) => self.call(Callee::Sqrt, &[a]),
            Operation::ExpM1(a) => self.call(Callee::ExpM1, &[a]),
            Operation::Ln1p(a) => self.call(Callee::Ln1p, &[a]),
            Operation::SinCos(a) => self.call(Callee::Function(Function::Sin), &[a]),
            Operation::Call(function, a) => self.call(Callee::Function(function), &[a]),
            Operation::Min(a, b) => self.call(Callee::Min, &[a, b]),
            Operation::Max(a, b) => self.call(Callee::Max, &[a, b]),
            Operation::Select {
                relation,
                left,
                right,
                then,
                otherwise,
            } => {
                let [left, right, then, otherwise] =
                    [left, right, then, otherwise].map(|operand| self.operand(operand).text);
                Text {
                    text: self.layout.choice(&Choice {
                        left: &left,
                        relation,
                        right: &right,
                        then: &then,
                        otherwise: &otherwise,
                    }),
                    strength: Strength::Choice,
                }
            }
        }
    }
}
