//! Expressions compiled once and run many times, in any format.

mod compile;
mod instruction;
mod kept;
mod run;

pub use compile::CompileError;
pub use instruction::{Instruction, Operand, Operation};
pub use kept::KeptProgram;
pub use run::Bound;

use crate::real::{Format, row};
use rug::Rational;
use std::sync::Arc;

/// Some expressions of the same variables as one flat list of instructions.
///
/// Parts that occur more than once, in one expression or in several, are computed once; sin and cos of the
/// same argument together. Where it is written so that digits would cancel, e^x − 1 and ln(1 + x) are
/// evaluated without. The order of operations is that of the expression, from left to right.
///
/// ```
/// use volver::real::Native;
/// use volver::symbolic::{Expr, Program};
///
/// let emission: Expr = "sin(s^2)".parse()?;
/// let extinction: Expr = "s*cos(s^2)".parse()?;
/// let program = Program::new(&[emission, extinction], &["s"])?;
/// // s², the pair of sine and cosine, and a product.
/// assert_eq!(program.instructions().len(), 3);
///
/// let mut values = [Vec::new(), Vec::new()];
/// program.bind(Native::<f64>::new()).run(&[&[0.0, 0.5]], &mut values);
/// assert_eq!(values[1][1], 0.5 * 0.25_f64.cos());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Program {
    inputs: Vec<Arc<str>>,
    constants: Vec<Constant>,
    instructions: Vec<Instruction>,
    outputs: Vec<Operand>,
    registers: usize,
}

/// A number that the program needs in the format it runs in.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Constant {
    /// A rational number, rounded once.
    Rational(Rational),
    /// π.
    Pi,
}

impl Program {
    /// Compiles `outputs` as functions of `inputs`.
    ///
    /// # Errors
    /// [`CompileError`] where a symbol is none of the inputs.
    pub fn new(
        outputs: &[crate::symbolic::Expr],
        inputs: &[&str],
    ) -> Result<Program, CompileError> {
        compile::compile(outputs, inputs)
    }

    /// The names of the inputs, in order.
    pub fn inputs(&self) -> impl Iterator<Item = &str> {
        self.inputs.iter().map(|name| &**name)
    }

    /// The constants.
    #[must_use]
    pub fn constants(&self) -> &[Constant] {
        &self.constants
    }

    /// What is done, in order.
    #[must_use]
    pub fn instructions(&self) -> &[Instruction] {
        &self.instructions
    }

    /// Where the values of the outputs are found at the end.
    #[must_use]
    pub fn outputs(&self) -> &[Operand] {
        &self.outputs
    }

    /// The program with its constants in `format`.
    pub fn bind<F: Format>(&self, format: F) -> Bound<'_, F> {
        Bound {
            program: self,
            format,
            constants: self.constants_in(format),
        }
    }

    fn constants_in<F: Format>(&self, format: F) -> Arc<[F::Real]> {
        let constants = self.constants.iter();
        let rounded = constants.map(|constant| match constant {
            Constant::Rational(q) => format.ratio(q),
            Constant::Pi => format.pi(),
        });
        row(rounded).into()
    }
}
