//! From expressions to instructions.

use super::{Constant, Instruction, Operand, Operation, Program};
use crate::symbolic::hash::HashMap;
use crate::symbolic::{Branch, Expr, Function, Kind};
use rug::Rational;

/// Why expressions cannot be compiled.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CompileError {
    /// A symbol that is none of the inputs.
    #[error("unknown name '{name}' (allowed: {allowed})")]
    UnknownSymbol {
        /// The symbol.
        name: String,
        /// The inputs.
        allowed: String,
    },
}

pub(super) fn compile(outputs: &[Expr], inputs: &[&str]) -> Result<Program, CompileError> {
    let mut compiler = Compiler {
        program: Program {
            inputs: inputs.iter().map(|&name| name.into()).collect(),
            constants: Vec::new(),
            instructions: Vec::new(),
            outputs: Vec::new(),
            registers: 0,
        },
        places: HashMap::default(),
        constants: HashMap::default(),
        results: HashMap::default(),
    };
    for output in outputs {
        let place = compiler.value(output)?;
        compiler.program.outputs.push(place);
    }
    Ok(compiler.program)
}

struct Compiler {
    program: Program,
    places: HashMap<Expr, Operand>,
    constants: HashMap<Constant, Operand>,
    /// Equal operations on equal operands are one.
    results: HashMap<Operation, usize>,
}

impl Compiler {
    fn constant(&mut self, constant: Constant) -> Operand {
        let constants = &mut self.program.constants;
        *self
            .constants
            .entry(constant)
            .or_insert_with_key(|constant| {
                constants.push(constant.clone());
                Operand::Constant(constants.len() - 1)
            })
    }

    fn number(&mut self, q: impl Into<Rational>) -> Operand {
        self.constant(Constant::Rational(q.into()))
    }

    /// The register that the operation fills (the first of two, for a sine and a cosine).
    fn register(&mut self, operation: Operation) -> usize {
        let program = &mut self.program;
        *self.results.entry(operation).or_insert_with(|| {
            let target = program.registers;
            program.registers += match operation {
                Operation::SinCos(_) => 2,
                _ => 1,
            };
            program.instructions.push(Instruction { operation, target });
            target
        })
    }

    fn emit(&mut self, operation: Operation) -> Operand {
        Operand::Register(self.register(operation))
    }

    fn value(&mut self, expr: &Expr) -> Result<Operand, CompileError> {
        if let Some(&place) = self.places.get(expr) {
            return Ok(place);
        }
        let place = self.compute(expr)?;
        self.places.insert(expr.clone(), place);
        Ok(place)
    }

    fn compute(&mut self, expr: &Expr) -> Result<Operand, CompileError> {
        match expr.kind() {
            Kind::Number(q) => Ok(self.number(q.clone())),
            Kind::Pi => Ok(self.constant(Constant::Pi)),
            Kind::Symbol(name) => {
                match self.program.inputs.iter().position(|input| input == name) {
                    Some(place) => Ok(Operand::Input(place)),
                    None => Err(CompileError::UnknownSymbol {
                        name: name.to_string(),
                        allowed: self.program.inputs.join(", "),
                    }),
                }
            }
            Kind::Sum(terms) => self.sum(terms),
            Kind::Product(factors) => self.product(factors),
            Kind::Power(base, exponent) => {
                let base = self.value(base)?;
                if *exponent < 0 {
                    let power = self.power(base, &Rational::from(-exponent));
                    let one = self.number(1);
                    Ok(self.emit(Operation::Divide(one, power)))
                } else {
                    Ok(self.power(base, exponent))
                }
            }
            Kind::Call(function, argument) => self.call(*function, argument),
            Kind::Min(a, b) => {
                let (a, b) = (self.value(a)?, self.value(b)?);
                Ok(self.emit(Operation::Min(a, b)))
            }
            Kind::Max(a, b) => {
                let (a, b) = (self.value(a)?, self.value(b)?);
                Ok(self.emit(Operation::Max(a, b)))
            }
            Kind::Piecewise(branches, otherwise) => self.piecewise(branches, otherwise),
        }
    }

    fn call(&mut self, function: Function, argument: &Expr) -> Result<Operand, CompileError> {
        if function == Function::Ln
            && let Kind::Sum(terms) = argument.kind()
            && terms.iter().any(|term| term.is(1))
        {
            let rest = Expr::sum(terms.iter().filter(|term| !term.is(1)).cloned());
            let rest = self.value(&rest)?;
            return Ok(self.emit(Operation::Ln1p(rest)));
        }
        let argument = self.value(argument)?;
        Ok(match function {
            Function::Sin => self.emit(Operation::SinCos(argument)),
            Function::Cos => Operand::Register(self.register(Operation::SinCos(argument)) + 1),
            _ => self.emit(Operation::Call(function, argument)),
        })
    }

    fn sum(&mut self, terms: &[Expr]) -> Result<Operand, CompileError> {
        let terms = terms_without_cancellation(terms);
        let mut sum: Option<Operand> = None;
        for term in &terms {
            sum = Some(match (sum, term) {
                (None, Term::Plain(term)) => self.value(term)?,
                (None, Term::ExpM1 { factor, exponent }) => {
                    let value = self.exp_m1(exponent)?;
                    self.scaled(factor, value)
                }
                (Some(sum), Term::Plain(term)) => {
                    if let Some(term) = negated(term) {
                        let term = self.value(&term)?;
                        self.emit(Operation::Subtract(sum, term))
                    } else {
                        let term = self.value(term)?;
                        self.emit(Operation::Add(sum, term))
                    }
                }
                (Some(sum), Term::ExpM1 { factor, exponent }) => {
                    let value = self.exp_m1(exponent)?;
                    if *factor < 0 {
                        let value = self.scaled(&Rational::from(-factor), value);
                        self.emit(Operation::Subtract(sum, value))
                    } else {
                        let value = self.scaled(factor, value);
                        self.emit(Operation::Add(sum, value))
                    }
                }
            });
        }
        match sum {
            Some(sum) => Ok(sum),
            None => Ok(self.number(0)),
        }
    }

    fn exp_m1(&mut self, exponent: &Expr) -> Result<Operand, CompileError> {
        let exponent = self.value(exponent)?;
        Ok(self.emit(Operation::ExpM1(exponent)))
    }

    /// `factor` times a value, with one rounding where that is possible.
    fn scaled(&mut self, factor: &Rational, value: Operand) -> Operand {
        if *factor == 1 {
            value
        } else if *factor == -1 {
            self.emit(Operation::Negate(value))
        } else if *factor.numer() == 1 && !factor.denom().is_power_of_two() {
            let divisor = self.number(factor.denom().clone());
            self.emit(Operation::Divide(value, divisor))
        } else {
            let factor = self.number(factor.clone());
            self.emit(Operation::Multiply(factor, value))
        }
    }

    fn product(&mut self, factors: &[Expr]) -> Result<Operand, CompileError> {
        let (coefficient, factors) = match factors {
            [first, rest @ ..] => match first.as_number() {
                Some(q) => (q.clone(), rest),
                None => (Rational::from(1), factors),
            },
            [] => (Rational::from(1), factors),
        };
        let mut product: Option<Operand> = None;
        for factor in factors {
            product = Some(match (product, factor.kind()) {
                (None, _) => self.value(factor)?,
                (Some(product), Kind::Power(base, exponent)) if *exponent < 0 => {
                    let base = self.value(base)?;
                    let divisor = self.power(base, &Rational::from(-exponent));
                    self.emit(Operation::Divide(product, divisor))
                }
                (Some(product), _) => {
                    let factor = self.value(factor)?;
                    self.emit(Operation::Multiply(product, factor))
                }
            });
        }
        Ok(match product {
            Some(product) => self.scaled(&coefficient, product),
            None => self.number(coefficient),
        })
    }

    /// A power with an exponent ≥ 0: by squaring where it is an integer, by roots where its denominator is 2,
    /// otherwise by exp and ln.
    fn power(&mut self, base: Operand, exponent: &Rational) -> Operand {
        match (exponent.numer().to_u32(), exponent.denom().to_u32()) {
            (Some(n), Some(1)) => self.integer_power(base, n),
            (Some(n), Some(2)) => {
                let root = self.emit(Operation::Sqrt(base));
                self.integer_power(root, n)
            }
            _ => {
                let ln = self.emit(Operation::Call(Function::Ln, base));
                let exponent = self.number(exponent.clone());
                let product = self.emit(Operation::Multiply(exponent, ln));
                self.emit(Operation::Call(Function::Exp, product))
            }
        }
    }

    fn integer_power(&mut self, base: Operand, exponent: u32) -> Operand {
        match exponent {
            0 => self.number(1),
            1 => base,
            _ => {
                let half = self.integer_power(base, exponent / 2);
                let square = self.emit(Operation::Multiply(half, half));
                if exponent.is_multiple_of(2) {
                    square
                } else {
                    self.emit(Operation::Multiply(square, base))
                }
            }
        }
    }

    fn piecewise(
        &mut self,
        branches: &[Branch],
        otherwise: &Expr,
    ) -> Result<Operand, CompileError> {
        let mut value = self.value(otherwise)?;
        for branch in branches.iter().rev() {
            let condition = &branch.condition;
            let select = Operation::Select {
                relation: condition.relation,
                left: self.value(&condition.left)?,
                right: self.value(&condition.right)?,
                then: self.value(&branch.value)?,
                otherwise: value,
            };
            value = self.emit(select);
        }
        Ok(value)
    }
}

/// A term of a sum.
enum Term<'e> {
    Plain(&'e Expr),
    /// factor·(e^exponent − 1), from a number and an exponential that would cancel.
    ExpM1 {
        factor: Rational,
        exponent: &'e Expr,
    },
}

/// The terms, with c·eˣ − c as one of them: it stands where the first of the two stood.
fn terms_without_cancellation(terms: &[Expr]) -> Vec<Term<'_>> {
    let number = terms.iter().position(|term| term.as_number().is_some());
    let pair = number.and_then(|number| {
        let constant = terms[number].as_number()?;
        let (place, exponent) = terms.iter().enumerate().find_map(|(place, term)| {
            let (factor, exponent) = as_exponential(term)?;
            (constant + factor == 0).then_some((place, exponent))
        })?;
        Some((number, place, Rational::from(-constant), exponent))
    });
    let Some((number, place, factor, exponent)) = pair else {
        return terms.iter().map(Term::Plain).collect();
    };
    let (first, second) = (number.min(place), number.max(place));
    let mut factor = Some(factor);
    terms
        .iter()
        .enumerate()
        .filter_map(|(i, term)| {
            if i == first {
                factor.take().map(|factor| Term::ExpM1 { factor, exponent })
            } else {
                (i != second).then_some(Term::Plain(term))
            }
        })
        .collect()
}

/// c and x of a term c·eˣ.
fn as_exponential(term: &Expr) -> Option<(Rational, &Expr)> {
    match term.kind() {
        Kind::Call(Function::Exp, exponent) => Some((Rational::from(1), exponent)),
        Kind::Product(factors) => match &factors[..] {
            [factor, exponential] => match (factor.as_number(), exponential.kind()) {
                (Some(factor), Kind::Call(Function::Exp, exponent)) => {
                    Some((factor.clone(), exponent))
                }
                _ => None,
            },
            _ => None,
        },
        _ => None,
    }
}

/// −x for a term with a negative coefficient, which is subtracted instead.
fn negated(term: &Expr) -> Option<Expr> {
    let negative = match term.kind() {
        Kind::Number(q) => *q < 0,
        Kind::Product(factors) => factors
            .first()
            .and_then(Expr::as_number)
            .is_some_and(|q| *q < 0),
        _ => false,
    };
    negative.then(|| -term)
}
